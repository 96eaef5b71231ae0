//! What must not change: momentum, angular momentum, energy.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{elastic_gas, momentum_scale};
use pulvis_core::{Ledger, Simulation};

fn advance(simulation: &mut Simulation, steps: usize) -> f64 {
    let mut worst = 0.0_f64;
    for step in 0..steps {
        simulation.step().unwrap();
        if step % 50 == 0 {
            worst = worst.max(simulation.ledger().relative_error().abs());
        }
    }
    worst
}

#[test]
fn a_frictionless_elastic_gas_keeps_its_energy_better_the_shorter_the_step() {
    // The same simulated time with 100, 200 and 400 steps a contact.
    let errors: Vec<f64> = [100.0, 200.0, 400.0]
        .map(|steps_per_contact| {
            let mut gas = elastic_gas(300, steps_per_contact);
            advance(&mut gas, (10.0 * steps_per_contact) as usize)
        })
        .into();
    println!("{errors:?}");
    // Collisions begin and end between steps, each with an error of second order and random sign.
    let order = (errors[0] / errors[2]).log2() / 2.0;
    assert!(order > 1.6, "observed order {order}: {errors:?}");
}

#[test]
fn momentum_is_conserved_to_round_off_in_a_periodic_box() {
    let mut gas = elastic_gas(300, 50.0);
    let before = gas.particles().momentum();
    let scale = momentum_scale(&gas);
    advance(&mut gas, 2_000);
    let drift = (gas.particles().momentum() - before).norm();
    // Each step adds one rounding a particle and component: 2000 steps, random signs.
    assert!(drift < 1e-13 * scale, "{drift} of {scale}");
}

#[test]
fn an_undisturbed_ledger_has_no_error() {
    let mut gas = elastic_gas(50, 50.0);
    let Ledger { initial, .. } = gas.ledger();
    assert!(initial > 0.0);
    assert_eq!(gas.ledger().closing_error(), 0.0);
}
