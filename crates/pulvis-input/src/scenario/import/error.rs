//! Why a file of particles cannot be used.

use thiserror::Error;

/// Why a file of particles cannot be used.
#[derive(Debug, Error)]
pub enum PointsError {
    /// No such file.
    #[error("there is no file {file}")]
    Missing {
        /// The path of the file.
        file: String,
    },
    /// The file cannot be read.
    #[error("{file} cannot be read: {reason}")]
    Unreadable {
        /// The path of the file.
        file: String,
        /// The refusal of the operating system.
        reason: std::io::Error,
    },
    /// No particle stands in the file.
    #[error("{file} holds no particles; expected one or more")]
    Empty {
        /// The path of the file.
        file: String,
    },
    /// A table without a header whose columns cannot be told.
    #[error(
        "{file}:{line}: found {found} columns without names; expected 3 (x, y, z), 4 (and a radius) or 7 (and a velocity), or a line with their names"
    )]
    Headless {
        /// The path of the file.
        file: String,
        /// The number of the line, the first is 1.
        line: usize,
        /// Number of columns.
        found: usize,
    },
    /// A column that is needed is not there, or one that is there cannot be used.
    #[error("{file}:{line}: found the columns {found}; expected {expected}")]
    Columns {
        /// The path of the file.
        file: String,
        /// The number of the line, the first is 1.
        line: usize,
        /// The columns.
        found: String,
        /// What there should be.
        expected: String,
    },
    /// A line with too few or too many values.
    #[error("{file}:{line}: found {found} values; expected {expected}, one for each column")]
    Count {
        /// The path of the file.
        file: String,
        /// The number of the line.
        line: usize,
        /// Number of values.
        found: usize,
        /// Number of columns.
        expected: usize,
    },
    /// A value that is no finite number, a radius that is not positive, a material that is not known.
    #[error("{file}:{line}: {column} is {found}; expected {expected}")]
    Value {
        /// The path of the file.
        file: String,
        /// The number of the line.
        line: usize,
        /// The column.
        column: String,
        /// The value as written.
        found: String,
        /// What it should be.
        expected: String,
    },
    /// A line that does not belong where it stands.
    #[error("{file}:{line}: found {found}; expected {expected}")]
    Structure {
        /// The path of the file.
        file: String,
        /// The number of the line; one beyond the last where the file breaks off.
        line: usize,
        /// What stands there.
        found: String,
        /// What should stand there.
        expected: String,
    },
    /// An array whose numbers cannot be had.
    #[error("{file}:{line}: the array {name} {problem}")]
    Array {
        /// The path of the file.
        file: String,
        /// The number of the line on which the array is announced.
        line: usize,
        /// The name of the array.
        name: String,
        /// What is wrong with it, and what was expected.
        problem: String,
    },
    /// A folder that is not that of a run with frames.
    #[error(
        "{folder} has no series.pvd; expected the folder of a run that has written frames (`vtk` in its [output])"
    )]
    NoRun {
        /// The path of the folder.
        folder: String,
    },
    /// The record of a run, which names its materials, cannot be read.
    #[error("the names of the materials of the run cannot be read: {reason}")]
    Record {
        /// What is wrong, with the path of the file.
        reason: String,
    },
    /// A checkpoint that cannot be used.
    #[error("{reason}; expected a checkpoint of a run, or the folder of a run that has one")]
    Checkpoint {
        /// What is wrong, with the path of the file.
        reason: String,
    },
    /// A particle of a material that the scenario does not have.
    #[error(
        "{file}: the material of particle {particle} is \"{found}\"; expected one of {known}, as the key `materials` says"
    )]
    Material {
        /// The path of the file.
        file: String,
        /// Its number, from 0.
        particle: usize,
        /// The material.
        found: String,
        /// Those that are known.
        known: String,
    },
    /// The file has fewer instants.
    #[error("{file} holds {found} frames; expected more, for frame {wanted} counted from 0")]
    Frame {
        /// The path of the file.
        file: String,
        /// Number of instants.
        found: usize,
        /// The instant that was asked for.
        wanted: usize,
    },
}
