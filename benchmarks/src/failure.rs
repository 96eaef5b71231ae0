//! What can go wrong.

use std::path::PathBuf;

use pulvis_core::{SetupError, StepError};
use pulvis_input::InputErrors;
use pulvis_packing::InvalidDistribution;
use thiserror::Error;

/// Why a benchmark could not be run.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// A table could not be read.
    #[error("cannot read {}: {cause}", path.display())]
    Read { path: PathBuf, cause: std::io::Error },
    /// A table could not be written.
    #[error("cannot write {}: {cause}", path.display())]
    Write { path: PathBuf, cause: std::io::Error },
    /// A line of a table is not a particle.
    #[error(
        "{}, line {line}: found {found}, expected seven numbers `x y z r vx vy vz` in SI units, r > 0",
        path.display()
    )]
    Line { path: PathBuf, line: usize, found: String },
    /// A table without particles.
    #[error("{} holds no particles", path.display())]
    Empty { path: PathBuf },
    /// The tablet's lattice is a cube.
    #[error("{0} particles do not fill a cubic lattice; write for example 216 or 1728")]
    NoCube(usize),
    /// An instruction set that this machine does not have.
    #[error("no instruction set `{found}` on this machine; it has {expected}")]
    Instructions { found: String, expected: String },
    /// MPI cannot be used.
    #[cfg(feature = "mpi")]
    #[error("MPI: {0}")]
    Ranks(String),
    /// The system has no room for a thread.
    #[error("cannot begin a thread: {0}")]
    Thread(std::io::Error),
    #[error(transparent)]
    Law(#[from] InputErrors),
    #[error(transparent)]
    Radii(#[from] InvalidDistribution),
    #[error(transparent)]
    Setup(#[from] SetupError),
    #[error(transparent)]
    Step(#[from] StepError),
}
