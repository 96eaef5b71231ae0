//! How far the run in a folder has come.

use std::path::Path;

use pulvis_input::scenario::Scenario;

use super::checkpoint::has_ended;
use super::error::PrepareError;
use super::folder::{RECORD, look};

/// What a folder holds of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RunState {
    /// Nothing, or what a run has left that was killed before it had written its record.
    Fresh,
    /// A run of this very scenario that has not ended.
    Begun,
    /// A run of this very scenario, by this version, to its end.
    Complete,
    /// A run of another scenario, or by another version.
    Other,
}

/// What `folder` holds of the run of a scenario by this `version`.
///
/// # Errors
/// It holds something that is no run, or cannot be read.
pub(crate) fn run_state(scenario: &Scenario, version: &str, folder: &Path) -> Result<RunState, PrepareError> {
    let Ok(record) = std::fs::read_to_string(folder.join(RECORD)) else {
        return look(folder, true).map(|_| RunState::Fresh);
    };
    Ok(match (record == scenario.to_resolved_toml(version), has_ended(folder)) {
        (false, _) => look(folder, true).map(|_| RunState::Other)?,
        (true, false) => RunState::Begun,
        (true, true) => RunState::Complete,
    })
}
