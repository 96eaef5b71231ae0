//! A run under way: what it writes when it ends, however it does.

use std::path::PathBuf;

use pulvis_io::checkpoint::write_text;

use super::Run;
use crate::protocol::averages::{self, AVERAGES, Average};
use crate::protocol::error::RunError;
use crate::protocol::explain::{ALARM, AlarmReport};
use crate::protocol::report::{self, Series};
use crate::protocol::run::{RunSummary, StageResult};

impl Run<'_> {
    /// Completes the files of a run that has failed, and shows the state in which it did, as far as that is possible:
    /// what failed is the error that counts.
    pub(super) fn salvage(&mut self, error: &RunError) {
        let (simulation, message) = (&self.simulation, error.to_string());
        let report = match error {
            RunError::Step { source, .. } => AlarmReport::new(simulation, source, &message),
            RunError::Inlet { .. } => AlarmReport::of_sound_state(simulation, &[], &message),
            _ => return,
        };
        let _ = self.output.file(ALARM).map(|file| write_text(&file, &report.to_text()));
        let _ = self.frame();
        let _ = self.writer.flush();
        let _ = self.draw();
    }

    fn draw(&mut self) -> Result<Vec<PathBuf>, RunError> {
        if !self.scenario.output.plots {
            return Ok(Vec::new());
        }
        let series = Series { measure: &self.measure, rows: self.rows.rows() };
        report::draw(self.scenario, &self.simulation, &series, self.pictures, &mut self.output)
    }

    /// Completes the files of a run that has ended or that the user has stopped.
    pub(super) fn finish(&mut self, interrupted: Option<StageResult>) -> Result<RunSummary, RunError> {
        self.writer.flush()?;
        self.snapshots.settle()?;
        let energy_error_max = self.rows.largest_error();
        let averages = self.averages()?;
        let pictures = self.draw()?;
        if interrupted.is_none() {
            self.end_checkpoint()?;
        }
        let can_be_resumed = interrupted.is_some() && self.keeper.plan().is_some();
        Ok(RunSummary {
            folder: self.output.path().to_owned(),
            stages: self.results.iter().cloned().chain(interrupted).collect(),
            particles: self.simulation.particles().len(),
            steps: self.simulation.steps(),
            steps_before: self.steps_before,
            wall_clock: self.began.elapsed().as_secs_f64(),
            energy_error: self.simulation.ledger().relative_error(),
            energy_error_max,
            averages,
            pictures,
            can_be_resumed,
        })
    }

    /// Writes the averages of what observers have seen.
    fn averages(&mut self) -> Result<Vec<Average>, RunError> {
        if self.scenario.observers.is_empty() {
            return Ok(Vec::new());
        }
        let averages = averages::averages(self.scenario, self.measure.columns(), self.rows.rows());
        averages::table(&averages)?.write(&self.output.file(AVERAGES)?)?;
        Ok(averages)
    }
}
