//! The experiment `chung-ooi`: eight benchmark tests, with the comparison printed (`--nocapture`).

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

use std::collections::{BTreeMap, BTreeSet};

use pulvis_input::collision::CollisionScenario;
use pulvis_input::{Dimension, Document, Integer, List, QuantityRule, Reported, TableReader, Text};
use pulvis_io::table::{Cell, Table, significant};
use pulvis_lab::collision::{SweepPoint, result_table, sweep};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../experiments/chung-ooi");

/// Numbers that one of the scenarios is compared with.
struct Check {
    file: String,
    quantity: String,
    source: String,
    /// Rows of the sweep, from 1; or overlaps on approach [m].
    rows: Vec<usize>,
    overlaps: Vec<f64>,
    values: Vec<f64>,
    tolerance: Option<f64>,
    scale: f64,
}

fn checks(mut root: TableReader<'_>) -> Result<Vec<Check>, Reported> {
    let number = || QuantityRule::of(Dimension::NONE);
    let mut checks = Vec::new();
    for mut table in root.tables("checks")? {
        let rows = table.or("rows", List::of(Integer::at_least(1)), Vec::new())?;
        checks.push(Check {
            file: table.required("file", Text)?,
            quantity: table.required("quantity", Text)?,
            source: table.required("source", Text)?,
            rows: rows.into_iter().map(|row| usize::try_from(row).unwrap()).collect(),
            overlaps: table.or("at", List::of(QuantityRule::of(Dimension::LENGTH)), Vec::new())?,
            values: table.required("values", List::of(number()))?,
            tolerance: table.optional("tolerance", number())?,
            scale: table.or("scale", number(), 0.0)?,
        });
        let note = table.optional("note", Text)?;
        assert!(note.is_some() || checks.last().unwrap().tolerance.is_some(), "why is it not demanded?");
        table.finish();
    }
    root.finish();
    Ok(checks)
}

/// The results of a scenario.
struct Results {
    points: Vec<SweepPoint>,
    table: Table,
}

impl Results {
    fn new(file: &str) -> Self {
        let scenario = CollisionScenario::load(format!("{FOLDER}/{file}.toml"), &[]);
        let scenario = scenario.unwrap_or_else(|errors| panic!("{errors}"));
        let points = sweep(&scenario, true).unwrap();
        let table = result_table(&scenario, &points, false).unwrap();
        Self { points, table }
    }

    /// A column of the table, or the largest force.
    fn at_row(&self, quantity: &str, row: usize) -> f64 {
        if quantity == "force_max" {
            let course = &self.points[row - 1].collision.course;
            return course.iter().map(|sample| sample.force).fold(0.0, f64::max);
        }
        let column = self.table.columns().iter().position(|name| name == quantity);
        match &self.table.rows()[row - 1][column.unwrap_or_else(|| panic!("{quantity}"))] {
            Cell::Number(value) => *value,
            other => panic!("{quantity} of row {row} is {other:?}"),
        }
    }

    /// The force at an overlap on approach, straight between two instants.
    fn force(&self, overlap: f64) -> f64 {
        let course = &self.points[0].collision.course;
        let pair = course.windows(2).find(|pair| pair[0].overlap <= overlap && overlap < pair[1].overlap);
        let pair = pair.expect("the overlap is reached");
        let share = (overlap - pair[0].overlap) / (pair[1].overlap - pair[0].overlap);
        pair[0].force + share * (pair[1].force - pair[0].force)
    }
}

#[test]
fn every_expected_number_is_met_and_all_are_printed() {
    let checks = Document::load(format!("{FOLDER}/expected.toml")).unwrap().read(checks).unwrap();
    let files: BTreeSet<&str> = checks.iter().map(|check| check.file.as_str()).collect();
    for number in 1..=8 {
        assert!(files.iter().any(|file| file.starts_with(&format!("test-{number}-"))), "test {number}");
    }
    let results: BTreeMap<&str, Results> = files.into_iter().map(|file| (file, Results::new(file))).collect();
    println!(
        "{:23} {:>9} {:22} {:11} {:>12} {:>12} {:>10} {:>10}",
        "file", "row or δ", "quantity", "source", "expected", "computed", "difference", "tolerance"
    );
    let mut missed = Vec::new();
    let mut demanded = 0;
    for check in &checks {
        let Check { file, quantity, source, rows, overlaps, values, tolerance, scale } = check;
        let results = &results[file.as_str()];
        let mut places: Vec<(String, f64)> =
            rows.iter().map(|row| (row.to_string(), results.at_row(quantity, *row))).collect();
        places.extend(
            overlaps.iter().map(|overlap| (format!("{:.1} µm", overlap * 1e6), results.force(*overlap))),
        );
        assert_eq!(places.len(), values.len(), "{file}, {quantity}");
        for ((place, computed), value) in places.iter().zip(values) {
            let difference = (computed - value) / value.abs().max(*scale);
            let limit = tolerance.map_or("reported".to_owned(), |tolerance| format!("{tolerance:e}"));
            let [value, computed] = [*value, *computed].map(|number| significant(number, 5));
            let line = format!(
                "{file:23} {place:>9} {quantity:22} {source:11} {value:>12} {computed:>12} {difference:10.5} {limit:>10}"
            );
            println!("{line}");
            demanded += usize::from(tolerance.is_some());
            if !tolerance.is_none_or(|tolerance| difference.abs() <= tolerance) {
                missed.push(line);
            }
        }
    }
    assert!(demanded > 80, "{demanded}");
    assert!(missed.is_empty(), "missed:\n{}", missed.join("\n"));
}
