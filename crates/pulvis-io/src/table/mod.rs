//! Tables: for the terminal, for a file, and growing while a run goes on.
//!
//! A [`Table`] is held in memory and written in any of the [`FORMATS`]; a [`TimeSeriesWriter`] appends rows to a CSV file.
//! Column names carry the unit: `"force [N]"`.
//!
//! Numbers that are not finite are `nan`, `inf` and `-inf` in text and CSV (numpy and pandas read these), and `null` in
//! JSON, which has no word for them. CSV and JSON hold the shortest digits that read back as the same number.
//!
//! ```
//! use pulvis_io::table::{Cell, Table, format};
//!
//! # fn main() -> Result<(), pulvis_io::IoError> {
//! let mut table = Table::new(["law", "restitution [-]"]);
//! table.push([Cell::from("luding"), Cell::from(0.1 + 0.2)])?;
//! table.push([Cell::from("hertz"), Cell::Empty])?;
//! assert_eq!(table.to_text(3), "law     restitution [-]\n------  ---------------\nluding              0.3\nhertz\n");
//! assert_eq!(table.to_string(format("csv")?)?, "law,restitution [-]\nluding,0.30000000000000004\nhertz,\n");
//! # Ok(())
//! # }
//! ```

mod csv;
mod json;
mod number;
mod text;
mod time_series;

pub use number::significant;
pub use time_series::{SeriesPosition, TimeSeriesWriter};

use crate::{IoError, file};
use std::io::{self, Write};
use std::path::Path;

/// Every format in which a table can be written. A new one is a file beside this one and a line here.
pub const FORMATS: &[Format] = &[text::FORMAT, csv::FORMAT, json::FORMAT];

/// A way to write a [`Table`].
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// Name by which users choose it.
    pub name: &'static str,
    /// Ending of its files, without the dot.
    pub extension: &'static str,
    /// What it is good for, in one line.
    pub summary: &'static str,
    /// The writer.
    pub write: fn(&Table, &mut dyn Write) -> io::Result<()>,
}

/// The format called `name`.
///
/// # Errors
/// No format has this name; the error lists those that exist.
pub fn format(name: &str) -> Result<&'static Format, IoError> {
    find(name, |format| format.name)
}

fn find(given: &str, key: fn(&Format) -> &'static str) -> Result<&'static Format, IoError> {
    FORMATS.iter().find(|format| key(format).eq_ignore_ascii_case(given)).ok_or_else(|| {
        let known = FORMATS.iter().map(key).collect::<Vec<_>>().join(", ");
        IoError::UnknownFormat { what: "table", given: given.to_owned(), known }
    })
}

/// One entry of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number.
    Number(f64),
    /// Words.
    Text(String),
    /// Nothing was measured here.
    Empty,
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// Named columns and rows of cells; each row has one cell per column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table with these columns; write units into the names.
    pub fn new<N: Into<String>>(columns: impl IntoIterator<Item = N>) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The row does not have one cell per column.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) -> Result<(), IoError> {
        let row: Vec<Cell> = row.into_iter().collect();
        if row.len() != self.columns.len() {
            return Err(IoError::RowLength { expected: self.columns.len(), found: row.len() });
        }
        self.rows.push(row);
        Ok(())
    }

    /// Names of the columns.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The rows, each with one cell per column.
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// The table with aligned columns for a terminal, numbers rounded to `digits` significant digits.
    pub fn to_text(&self, digits: usize) -> String {
        text::render(self, digits)
    }

    /// The table in any format.
    ///
    /// # Errors
    /// The writer fails, which none does in memory.
    pub fn to_string(&self, format: &Format) -> Result<String, IoError> {
        let mut bytes = Vec::new();
        (format.write)(self, &mut bytes).map_err(|e| IoError::system("write", Path::new(format.name), e))?;
        // Every format writes UTF-8, so nothing is lost here.
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// Writes the table to `path` in the format that the file's ending names.
    ///
    /// # Errors
    /// An ending that no format has, or a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), IoError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        let format = find(&ending, |format| format.extension)?;
        file::replace(path, |out| (format.write)(self, out))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn every_format_is_found_by_name_and_by_ending() {
        let folder = tempfile::tempdir().unwrap();
        let mut table = Table::new(["a [m]"]);
        table.push([Cell::Number(1.5)]).unwrap();
        for listed in FORMATS {
            assert_eq!(format(listed.name).unwrap().name, listed.name);
            let path = folder.path().join("table").with_extension(listed.extension);
            table.write(&path).unwrap();
            assert_eq!(std::fs::read_to_string(path).unwrap(), table.to_string(listed).unwrap());
        }
    }

    #[test]
    fn an_unknown_ending_is_refused_with_the_list() {
        let error = Table::default().write(Path::new("table.xlsx")).unwrap_err();
        assert_eq!(error.to_string(), "no table format is called `xlsx`; choose one of: txt, csv, json");
    }

    #[test]
    fn a_row_of_the_wrong_length_is_refused() {
        let error = Table::new(["a", "b"]).push([Cell::Empty]);
        assert!(matches!(error, Err(IoError::RowLength { expected: 2, found: 1 })));
    }
}
