//! The runs of a study, and what its output folder holds of them already.

use super::StudyError;
use super::folder;
use crate::protocol::{RunState, run_state};
use pulvis_input::scenario::Scenario;
use pulvis_input::study::Study;
use std::path::{Path, PathBuf};

/// All runs of a study, point by point.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The output folder.
    pub folder: PathBuf,
    /// The runs.
    pub runs: Vec<PlannedRun>,
    /// Whether all runs begin anew.
    pub(super) anew: bool,
}

/// A run of a study.
#[derive(Clone, Debug)]
pub struct PlannedRun {
    /// The index of its point.
    pub point: usize,
    /// Its seed.
    pub seed: u64,
    /// What is run.
    pub scenario: Scenario,
    /// Its folder, relative to that of the study.
    pub folder: PathBuf,
    pub(super) state: RunState,
}

impl PlannedRun {
    /// Whether it is there already, to its end.
    pub fn is_complete(&self) -> bool {
        self.state == RunState::Complete
    }

    /// What will be done, in a word.
    pub fn state_in_words(&self) -> &'static str {
        match self.state {
            RunState::Fresh | RunState::Other => "to be run",
            RunState::Begun => "to go on",
            RunState::Complete => "complete",
        }
    }
}

impl Plan {
    /// Runs that are still to be carried out.
    pub fn missing(&self) -> usize {
        self.runs.iter().filter(|run| !run.is_complete()).count()
    }
}

/// Looks at the output folder of a study and touches nothing. With `force`, all runs are to begin anew.
///
/// # Errors
/// The folder holds something else than this study, or a run that is none of its own.
pub fn plan(study: &Study, output: &Path, force: bool, version: &str) -> Result<Plan, StudyError> {
    folder::look(output, &folder::names(study))?;
    let mut runs = Vec::with_capacity(study.points.len() * study.seeds.len());
    for (point, own) in study.points.iter().enumerate() {
        for &seed in &study.seeds {
            let mut scenario = own.scenario.clone();
            if scenario.seed != seed {
                scenario.seed = seed;
                scenario.source.replaced.push("seed".to_owned());
            }
            let folder = Path::new("runs").join(&own.name).join(format!("seed-{seed}"));
            let state = match run_state(&scenario, version, &output.join(&folder))? {
                RunState::Other if !force => {
                    return Err(StudyError::OtherRun { folder: output.join(folder) });
                }
                _ if force => RunState::Fresh,
                state => state,
            };
            runs.push(PlannedRun { point, seed, scenario, folder, state });
        }
    }
    Ok(Plan { folder: output.to_owned(), runs, anew: force })
}
