//! Why a run cannot start, or failed.

use std::path::PathBuf;

use pulvis_core::{SetupError, StepError};
use pulvis_input::InputError;
use pulvis_io::IoError;
use thiserror::Error;

/// What is wrong with a scenario once its particles exist: bad input, found before anything is written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// A mistake in the scenario that shows once its particles exist.
    #[error("{0}")]
    Scenario(Box<InputError>),
    /// The output folder holds something already.
    #[error(
        "output folder {} is not empty; choose another one with `--output DIR`, or write over the run in it with `--force`",
        .folder.display()
    )]
    FolderInUse {
        /// The folder.
        folder: PathBuf,
    },
    /// The output folder cannot be used.
    #[error("output folder {}: {source}; choose another one with `--output DIR`", .folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

/// What stopped a run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunError {
    /// It could not start.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// A step failed.
    #[error("stage `{stage}`: {source}")]
    Step {
        /// The stage.
        stage: String,
        /// Why.
        source: StepError,
    },
    /// Output could not be written.
    #[error(transparent)]
    Output(#[from] IoError),
    /// A switch between stages was refused by the engine.
    #[error("stage `{stage}`: {source}")]
    Switch {
        /// The stage.
        stage: String,
        /// Why.
        source: SetupError,
    },
}

impl RunError {
    /// Whether the input is to blame, and nothing was computed yet.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Prepare(_))
    }
}

impl From<InputError> for PrepareError {
    fn from(error: InputError) -> Self {
        Self::Scenario(Box::new(error))
    }
}
