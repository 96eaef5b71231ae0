//! The collision as the engine integrates it: two real particles, or one and a wall, in a simulation
//! with steps of one length.

mod setup;

use super::error::CollisionError;
use super::oblique::{self, Momenta, RelativeMotion};
use super::outcome::{Collision, Observation, Outcome, Regime, Sample, Sampling};
use super::problem::Problem;
use crate::branch::ruling_branch;
use pulvis_contact::NormalMotion;
use pulvis_core::{NamedColumn, Simulation};
use pulvis_input::BodyQuantity;
use pulvis_input::collision::Bodies;
use setup::setup;

/// Steps after which a collision is given up.
const MOST_STEPS: u64 = 50_000_000;

/// A pair with less than this part of its kinetic energy, and as little elastic energy about the
/// force-free point, is at rest.
const AT_REST: f64 = 1e-24;

/// Collides two bodies in the engine, with `steps_per_contact` steps in the shortest contact time.
///
/// # Errors
/// The engine refuses the time step or loses a particle, or the motion does not end.
pub(super) fn collide(
    problem: &Problem<'_>,
    steps_per_contact: f64,
    observation: &Observation,
) -> Result<Collision, CollisionError> {
    let time_step = problem.shortest_time / steps_per_contact;
    let mut run = Run::new(problem, time_step, observation)?;
    while !run.over {
        run.step()?;
    }
    Ok(run.finish())
}

/// Where the bodies are, seen along the line of centres.
#[derive(Clone, Copy, Debug, Default)]
struct Instant {
    time: f64,
    overlap: f64,
    velocity: f64,
    force: f64,
    /// Tangential force on i [N].
    tangential_force: f64,
}

/// A collision under way.
struct Run<'p> {
    problem: &'p Problem<'p>,
    observation: &'p Observation,
    simulation: Simulation,
    /// Those before.
    momenta: Momenta,
    now: Instant,
    before: Instant,
    overlap_max: f64,
    touch_time: Option<f64>,
    opening_time: Option<f64>,
    stop: Option<Outcome>,
    end_time: f64,
    next_sample: usize,
    course: Vec<Sample>,
    over: bool,
}

impl<'p> Run<'p> {
    fn new(
        problem: &'p Problem<'p>,
        time_step: f64,
        observation: &'p Observation,
    ) -> Result<Self, CollisionError> {
        let surroundings = problem.surroundings;
        let setup = setup(problem, time_step, observation.phase);
        let bodies = setup.particles.len();
        let column = |quantity: &BodyQuantity| NamedColumn {
            name: quantity.name.to_owned(),
            unit: quantity.unit.clone(),
            values: quantity.values[..bodies].to_vec(),
        };
        let columns = surroundings.quantities.iter().map(column).collect();
        let mut simulation = Simulation::with_columns(setup, columns)?;
        simulation.set_temperature(surroundings.temperature.clone());
        let mut run = Self {
            problem,
            observation,
            momenta: Momenta::of(simulation.particles()),
            simulation,
            now: Instant::default(),
            before: Instant::default(),
            overlap_max: 0.0,
            touch_time: None,
            opening_time: None,
            stop: None,
            end_time: f64::INFINITY,
            next_sample: 0,
            course: Vec::new(),
            over: false,
        };
        run.now = run.look();
        run.record();
        Ok(run)
    }

    fn step(&mut self) -> Result<(), CollisionError> {
        if self.simulation.steps() >= self.observation.most_steps.unwrap_or(MOST_STEPS) {
            let (velocity, steps, time) = (self.problem.velocity, self.simulation.steps(), self.now.time);
            let damped = self.problem.is_damped();
            return Err(CollisionError::TooLong { velocity, steps, time, damped });
        }
        self.simulation.step()?;
        self.before = self.now;
        self.now = self.look();
        self.record();
        self.judge();
        Ok(())
    }

    /// What the contact remembers; zeros while it is none. Few steps ask.
    fn remembered(&self) -> Vec<f64> {
        let mut columns = vec![0.0; self.problem.contact.memory_layout().columns()];
        self.simulation.for_each_contact(&mut |contact| columns.copy_from_slice(contact.memory));
        columns
    }

    /// Reads the state off the simulation.
    fn look(&self) -> Instant {
        let particles = self.simulation.particles();
        let (position, velocity, forces) =
            (particles.positions(), particles.velocities(), particles.forces());
        // Of two particles, the first one is the one with the lower id.
        let i = usize::from(particles.ids().first() != Some(&0));
        let (overlap, rate, force) = match self.problem.bodies {
            Bodies::Pair([first, second]) => {
                let j = 1 - i;
                let (between, against) = (position[i] - position[j], velocity[j] - velocity[i]);
                let sum = first.radius + second.radius;
                // The same bits as along the line of centres alone where nothing moves across it.
                match between.unit().filter(|_| self.problem.incidence.is_some()) {
                    Some(normal) => (sum - between.norm(), against.dot(normal), forces[i].dot(normal)),
                    None => (sum - between.x, against.x, forces[i].x),
                }
            }
            Bodies::Wall(sphere) => (sphere.radius - position[i].x, -velocity[i].x, forces[i].x),
        };
        let tangential_force = forces[i].y;
        Instant { time: self.simulation.time(), overlap, velocity: rate, force, tangential_force }
    }

    /// Looks for touch, turning points, sticking and the end.
    fn judge(&mut self) {
        let (before, now) = (self.before, self.now);
        self.overlap_max = self.overlap_max.max(now.overlap);
        let crossing = || {
            let share = before.overlap / (before.overlap - now.overlap);
            before.time + share * (now.time - before.time)
        };
        if before.overlap <= 0.0 && now.overlap > 0.0 {
            self.touch_time.get_or_insert_with(crossing);
        } else if before.overlap > 0.0 && now.overlap <= 0.0 {
            self.opening_time.get_or_insert_with(crossing);
        }
        if self.touch_time.is_none() {
            return;
        }
        if before.velocity > 0.0 && now.velocity <= 0.0 {
            self.overlap_max = self.overlap_max.max(self.turning_overlap());
        }
        let turned = before.velocity < 0.0 && now.velocity >= 0.0;
        if self.stop.is_none() && (turned || self.at_rest()) {
            self.stop = Some(self.outcome(Regime::Stick));
            self.end_time = now.time + self.observation.time_after_sticking;
        }
        // A force that ended within the last step works on in the half kick to come.
        let gone = now.overlap <= -self.problem.interaction_range() && now.velocity < 0.0 && now.force == 0.0;
        self.over = gone || now.time >= self.end_time;
    }

    /// The overlap at a turning point within the last step, taking the acceleration as constant [m].
    fn turning_overlap(&self) -> f64 {
        let (before, now) = (self.before, self.now);
        let share = before.velocity / (before.velocity - now.velocity);
        before.overlap + 0.5 * before.velocity * share * (now.time - before.time)
    }

    fn at_rest(&self) -> bool {
        let least = AT_REST * self.problem.kinetic(self.problem.velocity);
        let squared = self.now.force * self.now.force;
        self.now.overlap > 0.0
            && self.problem.kinetic(self.now.velocity) < least
            && squared < least * self.problem.stiffness_scale()
    }

    fn outcome(&mut self, regime: Regime) -> Outcome {
        let ledger = self.simulation.ledger();
        let oblique = self
            .problem
            .incidence
            .as_ref()
            .map(|incidence| oblique::outcome(self.problem, incidence, &self.simulation, &self.momenta));
        let before = match oblique {
            Some(_) => ledger.initial,
            None => self.problem.kinetic(self.problem.velocity),
        };
        let rebound = regime == Regime::Rebound;
        let turned = self.before.velocity < 0.0 && self.now.velocity >= 0.0;
        let stop = if turned { self.turning_overlap() } else { self.now.overlap };
        Outcome {
            regime,
            stop_branch: (!rebound).then(|| self.branch(self.before.overlap)),
            restitution: if rebound { self.rebound_velocity() / self.problem.normal_velocity } else { 0.0 },
            overlap_max: self.overlap_max,
            overlap_end: if rebound { 0.0 - self.problem.interaction_range() } else { stop },
            contact_duration: self.opening_time.zip(self.touch_time).map(|(end, start)| end - start),
            energy_dissipated: ledger.dissipated(),
            energy_error: -ledger.closing_error() / before.max(ledger.scale),
            oblique,
        }
    }

    /// How fast the bodies move apart along the line of centres before [m/s].
    fn rebound_velocity(&self) -> f64 {
        match self.problem.incidence {
            Some(_) => RelativeMotion::now(&self.simulation).velocity.x,
            None => -self.now.velocity,
        }
    }

    /// The branch on which the bodies are, or that of the attraction where they are apart.
    fn branch(&self, overlap: f64) -> &'static str {
        let Problem { contact, pair, bodies, .. } = self.problem;
        ruling_branch(contact, pair, bodies.radii(), overlap, &self.remembered())
    }

    fn finish(mut self) -> Collision {
        let outcome = match self.stop {
            Some(outcome) => outcome,
            None => self.outcome(Regime::Rebound),
        };
        Collision { outcome, course: self.course }
    }

    /// Keeps this instant if it is asked for; the steps are not cut to fit.
    fn record(&mut self) {
        match &self.observation.sampling {
            Sampling::None => return,
            Sampling::Every(_) => {}
            Sampling::At(times) => match times.get(self.next_sample) {
                Some(next) if *next <= self.now.time => self.next_sample += 1,
                _ => return,
            },
        }
        let sample = self.sample();
        self.course.push(sample);
    }

    fn sample(&mut self) -> Sample {
        let ledger = self.simulation.ledger();
        let Instant { time, overlap, velocity, force, tangential_force } = self.now;
        let oblique = self
            .problem
            .incidence
            .map(|_| RelativeMotion::now(&self.simulation).sample(self.problem.bodies, tangential_force));
        let all = oblique.is_some();
        let (normal, pair) = (&self.problem.contact.normal, &self.problem.pair);
        let columns = self.remembered();
        let branch = normal.branch(pair, overlap, &columns).0;
        let elastic = ledger.elastic_normal + ledger.elastic_bond;
        let potential = normal.branch_potential(branch, &NormalMotion::at_rest(pair, overlap), &columns);
        Sample {
            time,
            overlap,
            velocity,
            force,
            delta_max: normal.remembered_overlap(&columns).unwrap_or(self.overlap_max),
            kinetic: if all { ledger.kinetic() } else { self.problem.kinetic(velocity) },
            potential_available: if all { ledger.elastic() } else { elastic },
            potential_plastic: potential.unwrap_or(elastic),
            potential_attraction: ledger.attraction(),
            dissipated: ledger.dissipated(),
            oblique,
        }
    }
}
