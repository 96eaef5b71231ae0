//! The two small index files: one per frame (`.vtm`) and one per run (`.pvd`).

use super::polydata::escape;
use crate::{IoError, file};
use std::io::Write;
use std::path::Path;

/// One instant in the run's index.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    /// Time of the frame \[s\].
    pub(crate) time: f64,
    /// File of the frame, relative to the index.
    pub(crate) file: String,
}

/// Writes the index of one frame: named blocks, each a file in the same folder.
pub(crate) fn write_blocks(path: &Path, blocks: &[(&str, &str)]) -> Result<(), IoError> {
    file::replace(path, |out| {
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(
            out,
            "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">"
        )?;
        writeln!(out, "<vtkMultiBlockDataSet>")?;
        for (number, (name, file)) in blocks.iter().enumerate() {
            let (name, file) = (escape(name), escape(file));
            writeln!(out, "<DataSet index=\"{number}\" name=\"{name}\" file=\"{file}\"/>")?;
        }
        writeln!(out, "</vtkMultiBlockDataSet>\n</VTKFile>")
    })
}

/// Writes the index of a run. `{:?}` prints the shortest text that reads back as the same time.
pub(crate) fn write_series(path: &Path, entries: &[Entry]) -> Result<(), IoError> {
    file::replace(path, |out| {
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(out, "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">")?;
        writeln!(out, "<Collection>")?;
        for Entry { time, file } in entries {
            writeln!(out, "<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{}\"/>", escape(file))?;
        }
        writeln!(out, "</Collection>\n</VTKFile>")
    })
}

/// Reads an index that [`write_series`] wrote: one entry per line, which is all this parser knows of XML.
pub(crate) fn read_series(path: &Path) -> Result<Vec<Entry>, IoError> {
    let text = std::fs::read_to_string(path).map_err(|source| IoError::system("read", path, source))?;
    let mut entries = Vec::new();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| line.starts_with("<DataSet ")) {
        let entry = attribute(line, "timestep")
            .and_then(|time| time.parse::<f64>().ok())
            .zip(attribute(line, "file"))
            .map(|(time, file)| Entry { time, file: unescape(file) });
        entries.push(entry.ok_or_else(|| IoError::Index { path: path.to_path_buf(), line: number + 1 })?);
    }
    Ok(entries)
}

fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let start = line.find(&format!(" {name}=\""))? + name.len() + 3;
    let value = line.get(start..)?;
    value.get(..value.find('"')?)
}

fn unescape(text: &str) -> String {
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}
