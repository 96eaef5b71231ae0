//! Many bodies, one step after another.

mod errors;
mod observe;
mod switch;

pub use errors::{SetupError, StepError};

use pulvis_math::{InstructionSet, Quad, Vector3};

use crate::background::Background;
use crate::contacts::{Advance, ContactTable, Interactions, MemoryStore, Surroundings, WallMotionNow};
use crate::domain::Domain;
use crate::integrator::{Columns, Kick, KickAndDrift, Step};
use crate::ledger::Running;
use crate::neighbours::{CellGrid, Outdated, Skin};
use crate::particles::{Load, MaterialIndex, Particle, Particles};
use crate::phases::{Phases, Stopwatch};
use crate::shared::Shared;
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
    /// What contacts remember while they are listed anew.
    memory: MemoryStore,
    team: Team,
    instructions: InstructionSet,
    accounting: bool,
    /// Where the time goes, if anybody wants to know; up to the last list of candidates.
    phases: Option<Phases>,
    /// The materials of all particles, each once.
    materials: Vec<MaterialIndex>,
    /// Scratch: what came out of the integration of each piece.
    outcomes: Vec<Outcome>,
    /// Scratch: how the walls lie and move, and their forces on the particles, in this step.
    walls_now: Vec<WallMotionNow>,
    on_particles: Vec<Vector3>,
    skin: Skin,
    /// Whether the skin is the engine's own choice.
    chooses_skin: bool,
    mean_radius: f64,
    running: Running,
    rebuilds: u64,
}

/// What comes out of the integration of a piece of rows.
#[derive(Clone, Copy, Debug, Default)]
struct Outcome {
    /// Power that the drag takes [W].
    power: f64,
    /// Largest square of the distance of any particle from where it was listed [m²].
    farthest: f64,
    /// Time spent since the candidates were listed [s].
    seconds: f64,
}

/// The skin of the candidate list over the mean radius, in a packing and in a gas. Thicker lists are
/// renewed less often but hold more candidates that do not touch; a gas has few.
const SKIN_OF_PACKING: f64 = 0.3;
const SKIN_OF_GAS: f64 = 0.8;
/// The skin where periods leave no room for a better one.
const SKIN_OF_SHORT_PERIODS: f64 = 0.2;
/// Candidates per particle below which the one is taken for a gas, and above which it is for a packing.
const GAS: f64 = 1.0;
const PACKING: f64 = 3.0;

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
            memory: MemoryStore::default(),
            team: Team::default(),
            instructions: InstructionSet::widest(),
            accounting: true,
            phases: None,
            materials: Vec::new(),
            outcomes: Vec::new(),
            walls_now: Vec::new(),
            on_particles: Vec::new(),
            skin: Skin::default(),
            chooses_skin: true,
            mean_radius: 0.0,
            running: Running::default(),
            rebuilds: 0,
        };
        simulation.materials.clone_from(&simulation.particles.material);
        simulation.materials.sort_unstable();
        simulation.materials.dedup();
        simulation.on_particles = vec![Vector3::zero(); simulation.walls.len()];
        simulation.check_models()?;
        simulation.check_walls()?;
        let count = simulation.particles.len().max(1) as f64;
        simulation.mean_radius = simulation.particles.radius.iter().sum::<f64>() / count;
        simulation.skin.thickness = SKIN_OF_PACKING * simulation.mean_radius;
        if simulation.check_periods().is_err() {
            simulation.skin.thickness = SKIN_OF_SHORT_PERIODS * simulation.mean_radius;
        }
        simulation.check_periods()?;
        for (wall, state) in simulation.walls.iter().zip(&mut simulation.wall_states) {
            state.start(&wall.motion);
        }
        simulation.rebuild();
        simulation.evaluate_at_rest();
        simulation.running.forget_losses();
        simulation.running.initial = simulation.ledger().held();
        Ok(simulation)
    }

    fn check_models(&self) -> Result<(), SetupError> {
        let walls = self.walls.iter().map(|wall| wall.material);
        for &one in &self.materials {
            for other in self.materials.iter().copied().chain(walls.clone()) {
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

    /// One time step.
    ///
    /// # Errors
    /// See [`advance`](Self::advance).
    pub fn step(&mut self) -> Result<(), StepError> {
        self.advance(1)
    }

    /// Time steps: kick and drift, walls, neighbours, forces, kick, ledger. The same as so many single
    /// [steps](Self::step), but faster: the second kick of a step and the first one of the next are
    /// made in one go, while the particles are in the cache.
    ///
    /// # Errors
    /// A position is no number any more.
    pub fn advance(&mut self, steps: u64) -> Result<(), StepError> {
        if steps == 0 {
            return Ok(());
        }
        let mut farthest = self.kick_and_drift();
        for left in (0..steps).rev() {
            self.move_walls();
            self.step += 1;
            let closed = self.renew_if_outdated(farthest)?;
            let background_power;
            (background_power, farthest) = self.forces_and_kick(closed, false, left > 0);
            self.finish_walls();
            self.time += self.time_step;
            self.running.take_in(self.contacts.energies(), background_power, self.time_step);
        }
        Ok(())
    }

    /// First half kick and drift. Answers with the largest square of the distance of any particle from
    /// where it was listed [m²].
    fn kick_and_drift(&mut self) -> f64 {
        let pieces = self.contacts.pieces();
        let (instructions, step) = (self.instructions, self.step_of_rows());
        let columns = Columns::of(&mut self.particles, self.skin.listed());
        let timed = self.phases.is_some();
        self.team.for_each(&mut self.outcomes, |number, outcome| {
            let mut clock = Stopwatch::start(timed);
            let rows = pieces[number].rows.clone();
            // SAFETY: pieces have different rows.
            outcome.farthest = unsafe {
                let loads = columns.loads.range_mut(rows.clone());
                instructions.run(KickAndDrift::new(columns, rows, loads, step))
            };
            clock.lap(&mut outcome.seconds);
        });
        farthest(&self.outcomes)
    }

    fn step_of_rows(&self) -> Step {
        let turning = self.interactions.models().any(|model| model.composition.has_resistance_dashpot());
        Step { time_step: self.time_step, predicts_spins: turning || self.background.has_drag() }
    }

    /// Lists the candidates anew if particles have moved too far, the square of the longest way being
    /// `farthest` [m²]. Answers by how much a gap can have closed since they were listed [m].
    fn renew_if_outdated(&mut self, farthest: f64) -> Result<f64, StepError> {
        let closed = self.skin.closed(farthest, self.walls.iter().map(Wall::offset));
        match self.skin.outdated(closed, &self.particles.place) {
            Outdated::No => Ok(closed),
            Outdated::Yes => {
                self.renew_candidates();
                Ok(0.0)
            }
            Outdated::Lost(row) => {
                let id = self.particles.id[row];
                Err(StepError::Lost { id, step: self.step, time: self.time })
            }
        }
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

    /// Forces and torques of all contacts and of the background, and the second half kick; with
    /// `onwards` also the first half kick and the drift of the next step. `closed` is by how much a gap
    /// can have closed since the candidates were listed [m]; `at_rest` no time has passed.
    ///
    /// Answers with the drag's power [W] and the largest square of the distance of any particle from
    /// where it was listed [m²]; each wall's force on the particles is left in its place.
    fn forces_and_kick(&mut self, closed: f64, at_rest: bool, onwards: bool) -> (f64, f64) {
        self.walls_now.clear();
        for (wall, state) in self.walls.iter().zip(&self.wall_states) {
            let motion = if at_rest { state.motion_at_rest(wall) } else { state.motion_now(wall) };
            self.walls_now.push(motion);
        }
        let time_step = if at_rest { 0.0 } else { self.time_step };
        let advance = Advance {
            closed,
            time_step,
            timed: self.phases.is_some(),
            images: self.domain.images(),
            ledger: self.accounting,
            instructions: self.instructions,
        };
        let step = self.step_of_rows();
        let columns = Columns::of(&mut self.particles, self.skin.listed());
        let (instructions, background) = (self.instructions, &self.background);
        let outcomes = Shared::new(&mut self.outcomes);
        self.contacts.sweep(
            columns.loads,
            columns.moving(),
            &self.walls_now,
            &advance,
            &self.team,
            !onwards,
            |number, rows, loads| {
                // SAFETY: each piece is finished once, and nobody reads its rows any more.
                unsafe {
                    let outcome = outcomes.get_mut(number);
                    let mut clock = Stopwatch::start(advance.timed);
                    let half = 0.5 * time_step;
                    let kick = Kick::new(columns, rows.clone(), &mut *loads, background, half);
                    outcome.power = instructions.run(kick);
                    if onwards {
                        let drift = KickAndDrift::new(columns, rows, loads, step);
                        outcome.farthest = instructions.run(drift);
                    }
                    clock.lap(&mut outcome.seconds);
                }
            },
        );
        self.on_particles.fill(Vector3::zero());
        self.contacts.add_wall_forces(&mut self.on_particles);
        let power = self.outcomes.iter().map(|outcome| outcome.power).sum();
        (power, farthest(&self.outcomes))
    }

    /// Forces of the present state, without a step having led here; switches nothing in memory but
    /// what the laws themselves would.
    fn evaluate_at_rest(&mut self) {
        let particles = &mut self.particles;
        for (predicted, now) in particles.velocity_predicted.iter_mut().zip(&particles.velocity) {
            predicted.vector = now.vector;
        }
        for (predicted, now) in particles.spin_predicted.iter_mut().zip(&particles.spin) {
            predicted.vector = now.vector;
        }
        // No block is passed over: whatever was switched may act at once.
        let (background_power, _) = self.forces_and_kick(f64::INFINITY, true, false);
        self.running.take_in(self.contacts.energies(), background_power, 0.0);
        for (state, &force) in self.wall_states.iter_mut().zip(&self.on_particles) {
            state.force = -force;
        }
    }

    fn renew_candidates(&mut self) {
        let mut clock = Stopwatch::start(self.phases.is_some());
        self.phases = self.phases();
        self.choose_skin();
        self.contacts.remember(&mut self.memory, self.particles.len());
        self.rebuild();
        self.rebuilds += 1;
        if let Some(phases) = &mut self.phases {
            clock.lap(&mut phases.neighbours);
        }
    }

    /// Takes the skin that suits the number of candidates in the present list, as far as periods allow.
    fn choose_skin(&mut self) {
        if !self.chooses_skin {
            return;
        }
        let candidates = self.candidates() as f64 / self.particles.len().max(1) as f64;
        let suited = if candidates < GAS {
            SKIN_OF_GAS
        } else if candidates > PACKING {
            SKIN_OF_PACKING
        } else {
            return;
        };
        let before = std::mem::replace(&mut self.skin.thickness, suited * self.mean_radius);
        if self.check_periods().is_err() {
            self.skin.thickness = before;
        }
    }

    /// Puts the particles into cell order and lists all candidates within reach and skin.
    fn rebuild(&mut self) {
        let gravity = self.background.gravity;
        for (place, mass) in self.particles.place.iter_mut().zip(&self.particles.mass) {
            let wrapped = self.domain.wrapped(place.vector);
            // Falling through a periodic boundary is falling on: the potential must not jump.
            self.running.gravity_wrapped += mass * gravity.dot(wrapped - place.vector);
            place.vector = wrapped;
        }
        let margin = self.interactions.reach() + self.skin.thickness;
        let (grid, order) = CellGrid::sort(&self.domain, &self.particles.place, margin);
        self.particles.reorder(&order);
        let around = Surroundings {
            particles: &self.particles,
            order: &order,
            materials: &self.materials,
            interactions: &self.interactions,
            walls: &self.walls,
            images: self.domain.images(),
            skin: self.skin.thickness,
            instructions: self.instructions,
        };
        let places = self.contacts.rebuild(&around, &grid, &self.memory, &self.team);
        self.particles.loads.clear();
        self.particles.loads.resize(places, Load::default());
        self.outcomes.clear();
        self.outcomes.resize(self.contacts.pieces().len(), Outcome::default());
        self.skin.renew(&self.particles.place, self.walls.iter().map(Wall::offset));
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

    /// Where the time goes since [`watch_phases`](Self::watch_phases) was called, `None` if it was not.
    pub fn phases(&self) -> Option<Phases> {
        let mut sum = self.phases?;
        for (piece, outcome) in self.contacts.pieces().iter().zip(&self.outcomes) {
            sum += piece.phases;
            sum.integration += outcome.seconds;
        }
        Some(sum)
    }

    /// How often the list of candidates was renewed.
    pub fn rebuilds(&self) -> u64 {
        self.rebuilds
    }

    /// Memory of particles, candidates and contact memory [byte].
    pub fn memory_size(&self) -> usize {
        // The skin keeps one more quad for each particle.
        let rows = self.particles.len() * (Particles::BYTES + size_of::<Quad>());
        rows + size_of_val(&self.particles.loads[..]) + self.contacts.memory_size()
    }

    /// Candidate contacts in the list.
    pub fn candidates(&self) -> usize {
        self.contacts.candidates()
    }

    /// Number of threads that do the work.
    pub fn threads(&self) -> usize {
        self.team.threads()
    }
}

/// The largest of the pieces' squares of distances [m²].
fn farthest(outcomes: &[Outcome]) -> f64 {
    outcomes.iter().map(|outcome| outcome.farthest).fold(0.0, f64::max)
}
