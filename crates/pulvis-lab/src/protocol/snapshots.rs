//! Particles and contacts as files for other programs.

use std::path::Path;
use std::sync::Arc;

use pulvis_core::Simulation;
use pulvis_input::scenario::{Interval, Scenario, Snapshots as SnapshotPlan};
use pulvis_io::IoError;
use pulvis_io::frames::{self, FramePosition, FrameWriter, Precision, Series, Units};
use pulvis_io::table::SeriesPosition;
use serde::{Deserialize, Serialize};

use super::error::RunError;
use super::folder::OutputFolder;
use super::formats::units;
use super::frame::{Selection, selected_frame};
use super::outlines::bounds;
use super::pace::Due;
use super::pen::{Page, Pen};

/// The files that the key `vtk` asks for, and those of every block `[[output.files]]`.
pub(super) struct Snapshots<'a> {
    blocks: Vec<Block<'a>>,
    materials: Arc<[String]>,
}

/// Files of one format.
struct Block<'a> {
    pen: Pen,
    selection: Selection<'a>,
    /// When it is time, beside the starts and ends of stages.
    due: Option<Due>,
    last_step: Option<u64>,
}

/// What a run writes of particles and contacts: one block.
pub(super) struct Plan<'a> {
    pub(super) format: &'static str,
    pub(super) name: &'a str,
    every: Option<Interval>,
    precision: Precision,
    compressed: bool,
    pub(super) selection: Selection<'a>,
}

/// How far a block has come.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct BlockRecord {
    /// Instants that were written.
    frames: u64,
    /// Length and hash of each file that grows.
    files: Vec<(u64, u64)>,
    /// How often it was time.
    due: u64,
    /// The step of the last instant.
    last_step: Option<u64>,
}

impl BlockRecord {
    /// Instants that were written.
    pub(super) fn frames(&self) -> u64 {
        self.frames
    }
}

/// All blocks of a scenario.
pub(super) fn plans(scenario: &Scenario) -> Vec<Plan<'_>> {
    let of_runs = |every| Plan {
        format: "vtk",
        name: "",
        every,
        precision: Precision::Double,
        compressed: false,
        selection: Selection::default_of_runs(scenario),
    };
    let mut plans = match scenario.output.snapshots {
        SnapshotPlan::Never => Vec::new(),
        SnapshotPlan::StageEnds => vec![of_runs(None)],
        SnapshotPlan::Every(interval) => vec![of_runs(Some(interval))],
    };
    plans.extend(scenario.output.files.iter().map(|files| Plan {
        format: files.format.name(),
        name: &files.name,
        every: files.every,
        precision: if files.single_precision { Precision::Single } else { Precision::Double },
        compressed: files.compressed,
        selection: Selection::of(files, scenario),
    }));
    plans
}

fn materials(scenario: &Scenario) -> Arc<[String]> {
    scenario.materials.iter().map(|material| material.name.clone()).collect()
}

impl<'a> Snapshots<'a> {
    /// Before the first instant.
    pub(super) fn create(
        scenario: &'a Scenario,
        simulation: &Simulation,
        folder: &Path,
    ) -> Result<Self, IoError> {
        let mut blocks = Vec::new();
        for plan in plans(scenario) {
            let pen = Pen::new(open(&plan, scenario, folder, None)?);
            let due = plan.every.map(|every| Due::from_now(every, simulation));
            blocks.push(Block { pen, selection: plan.selection, due, last_step: None });
        }
        Ok(Self { blocks, materials: materials(scenario) })
    }

    /// Goes on with the files of an interrupted run.
    pub(super) fn resume(
        scenario: &'a Scenario,
        folder: &Path,
        records: &[BlockRecord],
    ) -> Result<Self, IoError> {
        let mut blocks = Vec::new();
        for (plan, record) in plans(scenario).into_iter().zip(records) {
            let files = record.files.iter().map(|&(bytes, hash)| SeriesPosition { bytes, hash });
            let position = FramePosition { frames: record.frames, files: files.collect() };
            let pen = Pen::new(open(&plan, scenario, folder, Some(&position))?);
            let due = plan.every.map(|every| Due::resume(every, record.due));
            blocks.push(Block { pen, selection: plan.selection, due, last_step: record.last_step });
        }
        Ok(Self { blocks, materials: materials(scenario) })
    }

    /// Waits until all that has been asked for is written.
    ///
    /// # Errors
    /// A file cannot be written.
    pub(super) fn settle(&mut self) -> Result<(), IoError> {
        self.blocks.iter_mut().try_for_each(|block| block.pen.settle())
    }

    /// How far all blocks have come; waits until what they write is written.
    pub(super) fn record(&mut self) -> Result<Vec<BlockRecord>, IoError> {
        let Self { blocks, materials: _ } = self;
        let record = |block: &mut Block<'_>| {
            let Block { pen, selection: _, due, last_step } = block;
            let FramePosition { frames, files } = pen.position()?;
            let files = files.into_iter().map(|SeriesPosition { bytes, hash }| (bytes, hash)).collect();
            let due = due.as_ref().map_or(0, Due::count);
            Ok(BlockRecord { frames, files, due, last_step: *last_step })
        };
        blocks.iter_mut().map(record).collect()
    }

    /// Names of the files that every instant changes.
    pub(super) fn growing(&self) -> Vec<String> {
        self.blocks.iter().flat_map(|block| block.pen.growing().iter().cloned()).collect()
    }

    /// When it is time for something.
    pub(super) fn due(&self) -> impl Iterator<Item = &Due> {
        self.blocks.iter().filter_map(|block| block.due.as_ref())
    }

    /// Writes the present state to all blocks, unless it has just been written.
    pub(super) fn write_all(
        &mut self,
        scenario: &Scenario,
        simulation: &Simulation,
        output: &mut OutputFolder,
    ) -> Result<(), RunError> {
        let Self { blocks, materials } = self;
        blocks.iter_mut().try_for_each(|block| block.write(scenario, simulation, materials, output))
    }

    /// Writes the present state to those blocks whose time it is, and tells what has gone wrong with earlier ones.
    pub(super) fn write_due(
        &mut self,
        scenario: &Scenario,
        simulation: &Simulation,
        output: &mut OutputFolder,
    ) -> Result<(), RunError> {
        let Self { blocks, materials } = self;
        for block in blocks {
            block.pen.look()?;
            if block.due.as_mut().is_some_and(|due| due.now(simulation)) {
                block.write(scenario, simulation, materials, output)?;
            }
        }
        Ok(())
    }
}

impl Block<'_> {
    fn write(
        &mut self,
        scenario: &Scenario,
        simulation: &Simulation,
        materials: &Arc<[String]>,
        output: &mut OutputFolder,
    ) -> Result<(), RunError> {
        if self.last_step == Some(simulation.steps()) {
            return Ok(());
        }
        self.last_step = Some(simulation.steps());
        self.pen.settle()?;
        let frame = selected_frame(scenario, simulation, &self.selection);
        let (time, step, bounds) = (simulation.time(), simulation.steps(), bounds(scenario, simulation));
        let page = Page { time, step, bounds, materials: Arc::clone(materials), frame };
        for name in self.pen.next_files(&page) {
            output.file(&name)?;
        }
        Ok(self.pen.write(page)?)
    }
}

/// The writer of a block.
fn open(
    plan: &Plan<'_>,
    scenario: &Scenario,
    folder: &Path,
    resume: Option<&FramePosition>,
) -> Result<Box<dyn FrameWriter>, IoError> {
    let (name, precision, contacts) = (plan.name, plan.precision, plan.selection.has_contacts());
    let [of_particles, of_contacts] = units(scenario, &plan.selection);
    (frames::format(plan.format)?.open)(&Series {
        folder,
        name,
        precision,
        compressed: plan.compressed,
        contacts,
        units: Units { particles: &of_particles, contacts: &of_contacts },
        resume,
    })
}
