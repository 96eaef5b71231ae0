//! A simulation of many bodies.

mod accessors;
mod cell;
mod checks;
mod columns;
mod diagnosis;
mod edit;
mod electrostatics;
mod errors;
mod groups;
mod insertion;
mod limits;
mod lists;
mod observation;
mod observe;
mod ranks;
mod state;
mod steps;
mod sums;
mod switch;

pub use diagnosis::DeepContact;
pub use errors::{Alarm, SetupError, StepError};
pub use groups::{Group, GroupLoad};
pub use limits::Limits;
pub use state::{CellState, GroupRecord, ListState, ParticleState, State, StateError, WallRecord};

use pulvis_contact::ROOM_TEMPERATURE;
use pulvis_math::{InstructionSet, Vector3, max_or_nan};

use self::cell::Cell;
use self::sums::{PassTotals, RowSums};
use crate::chunk_tree::ChunkTree;
use crate::columns::NamedColumn;
use crate::contacts::{BrokenBonds, ContactTable, Interactions, MemoryStore};
use crate::electrostatics::Charges;
use crate::integrator::Kicked;
use crate::ledger::Running;
use crate::neighbours::{Moved, Skin};
use crate::particles::{MaterialIndex, Particle, Particles};
use crate::phases::Phases;
use crate::ranks::Ranks;
use crate::thread_pool::ThreadPool;
use crate::walls::{
    FaceArea, Shape, Wall, WallFeature, WallForce, WallMotion, WallNow, WallShape, WallState,
};
use pulvis_boundary::Background;
use pulvis_boundary::{Domain, TemperatureProgram};

/// The initial state of a simulation.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The particles; their ids are their indices in this list.
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
    /// Groups of particles, in the order in which they were made.
    groups: Vec<Group>,
    domain: Domain,
    /// How the domain deforms.
    cell: Cell,
    background: Background,
    /// The temperature over time, if laws are to know it.
    temperature: Option<TemperatureProgram>,
    time_step: f64,
    step: u64,
    time: f64,
    contacts: ContactTable,
    /// The pairs whose bond has broken, but for those of the present list that broke since it was made.
    broken_bonds: BrokenBonds,
    /// Memory of the contacts during a rebuild.
    memory: MemoryStore,
    /// The row of each particle before it was put into the present order.
    former_rows: Vec<u32>,
    pool: ThreadPool,
    instructions: InstructionSet,
    accounting: bool,
    /// Whether all laws are called through pointers.
    pointers: bool,
    /// Time spent in the parts of a step up to the last rebuild, if it is measured.
    phases: Option<Phases>,
    /// The materials of all particles, each once.
    materials: Vec<MaterialIndex>,
    /// Scratch: what came out of the integration of each chunk.
    outcomes: Vec<Outcome>,
    /// Scratch: the charges, where they act over all distances.
    charges: Charges,
    /// What all chunks came to in the last pass.
    pass: PassTotals,
    /// Scratch: sums over chunks.
    tree: ChunkTree,
    /// The sums over all rows after a step with this number, where this rank does not hold all rows.
    row_sums: Option<(u64, RowSums)>,
    /// Scratch: how the walls lie and move, and their forces on the particles, in this step.
    walls_now: Vec<WallNow>,
    on_particles: Vec<WallForce>,
    skin: Skin,
    /// Whether the skin is the engine's own choice.
    chooses_skin: bool,
    mean_radius: f64,
    running: Running,
    /// What stops the simulation.
    limits: Limits,
    /// The first contact that was deeper than contacts should be.
    first_deep: Option<DeepContact>,
    rebuilds: u64,
    /// The ranks that share the work, if there are several.
    ranks: Option<Box<Ranks>>,
}

/// The results of the integration of a chunk of rows.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    /// Results of the last kicks.
    kicked: Kicked,
    /// Upper bounds of the displacements since the last rebuild [m].
    pub(crate) moved: Moved,
    /// Time spent since the last rebuild [s].
    seconds: f64,
}

impl Outcome {
    /// Extends the bounds after the rows have drifted over a `time_step` [s].
    fn drift_on(&mut self, time_step: f64) {
        self.moved = self.moved.farther(self.kicked.fastest * time_step);
    }
}

/// Contacts keep rows as 32-bit indices of numbers, of which a packed vector has four. Records of contact memory, some three
/// per particle, then still have 32-bit indices; all other counts of contacts have 64 bits.
const MOST_PARTICLES: usize = u32::MAX as usize / 4;

fn check_count(found: usize) -> Result<(), SetupError> {
    if found > MOST_PARTICLES {
        return Err(SetupError::TooMany { found, most: MOST_PARTICLES });
    }
    Ok(())
}

impl Simulation {
    /// The largest number of particles that a simulation can have.
    pub const MOST_PARTICLES: usize = MOST_PARTICLES;

    /// Sets the simulation up and computes the forces of its initial state.
    ///
    /// # Errors
    /// Invalid numbers of particles, walls, gravity or drag; materials that can meet without a contact model; walls across a
    /// periodic direction; servo walls without an area; periods that are too short.
    pub fn new(setup: Setup) -> Result<Self, SetupError> {
        Self::with_columns(setup, Vec::new())
    }

    /// The same with [columns](Self::set_column) of the particles from the start, which laws may read.
    ///
    /// # Errors
    /// As of [`new`](Self::new); there is not one finite value for each particle, or a column lacks that a law reads.
    pub fn with_columns(setup: Setup, columns: Vec<NamedColumn>) -> Result<Self, SetupError> {
        checks::check_setup(&setup)?;
        for column in &columns {
            columns::check_column(column, setup.particles.len())?;
        }
        let Setup { particles, interactions, walls, domain, background, time_step } = setup;
        if !(time_step > 0.0 && time_step.is_finite()) {
            return Err(SetupError::TimeStep(time_step));
        }
        check_count(particles.len())?;
        let mut particles = Particles::new(&particles);
        particles.columns = columns;
        let mut simulation =
            Self::without_list(particles, interactions, walls, domain, background, time_step);
        simulation.check_models()?;
        simulation.check_walls()?;
        simulation.choose_first_skin();
        simulation.check_periods()?;
        for (wall, state) in simulation.walls.iter().zip(&mut simulation.wall_states) {
            state.start(&wall.motion);
        }
        simulation.rebuild(None);
        if simulation.choose_skin() {
            simulation.rebuild(None);
        }
        simulation.evaluate_at_rest();
        simulation.running.forget_losses();
        let ledger = simulation.ledger();
        (simulation.running.initial, simulation.running.scale) = (ledger.stored(), ledger.scale);
        Ok(simulation)
    }

    /// At time zero, without a neighbour list; nothing is checked or computed yet.
    fn without_list(
        particles: Particles,
        interactions: Interactions,
        walls: Vec<Wall>,
        domain: Domain,
        background: Background,
        time_step: f64,
    ) -> Self {
        let mut simulation = Self {
            particles,
            interactions,
            wall_states: vec![WallState::default(); walls.len()],
            wall_starts: vec![0.0; walls.len()],
            groups: Vec::new(),
            domain,
            cell: Cell::new(domain),
            background,
            temperature: None,
            time_step,
            step: 0,
            time: 0.0,
            contacts: ContactTable::default(),
            broken_bonds: BrokenBonds::default(),
            memory: MemoryStore::default(),
            former_rows: Vec::new(),
            pool: ThreadPool::default(),
            instructions: InstructionSet::widest(),
            accounting: true,
            pointers: false,
            phases: None,
            materials: Vec::new(),
            outcomes: Vec::new(),
            charges: Charges::default(),
            pass: PassTotals::default(),
            tree: ChunkTree::default(),
            row_sums: None,
            walls_now: Vec::new(),
            on_particles: vec![WallForce::default(); walls.len()],
            skin: Skin::default(),
            chooses_skin: true,
            mean_radius: 0.0,
            running: Running::default(),
            limits: Limits::NONE,
            first_deep: None,
            rebuilds: 0,
            ranks: None,
            walls,
        };
        simulation.list_materials();
        simulation
    }

    /// Lists the materials of all particles, and fits the ranges of contacts to the largest particles of each.
    fn list_materials(&mut self) {
        self.materials.clone_from(&self.particles.material);
        self.materials.sort_unstable();
        self.materials.dedup();
        self.fit_interactions();
    }

    fn fit_interactions(&mut self) {
        let mut largest: Vec<(MaterialIndex, f64)> = self.materials.iter().map(|&one| (one, 0.0)).collect();
        for (material, &radius) in self.particles.material.iter().zip(&self.particles.radius) {
            if let Ok(index) = self.materials.binary_search(material) {
                largest[index].1 = largest[index].1.max(radius);
            }
        }
        let walls: Vec<(MaterialIndex, f64)> =
            self.walls.iter().map(|wall| (wall.material, wall.shape.least_mean_curvature())).collect();
        let columns = self.particles.columns();
        self.interactions.fit(&largest, &walls, |name| {
            let named = columns.iter().filter(|column| column.name == name);
            named.flat_map(|column| &column.values).copied().collect()
        });
    }

    fn check_models(&self) -> Result<(), SetupError> {
        self.check_quantities()?;
        let walls = self.walls.iter().map(|wall| wall.material);
        for &one in &self.materials {
            // A single particle of its material has nothing of its kind to meet.
            let is_lone =
                self.particles.material.iter().filter(|&&material| material == one).take(2).count() < 2;
            let partners = self.materials.iter().copied().filter(|&other| other != one || !is_lone);
            for other in partners.chain(walls.clone()) {
                if self.interactions.get(one, other).is_none() {
                    return Err(SetupError::NoModel { one, other });
                }
            }
        }
        match self.walls.iter().find_map(|wall| self.bonded_to_mesh(wall)) {
            Some(name) => Err(SetupError::BondWithMesh { name }),
            None => Ok(()),
        }
    }

    fn check_walls(&self) -> Result<(), SetupError> {
        if self.walls.len() > WallFeature::MOST_WALLS {
            return Err(SetupError::TooManyWalls { found: self.walls.len(), most: WallFeature::MOST_WALLS });
        }
        let largest = self.particles.radius.iter().copied().fold(0.0, max_or_nan);
        for (index, wall) in self.walls.iter().enumerate() {
            wall.shape
                .check(largest)
                .map_err(|reason| SetupError::WallShape { name: wall.name.clone(), reason })?;
            let varies = |&axis: &usize| {
                let mut direction = Vector3::zero();
                *direction.component_mut(axis) = 1.0;
                self.domain.period(axis).is_some() && !wall.shape.is_invariant_along(direction)
            };
            if let Some(axis) = (0..3).find(varies) {
                return Err(SetupError::WallAcrossPeriod { wall: index, axis });
            }
            self.check_motion(index, &wall.motion)?;
        }
        Ok(())
    }

    /// The name of a wall whose features a bond could not follow.
    fn bonded_to_mesh(&self, wall: &Wall) -> Option<String> {
        let bonds = |&material: &MaterialIndex| {
            let model = self.interactions.get(material, wall.material);
            model.is_some_and(|model| model.laws.bond.is_some())
        };
        let is_mesh = matches!(wall.shape, WallShape::Mesh(_));
        (is_mesh && self.materials.iter().any(bonds)).then(|| wall.name.clone())
    }

    /// Whether a wall can move in this way.
    fn check_motion(&self, index: usize, motion: &WallMotion) -> Result<(), SetupError> {
        let wall = &self.walls[index];
        let motion = motion.law();
        if motion.is_pushed() && wall.shape.direction_of_push().is_none() {
            return Err(SetupError::ServoNeedsPlane { wall: index });
        }
        if motion.needs_area() && wall.area == FaceArea::Unknown {
            return Err(SetupError::NoArea { wall: index });
        }
        if motion.needs_axis() && wall.shape.axis().is_none() {
            return Err(SetupError::RotationNeedsAxis { wall: index });
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

    /// Two centres farther apart than this cannot act on each other before the next rebuild [m].
    fn search_radius(&self) -> f64 {
        let largest = self.particles.radius.iter().copied().fold(0.0, max_or_nan);
        2.0 * largest + self.interactions.longest_range() + 2.0 * self.skin.thickest
    }

    /// The temperature that laws are told at a time [K].
    fn temperature_at(&self, time: f64) -> f64 {
        self.temperature.as_ref().map_or(ROOM_TEMPERATURE, |program| program.at(time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_particles_than_can_be_numbered_are_refused() {
        assert_eq!(check_count(1_000_000_000), Ok(()));
        let refused = check_count(2_000_000_000);
        assert_eq!(refused, Err(SetupError::TooMany { found: 2_000_000_000, most: 1_073_741_823 }));
    }
}
