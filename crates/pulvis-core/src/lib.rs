//! Level 2 of the house: many bodies.
//!
//! Particles are columns in cell order, contacts are blocks of eight with memory that survives every
//! new list of candidates, time moves by synchronised velocity-Verlet, and an energy ledger closes
//! over it all. Nothing here knows files.

mod chunk_tree;
mod columns;
mod contacts;
mod counting_sort;
mod electrostatics;
mod integrator;
mod ledger;
mod neighbours;
pub mod observation;
mod particles;
mod phases;
mod ranks;
mod simulation;
mod time_step;
pub mod walls;

use pulvis_parallel::{shared, thread_pool};

pub use columns::{NameError, NamedColumn};
pub use contacts::{
    Binding, BondCount, BrokenBond, ContactPartner, ContactRecords, ContactTotals, ContactView, Interactions,
    MemoryColumn, MemoryError,
};
pub use electrostatics::shortest_motion_of_charges;
pub use ledger::Ledger;
pub use particles::{MaterialIndex, Particle, ParticleId, Particles, Vectors};
pub use phases::Phases;
pub use pulvis_boundary::{
    Background, CellContent, CellControl, CellMotion, Domain, Electrostatics, GroupMotion, Region,
    TemperatureProgram, UpperTriangular,
};
pub use pulvis_math::InstructionSet;
pub use simulation::{
    Alarm, CellState, DeepContact, Group, GroupLoad, GroupRecord, Limits, ListState, ParticleState, Setup,
    SetupError, Simulation, State, StateError, StepError, WallRecord,
};
pub use time_step::{
    MotionKind, ShortestContact, ShortestMotion, TouchingAtOnce, shortest_contact, shortest_motion,
};
