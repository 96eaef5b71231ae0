//! `status.json`: the sign of life of a run.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use pulvis_io::checkpoint::write_text;
use serde::{Deserialize, Serialize};

use super::{ProgressRecord, RunPhase};
use crate::protocol::run::Progress;

/// The file. It is the one file of a run that holds times of a clock, and has other bytes each time.
pub(in crate::protocol) const STATUS: &str = "status.json";

/// How often a run gives a sign of life, if nothing else happens.
const EVERY: Duration = Duration::from_secs(1);

/// What the file holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Told {
    /// The version of the program.
    version: String,
    pub(super) process: u32,
    pub(super) state: RunPhase,
    pub(super) message: Option<String>,
    /// When the process began, and when it last gave a sign of life [s since 1970].
    pub(super) began: f64,
    pub(super) updated: f64,
    pub(super) progress: Option<ProgressRecord>,
}

/// Writes the file.
#[derive(Debug)]
pub(in crate::protocol) struct StatusFile {
    path: PathBuf,
    told: Told,
    last: Option<Instant>,
}

impl StatusFile {
    /// The sign of life of a run that begins or goes on.
    pub(in crate::protocol) fn begin(path: PathBuf, version: &str) -> Self {
        let told = Told {
            version: version.to_owned(),
            process: std::process::id(),
            state: RunPhase::Running,
            message: None,
            began: now(),
            updated: now(),
            progress: None,
        };
        let mut file = Self { path, told, last: None };
        file.write();
        file
    }

    /// Tells how far the run has come, once a second and at the end of each stage.
    pub(in crate::protocol) fn tell(&mut self, progress: &Progress) {
        let is_due = self.last.is_none_or(|last| last.elapsed() >= EVERY) || progress.ending.is_some();
        if is_due {
            self.told.progress = Some(ProgressRecord::new(progress));
            self.write();
        }
    }

    /// Tells how the run has ended.
    pub(in crate::protocol) fn end(&mut self, state: RunPhase, message: Option<String>) {
        (self.told.state, self.told.message) = (state, message);
        self.write();
    }

    fn write(&mut self) {
        self.told.updated = now();
        self.last = Some(Instant::now());
        // Names and numbers: this cannot fail. A run is not stopped for its sign of life; a full disk shows elsewhere.
        if let Ok(text) = serde_json::to_string_pretty(&self.told) {
            let _ = write_text(&self.path, &(text + "\n"));
        }
    }
}

/// What stands in the file; `None` where there is none, or something else.
pub(super) fn read(path: &Path) -> Option<Told> {
    serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()
}

/// The time of the clock [s since 1970].
pub(super) fn now() -> f64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0.0, |time| time.as_secs_f64())
}
