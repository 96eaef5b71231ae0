//! Bulk experiments: a scenario's stages, run one after another.
//!
//! [`prepare`] turns a scenario into a simulation and refuses what only its particles can tell;
//! [`preflight`] says what a run will be like; [`run`] does it and writes its files; [`resume`] goes on with an interrupted one.
//! A [`Session`] takes the same steps in the hands of a program, without files.

mod allow;
mod averages;
mod cell;
mod check;
mod checkpoint;
mod clusters;
mod damping;
mod disk;
mod error;
mod explain;
mod feasible;
mod fields;
mod folder;
mod fracture;
mod frame;
mod kept_rows;
mod lock;
mod measure;
mod memory;
mod observers;
mod outlines;
mod pace;
mod packed;
mod particle_sums;
mod particles;
mod refusal;
mod report;
mod resources;
mod run;
mod session;
mod setup;
mod snapshots;
mod stage;
mod start;
mod state;
mod switch;
mod timing;
mod typical;
mod under_way;
mod warnings;

pub use averages::Average;
pub(crate) use check::stages;
pub use check::{ContactForecast, Preflight, StageForecast, Sticking, preflight};
pub use checkpoint::{FindError, checkpoint_files, has_ended};
pub use disk::DiskForecast;
pub use error::{PrepareError, RunError};
pub use explain::{Explanation, explain};
pub(crate) use folder::{RECORD, clear};
pub(crate) use lock::{LOCK, Lock, lock};
pub use measure::{Measure, column_names};
pub use memory::{MemoryForecast, memory_forecast};
pub use resources::size_in_words;
pub(crate) use run::threads_for;
pub use run::{PictureOptions, Progress, RunOptions, RunSummary, StageResult, resume, run};
pub use session::{Advance, Session};
pub use setup::{Prepared, StagePlan, prepare};
pub use stage::Ending;
pub(crate) use start::frame_of_checkpoint;
pub(crate) use start::start_alike;
pub use start::{load_document, load_scenario, read_scenario};
pub(crate) use state::{RunState, run_state};
pub use warnings::warnings;
