//! Figures of papers, computed anew: symbols from simulations, lines from closed forms, and what they have to fulfil.
//!
//! Nothing here knows one figure: what is computed, drawn and checked stands in the figure's folder
//! ([`pulvis_input::figure`]). Collisions are computed by the exact method and by the engine's integrator at the
//! automatic time step.

mod chart;
mod curves;
mod judge;
mod limits;
mod quantity;
mod report;
mod results;
mod run;

pub use judge::Judged;
pub use report::{files, report};
pub use run::{Attempt, run_all};

use crate::collision::CollisionError;
use crate::probe::ProbeError;
use pulvis_input::figure::FigureScenario;
use pulvis_io::IoError;
use pulvis_io::plot::Figure;
use pulvis_io::table::Table;
use results::Results;
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
}

impl Reproduction {
    /// Whether all checks are fulfilled.
    pub fn passes(&self) -> bool {
        self.checks.iter().all(Judged::passes)
    }
}

/// Computes a figure.
///
/// # Errors
/// Something cannot be computed, or has no closed form.
pub fn reproduce(figure: &FigureScenario) -> Result<Reproduction, ReproductionError> {
    let results = Results::compute(figure)?;
    let (picture, table) = chart::draw(figure, &results)?;
    let judged = figure.checks.iter().map(|check| judge::judge(check, &results));
    let checks = judged.collect::<Result<_, _>>()?;
    Ok(Reproduction { picture, table, checks })
}
