//! Collisions against the reference values of the papers' figures.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::disallowed_methods,
    clippy::print_stderr
)]

mod reference;

use pulvis_lab::collision::{Observation, Outcome, Regime, Sample, Sampling, collide};
use reference::{Row, rows};

/// The promise of the exact method is 1e-8 relative; a few dozen steps, each good to round-off, and
/// events met to round-off keep it by far. The worst rows lie beside a threshold, where e amplifies
/// errors by 1/e².
const PROMISE: f64 = 1e-10;

fn outcome(row: &Row) -> Outcome {
    collide(&row.case(), &Observation::default()).unwrap().outcome
}

/// Compares one outcome per row; `of` gives `None` for rows that it does not speak about.
fn compare(quantity: &str, least: usize, tolerance: f64, of: impl Fn(&Row, &Outcome) -> f64) {
    let rows: Vec<Row> = rows()
        .into_iter()
        // Thresholds and asymptotes carry no velocity.
        .filter(|row| row.text("quantity") == quantity && row.number("v_inf") > 0.0)
        // The tuned pair of figure 9 and the loops of figure 10 are rows of their own.
        .collect();
    assert!(rows.len() >= least, "only {} rows of {quantity}", rows.len());
    let mut worst: f64 = 0.0;
    for row in &rows {
        let (got, expected) = (of(row, &outcome(row)), row.value());
        let error = if expected == 0.0 { got.abs() } else { (got / expected - 1.0).abs() };
        assert!(error < tolerance, "{}: got {got}, expected {expected}", row.describe());
        worst = worst.max(error);
    }
    eprintln!("{quantity}: {} rows, largest relative error {worst:.1e}", rows.len());
}

#[test]
fn every_coefficient_of_restitution_of_the_papers_is_met() {
    compare("e", 400, PROMISE, |_, outcome| outcome.restitution);
}

#[test]
fn every_collision_ends_in_the_regime_and_on_the_branch_of_the_reference() {
    compare("outcome_code", 200, PROMISE, |_, outcome| match outcome.stop_branch {
        None => 0.0,
        Some("k2") => 1.0,
        Some("kc") => 2.0,
        Some("attraction") => 3.0,
        Some(other) => panic!("stopped on {other}"),
    });
}

#[test]
fn every_largest_overlap_is_met() {
    compare("delta_max_over_dp", 70, PROMISE, |row, outcome| outcome.overlap_max / row.plastic_limit());
}

#[test]
fn every_sticking_overlap_is_met() {
    compare("delta_turn_over_dp", 20, PROMISE, |row, outcome| {
        assert_eq!(outcome.regime, Regime::Stick);
        outcome.overlap_end / row.plastic_limit()
    });
}

#[test]
fn every_contact_duration_is_met() {
    compare("t_contact", 15, PROMISE, |_, outcome| outcome.contact_duration.unwrap());
}

#[test]
fn the_accounts_of_every_collision_close() {
    for row in rows().iter().filter(|row| row.text("quantity") == "e" && row.number("v_inf") > 0.0) {
        let error = outcome(row).energy_error;
        // Accounts are sums over a few dozen steps, each good to round-off.
        assert!(error.abs() < 1e-12, "{}: {error}", row.describe());
    }
}

/// The rows of one curve share a collision; compares samples at their times.
fn follow(figure: &str, quantity: &str, least: usize, of: impl Fn(&Row, &Sample) -> f64) {
    let all: Vec<Row> = rows().into_iter().filter(|row| row.is(figure, quantity)).collect();
    assert!(all.len() >= least, "only {} rows", all.len());
    let curves: std::collections::BTreeSet<String> =
        all.iter().map(|row| row.text("curve").to_owned()).collect();
    let mut worst: f64 = 0.0;
    for curve in &curves {
        let rows: Vec<&Row> = all.iter().filter(|row| row.text("curve") == curve).collect();
        let times: Vec<f64> = rows.iter().map(|row| row.number("x") * row.time_unit()).collect();
        let last = times.last().copied().unwrap();
        let observation = Observation {
            sampling: Sampling::At(times),
            time_after_sticking: last,
            ..Observation::default()
        };
        let course = collide(&rows[0].case(), &observation).unwrap().course;
        for (row, sample) in rows.iter().zip(&course) {
            let (got, expected) = (of(row, sample), row.value());
            // All quantities are of order one in the units of the figures. Times are given with
            // 16 digits, and what moves at unit rates is known to as much.
            assert!((got - expected).abs() < 1e-11, "{}: got {got}, expected {expected}", row.describe());
            worst = worst.max((got - expected).abs());
        }
        // A pair that has opened is not followed; the reference may go on.
        let missing: Vec<&&Row> = rows.iter().skip(course.len()).collect();
        assert!(missing.len() <= 1, "{curve}: {} of {} samples", course.len(), rows.len());
    }
    eprintln!("figure {figure}, {quantity}: {} curves, largest error {worst:.1e}", curves.len());
}

#[test]
fn the_motion_of_figures_7_and_11_is_followed_through_damping_sticking_and_oscillation() {
    for (figure, least) in [("7", 60), ("11", 100)] {
        follow(figure, "delta_over_dp", least, |row, sample| sample.overlap / row.plastic_limit());
    }
}

#[test]
fn the_force_loops_of_figures_7_and_11_are_followed() {
    for (figure, least) in [("7", 60), ("11", 100)] {
        follow(figure, "f_total_over_k1dp", least, |row, sample| {
            sample.force / (row.number("k1") * row.plastic_limit())
        });
    }
}

#[test]
fn the_energies_of_figure_15_are_followed() {
    let initial = |row: &Row| 0.5 * row.bodies().pair().reduced_mass() * row.number("v_inf").powi(2);
    follow("15", "E_kin_over_Ei", 40, |row, sample| sample.kinetic / initial(row));
    follow("15", "E_pot_over_Ei", 40, |row, sample| sample.potential_plastic / initial(row));
    follow("15", "E_avail_over_Ei", 40, |row, sample| sample.potential_available / initial(row));
}

#[test]
fn kinetic_available_attraction_and_lost_energy_add_up_at_every_instant() {
    for row in rows().iter().filter(|row| row.is("11", "e") || row.is("5", "e") && row.text("x") == "0.3") {
        let sampling = Sampling::Every(0.1 * row.time_unit());
        let time_after_sticking = 10.0 * row.time_unit();
        let observation = Observation { sampling, time_after_sticking, ..Observation::default() };
        let course = collide(&row.case(), &observation).unwrap().course;
        let total = |sample: &Sample| {
            sample.kinetic + sample.potential_available + sample.potential_attraction + sample.dissipated
        };
        let first = course[0].kinetic;
        for sample in &course {
            // Sums of round-off, in units of the energy that came in.
            assert!((total(sample) / first - 1.0).abs() < 1e-12, "{}: {sample:?}", row.describe());
        }
    }
}
