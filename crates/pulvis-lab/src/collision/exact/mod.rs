//! The collision to round-off: error-controlled steps that end at every change of branch.
//!
//! Within a step the memory of the contact is frozen. That is exact, because a law's force is a
//! function of the overlap as long as the motion does not turn and the branch does not change, and at
//! both the step ends: its length is halved until the event is met to round-off. Then the memory is
//! updated, and what the laws lost on the way is booked.

mod account;
mod events;

use super::dynamics::{Branches, Dynamics, Motion, Phase, Record};
use super::error::CollisionError;
use super::extrapolation::{Trial, try_step};
use super::outcome::{Collision, Observation, Outcome, Regime, Sample, Sampling};
use super::problem::Problem;
use events::Event;
use pulvis_contact::ContactResponse;

/// More steps than any collision should take: overdamped pairs creep, but not that long.
const MOST_STEPS: u64 = 2_000_000;

/// Part of the shortest contact time that a step may cover at most, so that no pair of turning points
/// falls between its ends.
const LONGEST_STEP: f64 = 1.0 / 8.0;

/// Collides two bodies.
///
/// # Errors
/// The motion does not end, or leaves the range of numbers.
pub(super) fn collide(problem: &Problem<'_>, observation: &Observation) -> Result<Collision, CollisionError> {
    let dynamics = Dynamics::new(problem.contact, problem.bodies, problem.pair);
    let mut flight = Flight::new(dynamics, problem, observation);
    while !flight.over {
        flight.step()?;
    }
    Ok(flight.finish())
}

/// A collision under way.
struct Flight<'p> {
    dynamics: Dynamics,
    problem: &'p Problem<'p>,
    observation: &'p Observation,
    time: f64,
    motion: Motion,
    phase: Phase,
    memory: Record,
    response: ContactResponse<f64>,
    /// Lost to the rate-independent laws [J].
    lost: f64,
    step_length: f64,
    longest_step: f64,
    steps: u64,
    scale: Motion,
    overlap_max: f64,
    /// The largest energy that took part: the scale of the balance [J].
    largest_energy: f64,
    touch_time: Option<f64>,
    opening_time: Option<f64>,
    stop: Option<Outcome>,
    end_time: f64,
    next_sample: usize,
    course: Vec<Sample>,
    /// Time and phase of the last recorded instant.
    recorded: (f64, Phase),
    /// The branch travelled last: at its end, a corner, the point lies on two.
    travelled: Option<Branches>,
    over: bool,
}

impl<'p> Flight<'p> {
    fn new(dynamics: Dynamics, problem: &'p Problem<'p>, observation: &'p Observation) -> Self {
        let longest_step = LONGEST_STEP * problem.shortest_time;
        let start = problem.start_overlap();
        let longest_step = match observation.sampling {
            Sampling::Every(interval) => longest_step.min(interval),
            _ => longest_step,
        };
        let speed = problem.velocity;
        let mut flight = Self {
            motion: [start, speed, 0.0],
            phase: Phase::Apart,
            memory: dynamics.fresh(),
            response: ContactResponse::default(),
            lost: 0.0,
            time: 0.0,
            step_length: longest_step,
            longest_step,
            steps: 0,
            scale: [speed * problem.shortest_time - start, speed, problem.kinetic(speed)],
            overlap_max: 0.0,
            largest_energy: problem.kinetic(speed),
            touch_time: None,
            opening_time: None,
            stop: None,
            end_time: f64::INFINITY,
            next_sample: 0,
            course: Vec::new(),
            recorded: (f64::NEG_INFINITY, Phase::Apart),
            travelled: None,
            over: false,
            dynamics,
            problem,
            observation,
        };
        flight.commit();
        flight.record();
        if start >= 0.0 {
            flight.cross_border();
        }
        flight
    }

    /// Takes one step, up to the next event.
    fn step(&mut self) -> Result<(), CollisionError> {
        self.steps += 1;
        if self.steps > self.observation.most_steps.unwrap_or(MOST_STEPS) {
            let (velocity, steps, time) = (self.problem.velocity, self.steps, self.time);
            let damped = self.problem.is_damped();
            return Err(CollisionError::TooLong { velocity, steps, time, damped });
        }
        let outward = self.motion[1] < 0.0 || (self.motion[1] == 0.0 && self.response.normal_force > 0.0);
        let direction = if outward { -1.0 } else { 1.0 };
        // A corner between branches, a turning point above all, lies on two: the one that the law
        // names, and the one just ahead. Motion in one direction does not come back to the first.
        let ahead = self.motion[0] + direction * 1e-14 * (self.motion[0].abs() + self.scale[0]);
        let branches =
            [self.motion[0], ahead].map(|overlap| self.dynamics.branches(self.phase, overlap, &self.memory));

        let (length, trial) = self.refine()?;
        let grown = (length * trial.factor()).min(self.longest_step);
        // A step cut short by a sample time says nothing about the next one.
        self.step_length = if length < self.step_length { self.step_length.max(grown) } else { grown };
        let event = self.event(&trial, direction, &branches);
        if event == Event::None {
            self.accept(length, &trial.end);
        } else {
            self.advance_to_event(length, direction, &branches);
        }
        self.after_step(outward, &branches);
        Ok(())
    }

    /// Shortens the step until its error is allowed.
    fn refine(&mut self) -> Result<(f64, Trial<3>), CollisionError> {
        let allowed = self.time_allowed();
        loop {
            let length = self.step_length.min(allowed);
            let trial = self.attempt(length);
            let finite = trial.end.iter().all(|number| number.is_finite());
            if !finite && length < 1e-12 * self.longest_step {
                let (velocity, time) = (self.problem.velocity, self.time);
                return Err(CollisionError::NotFinite { velocity, time });
            }
            // A kink that no branch number tells of stops the refinement here.
            if finite && (trial.error <= 1.0 || length <= 1e-13 * self.longest_step) {
                return Ok((length, trial));
            }
            self.step_length = length * if trial.error.is_finite() { trial.factor().min(0.7) } else { 0.1 };
        }
    }

    fn attempt(&self, length: f64) -> Trial<3> {
        try_step(&self.motion, length, &self.scale, |motion| {
            self.dynamics.rate(self.phase, motion, &self.memory)
        })
    }

    /// How long the next step may be, so that it ends at the next sample and at the end.
    fn time_allowed(&self) -> f64 {
        let mut allowed = self.end_time - self.time;
        if let Sampling::At(times) = &self.observation.sampling
            && let Some(next) = times.get(self.next_sample)
        {
            allowed = allowed.min(next - self.time);
        }
        allowed
    }

    /// Moves to the end of a step.
    fn accept(&mut self, length: f64, end: &Motion) {
        self.time += length;
        self.motion = *end;
        self.overlap_max = self.overlap_max.max(end[0]);
        self.scale[0] = self.scale[0].max(end[0].abs());
        self.scale[1] = self.scale[1].max(end[1].abs());
        self.scale[2] = self.scale[2].max(self.problem.kinetic(end[1]));
        self.commit();
    }

    /// Lets the laws update their memory, and books what they lost.
    fn commit(&mut self) {
        self.response = self.dynamics.respond(self.phase, &self.motion, &mut self.memory);
        let energies = &self.response.energies;
        self.lost += energies.dissipated();
        let size =
            (energies.elastic_normal + energies.elastic_bond).max(energies.attraction().abs()).max(self.lost);
        self.largest_energy = self.largest_energy.max(size);
    }

    /// Touch or opening.
    fn cross_border(&mut self) {
        self.phase = match self.phase {
            Phase::Apart => {
                self.touch_time.get_or_insert(self.time);
                Phase::Contact
            }
            Phase::Contact => {
                self.opening_time.get_or_insert(self.time);
                Phase::Apart
            }
        };
        self.commit();
        if self.phase == Phase::Contact {
            self.record();
        }
    }

    /// Samples, and decides whether the pair has stuck, rests, or is gone.
    fn after_step(&mut self, outward: bool, branches: &[Branches; 2]) {
        self.travelled = Some(branches[1]);
        self.record();
        let turned = outward && self.motion[1] == 0.0;
        let resting = self.touch_time.is_some() && self.at_rest();
        if (turned || resting) && self.stop.is_none() {
            let name = branches[1].name(self.phase);
            self.stop = Some(self.outcome(Regime::Stick, Some(name)));
            self.end_time = self.time + self.observation.time_after_sticking;
        }
        let here = self.dynamics.branches(self.phase, self.motion[0], &self.memory);
        let gone = self.phase == Phase::Apart && self.touch_time.is_some() && !here.attracted;
        self.over = self.time >= self.end_time || (gone && self.motion[1] < 0.0);
    }
}
