//! A run under way: its stages and what it writes.

mod checkpoints;
mod last_files;

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use pulvis_core::{Interactions, Simulation, StepError};
use pulvis_input::scenario::Scenario;
use pulvis_io::table::TimeSeriesWriter;

use super::checkpoint::{Ancestor, Keeper, LATEST, PREVIOUS, stage_file};
use super::ending::Ending;
use super::error::RunError;
use super::explain::likely_cause;
use super::fields::{FIELDS, fields};
use super::folder::OutputFolder;
use super::kept_rows::KeptRows;
use super::measure::Measure;
use super::observers::{histogram, histogram_file};
use super::openings::Openings;
use super::pace::{Due, Pace};
use super::programs::update;
use super::ranks::{Leader, look_after_steps, tell};
use super::run::{PictureOptions, Progress, RunOptions, RunSummary, StageResult, Watch, set_machine};
use super::setup::{Prepared, StagePlan};
use super::snapshots::Snapshots;
use super::stage::{Look, StageWatch};
use super::status::{RunPhase, STATUS, StatusFile};
use super::switch::switch;

/// The column of the relative closing error.
const RELATIVE_ERROR: &str = "relative_error";

pub(crate) const TIME_SERIES: &str = "timeseries.csv";

/// A run under way.
pub(super) struct Run<'a> {
    scenario: &'a Scenario,
    /// The same as text.
    resolved: String,
    /// The runs that this one has branched from.
    ancestors: Vec<Ancestor>,
    simulation: Simulation,
    /// The contact models that the simulation has now.
    interactions: Interactions,
    /// The update of the present stage's programs that holds.
    update: usize,
    plans: Vec<StagePlan>,
    /// The stages that have ended.
    results: Vec<StageResult>,
    /// The stage that a resumed run is in.
    watch: Option<StageWatch<'a>>,
    /// Whether motions of walls with an end have come to it when the next stage begins.
    walls_arrive: bool,
    measure: Measure,
    openings: Openings,
    writer: TimeSeriesWriter,
    rows: KeptRows,
    snapshots: Snapshots<'a>,
    output: OutputFolder,
    /// How many of the files of the run are on the disk for certain.
    synced: usize,
    began: Instant,
    steps_before: u64,
    rows_due: Due,
    checkpoints_due: Option<Due>,
    keeper: Keeper,
    pictures: PictureOptions,
    /// The sign of life for other processes.
    status: StatusFile,
    /// Orders to other ranks.
    leader: Leader,
    /// Of the last steps.
    steps_per_second: f64,
}

impl<'a> Run<'a> {
    /// At the start of the first stage.
    pub(super) fn begin(
        scenario: &'a Scenario,
        resolved: String,
        prepared: Prepared,
        mut output: OutputFolder,
        version: &str,
    ) -> Result<Self, RunError> {
        let Prepared { simulation, stages: plans, particles: _, sample: _, origin } = prepared;
        let measure = Measure::new(scenario, &simulation);
        fields(scenario, measure.columns())?.write(&output.file(FIELDS)?)?;
        let writer = TimeSeriesWriter::create(&output.file(TIME_SERIES)?, measure.columns())?;
        let status = StatusFile::begin(output.file(STATUS)?, version);
        let keeper = Keeper::new(scenario, output.path(), version);
        if keeper.plan().is_some() {
            output.file(LATEST)?;
            output.file(PREVIOUS)?;
        }
        let due = |interval| Due::from_now(interval, &simulation);
        let mut run = Self {
            scenario,
            resolved,
            ancestors: origin.ancestors,
            openings: Openings::new(scenario, origin.openings.as_ref()),
            interactions: origin.interactions,
            update: 0,
            walls_arrive: origin.stage_ended,
            plans,
            results: Vec::new(),
            watch: None,
            rows: KeptRows::new(measure.column(RELATIVE_ERROR).unwrap_or(0)),
            measure,
            writer,
            snapshots: Snapshots::create(scenario, &simulation, output.path())?,
            output,
            synced: 0,
            began: Instant::now(),
            steps_before: simulation.steps(),
            rows_due: due(scenario.output.timeseries),
            checkpoints_due: keeper.plan().and_then(|plan| plan.every).map(due),
            keeper,
            pictures: PictureOptions::default(),
            status,
            leader: Leader::default(),
            steps_per_second: 0.0,
            simulation,
        };
        run.frame()?;
        Ok(run)
    }

    /// Runs all stages that are left, or those before the user stops it, and completes all files.
    pub(super) fn complete(
        mut self,
        options: &RunOptions,
        stop: &AtomicBool,
        watch: Watch<'_>,
    ) -> Result<RunSummary, RunError> {
        let stage = self.scenario.stages[self.results.len().min(self.plans.len() - 1)].name.clone();
        let machine = set_machine(&mut self.simulation, self.scenario.expected_particles(), options);
        machine.map_err(|source| RunError::Switch { stage, source })?;
        self.pictures = options.pictures;
        self.leader = Leader::new(options.exchange.as_ref());
        match self.stages(stop, watch).and_then(|interrupted| self.finish(interrupted)) {
            Ok(summary) => {
                let interrupted = summary.interrupted();
                self.status.end(if interrupted { RunPhase::Interrupted } else { RunPhase::Complete }, None);
                Ok(summary)
            }
            Err(mut error) => {
                let step = self.keeper.rescue();
                if let RunError::Step { saved, .. } | RunError::Inlet { saved, .. } = &mut error {
                    *saved = step;
                }
                // Where a rank is lost, so is its part of the state.
                if self.simulation.knows_everything() {
                    self.salvage(&error);
                }
                self.status.end(RunPhase::Failed, Some(error.to_string()));
                Err(error)
            }
        }
    }

    /// Runs all stages that are left; answers with how the user has stopped them.
    fn stages(&mut self, stop: &AtomicBool, watch: Watch<'_>) -> Result<Option<StageResult>, RunError> {
        for number in self.results.len()..self.scenario.stages.len() {
            let result = self.stage(number, stop, watch)?;
            if result.ending == Ending::Interrupted {
                return Ok(Some(result));
            }
            self.results.push(result);
            if self.keeper.plan().is_some_and(|plan| plan.stage_ends) {
                let name = stage_file(number);
                self.output.file(&name)?;
                self.hold(None)?;
                self.keeper.write_now(Some(&name))?;
            }
        }
        Ok(None)
    }

    /// Runs one stage to its end.
    fn stage(&mut self, number: usize, stop: &AtomicBool, watch: Watch<'_>) -> Result<StageResult, RunError> {
        let scenario = self.scenario;
        let stage = &scenario.stages[number];
        let mut rules = match self.watch.take() {
            Some(rules) => rules,
            None => {
                self.switch_to(number)?;
                self.openings.enter_stage(&stage.name, &self.simulation);
                let rules = StageWatch::new(scenario, stage, &self.simulation);
                self.row(number, &rules)?;
                rules
            }
        };
        let mut pace = Pace::new(self.simulation.steps());
        let ending = loop {
            self.advance(number, &rules, stop)?;
            if let Some(ending) = rules.ending(&self.simulation, &self.openings, &self.measure, number) {
                break ending;
            }
            let simulation = &self.simulation;
            let asked = self.checkpoints_due.as_mut().is_some_and(|due| due.now(simulation));
            // All that belongs to this step has been written and decided: what follows is the next step.
            if stop.load(Ordering::Relaxed) {
                self.look(Look::Everything)?;
                self.last_checkpoint(&rules)?;
                break Ending::Interrupted;
            }
            self.checkpoint(&rules, asked)?;
            if pace.is_due(self.simulation.steps(), self.leader.patience()) {
                self.look(Look::Energies)?;
                let fraction = rules.progress(&self.simulation);
                let progress = self.progress(number, &mut pace, fraction, None);
                self.status.tell(&progress);
                watch(&progress);
            }
        };
        if ending != Ending::Interrupted {
            self.leader.end_stage(&mut self.simulation)?;
        }
        self.row(number, &rules)?;
        self.frame()?;
        if ending != Ending::Interrupted {
            self.histograms(number)?;
        }
        self.measure.end_stage(scenario, &self.simulation, number);
        let progress = self.progress(number, &mut pace, None, Some(ending));
        self.status.tell(&progress);
        watch(&progress);
        let (time, steps) = (self.simulation.time(), self.simulation.steps());
        Ok(StageResult { name: stage.name.clone(), ending, time, steps })
    }

    /// Steps to the next look, and all that is due then. Where another rank is asked to `stop`, so is this one.
    fn advance(&mut self, number: usize, rules: &StageWatch<'_>, stop: &AtomicBool) -> Result<(), RunError> {
        let scenario = self.scenario;
        let stage = &scenario.stages[number];
        let steps = self.steps_to_next_look(rules);
        if self.leader.order_steps(steps)? {
            stop.store(true, Ordering::Relaxed);
        }
        let began = Instant::now();
        self.simulation.advance_apart(steps).map_err(|source| self.stopped(number, source))?;
        self.steps_per_second = steps as f64 / began.elapsed().as_secs_f64();
        let look = look_after_steps(rules, scenario, stage, &self.simulation);
        tell(&mut self.simulation, look)?;
        let programs = (stage, &self.plans[number].programs[..]);
        let (models, present) = (&mut self.interactions, &mut self.update);
        update(&mut self.simulation, models, present, programs, rules.start_time())?;
        if let Err(source) = self.openings.act(&mut self.simulation) {
            // The state is sound, and the last that there is.
            self.row(number, rules)?;
            return Err(RunError::inlet(&stage.name, source).with_folder(self.output.path()));
        }
        if self.rows_due.now(&self.simulation) {
            self.row(number, rules)?;
        }
        if self.snapshots.due().any(|due| due.is_now(&self.simulation)) {
            self.look(Look::Everything)?;
        }
        self.snapshots.write_due(scenario, &self.simulation, &mut self.output)
    }

    /// Steps that can be done in one go before anything has to be looked at: the engine is faster so.
    fn steps_to_next_look(&self, rules: &StageWatch<'_>) -> u64 {
        let simulation = &self.simulation;
        let every = self.leader.pace(self.steps_per_second);
        let pace = every - simulation.steps() % every;
        let regular = [Some(&self.rows_due), self.checkpoints_due.as_ref()];
        let regular =
            regular.into_iter().flatten().chain(self.snapshots.due()).map(|due| due.steps_left(simulation));
        let openings = self.openings.steps_left(simulation);
        regular.fold(pace, u64::min).min(rules.steps_left(simulation, &self.openings)).min(openings).max(1)
    }

    fn switch_to(&mut self, number: usize) -> Result<(), RunError> {
        let (plan, stage) = (&self.plans[number], &self.scenario.stages[number]);
        let scenario = self.scenario;
        let arrival = (self.walls_arrive, &BTreeSet::new());
        switch(&mut self.simulation, &mut self.interactions, scenario, (plan, stage), arrival)?;
        self.walls_arrive = true;
        self.update = 0;
        Ok(())
    }

    /// Gets to know of other ranks what is looked at.
    fn look(&mut self, look: Look) -> Result<(), RunError> {
        self.leader.look(&mut self.simulation, look)
    }

    fn row(&mut self, stage: usize, rules: &StageWatch<'_>) -> Result<(), RunError> {
        self.look(Look::Everything)?;
        let (scenario, simulation, lengths) = (self.scenario, &self.simulation, rules.start_lengths());
        let row = self.measure.row(scenario, simulation, &self.openings, stage + 1, lengths);
        self.writer.row(&row)?;
        self.rows.push(row);
        // What is reported is right.
        self.simulation.check_state().map_err(|source| self.stopped(stage, source))
    }

    fn stopped(&self, stage: usize, source: StepError) -> RunError {
        let cause = likely_cause(&self.simulation, &source.alarm, self.steps_before);
        let (stage, folder) = (self.scenario.stages[stage].name.clone(), self.output.path().to_path_buf());
        RunError::Step { stage, source: Box::new(source), cause, folder, saved: None }
    }

    fn frame(&mut self) -> Result<(), RunError> {
        self.snapshots.write_all(self.scenario, &self.simulation, &mut self.output)
    }

    /// Writes the distributions of forces at the end of a stage.
    fn histograms(&mut self, stage: usize) -> Result<(), RunError> {
        for observer in self.scenario.observers.iter().filter(|observer| observer.histogram) {
            let table = histogram(observer, &self.simulation)?;
            table.write(&self.output.file(&histogram_file(observer, stage))?)?;
        }
        Ok(())
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
            particles: self.simulation.particles().len(),
            steps_per_second,
            fraction,
            remaining,
            energy_error: self.simulation.ledger().relative_error(),
            ending,
        }
    }
}
