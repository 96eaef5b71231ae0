//! Why a run cannot start, or failed.

use std::path::PathBuf;

use pulvis_core::arrangement::{InvalidSizes, NoRoom};
use pulvis_core::{ParticleId, SetupError, StepError};
use pulvis_io::IoError;
use thiserror::Error;

/// What is wrong with a scenario once its particles exist: bad input, found before anything is written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// A time step that does not resolve the shortest contact.
    #[error(
        "{file}: {key}: {step:.4e} s is longer than 1/{least} of the shortest contact ({contact:.4e} s, {between}); \
         use at most {longest:.4e} s, or \"auto\""
    )]
    TimeStepTooLong {
        /// The scenario file.
        file: String,
        /// The key with the step.
        key: String,
        /// The step given [s].
        step: f64,
        /// The shortest contact [s].
        contact: f64,
        /// Whose contact that is.
        between: String,
        /// Fewest steps in a contact.
        least: f64,
        /// The longest step allowed [s].
        longest: f64,
    },
    /// A particle starts outside of the walls.
    #[error(
        "{file}: particles: particle {id} at ({x:.6e}, {y:.6e}, {z:.6e}) m lies {depth:.3e} m behind wall `{wall}`; \
         move the arrangement or the wall"
    )]
    Outside {
        /// The scenario file.
        file: String,
        /// Which particle.
        id: ParticleId,
        /// Where it is [m].
        x: f64,
        /// Where it is [m].
        y: f64,
        /// Where it is [m].
        z: f64,
        /// How far behind the wall [m].
        depth: f64,
        /// Which wall.
        wall: String,
    },
    /// Two particles, or a particle and a wall, start deep in each other.
    #[error(
        "{file}: particles: particle {id} overlaps {partner} by {overlap:.3e} m at the start, more than a tenth of its \
         radius ({radius:.3e} m); enlarge the spacing or the region"
    )]
    Overlap {
        /// The scenario file.
        file: String,
        /// Which particle.
        id: ParticleId,
        /// What it overlaps.
        partner: String,
        /// By how much [m].
        overlap: f64,
        /// Its radius [m].
        radius: f64,
    },
    /// No room for random places.
    #[error("{file}: particles[{group}].arrangement: {source}; enlarge the region or take fewer particles")]
    NoRoom {
        /// The scenario file.
        file: String,
        /// Which group of particles.
        group: usize,
        /// How far it got.
        source: NoRoom,
    },
    /// Radii that cannot be drawn.
    #[error("{file}: particles[{group}].radius: {source}")]
    Sizes {
        /// The scenario file.
        file: String,
        /// Which group of particles.
        group: usize,
        /// Why.
        source: InvalidSizes,
    },
    /// Everything else that the engine refuses.
    #[error("{file}: {source}")]
    Setup {
        /// The scenario file.
        file: String,
        /// Why.
        source: SetupError,
    },
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
