//! The energy ledger of a whole protocol: pressed by servo walls, released, freed, pulled by a sticky plate.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::disallowed_methods,
    clippy::print_stderr
)]

mod protocol_scenarios;

use protocol_scenarios::{Series, run, small_tablet, tablet};
use pulvis_lab::protocol::prepare;

#[test]
fn the_ledger_closes_to_a_ten_thousandth_at_the_automatic_step() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&small_tablet(), folder.path());
    assert!(summary.energy_error_max < 1e-4, "{:e}", summary.energy_error_max);
    // Every account that this protocol can move has moved, so that none is left out of the sum.
    let series = Series::read(folder.path());
    for account in [
        "dissipated_plastic",
        "dissipated_viscous",
        "dissipated_sliding",
        "dissipated_rolling",
        "dissipated_torsion",
        "dissipated_background",
        "dissipated_adhesive",
        "work_walls",
        "work_servo",
        "switched",
        "elastic_normal",
        "kinetic_rotation",
    ] {
        assert!(series.column(account).iter().any(|&energy| energy != 0.0), "{account}");
    }
}

#[test]
fn the_closing_error_falls_at_second_order_with_the_time_step() {
    let steps = [20.0, 40.0, 80.0];
    let errors = steps.map(mean_error);
    // Least squares through three equidistant points is the line through the outer ones.
    let order = (errors[0] / errors[2]).ln() / (steps[2] / steps[0]).ln();
    eprintln!("closing errors {errors:?} with {steps:?} steps in a contact time: order {order:.2}");
    // Velocity-Verlet is of second order; a branch that begins or ends within a step costs an energy that
    // falls with the square of the step as well, but by a factor that is drawn anew for every event.
    assert!(order > 1.5, "order {order}, errors {errors:?}");
}

/// Largest closing error of a run, mean over three samples.
fn mean_error(steps_per_contact_time: f64) -> f64 {
    let seeds = ["seed = 1", "seed = 2", "seed = 3"];
    let steps = format!("steps_per_contact_time = {steps_per_contact_time}");
    let error = |seed: &str| {
        let text = tablet(&[("seed = 1", seed), ("steps_per_contact_time = 50", &steps)]);
        let folder = tempfile::tempdir().unwrap();
        run(&text, folder.path()).energy_error_max
    };
    seeds.map(error).iter().sum::<f64>() / 3.0
}

#[test]
fn the_automatic_step_is_the_stated_fraction_of_the_shortest_contact_of_each_stage() {
    let prepared = prepare(&small_tablet()).unwrap();
    for stage in &prepared.stages {
        let shortest = stage.shortest.unwrap().duration;
        assert!((stage.time_step * 50.0 / shortest - 1.0).abs() < 1e-12);
    }
    // The stiff adhesion of the plates shortens the step of the last stage.
    assert!(prepared.stages[2].time_step < prepared.stages[1].time_step);
}
