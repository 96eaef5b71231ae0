//! Aggregates of touching spheres that grow by hitting and sticking.

use pulvis_math::{Vector3, elementary};

use super::inlet::random_point;
use super::{Random, gaussian_vector};
use pulvis_boundary::Region;

/// How an aggregate has grown.
///
/// # Source
/// P. Meakin, Rev. Geophys. 29, 317 (1991); T. Mukai, H. Ishimoto, T. Kozasa, J. Blum, J. M. Greenberg, Astron. Astrophys.
/// 262, 315 (1992): fractal dimensions of 3 with a filling factor near 0.15, and of 1.9 to 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// Spheres hit one after the other from random directions and stick where they touch first: ballistic particle-cluster
    /// aggregation (BPCA). Compact, of fractal dimension 3.
    ParticleCluster,
    /// Clusters of equal numbers hit each other and stick: ballistic cluster-cluster aggregation (BCCA). Fluffy, of fractal
    /// dimension 1.9 to 2.
    ClusterCluster,
}

impl Growth {
    /// Both, with their names in a scenario.
    pub const ALL: [(&'static str, Self); 2] =
        [("particle-cluster", Self::ParticleCluster), ("cluster-cluster", Self::ClusterCluster)];

    /// Positions [m] of spheres of these radii [m] in an aggregate with its centre of mass at the origin, in the order of the
    /// radii. Spheres touch those that they have hit, to round-off, and overlap none.
    pub fn aggregate(self, radii: &[f64], random: &mut Random) -> Vec<Vector3> {
        let mut cluster = match self {
            Self::ParticleCluster => particle_cluster(radii, random),
            Self::ClusterCluster => cluster_cluster(radii, random),
        };
        cluster.centre();
        cluster.spheres.sort_unstable_by_key(|sphere| sphere.index);
        cluster.spheres.into_iter().map(|sphere| sphere.centre).collect()
    }
}

/// The radius of gyration about the centre of mass [m], of spheres of one density with these centres and radii [m]: that of
/// points at the centres, without the inertia of the spheres themselves.
pub fn radius_of_gyration(positions: &[Vector3], radii: &[f64]) -> f64 {
    let mass = |radius: &f64| elementary::powi(*radius, 3);
    let total: f64 = radii.iter().map(mass).sum();
    let mut centre = Vector3::zero();
    positions.iter().zip(radii).for_each(|(position, radius)| centre += *position * (mass(radius) / total));
    let squares =
        positions.iter().zip(radii).map(|(at, radius)| mass(radius) * (*at - centre).norm_squared());
    (squares.sum::<f64>() / total).sqrt()
}

#[derive(Clone, Copy)]
struct Sphere {
    index: usize,
    centre: Vector3,
    radius: f64,
}

/// How much farther than to the first touch a sphere goes, over the sum of the radii. Without it rounding would decide which
/// contacts touch, and laws that attract from touch on would hold one half of the contacts and not the other.
const PRESSED: f64 = 1e-9;

/// Spheres that move together, about a point near their middle.
struct Cluster {
    spheres: Vec<Sphere>,
    /// The farthest surface from the origin [m].
    outer: f64,
}

impl Cluster {
    fn of(index: usize, radius: f64) -> Self {
        Self { spheres: vec![Sphere { index, centre: Vector3::zero(), radius }], outer: radius }
    }

    /// Moves the centre of mass to the origin.
    fn centre(&mut self) {
        let mass = |sphere: &Sphere| elementary::powi(sphere.radius, 3);
        let total: f64 = self.spheres.iter().map(mass).sum();
        let mut middle = Vector3::zero();
        self.spheres.iter().for_each(|sphere| middle += sphere.centre * (mass(sphere) / total));
        self.spheres.iter_mut().for_each(|sphere| sphere.centre -= middle);
        let surface = |sphere: &Sphere| sphere.centre.norm() + sphere.radius;
        self.outer = self.spheres.iter().map(surface).fold(0.0, f64::max);
    }

    /// Turns it at random about the origin, every orientation equally likely.
    fn turn(&mut self, random: &mut Random) {
        let (first, second) = (direction(random), direction(random));
        let Some(second) = second.tangential_to(first).unit() else { return };
        let third = first.cross(second);
        for sphere in &mut self.spheres {
            let Vector3 { x, y, z } = sphere.centre;
            sphere.centre = first * x + second * y + third * z;
        }
    }

    /// Lets the other cluster, in any orientation, hit this one from a random direction on a random line, and stick.
    fn catch(&mut self, mut other: Self, random: &mut Random) {
        loop {
            other.turn(random);
            let along = direction(random);
            // A disc across the way, as wide as both clusters: lines through it are equally likely. A flat cylinder is one.
            let reach = self.outer + other.outer;
            let ends = [along * (-1.001 * reach), along * -reach];
            let start = random_point(&Region::Cylinder { ends, radius: reach }, random);
            if let Some(way) = self.way_of(&other, start, along) {
                let shift = start + along * way;
                let moved = |sphere: &Sphere| Sphere { centre: sphere.centre + shift, ..*sphere };
                self.spheres.extend(other.spheres.iter().map(moved));
                self.centre();
                return;
            }
        }
    }

    /// How far the other cluster, moved by `start`, goes along a unit vector until it touches this one [m]; `None` where it
    /// misses.
    fn way_of(&self, other: &Self, start: Vector3, along: Vector3) -> Option<f64> {
        let mut shortest: Option<f64> = None;
        for moving in &other.spheres {
            let from = moving.centre + start;
            for resting in &self.spheres {
                let (apart, reach) = (from - resting.centre, moving.radius + resting.radius);
                let (half, excess) = (apart.dot(along), apart.norm_squared() - reach * reach);
                let discriminant = half * half - excess;
                if discriminant >= 0.0 {
                    let way = -half - discriminant.sqrt() + PRESSED * reach;
                    shortest = Some(shortest.map_or(way, |known| known.min(way)));
                }
            }
        }
        shortest
    }
}

/// A random unit vector, every direction equally likely.
fn direction(random: &mut Random) -> Vector3 {
    loop {
        if let Some(direction) = gaussian_vector(random).unit() {
            return direction;
        }
    }
}

fn particle_cluster(radii: &[f64], random: &mut Random) -> Cluster {
    let mut spheres = radii.iter().enumerate().map(|(index, radius)| Cluster::of(index, *radius));
    let Some(mut cluster) = spheres.next() else { return Cluster { spheres: Vec::new(), outer: 0.0 } };
    spheres.for_each(|sphere| cluster.catch(sphere, random));
    cluster
}

/// Pairs of clusters until one is left. Where their number is odd, the last one waits for the next round.
fn cluster_cluster(radii: &[f64], random: &mut Random) -> Cluster {
    let mut clusters: Vec<Cluster> =
        radii.iter().enumerate().map(|(index, radius)| Cluster::of(index, *radius)).collect();
    while clusters.len() > 1 {
        let mut next = Vec::with_capacity(clusters.len().div_ceil(2));
        let mut round = clusters.into_iter();
        while let Some(mut one) = round.next() {
            if let Some(other) = round.next() {
                one.catch(other, random);
            }
            next.push(one);
        }
        // Those that waited come first in the next round.
        next.rotate_right(1);
        clusters = next;
    }
    clusters.pop().unwrap_or(Cluster { spheres: Vec::new(), outer: 0.0 })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::super::random_stream;
    use super::*;
    use rand::RngExt;

    fn aggregate(growth: Growth, count: usize, seed: u64) -> (Vec<Vector3>, Vec<f64>) {
        let radii = vec![1.0; count];
        (growth.aggregate(&radii, &mut random_stream(seed)), radii)
    }

    #[test]
    fn all_spheres_hang_together_by_touching_and_none_overlap_by_more_than_they_are_pressed() {
        for (_, growth) in Growth::ALL {
            let mut random = random_stream(4);
            let radii: Vec<f64> = (0..150).map(|_| 0.5 + random.random::<f64>()).collect();
            let positions = growth.aggregate(&radii, &mut random);
            let mut group: Vec<usize> = (0..radii.len()).collect();
            let mut contacts = 0;
            for i in 0..radii.len() {
                for j in 0..i {
                    let gap = (positions[i] - positions[j]).norm() - radii[i] - radii[j];
                    assert!(gap > -1.001 * PRESSED * (radii[i] + radii[j]), "{i} and {j} overlap by {gap}");
                    if gap < 0.0 {
                        contacts += 1;
                        let (old, new) = (group[i], group[j]);
                        group.iter_mut().filter(|own| **own == old).for_each(|own| *own = new);
                    }
                }
            }
            // Each sphere or cluster sticks by one contact: a tree.
            assert_eq!(contacts, radii.len() - 1);
            assert!(group.iter().all(|own| *own == group[0]));
            assert_eq!(
                positions,
                growth.aggregate(&radii, &mut {
                    let mut again = random_stream(4);
                    let _: Vec<f64> = (0..150).map(|_| again.random::<f64>()).collect();
                    again
                })
            );
        }
    }

    /// Slope of ln N over ln R_g between two sizes, of the mean radii of some seeds.
    fn dimension(growth: Growth, sizes: [usize; 2], seeds: u64) -> f64 {
        let [small, large] = sizes.map(|count| {
            let sum: f64 = (1..=seeds)
                .map(|seed| {
                    let (positions, radii) = aggregate(growth, count, seed);
                    elementary::ln(radius_of_gyration(&positions, &radii))
                })
                .sum();
            sum / seeds as f64
        });
        elementary::ln(sizes[1] as f64 / sizes[0] as f64) / (large - small)
    }

    // The published dimensions are 1.9 to 2 and 3, of N to infinity (certainty B: from reviews, not from their data). R_g of a
    // seed scatters by 8 % (clusters) and 3 % (particles), of 12 and 6 seeds by 2.3 % and 1.2 %: the slopes by 0.05 and 0.05.
    #[test]
    fn aggregates_have_the_published_fractal_dimensions() {
        let fluffy = dimension(Growth::ClusterCluster, [32, 512], 12);
        assert!(fluffy > 1.8 && fluffy < 2.1, "{fluffy}");
        let compact = dimension(Growth::ParticleCluster, [128, 2048], 4);
        assert!(compact > 2.75 && compact < 3.1, "{compact}");
    }

    #[test]
    fn a_compact_aggregate_fills_a_seventh_of_its_sphere() {
        // The sphere of the same radius of gyration has R = sqrt(5/3) R_g; published: a filling factor of 0.15 for large N.
        let (positions, radii) = aggregate(Growth::ParticleCluster, 2048, 3);
        let outer = f64::sqrt(5.0 / 3.0) * radius_of_gyration(&positions, &radii);
        let filling = 2048.0 / elementary::powi(outer, 3);
        assert!(filling > 0.13 && filling < 0.19, "{filling}");
    }
}
