//! A CSV file that grows while a run goes on.

use super::number::exact;
use crate::IoError;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Appends rows of numbers to a CSV file, in groups of complete lines.
///
/// Rows are gathered in memory and handed to the system one group at a time, ending in a line break, so that a run which
/// is killed leaves a file of complete lines (at most the last group is missing). Dropping the writer writes what is
/// left but cannot tell of an error: end with [`TimeSeriesWriter::finish`].
///
/// ```
/// use pulvis_io::table::TimeSeriesWriter;
///
/// # fn main() -> Result<(), pulvis_io::IoError> {
/// # let scratch = tempfile::tempdir().expect("a temporary folder");
/// # let path = scratch.path().join("energy.csv");
/// let mut series = TimeSeriesWriter::create(&path, ["time [s]", "kinetic energy [J]"])?;
/// series.row(&[0.0, 0.5])?;
/// series.row(&[1.0e-6, 0.4375])?;
/// series.finish()?;
/// # assert_eq!(std::fs::read_to_string(&path).unwrap(), "time [s],kinetic energy [J]\n0,0.5\n1e-6,0.4375\n");
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct TimeSeriesWriter {
    path: PathBuf,
    file: File,
    columns: usize,
    group: usize,
    waiting: usize,
    lines: csv::Writer<Vec<u8>>,
}

impl TimeSeriesWriter {
    /// Rows per group unless [`TimeSeriesWriter::rows_per_group`] says otherwise: one write per few kilobytes.
    const GROUP: usize = 32;

    /// Creates the file and writes its header; write units into the names.
    ///
    /// # Errors
    /// The file cannot be created or written.
    pub fn create<N: AsRef<str>>(path: &Path, columns: impl IntoIterator<Item = N>) -> Result<Self, IoError> {
        let file = File::create(path).map_err(|source| IoError::system("write", path, source))?;
        let names: Vec<N> = columns.into_iter().collect();
        let mut series = Self {
            path: path.to_path_buf(),
            file,
            columns: names.len(),
            group: Self::GROUP,
            waiting: 0,
            lines: csv::Writer::from_writer(Vec::new()),
        };
        series.record(names.iter().map(AsRef::as_ref))?;
        series.flush()?;
        Ok(series)
    }

    /// Sets after how many rows a group is handed to the system; one for rows that are minutes apart.
    #[must_use]
    pub fn rows_per_group(mut self, rows: usize) -> Self {
        self.group = rows.max(1);
        self
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The row does not have one number per column, or the file cannot be written.
    pub fn row(&mut self, values: &[f64]) -> Result<(), IoError> {
        if values.len() != self.columns {
            return Err(IoError::RowLength { expected: self.columns, found: values.len() });
        }
        self.record(values.iter().map(|&value| exact(value)))?;
        self.waiting += 1;
        if self.waiting >= self.group { self.flush() } else { Ok(()) }
    }

    /// Hands the rows so far to the system.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn flush(&mut self) -> Result<(), IoError> {
        let fresh = csv::Writer::from_writer(Vec::new());
        let lines = std::mem::replace(&mut self.lines, fresh);
        self.waiting = 0;
        let bytes = lines.into_inner().map_err(|error| {
            let reason = std::io::Error::other(error.error().to_string());
            IoError::system("write", &self.path, reason)
        })?;
        self.file.write_all(&bytes).map_err(|source| IoError::system("write", &self.path, source))
    }

    /// Writes what is left and closes the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(mut self) -> Result<(), IoError> {
        self.flush()
    }

    fn record<T: AsRef<[u8]>>(&mut self, fields: impl IntoIterator<Item = T>) -> Result<(), IoError> {
        self.lines.write_record(fields).map_err(|error| IoError::system("write", &self.path, error.into()))
    }
}

impl Drop for TimeSeriesWriter {
    fn drop(&mut self) {
        // A drop cannot report; `finish` does.
        let _ = self.flush();
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_killed_run_leaves_complete_lines() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        // Long lines: far more than any buffer of 8 KiB in one group.
        let mut series = TimeSeriesWriter::create(&path, (0..40).map(|n| format!("c{n}"))).unwrap();
        for row in 0..100 {
            series.row(&[f64::from(row) / 7.0; 40]).unwrap();
        }
        // Forgetting is the nearest a test comes to being killed: no destructor runs.
        std::mem::forget(series);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.ends_with('\n'));
        assert_eq!(text.lines().count(), 1 + 96, "header and three groups of 32");
        assert!(text.lines().all(|line| line.split(',').count() == 40));
        assert_eq!(text.lines().last().unwrap().split(',').next().unwrap().parse(), Ok(95.0 / 7.0));
    }

    #[test]
    fn the_header_is_there_before_the_first_row() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let mut series =
            TimeSeriesWriter::create(&path, ["t [s]", "e, total [J]"]).unwrap().rows_per_group(1);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "t [s],\"e, total [J]\"\n");
        series.row(&[f64::NAN, f64::INFINITY]).unwrap();
        assert!(std::fs::read_to_string(&path).unwrap().ends_with("\nnan,inf\n"));
        assert!(matches!(series.row(&[1.0]), Err(IoError::RowLength { expected: 2, found: 1 })));
    }
}
