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
    let resolved = scenario.to_resolved_toml(version);
    Ok(match (essence(&record).eq(essence(&resolved)), has_ended(folder)) {
        (false, _) => look(folder, true).map(|_| RunState::Other)?,
        (true, false) => RunState::Begun,
        (true, true) => RunState::Complete,
    })
}

/// The version and the keys of a record, without the remarks on the file that they come from: that may be called by another
/// path.
fn essence(record: &str) -> impl Iterator<Item = &str> {
    record
        .lines()
        .enumerate()
        .filter(|(number, line)| *number == 0 || !line.starts_with('#'))
        .map(|(_, line)| line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_of_the_scenario_is_not_part_of_a_run_but_version_and_keys_are() {
        let record = |version: &str, path: &str, seed: u32| {
            format!("# Pulvis {version}\n# resolved from {path} with seed {seed}\nseed = {seed}\n")
        };
        let first = record("1", "a/s.toml", 3);
        let same = |other: &str| essence(&first).eq(essence(other));
        assert!(same(&record("1", "s.toml", 3)));
        assert!(!same(&record("2", "a/s.toml", 3)) && !same(&record("1", "a/s.toml", 4)));
        assert!(!same("# Pulvis 1\n"));
    }
}
