//! Why a picture cannot be made.

use std::path::PathBuf;

use pulvis_input::Problem;
use pulvis_io::IoError;
use thiserror::Error;

use crate::protocol::PrepareError;

/// Why a picture cannot be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// There is nothing of this name.
    #[error("there is no {}; expected the folder of a run, or a checkpoint", .0.display())]
    Nothing(PathBuf),
    /// A folder in which no run is.
    #[error("no run is in {}; expected a folder with the file run.toml or series.pvd of a run", .0.display())]
    NoRun(PathBuf),
    /// A run that has written no frames.
    #[error(
        "the run in {} has no frames to draw; let the scenario write some: `vtk = true` in [output], or `vtk = {{ interval = \"1 ms\" }}` for a sequence{}",
        .folder.display(),
        .checkpoint.as_ref().map_or(String::new(), |file| format!("\n  help: its checkpoint can be drawn: `pulvis render {}`", file.display()))
    )]
    NoFrames {
        /// The folder.
        folder: PathBuf,
        /// A checkpoint in it.
        checkpoint: Option<PathBuf>,
    },
    /// A frame that is not there.
    #[error("frame {found} is not there; expected 0 to {}, `last` or `all`", .count - 1)]
    NoFrame {
        /// What was asked for.
        found: usize,
        /// Number of frames.
        count: usize,
    },
    /// No frame is of this time.
    #[error(
        "no frame was written at {time:e} s; frames are written at the end of each stage unless `vtk = false`"
    )]
    NoTime {
        /// What was asked for \[s\].
        time: f64,
    },
    /// A column that is not there.
    #[error("colour: {0}")]
    Quantity(Box<Problem>),
    /// A column that every frame of a run has.
    #[error(
        "the frame has no column `{0}`, which every run writes; expected the files of a run as the run wrote them"
    )]
    Column(&'static str),
    /// A film of a picture.
    #[error("{}: a film needs frames; a checkpoint is one picture, expected a file that ends in .png", .0.display())]
    Film(PathBuf),
    /// A file with another ending.
    #[error("{}: no picture format is called `{found}`; choose one of: png, apng (a film of all frames)", .file.display())]
    Format {
        /// The file.
        file: PathBuf,
        /// Its ending.
        found: String,
    },
    /// The checkpoint cannot be used.
    #[error(transparent)]
    Checkpoint(#[from] PrepareError),
    /// A file of the run cannot be read.
    #[error(transparent)]
    Frame(IoError),
    /// The picture cannot be drawn or written.
    #[error(transparent)]
    Output(#[from] IoError),
}

impl RenderError {
    /// Whether what was asked for is to blame, and nothing has been written yet.
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, Self::Output(_))
    }
}
