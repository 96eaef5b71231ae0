//! Why a run cannot start, or failed.

use std::path::{Path, PathBuf};

use pulvis_core::{SetupError, StepError};
use pulvis_input::{InputError, InputErrors};
use pulvis_io::IoError;
use thiserror::Error;

use super::checkpoint::FindError;
use super::openings::InletError;
use crate::rendering::RenderError;

/// What is wrong with a scenario once its particles exist: bad input, found before anything is written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// A mistake in the scenario that shows once its particles exist.
    #[error("{0}")]
    Scenario(Box<InputError>),
    /// The output folder holds a run.
    #[error(
        "output folder {} is not empty; choose another one with `--output DIR`, go on with the run in it with `--resume {}`, or write over that with `--force`",
        .folder.display(),
        .folder.display()
    )]
    RunInFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// The output folder holds something that is no run.
    #[error("output folder {} is not empty; choose another one with `--output DIR`", .folder.display())]
    FolderInUse {
        /// The folder.
        folder: PathBuf,
    },
    /// `--force` and a folder that holds something that is no run.
    #[error(
        "output folder {} is not empty and holds no run of Pulvis with its list of files, so that `--force` would remove what it does not know; choose another folder with `--output DIR`, or empty this one",
        .folder.display()
    )]
    NoRun {
        /// The folder.
        folder: PathBuf,
    },
    /// A file that the run in the folder has not made, and that a new one may write over.
    #[error(
        "{} was not made by the run in its folder, and the new run may write over it; move it elsewhere, or choose another folder with `--output DIR`",
        .file.display()
    )]
    FileInTheWay {
        /// The file.
        file: PathBuf,
    },
    /// Another run writes into the folder.
    #[error(
        "a run is going on in the output folder {}{}; wait for its end or stop it, or choose another folder with `--output DIR`",
        .folder.display(),
        .process.as_ref().map_or(String::new(), |process| format!(" (process {process})"))
    )]
    RunGoesOn {
        /// The folder.
        folder: PathBuf,
        /// The number of its process, where it can be read.
        process: Option<String>,
    },
    /// A scenario or a file that it names is wrong.
    #[error("{0}")]
    Input(Box<InputErrors>),
    /// There is nothing to go on with.
    #[error(
        "{} holds no run of Pulvis that could be resumed; name the output folder of a run, or a checkpoint in it",
        .folder.display()
    )]
    NothingToResume {
        /// The folder.
        folder: PathBuf,
    },
    /// There is nothing to explain.
    #[error("{} holds no run of Pulvis; name the output folder of a run", .folder.display())]
    NothingToExplain {
        /// The folder.
        folder: PathBuf,
    },
    /// There is no run whose state could be told.
    #[error("{} holds no run of Pulvis; name the output folder of a run", .folder.display())]
    NoStatus {
        /// The folder.
        folder: PathBuf,
    },
    /// The run is complete.
    #[error("the run in {} has ended: there is nothing to resume; to go on from its end, write a scenario with `start_from`", .folder.display())]
    RunHasEnded {
        /// The folder.
        folder: PathBuf,
    },
    /// No checkpoint can be had.
    #[error(transparent)]
    Checkpoint(#[from] FindError),
    /// A checkpoint is that of something else.
    #[error("{} does not belong to this run: {problem}", .file.display())]
    Misfit {
        /// The checkpoint.
        file: PathBuf,
        /// What does not fit.
        problem: String,
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
    /// Nobody belongs to a group.
    #[error(
        "stage {stage}: no particle belongs to the group {group} when it is gathered, at the start of this stage; look at its criteria in [groups.{group}]"
    )]
    EmptyGroup {
        /// The stage.
        stage: String,
        /// The group.
        group: String,
    },
    /// It could not start.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// What happened in a step cannot be right.
    #[error("stage `{stage}`, {source}\n  likely cause: {cause}{}", files_of(Some(.folder), *.saved))]
    Step {
        /// The stage.
        stage: String,
        /// Why.
        source: Box<StepError>,
        /// What has led to it, as far as the state tells.
        cause: String,
        /// The output folder.
        folder: PathBuf,
        /// The step of the last checkpoint, if there is one.
        saved: Option<u64>,
    },
    /// What happened in a step of a session cannot be right.
    #[error("stage `{stage}`, {source}\n  likely cause: {cause}")]
    Stopped {
        /// The stage.
        stage: String,
        /// Why.
        source: Box<StepError>,
        /// What has led to it, as far as the state tells.
        cause: String,
    },
    /// An inlet could not bring in what it should.
    #[error("stage `{stage}`: {source}{}", files_of(.folder.as_deref(), *.saved))]
    Inlet {
        /// The stage.
        stage: String,
        /// Why.
        source: Box<InletError>,
        /// The output folder; a session has none.
        folder: Option<PathBuf>,
        /// The step of the last checkpoint, if there is one.
        saved: Option<u64>,
    },
    /// The ranks that share a run cannot go on together.
    #[error("{reason}; the run has stopped on all ranks")]
    Ranks {
        /// What happened, and on which rank.
        reason: String,
    },
    /// A session is asked to go on after it has failed.
    #[error(
        "the simulation has failed and stands in the middle of a step: it can be looked at, but not go on"
    )]
    Broken,
    /// A session is asked for a checkpoint before its first step.
    #[error("no checkpoint can be written before the first step: the scenario says all there is")]
    NotBegun,
    /// Output could not be written.
    #[error(transparent)]
    Output(#[from] IoError),
    /// The particles could not be drawn.
    #[error(transparent)]
    Picture(#[from] Box<RenderError>),
    /// A file of the run cannot be made, or would replace one that is not its own.
    #[error("cannot make {}: {source}; move away what is there, or choose another folder with `--output DIR`", .file.display())]
    File {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A switch between stages was refused by the engine.
    #[error("stage `{stage}`: {source}")]
    Switch {
        /// The stage.
        stage: String,
        /// Why.
        source: SetupError,
    },
}

/// What is left of a run that has stopped.
fn files_of(folder: Option<&Path>, saved: Option<u64>) -> String {
    let Some(folder) = folder.map(Path::display) else { return String::new() };
    let saved = saved.map_or(String::new(), |step| format!("; its last checkpoint is of step {step}"));
    format!(
        "\n  the run has stopped; the files in {folder} are complete up to there{saved}; `pulvis explain {folder}` tells more"
    )
}

impl RunError {
    pub(super) fn inlet(stage: &str, source: InletError) -> Self {
        Self::Inlet { stage: stage.to_owned(), source: Box::new(source), folder: None, saved: None }
    }

    /// The same of a run with files in a folder.
    pub(super) fn with_folder(self, of_run: &Path) -> Self {
        match self {
            Self::Inlet { stage, source, folder: _, saved } => {
                Self::Inlet { stage, source, folder: Some(of_run.to_owned()), saved }
            }
            other => other,
        }
    }

    /// Whether the input is to blame, and nothing was computed yet.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Prepare(_))
    }
}

impl From<InputErrors> for PrepareError {
    fn from(errors: InputErrors) -> Self {
        Self::Input(Box::new(errors))
    }
}

impl From<InputError> for PrepareError {
    fn from(error: InputError) -> Self {
        Self::Scenario(Box::new(error))
    }
}
