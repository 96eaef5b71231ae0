//! How far the run in a folder has come, told from its files: by `pulvis status`, from another shell than that of the run.

mod file;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

pub(super) use file::{STATUS, StatusFile};

use super::checkpoint::{checkpoint_files, has_ended};
use super::error::PrepareError;
use super::explain::alarm_message;
use super::folder::RECORD;
use super::lock::{is_locked, process_of};
use super::run::Progress;

/// What a run is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum RunPhase {
    /// Its process computes.
    Running,
    /// It has come to its end.
    Complete,
    /// The user has stopped it.
    Interrupted,
    /// Something that cannot be right has stopped it.
    Failed,
    /// Its process has ended without a word: killed, or the machine went down.
    Killed,
    /// It has not ended, and nobody can tell from here whether its process lives: the file system knows no locks.
    Unknown,
}

impl RunPhase {
    /// The phase in a word.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::Complete => "complete",
            Self::Interrupted => "interrupted",
            Self::Failed => "failed",
            Self::Killed => "killed",
            Self::Unknown => "unknown",
        }
    }
}

/// How far a run has come, as files and log lines tell it. Numbers that are not finite are `null` in JSON.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgressRecord {
    /// Name of the stage.
    pub stage: String,
    /// Number of the stage, from 1.
    pub number: usize,
    /// Number of stages.
    pub stages: usize,
    /// Simulated time \[s\].
    pub time: f64,
    /// Steps done.
    pub step: u64,
    /// Particles that are there.
    pub particles: usize,
    /// Steps per second of wall-clock time.
    pub steps_per_second: Option<f64>,
    /// The same times the number of particles.
    pub particle_steps_per_second: Option<f64>,
    /// Share of the stage that is done, from 0 to 1, where its duration is known.
    pub fraction: Option<f64>,
    /// Wall-clock time that the stage still needs \[s\], where its duration is known.
    pub remaining: Option<f64>,
    /// Relative closing error of the energy ledger \[1\].
    pub energy_error: Option<f64>,
    /// Why the stage has ended, if it has.
    pub ending: Option<String>,
}

impl ProgressRecord {
    /// What is told of a progress.
    pub fn new(progress: &Progress) -> Self {
        let Progress {
            stage,
            number,
            stages,
            time,
            steps,
            particles,
            steps_per_second,
            fraction,
            remaining,
            energy_error,
            ending,
        } = progress;
        let finite = |value: f64| value.is_finite().then_some(value);
        Self {
            stage: stage.clone(),
            number: *number,
            stages: *stages,
            time: *time,
            step: *steps,
            particles: *particles,
            steps_per_second: finite(*steps_per_second),
            particle_steps_per_second: finite(steps_per_second * *particles as f64),
            fraction: *fraction,
            remaining: *remaining,
            energy_error: finite(*energy_error),
            ending: ending.map(|ending| ending.text().to_owned()),
        }
    }

    /// One line of JSON.
    pub fn to_json(&self) -> String {
        // Names and finite numbers only: this cannot fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// The state of the run in a folder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunStatus {
    /// What it is doing.
    pub state: RunPhase,
    /// The number of its process, while that runs.
    pub process: Option<u32>,
    /// How far it has come, where it has told.
    pub progress: Option<ProgressRecord>,
    /// Wall-clock time from the start of its process to its last sign of life \[s\].
    pub wall_clock: Option<f64>,
    /// Time since its last sign of life \[s\].
    pub silent: Option<f64>,
    /// What has stopped it.
    pub message: Option<String>,
    /// Its latest checkpoint.
    pub checkpoint: Option<PathBuf>,
}

impl RunStatus {
    /// As JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

/// How far the run in a folder has come. Nothing is changed.
///
/// # Errors
/// There is no run.
pub fn run_status(folder: &Path) -> Result<RunStatus, PrepareError> {
    if !folder.join(RECORD).is_file() {
        return Err(PrepareError::NoStatus { folder: folder.to_owned() });
    }
    let told = file::read(&folder.join(STATUS));
    let locked = is_locked(folder);
    let state = match (told.as_ref().map(|told| told.state), locked) {
        (_, Some(true)) => RunPhase::Running,
        (Some(RunPhase::Running), Some(false)) => RunPhase::Killed,
        (Some(RunPhase::Running), None) => RunPhase::Unknown,
        (Some(ended), _) => ended,
        // A run of an older version, or one whose status could not be written.
        (None, _) if has_ended(folder) => RunPhase::Complete,
        (None, _) if alarm_message(folder).is_some() => RunPhase::Failed,
        (None, Some(false)) => RunPhase::Interrupted,
        (None, None) => RunPhase::Unknown,
    };
    let is_running = state == RunPhase::Running;
    let message = match state {
        RunPhase::Failed => {
            told.as_ref().and_then(|told| told.message.clone()).or_else(|| alarm_message(folder))
        }
        _ => None,
    };
    Ok(RunStatus {
        state,
        process: process_of(folder).or_else(|| told.as_ref().map(|told| told.process)).filter(|_| is_running),
        wall_clock: told.as_ref().map(|told| told.updated - told.began),
        silent: told.as_ref().map(|told| (file::now() - told.updated).max(0.0)),
        progress: told.and_then(|told| told.progress),
        message,
        checkpoint: checkpoint_files(folder).into_iter().next(),
    })
}
