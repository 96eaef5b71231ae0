//! Hertz with Tsuji's dashpot, the adhesive law of Johnson, Kendall and Roberts, and the piece-wise linear law after
//! Walton and Johnson, on single pairs, against closed forms and against numbers of 50 digits.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use std::f64::consts::PI;

use pulvis_contact::theory::hertz::tsuji_restitution;
use pulvis_contact::theory::{HertzPair, JkrPair, WaltonJohnsonPair};
use pulvis_contact::viscosity::Tsuji;
use pulvis_contact::{
    ContactLaws, ContactModel, ExpectedLoading, Hertz, Jkr, Normal, NormalLaw, NormalMotion, NormalResponse,
    Pair, Viscosity, WaltonJohnson,
};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::collisions::collide;

fn bare(normal: impl Into<Normal>) -> ContactModel {
    ContactModel::frictionless(normal)
}

#[test]
fn a_hertz_collision_takes_the_time_and_the_force_of_the_closed_form() {
    for (modulus, radius, mass, speeds) in
        [(1e8, 5e-4, 5e-6, [0.5, 0.01]), (2e11, 5e-3, 0.0163362818, [1.0, 20.0])]
    {
        let theory = HertzPair::new(modulus, radius, mass).unwrap();
        for speed in speeds {
            let duration = theory.contact_duration(speed);
            let model = bare(Hertz { effective_modulus: modulus });
            let found = collide(&model, (mass, radius), speed, duration / 40_000.3, 0.0);
            // Velocity-Verlet errs by (ω dt)²/24, with ω t_c = 4.03 at the most: 4e-10.
            assert!((found.duration / duration - 1.0).abs() < 1e-8, "{} {duration}", found.duration);
            let force = theory.force_max(speed);
            assert!((found.force_max / force - 1.0).abs() < 1e-8, "{} {force}", found.force_max);
            assert!((found.restitution - 1.0).abs() < 1e-8, "{}", found.restitution);
            assert!(found.missing < 1e-8, "{}", found.missing);
        }
    }
}

#[test]
fn tsujis_dashpot_gives_the_same_restitution_at_any_speed() {
    let (modulus, radius, mass) = (1e8, 5e-4, 5e-6);
    let theory = HertzPair::new(modulus, radius, mass).unwrap();
    for restitution in [0.3, 0.5, 0.9, 1.0] {
        let dashpot = Tsuji::from_restitution(restitution);
        assert!((tsuji_restitution(dashpot.alpha) / restitution - 1.0).abs() < 1e-14);
        let laws = ContactLaws { viscosity: Viscosity::Tsuji(dashpot), ..ContactLaws::default() };
        let model = ContactModel { normal: Hertz { effective_modulus: modulus }.into(), laws };
        let squares = [1e-3, 0.1, 10.0].map(|speed| {
            let dt = theory.contact_duration(speed) / 4_000.3;
            // It begins before touch: at touch, round-off would say whether the bodies have met in the first step.
            collide(&model, (mass, radius), speed, dt, -1e-12 * radius).restitution.powi(2)
        });
        // The dashpot ~ δ^(1/4) is steep at touch: between first and second order, 5e-4 at 200 steps a contact.
        for square in squares {
            assert!((square - restitution * restitution).abs() < 1e-4, "{square}, e = {restitution}");
        }
        // All speeds are one collision in other units.
        assert!((squares[0] - squares[2]).abs() < 1e-8, "{squares:?}");
    }
}

/// E* [Pa], Γ [J/m²] and R [m] of two pairs.
const ADHESIVE: [(f64, f64, f64); 2] = [(1e9, 0.1, 1e-6), (4e10, 0.05, 5e-4)];

fn rest(law: &Jkr, pair: &Pair, overlap: f64, memory: &mut [f64; 1]) -> NormalResponse {
    law.respond(&NormalMotion::at_rest(pair, overlap), memory)
}

#[test]
fn the_adhesive_curve_has_the_pull_off_and_the_separation_of_the_closed_form() {
    for (modulus, adhesion, radius) in ADHESIVE {
        let theory = JkrPair::new(modulus, adhesion, radius).unwrap();
        let (law, pair) = (Jkr::new(modulus, adhesion), Pair::wall(1.0, radius));
        let mut attached = [0.0];
        rest(&law, &pair, 0.0, &mut attached);
        let at = |overlap: f64| rest(&law, &pair, overlap, &mut attached.clone());
        let close = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() < 1e-10, "{found}, expected {expected}");
        };
        // Under a constant load bodies part at the least force: a search by thirds.
        let (mut low, mut high) = (theory.separation_overlap(), 0.0);
        for _ in 0..100 {
            let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if at(left).force < at(right).force { high = right } else { low = left }
        }
        close(at(low).force, -theory.pull_off_force());
        // Of bodies whose distance is given the neck breaks at δ_sep.
        let (mut parted, mut held) = (2.0 * theory.separation_overlap(), 0.0);
        for _ in 0..60 {
            let middle = 0.5 * (parted + held);
            if at(middle).in_contact { held = middle } else { parted = middle }
        }
        close(held, theory.separation_overlap());
        close(law.interaction_range(&pair), -theory.separation_overlap());
        // The force changes with the root of the distance from there: by 1e-8 within a rounding of the overlap.
        let last = at(held).force;
        assert!((last / theory.separation_force() - 1.0).abs() < 1e-6, "{last}");
        close(at(0.0).force, -8.0 / 9.0 * theory.pull_off_force());
        // Both curves, δ(a) and F(a), at the radius that the law answers with.
        for share in [-0.97, -0.5, 0.0, 0.3, 4.0, 1e3, 1e6] {
            let overlap = -share * theory.separation_overlap();
            let answer = at(overlap);
            let scale = overlap.abs().max(-theory.separation_overlap());
            assert!((theory.overlap(answer.contact_radius) - overlap).abs() < 1e-12 * scale, "{share}");
            let scale = answer.force.abs().max(theory.pull_off_force());
            assert!((theory.force(answer.contact_radius) - answer.force).abs() < 1e-12 * scale, "{share}");
        }
    }
}

/// Overlap over |δ_sep|, y = √(a/a_sep) and force over F_c: the stable root of y⁴ − 4 y = 3 δ/|δ_sep| and y³ (y³ − 6)/9,
/// computed with 60 digits (mpmath).
#[allow(clippy::excessive_precision)]
const CURVE: [(f64, f64, f64); 20] = [
    (-0.999999, 1.0007069401832441437, -0.5564983085046889464),
    (-0.999, 1.0221961551467418598, -0.58529723347559779718),
    (-0.99, 1.0691096676002963111, -0.64874129087908366833),
    (-0.9, 1.2088332872982540862, -0.83092590548525291833),
    (-0.7, 1.3462926872354628754, -0.96517557334999224266),
    (-0.5, 1.4349478725415326857, -0.99977164619651777396),
    (-0.3, 1.5039254331574808291, -0.9820827430530643899),
    (-0.1, 1.5615694241117555137, -0.92748009836435730204),
    (0.0, 1.5874010519681994748, -0.88888888888888888889),
    (1e-6, 1.5874013019681207297, -0.88888846891487488214),
    (0.01, 1.5898932185383869311, -0.88465617445622964001),
    (0.1, 1.6116524767086758363, -0.84367350943794792525),
    (0.3, 1.6562535930527290075, -0.73532574745646683252),
    (1.0, 1.7843579810326167676, -0.20119486103083534853),
    (3.0, 2.0346719180264453676, 2.2680414699430718156),
    (10.0, 2.5158636401631207516, 17.559825151134246125),
    (100.0, 4.2191261393062216705, 576.67756342710453452),
    (1e4, 13.166512365824437525, 577349.60232811341377),
    (1e6, 41.61849184914267607, 577350268.52295293235),
    (1e8, 131.60745903026350112, 577350269188.95909765),
];

#[test]
fn the_adhesive_curve_is_inverted_to_round_off() {
    for (modulus, adhesion, radius) in ADHESIVE {
        let (law, pair) = (Jkr::new(modulus, adhesion), Pair::wall(1.0, radius));
        let theory = JkrPair::new(modulus, adhesion, radius).unwrap();
        for (overlap, y, force) in CURVE {
            let mut memory = [0.0];
            rest(&law, &pair, 0.0, &mut memory);
            let answer = rest(&law, &pair, overlap * law.interaction_range(&pair), &mut memory);
            // Ten roundings; and near the separation e = 3 + δ/s has lost digits, 1e-16/(1 + δ/|δ_sep|).
            let lost = 1e-15 / (1.0 + overlap).min(1.0);
            let found = answer.force / theory.pull_off_force();
            assert!(
                (found - force).abs() < (1e-14 + lost) * force.abs().max(1.0),
                "{overlap}: {found} {force}"
            );
            let found = (answer.contact_radius / theory.separation_radius()).sqrt();
            assert!((found / y - 1.0).abs() < 1e-14 + lost, "{overlap}: {found} {y}");
        }
    }
}

#[test]
fn adhesive_spheres_rebound_as_their_energy_loss_says_and_stick_below() {
    let (modulus, adhesion, radius) = ADHESIVE[0];
    let mass = 2000.0 * 4.0 / 3.0 * PI * radius * radius * radius;
    let theory = JkrPair::new(modulus, adhesion, radius).unwrap();
    let (law, pair) = (Jkr::new(modulus, adhesion), Pair::wall(mass, radius));
    let sticking = theory.sticking_velocity(mass);
    let step = |speed: f64, steps: f64| {
        let expected = ExpectedLoading { speed, ..ExpectedLoading::default() };
        2.0 * PI * (mass / law.max_stiffness(&pair, &expected)).sqrt() / steps
    };
    let end = 1.001 * theory.separation_overlap();
    for ratio in [1.05, 1.5, 4.0, 40.0] {
        let speed = ratio * sticking;
        let expected = theory.restitution(speed, mass).powi(2);
        for (steps, tolerance) in [(80.0, 4e-3), (640.0, 1.5e-4)] {
            let found = collide(&bare(law), (mass, radius), speed, step(speed, steps), end);
            // Events weighted by the part of the step in which the force acts: second order although it jumps. Worst
            // of many phases and speeds 2.8e-3 and 1.0e-4.
            let error = (found.restitution.powi(2) - expected).abs();
            assert!(error < tolerance, "{ratio} v_s, {steps} steps: e² errs by {error}");
            assert!(found.missing < tolerance, "{ratio} v_s, {steps} steps: {} is missing", found.missing);
        }
    }
    // Slower, the bodies stay together for good.
    let speed = 0.98 * sticking;
    let mut sphere = Sphere::at_rest(mass, radius, Vector3::new(0.0, 0.0, radius));
    sphere.velocity.z = -speed;
    let mut couple = Couple::new(&bare(law), sphere, None);
    for _ in 0..20_000 {
        couple.step(step(speed, 200.0));
        assert!(couple.overlap > theory.separation_overlap(), "parted");
    }
}

#[test]
fn the_law_after_walton_and_johnson_rebounds_as_its_closed_form() {
    let (mass, radius) = (5.575e-6, 1e-3);
    // The last one parts beyond touching.
    for (k2, f_0, kappa, k_tail) in
        [(400.0, 1e-4, 0.05, 50.0), (400.0, 0.0, 0.2, 400.0), (110.0, 1e-3, 0.0, 300.0)]
    {
        let law = WaltonJohnson { k1: 100.0, k2, f_0, kappa, k_tail };
        let theory = WaltonJohnsonPair::new([100.0, k2, k_tail], f_0, kappa, mass).unwrap();
        for speed in [0.1, 0.2] {
            let expected = theory.restitution(speed);
            let end = theory.end_overlap(theory.overlap_max(speed)).min(0.0);
            let errors = [200.3, 1600.3].map(|steps| {
                let dt = PI * (mass / 400.0_f64).sqrt() / steps;
                let found = collide(&bare(law), (mass, radius), speed, dt, end);
                // Losses are booked exactly: what is missing is the error of the integration.
                assert!(found.missing < 4.0 / (steps * steps), "{law:?}: {} is missing", found.missing);
                (found.restitution - expected).abs()
            });
            // Second order, as the force only has kinks: 1e-4 at 200 steps.
            assert!(errors[0] < 4e-4 && errors[1] < 1e-5, "{law:?}, {speed} m/s: {errors:?}, e = {expected}");
        }
    }
}

#[test]
fn a_stretched_contact_after_walton_and_johnson_holds_beyond_touching_until_its_tail_ends() {
    let law = WaltonJohnson { k1: 100.0, k2: 400.0, f_0: 2e-3, kappa: 0.0, k_tail: 300.0 };
    let pair = Pair::wall(1e-6, 1e-3);
    let range = law.interaction_range(&pair);
    // f_0 (1/k2 + 1/k_tail).
    assert!((range / (2e-3 * (1.0 / 400.0 + 1.0 / 300.0)) - 1.0).abs() < 1e-15, "{range}");
    let mut memory = Default::default();
    let mut force = |overlap: f64| law.respond(&NormalMotion::at_rest(&pair, overlap), &mut memory).force;
    assert_eq!(force(-0.5 * range), 0.0, "before a touch nothing acts");
    assert!((force(1e-6) - 1e-4).abs() < 1e-18);
    // o = 0.75 µm; the pull-off of 2 mN is reached 5 µm below, the tail ends 6.67 µm further down.
    assert!((force(0.75e-6 - 5e-6) + 2e-3).abs() < 1e-17);
    assert!((force(0.75e-6 - 5e-6 - 4e-6) + 0.8e-3).abs() < 1e-16);
    // Re-loading along k2 with the pull-off force that is left: 1 µm gives 0.4 mN, and back to the tail.
    assert!((force(0.75e-6 - 8e-6) + 0.4e-3).abs() < 1e-16);
    assert!((force(0.75e-6 - 10e-6) + 0.5e-3).abs() < 1e-16);
    assert!(force(0.75e-6 - 11.6e-6) < 0.0);
    assert_eq!(force(0.75e-6 - 11.7e-6), 0.0);
    assert_eq!(force(-1e-6), 0.0, "the bodies have parted");
}

#[test]
fn a_pull_off_force_that_grows_faster_than_the_plastic_overlap_is_refused() {
    let values = pulvis_contact::catalogue::Values::new()
        .with("k1", 100.0)
        .with("k2", 400.0)
        .with("k_tail", 50.0)
        .with("f_0", 1e-4);
    // (1 − k1/k2)/(k1/k2 + k1/k_tail) = 0.75/2.25.
    assert!(Normal::build("walton-johnson", &values.clone().with("kappa", 0.333)).unwrap().is_ok());
    let error = Normal::build("walton-johnson", &values.with("kappa", 0.334)).unwrap().unwrap_err();
    assert_eq!(error.name(), "kappa");
    assert!(error.to_string().contains("0.333"), "{error}");
}
