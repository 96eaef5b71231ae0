//! Where particles start: sizes and places. Everything random comes from one seed.

mod gaussian;
mod lattice;
mod random;
mod sizes;

pub use gaussian::gaussian_vector;
pub use lattice::{Lattice, lattice};
pub use rand_chacha::ChaCha8Rng as Random;
pub use random::{NoRoom, Region, random_places};
pub use sizes::{InvalidSizes, Sizes};

use rand::SeedableRng;

/// A stream of random numbers that is the same on every machine.
pub fn random_stream(seed: u64) -> Random {
    Random::seed_from_u64(seed)
}
