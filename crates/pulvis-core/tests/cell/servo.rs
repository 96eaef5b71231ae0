//! A cell that follows stresses.

use super::common::{start, states};
use super::lattice::{exact_stress, lattice};
use super::{constant, packing, stress};
use pulvis_core::{CellControl, CellMotion, UpperTriangular};
use pulvis_math::Vector3;

/// The edge at which the lattice has this pressure, over that at the start [1], by bisection.
fn exact_stretch(edge: f64, pressure: f64) -> f64 {
    let (mut low, mut high) = (0.9, 1.01);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let deformation = UpperTriangular { xx: middle, yy: middle, zz: middle, ..UpperTriangular::ZERO };
        if exact_stress(edge, &deformation, 0, 0) > pressure { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn a_lattice_under_a_pressure_comes_to_the_strain_of_its_springs() {
    let (setup, edge) = lattice(0.01);
    let mut simulation = start(setup, 50.0);
    let pressure = 4e4;
    let motion =
        CellMotion { isotropic: Some(constant(pressure)), inertial_number: 0.02, ..CellMotion::default() };
    simulation.set_cell_motion(motion).unwrap();
    simulation.advance(20_000).unwrap();
    let found = (simulation.cell_strain().xx).exp();
    let exact = exact_stretch(edge, pressure);
    assert!((found - exact).abs() < 1e-7, "{found} {exact}");
    assert!((stress(&simulation, 2, 2) / pressure - 1.0).abs() < 1e-6);
    assert!(states(&simulation).iter().all(|state| state.velocity.norm() < 1e-9));
}

#[test]
fn a_rate_along_one_axis_and_stresses_along_the_others_are_kept_together() {
    let (setup, _) = lattice(0.02);
    let mut simulation = start(setup, 50.0);
    let mut motion = CellMotion { inertial_number: 0.02, ..CellMotion::default() };
    let rate = -0.02 / (20_000.0 * simulation.time_step());
    motion.components[0] = CellControl::Stress(constant(3e4));
    motion.components[1] = CellControl::Stress(constant(5e4));
    motion.components[2] = CellControl::Rate(rate);
    simulation.set_cell_motion(motion).unwrap();
    simulation.advance(20_000).unwrap();
    // The targets are followed with a lag: the rate over K/η of the servo.
    assert!((stress(&simulation, 0, 0) / 3e4 - 1.0).abs() < 0.02, "{}", stress(&simulation, 0, 0));
    assert!((stress(&simulation, 1, 1) / 5e4 - 1.0).abs() < 0.02, "{}", stress(&simulation, 1, 1));
    assert!((simulation.cell_strain().zz + 0.02).abs() < 1e-9);
    assert!(simulation.ledger().relative_error().abs() < 1e-5);
}

#[test]
fn a_packing_is_sheared_at_constant_pressure_on_the_sheared_faces() {
    let mut simulation = packing(100, 0.66, 30.0);
    let target = 0.5 * stress(&simulation, 1, 1);
    assert!(target > 0.0);
    let mut motion = CellMotion { inertial_number: 0.1, ..CellMotion::default() };
    motion.components[1] = CellControl::Stress(constant(target));
    motion.components[3] = CellControl::Rate(0.3 / (12_000.0 * simulation.time_step()));
    simulation.set_cell_motion(motion).unwrap();
    simulation.advance(4000).unwrap();
    let mut mean = 0.0;
    for _ in 0..800 {
        simulation.advance(10).unwrap();
        mean += stress(&simulation, 1, 1) / 800.0;
    }
    assert!((mean / target - 1.0).abs() < 0.05, "{mean} {target}");
    assert!((simulation.cell_strain().xy - 0.3).abs() < 1e-6);
    assert!(simulation.cell_rate().xx == 0.0 && simulation.domain().extent.size().is_finite());
    let momentum = simulation.particles().masses().iter().zip(simulation.particles().velocities().iter());
    let momentum =
        momentum.map(|(mass, velocity)| velocity * *mass).fold(Vector3::zero(), |sum, one| sum + one);
    assert!(momentum.is_finite());
}
