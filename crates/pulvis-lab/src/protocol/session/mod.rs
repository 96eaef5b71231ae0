//! The stages of a scenario in the hands of a program: step by step, without files.

mod edit;
mod files;

use std::collections::BTreeSet;

use pulvis_core::{InstructionSet, Interactions, Simulation};
use pulvis_input::scenario::Scenario;

use super::checkpoint::{Ancestor, WatchRecord};
use super::ending::Ending;
use super::error::RunError;
use super::explain::likely_cause;
use super::measure::Measure;
use super::openings::Openings;
use super::programs::update;
use super::run::{StageResult, sensible_threads};
use super::setup::{Prepared, StagePlan, prepare};
use super::stage::StageWatch;
use super::switch::switch;
use super::warnings::warnings;
pub use edit::{EditError, MotionValue};
use files::Outputs;

/// A scenario under way. The state after any number of steps is, bit for bit, that of [`run`](super::run()): stages begin and
/// end at the same steps.
#[derive(Debug)]
pub struct Session {
    scenario: Scenario,
    simulation: Simulation,
    interactions: Interactions,
    /// The update of the present stage's programs that holds.
    update: usize,
    plans: Vec<StagePlan>,
    walls_arrive: bool,
    measure: Measure,
    openings: Openings,
    /// The stages that have ended.
    results: Vec<StageResult>,
    /// What the rules of the present stage have seen; `None` between two stages.
    watch: Option<WatchRecord>,
    start_lengths: [Option<f64>; 3],
    /// Where the session began.
    first_step: u64,
    warnings: Vec<String>,
    /// Whether it has stopped for good.
    broken: bool,
    /// The runs that this one has branched from.
    ancestors: Vec<Ancestor>,
    /// The walls that the program has taken in hand, which checkpoints tell beside the scenario.
    led_walls: BTreeSet<usize>,
    outputs: Outputs,
}

/// What came of a call of [`Session::advance`].
#[derive(Clone, Debug, PartialEq)]
pub struct Advance {
    /// Steps that were taken: fewer than asked for where the last stage has ended, or the present one if that was asked.
    pub steps: u64,
    /// The stages that have ended meanwhile.
    pub ended: Vec<StageResult>,
}

impl Session {
    /// A scenario before its first step.
    ///
    /// # Errors
    /// The scenario cannot be run.
    pub fn new(scenario: Scenario) -> Result<Self, RunError> {
        let prepared = prepare(&scenario)?;
        let warnings = warnings(&scenario, &prepared);
        let Prepared { simulation, stages: plans, particles: _, sample: _, origin } = prepared;
        let mut session = Self {
            measure: Measure::new(&scenario, &simulation),
            openings: Openings::new(&scenario, origin.openings.as_ref()),
            interactions: origin.interactions,
            update: 0,
            walls_arrive: origin.stage_ended,
            plans,
            results: Vec::new(),
            watch: None,
            start_lengths: [None; 3],
            first_step: simulation.steps(),
            warnings,
            broken: false,
            ancestors: origin.ancestors,
            led_walls: BTreeSet::new(),
            outputs: Outputs::default(),
            simulation,
            scenario,
        };
        session.set_threads(None)?;
        Ok(session)
    }

    /// Takes steps; stages change on the way. With `one_stage`, none beyond the end of the present stage.
    ///
    /// # Errors
    /// What happens in a step cannot be right, or the switch to a stage is refused. The session then stands in the middle of
    /// a step: look at it, it does not go on.
    pub fn advance(&mut self, steps: u64, one_stage: bool) -> Result<Advance, RunError> {
        if self.broken {
            return Err(RunError::Broken);
        }
        let outcome = self.advance_stages(steps, one_stage);
        self.broken = outcome.is_err();
        outcome
    }

    fn advance_stages(&mut self, steps: u64, one_stage: bool) -> Result<Advance, RunError> {
        let mut advance = Advance { steps: 0, ended: Vec::new() };
        while advance.steps < steps && !self.is_over() {
            let ended = self.advance_stage(steps - advance.steps, &mut advance.steps)?;
            let has_ended = ended.is_some();
            advance.ended.extend(ended);
            if has_ended && one_stage {
                break;
            }
        }
        let checked = self.simulation.check_state();
        checked.map_err(|source| self.stopped(source))?;
        Ok(advance)
    }

    /// Takes steps of one stage; answers with its end if it has come.
    fn advance_stage(&mut self, most: u64, taken: &mut u64) -> Result<Option<StageResult>, RunError> {
        let number = self.results.len();
        if self.watch.is_none() {
            let (plan, stage) = (&self.plans[number], &self.scenario.stages[number]);
            let (models, scenario) = (&mut self.interactions, &self.scenario);
            let arrival = (self.walls_arrive, &self.led_walls);
            switch(&mut self.simulation, models, scenario, (plan, stage), arrival)?;
            // What a stage controls is in the hands of the scenario again.
            self.led_walls.retain(|place| plan.wall_changes.iter().all(|(wall, _)| wall != place));
            self.walls_arrive = true;
            self.update = 0;
            self.openings.enter_stage(&stage.name, &self.simulation);
        }
        let stage = &self.scenario.stages[number];
        let mut rules = match &self.watch {
            Some(record) => StageWatch::resume(&self.scenario, stage, record),
            None => StageWatch::new(&self.scenario, stage, &self.simulation),
        };
        self.start_lengths = rules.start_lengths();
        let mut left = most;
        let ending = loop {
            let openings = self.openings.steps_left(&self.simulation);
            let steps = rules.steps_left(&self.simulation, &self.openings).min(openings).clamp(1, left);
            self.simulation.advance(steps).map_err(|source| self.stopped(source))?;
            (left, *taken) = (left - steps, *taken + steps);
            let programs = (stage, &self.plans[number].programs[..]);
            let (models, present) = (&mut self.interactions, &mut self.update);
            update(&mut self.simulation, models, present, programs, rules.start_time())?;
            let acted = self.openings.act(&mut self.simulation);
            acted.map_err(|source| RunError::inlet(&stage.name, source))?;
            let ending = rules.ending(&self.simulation, &self.openings, &self.measure, number);
            if ending.is_some() || left == 0 {
                break ending;
            }
        };
        self.watch = ending.is_none().then(|| rules.record());
        Ok(ending.map(|ending| self.end_stage(number, ending)))
    }

    fn end_stage(&mut self, number: usize, ending: Ending) -> StageResult {
        self.measure.end_stage(&self.scenario, &self.simulation, number);
        let (time, steps) = (self.simulation.time(), self.simulation.steps());
        let result = StageResult { name: self.scenario.stages[number].name.clone(), ending, time, steps };
        self.results.push(result.clone());
        result
    }

    fn stopped(&self, source: pulvis_core::StepError) -> RunError {
        let cause = likely_cause(&self.simulation, &source.alarm, self.first_step);
        let stage = self.scenario.stages[self.stage()].name.clone();
        RunError::Stopped { stage, source: Box::new(source), cause }
    }

    /// Number of the present stage, from 0; that of the last one after its end.
    pub fn stage(&self) -> usize {
        self.results.len().min(self.scenario.stages.len() - 1)
    }

    /// Whether the last stage has ended.
    pub fn is_over(&self) -> bool {
        self.results.len() >= self.scenario.stages.len()
    }

    /// The stages that have ended.
    pub fn results(&self) -> &[StageResult] {
        &self.results
    }

    /// The scenario.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The simulation as it is now.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// What is valid and yet probably not meant.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The names of the columns of [`row`](Self::row), those of `timeseries.csv`.
    pub fn columns(&self) -> &[String] {
        self.measure.columns()
    }

    /// One row of the time series: the present state.
    pub fn row(&self) -> Vec<f64> {
        let (stage, openings) = (self.stage() + 1, &self.openings);
        self.measure.row(&self.scenario, &self.simulation, openings, stage, self.start_lengths)
    }

    /// Sets the number of threads; as many as there are processors and work for them where `None`. Results do not depend
    /// on it.
    ///
    /// # Errors
    /// No thread, or more than the system gives.
    pub fn set_threads(&mut self, threads: Option<usize>) -> Result<(), RunError> {
        let threads = threads.unwrap_or_else(|| {
            let expected = self.scenario.expected_particles();
            sensible_threads(self.simulation.particles().len().max(expected))
        });
        let stage = self.scenario.stages[self.stage()].name.clone();
        self.simulation.set_threads(threads).map_err(|source| RunError::Switch { stage, source })
    }

    /// Sets the instruction set. Results do not depend on it.
    pub fn set_instructions(&mut self, instructions: InstructionSet) {
        self.simulation.set_instructions(instructions);
    }
}
