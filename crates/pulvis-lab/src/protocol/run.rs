//! Runs the stages of a scenario and writes what they give.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use pulvis_core::walls::WallMotion;
use pulvis_core::{InstructionSet, Simulation, StepError};
use pulvis_input::scenario::{Scenario, Snapshots as SnapshotPlan, WallControl};
use pulvis_io::table::TimeSeriesWriter;
use pulvis_math::max_or_nan;

use super::error::{PrepareError, RunError};
use super::folder::{OutputFolder, RECORD};
use super::measure::Measure;
use super::pace::{Due, PACE, Pace};
use super::report::{self, Series};
use super::setup::{Prepared, StagePlan, prepare};
use super::snapshots::Snapshots;
use super::stage::{Ending, StageWatch, length};
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
    /// Told what is valid and yet probably not meant, before the first step.
    pub warn: fn(&str),
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
    /// Wall-clock time [s].
    pub wall_clock: f64,
    /// Relative closing error of the energy ledger at the end [1].
    pub energy_error: f64,
    /// The largest relative closing error among all rows of the time series [1].
    pub energy_error_max: f64,
    /// Pictures that were drawn.
    pub pictures: Vec<PathBuf>,
}

impl RunSummary {
    /// Whether the user stopped the run.
    pub fn interrupted(&self) -> bool {
        self.stages.last().is_some_and(|stage| stage.ending == Ending::Interrupted)
    }
}

/// Runs a scenario. `watch` is told about the progress some times a second; a true `stop` ends the
/// run after the present step with all files complete.
pub fn run(
    scenario: &Scenario,
    options: &RunOptions,
    stop: &AtomicBool,
    watch: &mut (dyn FnMut(&Progress) + Send),
) -> Result<RunSummary, RunError> {
    let prepared = prepare(scenario)?;
    for warning in warnings(scenario, &prepared) {
        (options.warn)(&warning);
    }
    let folder = options.folder.clone().unwrap_or_else(|| scenario.output.folder.clone());
    let mut output = OutputFolder::open(&folder, options.force)?;
    let resolved = scenario.to_resolved_toml(&options.version);
    let record = output.file(RECORD)?;
    std::fs::write(&record, resolved).map_err(|source| PrepareError::Folder { folder: record, source })?;
    let mut run = Run::begin(scenario, prepared, output)?;
    let threads = options.threads.unwrap_or_else(|| sensible_threads(run.simulation.particles().len()));
    run.simulation
        .set_threads(threads)
        .map_err(|source| RunError::Switch { stage: scenario.stages[0].name.clone(), source })?;
    if let Some(instructions) = options.instructions {
        run.simulation.set_instructions(instructions);
    }
    match run.stages(stop, watch) {
        Ok(stages) => run.finish(stages),
        Err(error) => {
            if matches!(error, RunError::Step { .. }) {
                run.salvage();
            }
            Err(error)
        }
    }
}

/// Particles for which a further thread pays: with fewer, threads wait for each other longer than
/// they work.
const PARTICLES_PER_THREAD: usize = 500;

pub(super) fn sensible_threads(particles: usize) -> usize {
    let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    threads_for(particles, processors)
}

fn threads_for(particles: usize, processors: usize) -> usize {
    processors.min(particles / PARTICLES_PER_THREAD).max(1)
}

/// A run under way.
struct Run<'a> {
    scenario: &'a Scenario,
    simulation: Simulation,
    plans: Vec<StagePlan>,
    measure: Measure,
    writer: TimeSeriesWriter,
    rows: Vec<Vec<f64>>,
    snapshots: Option<Snapshots>,
    output: OutputFolder,
    began: Instant,
    rows_due: Due,
    frames_due: Option<Due>,
}

impl<'a> Run<'a> {
    fn begin(scenario: &'a Scenario, prepared: Prepared, mut output: OutputFolder) -> Result<Self, RunError> {
        let Prepared { simulation, stages: plans, .. } = prepared;
        let measure = Measure::new(scenario, &simulation);
        let writer = TimeSeriesWriter::create(&output.file("timeseries.csv")?, measure.columns())?;
        let folder = output.path();
        let (snapshots, frames_due) = match scenario.output.snapshots {
            SnapshotPlan::Never => (None, None),
            SnapshotPlan::StageEnds => (Some(Snapshots::create(folder)?), None),
            SnapshotPlan::Every(interval) => (Some(Snapshots::create(folder)?), Some(Due::new(interval))),
        };
        let mut run = Self {
            scenario,
            simulation,
            plans,
            measure,
            writer,
            rows: Vec::new(),
            snapshots,
            output,
            began: Instant::now(),
            rows_due: Due::new(scenario.output.timeseries),
            frames_due,
        };
        run.frame()?;
        Ok(run)
    }

    /// Runs all stages, or those before the user stops it.
    fn stages(
        &mut self,
        stop: &AtomicBool,
        watch: &mut (dyn FnMut(&Progress) + Send),
    ) -> Result<Vec<StageResult>, RunError> {
        let mut results: Vec<StageResult> = Vec::new();
        for number in 0..self.scenario.stages.len() {
            results.push(self.stage(number, stop, watch)?);
            if results.last().is_some_and(|result| result.ending == Ending::Interrupted) {
                break;
            }
        }
        Ok(results)
    }

    /// Runs one stage to its end.
    fn stage(
        &mut self,
        number: usize,
        stop: &AtomicBool,
        watch: &mut (dyn FnMut(&Progress) + Send),
    ) -> Result<StageResult, RunError> {
        let scenario = self.scenario;
        let stage = &scenario.stages[number];
        self.switch_to(number)?;
        let mut rules = StageWatch::new(scenario, stage, &self.simulation);
        let start_lengths = [0, 1, 2].map(|axis| length(scenario, &self.simulation, axis));
        self.row(number, start_lengths)?;
        let mut pace = Pace::new(self.simulation.steps());
        let ending = loop {
            let steps = self.steps_to_next_look(&rules);
            self.simulation.advance(steps).map_err(|source| self.stopped(number, source))?;
            if self.rows_due.now(&self.simulation) {
                self.row(number, start_lengths)?;
            }
            let simulation = &self.simulation;
            if self.frames_due.as_mut().is_some_and(|due| due.now(simulation)) {
                self.frame()?;
            }
            if stop.load(Ordering::Relaxed) {
                break Ending::Interrupted;
            }
            if let Some(ending) = rules.ending(&self.simulation) {
                break ending;
            }
            if pace.is_due(self.simulation.steps()) {
                let fraction = rules.progress(&self.simulation);
                watch(&self.progress(number, &mut pace, fraction, None));
            }
        };
        self.row(number, start_lengths)?;
        self.frame()?;
        if scenario.output.dimensionless.and_then(|scales| scales.reference_stage) == Some(number) {
            self.measure.take_reference(scenario, &self.simulation);
        }
        watch(&self.progress(number, &mut pace, None, Some(ending)));
        let (time, steps) = (self.simulation.time(), self.simulation.steps());
        Ok(StageResult { name: stage.name.clone(), ending, time, steps })
    }

    /// Steps that can be done in one go before anything has to be looked at: the engine is faster so.
    fn steps_to_next_look(&self, rules: &StageWatch<'_>) -> u64 {
        let simulation = &self.simulation;
        let pace = PACE - simulation.steps() % PACE;
        let frame = self.frames_due.as_ref().map_or(pace, |due| due.steps_left(simulation));
        let row = self.rows_due.steps_left(simulation);
        pace.min(frame).min(row).min(rules.steps_left(simulation)).max(1)
    }

    fn switch_to(&mut self, number: usize) -> Result<(), RunError> {
        let plan = &self.plans[number];
        let simulation = &mut self.simulation;
        if let Some(region) = &self.scenario.stages[number].remove {
            simulation.remove_within(region);
        }
        let failed = |source| RunError::Switch { stage: self.scenario.stages[number].name.clone(), source };
        // What the first stage sets is what the simulation was built with.
        if number > 0 {
            let before = &self.plans[number - 1];
            if before.interactions != plan.interactions {
                simulation.set_interactions(plan.interactions.clone()).map_err(failed)?;
            }
            if before.background != plan.background {
                simulation.set_background(plan.background).map_err(failed)?;
            }
            if before.time_step.to_bits() != plan.time_step.to_bits() {
                simulation.set_time_step(plan.time_step).map_err(failed)?;
            }
        }
        // A wall that was on its way by a function of time has arrived.
        for place in 0..simulation.walls().len() {
            let changed = plan.wall_changes.iter().any(|(wall, _)| *wall == place);
            if !changed && simulation.walls()[place].motion.law().duration().is_some() {
                simulation.set_wall_motion(place, WallMotion::Fixed).map_err(failed)?;
            }
        }
        for (place, control) in &plan.wall_changes {
            simulation.set_wall_motion(*place, control.motion().unwrap_or_default()).map_err(failed)?;
            if matches!(control, WallControl::Removed) {
                simulation.set_wall_present(*place, false);
            }
        }
        if self.scenario.stages[number].form_bonds {
            simulation.form_bonds();
        }
        Ok(())
    }

    fn row(&mut self, stage: usize, start_lengths: [Option<f64>; 3]) -> Result<(), RunError> {
        let row = self.measure.row(self.scenario, &self.simulation, stage + 1, start_lengths);
        self.writer.row(&row)?;
        self.rows.push(row);
        // What is reported is right.
        self.simulation.check_state().map_err(|source| self.stopped(stage, source))
    }

    fn stopped(&self, stage: usize, source: StepError) -> RunError {
        let (stage, folder) = (self.scenario.stages[stage].name.clone(), self.output.path().to_path_buf());
        RunError::Step { stage, source, folder }
    }

    fn frame(&mut self) -> Result<(), RunError> {
        match &mut self.snapshots {
            Some(snapshots) => snapshots.write(&self.simulation, &mut self.output),
            None => Ok(()),
        }
    }

    fn progress(
        &mut self,
        number: usize,
        pace: &mut Pace,
        fraction: Option<f64>,
        ending: Option<Ending>,
    ) -> Progress {
        let steps_per_second = pace.rate(self.simulation.steps());
        let elapsed = pace.began.elapsed().as_secs_f64();
        let remaining = fraction.filter(|&done| done > 0.0).map(|done| elapsed * (1.0 - done) / done);
        Progress {
            stage: self.scenario.stages[number].name.clone(),
            number: number + 1,
            stages: self.scenario.stages.len(),
            time: self.simulation.time(),
            steps: self.simulation.steps(),
            steps_per_second,
            fraction,
            remaining,
            energy_error: self.simulation.ledger().relative_error(),
            ending,
        }
    }

    /// Completes the files of a run that has failed, and shows the state in which it did, as far as that is possible:
    /// what failed is the error that counts.
    fn salvage(mut self) {
        let _ = self.frame();
        let _ = self.writer.finish();
        if self.scenario.output.plots {
            let series = Series { measure: &self.measure, rows: &self.rows };
            let _ = report::draw(self.scenario, &self.simulation, &series, &mut self.output);
        }
    }

    fn finish(mut self, stages: Vec<StageResult>) -> Result<RunSummary, RunError> {
        self.writer.finish()?;
        let error_column = self.measure.column("relative_error").unwrap_or(0);
        let errors = self.rows.iter().map(|row| row[error_column].abs());
        let energy_error_max = errors.fold(0.0, max_or_nan);
        let series = Series { measure: &self.measure, rows: &self.rows };
        let pictures = if self.scenario.output.plots {
            report::draw(self.scenario, &self.simulation, &series, &mut self.output)?
        } else {
            Vec::new()
        };
        Ok(RunSummary {
            folder: self.output.path().to_owned(),
            stages,
            particles: self.simulation.particles().len(),
            steps: self.simulation.steps(),
            wall_clock: self.began.elapsed().as_secs_f64(),
            energy_error: self.simulation.ledger().relative_error(),
            energy_error_max,
            pictures,
        })
    }
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
