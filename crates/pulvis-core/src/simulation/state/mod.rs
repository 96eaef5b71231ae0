//! Everything that decides the next bit, as plain numbers.

mod checks;
mod error;
mod export;
mod import;

pub use error::StateError;

use crate::columns::NamedColumn;
use crate::contacts::{BrokenBond, ContactRecords, ContactTotals};
use crate::particles::{MaterialIndex, ParticleId};
use pulvis_boundary::{Background, CellMotion, Domain, GroupMotion, TemperatureProgram};

/// Everything that decides the next bit of a simulation, as plain columns. [`Simulation::import_state`] makes a simulation
/// of it that continues the exported one, bit for bit, for any number of threads and on any instruction set.
///
/// Not included are contact models, and the names, materials, shapes, areas and motions of walls, which are given again at
/// the import; and settings of a run that change no bit: threads, instructions, limits. Everything else in a simulation is
/// derived from the state.
///
/// [`Simulation::import_state`]: crate::Simulation::import_state
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Steps done.
    pub step: u64,
    /// Simulated time [s].
    pub time: f64,
    /// Time step [s].
    pub time_step: f64,
    /// Space and its periods.
    pub domain: Domain,
    /// How the periodic cell deforms.
    pub cell: CellState,
    /// Gravity and drag.
    pub background: Background,
    /// Temperature over time, if laws are told one.
    pub temperature: Option<TemperatureProgram>,
    /// Whether the energy ledger is kept.
    pub keeps_ledger: bool,
    /// The id that the next inserted particle will get.
    pub next_id: ParticleId,
    /// The particles.
    pub particles: ParticleState,
    /// The walls, in the order of the list of walls.
    pub walls: Vec<WallRecord>,
    /// Groups of particles, in the order in which they were made.
    pub groups: Vec<GroupRecord>,
    /// The state at the last rebuild, and how far bodies have moved since.
    pub list: ListState,
    /// Memory of the contacts, one table for each kind of memory.
    pub memory: Vec<ContactRecords>,
    /// Sums over all contacts when the forces were computed, for observation.
    pub totals: ContactTotals,
    /// The pairs whose bond had broken when the list was made.
    pub broken_bonds: Vec<BrokenBond>,
    /// The sums of the energy ledger so far, by name [J, and W for powers].
    pub ledger: Vec<(String, f64)>,
}

/// How the periodic cell deforms.
#[derive(Clone, Debug, PartialEq)]
pub struct CellState {
    /// What leads it.
    pub motion: CellMotion,
    /// Space and its periods when the neighbour list was made.
    pub listed: Domain,
    /// What it keeps between steps, by name, in SI units.
    pub numbers: Vec<(String, f64)>,
}

/// The particles, one entry a row, in the order of the engine's rows: that order decides the order of sums.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParticleState {
    /// Ids.
    pub id: Vec<ParticleId>,
    /// Indices in the list of materials.
    pub material: Vec<MaterialIndex>,
    /// Radii [m].
    pub radius: Vec<f64>,
    /// Masses [kg].
    pub mass: Vec<f64>,
    /// Centres [m]; up to a skin outside of the periodic box.
    pub position: Vec<[f64; 3]>,
    /// Velocities [m/s].
    pub velocity: Vec<[f64; 3]>,
    /// Angular velocities [rad/s].
    pub angular_velocity: Vec<[f64; 3]>,
    /// Forces [N], by which the next step begins.
    pub force: Vec<[f64; 3]>,
    /// Torques [N m].
    pub torque: Vec<[f64; 3]>,
    /// Forces that a program applies [N], which `force` holds already; empty where there are none.
    pub applied_force: Vec<[f64; 3]>,
    /// Further quantities by name.
    pub columns: Vec<NamedColumn>,
}

/// A wall's own numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallRecord {
    /// Its name.
    pub name: String,
    /// Whether it is there.
    pub present: bool,
    /// Its reference point [m].
    pub point: [f64; 3],
    /// Where that was when the neighbour list was made [m].
    pub listed_point: [f64; 3],
    /// By how much it has turned about its axis, if that changes it [rad].
    pub angle: f64,
    /// The same when the neighbour list was made [rad].
    pub listed_angle: f64,
    /// When its present motion began [s].
    pub motion_start: f64,
    /// What its motion keeps between steps, by name, in SI units.
    pub motion: Vec<(String, f64)>,
}

/// A group of particles.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupRecord {
    /// Its name.
    pub name: String,
    /// The ids of its particles, ascending.
    pub ids: Vec<ParticleId>,
    /// How it moves.
    pub motion: GroupMotion,
    /// When that motion began [s].
    pub start: f64,
    /// Displacement since then [m].
    pub travelled: [f64; 3],
    /// Work done by leading it so far [J].
    pub work: f64,
}

/// The state at the last rebuild, from which an import makes the same neighbour list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ListState {
    /// How many lists there have been before it.
    pub rebuilds: u64,
    /// Steps since it was made.
    pub steps: u64,
    /// Whether the engine chooses the skins.
    pub chooses_skin: bool,
    /// Mean radius that the engine chooses skins by [m].
    pub mean_radius: f64,
    /// The thickest skin of a particle [m].
    pub skin_thickest: f64,
    /// The thinnest skin of a particle [m].
    pub skin_thinnest: f64,
    /// Centres when the list was made [m], row by row.
    pub position: Vec<[f64; 3]>,
    /// Radii with skins [m], row by row.
    pub radius_with_skin: Vec<f64>,
    /// The row that each particle had before it was put into cell order.
    pub former_row: Vec<u32>,
    /// Upper bound of the largest displacement of any particle since then [m], chunk by chunk.
    pub displacement_largest: Vec<f64>,
    /// The same of the second largest [m].
    pub displacement_second: Vec<f64>,
    /// Lower bound of the remaining skin of any particle [m], chunk by chunk.
    pub remaining_skin: Vec<f64>,
    /// Whether any contact of a block of eight acts, block by block.
    pub active: Vec<bool>,
}
