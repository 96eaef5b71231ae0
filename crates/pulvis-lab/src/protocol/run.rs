//! Runs the stages of a scenario, from the beginning or from a checkpoint.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use pulvis_core::{InstructionSet, SetupError, Simulation};
use pulvis_input::scenario::Scenario;
use pulvis_io::checkpoint::{CheckpointError, peek_header, write_text};
use pulvis_parallel::exchange::Exchange;

use super::averages::Average;
use super::check::stages;
use super::checkpoint::{Found, ResultRecord, checkpoint_files, find, scenario_from_text};
use super::disk::refuse_full_disk;
use super::ending::Ending;
use super::error::{PrepareError, RunError};
use super::folder::{LIST, OutputFolder, RECORD};
use super::formats::refuse_missing_formats;
use super::measure::Measure;
use super::ranks::Leader;
use super::setup::prepare;
use super::under_way::Run;
use super::warnings::warnings;

/// Where a run writes, and how.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// Output folder; the scenario's own where `None`.
    pub folder: Option<PathBuf>,
    /// Whether to write over a run that is in the folder.
    pub force: bool,
    /// Number of threads; as many as there are processors and work for them where `None`. Results do
    /// not depend on it.
    pub threads: Option<usize>,
    /// The instruction set; the widest that the processor has where `None`. Results do not depend on it.
    pub instructions: Option<InstructionSet>,
    /// Version of the program, for the record.
    pub version: String,
    /// How pictures are written.
    pub pictures: PictureOptions,
    /// The other ranks that share the run; `None` where it has one. Results do not depend on them.
    pub exchange: Option<Arc<dyn Exchange>>,
    /// Told what is valid and yet probably not meant, before the first step.
    pub warn: fn(&str),
}

/// How the pictures of a run are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureOptions {
    /// Pixels to the inch of a PNG.
    pub dpi: u32,
    /// Whether plots are written as SVG too.
    pub svg: bool,
}

impl Default for PictureOptions {
    /// PNG with 144 pixels to the inch.
    fn default() -> Self {
        Self { dpi: 144, svg: false }
    }
}

/// How far a run has come.
#[derive(Clone, Debug)]
pub struct Progress {
    /// Name of the stage.
    pub stage: String,
    /// Number of the stage, from 1.
    pub number: usize,
    /// Number of stages.
    pub stages: usize,
    /// Simulated time [s].
    pub time: f64,
    /// Steps done.
    pub steps: u64,
    /// Particles that are there.
    pub particles: usize,
    /// Time steps per second of wall-clock time.
    pub steps_per_second: f64,
    /// Progress of the stage from 0 to 1, where its duration is known.
    pub fraction: Option<f64>,
    /// Wall-clock time that the stage still needs [s], where its duration is known.
    pub remaining: Option<f64>,
    /// Relative closing error of the energy ledger [1].
    pub energy_error: f64,
    /// Set when the stage has ended: why.
    pub ending: Option<Ending>,
}

/// What came of a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct StageResult {
    /// Name of the stage.
    pub name: String,
    /// Why it ended.
    pub ending: Ending,
    /// Simulated time at its end [s].
    pub time: f64,
    /// Steps done at its end.
    pub steps: u64,
}

impl StageResult {
    pub(super) fn record(&self) -> ResultRecord {
        // The name is that of the scenario.
        let Self { name: _, ending, time, steps } = self;
        ResultRecord { ending: ending.number(), time: *time, steps: *steps }
    }
}

/// What came of a run.
#[derive(Clone, Debug)]
pub struct RunSummary {
    /// The output folder.
    pub folder: PathBuf,
    /// The stages that ran.
    pub stages: Vec<StageResult>,
    /// Number of particles.
    pub particles: usize,
    /// Steps done.
    pub steps: u64,
    /// Steps that were done before, if the run went on from a state.
    pub steps_before: u64,
    /// Wall-clock time [s].
    pub wall_clock: f64,
    /// Relative closing error of the energy ledger at the end [1].
    pub energy_error: f64,
    /// The largest relative closing error among all rows of the time series [1].
    pub energy_error_max: f64,
    /// Averages of what observers have seen, stage by stage.
    pub averages: Vec<Average>,
    /// Pictures that were drawn.
    pub pictures: Vec<PathBuf>,
    /// Whether a checkpoint was written from which the run can go on.
    pub can_be_resumed: bool,
}

impl RunSummary {
    /// Whether the user stopped the run.
    pub fn interrupted(&self) -> bool {
        self.stages.last().is_some_and(|stage| stage.ending == Ending::Interrupted)
    }
}

/// Told about the progress some times a second.
pub(super) type Watch<'a> = &'a mut (dyn FnMut(&Progress) + Send);

/// Runs a scenario. `watch` is told about the progress some times a second; a true `stop` ends the
/// run after the present step with all files complete and a checkpoint, from which [`resume`] goes on.
///
/// # Errors
/// The scenario cannot be run, the output cannot be written, or what happens cannot be right.
pub fn run(
    scenario: &Scenario,
    options: &RunOptions,
    stop: &AtomicBool,
    watch: &mut (dyn FnMut(&Progress) + Send),
) -> Result<RunSummary, RunError> {
    let result = run_as_leader(scenario, options, stop, watch);
    Leader::new(options.exchange.as_ref()).end(&result);
    result
}

fn run_as_leader(
    scenario: &Scenario,
    options: &RunOptions,
    stop: &AtomicBool,
    watch: Watch<'_>,
) -> Result<RunSummary, RunError> {
    refuse_missing_formats(scenario)?;
    let prepared = prepare(scenario)?;
    for warning in warnings(scenario, &prepared) {
        (options.warn)(&warning);
    }
    let folder = options.folder.clone().unwrap_or_else(|| scenario.output.folder.clone());
    let columns = Measure::new(scenario, &prepared.simulation).columns().len();
    let stages = stages(scenario, &prepared);
    let particles = prepared.particles.len().max(scenario.expected_particles());
    refuse_full_disk(scenario, &folder, particles, columns, &stages)?;
    let mut output = OutputFolder::open(&folder, options.force)?;
    let resolved = scenario.to_resolved_toml(&options.version);
    write_text(&output.file(RECORD)?, &resolved)?;
    Run::begin(scenario, resolved, prepared, output, &options.version)?.complete(options, stop, watch)
}

/// Goes on with an interrupted run, from the latest checkpoint in its folder, or from the one that `path` is. The output is
/// cut back to what the checkpoint knows of; all files then become what they had become without the interruption, byte
/// by byte. A run without any checkpoint begins again.
///
/// # Errors
/// There is no run, it goes on or has ended, its checkpoint cannot be used or its files have changed; and as of [`run`].
pub fn resume(
    path: &Path,
    options: &RunOptions,
    stop: &AtomicBool,
    watch: &mut (dyn FnMut(&Progress) + Send),
) -> Result<RunSummary, RunError> {
    let result = resume_as_leader(path, options, stop, watch);
    Leader::new(options.exchange.as_ref()).end(&result);
    result
}

fn resume_as_leader(
    path: &Path,
    options: &RunOptions,
    stop: &AtomicBool,
    watch: Watch<'_>,
) -> Result<RunSummary, RunError> {
    let parent = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let is_file = path.is_file();
    if is_file && matches!(peek_header(path), Err(CheckpointError::Foreign)) {
        return Err(PrepareError::NothingToResume { folder: path.to_owned() }.into());
    }
    let folder = if is_file { parent } else { path };
    let mut output = OutputFolder::reopen(folder)?;
    let found = find(path).map_err(PrepareError::from)?;
    let record = folder.join(RECORD);
    let unreadable = |source| PrepareError::Folder { folder: folder.to_owned(), source };
    let resolved = std::fs::read_to_string(&record).map_err(unreadable)?;
    let scenario =
        scenario_from_text(&record.display().to_string(), &resolved).map_err(PrepareError::from)?;
    refuse_missing_formats(&scenario)?;
    // Others read the same files, which change from here on.
    Leader::new(options.exchange.as_ref()).wait_for_others()?;
    let Some(found) = found else {
        (options.warn)("the run has no checkpoint: it begins again");
        let prepared = prepare(&scenario)?;
        output.cut_back(&[LIST, RECORD].map(str::to_owned))?;
        return Run::begin(&scenario, resolved, prepared, output, &options.version)?
            .complete(options, stop, watch);
    };
    check_found(&found, &resolved, folder, options)?;
    Run::resume(&scenario, resolved, found, output, &options.version)?.complete(options, stop, watch)
}

/// Whether a checkpoint is one of this run, from which it can go on.
fn check_found(
    found: &Found,
    resolved: &str,
    folder: &Path,
    options: &RunOptions,
) -> Result<(), PrepareError> {
    let Found { path, checkpoint } = found;
    if checkpoint.scenario != resolved {
        let problem = format!("its scenario is not the one in {}", folder.join(RECORD).display());
        return Err(PrepareError::Misfit { file: path.clone(), problem });
    }
    if checkpoint.run.complete {
        return Err(PrepareError::RunHasEnded { folder: folder.to_owned() });
    }
    let version =
        resolved.lines().next().and_then(|line| line.strip_prefix("# Pulvis ")).unwrap_or("unknown");
    if version != options.version {
        let own = &options.version;
        (options.warn)(&format!(
            "the run was begun by Pulvis {version} and goes on with Pulvis {own}: the last bits may be other ones"
        ));
    }
    Ok(())
}

/// Removes the checkpoints that come after the one to go on from: the files that they know of will be gone.
pub(super) fn drop_later(path: &Path) -> Result<(), RunError> {
    let Some(folder) = path.parent() else { return Ok(()) };
    let files = checkpoint_files(folder);
    for later in files.iter().take_while(|file| file.file_name() != path.file_name()) {
        let removed = std::fs::remove_file(later);
        removed.map_err(|source| RunError::File { file: later.clone(), source })?;
    }
    Ok(())
}

/// Sets what changes no bit, for as many particles as there are or are `expected`.
pub(super) fn set_machine(
    simulation: &mut Simulation,
    expected: usize,
    options: &RunOptions,
) -> Result<(), SetupError> {
    let particles = simulation.particles().len().max(expected);
    let alone = options.exchange.is_none();
    // Ranks that share a machine do not know how many they are: a thread each, unless the user knows better.
    let threads = options.threads.unwrap_or_else(|| if alone { sensible_threads(particles) } else { 1 });
    simulation.set_threads(threads)?;
    if let Some(exchange) = &options.exchange {
        if exchange.ranks() > 1 && simulation.has_applied_forces() {
            let problem = "the checkpoint holds forces that a program applies, whose work ranks do not tell each other; \
                           run it on one rank";
            return Err(SetupError::Column { name: "applied_force".to_owned(), problem: problem.to_owned() });
        }
        simulation.set_exchange(Arc::clone(exchange));
    }
    if let Some(instructions) = options.instructions {
        simulation.set_instructions(instructions);
    }
    Ok(())
}

/// Particles for which a further thread pays: with fewer, threads wait for each other longer than
/// they work.
const PARTICLES_PER_THREAD: usize = 500;

pub(super) fn sensible_threads(particles: usize) -> usize {
    let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    threads_for(particles, processors)
}

/// As many threads as there is work for, of `processors`.
pub(crate) fn threads_for(particles: usize, processors: usize) -> usize {
    processors.min(particles / PARTICLES_PER_THREAD).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_systems_take_all_processors_and_small_ones_as_many_as_they_have_work_for() {
        let threads = |times: usize, processors| threads_for(times * PARTICLES_PER_THREAD, processors);
        assert_eq!(
            [threads(0, 8), threads(1, 8), threads(3, 8), threads(8, 8), threads(1000, 8)],
            [1, 1, 3, 8, 8]
        );
        assert_eq!(threads(1000, 1), 1);
    }
}
