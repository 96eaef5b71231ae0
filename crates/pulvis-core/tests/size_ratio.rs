//! Small grains between large ones.
//!
//! Springs that are stretched with velocities of one instant along normals of another take in a part
//! of the normal motion as sliding. Between grains of very different size that part is large: a small
//! grain sticks where it should slip (Vyas et al., arXiv:2410.14798).
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::*;
use pulvis_contact::{ContactModel, Linear};
use pulvis_core::Setup;
use pulvis_math::Vector3;

/// The large radii over the small one.
const RATIOS: [f64; 4] = [3.0, 5.0, 10.0, 30.0];

/// At which both contact normals stand to the line of the large centres. Steeper, the largest grains would overlap.
const SLOPE: f64 = 0.2;

/// A small grain in the neck of two large ones that close in on it from both sides, all with friction.
fn neck(ratio: f64, friction: f64) -> Setup {
    let mut model = ContactModel::frictionless(Linear::new(1000.0, 0.0));
    model.laws.sliding = Some(slider(1000.0 * 2.0 / 7.0, 0.0, friction));
    let large = ratio * RADIUS;
    let apart = large + RADIUS;
    let place = vector(apart * SLOPE.cos(), 0.0, -apart * SLOPE.sin());
    let speed = 0.02;
    let grains = vec![
        sphere(Vector3::zero(), Vector3::zero(), RADIUS),
        sphere(place, vector(-speed, 0.0, 0.0), large),
        sphere(vector(-place.x, 0.0, place.z), vector(speed, 0.0, 0.0), large),
    ];
    setup(grains, model)
}

#[test]
fn a_small_grain_between_large_ones_moves_the_same_with_a_tenth_of_the_step() {
    // From hardly any friction to more than the neck's tangent, which locks the grain.
    let cases = RATIOS.into_iter().flat_map(|ratio| [0.05, 0.1, 0.4].map(|friction| (ratio, friction)));
    for (ratio, friction) in cases {
        let [coarse, fine] = [50.0, 500.0].map(|steps_per_contact| {
            let mut neck = start(neck(ratio, friction), steps_per_contact);
            advance(&mut neck, (30.0 * steps_per_contact) as usize);
            states(&neck)[0]
        });
        let moved = fine.position.z.abs().max(1e-3 * RADIUS);
        let apart = (coarse.position - fine.position).norm();
        // Of second order in the step; a grain that sticks where it should slip is wrong by all of it.
        assert!(apart < 3e-3 * moved, "ratio {ratio}, friction {friction}: {apart} of {moved}");
    }
}

#[test]
fn a_grain_slips_out_of_the_neck_below_the_locking_friction_only() {
    // Two contacts at the angle s to the horizontal lock a light grain from μ = tan s on: 0.203.
    for ratio in RATIOS {
        // Where the grain is when the large ones turn back (the largest are too heavy to do so soon), and what sliding has cost by then.
        let squeezed = |friction: f64| {
            let mut neck = start(neck(ratio, friction), 50.0);
            let mut steps = 0;
            while states(&neck)[1].velocity.x < 0.0 && steps < 1_500 {
                advance(&mut neck, 1);
                steps += 1;
            }
            (states(&neck)[0].position.z / RADIUS, neck.ledger().dissipated_sliding)
        };
        let [(slipping, lost), (locked, lost_locked)] = [0.1, 0.4].map(squeezed);
        // The nearer the centres, the sooner the neck widens: least at a ratio of 3.
        assert!(slipping > 0.1 && lost > 0.0, "ratio {ratio}: {slipping} {lost}");
        // The springs of the locked contacts give way.
        let locks = locked.abs() < 0.1 && lost_locked == 0.0;
        assert!(locks, "ratio {ratio}: {locked} {lost_locked}");
    }
}
