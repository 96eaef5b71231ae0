//! The numbers that a study takes out of its runs.

use super::expected::{Expected, read_expected};
use super::points::Combined;
use super::variable::plain;
use crate::context::{Location, Reported};
use crate::figure::feature::{Measured, read_rows};
use crate::figure::{Expression, Measure, one_paragraph};
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Text;

/// A number out of the time series of each run.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyMeasure {
    /// Its short name: of columns, and of the files of its picture.
    pub key: String,
    /// What it is, in words.
    pub what: String,
    /// Its unit, for axes.
    pub unit: Option<String>,
    /// The number.
    pub measure: Measure,
    /// By what it is divided.
    pub over: Option<Measure>,
    /// What its mean has to be.
    pub expected: Option<Expected>,
    /// The columns that it needs, and where they are named.
    pub(super) columns: Vec<(String, Location)>,
}

/// Reads all `[[measures]]`.
pub(super) fn read_measures(
    root: &mut TableReader<'_>,
    combined: &Combined,
) -> Result<Vec<StudyMeasure>, Reported> {
    let tables = root.tables("measures")?;
    if tables.is_empty() {
        let expected = "one table [[measures]] for each number that is taken out of the runs".to_owned();
        return Err(root.refuse("", Problem::MissingKey { key: "measures".to_owned(), expected }));
    }
    let mut all: Vec<StudyMeasure> = Vec::new();
    let mut failure = None;
    for table in tables {
        match read_one(table, combined, &all) {
            Ok(measure) => all.push(measure),
            Err(reported) => failure = Some(reported),
        }
    }
    failure.map_or(Ok(all), Err)
}

fn read_one(
    mut table: TableReader<'_>,
    combined: &Combined,
    before: &[StudyMeasure],
) -> Result<StudyMeasure, Reported> {
    let key = table.required("key", Text).and_then(|key| refuse_bad_key(&table, key, before));
    let what = table.required("what", Text);
    let unit = table.optional("unit", Text);
    let stages = combined.points.first().map(|point| point.scenario.stages.as_slice()).unwrap_or_default();
    let measured = || Ok(Some(Measured { data: 0, name: "the scenario", stages }));
    let measure = read_rows(&mut table, measured(), None);
    let mut columns = measure.as_ref().map(|measure| columns(&mut table, measure)).unwrap_or_default();
    let over = table.optional_table("over").and_then(|over| {
        let Some(mut over) = over else { return Ok(None) };
        let read = read_rows(&mut over, measured(), measure.as_ref().ok());
        if let Ok(read) = &read {
            columns.extend(self::columns(&mut over, read));
        }
        over.finish();
        read.map(Some)
    });
    let points: Vec<&[usize]> = combined.points.iter().map(|point| point.choice.as_slice()).collect();
    let expected = read_expected(&mut table, &points);
    table.finish();
    Ok(StudyMeasure {
        key: key?,
        what: one_paragraph(&what?),
        unit: unit?,
        measure: measure?,
        over: over?,
        expected: expected?,
        columns,
    })
}

/// Names that tables and files of the study have for something else.
const TAKEN: [&str; 9] =
    ["point", "seed", "status", "message", "folder", "runs", "report", "study", "particles"];

fn refuse_bad_key(table: &TableReader<'_>, key: String, before: &[StudyMeasure]) -> Result<String, Reported> {
    let same = |other: &str| other.eq_ignore_ascii_case(&key);
    let problem = if plain(&key) != key {
        Problem::rule(format!("`{key}` cannot be the name of a file"), "letters, digits and `_`, `-`, `.`")
    } else if TAKEN.iter().any(|taken| same(taken)) {
        Problem::rule(format!("`{key}` is a word of the study's own tables"), "another name")
    } else if before.iter().any(|other| same(&other.key)) {
        Problem::rule(format!("two [[measures]] are called `{key}`"), "a `key` of its own for each")
    } else {
        return Ok(key);
    };
    Err(table.refuse("key", problem))
}

/// The columns that a measure needs, each with the place that names it.
fn columns(table: &mut TableReader<'_>, measure: &Measure) -> Vec<(String, Location)> {
    let mut columns = Vec::new();
    for (key, column) in [("x", &measure.x), ("y", &measure.y)] {
        columns.push((column, table.location(key)));
    }
    if let Some(within) = &measure.within {
        columns.push((&within.column, table.location("within")));
    }
    // What is no formula has been refused.
    let needed = |text: &String| Expression::parse(text).map(|formula| formula.columns().to_vec());
    let each = |(text, place): (&String, Location)| {
        let columns = needed(text).unwrap_or_default().into_iter();
        columns.map(move |column| (column, place.clone()))
    };
    columns.into_iter().flat_map(each).collect()
}
