//! The room that the files of a run take.

use std::path::Path;

use pulvis_input::Problem;
use pulvis_input::scenario::{
    ContactFields, DEFAULT_CONTACT_FIELDS, DEFAULT_PARTICLE_FIELDS, FileFormat, Interval, OutputFiles,
    Refusal, Scenario, Snapshots,
};

use super::allow::refuse_unless_allowed;
use super::check::StageForecast;
use super::error::PrepareError;
use super::fields::component_count;
use super::resources::{free_disk_space, size_in_words};

/// Bytes of a number in the time series, on the average.
const NUMBER: f64 = 18.0;

/// Bytes of a particle in a frame: position, velocity, angular velocity, force, torque, radius, id, type,
/// coordination and two numbers of its cell, eight bytes each and a third more as text.
const PARTICLE: f64 = 4.0 / 3.0 * 8.0 * (5.0 * 3.0 + 4.0 + 2.0);

/// Bytes of a contact in a frame: two ends, force, two ids, normal force, overlap, memory and three numbers of
/// its cell.
const CONTACT: f64 = 4.0 / 3.0 * 8.0 * (3.0 * 3.0 + 5.0 + 3.0);

/// Bytes of a particle in a checkpoint, compressed: 236 in a lattice with three contacts a particle, which remember an
/// overlap and a spring.
const STATE: f64 = 240.0;

/// Contacts of a particle in a packing, half of the coordination.
const CONTACTS: f64 = 3.5;

/// What the files of a run take.
#[derive(Clone, Copy, Debug)]
pub struct DiskForecast {
    /// The time series [byte].
    pub timeseries: f64,
    /// All frames [byte].
    pub snapshots: f64,
    /// One frame [byte].
    pub frame: f64,
    /// Number of frames.
    pub frames: f64,
    /// All files of `[[output.files]]` [byte].
    pub files: f64,
    /// All checkpoints that are kept, and one that is being written [byte].
    pub checkpoints: f64,
    /// Room that is left [byte]; `None` where the system does not say.
    pub free: Option<u64>,
}

impl DiskForecast {
    /// All files [byte].
    pub fn total(&self) -> f64 {
        self.timeseries + self.snapshots + self.files + self.checkpoints
    }
}

/// Estimates the files of a run, as long as its stages are known to take, with the contacts of a packing.
pub(super) fn disk_forecast(
    scenario: &Scenario,
    folder: &Path,
    particles: usize,
    columns: usize,
    stages: &[StageForecast],
) -> DiskForecast {
    let rows: f64 = stages.iter().map(|stage| 2.0 + stage.count(scenario.output.timeseries)).sum();
    let frames: f64 = match scenario.output.snapshots {
        Snapshots::Never => 0.0,
        Snapshots::StageEnds => 1.0 + stages.len() as f64,
        Snapshots::Every(interval) => {
            1.0 + stages.iter().map(|stage| 1.0 + stage.count(interval)).sum::<f64>()
        }
    };
    let frame = particles as f64 * (PARTICLE + CONTACTS * CONTACT);
    DiskForecast {
        timeseries: rows * columns as f64 * NUMBER,
        snapshots: frames * frame,
        frame,
        frames,
        files: scenario.output.files.iter().map(|files| further(files, particles, stages)).sum(),
        checkpoints: checkpoints(scenario) * particles as f64 * STATE,
        free: free_disk_space(folder),
    }
}

/// Refuses a run whose files certainly take more room than there is in the folder's disk.
pub(super) fn refuse_full_disk(
    scenario: &Scenario,
    folder: &Path,
    particles: usize,
    columns: usize,
    stages: &[StageForecast],
) -> Result<(), PrepareError> {
    let shortest: Vec<StageForecast> = stages
        .iter()
        .map(|stage| StageForecast { steps: Some(stage.least_steps), ..stage.clone() })
        .collect();
    let least = disk_forecast(scenario, folder, particles, columns, &shortest);
    let Some(free) = least.free.filter(|free| least.total() > *free as f64) else { return Ok(()) };
    let found = format!(
        "the files take {} at least, and {} are free at {}",
        size_in_words(least.total() as u64),
        size_in_words(free),
        folder.display()
    );
    let paths = if least.files > least.snapshots.max(least.timeseries) {
        ["output.files", "output"]
    } else if least.snapshots > least.timeseries {
        ["output.vtk", "output"]
    } else {
        ["output.timeseries", "output"]
    };
    let problem = Problem::rule(found, "files that fit onto the disk");
    let help = "write less often, or choose a folder on another disk with `--output DIR`";
    refuse_unless_allowed(scenario, Refusal::Disk, &[paths[0], paths[1], "stages[0]"], problem, help)
}

/// The components of fields together.
fn components<'a>(fields: impl Iterator<Item = &'a str>) -> f64 {
    fields.map(component_count).sum::<usize>() as f64
}

/// What the files of a block take [byte], with regions as large as the sample.
fn further(files: &OutputFiles, particles: usize, stages: &[StageForecast]) -> f64 {
    let between = |stage: &StageForecast| files.every.map_or(0.0, |interval| stage.count(interval));
    let frames = 1.0 + stages.iter().map(|stage| 1.0 + between(stage)).sum::<f64>();
    let number = match files.format {
        // Zlib leaves 0.47 of the text of a settled bed of 32 000 grains; of other beds less may be left.
        FileFormat::Vtk if files.compressed => 4.0,
        FileFormat::Vtk => 4.0 / 3.0 * 8.0,
        // Shuffled and deflated, numbers without order in them keep 0.74 of their bytes.
        FileFormat::Hdf5 if files.compressed => 6.0,
        FileFormat::Npz | FileFormat::Hdf5 => 8.0,
        FileFormat::LammpsDump | FileFormat::Xyz | FileFormat::Csv => NUMBER,
    };
    let number = if files.single_precision { 0.5 * number } else { number };
    let of_particle = 3.0
        + match &files.fields {
            Some(names) => components(names.iter().map(String::as_str)),
            None => components(DEFAULT_PARTICLE_FIELDS.iter().copied()),
        };
    // VTK has both ends of a contact.
    let ends = if files.format == FileFormat::Vtk { 6.0 } else { 0.0 };
    let of_contact = match &files.contacts {
        ContactFields::None => 0.0,
        ContactFields::Default => ends + components(DEFAULT_CONTACT_FIELDS.iter().copied()),
        ContactFields::Named(names) => ends + components(names.iter().map(String::as_str)),
    };
    frames * particles as f64 * number * (of_particle + CONTACTS * of_contact)
}

/// Checkpoints that are on the disk at the same time at most.
fn checkpoints(scenario: &Scenario) -> f64 {
    let Some(plan) = scenario.output.checkpoints else { return 0.0 };
    // The two last ones, and the next.
    3.0 + if plan.stage_ends { scenario.stages.len() as f64 } else { 0.0 }
}

impl StageForecast {
    /// How often something regular happens in the stage, as long as it is known to take.
    pub(super) fn count(&self, interval: Interval) -> f64 {
        let steps = self.steps.unwrap_or(self.least_steps) as f64;
        match interval {
            Interval::Steps(every) => (steps / every as f64).floor(),
            Interval::Time(every) => (steps * self.time_step / every).floor().min(steps),
        }
    }
}
