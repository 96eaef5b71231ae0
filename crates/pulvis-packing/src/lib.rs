//! Initial packings: how large particles are and where they start; and inlets, through which more of them come. Everything
//! random comes from a seed.
//!
//! This crate knows no engine and no file. Scenarios are read into its types, and the engine gets what
//! comes out of them.

mod aggregate;
mod dense;
mod gas;
mod gaussian;
mod inlet;
mod lattice;
mod occupied;
mod radius;
mod random;

pub use aggregate::{Growth, radius_of_gyration};
pub use dense::{Jammed, dense_positions};
pub use gas::GasVelocities;
pub use gaussian::gaussian_vector;
pub use inlet::{Amount, Inlet, InletPlan, InletState, InvalidInlet, NewSphere, Room, random_point};
pub use lattice::{Lattice, Structure};
pub use occupied::OccupiedSpace;
pub use radius::{InvalidDistribution, LEAST_SHARE, RadiusDistribution};
pub use rand_chacha::ChaCha8Rng as Random;
pub use random::{NoRoom, random_positions};

use rand::SeedableRng;

/// A stream of random numbers that is the same on every machine.
pub fn random_stream(seed: u64) -> Random {
    Random::seed_from_u64(seed)
}
