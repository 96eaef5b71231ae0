//! The two small index files: one per frame (`.vtm`) and one per run (`.pvd`).

use super::polydata::escape;
use crate::{IoError, file};
use std::io::Write;
use std::path::Path;

/// One instant in the index of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Time of the frame \[s\].
    pub time: f64,
    /// File of the frame, relative to the index.
    pub file: String,
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

/// The frames of a run, from the index that it wrote: one entry a line, which is all that this parser knows of XML.
///
/// # Errors
/// The index cannot be read, or is not one that Pulvis wrote.
pub fn read_series(path: &Path) -> Result<Vec<Entry>, IoError> {
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

/// Name and file of the blocks of a frame.
pub(super) fn read_blocks(path: &Path) -> Result<Vec<(String, String)>, IoError> {
    let text = std::fs::read_to_string(path).map_err(|source| IoError::system("read", path, source))?;
    let mut blocks = Vec::new();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| line.starts_with("<DataSet ")) {
        let block = attribute(line, "name").zip(attribute(line, "file"));
        let (name, file) =
            block.ok_or_else(|| IoError::Index { path: path.to_path_buf(), line: number + 1 })?;
        blocks.push((unescape(name), unescape(file)));
    }
    Ok(blocks)
}

pub(super) fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let start = line.find(&format!(" {name}=\""))? + name.len() + 3;
    let value = line.get(start..)?;
    value.get(..value.find('"')?)
}

pub(super) fn unescape(text: &str) -> String {
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}
