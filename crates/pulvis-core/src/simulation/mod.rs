//! Many bodies, one step after another.

mod errors;
mod observe;
mod switch;

pub use errors::{SetupError, StepError};

use pulvis_math::Vector3;

use crate::background::Background;
use crate::contacts::{
    Advance, ContactTable, Interactions, MemoryStore, Moving, Surroundings, WallMotionNow,
};
use crate::domain::Domain;
use crate::integrator::{collect_and_kick, kick_and_drift};
use crate::ledger::Running;
use crate::neighbours::{CellGrid, Outdated, Skin};
use crate::particles::{Particle, Particles};
use crate::team::Team;
use crate::walls::{Extent, FaceArea, Wall, WallMotion, WallState};

/// What a simulation starts from.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The particles; their ids are their places in this list.
    pub particles: Vec<Particle>,
    /// Contact models by pair of materials.
    pub interactions: Interactions,
    /// Walls.
    pub walls: Vec<Wall>,
    /// Periodic directions.
    pub domain: Domain,
    /// Gravity and drag.
    pub background: Background,
    /// Time step [s].
    pub time_step: f64,
}

/// A running simulation.
#[derive(Clone, Debug)]
pub struct Simulation {
    pub(crate) particles: Particles,
    interactions: Interactions,
    walls: Vec<Wall>,
    wall_states: Vec<WallState>,
    /// When each wall's present motion began [s].
    wall_starts: Vec<f64>,
    domain: Domain,
    background: Background,
    time_step: f64,
    step: u64,
    time: f64,
    contacts: ContactTable,
    team: Team,
    /// Scratch: how the walls lie and move, and their forces on the particles, in this step.
    walls_now: Vec<WallMotionNow>,
    on_particles: Vec<Vector3>,
    skin: Skin,
    running: Running,
    rebuilds: u64,
}

/// The skin of the candidate list over the mean radius. Thicker lists are renewed less often but hold
/// more candidates that do not touch.
const SKIN_PER_RADIUS: f64 = 0.2;

impl Simulation {
    /// Sets the simulation up and computes the forces of its initial state.
    pub fn new(setup: Setup) -> Result<Self, SetupError> {
        let Setup { particles, interactions, walls, domain, background, time_step } = setup;
        if !(time_step > 0.0 && time_step.is_finite()) {
            return Err(SetupError::TimeStep(time_step));
        }
        let mut simulation = Self {
            particles: Particles::new(&particles),
            interactions,
            wall_states: vec![WallState::default(); walls.len()],
            wall_starts: vec![0.0; walls.len()],
            walls,
            domain,
            background,
            time_step,
            step: 0,
            time: 0.0,
            contacts: ContactTable::default(),
            team: Team::default(),
            walls_now: Vec::new(),
            on_particles: Vec::new(),
            skin: Skin::default(),
            running: Running::default(),
            rebuilds: 0,
        };
        simulation.on_particles = vec![Vector3::zero(); simulation.walls.len()];
        simulation.check_models()?;
        simulation.check_walls()?;
        let count = simulation.particles.len().max(1) as f64;
        simulation.skin.thickness = SKIN_PER_RADIUS * simulation.particles.radius.iter().sum::<f64>() / count;
        simulation.check_periods()?;
        for (wall, state) in simulation.walls.iter().zip(&mut simulation.wall_states) {
            state.start(&wall.motion);
        }
        simulation.rebuild(&MemoryStore::default());
        simulation.evaluate_at_rest();
        simulation.running.forget_losses();
        simulation.running.initial = simulation.ledger().held();
        Ok(simulation)
    }

    fn check_models(&self) -> Result<(), SetupError> {
        let mut present: Vec<u16> = self.particles.material.clone();
        present.sort_unstable();
        present.dedup();
        let walls = self.walls.iter().map(|wall| wall.material);
        for &one in &present {
            for other in present.iter().copied().chain(walls.clone()) {
                if self.interactions.get(one, other).is_none() {
                    return Err(SetupError::NoModel { one, other });
                }
            }
        }
        Ok(())
    }

    fn check_walls(&self) -> Result<(), SetupError> {
        for (place, wall) in self.walls.iter().enumerate() {
            // Normals of rotated boxes come with rounding errors.
            let across = |&axis: &usize| wall.normal[axis].abs() > 1e-12;
            if let Some(axis) = (0..3).filter(|&axis| self.domain.period(axis).is_some()).find(across) {
                return Err(SetupError::WallAcrossPeriod { wall: place, axis });
            }
            if matches!(wall.motion, WallMotion::Servo(_)) && wall.area == FaceArea::Unknown {
                return Err(SetupError::NoArea { wall: place });
            }
        }
        Ok(())
    }

    fn check_periods(&self) -> Result<(), SetupError> {
        let least = 2.0 * self.search_radius();
        for axis in 0..3 {
            match self.domain.period(axis) {
                Some(period) if period < least || period.is_nan() => {
                    return Err(SetupError::ShortPeriod { axis, period, least });
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Two centres farther apart than this cannot act on each other before the next list [m].
    fn search_radius(&self) -> f64 {
        let largest = self.particles.radius.iter().copied().fold(0.0, f64::max);
        2.0 * largest + self.interactions.reach() + self.skin.thickness
    }

    /// One time step: kick and drift, walls, neighbours, forces, kick, ledger.
    pub fn step(&mut self) -> Result<(), StepError> {
        let farthest = kick_and_drift(&mut self.particles, self.skin.listed(), self.time_step, &self.team);
        self.move_walls();
        self.step += 1;
        let mut closed = self.skin.closed(farthest, self.walls.iter().map(Wall::offset));
        match self.skin.outdated(closed, &self.particles.position) {
            Outdated::No => {}
            Outdated::Yes => {
                self.renew_candidates();
                closed = 0.0;
            }
            Outdated::Lost(row) => {
                let id = self.particles.id[row];
                return Err(StepError::Lost { id, step: self.step, time: self.time });
            }
        }
        let half = 0.5 * self.time_step;
        let advance = Advance { closed, time_step: self.time_step };
        let background_power = self.forces_and_kick(advance, half, false);
        self.finish_walls();
        self.time += self.time_step;
        self.running.take_in(self.contacts.energies(), background_power, self.time_step);
        Ok(())
    }

    fn move_walls(&mut self) {
        for place in 0..self.walls.len() {
            if !self.walls[place].present {
                continue;
            }
            let area = self.wall_area(place);
            let since = self.time - self.wall_starts[place];
            self.wall_states[place].advance(&mut self.walls[place], area, since, self.time_step);
        }
    }

    fn finish_walls(&mut self) {
        for place in 0..self.walls.len() {
            if !self.walls[place].present {
                continue;
            }
            let area = self.wall_area(place);
            let since = self.time - self.wall_starts[place];
            let force = -self.on_particles[place];
            self.wall_states[place].finish(&self.walls[place], force, area, since, self.time_step);
        }
    }

    /// Forces and torques of all contacts and of the background, and the kick that they give over
    /// `half` a step [s]. Answers with the drag's power [W]; each wall's force on the particles is
    /// left in its place.
    fn forces_and_kick(&mut self, advance: Advance, half: f64, at_rest: bool) -> f64 {
        self.walls_now.clear();
        for (wall, state) in self.walls.iter().zip(&self.wall_states) {
            let motion = if at_rest { state.motion_at_rest(wall) } else { state.motion_now(wall) };
            self.walls_now.push(motion);
        }
        let particles = &mut self.particles;
        let moving = Moving {
            radius: &particles.radius,
            mass: &particles.mass,
            position: &particles.position,
            velocity_mid: &particles.velocity,
            velocity: &particles.velocity_predicted,
            spin_mid: &particles.spin,
            spin: &particles.spin_predicted,
        };
        let images = self.domain.images();
        self.contacts.sweep(moving, images, &self.walls_now, advance, &self.team);
        self.on_particles.fill(Vector3::zero());
        self.contacts.add_wall_forces(&mut self.on_particles);
        collect_and_kick(particles, &self.contacts, &self.background, half, &self.team)
    }

    /// Forces of the present state, without a step having led here; switches nothing in memory but
    /// what the laws themselves would.
    fn evaluate_at_rest(&mut self) {
        self.particles.velocity_predicted.clone_from(&self.particles.velocity);
        self.particles.spin_predicted.clone_from(&self.particles.spin);
        // No block is passed over: whatever was switched may act at once.
        let advance = Advance { closed: f64::INFINITY, time_step: 0.0 };
        let background_power = self.forces_and_kick(advance, 0.0, true);
        self.running.take_in(self.contacts.energies(), background_power, 0.0);
        for (state, &force) in self.wall_states.iter_mut().zip(&self.on_particles) {
            state.force = -force;
        }
    }

    fn renew_candidates(&mut self) {
        let memory = self.contacts.memory(&self.particles);
        self.rebuild(&memory);
        self.rebuilds += 1;
    }

    /// Puts the particles into cell order and lists all candidates within reach and skin.
    fn rebuild(&mut self, memory: &MemoryStore) {
        let gravity = self.background.gravity;
        for (position, mass) in self.particles.position.iter_mut().zip(&self.particles.mass) {
            let wrapped = self.domain.wrapped(*position);
            // Falling through a periodic boundary is falling on: the potential must not jump.
            self.running.gravity_wrapped += mass * gravity.dot(wrapped - *position);
            *position = wrapped;
        }
        let margin = self.interactions.reach() + self.skin.thickness;
        let Particles { position, radius, .. } = &self.particles;
        let (grid, order) = CellGrid::sort(&self.domain, position, radius, margin);
        self.particles.reorder(&order);
        let around = Surroundings {
            particles: &self.particles,
            interactions: &self.interactions,
            walls: &self.walls,
            images: self.domain.images(),
            skin: self.skin.thickness,
        };
        self.contacts.rebuild(around, &grid, memory);
        self.skin.renew(&self.particles.position, self.walls.iter().map(Wall::offset));
    }

    /// The area over which a wall's force is spread [m²], where it is known.
    pub fn wall_area(&self, place: usize) -> Option<f64> {
        let extent = |extent: &Extent| match *extent {
            Extent::Given(length) => length,
            Extent::Between(one, other) => {
                let (one, other) = (&self.walls[one], &self.walls[other]);
                (other.point - one.point).dot(one.normal).abs()
            }
        };
        match &self.walls[place].area {
            FaceArea::Unknown => None,
            FaceArea::Given(area) => Some(*area),
            FaceArea::Product([one, other]) => Some(extent(one) * extent(other)),
        }
    }

    /// The particles.
    pub fn particles(&self) -> &Particles {
        &self.particles
    }

    /// The walls as they stand now.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// Force of the particles on a wall [N].
    pub fn wall_force(&self, place: usize) -> Vector3 {
        self.wall_states[place].force
    }

    /// Velocity of a wall [m/s].
    pub fn wall_velocity(&self, place: usize) -> Vector3 {
        self.wall_states[place].velocity
    }

    /// Space and its periods.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Time step [s].
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// How often the list of candidates was renewed.
    pub fn rebuilds(&self) -> u64 {
        self.rebuilds
    }

    /// Memory of particles, candidates and contact memory [byte].
    pub fn memory_size(&self) -> usize {
        self.particles.memory_size() + self.contacts.memory_size()
    }

    /// Candidate contacts in the list.
    pub fn candidates(&self) -> usize {
        self.contacts.candidates()
    }

    /// Number of threads that do the work.
    pub fn threads(&self) -> usize {
        self.team.threads()
    }

    /// The threads that do the work: see [`Team::run`].
    pub fn team(&self) -> &Team {
        &self.team
    }
}
