//! Cubic lattices, jittered if wanted.

use pulvis_boundary::Cuboid;
use pulvis_math::Vector3;
use rand::RngExt;

use super::Random;

/// Which sites a cubic cell has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Structure {
    /// One site a cell: 6 neighbours, 0.5236 solid where spheres touch.
    #[default]
    SimpleCubic,
    /// Two sites a cell: 8 neighbours, 0.6802 solid.
    BodyCentred,
    /// Four sites a cell: 12 neighbours, 0.7405 solid, the densest packing of equal spheres.
    FaceCentred,
}

impl Structure {
    /// All of them, by their names in a scenario.
    pub const ALL: [(&'static str, Self); 3] = [
        ("simple-cubic", Self::SimpleCubic),
        ("body-centred-cubic", Self::BodyCentred),
        ("face-centred-cubic", Self::FaceCentred),
    ];

    /// The name in a scenario.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, structure)| *structure == self).map_or("", |(name, _)| name)
    }

    /// The sites of a cell, in units of its edge. They lie a half of their distance within its faces.
    const fn basis(self) -> &'static [[f64; 3]] {
        match self {
            Self::SimpleCubic => &[[0.5; 3]],
            Self::BodyCentred => &[[0.25; 3], [0.75; 3]],
            Self::FaceCentred => &[[0.25; 3], [0.75, 0.75, 0.25], [0.75, 0.25, 0.75], [0.25, 0.75, 0.75]],
        }
    }

    /// Distance of nearest neighbours over the edge of a cell [1].
    pub const fn neighbour_distance(self) -> f64 {
        match self {
            Self::SimpleCubic => 1.0,
            Self::BodyCentred => 0.866_025_403_784_438_6,
            Self::FaceCentred => std::f64::consts::FRAC_1_SQRT_2,
        }
    }
}

/// A cubic lattice that fills a block with whole cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Lower corner of the block [m].
    pub lower: Vector3,
    /// Number of cells along x, y, z.
    pub counts: [usize; 3],
    /// Edge of a cell [m].
    pub spacing: f64,
    /// Largest random displacement along each axis, as a fraction of the distance of nearest neighbours [1].
    pub jitter: f64,
    /// The sites of a cell.
    pub structure: Structure,
}

impl Lattice {
    /// The number of sites of a cell.
    pub const fn sites_per_cell(&self) -> usize {
        self.structure.basis().len()
    }

    /// The number of sites.
    pub fn site_count(&self) -> usize {
        self.counts.iter().product::<usize>() * self.sites_per_cell()
    }

    /// The sites without their displacements, cell by cell, x fastest and z slowest: of a simple cubic lattice
    /// lower + (i + 1/2) spacing [m].
    pub fn sites(&self) -> impl Iterator<Item = Vector3> + '_ {
        (0..self.site_count()).map(|number| self.site(number))
    }

    /// The site of this number without its displacement [m].
    pub fn site(&self, number: usize) -> Vector3 {
        self.displaced_site(number, || 0.0)
    }

    /// One position at each site, randomly displaced, in the order of the sites [m].
    pub fn positions(&self, random: &mut Random) -> Vec<Vector3> {
        let most = self.jitter * self.structure.neighbour_distance();
        let mut displacement = || most * (2.0 * random.random::<f64>() - 1.0);
        (0..self.site_count()).map(|number| self.displaced_site(number, &mut displacement)).collect()
    }

    /// A site [m], moved along each axis by a fraction of the spacing.
    fn displaced_site(&self, number: usize, mut displacement: impl FnMut() -> f64) -> Vector3 {
        let [along_x, along_y, _] = self.counts;
        let basis = self.structure.basis();
        let (number, site) = (number / basis.len(), basis[number % basis.len()]);
        let cell = [number % along_x, number / along_x % along_y, number / (along_x * along_y)];
        // A lattice of more than 2^53 cells along an axis does not fit into any memory.
        let cell = cell.map(|index| index as f64 + displacement());
        self.lower + Vector3::from(site) * self.spacing + Vector3::from(cell) * self.spacing
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
        let structure = Structure::SimpleCubic;
        let lower = Vector3::new(1.0, 0.0, 0.0);
        let mut plan = Lattice { lower, counts: [2, 1, 3], spacing: 0.5, jitter: 0.0, structure };
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

    #[test]
    fn neighbours_and_solid_fraction_are_those_of_crystallography() {
        use std::f64::consts::PI;
        // Ashcroft and Mermin, Solid State Physics (1976), table 4.5 and problem 4.6.
        let expected = [(6, PI / 6.0), (8, 3.0_f64.sqrt() * PI / 8.0), (12, 2.0_f64.sqrt() * PI / 6.0)];
        for ((name, structure), (neighbours, fraction)) in Structure::ALL.into_iter().zip(expected) {
            assert_eq!(structure.name(), name);
            let plan =
                Lattice { lower: Vector3::zero(), counts: [3; 3], spacing: 2.0, jitter: 0.0, structure };
            let (sites, edge) = (plan.positions(&mut random_stream(1)), 6.0);
            assert_eq!(sites.len(), plan.site_count());
            let nearest = 2.0 * structure.neighbour_distance();
            for one in &sites {
                let distance = |other: &Vector3| {
                    let way = (*one - *other).to_array().map(|way| way - edge * (way / edge).round());
                    Vector3::from(way).norm()
                };
                // Nobody is nearer, through the faces of the block too.
                let least = sites.iter().map(distance).filter(|way| *way > 0.0).fold(f64::INFINITY, f64::min);
                assert!((least / nearest - 1.0).abs() < 1e-15, "{name}: {least}");
                let touching = sites.iter().filter(|other| (distance(other) / nearest - 1.0).abs() < 1e-12);
                assert_eq!(touching.count(), neighbours, "{name}");
            }
            let share = nearest / edge;
            let solid = sites.len() as f64 * PI / 6.0 * share * share * share;
            assert!((solid / fraction - 1.0).abs() < 1e-15, "{name}: {solid}");
        }
    }
}
