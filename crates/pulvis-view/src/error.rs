//! Why something cannot be shown.

use pulvis_io::IoError;
use std::net::SocketAddr;
use std::path::PathBuf;
use thiserror::Error;

/// Why something cannot be shown.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViewError {
    /// There is nothing of this name.
    #[error("there is no {}; expected the folder of a run", .0.display())]
    Nothing(PathBuf),
    /// A file in the place of a folder.
    #[error("{} is a file; expected the folder of a run", .0.display())]
    NoFolder(PathBuf),
    /// A folder in which no run is.
    #[error("no run is in {}; expected a folder with the file run.toml or series.pvd of a run", .0.display())]
    NoRun(PathBuf),
    /// A run that has written no frames.
    #[error(
        "the run in {} has no frames to show; let the scenario write some: `vtk = true` in [output], or `vtk = {{ interval = \"1 ms\" }}` for a sequence", .0.display()
    )]
    NoFrames(PathBuf),
    /// The port is taken.
    #[error("port {} of {} is taken; choose another one with --port, or leave --port out to get the next free one", .0.port(), .0.ip())]
    PortTaken(SocketAddr),
    /// The address is not one of this machine, or may not be used.
    #[error(
        "cannot listen at {address}: {source}; expected an address of this machine and a port from 1024 on"
    )]
    Listen {
        /// The address.
        address: SocketAddr,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file of the run cannot be read.
    #[error(transparent)]
    File(#[from] IoError),
    /// The page cannot be written; an older file of this name is as it was.
    #[error(transparent)]
    Write(IoError),
}

impl ViewError {
    /// Whether what was asked for is to blame.
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, Self::Write(_))
    }
}
