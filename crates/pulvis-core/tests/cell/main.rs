//! A periodic cell that deforms, against closed forms, Newton's equations in the laboratory, and itself in other images.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

#[path = "../common/mod.rs"]
mod common;

mod free;
mod images;
mod lattice;
mod ledger;
mod refusals;
mod restart;
mod servo;

use common::{RADIUS, setup, sphere, vector, viscous_luding};
use pulvis_boundary::Cuboid;
use pulvis_boundary::motion::PressureRamp;
use pulvis_contact::ContactModel;
use pulvis_core::{CellControl, CellMotion, Domain, Particle, Setup, Simulation, UpperTriangular};
use pulvis_math::Vector3;
use pulvis_packing::{gaussian_vector, random_positions, random_stream};

/// A motion with these rates [1/s].
fn at_rates(rates: UpperTriangular) -> CellMotion {
    CellMotion { components: rates.to_array().map(CellControl::Rate), ..CellMotion::default() }
}

fn shear(rate: f64) -> CellMotion {
    at_rates(UpperTriangular { xy: rate, ..UpperTriangular::ZERO })
}

fn constant(stress: f64) -> PressureRamp {
    PressureRamp { from: stress, to: stress, duration: 0.0 }
}

/// A cube from zero, periodic along all axes.
fn cube(edge: f64) -> Domain {
    Domain::periodic(Vector3::zero(), vector(edge, edge, edge), [true; 3])
}

/// Spheres of 0.8 to 1.2 `RADIUS` at random places and with random velocities, at this solid fraction.
fn gas(count: usize, fraction: f64, speed: f64, model: ContactModel) -> Setup {
    let radii: Vec<f64> =
        (0..count).map(|number| RADIUS * (0.8 + 0.4 * number as f64 / count as f64)).collect();
    let volume: f64 = radii.iter().map(|radius| 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)).sum();
    let edge = (volume / fraction).cbrt();
    let domain = cube(edge);
    let mut random = random_stream(5);
    let region = Cuboid { lower: Vector3::zero(), upper: vector(edge, edge, edge) };
    let places = random_positions(&radii, &region, &domain, &[], &mut random).unwrap();
    let moving = |(place, radius): (Vector3, f64)| -> Particle {
        let mut particle = sphere(place, gaussian_vector(&mut random) * speed, radius);
        particle.angular_velocity = gaussian_vector(&mut random) * (speed / RADIUS);
        particle
    };
    Setup { domain, ..setup(places.into_iter().zip(radii).map(moving).collect(), model) }
}

/// A dense frictional packing that has been compressed to this solid fraction within some hundred contacts.
fn packing(count: usize, fraction: f64, steps_per_contact: f64) -> Simulation {
    let mut simulation = common::start(gas(count, 0.3, 0.02, viscous_luding()), steps_per_contact);
    let duration = 4000.0 * simulation.time_step();
    let rate = (0.3 / fraction).ln() / 3.0 / duration;
    simulation
        .set_cell_motion(at_rates(UpperTriangular { xx: rate, yy: rate, zz: rate, ..UpperTriangular::ZERO }))
        .unwrap();
    simulation.advance(4000).unwrap();
    simulation.set_cell_motion(CellMotion::default()).unwrap();
    simulation
}

/// The stress σ_ab now [Pa].
fn stress(simulation: &Simulation, row: usize, column: usize) -> f64 {
    simulation.stress_times_volume()[row][column] / simulation.domain().extent.volume()
}
