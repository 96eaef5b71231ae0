//! Files of a simulation that a program leads: checkpoints, instants for other programs, pictures.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use pulvis_input::scenario::{FileFormat, OutputFiles};
use pulvis_io::frames::{self, FrameWriter, Instant, Precision, Series, Units};

use super::Session;
use crate::protocol::checkpoint::{
    Checkpoint, FindError, Label, LedWall, RunRecord, find, scenario_from_text,
};
use crate::protocol::error::{PrepareError, RunError};
use crate::protocol::formats::units;
use crate::protocol::frame::{Selection, frame_of, selected_frame};
use crate::protocol::measure::Measure;
use crate::protocol::openings::Openings;
use crate::protocol::outlines::bounds;
use crate::protocol::programs::models_after;
use crate::protocol::run::StageResult;
use crate::protocol::start::{Resumed, resumed};
use crate::rendering::default_picture;

/// The files that instants have been written to.
#[derive(Debug, Default)]
pub(super) struct Outputs(Vec<Output>);

#[derive(Debug)]
struct Output {
    folder: PathBuf,
    format: &'static str,
    contacts: bool,
    /// In a lock, so that a session may be looked at by several threads.
    writer: Mutex<Box<dyn FrameWriter>>,
}

impl Session {
    /// Goes on from a checkpoint: of a session, or of a run. Forces that a program has applied act on, and walls that it has
    /// taken in hand move as it has said.
    ///
    /// # Errors
    /// There is no checkpoint at the path, or it cannot be used.
    pub fn resume(path: &Path) -> Result<Self, RunError> {
        let found = find(path).map_err(PrepareError::from)?.ok_or_else(|| FindError::None(path.to_owned()));
        let found = found.map_err(PrepareError::from)?;
        let scenario = scenario_from_text(&path.display().to_string(), &found.checkpoint.scenario)
            .map_err(PrepareError::from)?;
        let Resumed { simulation, plans, ancestors, record, results } = resumed(&scenario, found)?;
        let update = record.update as usize;
        let interactions = models_after(&scenario, &scenario.stages[record.stage()], update);
        let mut measure = Measure::new(&scenario, &simulation);
        measure.resume(record.reference);
        let start_lengths = record.watch.as_ref().map_or([None; 3], |watch| watch.start_lengths);
        let led_walls = record.led_walls.iter().map(LedWall::place).collect();
        let mut session = Self {
            measure,
            openings: Openings::new(&scenario, Some(&record.openings)),
            interactions,
            update,
            walls_arrive: true,
            plans,
            results,
            watch: record.watch,
            start_lengths,
            first_step: simulation.steps(),
            warnings: Vec::new(),
            broken: false,
            ancestors,
            led_walls,
            outputs: Outputs::default(),
            simulation,
            scenario,
        };
        session.set_threads(None)?;
        Ok(session)
    }

    /// Writes everything that the session is into a file, for [`resume`](Self::resume) and for the key `start_from` of
    /// scenarios. `version` is that of the program.
    ///
    /// # Errors
    /// The file cannot be written, no step was taken yet, or the session has failed.
    pub fn checkpoint(&self, path: &Path, version: &str) -> Result<(), RunError> {
        if self.broken {
            return Err(RunError::Broken);
        }
        if self.watch.is_none() && self.results.is_empty() {
            return Err(RunError::NotBegun);
        }
        let walls = self.simulation.walls();
        let led = |&place: &usize| Some(LedWall::of(place, walls.get(place)?));
        let run = RunRecord {
            results: self.results.iter().map(StageResult::record).collect(),
            watch: self.watch.clone(),
            update: self.update as u32,
            complete: self.is_over(),
            time_steps: self.plans.iter().map(|plan| plan.time_step).collect(),
            rows_due: 0,
            checkpoints_due: 0,
            reference: self.measure.reference(),
            openings: self.openings.record(),
            led_walls: self.led_walls.iter().filter_map(led).collect(),
            // A session has no files of its own.
            series: (0, 0),
            snapshots: Vec::new(),
            files: Vec::new(),
        };
        let resolved = self.scenario.to_resolved_toml(version);
        let checkpoint =
            Checkpoint::new(resolved, self.ancestors.clone(), run, self.simulation.export_state());
        let stages: Vec<String> = self.scenario.stages.iter().map(|stage| stage.name.clone()).collect();
        let label = Label { version, title: self.scenario.title.as_deref(), stages: &stages };
        checkpoint.write(path, None, &label)?;
        Ok(())
    }

    /// Writes the present instant into a folder, in a format of runs; later instants of the same folder and format go on with
    /// the same files or have the next numbers.
    ///
    /// # Errors
    /// There is no such format, or a file cannot be written.
    pub fn write_instant(&mut self, folder: &Path, format: &str, contacts: bool) -> Result<(), RunError> {
        let format = frames::format(format)?;
        let failed = |source| RunError::File { file: folder.to_owned(), source };
        std::fs::create_dir_all(folder).map_err(failed)?;
        let [particles, of_contacts] = units(&self.scenario, &Selection::default_of_runs(&self.scenario));
        let outputs = &mut self.outputs.0;
        let known = |output: &Output| {
            (output.folder.as_path(), output.format, output.contacts) == (folder, format.name, contacts)
        };
        let index = match outputs.iter().position(known) {
            Some(index) => index,
            None => {
                let precision = Precision::Double;
                let writer = (format.open)(&Series {
                    folder,
                    // As files of runs: `[output]` has no prefix for VTK, and a block of other files begins with its name.
                    name: if format.name == FileFormat::Vtk.name() { "" } else { OutputFiles::DEFAULT_NAME },
                    precision,
                    compressed: false,
                    contacts,
                    units: Units { particles: &particles, contacts: &of_contacts },
                    resume: None,
                })?;
                let writer = Mutex::new(writer);
                outputs.push(Output { folder: folder.to_owned(), format: format.name, contacts, writer });
                outputs.len() - 1
            }
        };
        let (scenario, simulation) = (&self.scenario, &self.simulation);
        let selection = Selection::default_of_runs(scenario);
        let selection = if contacts { selection } else { selection.without_contacts() };
        let materials: Vec<String> =
            scenario.materials.iter().map(|material| material.name.clone()).collect();
        let frame = selected_frame(scenario, simulation, &selection);
        let (time, step) = (simulation.time(), simulation.steps());
        let bounds = bounds(scenario, simulation);
        let writer = outputs[index].writer.get_mut().unwrap_or_else(PoisonError::into_inner);
        writer.write(&Instant { time, step, bounds, materials: &materials, frame: &frame })?;
        // What is written is there for others, also in files that grow.
        writer.position()?;
        Ok(())
    }

    /// Draws the particles into a file, as runs do it at their end.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_picture(&self, path: &Path, dots_per_inch: u32) -> Result<(), RunError> {
        let (scenario, simulation) = (&self.scenario, &self.simulation);
        let frame = frame_of(scenario, simulation);
        let picture = default_picture(scenario, &frame, simulation.time(), dots_per_inch);
        picture.map_err(Box::new)?.write(path)?;
        Ok(())
    }
}
