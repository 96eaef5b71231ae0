//! The tables of a study: `runs.csv`, `study.csv` and `study.json`.

use super::folder::StudyFolder;
use super::results::{PointResult, Status, StudyResults, StudyRun};
use pulvis_input::study::{Study, StudyMeasure};
use pulvis_io::IoError;
use pulvis_io::table::{Cell, Table};

/// Columns for the values of the variables: keys with their units, numbers in SI.
fn value_columns(study: &Study) -> Vec<String> {
    let mut columns = Vec::new();
    for variable in &study.variables {
        if variable.is_named {
            columns.push(variable.label.clone());
        }
        columns.extend(variable.keys.iter().map(|key| match &key.unit {
            Some(unit) if unit != "1" => format!("{} [{unit}]", key.path),
            _ => key.path.clone(),
        }));
    }
    columns
}

/// The values of a point, in the order of [`value_columns`].
fn value_cells(study: &Study, point: usize) -> Vec<Cell> {
    let Some(point) = study.points.get(point) else { return Vec::new() };
    let mut cells = Vec::new();
    for (variable, choice) in study.variables.iter().zip(&point.choice) {
        let Some(value) = variable.values.get(*choice) else { continue };
        if variable.is_named {
            cells.push(Cell::from(value.name.as_str()));
        }
        for (key, number) in variable.keys.iter().zip(&value.numbers) {
            let text = || {
                let set = value.set.iter().find(|(path, _)| *path == key.path);
                set.map_or(String::new(), |(_, value)| value.to_string().trim_matches('"').to_owned())
            };
            cells.push(number.map_or_else(|| Cell::from(text()), Cell::from));
        }
    }
    cells
}

/// The name of a point.
fn name(study: &Study, point: usize) -> Cell {
    Cell::from(study.points.get(point).map_or("", |point| point.name.as_str()))
}

/// Writes the table of all runs.
pub(super) fn write_runs(study: &Study, runs: &[StudyRun], output: &StudyFolder) -> Result<(), IoError> {
    let mut columns = vec!["point".to_owned()];
    columns.extend(value_columns(study));
    columns.extend(["seed", "status", "message", "folder"].map(str::to_owned));
    columns.extend(study.measures.iter().map(|measure| measure.key.clone()));
    let mut table = Table::new(columns);
    for run in runs {
        let message = match &run.status {
            Status::Failed(message) => Cell::from(message.as_str()),
            _ => Cell::Empty,
        };
        // With slashes everywhere, so that the table is the same on every system.
        let folder: Vec<_> = run.folder.iter().map(|part| part.to_string_lossy()).collect();
        let about = [
            Cell::from(run.seed.to_string()),
            Cell::from(run.status.word()),
            message,
            Cell::from(folder.join("/")),
        ];
        let values = (0..study.measures.len()).map(|number| Cell::from(run.values.get(number).copied()));
        let row = [name(study, run.point)].into_iter().chain(value_cells(study, run.point));
        table.push(row.chain(about).chain(values))?;
    }
    table.write(&output.file("runs.csv"))
}

/// Columns of a measure at a point, behind the values.
const OF_POINT: [&str; 13] = [
    "measure",
    "runs",
    "failed",
    "open",
    "mean",
    "standard_error",
    "spread",
    "expected",
    "tolerance",
    "allowed",
    "certainty",
    "source",
    "verdict",
];

/// Writes the table of all points, a row for each measure.
pub(super) fn write_points(
    study: &Study,
    results: &StudyResults,
    output: &StudyFolder,
) -> Result<(), IoError> {
    let columns = ["point".to_owned()].into_iter().chain(value_columns(study));
    let mut table = Table::new(columns.chain(OF_POINT.map(str::to_owned)));
    for (point, of_measures) in results.points.iter().enumerate() {
        for (measure, result) in study.measures.iter().zip(of_measures) {
            let row = [name(study, point)].into_iter().chain(value_cells(study, point));
            table.push(row.chain(point_cells(measure, point, result)))?;
        }
    }
    table.write(&output.file("study.csv"))?;
    table.write(&output.file("study.json"))
}

fn point_cells(measure: &StudyMeasure, point: usize, result: &PointResult) -> [Cell; 13] {
    let expected = measure.expected.as_ref();
    let count = |number: usize| Cell::from(number as f64);
    [
        Cell::from(measure.key.as_str()),
        count(result.runs),
        count(result.failed),
        count(result.open),
        Cell::from(result.mean),
        Cell::from(result.standard_error),
        Cell::from(result.spread),
        Cell::from(expected.and_then(|expected| expected.values.get(point).copied())),
        Cell::from(expected.map(|expected| expected.tolerance)),
        Cell::from(result.allowed),
        Cell::from(expected.and_then(|expected| expected.certainty.clone())),
        Cell::from(expected.map(|expected| expected.source.clone())),
        Cell::from(result.verdict.map(|verdict| verdict.word())),
    ]
}

/// The table of one measure for the report.
pub(super) fn of_measure(study: &Study, results: &StudyResults, number: usize) -> Result<Table, IoError> {
    let columns = ["mean", "standard error", "spread", "runs", "expected", "allowed", "verdict"];
    let mut all: Vec<String> = value_columns(study);
    if all.is_empty() {
        all.push("point".to_owned());
    }
    let mut table = Table::new(all.into_iter().chain(columns.map(str::to_owned)));
    for (point, of_measures) in results.points.iter().enumerate() {
        let Some(result) = of_measures.get(number) else { continue };
        let expected = study.measures.get(number).and_then(|measure| measure.expected.as_ref());
        let mut values = value_cells(study, point);
        if values.is_empty() {
            values.push(name(study, point));
        }
        let own = [
            Cell::from(result.mean),
            Cell::from(result.standard_error),
            Cell::from(result.spread),
            Cell::from(result.runs as f64),
            Cell::from(expected.and_then(|expected| expected.values.get(point).copied())),
            Cell::from(result.allowed),
            Cell::from(result.verdict.map(|verdict| verdict.word())),
        ];
        table.push(values.into_iter().chain(own))?;
    }
    Ok(table)
}
