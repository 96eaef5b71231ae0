//! Bulk experiments: a scenario's stages, run one after another.
//!
//! [`prepare`] turns a scenario into a simulation and refuses what only its particles can tell;
//! [`preflight`] says what a run will be like; [`run`] does it and writes its files; [`resume`] goes on with an interrupted one.

mod check;
mod checkpoint;
mod clusters;
mod disk;
mod error;
mod feasible;
mod folder;
mod fracture;
mod measure;
mod memory;
mod pace;
mod packed;
mod packing_picture;
mod particles;
mod refusal;
mod report;
mod resources;
mod run;
mod setup;
mod snapshots;
mod stage;
mod start;
mod timing;
mod under_way;
mod warnings;

pub use check::{ContactForecast, Preflight, StageForecast, Sticking, preflight};
pub use checkpoint::{FindError, checkpoint_files, has_ended};
pub use disk::DiskForecast;
pub use error::{PrepareError, RunError};
pub use measure::{Measure, column_names};
pub use memory::{MemoryForecast, memory_forecast};
pub use run::{Progress, RunOptions, RunSummary, StageResult, resume, run};
pub use setup::{Prepared, StagePlan, prepare};
pub use stage::Ending;
pub use start::load_scenario;
pub use warnings::warnings;
