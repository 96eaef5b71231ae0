//! Particles and contacts as files for ParaView and OVITO.

use std::path::Path;

use super::error::RunError;
use super::folder::OutputFolder;
use super::frame::frame_of;
use pulvis_core::Simulation;
use pulvis_input::scenario::Scenario;
use pulvis_io::IoError;
use pulvis_io::vtk::SeriesWriter;

/// Writes one frame after another into a folder.
pub(super) struct Snapshots {
    series: SeriesWriter,
    last_step: Option<u64>,
}

impl Snapshots {
    pub(super) fn create(folder: &Path) -> Result<Self, IoError> {
        Ok(Self { series: SeriesWriter::create(folder, "")?, last_step: None })
    }

    /// Goes on with the frames of an interrupted run, of which the last was of `last_step`.
    pub(super) fn resume(folder: &Path, frames: u64, last_step: Option<u64>) -> Result<Self, IoError> {
        Ok(Self { series: SeriesWriter::resume(folder, "", frames as usize)?, last_step })
    }

    /// Number of frames, and the step of the last one.
    pub(super) fn position(&self) -> (u64, Option<u64>) {
        let Self { series, last_step } = self;
        (series.frames() as u64, *last_step)
    }

    /// Writes the present state, unless it has just been written.
    pub(super) fn write(
        &mut self,
        scenario: &Scenario,
        simulation: &Simulation,
        output: &mut OutputFolder,
    ) -> Result<(), RunError> {
        if self.last_step == Some(simulation.steps()) {
            return Ok(());
        }
        self.last_step = Some(simulation.steps());
        let frame = frame_of(scenario, simulation);
        for name in self.series.next_files() {
            output.file(&name)?;
        }
        self.series.write_frame(simulation.time(), &frame)?;
        Ok(())
    }
}
