//! What an experiment must give: its `expected.toml`.

use std::path::Path;

use pulvis_input::{Dimension, Document, Name, Reported, TableReader, Text};

use crate::Outcome;

/// What collisions must give.
pub struct Collisions {
    /// Relative tolerance of everything.
    pub tolerance: f64,
    /// χ and the restitution expected there.
    pub points: Vec<(f64, f64)>,
}

/// One demand on a column of a run's time series.
pub struct Demand {
    /// The column.
    pub column: String,
    /// Which rows count: those of the stage with this number, from 1; all where `None`.
    pub stage: Option<f64>,
    /// What of the numbers: `first`, `last`, `minimum`, `maximum`, `mean`, or `change`, the last one less the first one.
    pub pick: &'static str,
    /// The column by the same of which it is divided, if any.
    pub over: Option<String>,
    /// It must lie between these two.
    pub bounds: [f64; 2],
}

const PICKS: [&str; 6] = ["first", "last", "minimum", "maximum", "mean", "change"];

/// Reads what the collisions of an experiment must give; tests of `pulvis-lab` read the rest.
pub fn collisions(path: &Path) -> Outcome<Collisions> {
    read(path, |mut root| {
        let tolerance = root.required("tolerance", Dimension::NONE)?;
        let mut points = Vec::new();
        for mut point in root.tables("points")? {
            let chi = point.required("chi", Dimension::NONE)?;
            points.push((chi, point.required("restitution", Dimension::NONE)?));
            leave_the_rest(point);
        }
        leave_the_rest(root);
        Ok(Collisions { tolerance, points })
    })
}

/// Reads the tables `[[NAME.timeseries]]` that the scenario NAME.toml of the experiment must meet.
pub fn demands(path: &Path, scenario: &str) -> Outcome<Vec<Demand>> {
    read(path, |mut root| {
        let own = root.optional_table(scenario)?;
        leave_the_rest(root);
        let Some(mut own) = own else { return Ok(Vec::new()) };
        let demands = own.tables("timeseries")?.into_iter().map(demand).collect();
        leave_the_rest(own);
        demands
    })
}

/// Closes a table that holds keys for other readers.
fn leave_the_rest(mut table: TableReader<'_>) {
    for key in table.keys() {
        table.value(key);
    }
    table.finish();
}

fn demand(mut table: TableReader<'_>) -> Result<Demand, Reported> {
    let number = Dimension::NONE;
    let demand = Demand {
        column: table.required("column", Text)?.to_owned(),
        stage: table.optional("stage", number)?,
        pick: table.required("pick", Name(&PICKS))?,
        over: table.optional("over", Text)?,
        bounds: [table.required("least", number)?, table.required("most", number)?],
    };
    table.finish();
    Ok(demand)
}

fn read<T>(path: &Path, walk: impl FnOnce(TableReader<'_>) -> Result<T, Reported>) -> Outcome<T> {
    Document::load(path).and_then(|document| document.read(walk)).map_err(|errors| errors.to_string())
}
