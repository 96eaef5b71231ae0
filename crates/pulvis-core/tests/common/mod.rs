//! Systems that several tests start from.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_contact::{ContactModel, Linear};
use pulvis_core::arrangement::{Region, gaussian_vector, random_places, random_stream};
use pulvis_core::{
    Background, Domain, Interactions, Particle, Setup, Simulation, shortest_contact,
};
use pulvis_math::Vector3;

pub const RADIUS: f64 = 0.5e-3;

pub fn sphere(position: Vector3, velocity: Vector3, radius: f64) -> Particle {
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 2500.0 * radius.powi(3);
    Particle { material: 0, radius, mass, position, velocity, spin: Vector3::zero() }
}

/// Frictionless undamped spheres at a solid fraction of 0.2 in a periodic cube, 0.1 m/s a component.
pub fn elastic_gas(count: usize, steps_per_contact: f64) -> Simulation {
    let volume = count as f64 * 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3);
    let edge = (volume / 0.2).cbrt();
    let upper = Vector3::new(edge, edge, edge);
    let domain = Domain::periodic(Vector3::zero(), upper, [true; 3]);
    let region = Region { lower: Vector3::zero(), upper };
    let mut random = random_stream(11);
    let places = random_places(&vec![RADIUS; count], &region, &domain, &[], &mut random).unwrap();
    let particles: Vec<_> = places
        .into_iter()
        .map(|place| sphere(place, gaussian_vector(&mut random) * 0.1, RADIUS))
        .collect();
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, ContactModel::frictionless(Linear::new(1000.0, 0.0)));
    let contact = shortest_contact(&particles, &interactions, &[]).unwrap();
    let time_step = contact.duration / steps_per_contact;
    let walls = Vec::new();
    let background = Background::default();
    Simulation::new(Setup { particles, interactions, walls, domain, background, time_step }).unwrap()
}

pub fn momentum_scale(simulation: &Simulation) -> f64 {
    let particles = simulation.particles();
    particles.masses().iter().zip(particles.velocities()).map(|(mass, velocity)| mass * velocity.norm()).sum()
}
