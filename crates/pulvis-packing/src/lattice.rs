//! A simple cubic lattice, jittered if wanted.

use pulvis_boundary::Cuboid;
use pulvis_math::Vector3;
use rand::RngExt;

use super::Random;

/// A simple cubic lattice that fills a block: sites are the centres of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Lower corner of the block [m].
    pub lower: Vector3,
    /// Number of cells along x, y, z.
    pub counts: [usize; 3],
    /// Edge of a cell [m].
    pub spacing: f64,
    /// Largest random displacement along each axis, as a fraction of the spacing [1].
    pub jitter: f64,
}

impl Lattice {
    /// The number of sites.
    pub fn site_count(&self) -> usize {
        self.counts.iter().product()
    }

    /// The sites without their displacements, x fastest and z slowest: lower + (i + 1/2) spacing [m].
    pub fn sites(&self) -> impl Iterator<Item = Vector3> + '_ {
        (0..self.site_count()).map(|number| self.site(number))
    }

    /// The site of this number without its displacement [m].
    pub fn site(&self, number: usize) -> Vector3 {
        self.displaced_site(number, || 0.0)
    }

    /// One position at each site, randomly displaced, in the order of the sites [m].
    pub fn positions(&self, random: &mut Random) -> Vec<Vector3> {
        let mut displacement = || self.jitter * (2.0 * random.random::<f64>() - 1.0);
        (0..self.site_count()).map(|number| self.displaced_site(number, &mut displacement)).collect()
    }

    /// A site [m], moved along each axis by a fraction of the spacing.
    fn displaced_site(&self, number: usize, mut displacement: impl FnMut() -> f64) -> Vector3 {
        let [along_x, along_y, _] = self.counts;
        let cell = [number % along_x, number / along_x % along_y, number / (along_x * along_y)];
        // A lattice of more than 2^53 cells along an axis does not fit into any memory.
        let cell = cell.map(|index| index as f64 + displacement());
        let half = 0.5 * self.spacing;
        self.lower + Vector3::new(half, half, half) + Vector3::from(cell) * self.spacing
    }

    /// The block that the cells fill.
    pub fn extent(&self) -> Cuboid {
        let size = self.counts.map(|count| count as f64 * self.spacing);
        Cuboid { lower: self.lower, upper: self.lower + Vector3::from(size) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::random_stream;
    use super::*;

    #[test]
    fn a_lattice_without_jitter_is_regular_and_with_jitter_repeats_with_its_seed() {
        let mut plan =
            Lattice { lower: Vector3::new(1.0, 0.0, 0.0), counts: [2, 1, 3], spacing: 0.5, jitter: 0.0 };
        let sites = plan.positions(&mut random_stream(1));
        assert_eq!(sites, plan.sites().collect::<Vec<_>>());
        assert_eq!(sites.len(), 6);
        assert_eq!(sites[1], Vector3::new(1.75, 0.25, 0.25));
        assert_eq!(sites[4], Vector3::new(1.25, 0.25, 1.25));
        assert_eq!(plan.extent().upper, Vector3::new(2.0, 0.5, 1.5));
        plan.jitter = 0.2;
        let jittered = plan.positions(&mut random_stream(7));
        assert_eq!(jittered, plan.positions(&mut random_stream(7)));
        assert_ne!(jittered, plan.positions(&mut random_stream(8)));
        assert!(jittered.iter().zip(&sites).all(|(a, b)| (*a - *b).norm() < 0.1 * 3.0_f64.sqrt() + 1e-12));
    }
}
