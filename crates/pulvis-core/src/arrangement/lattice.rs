//! A simple cubic lattice, jittered if wanted.

use pulvis_math::Vector3;
use rand::RngExt;

use super::Random;

/// A simple cubic lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// The first site [m].
    pub lower: Vector3,
    /// Sites along x, y, z.
    pub counts: [usize; 3],
    /// Distance of neighbouring sites [m].
    pub spacing: f64,
    /// Each coordinate is moved by up to this fraction of the spacing, either way [1].
    pub jitter: f64,
}

/// The sites of a lattice [m], x running fastest.
pub fn lattice(lattice: &Lattice, random: &mut Random) -> Vec<Vector3> {
    let [nx, ny, nz] = lattice.counts;
    let mut sites = Vec::with_capacity(nx * ny * nz);
    let mut jitter = || lattice.jitter * (2.0 * random.random::<f64>() - 1.0);
    for z in 0..nz {
        for y in 0..ny {
            for x in 0..nx {
                let place = Vector3::new(x as f64 + jitter(), y as f64 + jitter(), z as f64 + jitter());
                sites.push(lattice.lower + place * lattice.spacing);
            }
        }
    }
    sites
}

#[cfg(test)]
mod tests {
    use super::super::random_stream;
    use super::*;

    #[test]
    fn a_lattice_without_jitter_is_regular_and_with_jitter_repeats_with_its_seed() {
        let mut plan =
            Lattice { lower: Vector3::new(1.0, 0.0, 0.0), counts: [2, 1, 3], spacing: 0.5, jitter: 0.0 };
        let sites = lattice(&plan, &mut random_stream(1));
        assert_eq!(sites.len(), 6);
        assert_eq!(sites[1], Vector3::new(1.5, 0.0, 0.0));
        assert_eq!(sites[4], Vector3::new(1.0, 0.0, 1.0));
        plan.jitter = 0.2;
        let jittered = lattice(&plan, &mut random_stream(7));
        assert_eq!(jittered, lattice(&plan, &mut random_stream(7)));
        assert_ne!(jittered, lattice(&plan, &mut random_stream(8)));
        assert!(jittered.iter().zip(&sites).all(|(a, b)| (*a - *b).norm() < 0.1 * 3.0_f64.sqrt() + 1e-12));
    }
}
