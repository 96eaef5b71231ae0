//! Few large spheres among many small ones.

use pulvis_contact::ContactModel;
use pulvis_core::{Particle, Setup};
use pulvis_math::{Vector3, elementary};
use pulvis_packing::{Lattice, Structure, gaussian_vector, random_stream};
use rand::seq::SliceRandom;

use super::{RADIUS, edge_of_cube, of_one_material, periodic_cube, sphere};
use crate::failure::Failure;

/// Volume of the spheres over that of the cube [1].
const SOLID_FRACTION: f64 = 0.3;
/// Standard deviation of each component of the small spheres' velocities [m/s].
const SPEED: f64 = 0.1;

/// Sizes and numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    /// Large radius over small radius [1].
    pub(crate) ratio: f64,
    /// Number of small spheres.
    pub(crate) small: usize,
    /// Number of large spheres per edge of the cube.
    pub(crate) large_per_edge: usize,
}

/// Large spheres on a cubic lattice, small ones on sites of a fine lattice that are free.
pub(crate) fn setup(plan: &Plan, model: ContactModel) -> Result<Setup, Failure> {
    let large_radius = plan.ratio * RADIUS;
    let large_count = plan.large_per_edge.pow(3);
    let radii = std::iter::repeat_n(RADIUS, plan.small).chain(std::iter::repeat_n(large_radius, large_count));
    let edge = edge_of_cube(radii, SOLID_FRACTION);
    let mut random = random_stream(50);
    let mut particles = large_spheres(plan, large_radius, edge);
    // Finer and finer until there is room for all; below one diameter the small ones overlap a
    // little, which contacts can bear.
    let mut per_edge = elementary::cbrt(plan.small as f64).ceil() as usize;
    let mut free = loop {
        let free = free_sites(&particles, edge, per_edge);
        if free.len() >= plan.small {
            break free;
        }
        per_edge += 1;
    };
    free.shuffle(&mut random);
    for site in free.into_iter().take(plan.small) {
        particles.push(sphere(site, RADIUS, gaussian_vector(&mut random) * SPEED));
    }
    Ok(Setup { domain: periodic_cube(edge), ..of_one_material(particles, model) })
}

fn cubic(edge: f64, per_edge: usize) -> Vec<Vector3> {
    let spacing = edge / per_edge as f64;
    let lattice = Lattice {
        lower: Vector3::zero(),
        counts: [per_edge; 3],
        spacing,
        jitter: 0.0,
        structure: Structure::SimpleCubic,
    };
    lattice.sites().collect()
}

fn large_spheres(plan: &Plan, radius: f64, edge: f64) -> Vec<Particle> {
    let sites = cubic(edge, plan.large_per_edge.max(1));
    let places = sites.into_iter().take(plan.large_per_edge.pow(3));
    places.map(|site| sphere(site, radius, Vector3::zero())).collect()
}

/// The sites at which a small sphere does not overlap a large one. No large sphere ranges across the
/// boundary of the cube.
fn free_sites(large: &[Particle], edge: f64, per_edge: usize) -> Vec<Vector3> {
    let is_free =
        |site: &Vector3| large.iter().all(|other| (*site - other.position).norm() >= other.radius + RADIUS);
    cubic(edge, per_edge).into_iter().filter(is_free).collect()
}
