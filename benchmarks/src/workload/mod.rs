//! The systems that are timed. Spheres of 2500 kg/m³, mean diameter 1 mm, time step 4 µs.

pub(crate) mod bed;
pub(crate) mod bidisperse;
pub(crate) mod gas;
mod table;
pub(crate) mod tablet;

use std::f64::consts::PI;

use pulvis_contact::ContactModel;
use pulvis_core::{Background, Domain, Interactions, Particle, Setup};
use pulvis_math::{Vector3, elementary};

/// Mean radius [m].
const RADIUS: f64 = 0.5e-3;
/// Density [kg/m³].
const DENSITY: f64 = 2500.0;
/// Time step [s].
const TIME_STEP: f64 = 4e-6;

/// A sphere of material 0.
fn sphere(position: Vector3, radius: f64, velocity: Vector3) -> Particle {
    let mass = 4.0 / 3.0 * PI * DENSITY * elementary::powi(radius, 3);
    Particle { material: 0, radius, mass, position, velocity, angular_velocity: Vector3::zero() }
}

/// Particles and walls of one material in open space.
fn of_one_material(particles: Vec<Particle>, model: ContactModel) -> Setup {
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, model);
    Setup {
        particles,
        interactions,
        walls: Vec::new(),
        domain: Domain::unbounded(),
        background: Background::default(),
        time_step: TIME_STEP,
    }
}

/// A periodic cube from zero to `edge` [m].
fn periodic_cube(edge: f64) -> Domain {
    Domain::periodic(Vector3::zero(), Vector3::new(edge, edge, edge), [true; 3])
}

/// The edge [m] of the cube in which the spheres fill a fraction of the volume.
fn edge_of_cube(radii: impl Iterator<Item = f64>, fraction: f64) -> f64 {
    let volume: f64 = radii.map(|radius| 4.0 / 3.0 * PI * elementary::powi(radius, 3)).sum();
    elementary::cbrt(volume / fraction)
}
