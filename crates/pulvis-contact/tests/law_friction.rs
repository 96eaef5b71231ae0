//! Friction laws give no work back that was not done on them, whatever their dashpots do and however the area of the
//! contact changes.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use proptest::prelude::*;
use pulvis_contact::conventions::SlipDashpot;
use pulvis_contact::friction::{Along, FrictionLaw, SpringMotion, Tangent, mindlin::Rescale};
use pulvis_contact::{ContactLaws, ContactModel, Conventions, Linear, Mindlin, SpringSlider};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::pair_motion;
use pulvis_testkit::contact::{Dance, deficits};
use pulvis_testkit::friction::Load;
use pulvis_testkit::{Draw, LiveContact, for_each_case};

/// A displacement [m] within `elapsed` [s] of a closed contact.
fn moved<T: Tangent<f64>>(
    displacement: T,
    elapsed: f64,
    reference: f64,
    radius: f64,
) -> SpringMotion<T, f64> {
    Load::new(reference, radius).moved(displacement, elapsed)
}

fn magnitude(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|exponent| 10_f64.powf(exponent))
}

proptest! {
    #[test]
    fn slip_goes_against_the_force_for_every_dashpot_speed_and_time_step(
        (stiffness, dashpot, elapsed) in (magnitude(0.0, 6.0), magnitude(-6.0, 6.0), magnitude(-9.0, 0.0)),
        steps in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, 0.0..2.0_f64, magnitude(-6.0, 3.0)), 1..40),
    ) {
        let law = SpringSlider { stiffness, dashpot, dynamic_coefficient: 0.4, static_coefficient: 0.4 };
        let mut spring = Vector3::zero();
        for (x, y, reference, speed) in steps {
            let displacement = Vector3::new(x, y, 0.0) * (speed * elapsed);
            let before = spring;
            let motion = moved(displacement, elapsed, reference, 0.0);
            let (answer, slips) = law.respond(&motion, &mut spring, &mut ());
            let (force, path) = (answer.force, displacement - (spring - before));
            // Round-off of the path, which is a difference of these.
            let error = 1e-14 * (displacement.norm() + spring.norm() + before.norm());
            prop_assert!(answer.viscous_power >= 0.0, "{answer:?}");
            prop_assert!(force.norm() <= 0.4 * reference * (1.0 + 1e-14), "{answer:?}");
            if slips {
                prop_assert!(path.dot(force) <= error * force.norm(), "{path:?} {answer:?}");
                prop_assert!(path.cross(force).norm() <= error * force.norm(), "{path:?} {answer:?}");
            } else {
                prop_assert!(path.norm() <= error, "{path:?} {answer:?}");
            }
        }
    }
}

#[test]
fn steady_sliding_brings_the_spring_to_the_limit_within_the_relaxation_time() {
    let (stiffness, dashpot, limit, elapsed) = (100.0, 3.0, 1.0, 1e-4);
    let law = SpringSlider { stiffness, dashpot, dynamic_coefficient: 1.0, static_coefficient: 1.0 };
    // From the opposite limit, pulled so fast that it slides at once.
    let mut spring = Along(-limit / stiffness);
    for step in 1..4000 {
        let answer = law.respond(&moved(Along(1e3 * elapsed), elapsed, limit, 0.0), &mut spring, &mut ()).0;
        assert!((answer.force.0 + limit).abs() < 1e-15, "{answer:?}");
        // k dξ/dt + ... = limit − k ξ over γ: what is missing falls by 1/(1 + k dt/γ) in each step.
        let missing = 2.0 * limit * (1.0 + stiffness * elapsed / dashpot).powi(-step);
        assert!((limit - stiffness * spring.0 - missing).abs() < 1e-12, "step {step}: {spring:?}");
    }
}

/// A frictional contact of an elastic spring with dashpots against all three motions, and a motion of its bodies.
fn with_dashpots(draw: &mut Draw, slip_dashpot: SlipDashpot) -> (ContactModel, Dance) {
    let stiffness = 1e3;
    let mut model = ContactModel::frictionless(Linear::new(stiffness, 0.0));
    let dance = Dance::in_contact(&model, draw);
    let mut slider = |share: f64| {
        let coefficient = draw.log_between(0.05, 1.0);
        let stiffness = share * stiffness * draw.log_between(0.3, 3.0);
        // From dashpots that are hardly felt to such that carry all of the Coulomb limit at a hundredth of the speed.
        let dashpot = stiffness * dance.duration * draw.log_between(1e-3, 1.0);
        let (dynamic_coefficient, static_coefficient) = (coefficient, coefficient * draw.between(1.0, 1.3));
        Some(SpringSlider { stiffness, dashpot, dynamic_coefficient, static_coefficient }.into())
    };
    let (sliding, rolling, torsion) = (slider(0.3), slider(0.1), slider(0.1));
    let conventions = Conventions { slip_dashpot, ..Conventions::default() };
    model.laws = ContactLaws { sliding, rolling, torsion, conventions, ..ContactLaws::default() };
    (model, dance)
}

/// The least that any slip account ever comes to, over all that dashpots and slip have taken in the end.
fn least_slip(model: &ContactModel, dance: &Dance, count: usize) -> f64 {
    let mut contact = LiveContact::new(model, dance.pair);
    let dt = dance.duration / count as f64;
    let (mut accounts, mut least, mut viscous) = ([0.0; 3], 0.0_f64, 0.0);
    for step in 0..=count {
        let [i, j] = dance.step(step, count);
        let motion = pair_motion(dance.radius_i, &i, Some((dance.radius_j, &j)));
        let e = contact.respond(&motion, if step == 0 { 0.0 } else { dt }).energies;
        assert!(e.viscous_power >= 0.0, "{e:?}");
        viscous += e.viscous_power * dt;
        let lost = [e.dissipated_sliding, e.dissipated_rolling, e.dissipated_torsion];
        for (account, lost) in accounts.iter_mut().zip(lost) {
            *account += lost;
            least = least.min(*account);
        }
    }
    least / (viscous + accounts.iter().sum::<f64>())
}

#[test]
fn dashpots_against_sliding_rolling_and_torsion_never_give_work_back() {
    let mut worst_printed = 0.0_f64;
    for_each_case("dashpots of friction", 40, |draw| {
        let mut again = draw.clone();
        let (model, dance) = with_dashpots(draw, SlipDashpot::Series);
        let [coarse, fine] = deficits(&model, &dance, [1000, 8000]);
        // At every instant the work done covers what is stored, up to the second order of the step.
        assert!(fine <= coarse / 16.0 + 1e-7, "{coarse} falls to {fine}: {model:?}");
        assert!(coarse < 1e-2, "{coarse}: {model:?}");
        // Nor do the accounts of slip; half a step of what a dashpot loses by slip is ahead of its time.
        let [coarse, fine] = [1000, 8000].map(|steps| least_slip(&model, &dance, steps));
        assert!(coarse > -1e-2 && fine > -1e-3, "{coarse} {fine}: {model:?}");
        let (model, dance) = with_dashpots(&mut again, SlipDashpot::Printed);
        let [fine] = deficits(&model, &dance, [8000]);
        worst_printed = worst_printed.max(fine);
    });
    // The rule as printed fails this test: half of all energy that is turned over comes from nothing.
    assert!(worst_printed > 0.1, "{worst_printed}");
}

const SHEAR_MODULUS: f64 = 1e7;

fn mindlin(rescale: Rescale) -> Mindlin {
    Mindlin { effective_shear_modulus: SHEAR_MODULUS, dashpot: 0.0, coefficient: f64::INFINITY, rescale }
}

/// Stiffness of an area of the radius [m].
fn stiffness(radius: f64) -> f64 {
    8.0 * SHEAR_MODULUS * radius
}

/// A tangential force that follows the radius of the area [m] and the displacement [m]; answers with the force [N] and
/// with what it stores [J].
trait Rule {
    fn go(&mut self, radius: f64, displacement: f64) -> (f64, f64);
}

struct OfLaw {
    law: Mindlin,
    force: Along<f64>,
    energy: [f64; 1],
}

impl OfLaw {
    fn new(rescale: Rescale) -> Self {
        Self { law: mindlin(rescale), force: Along(0.0), energy: [0.0] }
    }
}

impl Rule for OfLaw {
    fn go(&mut self, radius: f64, displacement: f64) -> (f64, f64) {
        let motion = moved(Along(displacement), 1.0, 1.0, radius);
        let answer = self.law.respond(&motion, &mut self.force, &mut self.energy).0;
        assert!((answer.force.0 + self.force.0).abs() <= 1e-15 * self.force.0.abs(), "{answer:?}");
        (self.force.0, answer.stored_energy)
    }
}

/// The displacement is remembered, the force is k ξ.
struct OfDisplacement(f64);

impl Rule for OfDisplacement {
    fn go(&mut self, radius: f64, displacement: f64) -> (f64, f64) {
        self.0 += displacement;
        (stiffness(radius) * self.0, 0.0)
    }
}

/// The force is remembered, whatever the area does.
struct OfForce(f64);

impl Rule for OfForce {
    fn go(&mut self, radius: f64, displacement: f64) -> (f64, f64) {
        self.0 += stiffness(radius) * displacement;
        (self.0, 0.0)
    }
}

/// A path of legs, each a radius [m] and a displacement [m], is gone by a rule: the work done, the least that it
/// exceeded what was stored by, and the sum of all work regardless of its sign [J].
///
/// The force is linear in the displacement where the area does not change: the trapezoidal rule is exact on legs that do
/// one of both.
fn along(rule: &mut impl Rule, path: &[(f64, f64)]) -> (f64, f64, f64) {
    let (mut force, mut work, mut least, mut turned_over) = (0.0, 0.0_f64, 0.0_f64, 0.0);
    for &(radius, displacement) in path {
        let (now, stored) = rule.go(radius, displacement);
        let done = 0.5 * (force + now) * displacement;
        work += done;
        turned_over += done.abs();
        least = least.min(work - stored);
        force = now;
    }
    (work, least, turned_over)
}

/// Legs of random radii and displacements, the latter back to where they began; between each two the area changes.
fn random_cycle(draw: &mut Draw) -> Vec<(f64, f64)> {
    let mut path = Vec::new();
    let (mut radius, mut gone) = (1e-4, 0.0);
    for _ in 0..6 + (draw.unit() * 14.0) as usize {
        radius = 1e-4 * draw.log_between(0.1, 4.0);
        path.push((radius, 0.0));
        let displacement = 1e-6 * draw.between(-1.0, 1.0);
        path.push((radius, displacement));
        gone += displacement;
    }
    path.push((radius, -gone));
    path
}

#[test]
fn without_a_coulomb_limit_no_random_cycle_of_area_and_shear_gives_work_back() {
    // With a limit the test would be blind: also rules that create energy pass it, as slip covers for them.
    let mut gains = [0, 0];
    for_each_case("area and shear", 10_000, |draw| {
        let path = random_cycle(draw);
        for rescale in [Rescale::Energy, Rescale::Unloading] {
            let (work, least, turned_over) = along(&mut OfLaw::new(rescale), &path);
            // On the way too, up to round-off.
            assert!(least >= -1e-13 * turned_over, "{rescale:?}: {least} J of {turned_over} J");
            assert!(work >= -1e-13 * turned_over, "{rescale:?}: {work} J of {turned_over} J");
        }
        gains[0] += usize::from(along(&mut OfDisplacement(0.0), &path).0 < 0.0);
        gains[1] += usize::from(along(&mut OfForce(0.0), &path).0 < 0.0);
    });
    // The usual memories of displacement and of force create energy in a good part of the same cycles.
    assert!(gains[0] > 1_000 && gains[1] > 1_000, "{gains:?}");
}

#[test]
fn area_and_shear_that_change_at_once_give_no_work_back_but_for_the_error_of_the_step() {
    for_each_case("area with shear", 100, |draw| {
        let waves: [f64; 6] = std::array::from_fn(|_| draw.between(-1.0, 1.0));
        let path = |steps: u32| -> Vec<(f64, f64)> {
            let shear = |time: f64| {
                let turn = std::f64::consts::TAU * time;
                1e-6 * (waves[0] * turn.sin() + waves[1] * (2.0 * turn).sin() + waves[2] * (turn.cos() - 1.0))
            };
            let times =
                (1..=steps).map(|step| [step - 1, step].map(|step| f64::from(step) / f64::from(steps)));
            let leg = |[before, now]: [f64; 2]| {
                let wave = waves[3] * (3.0 * std::f64::consts::TAU * now + waves[4]).sin();
                (1e-4 * (1.0 + 0.9 * wave), shear(now) - shear(before))
            };
            times.map(leg).collect()
        };
        for rescale in [Rescale::Energy, Rescale::Unloading] {
            let [coarse, fine] = [500, 4000].map(|steps| {
                let (_, least, turned_over) = along(&mut OfLaw::new(rescale), &path(steps));
                -least / turned_over
            });
            assert!(coarse < 1e-4 && fine <= coarse / 16.0 + 1e-9, "{rescale:?}: {coarse} falls to {fine}");
        }
    });
}

#[test]
fn directed_cycles_of_pressing_and_shearing_cost_work() {
    let (small, large, shear) = (1e-4, 4e-4, 1e-6);
    let scale = stiffness(small) * shear * shear;
    let press_between = [(small, shear), (large, 0.0), (large, -shear), (small, 0.0)];
    let release_between = [(large, shear), (small, 0.0), (small, -shear)];
    for path in [&press_between[..], &release_between] {
        for rescale in [Rescale::Energy, Rescale::Unloading] {
            let (work, least, _) = along(&mut OfLaw::new(rescale), path);
            assert!(work >= 0.0 && least >= -1e-13 * scale, "{rescale:?}: {work} {least}");
        }
    }
    // What other rules give back: 1.5 k s² where the displacement is kept; and where the force is kept, 6 k s² if the
    // spring is let go to its end.
    let (work, ..) = along(&mut OfDisplacement(0.0), &press_between);
    assert!((work / scale + 1.5).abs() < 1e-12, "{}", work / scale);
    let (work, ..) = along(&mut OfForce(0.0), &[(large, shear), (small, 0.0), (small, -4.0 * shear)]);
    assert!((work / scale + 6.0).abs() < 1e-12, "{}", work / scale);
}

#[test]
fn vibrations_of_the_area_wear_down_a_rescaled_force_and_leave_one_with_an_energy() {
    let after = |rescale: Rescale| {
        let mut rule = OfLaw::new(rescale);
        let start = rule.go(1e-4, 1e-6).0;
        for _ in 0..1000 {
            rule.go(1.01e-4, 0.0);
            rule.go(0.99e-4, 0.0);
        }
        rule.go(1e-4, 0.0).0 / start
    };
    // Only the first fall below the area of loading costs some of the force.
    assert!((after(Rescale::Energy) - 0.99).abs() < 1e-12, "{}", after(Rescale::Energy));
    // (0.99/1.01)^1000 = 2.06e-9: a shaken pile creeps.
    let crept = (0.99_f64 / 1.01).powi(1000);
    assert!(
        (after(Rescale::Unloading) / crept - 0.99 * 1.01 / 0.99).abs() < 0.02,
        "{}",
        after(Rescale::Unloading)
    );
}

#[test]
fn a_fall_of_the_area_and_a_shear_at_a_constant_one_may_be_gone_in_any_number_of_steps() {
    for rescale in [Rescale::Energy, Rescale::Unloading] {
        let ends = [1, 3, 500].map(|steps: u32| {
            let mut rule = OfLaw::new(rescale);
            let share = 1.0 / f64::from(steps);
            for _ in 0..steps {
                rule.go(1e-4, 1e-6 * share);
            }
            for step in 1..=steps {
                rule.go(1e-4 - 0.7e-4 * share * f64::from(step), 0.0);
            }
            rule.go(0.3e-4, 0.0)
        });
        for (force, stored) in ends {
            assert!((force / ends[0].0 - 1.0).abs() < 1e-12, "{rescale:?}: {ends:?}");
            assert!((stored / ends[0].1 - 1.0).abs() < 1e-12, "{rescale:?}: {ends:?}");
        }
    }
}
