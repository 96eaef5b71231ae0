//! The closed forms that the viscous laws and the attraction name in the catalogue, on integrated
//! collisions of one pair.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use std::f64::consts::PI;

use pulvis_contact::noncontact::{JumpIn, Reversible};
use pulvis_contact::normal::Interpolation;
use pulvis_contact::viscosity::{Constant, Hardening, OverlapPower, Restitution};
use pulvis_contact::{ContactLaws, ContactModel, Linear, Luding, NonContact, Normal, Pair, Viscosity};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::collisions::collide as testkit_collide;

const STIFFNESS: f64 = 100.0;
const REDUCED_MASS: f64 = 5.575e-6;

/// A head-on collision with a wall, which sees the mass itself as the reduced mass. The first touch
/// falls on a step; the end is found between two steps.
struct Collision {
    restitution: f64,
    duration: f64,
}

fn collide(model: &ContactModel, speed: f64, dt: f64) -> Collision {
    let radius = 1e-3;
    let mut sphere = Sphere::at_rest(REDUCED_MASS, radius, Vector3::new(0.0, 0.0, radius));
    sphere.velocity.z = -speed;
    let mut couple = Couple::new(model, sphere, None);
    let mut before = (0.0, sphere.velocity.z);
    let steps = couple.step_until(dt, 1_000_000, |couple| {
        let open = couple.overlap <= 0.0;
        if !open {
            before = (couple.overlap, couple.i.velocity.z);
        }
        open
    });
    // Linear in the last step, from the overlap before it to the one after it.
    let part = before.0 / (before.0 - couple.overlap);
    let velocity = before.1 + part * (couple.i.velocity.z - before.1);
    Collision { restitution: velocity / speed, duration: dt * (steps as f64 - 1.0 + part) }
}

fn model(normal: impl Into<Normal>, viscosity: impl Into<Option<Viscosity>>) -> ContactModel {
    let mut laws = ContactLaws::default();
    if let Some(viscosity) = viscosity.into() {
        laws.viscosity = viscosity;
    }
    ContactModel { normal: normal.into(), laws }
}

const CONTACT_TIME: f64 = 7.4e-4;

/// Checks restitution and duration of a linear contact with a dashpot.
fn rebounds(model: &ContactModel, restitution: f64, duration: f64) {
    let [coarse, fine] = [400.0, 1600.0].map(|steps| collide(model, 0.01, CONTACT_TIME / steps));
    // The dashpot sets in with a jump and the end is interpolated: first order in the step.
    assert!((fine.restitution - restitution).abs() < 4e-3, "{} {restitution}", fine.restitution);
    assert!((fine.duration / duration - 1.0).abs() < 4e-3, "{} {duration}", fine.duration);
    let error = |collision: &Collision| (collision.restitution - restitution).abs();
    assert!(error(&fine) < 0.5 * error(&coarse) + 1e-6, "{} {}", error(&coarse), error(&fine));
}

#[test]
fn a_linear_contact_has_the_restitution_and_duration_of_its_dashpot() {
    // e = exp(−π h/ω), t_c = π/ω; S1 (3), (4).
    let (restitution, duration) = (0.7156851186369, 7.4596842144e-4);
    rebounds(&model(Linear::new(STIFFNESS, 5e-3), None), restitution, duration);
    let spring = Linear::new(STIFFNESS, 0.0);
    rebounds(&model(spring, Viscosity::Constant(Constant { gamma_0: 5e-3 })), restitution, duration);
    // The linear spring does not harden: the full dashpot from the first touch.
    rebounds(&model(spring, Viscosity::Hardening(Hardening { gamma_0: 5e-3 })), restitution, duration);
}

#[test]
fn the_jumps_of_a_dashpot_cost_no_order_of_the_integration_wherever_in_a_step_the_bodies_touch() {
    let spring = |gamma| model(Linear::new(STIFFNESS, gamma), None);
    let beside = |gamma_0| model(Linear::new(STIFFNESS, 0.0), Viscosity::Constant(Constant { gamma_0 }));
    for restitution in [0.5_f64, 0.9] {
        let log = restitution.ln();
        let gamma = -2.0 * log * (STIFFNESS * REDUCED_MASS / (PI * PI + log * log)).sqrt();
        for contact in [spring(gamma), beside(gamma)] {
            let errors = [50.0, 400.0].map(|steps| {
                let phases = [0.03, 0.21, 0.37, 0.55, 0.71, 0.93].map(|phase| {
                    // An end beyond touch makes the collision begin before it.
                    let end = -1e-12 * 1e-3;
                    let dt = CONTACT_TIME / (steps + phase);
                    let found = testkit_collide(&contact, (REDUCED_MASS, 1e-3), 0.01, dt, end);
                    assert!(found.missing < 40.0 / (steps * steps), "{} is missing", found.missing);
                    (found.restitution - restitution).abs()
                });
                phases.into_iter().fold(0.0, |worst, error| if error <= worst { worst } else { error })
            });
            // Without weights 1e-2 with 50 steps and an eighth of it with 400.
            assert!(errors[0] < 2e-3 && errors[1] < errors[0] / 20.0, "{restitution}: {errors:?}");
        }
    }
}

#[test]
fn a_restitution_is_met_by_every_way_of_asking_for_it() {
    let law = |restitution: f64| {
        let values = pulvis_contact::catalogue::Values::new()
            .with("restitution", restitution)
            .with("stiffness", STIFFNESS);
        let Some(Ok(viscosity)) = Viscosity::build("restitution", &values) else { panic!("valid") };
        assert!(matches!(viscosity, Viscosity::Restitution(Restitution { .. })));
        viscosity
    };
    for restitution in [0.3, 0.5, 0.9, 1.0_f64] {
        let log = restitution.ln();
        // ω² = k/m_r π²/(π² + ln² e).
        let duration = ((PI * PI + log * log) * REDUCED_MASS / STIFFNESS).sqrt();
        rebounds(&model(Linear::new(STIFFNESS, 0.0), law(restitution)), restitution, duration);
        rebounds(&model(Linear::from_restitution(STIFFNESS, restitution), None), restitution, duration);
        let timed = Linear::from_contact_time(CONTACT_TIME, restitution);
        rebounds(&model(timed, None), restitution, CONTACT_TIME);
    }
    // contact-time check value: k = 100, m_r = 5.575e-6, e = 0.5 needs γ = 1.0174346245e-2 kg/s.
    let gamma = law(0.5).largest_coefficient(&Pair::wall(REDUCED_MASS, 1e-3), STIFFNESS);
    assert!((gamma / 1.0174346245e-2 - 1.0).abs() < 1e-10, "{gamma}");
}

#[test]
fn a_hardening_dashpot_does_not_act_on_a_contact_that_cannot_harden() {
    let elastic =
        Luding { k1: STIFFNESS, kp: STIFFNESS, kc: 0.0, phi_f: 0.05, interpolation: Interpolation::Linear };
    let viscosity = Viscosity::Hardening(Hardening { gamma_0: 5e-3 });
    let collision = collide(&model(elastic, viscosity), 0.01, CONTACT_TIME / 1600.0);
    assert!((collision.restitution - 1.0).abs() < 1e-5, "{}", collision.restitution);
}

#[test]
fn a_dashpot_of_an_overlap_power_loses_the_energy_of_its_beta_function() {
    // Undamped: δ = A sin ωt, so that γ_0 ∫ (δ/δ_p)^q (dδ/dt)² dt = γ_0 (A/δ_p)^q v²/ω B((q+1)/2, 3/2).
    // B(3/4, 3/2) = 0.95851..., B(1, 3/2) = 2/3, B(3/2, 3/2) = π/8.
    let beta_three_quarters = 0.958_512_187_788;
    for (exponent, beta) in [(0.5, beta_three_quarters), (1.0, 2.0 / 3.0), (2.0, PI / 8.0)] {
        let (speed, gamma_0) = (0.05, 1e-4);
        let omega = (STIFFNESS / REDUCED_MASS).sqrt();
        let scale = 2.0 * 1e-3;
        let expected = 2.0 * gamma_0 / (REDUCED_MASS * omega) * (speed / omega / scale).powf(exponent) * beta;
        let viscosity = Viscosity::OverlapPower(OverlapPower { gamma_0, exponent });
        let law = model(Linear::new(STIFFNESS, 0.0), viscosity);
        let lost = 1.0 - collide(&law, speed, CONTACT_TIME / 6400.0).restitution.powi(2);
        // First order in γ_0: the next order is of the relative size of the loss itself.
        assert!((lost / expected - 1.0).abs() < expected + 2e-3, "q = {exponent}: {lost} {expected}");
        assert!(expected < 1e-2, "the loss is small enough: {expected}");
    }
}

/// Speed out of reach after an elastic collision that started at `speed` just out of reach [m/s].
fn attracted(attraction: NonContact, speed: f64, steps: f64) -> f64 {
    let radius = 1e-3;
    let interaction_range = attraction.interaction_range(&Pair::wall(REDUCED_MASS, radius));
    let laws = ContactLaws { noncontact: attraction, ..ContactLaws::default() };
    let law = ContactModel { normal: Linear::new(STIFFNESS, 0.0).into(), laws };
    let mut sphere =
        Sphere::at_rest(REDUCED_MASS, radius, Vector3::new(0.0, 0.0, radius + 1.001 * interaction_range));
    sphere.velocity.z = -speed;
    let mut couple = Couple::new(&law, sphere, None);
    couple.step_until(CONTACT_TIME / steps, 10_000_000, |couple| {
        couple.overlap < -1.0005 * interaction_range && couple.i.velocity.z > 0.0
    });
    couple.i.velocity.z
}

#[test]
fn a_reversible_attraction_gives_back_what_it_took() {
    let attraction = NonContact::Reversible(Reversible { f_a: 1e-4, kc_a: 50.0 });
    let [coarse, fine] = [200.0, 800.0].map(|steps| (attracted(attraction, 0.01, steps) / 0.01 - 1.0).abs());
    // Second order where the force has kinks only.
    assert!(fine < 1e-5 && fine <= coarse / 8.0 + 1e-8, "{coarse} {fine}");
}

#[test]
fn an_attraction_without_reach_gives_back_what_it_took_or_nothing_at_all() {
    // Both act in contact alone, and jump where the bodies touch and where they part.
    let (f_a, kc_a) = (1e-4, f64::INFINITY);
    for attraction in
        [NonContact::Reversible(Reversible { f_a, kc_a }), NonContact::JumpIn(JumpIn { f_a, kc_a })]
    {
        let laws = ContactLaws { noncontact: attraction, ..ContactLaws::default() };
        let law = ContactModel { normal: Linear::new(STIFFNESS, 0.0).into(), laws };
        let [coarse, fine] = [50.0, 400.0].map(|steps| {
            let errors = [0.03, 0.21, 0.37, 0.55, 0.71, 0.93].map(|phase| {
                let dt = CONTACT_TIME / (steps + phase);
                let found = testkit_collide(&law, (REDUCED_MASS, 1e-3), 0.02, dt, -1e-12 * 1e-3);
                (found.restitution - 1.0).abs()
            });
            errors.into_iter().fold(0.0, |worst, error| if error <= worst { worst } else { error })
        });
        assert!(coarse < 4e-3 && fine <= coarse / 20.0 + 1e-9, "{attraction:?}: {coarse} {fine}");
    }
}

#[test]
fn a_jump_in_attraction_costs_its_pull_off_energy() {
    // e = √(1 − (v_f/v)²), v_f = f_a/√(m_r k_c^a).
    let (f_a, kc_a, speed) = (1e-4, 50.0, 0.02);
    let attraction = NonContact::JumpIn(JumpIn { f_a, kc_a });
    let pull_off = f_a / (REDUCED_MASS * kc_a).sqrt();
    let expected = (1.0 - (pull_off / speed) * (pull_off / speed)).sqrt();
    let [coarse, fine] =
        [200.0, 1600.0].map(|steps| (attracted(attraction, speed, steps) / speed - expected).abs());
    // A step in which the force jumps is weighted: second order.
    assert!(fine < 1e-6 && fine <= coarse / 20.0 + 1e-9, "{coarse} {fine}, expected {expected}");
}
