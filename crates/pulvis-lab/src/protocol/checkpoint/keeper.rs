//! When checkpoints are made, and who writes them.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use pulvis_input::scenario::{CheckpointPlan, Scenario};
use pulvis_io::IoError;
use pulvis_io::checkpoint::sync;

use super::{Checkpoint, LATEST, Label, PREVIOUS};

/// A state is taken for the case of an alarm after this time at the earliest, and after as many times the time that it takes.
const HOLD: Duration = Duration::from_secs(1);
const HOLD_COST: u32 = 50;

/// What a checkpoint is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::protocol) enum Purpose {
    /// To be written if an alarm ends the run.
    Hold,
    /// To be written while the run goes on.
    Write,
}

/// Holds the last state that was sound in memory, and writes checkpoints while the run goes on.
pub(in crate::protocol) struct Keeper {
    plan: Option<CheckpointPlan>,
    folder: PathBuf,
    names: Arc<Names>,
    written: Instant,
    held: Instant,
    cost: Duration,
    last: Option<Arc<Checkpoint>>,
    /// Whether the last one is in a file, or on its way.
    is_written: bool,
    writing: Option<JoinHandle<Result<(), IoError>>>,
}

/// What labels are made of.
#[derive(Debug)]
struct Names {
    version: String,
    title: Option<String>,
    stages: Vec<String>,
}

impl Names {
    fn label(&self) -> Label<'_> {
        Label { version: &self.version, title: self.title.as_deref(), stages: &self.stages }
    }
}

impl Keeper {
    pub(in crate::protocol) fn new(scenario: &Scenario, folder: &Path, version: &str) -> Self {
        let names = Names {
            version: version.to_owned(),
            title: scenario.title.clone(),
            stages: scenario.stages.iter().map(|stage| stage.name.clone()).collect(),
        };
        Self {
            plan: scenario.output.checkpoints,
            folder: folder.to_owned(),
            names: Arc::new(names),
            written: Instant::now(),
            held: Instant::now(),
            cost: Duration::ZERO,
            last: None,
            is_written: true,
            writing: None,
        }
    }

    /// When states are written; `None` where nobody wants them.
    pub(in crate::protocol) fn plan(&self) -> Option<CheckpointPlan> {
        self.plan
    }

    /// Whether a checkpoint is to be taken now.
    ///
    /// # Errors
    /// The last one could not be written.
    pub(in crate::protocol) fn due(&mut self) -> Result<Option<Purpose>, IoError> {
        let Some(plan) = self.plan else { return Ok(None) };
        if self.writing.as_ref().is_some_and(JoinHandle::is_finished) {
            self.wait()?;
        }
        if self.writing.is_none() && self.written.elapsed().as_secs_f64() >= plan.wall_clock {
            return Ok(Some(Purpose::Write));
        }
        let due = self.held.elapsed() >= HOLD.max(self.cost * HOLD_COST);
        Ok(due.then_some(Purpose::Hold))
    }

    /// Takes a checkpoint, which took so long to make.
    pub(in crate::protocol) fn hold(&mut self, checkpoint: Checkpoint, cost: Duration) {
        (self.last, self.is_written) = (Some(Arc::new(checkpoint)), false);
        (self.held, self.cost) = (Instant::now(), cost);
    }

    /// Writes the one that is held, while the run goes on. `files` belong to it and are handed to the disk first.
    ///
    /// # Errors
    /// The one before could not be written.
    pub(in crate::protocol) fn write_meanwhile(&mut self, files: Vec<PathBuf>) -> Result<(), IoError> {
        self.wait()?;
        let Some(checkpoint) = self.last.clone() else { return Ok(()) };
        let (path, previous) = (self.folder.join(LATEST), self.folder.join(PREVIOUS));
        let names = Arc::clone(&self.names);
        let write = move || {
            sync(&files)?;
            checkpoint.write(&path, Some(&previous), &names.label()).map(drop)
        };
        self.is_written = true;
        self.written = Instant::now();
        match std::thread::Builder::new().name("checkpoint".to_owned()).spawn(write) {
            Ok(thread) => self.writing = Some(thread),
            // No thread to be had: the run waits.
            Err(_) => self.write_now(None)?,
        }
        Ok(())
    }

    /// Writes the one that is held, into a file of its own where a name is given.
    ///
    /// # Errors
    /// It, or the one before, could not be written.
    pub(in crate::protocol) fn write_now(&mut self, name: Option<&str>) -> Result<(), IoError> {
        self.wait()?;
        let Some(checkpoint) = &self.last else { return Ok(()) };
        let path = self.folder.join(name.unwrap_or(LATEST));
        let previous = self.folder.join(PREVIOUS);
        checkpoint.write(&path, name.is_none().then_some(&previous), &self.names.label())?;
        if name.is_none() {
            (self.is_written, self.written) = (true, Instant::now());
        }
        Ok(())
    }

    /// Waits for the one that is being written.
    fn wait(&mut self) -> Result<(), IoError> {
        match self.writing.take().map(JoinHandle::join) {
            Some(Ok(result)) => result,
            // A panic of the writer is a bug, and has been told; the run has what it had before.
            Some(Err(_)) | None => Ok(()),
        }
    }

    /// Writes what is held when the run has failed; answers with the step of the latest checkpoint then.
    pub(in crate::protocol) fn rescue(&mut self) -> Option<u64> {
        let written = self.wait().and_then(|()| if self.is_written { Ok(()) } else { self.write_now(None) });
        written.ok().and(self.last.as_ref()).map(|checkpoint| checkpoint.step())
    }

    /// Writes the last checkpoint of a run that is complete; nobody needs the one before any more.
    ///
    /// # Errors
    /// It could not be written.
    pub(in crate::protocol) fn complete(&mut self) -> Result<(), IoError> {
        self.wait()?;
        // Before it is written, so that a run that has ended has none at whichever moment it is killed: until then the latest one
        // is whole. Where it cannot be removed it does no harm.
        let _ = std::fs::remove_file(self.folder.join(PREVIOUS));
        self.write_now(Some(LATEST))?;
        (self.is_written, self.written) = (true, Instant::now());
        Ok(())
    }
}
