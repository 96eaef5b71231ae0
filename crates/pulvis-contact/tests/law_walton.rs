//! The tangential law of Walton, and the energy that its published rule creates.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::friction::{Along, Walton, walton::Variant};
use pulvis_math::Vector3;
use pulvis_testkit::friction::{Load, Walk};

const STIFFNESS: f64 = 80.0;
const COEFFICIENT: f64 = 0.5;
const REFERENCE: f64 = 3.0;
/// μ N [N], and the path on which a spring of K₀ comes up to it [m].
const LIMIT: f64 = COEFFICIENT * REFERENCE;
const SCALE: f64 = LIMIT / STIFFNESS;

fn law(exponent: f64, variant: Variant) -> Walton {
    Walton { stiffness: STIFFNESS, exponent, coefficient: COEFFICIENT, variant }
}

fn load() -> Load {
    Load::new(REFERENCE, 1e-4)
}

fn walk(exponent: f64, variant: Variant) -> Walk<Walton, Along<f64>> {
    Walk::new(law(exponent, variant))
}

/// A displacement [m] in so many steps.
fn shear(walk: &mut Walk<Walton, Along<f64>>, displacement: f64, steps: u32) {
    for _ in 0..steps {
        walk.go(&load(), Along(displacement / f64::from(steps)));
    }
}

/// T/(μ N) after the monotone shear x = K₀ s/(μ N).
fn monotone(x: f64, exponent: f64) -> f64 {
    if exponent == 1.0 {
        return 1.0 - (-x).exp();
    }
    1.0 - (1.0 - (1.0 - exponent) * x).max(0.0).powf(1.0 / (1.0 - exponent))
}

#[test]
fn monotone_shear_gives_the_closed_form_in_steps_of_any_size() {
    // Printed values for g = 1/3.
    assert!((monotone(0.5, 1.0 / 3.0) - 0.4556689).abs() < 1e-7);
    assert_eq!(monotone(1.5, 1.0 / 3.0), 1.0);
    for exponent in [1.0 / 3.0, 0.1, 0.333, 0.5, 0.9, 1.0] {
        for variant in [Variant::Passive, Variant::Published] {
            for x in [1e-9, 0.5, 1.2, 1.5, 4.0] {
                for steps in [1, 7, 1000] {
                    let mut walk = walk(exponent, variant);
                    shear(&mut walk, x * SCALE, steps);
                    let share = -walk.force.0 / LIMIT;
                    let error = share / monotone(x, exponent) - 1.0;
                    // Near the limit the closed form itself loses digits by powers of a small difference.
                    assert!(
                        error.abs() < 1e-12 || x < 1e-8 && error.abs() < 1e-7,
                        "{exponent} {x} {steps}: {error}"
                    );
                }
            }
        }
    }
}

#[test]
fn without_a_coulomb_limit_the_spring_is_linear() {
    for exponent in [1.0 / 3.0, 0.5, 1.0] {
        for coefficient in [1e30, f64::INFINITY] {
            let law = Walton { coefficient, ..law(exponent, Variant::Passive) };
            let mut walk = Walk::<_, Vector3>::new(law);
            for piece in [Vector3::new(3e-3, 0.0, 0.0), Vector3::new(-1e-3, 4e-3, 0.0)] {
                walk.go(&load(), piece);
            }
            let expected = Vector3::new(2e-3, 4e-3, 0.0) * -STIFFNESS;
            assert!((walk.force - expected).norm() < 1e-14 * expected.norm(), "{:?}", walk.force);
        }
    }
}

#[test]
fn an_unloaded_contact_is_stiff_again() {
    // Passive: K₀ on the way back. Published: T* − T = (μ N + T*) (1 − (1 − (2/3) K₀ s/(μ N + T*))^(3/2)).
    for (variant, steps) in [(Variant::Passive, 1), (Variant::Published, 1), (Variant::Published, 100)] {
        let mut walk = walk(1.0 / 3.0, variant);
        shear(&mut walk, 0.9 * SCALE, 10);
        let turn = -walk.force.0;
        shear(&mut walk, -0.4 * SCALE, steps);
        let fallen = match variant {
            Variant::Passive => 0.4 * LIMIT,
            Variant::Published => (LIMIT + turn) * monotone(0.4 * LIMIT / (LIMIT + turn), 1.0 / 3.0),
        };
        assert!((turn + walk.force.0 - fallen).abs() < 1e-12 * LIMIT, "{variant:?}: {}", walk.force.0);
    }
}

#[test]
fn the_published_rule_creates_energy_by_small_turns_of_the_motion_and_the_passive_one_does_not() {
    let cycle = |variant: Variant| {
        let mut walk = walk(1.0 / 3.0, variant);
        // To the limit with a tiny turn in each of many steps, and back in one go.
        for _ in 0..3000 {
            walk.go(&load(), Along(1.001e-3 * SCALE));
            walk.go(&load(), Along(-1e-6 * SCALE));
        }
        let paid = walk.work;
        while -walk.force.0 > 0.0 {
            walk.go(&load(), Along(-1e-4 * SCALE));
        }
        (paid / (LIMIT * SCALE), (paid - walk.work) / (LIMIT * SCALE))
    };
    // 1/2 is the work on a spring of K₀; the other is 2 ∫ (1 − 2 y) (1 − y)^(−1/3) dy from 0 to 1/2. The limit is reached
    // within the first thousand of the turns; what follows slips.
    let back = 2.0 * (1.5 * 0.5_f64.powf(2.0 / 3.0) - 1.2 * 0.5_f64.powf(5.0 / 3.0) - 0.3);
    assert!((back - 0.533_929).abs() < 1e-6);
    let (_, returned) = cycle(Variant::Published);
    assert!((returned - back).abs() < 1e-3, "{returned}, expected {back}");
    let (_, returned) = cycle(Variant::Passive);
    assert!((returned - 0.5).abs() < 1e-3, "{returned}: U = (μ N)²/(2 K₀)");
    // Stopped when the limit is reached, the published cycle has cost less than it gives back.
    let mut walk = walk(1.0 / 3.0, Variant::Published);
    while -walk.force.0 < 0.999 * LIMIT {
        walk.go(&load(), Along(1.001e-3 * SCALE));
        walk.go(&load(), Along(-1e-6 * SCALE));
    }
    let paid = walk.work;
    while -walk.force.0 > 0.0 {
        walk.go(&load(), Along(-1e-4 * SCALE));
    }
    let gain = -walk.work / (LIMIT * SCALE);
    assert!((gain - 0.034).abs() < 2e-3, "{gain} of {paid} J");
}

#[test]
fn a_falling_normal_force_takes_the_tangential_one_along_and_books_it() {
    let mut walk = walk(1.0 / 3.0, Variant::Passive);
    shear(&mut walk, SCALE, 10);
    let before = walk.stored;
    let lighter = Load::new(0.2 * REFERENCE, 1e-4);
    let lost = walk.lost;
    walk.go(&lighter, Along(0.0));
    assert!((-walk.force.0 / (0.2 * LIMIT) - 1.0).abs() < 1e-15);
    assert!((walk.lost - lost - (before - walk.stored)).abs() < 1e-15 * before);
}
