//! Which time steps are stable, measured on the integrator against its characteristic polynomial.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_contact::viscosity::{Constant, Viscosity};
use pulvis_contact::{ContactModel, Linear};
use pulvis_core::{Background, Setup, Simulation};
use pulvis_math::Vector3;

/// Whether the motion of a sphere that is pressed into the floor, and held there by gravity, dies out.
/// `w` = ω dt of the contact, `h` = γ dt/m of its dashpot, `drag` = γ_b dt/m of the background.
fn dies_out(w: f64, h: f64, drag: f64) -> bool {
    let time_step = 1e-6;
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let stiffness = mass * (w / time_step) * (w / time_step);
    let mut model = ContactModel::frictionless(Linear::new(stiffness, 0.0));
    model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: h * mass / time_step });
    // At rest it is pressed in by a tenth of its radius, and moves by up to a thousandth of that: it stays in contact.
    let overlap = 0.1 * RADIUS;
    let strength = stiffness * overlap / mass;
    let resting = sphere(vector(0.0, 0.0, RADIUS - overlap * (1.0 + 1e-9)), Vector3::zero(), RADIUS);
    let background = Background { drag: drag * mass / time_step, ..gravity(strength) };
    let setup = Setup { walls: vec![floor()], background, time_step, ..setup(vec![resting], model) };
    let mut simulation = Simulation::new(setup).unwrap();
    let mut farthest = |steps: u64| {
        let mut farthest = 0.0;
        for _ in 0..steps {
            simulation.step().unwrap();
            let depth = RADIUS - states(&simulation)[0].position.z;
            farthest = pulvis_math::max_or_nan(farthest, (depth / overlap - 1.0).abs());
        }
        farthest
    };
    let first = farthest(20);
    let last = farthest(400).min(1.0);
    assert!(first > 1e-10 && last.is_finite());
    last < 2.0 * first
}

#[test]
fn a_spring_with_a_dashpot_is_stable_where_w2_plus_4h_is_less_than_4() {
    for h in [0.05, 0.2, 0.5, 0.8, 0.95] {
        let [stable, unstable] = [3.9, 4.1].map(|sum: f64| (sum - 4.0 * h).sqrt());
        assert!(dies_out(stable, h, 0.0), "w = {stable}, h = {h}");
        assert!(!dies_out(unstable, h, 0.0), "w = {unstable}, h = {h}");
    }
}

#[test]
fn the_background_drag_counts_as_a_dashpot_does() {
    for (h, drag) in [(0.0, 0.5), (0.3, 0.3), (0.0, 0.9)] {
        let [stable, unstable] = [3.9, 4.1].map(|sum: f64| (sum - 4.0 * (h + drag)).sqrt());
        assert!(dies_out(stable, h, drag), "w = {stable}, h = {h}, drag {drag}");
        assert!(!dies_out(unstable, h, drag), "w = {unstable}, h = {h}, drag {drag}");
    }
}
