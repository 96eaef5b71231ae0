//! Figures of papers, computed anew: symbols from simulations, lines from closed forms, and what they have to fulfil.
//!
//! Nothing here knows one figure: what is computed, drawn and checked stands in the figure's folder
//! ([`pulvis_input::figure`]). Collisions are computed by the exact method and by the engine's integrator at the
//! automatic time step; runs by the engine alone.

mod chain;
mod chart;
mod curves;
mod features;
mod judge;
mod limits;
mod quantity;
mod report;
mod results;
mod run;
mod series;
mod snapshots;
mod workplace;

pub use features::SeenFeature;
pub(crate) use features::measure;
pub use judge::Judged;
pub use report::{files, report};
pub use run::{Attempt, run_all};
pub(crate) use series::FinishedRun;
pub use snapshots::Snapshot;
pub use workplace::{RunDone, Seats, Workplace};

use crate::collision::CollisionError;
use crate::probe::ProbeError;
use crate::protocol::RunError;
use crate::rendering::RenderError;
use pulvis_input::figure::FigureScenario;
use pulvis_io::IoError;
use pulvis_io::plot::Figure;
use pulvis_io::table::Table;
use results::Results;
use std::path::PathBuf;
use thiserror::Error;

/// A figure that cannot be computed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReproductionError {
    /// A collision cannot be computed.
    #[error(transparent)]
    Collision(#[from] CollisionError),
    /// A probe cannot be computed.
    #[error(transparent)]
    Probe(#[from] ProbeError),
    /// A file cannot be written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A run failed.
    #[error("the run of `{data}`: {source}")]
    Run {
        /// The data.
        data: String,
        /// Why.
        source: Box<RunError>,
    },
    /// A folder for runs cannot be made.
    #[error("cannot create the folder {}: {source}; name a folder in which you may write with --output", .folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Particles of a run cannot be drawn.
    #[error("the particles of `{data}`: {source}")]
    Snapshot {
        /// The data.
        data: String,
        /// Why.
        source: Box<RenderError>,
    },
    /// The time series of a run, or a picture of it, cannot be read.
    #[error("{}: {reason}; run the figure again", .file.display())]
    TimeSeries {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: String,
    },
    /// A run has no such column.
    #[error(
        "the time series of `{data}` has no column `{column}`; there are {known}. `clusters = true` and `dimensionless` in [output] add some"
    )]
    NoColumn {
        /// The data.
        data: String,
        /// What is asked for.
        column: String,
        /// What there is.
        known: String,
    },
    /// The user stopped the program.
    #[error("interrupted")]
    Interrupted,
    /// A closed form is asked for where there is none.
    #[error("no closed form covers `{data}`; compare it with the exact method or with reference values")]
    NoTheory {
        /// The data.
        data: String,
    },
    /// A check that compares nothing would always pass.
    #[error(
        "the check of `{quantity}` of `{data}` finds nothing to compare; name another quantity or other data"
    )]
    NothingToCompare {
        /// The data.
        data: String,
        /// The quantity.
        quantity: &'static str,
    },
}

/// A figure that has been computed.
#[derive(Clone, Debug)]
pub struct Reproduction {
    /// The picture.
    pub picture: Figure,
    /// Every point of it.
    pub table: Table,
    /// What its checks found.
    pub checks: Vec<Judged>,
    /// What was seen in its runs.
    pub features: Vec<SeenFeature>,
    /// Pictures of particles.
    pub snapshots: Vec<Snapshot>,
}

impl Reproduction {
    /// Whether all checks are fulfilled.
    pub fn passes(&self) -> bool {
        self.checks.iter().all(Judged::passes) && self.features.iter().all(SeenFeature::passes)
    }
}

/// Computes a figure.
///
/// # Errors
/// Something cannot be computed, or has no closed form.
pub fn reproduce(
    figure: &FigureScenario,
    workplace: &Workplace<'_>,
) -> Result<Reproduction, ReproductionError> {
    let results = Results::compute(figure, workplace)?;
    let features = features::look_for(&figure.features, &results)?;
    let (picture, table) = chart::draw(figure, &results, &features)?;
    let judged = figure.checks.iter().map(|check| judge::judge(check, &results));
    let checks = judged.collect::<Result<_, _>>()?;
    let snapshots = snapshots::draw(figure, &results, workplace)?;
    Ok(Reproduction { picture, table, checks, features, snapshots })
}
