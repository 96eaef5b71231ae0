//! A CSV file that grows while a run goes on.

use super::number::exact;
use crate::IoError;
use std::fs::{File, OpenOptions};
use std::hash::Hasher;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use twox_hash::XxHash3_64;

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
pub struct TimeSeriesWriter {
    path: PathBuf,
    file: File,
    columns: usize,
    group: usize,
    waiting: usize,
    lines: csv::Writer<Vec<u8>>,
    bytes: u64,
    hash: XxHash3_64,
}

impl std::fmt::Debug for TimeSeriesWriter {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { path, bytes, waiting, .. } = self;
        let mut description = formatter.debug_struct("TimeSeriesWriter");
        description
            .field("path", path)
            .field("bytes", bytes)
            .field("waiting", waiting)
            .finish_non_exhaustive()
    }
}

/// How far a time series has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SeriesPosition {
    /// Length of the file \[byte\].
    pub bytes: u64,
    /// XXH3 of these bytes.
    pub hash: u64,
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
            bytes: 0,
            hash: XxHash3_64::with_seed(0),
        };
        series.record(names.iter().map(AsRef::as_ref))?;
        series.flush()?;
        Ok(series)
    }

    /// Goes on with the file of an interrupted run: what stands behind `position` is cut off. Answers with the rows before
    /// it, too.
    ///
    /// # Errors
    /// The file cannot be read or written, or is another one up to that position.
    pub fn resume<N: AsRef<str>>(
        path: &Path,
        columns: impl IntoIterator<Item = N>,
        position: SeriesPosition,
    ) -> Result<(Self, Vec<Vec<f64>>), IoError> {
        let failed = |source| IoError::system("read", path, source);
        let changed =
            |problem: &str| IoError::Changed { path: path.to_path_buf(), problem: problem.to_owned() };
        let mut file = OpenOptions::new().read(true).write(true).open(path).map_err(failed)?;
        let mut text = Vec::new();
        Read::by_ref(&mut file).take(position.bytes).read_to_end(&mut text).map_err(failed)?;
        if text.len() as u64 != position.bytes {
            return Err(changed("it has lost rows"));
        }
        if XxHash3_64::oneshot(&text) != position.hash {
            return Err(changed("its rows are other ones"));
        }
        let names: Vec<N> = columns.into_iter().collect();
        let mut reader = csv::Reader::from_reader(&text[..]);
        let header = reader.headers().map_err(|_| changed("it is no table"))?;
        if !header.iter().eq(names.iter().map(AsRef::as_ref)) {
            return Err(changed("it has other columns"));
        }
        let row = |record: csv::StringRecord| -> Option<Vec<f64>> {
            record.iter().map(|field| field.parse().ok()).collect()
        };
        let rows = reader.records().map(|record| record.ok().and_then(row)).collect::<Option<Vec<_>>>();
        let rows = rows.ok_or_else(|| changed("it holds something else than numbers"))?;
        let failed = |source| IoError::system("write", path, source);
        file.set_len(position.bytes).map_err(failed)?;
        file.seek(SeekFrom::End(0)).map_err(failed)?;
        let mut hash = XxHash3_64::with_seed(0);
        hash.write(&text);
        let series = Self {
            path: path.to_path_buf(),
            file,
            columns: names.len(),
            group: Self::GROUP,
            waiting: 0,
            lines: csv::Writer::from_writer(Vec::new()),
            bytes: position.bytes,
            hash,
        };
        Ok((series, rows))
    }

    /// How far the file has come; all rows so far are handed to the system first.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn position(&mut self) -> Result<SeriesPosition, IoError> {
        self.flush()?;
        Ok(SeriesPosition { bytes: self.bytes, hash: self.hash.finish() })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
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
        self.file.write_all(&bytes).map_err(|source| IoError::system("write", &self.path, source))?;
        self.bytes += bytes.len() as u64;
        self.hash.write(&bytes);
        Ok(())
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
    fn a_series_goes_on_where_it_was_and_what_came_later_or_in_halves_is_cut_off() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let columns = ["t [s]", "e, total [J]"];
        let row = |number: i32| [f64::from(number) / 7.0, if number == 3 { f64::NAN } else { -0.0 }];
        let mut series = TimeSeriesWriter::create(&path, columns).unwrap();
        (0..10).for_each(|number| series.row(&row(number)).unwrap());
        let position = series.position().unwrap();
        (10..20).for_each(|number| series.row(&row(number)).unwrap());
        series.finish().unwrap();
        let whole = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, format!("{whole}1.5,0.")).unwrap();
        let (mut series, rows) = TimeSeriesWriter::resume(&path, columns, position).unwrap();
        let bits = |row: &[f64]| row.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(rows.len(), 10);
        assert!(rows.iter().zip(0..).all(|(found, number)| bits(found) == bits(&row(number))));
        (10..20).for_each(|number| series.row(&row(number)).unwrap());
        let end = series.position().unwrap();
        series.finish().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), whole);
        assert_eq!(end.hash, XxHash3_64::oneshot(whole.as_bytes()));
        let refused = |text: &str, columns: [&str; 2]| {
            std::fs::write(&path, text).unwrap();
            let error = TimeSeriesWriter::resume(&path, columns, position).unwrap_err();
            assert!(std::fs::read_to_string(&path).unwrap() == text, "a refused file stays as it is");
            error.to_string()
        };
        assert!(refused(&whole[..90], columns).contains("it has lost rows"));
        assert!(refused(&whole.replacen("0,-0", "0,-1", 1), columns).contains("its rows are other ones"));
        assert!(refused(&whole, ["t [s]", "e"]).contains("it has other columns"));
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
