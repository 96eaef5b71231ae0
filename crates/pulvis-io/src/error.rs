//! The one error of this crate.

use std::io;
use std::path::{Path, PathBuf};

/// What can go wrong while writing output; each message ends in what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IoError {
    /// The operating system refused to create, write, rename or read a file.
    #[error("cannot {action} {}: {source}; {}", path.display(), advice(source))]
    System {
        /// What was tried: "write", "read", "create the folder".
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A column does not have one value per row (particle, contact, wall, sphere).
    #[error("column `{column}` has {found} values for {expected} {rows}; give one value for each")]
    ColumnLength {
        /// Name of the column.
        column: String,
        /// What a row is: "particles", "contacts", "walls", "spheres".
        rows: &'static str,
        /// Number of rows.
        expected: usize,
        /// Number of values in the column.
        found: usize,
    },
    /// Two columns have the same name; readers would keep only one of them.
    #[error("two columns are called `{column}`; readers would keep only one, so rename the other")]
    DuplicateColumn {
        /// The name.
        column: String,
    },
    /// A row of a table does not have one cell per column.
    #[error(
        "a row of {found} cells does not fit a table of {expected} columns; fill missing cells explicitly"
    )]
    RowLength {
        /// Number of columns.
        expected: usize,
        /// Number of cells in the row.
        found: usize,
    },
    /// A frame was given a time that is not a number or does not follow its predecessor.
    #[error("frame time {time} s does not follow {previous} s; give finite, increasing times")]
    FrameTime {
        /// The refused time \[s\].
        time: f64,
        /// Time of the frame before \[s\]; minus infinity for the first.
        previous: f64,
    },
    /// The index of an earlier run cannot be understood.
    #[error("{} line {line} is not an entry that Pulvis wrote; start the series in a new folder", path.display())]
    Index {
        /// The index file.
        path: PathBuf,
        /// Line number, from 1.
        line: usize,
    },
    /// A file of a frame cannot be understood.
    #[error("{} is not a file that Pulvis wrote: {problem}; expected a VTK file of a run as the run wrote it", path.display())]
    Frame {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// A file of an interrupted run is no longer what it was.
    #[error("{} has changed since the checkpoint: {problem}; resume from a copy of the run as it was, or run it again", path.display())]
    Changed {
        /// The file.
        path: PathBuf,
        /// How it has changed.
        problem: String,
    },
    /// No writer has this file ending or name.
    #[error("no {what} format is called `{given}`; choose one of: {known}")]
    UnknownFormat {
        /// What was to be written: "plot", "table", "picture".
        what: &'static str,
        /// The ending or name that was given; empty if the path has no ending.
        given: String,
        /// The known names, separated by commas.
        known: String,
    },
    /// The program was built without a format.
    #[error("this program was built without the format `{format}`; {advice}, or choose another format")]
    NotBuilt {
        /// Its name.
        format: &'static str,
        /// How to build a program that has it.
        advice: &'static str,
    },
    /// A picture or plot has a size that cannot be drawn.
    #[error(
        "a picture of {width} x {height} pixels cannot be drawn; choose each side between {least} and {most}"
    )]
    PictureSize {
        /// Width asked for \[pixel\].
        width: u32,
        /// Height asked for \[pixel\].
        height: u32,
        /// Smallest side \[pixel\].
        least: u32,
        /// Largest side \[pixel\].
        most: u32,
    },
    /// The drawing library failed.
    #[error("drawing failed: {reason}; this is likely a bug of Pulvis, please report it")]
    Drawing {
        /// The library's words.
        reason: String,
    },
}

impl IoError {
    /// Wraps a system error with the file it concerns.
    pub(crate) fn system(action: &'static str, path: &Path, source: io::Error) -> Self {
        Self::System { action, path: path.to_path_buf(), source }
    }

    /// Wraps any failure of the drawing library.
    pub(crate) fn drawing(reason: impl std::fmt::Display) -> Self {
        Self::Drawing { reason: reason.to_string() }
    }
}

/// What a user can do about a system error.
fn advice(source: &io::Error) -> &'static str {
    match source.kind() {
        io::ErrorKind::NotFound => "create the folder first, or check the spelling of the path",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "choose a folder in which you may write"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "free some space or choose another disk",
        io::ErrorKind::IsADirectory => "name a file, not a folder",
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "a file has the name of a folder on this path; rename it or choose another"
        }
        _ => "check the path and the disk, then try again",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_error_names_the_file_and_says_what_to_do() {
        let error = IoError::system("write", Path::new("a/b.csv"), io::ErrorKind::NotFound.into());
        let text = error.to_string();
        assert!(text.starts_with("cannot write a/b.csv: "), "{text}");
        assert!(text.ends_with("create the folder first, or check the spelling of the path"), "{text}");
    }
}
