//! Every joule that is lost has an account, and is lost once.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_contact::conventions::SlipDashpot;
use pulvis_contact::noncontact::{JumpIn, LiquidBridge};
use pulvis_contact::theory::LinearSpringDashpot;
use pulvis_contact::{ContactModel, Linear, NonContact};
use pulvis_core::{Background, Ledger, Setup};

const EDGE: f64 = 12.5 * RADIUS;

/// Spheres that fall together, and down, in a box.
fn box_of_powder(model: ContactModel) -> Setup {
    Setup {
        walls: cube_of_walls(EDGE),
        background: Background { drag: 1e-6, rotational_drag: 1e-6, ..gravity(9.81) },
        ..implosion(70, EDGE, 5, model)
    }
}

fn closing_errors(powder: &Setup, contact_times: f64) -> Vec<f64> {
    let watch = |steps_per_contact: f64| {
        let steps = (contact_times * steps_per_contact) as usize;
        advance_watching(&mut start(powder.clone(), steps_per_contact), steps, 10)
    };
    [50.0, 100.0, 200.0, 400.0, 800.0].map(watch).into()
}

#[test]
fn the_ledger_closes_at_second_order_with_all_springs_and_a_dashpot_along_the_normal() {
    let mut model = luding();
    model.laws.viscosity = viscous_luding().laws.viscosity;
    let errors = closing_errors(&box_of_powder(model), 60.0);
    assert!(errors[0] < 1e-4, "{errors:?}");
    assert!(order(&errors) > 1.7, "observed order {}: {errors:?}", order(&errors));
}

#[test]
fn the_ledger_of_the_whole_model_closes_at_second_order_but_for_what_dashpots_lose_by_slip() {
    // Their books run half a step ahead of that: first order, of a small part of the energy.
    let errors = closing_errors(&box_of_powder(viscous_luding()), 60.0);
    assert!(errors[0] < 1e-4, "{errors:?}");
    assert!(order(&errors) > 0.9, "observed order {}: {errors:?}", order(&errors));
    let mut printed = viscous_luding();
    printed.laws.conventions.slip_dashpot = SlipDashpot::Printed;
    let errors = closing_errors(&box_of_powder(printed), 60.0);
    assert!(errors[0] < 1e-4, "{errors:?}");
    assert!(order(&errors) > 1.7, "observed order {}: {errors:?}", order(&errors));
}

#[test]
fn an_attraction_that_jumps_in_closes_the_ledger_at_first_order() {
    let mut model = luding();
    model.laws.noncontact = NonContact::JumpIn(JumpIn { f_a: 1e-4, kc_a: 50.0 });
    let errors = closing_errors(&box_of_powder(model), 60.0);
    // Touches lie anywhere between two steps, and the force jumps there.
    assert!(errors[0] < 1e-3, "{errors:?}");
    assert!(order(&errors) > 0.75, "observed order {}: {errors:?}", order(&errors));
}

#[test]
fn a_liquid_bridge_is_dissipated_when_it_forms_held_while_it_is_stretched_and_gone_when_it_breaks() {
    // R = 1 mm, 2500 kg/m³, 1e-12 m³ of water: the work to rupture, and v_w = √(2 W/m_r).
    let (rupture_work, wet_speed) = (1.014_100_887_288e-8, 0.062_238);
    let (radius, speed) = (1e-3, 0.1);
    let mut model = elastic();
    model.laws.noncontact = NonContact::LiquidBridge(LiquidBridge::new(1e-12, 0.072, 0.0));
    let one = sphere(vector(-1.0001 * radius, 0.0, 0.0), vector(0.5 * speed, 0.0, 0.0), radius);
    let other = sphere(vector(1.0001 * radius, 0.0, 0.0), vector(-0.5 * speed, 0.0, 0.0), radius);
    let mut pair = start(setup(vec![one, other], model), 200.0);
    let kinetic = pair.ledger().kinetic();
    let (mut deepest, mut stretched) = (0.0_f64, f64::NEG_INFINITY);
    while pair.ledger().dissipated_capillary == 0.0 {
        assert_eq!(pair.ledger().capillary, 0.0);
        pair.step().unwrap();
    }
    while pair.ledger().capillary != 0.0 {
        let ledger = pair.ledger();
        assert!((ledger.dissipated_capillary / rupture_work - 1.0).abs() < 1e-10, "{ledger:?}");
        assert!(ledger.relative_error().abs() < 2e-3, "{ledger:?}");
        (deepest, stretched) = (deepest.min(ledger.capillary), stretched.max(ledger.capillary));
        pair.step().unwrap();
    }
    advance(&mut pair, 2);
    let ledger = pair.ledger();
    // Deeper than at touch while pressed, almost nothing before it breaks.
    assert!(deepest < -1.05 * rupture_work && stretched > -0.05 * rupture_work, "{deepest} {stretched}");
    assert_eq!((ledger.adhesive, ledger.dissipated_adhesive), (0.0, 0.0));
    let expected = 1.0 - (wet_speed / speed) * (wet_speed / speed);
    // v_w is printed to five digits; the steps of the two jumps.
    assert!((ledger.kinetic() / kinetic / expected - 1.0).abs() < 1e-3, "{ledger:?}");
    assert!(ledger.relative_error().abs() < 1e-3, "{ledger:?}");
}

fn losses(ledger: &Ledger) -> [f64; 5] {
    [
        ledger.dissipated_plastic,
        ledger.dissipated_adhesive,
        ledger.dissipated_sliding,
        ledger.dissipated_rolling,
        ledger.dissipated_torsion,
    ]
}

#[test]
fn without_dashpots_every_loss_only_grows() {
    let mut powder = start(box_of_powder(luding()), 50.0);
    let mut before = losses(&powder.ledger());
    assert_eq!(before, [0.0; 5]);
    for _ in 0..3_000 {
        powder.step().unwrap();
        let ledger = powder.ledger();
        let now = losses(&ledger);
        for (account, (now, before)) in now.iter().zip(before).enumerate() {
            // A contact that opens corrects what its springs did in the rest of the step: second order in the step.
            let correction = if account < 2 { 1e-15 } else { 1e-7 };
            assert!(*now >= before - correction * ledger.scale, "account {account}: {before} then {now}");
        }
        before = now;
    }
    assert!(before.iter().all(|&lost| lost > 0.0), "{before:?}");
}

#[test]
fn dashpots_and_slip_together_only_lose() {
    let mut powder = start(box_of_powder(viscous_luding()), 50.0);
    let mut before = 0.0;
    for _ in 0..3_000 {
        powder.step().unwrap();
        let ledger = powder.ledger();
        // The books of a dashpot in series with a slider run half a step ahead of what it loses by slip.
        let now = ledger.dissipated_viscous
            + ledger.dissipated_sliding
            + ledger.dissipated_rolling
            + ledger.dissipated_torsion;
        assert!(now >= before - 1e-7 * ledger.scale, "{before} then {now} of {}", ledger.scale);
        before = now;
    }
    let ledger = powder.ledger();
    assert!(ledger.dissipated_background > 0.0 && ledger.dissipated_viscous > 0.0);
}

/// The most that an isolated cloud of 150 grains ever holds, over what it began with, and its books at the end.
/// Tangential dashpots are 1.25 times the critical one.
fn most_held_by_a_cloud(slip_dashpot: SlipDashpot, steps_per_contact: f64) -> (f64, Ledger) {
    let mut model = luding();
    model.laws.sliding = Some(slider(100.0, 2e-2, 0.5));
    model.laws.rolling = Some(slider(50.0, 1e-2, 0.1));
    model.laws.torsion = Some(slider(50.0, 1e-2, 0.1));
    model.laws.conventions.slip_dashpot = slip_dashpot;
    let mut cloud = start(implosion(150, 13.0 * RADIUS, 3, model), steps_per_contact);
    let initial = cloud.ledger().stored();
    let mut most = 0.0_f64;
    let rounds = (150.0 * steps_per_contact / 25.0) as usize;
    for _ in 0..rounds {
        advance(&mut cloud, 25);
        let held = cloud.ledger().stored();
        assert!(held.is_finite());
        most = most.max(held / initial);
    }
    (most, cloud.ledger())
}

#[test]
fn an_isolated_cloud_never_holds_more_than_it_began_with_however_strong_the_dashpots_of_friction() {
    for (steps, tolerance) in [(50.0, 1e-3), (400.0, 1e-5)] {
        let (most, ledger) = most_held_by_a_cloud(SlipDashpot::Series, steps);
        // Second order in the step.
        assert!(most <= 1.0 + tolerance, "{most} at {steps} steps a contact");
        let lost = [
            ledger.dissipated_viscous,
            ledger.dissipated_sliding,
            ledger.dissipated_rolling,
            ledger.dissipated_torsion,
        ];
        assert!(lost.iter().all(|&lost| lost > 0.0), "{lost:?}");
        assert!(ledger.relative_error().abs() < 1e-3, "{}", ledger.relative_error());
    }
    // The rule as printed stretches the springs without bound, and takes the energy from the slip account.
    let (most, ledger) = most_held_by_a_cloud(SlipDashpot::Printed, 50.0);
    assert!(most > 1.05 && ledger.dissipated_sliding < -ledger.initial, "{most} {ledger:?}");
}

#[test]
fn contacts_at_the_start_have_lost_what_they_lost_before() {
    let pair = [0.0, 1.9 * RADIUS].map(|x| sphere(vector(x, 0.0, 0.0), vector(0.0, 0.0, 0.0), RADIUS));
    let mut pair = start(setup(pair.into(), luding()), 100.0);
    let ledger = pair.ledger();
    assert!(ledger.elastic_normal > 0.0);
    assert_eq!(ledger.initial, ledger.stored());
    assert_eq!(ledger.dissipated(), 0.0);
    assert_eq!(ledger.closing_error(), 0.0);
    assert!(advance_watching(&mut pair, 200, 1) < 1e-3);
}

/// Restitution of two unequal spheres that meet at 0.2 m/s along a slanted line.
fn restitution(model: ContactModel, steps_per_contact: f64) -> f64 {
    let along = vector(0.48, 0.6, 0.64);
    let gap = 0.3123 * RADIUS;
    let pair = vec![
        sphere(vector(0.0, 0.0, 0.0), along * 0.2, RADIUS),
        sphere(along * (1.7 * RADIUS + gap), vector(0.0, 0.0, 0.0), 0.7 * RADIUS),
    ];
    let setup = setup(pair, model);
    let flight = gap / 0.2;
    let steps = ((flight + 3.0 * contact_time(&setup)) / contact_time(&setup) * steps_per_contact) as usize;
    let mut simulation = start(setup, steps_per_contact);
    advance(&mut simulation, steps);
    let states = states(&simulation);
    (states[1].velocity - states[0].velocity).dot(along) / 0.2
}

#[test]
fn the_restitution_of_a_dashpot_converges_to_the_closed_form() {
    let (stiffness, dashpot) = (1000.0, 8e-3);
    let masses = [RADIUS, 0.7 * RADIUS]
        .map(|radius| sphere(vector(0.0, 0.0, 0.0), vector(0.0, 0.0, 0.0), radius).mass);
    let reduced_mass = masses[0] * masses[1] / (masses[0] + masses[1]);
    let theory = LinearSpringDashpot::new(stiffness, dashpot, reduced_mass).unwrap().restitution();
    assert!(theory > 0.2 && theory < 0.8, "{theory}");
    for steps_per_contact in [25.0, 50.0, 100.0, 400.0, 1600.0] {
        let error =
            restitution(ContactModel::frictionless(Linear::new(stiffness, dashpot)), steps_per_contact)
                - theory;
        // The dashpot's force jumps at touch and at parting, anywhere within a step: first order.
        assert!(error.abs() < 0.5 / steps_per_contact, "{steps_per_contact}: {error}");
    }
}
