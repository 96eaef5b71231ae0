//! Tables of values that another program computed.

use super::Surroundings;
use crate::context::Reported;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Text;
use std::path::PathBuf;

/// A table of reference values, in SI units. Lines that begin with `#` say where they are from.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceTable {
    /// The file.
    pub file: PathBuf,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// One number a column.
    pub rows: Vec<Vec<f64>>,
}

impl ReferenceTable {
    /// The values of a column.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let place = self.columns.iter().position(|column| column == name)?;
        self.rows.iter().map(|row| row.get(place).copied()).collect()
    }

    fn parse(file: PathBuf, text: &str) -> Result<Self, String> {
        let lines = text.lines().zip(1..).filter(|(line, _)| !line.trim_start().starts_with('#'));
        let mut lines = lines.filter(|(line, _)| !line.trim().is_empty());
        let Some((head, _)) = lines.next() else { return Err("has no line".to_owned()) };
        let columns: Vec<String> = head.split(',').map(|name| name.trim().to_owned()).collect();
        let row = |(line, number): (&str, usize)| {
            let numbers =
                line.split(',').map(|cell| cell.trim().parse::<f64>().ok().filter(|x| x.is_finite()));
            let numbers: Option<Vec<f64>> = numbers.collect();
            numbers
                .filter(|numbers| numbers.len() == columns.len())
                .ok_or_else(|| format!("line {number} does not hold {} finite numbers", columns.len()))
        };
        let rows: Vec<Vec<f64>> = lines.map(row).collect::<Result<_, _>>()?;
        if rows.is_empty() {
            return Err("has no row of numbers".to_owned());
        }
        Ok(Self { file, columns, rows })
    }
}

/// Reads the table whose file stands at `key`.
pub(super) fn read_reference(
    table: &mut TableReader<'_>,
    key: &str,
    around: &Surroundings<'_>,
) -> Result<ReferenceTable, Reported> {
    let name = table.required(key, Text)?;
    let file = around.folder.join(&name);
    let text = std::fs::read_to_string(&file).map_err(|error| format!("cannot be read: {error}"));
    text.and_then(|text| ReferenceTable::parse(file, &text)).map_err(|reason| {
        let expected = "a line of column names and lines of numbers, with commas between";
        table.refuse(key, Problem::rule(format!("`{name}` {reason}"), expected))
    })
}
