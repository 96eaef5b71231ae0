//! What must not change: momentum, angular momentum, energy.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use proptest::prelude::*;
use pulvis_core::{Particle, Simulation};
use pulvis_math::Vector3;

#[test]
fn a_frictionless_elastic_gas_keeps_its_energy_at_second_order_in_the_step() {
    // The same simulated time with 50, 100, 200 and 400 steps a contact.
    let errors = [50.0, 100.0, 200.0, 400.0].map(|steps_per_contact| {
        let mut gas = start(elastic_gas(300), steps_per_contact);
        advance_watching(&mut gas, (20.0 * steps_per_contact) as usize, 10)
    });
    // Collisions begin and end between steps, each with an error of second order and random sign.
    assert!(order(&errors) > 1.7, "observed order {}: {errors:?}", order(&errors));
}

/// Every collision begins and ends between two steps; it errs by up to (π dt/t_c)²/8 of its energy, in
/// either direction. With 4000 steps a contact that is 8e-8 of the energy of one collision, one
/// five-hundredth of the gas's.
const STEPS_PER_CONTACT: f64 = 4000.0;

#[test]
fn a_gas_of_a_thousand_keeps_its_energy_to_1e_8_for_a_hundred_thousand_steps() {
    let mut gas = start(elastic_gas(1000), STEPS_PER_CONTACT);
    let worst = advance_watching(&mut gas, 100_000, 100);
    assert!(worst < 1e-8, "{worst}");
}

#[test]
fn momentum_is_conserved_to_round_off_in_a_periodic_box() {
    let mut gas = start(elastic_gas(300), 50.0);
    let (before, scale) = (gas.particles().momentum(), momentum_scale(&gas));
    advance(&mut gas, 2_000);
    let drift = (gas.particles().momentum() - before).norm();
    // Each step adds one rounding a particle and component: 2000 steps, random signs.
    assert!(drift < 1e-13 * scale, "{drift} of {scale}");
}

/// Angular momentum about the origin, and the sum of the sizes of its parts.
fn angular_momentum(simulation: &Simulation) -> (Vector3, f64) {
    let particles = simulation.particles();
    let (mut sum, mut scale) = (Vector3::zero(), 0.0);
    for row in 0..particles.len() {
        let (mass, radius) = (particles.masses()[row], particles.radii()[row]);
        let orbit = particles.positions()[row].cross(particles.velocities()[row]) * mass;
        let own = particles.angular_velocities()[row] * (0.4 * mass * radius * radius);
        sum += orbit + own;
        scale += orbit.norm() + own.norm();
    }
    (sum, scale)
}

#[test]
fn friction_keeps_momentum_and_angular_momentum_of_an_isolated_cluster_to_round_off() {
    let mut cluster = start(implosion(60, 12.0 * RADIUS, 3, viscous_luding()), 50.0);
    let ((turning, turning_scale), momentum) = (angular_momentum(&cluster), cluster.particles().momentum());
    advance(&mut cluster, 4_000);
    let ledger = cluster.ledger();
    assert!(ledger.dissipated_sliding > 0.0 && ledger.dissipated_rolling > 0.0, "{ledger:?}");
    let drift = (angular_momentum(&cluster).0 - turning).norm();
    // The contact point's two levers add up to the distance of the centres, and the torques of rolling
    // and torsion are opposite: what remains is one rounding a contact and step.
    assert!(drift < 1e-12 * turning_scale, "{drift} of {turning_scale}");
    let drift = (cluster.particles().momentum() - momentum).norm();
    assert!(drift < 1e-12 * momentum_scale(&cluster));
}

/// Two to six spheres that overlap by some percent, with any velocities and angular velocities.
fn overlapping() -> impl Strategy<Value = Vec<Particle>> {
    let triple = || prop::array::uniform3(-1.0..1.0_f64).prop_map(Vector3::from);
    let particle = (triple(), triple(), triple(), 0.6..1.4_f64);
    prop::collection::vec(particle, 2..7).prop_map(|drawn| {
        let spaced = |(place, (offset, velocity, angular_velocity, size)): (
            usize,
            (Vector3, Vector3, Vector3, f64),
        )| {
            let site = vector((place % 2) as f64, (place / 2 % 2) as f64, (place / 4) as f64);
            let position = (site * 1.7 + offset * 0.15) * RADIUS;
            Particle {
                angular_velocity: angular_velocity * 200.0,
                ..sphere(position, velocity * 0.1, size * RADIUS)
            }
        };
        drawn.into_iter().enumerate().map(spaced).collect()
    })
}

proptest! {
    #[test]
    fn action_is_reaction(particles in overlapping(), steps in 0..30_usize) {
        let mut cluster = start(setup(particles, viscous_luding()), 30.0);
        advance(&mut cluster, steps);
        let particles = cluster.particles();
        let (mut force, mut moment) = (Vector3::zero(), Vector3::zero());
        let (mut force_scale, mut moment_scale) = (0.0, 0.0);
        for row in 0..particles.len() {
            let at = particles.positions()[row].cross(particles.forces()[row]);
            force += particles.forces()[row];
            moment += at + particles.torques()[row];
            force_scale += particles.forces()[row].norm();
            moment_scale += particles.positions()[row].norm() * particles.forces()[row].norm()
                + particles.torques()[row].norm();
        }
        // Some roundings of the largest contact, whose force may cancel in the sums of a particle.
        prop_assert!(force.norm() <= 1e-12 * force_scale + 1e-15, "{} of {force_scale}", force.norm());
        prop_assert!(moment.norm() <= 1e-12 * moment_scale + 1e-15 * RADIUS, "{} of {moment_scale}", moment.norm());
    }
}
