//! Why a file of triangles cannot be used.

use thiserror::Error;

/// Why a file of triangles cannot be used.
#[derive(Debug, Error)]
pub enum MeshFileError {
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
    /// The name tells no known format.
    #[error(
        "{file} is neither an STL nor an OBJ file by its name; expected a name that ends with .stl or .obj"
    )]
    Format {
        /// The path of the file.
        file: String,
    },
    /// An STL file that is no text has another length than it says.
    #[error(
        "{file} is damaged: it holds {found} bytes; expected {expected}, the header and the triangles that it counts"
    )]
    Length {
        /// The path of the file.
        file: String,
        /// Its length [byte].
        found: usize,
        /// The length that it should have [byte].
        expected: u64,
    },
    /// A line that does not belong there.
    #[error("{file}:{line}: found `{found}`; expected {expected}")]
    Line {
        /// The path of the file.
        file: String,
        /// The number of the line, the first is 1.
        line: usize,
        /// What stands there.
        found: String,
        /// What should.
        expected: &'static str,
    },
    /// The triangles are no surface.
    #[error("{file} is no surface: {reason}")]
    Surface {
        /// The path of the file.
        file: String,
        /// Why.
        reason: pulvis_boundary::InvalidMesh,
    },
    /// The file is not the one that the run began with.
    #[error(
        "{file} has changed: its hash is {found}; expected {expected}, that of the file at the start of the run"
    )]
    Changed {
        /// The path of the file.
        file: String,
        /// Its hash.
        found: String,
        /// The hash that was asked for.
        expected: String,
    },
}
