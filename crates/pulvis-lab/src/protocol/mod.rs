//! Bulk experiments: a scenario's stages, run one after another.
//!
//! [`prepare`] turns a scenario into a simulation and refuses what only its particles can tell;
//! [`preflight`] says what a run will be like; [`run`] does it and writes its files.

mod check;
mod error;
mod folder;
mod measure;
mod pace;
mod packed;
mod packing_picture;
mod particles;
mod report;
mod run;
mod setup;
mod snapshots;
mod stage;

pub use check::{ContactForecast, Preflight, StageForecast, preflight};
pub use error::{PrepareError, RunError};
pub use measure::Measure;
pub use run::{Progress, RunOptions, RunSummary, StageResult, run};
pub use setup::{Prepared, StagePlan, prepare};
pub use stage::Ending;
