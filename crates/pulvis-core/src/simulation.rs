//! Many bodies, one step after another.

use pulvis_contact::ContactEnergies;
use pulvis_math::Vector3;
use thiserror::Error;

use crate::background::Background;
use crate::contacts::{
    ContactGroup, ContactView, Interactions, MemoryStore, Moving, Partner, Totals, Views, pair_forces,
    view_contacts, wall_forces,
};
use crate::domain::Domain;
use crate::ledger::{Ledger, Running};
use crate::neighbours::{CellGrid, Outdated, Skin};
use crate::particles::{Particle, ParticleId, Particles};
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

/// Why a simulation cannot be set up.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SetupError {
    /// Two bodies can meet for which there is no contact model.
    #[error("no contact model for materials {one} and {other}, which can meet")]
    NoModel {
        /// Place of a material.
        one: u16,
        /// Place of the other.
        other: u16,
    },
    /// A period is too short for the rule of the nearest image.
    #[error(
        "the period {period} m along axis {axis} is shorter than {least} m, twice the search radius; a particle would meet two images of another one"
    )]
    ShortPeriod {
        /// 0 is x, 1 is y, 2 is z.
        axis: usize,
        /// The period [m].
        period: f64,
        /// The shortest one possible [m].
        least: f64,
    },
    /// A wall stands across a periodic direction: a particle that leaves through the boundary would
    /// come back on the wall's other side.
    #[error(
        "wall {wall} stands across axis {axis}, which is periodic; its normal must have no part along a periodic axis"
    )]
    WallAcrossPeriod {
        /// Place of the wall in the list of walls.
        wall: usize,
        /// 0 is x, 1 is y, 2 is z.
        axis: usize,
    },
    /// A wall follows a pressure, but its area is unknown.
    #[error("wall {wall} follows a pressure, but the area of its face is unknown")]
    NoArea {
        /// Place of the wall in the list of walls.
        wall: usize,
    },
    /// The time step is no positive number.
    #[error("the time step is {0} s, expected a number greater than zero")]
    TimeStep(f64),
}

/// Why a step failed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// A position is no number any more.
    #[error(
        "particle {id} was lost in step {step} (t = {time} s): its position is not a number; the time step is too long for the forces that act"
    )]
    Lost {
        /// Which particle.
        id: ParticleId,
        /// In which step.
        step: u64,
        /// When [s].
        time: f64,
    },
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
    pairs: Vec<ContactGroup>,
    wall_contacts: Vec<ContactGroup>,
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
            pairs: Vec::new(),
            wall_contacts: Vec::new(),
            skin: Skin::default(),
            running: Running::default(),
            rebuilds: 0,
        };
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
        self.kick_and_drift();
        self.move_walls();
        self.step += 1;
        match self.skin.outdated(&self.particles.position, self.walls.iter().map(Wall::offset)) {
            Outdated::No => {}
            Outdated::Yes => self.renew_candidates(),
            Outdated::Lost(row) => {
                let id = self.particles.id[row];
                return Err(StepError::Lost { id, step: self.step, time: self.time });
            }
        }
        let (energies, wall_forces, background_power) = self.forces(self.time_step, false);
        self.kick();
        self.finish_walls(&wall_forces);
        self.time += self.time_step;
        self.running.take_in(energies, background_power, self.time_step);
        Ok(())
    }

    /// First half kick and drift. Predicted velocities are those at the end of the step if forces
    /// stay as they are: what dashpots see, at the same instant as the positions.
    fn kick_and_drift(&mut self) {
        let half = 0.5 * self.time_step;
        let particles = &mut self.particles;
        for row in 0..particles.len() {
            let kick = particles.force[row] * (half / particles.mass[row]);
            let turn = particles.torque[row] * (half / particles.inertia(row));
            particles.velocity[row] += kick;
            particles.spin[row] += turn;
            particles.velocity_predicted[row] = particles.velocity[row] + kick;
            particles.spin_predicted[row] = particles.spin[row] + turn;
            particles.position[row] += particles.velocity[row] * self.time_step;
        }
    }

    /// Second half kick.
    fn kick(&mut self) {
        let half = 0.5 * self.time_step;
        let particles = &mut self.particles;
        for row in 0..particles.len() {
            particles.velocity[row] += particles.force[row] * (half / particles.mass[row]);
            let inertia = particles.inertia(row);
            particles.spin[row] += particles.torque[row] * (half / inertia);
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

    fn finish_walls(&mut self, on_particles: &[Vector3]) {
        for (place, &force) in on_particles.iter().enumerate() {
            if !self.walls[place].present {
                continue;
            }
            let area = self.wall_area(place);
            let since = self.time - self.wall_starts[place];
            self.wall_states[place].finish(&self.walls[place], -force, area, since, self.time_step);
        }
    }

    /// Forces and torques of all contacts and of the background, over the step that led here. Answers
    /// with the contacts' energies, the force of each wall on the particles and the drag's power.
    fn forces(&mut self, time_step: f64, at_rest: bool) -> (ContactEnergies, Vec<Vector3>, f64) {
        let particles = &mut self.particles;
        particles.force.fill(Vector3::zero());
        particles.torque.fill(Vector3::zero());
        let moving = Moving {
            radius: &particles.radius,
            mass: &particles.mass,
            position: &particles.position,
            velocity_mid: &particles.velocity,
            velocity: &particles.velocity_predicted,
            spin_mid: &particles.spin,
            spin: &particles.spin_predicted,
        };
        let mut totals = Totals { force: &mut particles.force, torque: &mut particles.torque };
        let mut energies = ContactEnergies::default();
        for group in &mut self.pairs {
            let images = self.domain.images();
            energies += pair_forces(group, moving, images, time_step, &mut totals).energies;
        }
        let mut on_particles = vec![Vector3::zero(); self.walls.len()];
        for group in &mut self.wall_contacts {
            let Partner::Wall(place) = group.partner else { continue };
            let (wall, state) = (&self.walls[place], &self.wall_states[place]);
            let motion = if at_rest { state.motion_at_rest(wall) } else { state.motion_now(wall) };
            let sums = wall_forces(group, moving, motion, time_step, &mut totals);
            energies += sums.energies;
            on_particles[place] += sums.force;
        }
        let background_power = self.background.act(particles);
        (energies, on_particles, background_power)
    }

    /// Forces of the present state, without a step having led here; switches nothing in memory but
    /// what the laws themselves would.
    fn evaluate_at_rest(&mut self) {
        self.particles.velocity_predicted.clone_from(&self.particles.velocity);
        self.particles.spin_predicted.clone_from(&self.particles.spin);
        let (energies, on_particles, background_power) = self.forces(0.0, true);
        self.running.take_in(energies, background_power, 0.0);
        for (state, force) in self.wall_states.iter_mut().zip(on_particles) {
            state.force = -force;
        }
    }

    fn renew_candidates(&mut self) {
        let groups = self.pairs.iter().chain(&self.wall_contacts);
        let memory = MemoryStore::gather(groups, &self.particles.id);
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
        let (grid, order) = CellGrid::sort(&self.domain, &self.particles.position, self.search_radius());
        self.particles.reorder(&order);
        self.pairs = self.empty_groups();
        let particles = &self.particles;
        let images = self.domain.images();
        let skin = self.skin.thickness;
        let place_of: Vec<Option<usize>> = self.group_places();
        let reaches: Vec<f64> = self.pairs.iter().map(|group| group.model.reach()).collect();
        grid.for_each_pair(|one, other| {
            let (i, j) = (one as usize, other as usize);
            let group = self.interactions.group(particles.material[i], particles.material[j]);
            let Some(place) = place_of[group] else { return };
            let cutoff = particles.radius[i] + particles.radius[j] + reaches[place] + skin;
            let separation = images.nearest(particles.position[i] - particles.position[j]);
            if separation.norm_squared() < cutoff * cutoff {
                memory.push_pair(&mut self.pairs[place], (one, other), &particles.id);
            }
        });
        self.rebuild_walls(memory);
        self.skin.renew(&self.particles.position, self.walls.iter().map(Wall::offset));
    }

    fn empty_groups(&self) -> Vec<ContactGroup> {
        let models = (0..self.interactions.groups()).filter_map(|group| self.interactions.model(group));
        models.map(|&model| ContactGroup::new(model, Partner::Particle)).collect()
    }

    /// For each pair of materials, the place of its group among the groups that have a model.
    fn group_places(&self) -> Vec<Option<usize>> {
        let mut next = 0..;
        (0..self.interactions.groups())
            .map(|group| self.interactions.model(group).and_then(|_| next.next()))
            .collect()
    }

    fn rebuild_walls(&mut self, memory: &MemoryStore) {
        let particles = &self.particles;
        let mut materials = particles.material.clone();
        materials.sort_unstable();
        materials.dedup();
        self.wall_contacts.clear();
        for (place, wall) in self.walls.iter().enumerate().filter(|(_, wall)| wall.present) {
            for &material in &materials {
                let Some(&model) = self.interactions.get(material, wall.material) else { continue };
                let mut group = ContactGroup::new(model, Partner::Wall(place));
                let limit = model.reach() + self.skin.thickness;
                for row in (0..particles.len()).filter(|&row| particles.material[row] == material) {
                    let gap =
                        particles.position[row].dot(wall.normal) - wall.offset() - particles.radius[row];
                    if gap < limit {
                        memory.push_wall(&mut group, place, row as u32, &particles.id);
                    }
                }
                self.wall_contacts.push(group);
            }
        }
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

    /// Draws up the energy ledger.
    pub fn ledger(&mut self) -> Ledger {
        let particles = &self.particles;
        let (mut translation, mut rotation, mut discretisation) = (0.0, 0.0, 0.0);
        for row in 0..particles.len() {
            let (mass, inertia) = (particles.mass[row], particles.inertia(row));
            translation += 0.5 * mass * particles.velocity[row].norm_squared();
            rotation += 0.5 * inertia * particles.spin[row].norm_squared();
            discretisation +=
                particles.force[row].norm_squared() / mass + particles.torque[row].norm_squared() / inertia;
        }
        let held = self.running.contacts;
        let mut ledger = Ledger {
            kinetic_translation: translation,
            kinetic_rotation: rotation,
            kinetic_discretisation: -0.125 * self.time_step * self.time_step * discretisation,
            elastic_normal: held.elastic_normal,
            elastic_sliding: held.elastic_sliding,
            elastic_rolling: held.elastic_rolling,
            elastic_torsion: held.elastic_torsion,
            adhesive: held.adhesive_potential,
            gravity: self.background.potential(particles) + self.running.gravity_wrapped,
            dissipated_plastic: held.dissipated_plastic,
            dissipated_adhesive: held.dissipated_adhesive,
            dissipated_viscous: self.running.viscous,
            dissipated_sliding: held.dissipated_sliding,
            dissipated_rolling: held.dissipated_rolling,
            dissipated_torsion: held.dissipated_torsion,
            dissipated_background: self.running.background,
            work_walls: self.wall_states.iter().map(|state| state.work_prescribed).sum(),
            work_servo: self.wall_states.iter().map(|state| state.work_servo).sum(),
            switched: self.running.switched,
            initial: self.running.initial,
            scale: 0.0,
        };
        // Adhesive and gravity potentials have arbitrary zeros, so only energy that moves counts.
        let turnover = ledger.kinetic() + ledger.elastic() + ledger.dissipated();
        self.running.scale = self.running.scale.max(turnover);
        ledger.scale = self.running.scale;
        ledger
    }

    /// Hands every contact that acts to `see`, pairs first, then walls.
    pub fn for_each_contact(&self, see: &mut dyn FnMut(&ContactView)) {
        let particles = &self.particles;
        let moving = Moving {
            radius: &particles.radius,
            mass: &particles.mass,
            position: &particles.position,
            velocity_mid: &particles.velocity,
            velocity: &particles.velocity,
            spin_mid: &particles.spin,
            spin: &particles.spin,
        };
        for group in self.pairs.iter().chain(&self.wall_contacts) {
            let wall = match group.partner {
                Partner::Particle => None,
                Partner::Wall(place) => Some(self.wall_states[place].motion_at_rest(&self.walls[place])),
            };
            let (ids, images) = (&particles.id, self.domain.images());
            view_contacts(Views { group, moving, ids, images, wall }, see);
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
        let groups = self.pairs.iter().chain(&self.wall_contacts);
        self.particles.memory_size() + groups.map(ContactGroup::memory_size).sum::<usize>()
    }

    /// Candidate contacts in the list.
    pub fn candidates(&self) -> usize {
        self.pairs.iter().chain(&self.wall_contacts).map(ContactGroup::len).sum()
    }
}

/// Switching between stages. Every switch keeps the ledger: what the system holds more or less
/// afterwards is booked as switched.
impl Simulation {
    /// Sets other contact models; contacts keep what both the old and the new law remember.
    pub fn set_interactions(&mut self, interactions: Interactions) -> Result<(), SetupError> {
        let before = std::mem::replace(&mut self.interactions, interactions);
        if let Err(error) = self.check_models().and_then(|()| self.check_periods()) {
            self.interactions = before;
            return Err(error);
        }
        self.switch(|simulation| simulation.renew_candidates());
        Ok(())
    }

    /// Sets another gravity and drag.
    pub fn set_background(&mut self, background: Background) {
        self.switch(|simulation| {
            simulation.background = background;
            simulation.running.gravity_wrapped = 0.0;
        });
    }

    /// Sets another time step [s].
    pub fn set_time_step(&mut self, time_step: f64) -> Result<(), SetupError> {
        if !(time_step > 0.0 && time_step.is_finite()) {
            return Err(SetupError::TimeStep(time_step));
        }
        self.switch(|simulation| simulation.time_step = time_step);
        Ok(())
    }

    /// Lets a wall move in another way from now on.
    pub fn set_wall_motion(&mut self, place: usize, motion: WallMotion) {
        // Dashpots see the wall's new velocity at once.
        self.switch(|simulation| {
            simulation.walls[place].motion = motion;
            simulation.wall_states[place].start(&motion);
            simulation.wall_starts[place] = simulation.time;
        });
    }

    /// Takes a wall away, or puts it back where it stood, its motion beginning anew. A wall that is
    /// away does not move.
    pub fn set_wall_present(&mut self, place: usize, present: bool) {
        self.switch(|simulation| {
            if present && !simulation.walls[place].present {
                simulation.wall_starts[place] = simulation.time;
                simulation.wall_states[place].start(&simulation.walls[place].motion);
            } else if !present {
                simulation.wall_states[place].stop();
            }
            simulation.walls[place].present = present;
            simulation.renew_candidates();
        });
    }

    /// Sets how far beyond their reach candidates are listed [m]; at the start a fifth of the mean
    /// radius. Thicker lists are renewed less often but hold more candidates that do not touch. A
    /// skin must be thicker than what any particle moves in a step.
    pub fn set_skin(&mut self, thickness: f64) -> Result<(), SetupError> {
        // What is no number counts as no skin.
        let before = std::mem::replace(&mut self.skin.thickness, thickness.max(0.0));
        if let Err(error) = self.check_periods() {
            self.skin.thickness = before;
            return Err(error);
        }
        self.switch(|simulation| simulation.renew_candidates());
        Ok(())
    }

    fn switch(&mut self, change: impl FnOnce(&mut Self)) {
        let before = self.ledger().closing_error();
        change(self);
        self.evaluate_at_rest();
        let after = self.ledger().closing_error();
        self.running.switched += after - before;
    }
}
