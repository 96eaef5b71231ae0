//! The collision as the engine integrates it: two real particles, or one and a wall, in a simulation
//! with steps of one length.

use super::error::CollisionError;
use super::outcome::{Collision, Observation, Outcome, Regime, Sample, Sampling};
use super::problem::Problem;
use crate::branch::ruling_branch;
use pulvis_contact::NormalMotion;
use pulvis_core::walls::Wall;
use pulvis_core::{Background, Domain, Interactions, Particle, Setup, Simulation};
use pulvis_input::collision::{Bodies, Sphere};
use pulvis_math::Vector3;

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
}

/// A collision under way.
struct Run<'p> {
    /// What the contact remembers; zeros while it is none.
    columns: Vec<f64>,
    problem: &'p Problem<'p>,
    observation: &'p Observation,
    simulation: Simulation,
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
        let mut run = Self {
            columns: vec![0.0; problem.contact.memory_layout().columns()],
            problem,
            observation,
            simulation: Simulation::new(setup(problem, time_step, observation.phase))?,
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
        run.take_in();
        run.record();
        Ok(run)
    }

    fn step(&mut self) -> Result<(), CollisionError> {
        if self.simulation.steps() >= MOST_STEPS {
            let (velocity, steps, time) = (self.problem.velocity, self.simulation.steps(), self.now.time);
            let damped = self.problem.is_damped();
            return Err(CollisionError::TooLong { velocity, steps, time, damped });
        }
        self.simulation.step()?;
        self.before = self.now;
        self.take_in();
        self.record();
        self.judge();
        Ok(())
    }

    /// Takes in the state of the simulation, and what the contact remembers.
    fn take_in(&mut self) {
        self.now = self.look();
        let mut columns = std::mem::take(&mut self.columns);
        columns.fill(0.0);
        self.simulation.for_each_contact(&mut |contact| columns.copy_from_slice(contact.memory));
        self.columns = columns;
    }

    /// Reads the state off the simulation.
    fn look(&self) -> Instant {
        let particles = self.simulation.particles();
        let rows = particles.rows_by_id();
        let (position, velocity, force) = (particles.positions(), particles.velocities(), particles.forces());
        let i = rows[0];
        let (overlap, rate) = match self.problem.bodies {
            Bodies::Pair([first, second]) => {
                let j = rows[1];
                let distance = position[i].x - position[j].x;
                (first.radius + second.radius - distance, velocity[j].x - velocity[i].x)
            }
            Bodies::Wall(sphere) => (sphere.radius - position[i].x, -velocity[i].x),
        };
        Instant { time: self.simulation.time(), overlap, velocity: rate, force: force[i].x }
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
        let before = self.problem.kinetic(self.problem.velocity);
        let rebound = regime == Regime::Rebound;
        let turned = self.before.velocity < 0.0 && self.now.velocity >= 0.0;
        let stop = if turned { self.turning_overlap() } else { self.now.overlap };
        Outcome {
            regime,
            stop_branch: (!rebound).then(|| self.branch(self.before.overlap)),
            restitution: if rebound { -self.now.velocity / self.problem.velocity } else { 0.0 },
            overlap_max: self.overlap_max,
            overlap_end: if rebound { 0.0 - self.problem.interaction_range() } else { stop },
            contact_duration: self.opening_time.zip(self.touch_time).map(|(end, start)| end - start),
            energy_dissipated: ledger.dissipated(),
            energy_error: -ledger.closing_error() / before.max(ledger.scale),
        }
    }

    /// The branch on which the bodies are, or that of the attraction where they are apart.
    fn branch(&self, overlap: f64) -> &'static str {
        ruling_branch(self.problem.contact, &self.problem.pair, overlap, &self.columns)
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
        let Instant { time, overlap, velocity, force } = self.now;
        let (normal, pair) = (&self.problem.contact.normal, &self.problem.pair);
        let branch = normal.branch(pair, overlap, &self.columns).0;
        let potential = normal.branch_potential(branch, &NormalMotion::at_rest(pair, overlap), &self.columns);
        Sample {
            time,
            overlap,
            velocity,
            force,
            delta_max: normal.remembered_overlap(&self.columns).unwrap_or(self.overlap_max),
            kinetic: self.problem.kinetic(velocity),
            potential_available: ledger.elastic_normal,
            potential_plastic: potential.unwrap_or(ledger.elastic_normal),
            potential_attraction: ledger.adhesive,
            dissipated: ledger.dissipated(),
        }
    }
}

/// The bodies on their way, `phase` of a step before they come within reach, their centre of mass at rest.
fn setup(problem: &Problem<'_>, time_step: f64, phase: f64) -> Setup {
    let along = |x: f64| Vector3::new(x, 0.0, 0.0);
    let particle = |sphere: &Sphere, position: f64, velocity: f64| Particle {
        material: 0,
        radius: sphere.radius,
        mass: sphere.mass,
        position: along(position),
        velocity: along(velocity),
        angular_velocity: along(0.0),
    };
    let velocity = problem.velocity;
    let gap = phase * velocity * time_step - problem.start_overlap();
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, *problem.contact);
    let (particles, walls) = match problem.bodies {
        Bodies::Pair([i, j]) => {
            let mass = i.mass + j.mass;
            let first = particle(i, i.radius + gap, -velocity * j.mass / mass);
            let second = particle(j, -j.radius, velocity * i.mass / mass);
            (vec![first, second], vec![])
        }
        Bodies::Wall(sphere) => {
            let wall = Wall::fixed("wall", 0, along(0.0), along(1.0));
            (vec![particle(sphere, sphere.radius + gap, -velocity)], vec![wall])
        }
    };
    Setup {
        particles,
        interactions,
        walls,
        domain: Domain::unbounded(),
        background: Background::default(),
        time_step,
    }
}
