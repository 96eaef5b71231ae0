//! Dashpots that follow the elastic stiffness, on integrated collisions, against closed forms, series and an ODE solver.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use std::f64::consts::PI;

use pulvis_contact::theory::HertzPair;
use pulvis_contact::theory::hertz::tsuji_restitution;
use pulvis_contact::viscosity::{Critical, KuwabaraKono};
use pulvis_contact::{ContactLaws, ContactModel, Hertz, Linear, Normal, Viscosity};
use pulvis_testkit::collisions::{Collision, collide};

fn damped(normal: impl Into<Normal>, viscosity: Viscosity) -> ContactModel {
    ContactModel { normal: normal.into(), laws: ContactLaws { viscosity, ..ContactLaws::default() } }
}

/// The pair of the published numbers: k_H = 1e7 N/m^(3/2), m_r = 1e-6 kg.
const RADIUS: f64 = 1e-3;
const MASS: f64 = 1e-6;

fn modulus() -> f64 {
    0.75 * 1e7 / RADIUS.sqrt()
}

fn viscous(dissipative_time: f64, steps: f64) -> Collision {
    let model = damped(
        Hertz { effective_modulus: modulus() },
        Viscosity::KuwabaraKono(KuwabaraKono { dissipative_time }),
    );
    collide(&model, (MASS, RADIUS), 1.0, 2.04e-5 / steps, 0.0)
}

#[test]
fn visco_elastic_spheres_rebound_as_the_integrated_equation_says() {
    // A [s], e and t_c [s] at the end δ = 0: an ODE solver with a tolerance of 1e-13.
    let cases = [
        (1e-7, 0.9730228453628813, 2.036104687947505e-05),
        (1e-6, 0.7648378153329505, 2.0937194132128002e-05),
    ];
    for (time, restitution, duration) in cases {
        let errors = [500.3, 4000.3].map(|steps| {
            let found = viscous(time, steps);
            assert!((found.duration / duration - 1.0).abs() < 4e-4, "{}", found.duration);
            // Losses of dashpots are booked by the trapezoidal rule.
            assert!(found.missing < 40.0 / (steps * steps), "{}", found.missing);
            (found.restitution - restitution).abs()
        });
        // Between first and second order: the dashpot ~ √δ has a vertical tangent at touch and at the end.
        assert!(errors[0] < 1e-4 && errors[1] < errors[0] / 8.0, "A = {time}: {errors:?}");
    }
}

#[test]
fn the_series_of_the_viscous_restitution_has_the_printed_values_and_meets_the_law() {
    let pair = HertzPair::new(modulus(), RADIUS, MASS).unwrap();
    for (time, printed, error) in [(1e-7, 0.9730297612165031, 1e-5), (1e-6, 0.7709019997641231, 7e-3)] {
        let series = pair.viscous_restitution(time, 1.0);
        assert!((series - printed).abs() < 2e-10, "{series}");
        // The third order of the series.
        let found = viscous(time, 4000.3).restitution;
        assert!((found - series).abs() < error, "{found} {series}");
    }
    // 1 − e ~ v^(1/5): twice as much for 32 times the velocity.
    let [slow, fast] = [1.0, 32.0].map(|speed| 1.0 - pair.viscous_restitution(1e-12, speed));
    assert!((fast / slow - 2.0).abs() < 1e-4, "{slow} {fast}");
}

#[test]
fn a_fraction_of_critical_damping_gives_the_restitution_of_its_closed_forms() {
    for fraction in [0.02, 0.2, 0.6] {
        let dashpot = Viscosity::Critical(Critical { fraction });
        let (stiffness, mass) = (100.0_f64, 5e-6);
        let model = damped(Linear::new(stiffness, 0.0), dashpot);
        let expected = (-PI * fraction / (1.0 - fraction * fraction).sqrt()).exp();
        let dt = (mass / stiffness).sqrt() / 4000.3;
        let found = collide(&model, (mass, 1e-3), 0.1, dt, 0.0).restitution;
        // The dashpot sets in and ends with a jump 2 ζ ω v: first order, half a step too much of it at each end.
        assert!((found - expected).abs() < fraction * 5e-4, "ζ = {fraction}: {found} {expected}");
        // 2 ζ √(m k) = α √(2/3 m k).
        let model = damped(Hertz { effective_modulus: 1e8 }, dashpot);
        let expected = tsuji_restitution(6.0_f64.sqrt() * fraction);
        let pair = HertzPair::new(1e8, 5e-4, mass).unwrap();
        let dt = pair.contact_duration(0.5) / 4000.3;
        let found = collide(&model, (mass, 5e-4), 0.5, dt, 0.0).restitution;
        // As for `tsuji`, between first and second order.
        assert!((found.powi(2) - expected * expected).abs() < 1e-4, "ζ = {fraction}: {found} {expected}");
    }
}
