//! Where particles start: sizes and places. Everything random comes from one seed.

mod lattice;
mod random;
mod sizes;

pub use lattice::{Lattice, lattice};
pub use rand_chacha::ChaCha8Rng as Random;
pub use random::{NoRoom, Region, random_places};
pub use sizes::{InvalidSizes, Sizes};

use pulvis_math::Vector3;
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// A stream of random numbers that is the same on every machine.
pub fn random_stream(seed: u64) -> Random {
    Random::seed_from_u64(seed)
}

/// A vector of three independent Gaussian components with zero mean and unit variance.
pub fn gaussian_vector(random: &mut Random) -> Vector3 {
    let mut component = || -> f64 { StandardNormal.sample(random) };
    Vector3::new(component(), component(), component())
}
