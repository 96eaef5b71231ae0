//! The time series of a run, while it grows and afterwards.

use serde_json::{Map, Value, json};
use std::path::Path;

/// More rows than a chart is wide are thinned out.
const MOST_ROWS: usize = 4000;

/// A table of numbers.
#[derive(Debug)]
pub(crate) struct Series {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Series {
    /// Whole lines of the file, as far as it is written.
    pub(super) fn read(file: &Path) -> Option<Self> {
        let text = std::fs::read_to_string(file).ok()?;
        let whole = text.get(..text.rfind('\n')? + 1)?;
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(whole.as_bytes());
        let names = reader.headers().ok()?.iter().map(str::to_owned).collect();
        let row = |record: csv::StringRecord| {
            record.iter().map(|field| field.parse().unwrap_or(f64::NAN)).collect()
        };
        let rows = reader.records().filter_map(|record| record.ok().map(row)).collect();
        Some(Self { names, rows })
    }

    /// All names, number of rows, and the numbers of some columns: one row of several where there are very many, and the last.
    pub(crate) fn columns<'n>(&self, wanted: impl Iterator<Item = &'n str>) -> Value {
        let stride = self.rows.len().div_ceil(MOST_ROWS).max(1);
        let last = self.rows.len().saturating_sub(1);
        let rows = || self.rows.iter().enumerate().filter(|(row, _)| row % stride == 0 || *row == last);
        let column = |name: &str| {
            let place = self.names.iter().position(|known| known == name)?;
            let numbers: Vec<f64> =
                rows().map(|(_, row)| row.get(place).copied().unwrap_or(f64::NAN)).collect();
            Some((name.to_owned(), json!(numbers)))
        };
        let numbers: Map<String, Value> = wanted.filter_map(column).collect();
        json!({ "names": self.names, "rows": self.rows.len(), "columns": numbers })
    }

    /// All of them.
    pub(crate) fn all(&self) -> Value {
        self.columns(self.names.iter().map(String::as_str))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_line_that_is_being_written_is_not_shown_yet() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("timeseries.csv");
        std::fs::write(&file, "time,kinetic\n0,1.5\n0.1,NaN\n0.2,0.").unwrap();
        let series = Series::read(&file).unwrap().all();
        assert_eq!(series["columns"]["time"], json!([0.0, 0.1]));
        assert_eq!(series["columns"]["kinetic"], json!([1.5, null]));
        assert_eq!(series["rows"], json!(2));
    }

    #[test]
    fn long_series_are_thinned_out_and_keep_their_last_row() {
        let rows: Vec<Vec<f64>> = (0..10_001).map(|row| vec![f64::from(row)]).collect();
        let series = Series { names: vec!["time".to_owned()], rows }.all();
        let times = series["columns"]["time"].as_array().unwrap();
        assert!(times.len() <= MOST_ROWS + 1 && times.len() > MOST_ROWS / 2, "{}", times.len());
        assert_eq!(times.last().unwrap(), &json!(10_000.0));
    }
}
