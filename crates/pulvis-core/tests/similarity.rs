//! Identity I5 of the bulk laboratory: what is scaled alike behaves alike.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_contact::normal::Interpolation;
use pulvis_contact::viscosity::{Constant, Viscosity};
use pulvis_contact::{ContactModel, Luding};
use pulvis_core::observation::{Observation, ObservationPlan};
use pulvis_core::{Setup, Simulation};

/// Cohesive spheres that fly together in a box under gravity; lengths, stiffnesses and times times `scale`, densities and
/// velocities as they are.
fn scaled(scale: f64) -> (Simulation, f64) {
    let interpolation = Interpolation::Linear;
    let luding =
        Luding { k1: 100.0 * scale, kp: 500.0 * scale, kc: 100.0 * scale, phi_f: 0.05, interpolation };
    let mut model = ContactModel::frictionless(luding);
    // Force over velocity.
    model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: 2e-3 * scale * scale });
    model.laws.sliding = Some(slider(100.0 * scale, 4e-4 * scale * scale, 0.5));
    let edge = 9e-3;
    let mut setup = implosion(300, edge, 3, model);
    for particle in &mut setup.particles {
        particle.position = particle.position * scale;
        particle.radius *= scale;
        particle.mass *= scale * scale * scale;
        particle.angular_velocity = particle.angular_velocity * (1.0 / scale);
    }
    let walls = cube_of_walls(edge * scale);
    let background = gravity(981.0 / scale);
    let setup = Setup { walls, background, time_step: 2e-6 * scale, ..setup };
    let length = edge * scale;
    (Simulation::new(setup).unwrap(), length * length * length)
}

#[test]
fn larger_and_stiffer_spheres_have_the_same_stress_and_packing_at_the_same_strain() {
    let runs = [1.0, 2.0, 3.0].map(|scale| {
        let (mut simulation, volume) = scaled(scale);
        let mut seen: Vec<Observation> = Vec::new();
        for _ in 0..6 {
            simulation.advance(200).unwrap();
            seen.push(simulation.observe(&ObservationPlan::whole()).remove(0));
        }
        let ledger = simulation.ledger();
        (seen, volume, ledger.dissipated() / ledger.scale)
    });
    let [(seen, volume, lost), others @ ..] = &runs;
    assert!(seen[5].contacts > 100.0 && *lost > 0.1, "{} contacts, {lost}", seen[5].contacts);
    for (number, (other, larger, lost_there)) in others.iter().enumerate() {
        for (one, other) in seen.iter().zip(other) {
            assert_eq!((one.contacts, one.rattlers), (other.contacts, other.rattlers));
            // A factor of two changes no digit; one of three rounds otherwise, and contacts part trajectories slowly.
            let tolerance = if number == 0 { 1e-13 } else { 1e-9 };
            for axis in 0..3 {
                let (stress, there) = (one.stress(*volume)[axis][axis], other.stress(*larger)[axis][axis]);
                assert!((there / stress - 1.0).abs() < tolerance, "{stress} {there}");
            }
        }
        assert!((lost_there / lost - 1.0).abs() < 1e-9);
    }
}
