//! Checkpoints: everything that a run is at an instant, as a file.

mod cell;
mod find;
mod groups;
mod keeper;
mod motion;
mod particles;
mod planes;
mod state;

use std::io::{self, Write};
use std::path::Path;

use pulvis_core::State;
use pulvis_io::IoError;
use pulvis_io::checkpoint::{self, CheckpointError};
use pulvis_io::table::SeriesPosition;
use serde::{Deserialize, Serialize};

use super::openings::OpeningsRecord;
use super::snapshots::BlockRecord;
use super::steady::Steady;
pub use find::{FindError, checkpoint_files, has_ended};
pub(super) use find::{Found, find, of_run};
pub(super) use keeper::{Keeper, Purpose};
pub(super) use motion::LedWall;
pub(super) use particles::read_particles;
pub use particles::scenario_from_text;
use state::StateRecord;

/// Where a run is that has come to its end.
const END_OF_RUN: &str = "end of the run";

/// The latest checkpoint of a run.
pub(super) const LATEST: &str = "checkpoint.pulvis";

/// The one before it.
pub(super) const PREVIOUS: &str = "checkpoint.previous.pulvis";

/// The state at the end of a stage.
pub(super) fn stage_file(stage: usize) -> String {
    format!("checkpoint.stage-{}.pulvis", stage + 1)
}

/// Whether a run may write a checkpoint of this name.
pub(super) fn is_checkpoint(name: &str) -> bool {
    let number = || name.strip_prefix("checkpoint.stage-")?.strip_suffix(".pulvis");
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let is_stage = || number().is_some_and(is_number);
    [LATEST, PREVIOUS].contains(&name) || is_stage()
}

/// Everything that a run is at an instant.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Checkpoint {
    /// The resolved scenario.
    pub(super) scenario: String,
    /// The runs that this one has branched from, the oldest first.
    pub(super) ancestors: Vec<Ancestor>,
    pub(super) run: RunRecord,
    state: StateRecord,
}

/// A run that another one has branched from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Ancestor {
    /// Its resolved scenario.
    pub(super) scenario: String,
    /// The stage that it was in.
    pub(super) stage: u32,
    /// Whether that stage had ended.
    pub(super) stage_ended: bool,
    /// The walls that a program had in hand.
    pub(super) led_walls: Vec<LedWall>,
}

/// Where a run is in its protocol, and what it has written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct RunRecord {
    /// The stages that have ended.
    pub(super) results: Vec<ResultRecord>,
    /// The stage that goes on, unless the last one that has begun has ended.
    pub(super) watch: Option<WatchRecord>,
    /// The update of the programs of that stage that holds.
    pub(super) update: u32,
    /// Whether all is done and drawn.
    pub(super) complete: bool,
    /// The time steps of all stages [s].
    pub(super) time_steps: Vec<f64>,
    /// How often rows and checkpoints at intervals have been due.
    pub(super) rows_due: u64,
    pub(super) checkpoints_due: u64,
    /// Reference lengths of dimensionless columns [m].
    pub(super) reference: Option<[Option<f64>; 3]>,
    /// What inlets and outlets have seen.
    pub(super) openings: OpeningsRecord,
    /// The walls that a program has in hand.
    pub(super) led_walls: Vec<LedWall>,
    /// Length and hash of the time series.
    pub(super) series: (u64, u64),
    /// How far the files of particles and contacts have come, block by block.
    pub(super) snapshots: Vec<BlockRecord>,
    /// The files of the run, in the order of its list.
    pub(super) files: Vec<String>,
}

/// What came of a stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct ResultRecord {
    pub(super) ending: u8,
    pub(super) time: f64,
    pub(super) steps: u64,
}

/// What the stop rules of a stage have seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct WatchRecord {
    pub(super) start_step: u64,
    pub(super) start_time: f64,
    pub(super) start_lengths: [Option<f64>; 3],
    pub(super) start_strain: [f64; 6],
    pub(super) calm_looks: u32,
    pub(super) last_stress: Option<f64>,
    pub(super) steady: Steady,
}

impl RunRecord {
    /// The stage that the run is in or has just ended.
    pub(super) fn stage(&self) -> usize {
        match self.watch {
            Some(_) => self.results.len(),
            None => self.results.len().saturating_sub(1),
        }
    }

    pub(super) fn series(&self) -> SeriesPosition {
        SeriesPosition { bytes: self.series.0, hash: self.series.1 }
    }
}

/// What people are told about a checkpoint.
#[derive(Clone, Debug)]
pub(super) struct Label<'a> {
    pub(super) version: &'a str,
    pub(super) title: Option<&'a str>,
    pub(super) stages: &'a [String],
}

impl Checkpoint {
    pub(super) fn new(scenario: String, ancestors: Vec<Ancestor>, run: RunRecord, state: State) -> Self {
        Self { scenario, ancestors, run, state: state.into() }
    }

    pub(super) fn step(&self) -> u64 {
        self.state.step
    }

    /// The state, taken out.
    pub(super) fn into_state(self) -> Result<State, &'static str> {
        self.state.try_into()
    }

    /// Lines of `key = value`, as TOML.
    fn header(&self, label: &Label<'_>) -> String {
        let Self { run, state, .. } = self;
        let stage = run.stage();
        let where_it_is = match (run.complete, run.watch.is_some()) {
            (true, _) => END_OF_RUN,
            (false, false) => "end of a stage",
            (false, true) => "in a stage",
        };
        let name = label.stages.get(stage).map_or("", String::as_str);
        format!(
            "program = {:?}\ntitle = {:?}\nwhere = \"{where_it_is}\"\nstage = {name:?}\nstage_number = {}\nstages = {}\nstep = {}\ntime_s = {:?}\nparticles = {}\nframes = {}\n",
            label.version,
            label.title.unwrap_or(""),
            stage + 1,
            label.stages.len(),
            state.step,
            state.time,
            state.particles.id.len(),
            run.snapshots.iter().map(BlockRecord::frames).max().unwrap_or(0),
        )
    }

    /// Writes the file; see [`checkpoint::write`].
    pub(super) fn write(
        &self,
        path: &Path,
        previous: Option<&Path>,
        label: &Label<'_>,
    ) -> Result<u64, IoError> {
        checkpoint::write(path, previous, &self.header(label), |out| {
            postcard::to_io(self, Out(out)).map(drop).map_err(io::Error::other)
        })
    }

    /// Reads a file.
    pub(super) fn read(path: &Path) -> Result<Self, CheckpointError> {
        let (_, contents) = checkpoint::read(path)?;
        // The checksum is right: whoever wrote this is not who reads it.
        postcard::from_bytes(&contents).map_err(|_| CheckpointError::Damaged)
    }
}

/// A writer behind a pointer.
struct Out<'a>(&'a mut dyn Write);

impl Write for Out<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}
