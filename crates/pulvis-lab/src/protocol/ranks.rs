//! A run on several ranks. The first one leads: it decides when the run looks at the state, and writes all files. The
//! others follow: they take the same steps and go through the same stages, without a file.
//!
//! Between two advances every rank holds the whole state, so that stages, programs, inlets and rules come to the same on
//! each of them without a word. What only one rank knows is told by the leader before every advance: how many steps it
//! takes; and by the others in answer: whether somebody has asked them to stop.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use pulvis_core::{Interactions, Simulation};
use pulvis_input::scenario::{Scenario, Stage};
use pulvis_parallel::exchange::{Exchange, ExchangeError, Message, Waiting};

use super::checkpoint::{find, scenario_from_text};
use super::error::{PrepareError, RunError};
use super::folder::RECORD;
use super::measure::Measure;
use super::openings::Openings;
use super::pace::PACE;
use super::programs::{models_after, update};
use super::run::{RunOptions, RunSummary, set_machine};
use super::setup::{Prepared, StagePlan, prepare};
use super::stage::{Look, StageWatch};
use super::start::{Resumed, resumed};
use super::switch::switch;

/// What the leader orders, as a number: so many steps, nothing but an answer, the end, to tell all of particles, of
/// everything or of energies, or to go on to the next stage.
const WAIT: f64 = 0.0;
const END: f64 = -1.0;
const TELL_PARTICLES: f64 = -2.0;
const TELL_EVERYTHING: f64 = -3.0;
const NEXT_STAGE: f64 = -4.0;
const TELL_ENERGIES: f64 = -5.0;

/// What a follower answers.
const GOES_ON: f64 = 0.0;
const IS_STOPPED: f64 = 1.0;
const HAS_FAILED: f64 = 2.0;

impl From<ExchangeError> for RunError {
    fn from(error: ExchangeError) -> Self {
        Self::Ranks { reason: error.reason }
    }
}

/// Orders of the leader to all ranks, if there are others.
#[derive(Clone, Debug, Default)]
pub(super) struct Leader {
    exchange: Option<Arc<dyn Exchange>>,
}

impl Leader {
    pub(super) fn new(exchange: Option<&Arc<dyn Exchange>>) -> Self {
        Self { exchange: exchange.cloned() }
    }

    /// The others take so many steps, too. Answers whether any of them is asked to stop after these.
    ///
    /// # Errors
    /// A rank is lost, or could not do its part.
    pub(super) fn order_steps(&self, steps: u64) -> Result<bool, RunError> {
        self.order(steps as f64)
    }

    /// The leader looks at what it may not know.
    ///
    /// # Errors
    /// A rank is lost.
    pub(super) fn look(&self, simulation: &mut Simulation, look: Look) -> Result<(), RunError> {
        if simulation.knows_everything() || look == Look::Totals {
            return Ok(());
        }
        self.order(match look {
            Look::Totals | Look::Energies => TELL_ENERGIES,
            Look::Particles => TELL_PARTICLES,
            Look::Everything => TELL_EVERYTHING,
        })?;
        Ok(tell(simulation, look)?)
    }

    /// The stage has ended for all ranks.
    ///
    /// # Errors
    /// A rank is lost.
    pub(super) fn end_stage(&self, simulation: &mut Simulation) -> Result<(), RunError> {
        self.order(NEXT_STAGE)?;
        Ok(tell(simulation, Look::Everything)?)
    }

    /// How long it takes at least from one sign of life to the next: with other ranks, it costs as much as a step.
    pub(super) fn patience(&self) -> f64 {
        if self.exchange.is_some() { 2.0 } else { 0.2 }
    }

    /// Steps after which the clock is looked at: about a second of them where that costs something.
    pub(super) fn pace(&self, steps_per_second: f64) -> u64 {
        if self.exchange.is_none() {
            return PACE;
        }
        // Whatever is no number of steps comes out as the shortest pace.
        (steps_per_second as u64 / PACE).clamp(1, 4096) * PACE
    }

    /// Waits until all others are ready to begin.
    ///
    /// # Errors
    /// As above.
    pub(super) fn wait_for_others(&self) -> Result<(), RunError> {
        self.order(WAIT).map(drop)
    }

    /// Sends the others home, however the run has ended; of no use where one is lost.
    pub(super) fn end(&self, result: &Result<RunSummary, RunError>) {
        let is_lost = match result {
            Err(RunError::Ranks { .. }) => true,
            Err(RunError::Step { source, .. }) => source.alarm.is_lost_rank(),
            _ => false,
        };
        if !is_lost {
            // Those who do not hear it miss this rank soon.
            let _ = self.order(END);
        }
    }

    fn order(&self, order: f64) -> Result<bool, RunError> {
        let Some(exchange) = &self.exchange else { return Ok(false) };
        let mut answers = Vec::new();
        exchange.gather(&[order], &mut answers, Waiting::ForFiles)?;
        let answer = |answer: &Message| answer.first().copied().unwrap_or(HAS_FAILED);
        let mut others = answers.iter().enumerate().skip(1);
        match others.find(|(_, message)| order != END && answer(message) == HAS_FAILED) {
            Some((rank, _)) => {
                let reason = format!("rank {rank} could not do its part; its own message says why");
                Err(RunError::Ranks { reason })
            }
            None => Ok(answers[1..].iter().any(|message| answer(message) == IS_STOPPED)),
        }
    }
}

/// What all ranks do together after steps that each has taken apart.
pub(super) fn tell(simulation: &mut Simulation, look: Look) -> Result<(), ExchangeError> {
    let told = match look {
        Look::Totals => Ok(()),
        Look::Energies => simulation.tell_energies(),
        Look::Particles => simulation.tell_particles(),
        Look::Everything => simulation.tell_everything(),
    };
    told.map_err(|error| ExchangeError { reason: error.to_string() })
}

/// What everybody looks at after the steps up to a look: what may change the state must know it.
pub(super) fn look_after_steps(
    rules: &StageWatch<'_>,
    scenario: &Scenario,
    stage: &Stage,
    simulation: &Simulation,
) -> Look {
    let may_change = stage.programs.is_some() || !scenario.inlets.is_empty() || !scenario.outlets.is_empty();
    if may_change { Look::Everything } else { rules.look(simulation) }
}

/// Sends the other ranks home before there is a run.
pub fn dismiss(exchange: &Arc<dyn Exchange>) {
    let _ = Leader::new(Some(exchange)).order(END);
}

/// What a follower does that could not even read its scenario: the leader most likely could not, either, and says why.
/// Answers whether it could, so that this rank has to say it.
pub fn follow_nobody(exchange: &Arc<dyn Exchange>) -> bool {
    !matches!(next_order(exchange.as_ref(), HAS_FAILED), Ok(END))
}

/// Where a rank that follows begins.
#[derive(Clone, Copy, Debug)]
pub enum Following<'a> {
    /// At the beginning of a scenario.
    Scenario(&'a Scenario),
    /// Where the run in a folder, or in the folder of this checkpoint, goes on.
    Resumed(&'a Path),
}

/// How a rank has followed.
#[derive(Debug)]
pub enum Followed {
    /// To the end of the run, or until the user stopped it.
    ToTheEnd,
    /// Until something failed that the leader tells.
    UntilTold(RunError),
}

/// Follows the leader of a run until it ends. A true `stop` stops the run on all ranks.
///
/// # Errors
/// What only this rank knows of, so that it has to tell.
pub fn follow(
    following: Following<'_>,
    options: &RunOptions,
    exchange: &Arc<dyn Exchange>,
    stop: &AtomicBool,
) -> Result<Followed, RunError> {
    let followed = match following {
        Following::Scenario(scenario) => follow_from_start(scenario, options, exchange, stop),
        Following::Resumed(path) => follow_from_checkpoint(path, options, exchange, stop),
    };
    match followed {
        Ok(()) => Ok(Followed::ToTheEnd),
        Err(error @ RunError::Ranks { .. }) => Err(error),
        Err(error) => match next_order(exchange.as_ref(), HAS_FAILED) {
            Ok(END) => Ok(Followed::UntilTold(error)),
            // The leader goes on, or is lost: nobody else says what happened here.
            _ => Err(error),
        },
    }
}

/// Hears the next order, and gives an answer.
fn next_order(exchange: &dyn Exchange, answer: f64) -> Result<f64, ExchangeError> {
    let mut all = Vec::new();
    exchange.gather(&[answer], &mut all, Waiting::ForFiles)?;
    Ok(all.first().and_then(|message| message.first().copied()).unwrap_or(END))
}

fn follow_from_start(
    scenario: &Scenario,
    options: &RunOptions,
    exchange: &Arc<dyn Exchange>,
    stop: &AtomicBool,
) -> Result<(), RunError> {
    let Prepared { simulation, stages: plans, particles: _, sample: _, origin } = prepare(scenario)?;
    let mut follower = Follower {
        scenario,
        openings: Openings::new(scenario, origin.openings.as_ref()),
        interactions: origin.interactions,
        update: 0,
        plans,
        walls_arrive: origin.stage_ended,
        measure: Measure::new(scenario, &simulation),
        simulation,
        exchange,
        stop,
    };
    follower.stages(0, None, options)
}

fn follow_from_checkpoint(
    path: &Path,
    options: &RunOptions,
    exchange: &Arc<dyn Exchange>,
    stop: &AtomicBool,
) -> Result<(), RunError> {
    let folder = if path.is_file() { path.parent().unwrap_or(path) } else { path };
    let record = folder.join(RECORD);
    let unreadable = |source| PrepareError::Folder { folder: folder.to_owned(), source };
    let resolved = std::fs::read_to_string(&record).map_err(unreadable)?;
    let scenario =
        scenario_from_text(&record.display().to_string(), &resolved).map_err(PrepareError::from)?;
    let Some(found) = find(path).map_err(PrepareError::from)? else {
        return follow_from_start(&scenario, options, exchange, stop);
    };
    let Resumed { simulation, plans, ancestors: _, record, results } = resumed(&scenario, found)?;
    let (number, update) = (results.len(), record.update as usize);
    let stage = &scenario.stages[record.stage()];
    let rules = record.watch.as_ref().map(|watch| StageWatch::resume(&scenario, stage, watch));
    let mut measure = Measure::new(&scenario, &simulation);
    measure.resume(record.reference);
    let mut follower = Follower {
        measure,
        scenario: &scenario,
        openings: Openings::new(&scenario, Some(&record.openings)),
        interactions: models_after(&scenario, stage, update),
        update,
        plans,
        walls_arrive: true,
        simulation,
        exchange,
        stop,
    };
    follower.stages(number, rules, options)
}

/// A rank that follows.
struct Follower<'a> {
    scenario: &'a Scenario,
    simulation: Simulation,
    interactions: Interactions,
    /// The update of the present stage's programs that holds.
    update: usize,
    plans: Vec<StagePlan>,
    walls_arrive: bool,
    openings: Openings,
    /// What the rule `steady` looks at.
    measure: Measure,
    exchange: &'a Arc<dyn Exchange>,
    stop: &'a AtomicBool,
}

impl<'a> Follower<'a> {
    /// Goes through the stages from this one on, of which `watch` has seen a part, until the leader ends.
    fn stages(
        &mut self,
        first: usize,
        mut watch: Option<StageWatch<'a>>,
        options: &RunOptions,
    ) -> Result<(), RunError> {
        let scenario = self.scenario;
        let stage = scenario.stages[first.min(scenario.stages.len() - 1)].name.clone();
        let machine = set_machine(&mut self.simulation, scenario.expected_particles(), options);
        machine.map_err(|source| RunError::Switch { stage, source })?;
        for number in first..scenario.stages.len() {
            let has_more = self.stage(number, watch.take())?;
            if !has_more {
                return Ok(());
            }
        }
        // The leader still has to complete its files.
        while self.next_order()? != END {}
        Ok(())
    }

    fn next_order(&self) -> Result<f64, RunError> {
        let answer = if self.stop.load(Ordering::Relaxed) { IS_STOPPED } else { GOES_ON };
        Ok(next_order(self.exchange.as_ref(), answer)?)
    }

    /// Goes through a stage; answers whether the run goes on after it.
    fn stage(&mut self, number: usize, watch: Option<StageWatch<'a>>) -> Result<bool, RunError> {
        let scenario = self.scenario;
        let (stage, plan) = (&scenario.stages[number], &self.plans[number]);
        let mut rules = match watch {
            Some(rules) => rules,
            None => {
                let (simulation, interactions) = (&mut self.simulation, &mut self.interactions);
                let arrival = (self.walls_arrive, &BTreeSet::new());
                switch(simulation, interactions, scenario, (plan, stage), arrival)?;
                (self.walls_arrive, self.update) = (true, 0);
                self.openings.enter_stage(&stage.name, &self.simulation);
                StageWatch::new(scenario, stage, &self.simulation)
            }
        };
        let mut has_ended = false;
        loop {
            let order = self.next_order()?;
            match order {
                END => return Ok(false),
                WAIT => continue,
                TELL_ENERGIES => tell(&mut self.simulation, Look::Energies)?,
                TELL_PARTICLES => tell(&mut self.simulation, Look::Particles)?,
                TELL_EVERYTHING => tell(&mut self.simulation, Look::Everything)?,
                NEXT_STAGE => {
                    tell(&mut self.simulation, Look::Everything)?;
                    self.measure.end_stage(scenario, &self.simulation, number);
                    return Ok(true);
                }
                _ => {}
            }
            if order < 0.0 {
                continue;
            }
            if has_ended {
                let reason = format!("the stage `{}` has ended on one rank and not on the first", stage.name);
                return Err(RunError::Ranks { reason });
            }
            let name = || stage.name.clone();
            self.simulation.advance_apart(order as u64).map_err(|source| RunError::Stopped {
                stage: name(),
                source: Box::new(source),
                cause: "the first rank tells it".to_owned(),
            })?;
            let look = look_after_steps(&rules, scenario, stage, &self.simulation);
            tell(&mut self.simulation, look)?;
            let programs = (stage, &self.plans[number].programs[..]);
            let (models, present) = (&mut self.interactions, &mut self.update);
            update(&mut self.simulation, models, present, programs, rules.start_time())?;
            self.openings.act(&mut self.simulation).map_err(|source| RunError::inlet(&stage.name, source))?;
            has_ended = rules.ending(&self.simulation, &self.openings, &self.measure, number).is_some();
        }
    }
}
