//! Studies: a scenario over seeds and over every combination of some values, its runs in parallel; means, standard errors,
//! pictures, and what the means are expected to be.
//!
//! [`load_study`] reads a study and [`plan`] looks at its output folder; [`check`] prepares every point and refuses what can be
//! known; [`run_study`] carries out what is missing and writes tables, pictures and report. A run that fails is recorded and
//! stops nothing. The same call goes on where it was interrupted.

mod budget;
mod chart;
mod check;
mod folder;
mod plan;
mod report;
mod results;
mod runs;
mod tables;

pub use check::{Checked, Forecast, check, time_of_first_point};
pub use plan::{Plan, PlannedRun, plan};
pub use results::{PointResult, Status, StudyResults, StudyRun};
pub use runs::{StudyOptions, Told, run_study};

use crate::protocol::{PrepareError, column_names, load_document};
use pulvis_input::study::Study;
use pulvis_io::IoError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a study cannot be computed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The study, its scenario or its folder.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// What only the particles of a point can tell.
    #[error("{source}\n  note: this is the point {point} of the study")]
    Point {
        /// The name of the point.
        point: String,
        /// What is wrong.
        source: PrepareError,
    },
    /// The folder of a run is taken.
    #[error(
        "{} holds a run of another scenario, or by another version of Pulvis; choose another folder with `--output DIR`, or begin the runs of the study anew with `--force`",
        .folder.display()
    )]
    OtherRun {
        /// The folder.
        folder: PathBuf,
    },
    /// A table, a picture or the report cannot be written.
    #[error(transparent)]
    Io(#[from] IoError),
}

impl StudyError {
    /// Whether the input is to blame, and nothing was computed yet.
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, Self::Io(_))
    }
}

/// Reads a study and its scenario at every point.
///
/// # Errors
/// All mistakes of both files, columns that the time series will not have included.
pub fn load_study(file: &Path) -> Result<Study, PrepareError> {
    let study = Study::load(file, &load_document)?;
    study.check_columns(column_names)?;
    Ok(study)
}
