//! The granular gas.

use std::path::Path;

use pulvis_contact::ContactModel;
use pulvis_core::{Particle, Setup};
use pulvis_math::{Vector3, elementary};
use pulvis_packing::{Lattice, RadiusDistribution, Random, Structure, gaussian_vector, random_stream};
use rand::seq::SliceRandom;

use super::{RADIUS, edge_of_cube, of_one_material, periodic_cube, sphere, table};
use crate::failure::Failure;

/// Dashpot coefficient over the reduced mass [1/s].
pub(crate) const DAMPING_RATE: f64 = 800.0;
/// Volume of the spheres over that of the cube [1].
const SOLID_FRACTION: f64 = 0.1;
/// Standard deviation of each component of the velocities [m/s].
const SPEED: f64 = 0.1;

/// The gas of a table, or a new one of `count` particles.
pub(crate) fn setup(path: Option<&Path>, count: usize, model: ContactModel) -> Result<Setup, Failure> {
    let particles = match path {
        Some(path) => table::read(path)?,
        None => made_anew(count, &mut random_stream(777))?,
    };
    let edge = edge_of_cube(particles.iter().map(|particle| particle.radius), SOLID_FRACTION);
    Ok(Setup { domain: periodic_cube(edge), ..of_one_material(particles, model) })
}

/// Spheres of radius ±20 % on randomly chosen sites of a lattice, moved off them by no more than the
/// room that the largest sphere has there.
fn made_anew(count: usize, random: &mut Random) -> Result<Vec<Particle>, Failure> {
    let distribution = RadiusDistribution::Uniform { minimum: 0.8 * RADIUS, maximum: 1.2 * RADIUS };
    let radii = distribution.draw(count, random)?;
    let edge = edge_of_cube(radii.iter().copied(), SOLID_FRACTION);
    let per_edge = elementary::cbrt(count as f64).ceil() as usize;
    let spacing = edge / per_edge as f64;
    let jitter = (0.5 - 1.2 * RADIUS / spacing).max(0.0);
    let lattice = Lattice {
        lower: Vector3::zero(),
        counts: [per_edge; 3],
        spacing,
        jitter,
        structure: Structure::SimpleCubic,
    };
    let mut sites = lattice.positions(random);
    sites.shuffle(random);
    let velocities: Vec<_> = (0..count).map(|_| gaussian_vector(random) * SPEED).collect();
    let mean = velocities.iter().fold(Vector3::zero(), |sum, &v| sum + v) * (1.0 / count.max(1) as f64);
    let spheres = sites.into_iter().zip(radii).zip(velocities);
    Ok(spheres.map(|((site, radius), velocity)| sphere(site, radius, velocity - mean)).collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn a_new_gas_starts_without_overlaps_and_without_momentum() {
        let particles = made_anew(500, &mut random_stream(1)).unwrap();
        let edge = edge_of_cube(particles.iter().map(|particle| particle.radius), SOLID_FRACTION);
        let nearest = |d: f64| d - (d / edge).round() * edge;
        for (place, one) in particles.iter().enumerate() {
            for other in &particles[..place] {
                let d = one.position - other.position;
                let distance = Vector3::new(nearest(d.x), nearest(d.y), nearest(d.z)).norm();
                assert!(distance >= (one.radius + other.radius) * (1.0 - 1e-12));
            }
        }
        let sum = particles.iter().fold(Vector3::zero(), |sum, particle| sum + particle.velocity);
        // 500 terms of 0.1 m/s, each with a rounding error of 1e-17.
        assert!(sum.norm() < 1e-13);
    }
}
