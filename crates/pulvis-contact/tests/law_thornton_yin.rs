//! The peeling of adhesive contacts under shear, against its closed forms.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::friction::{Along, ThorntonYin};
use pulvis_contact::theory::JkrPair;
use pulvis_testkit::friction::{Load, Walk};

const MODULUS: f64 = 1e9;
const SHEAR_MODULUS: f64 = 2e8;
const RADIUS: f64 = 1e-6;
/// The pull-off force of the printed values [N].
const PULL_OFF: f64 = 4.7e-7;

fn pair() -> JkrPair {
    JkrPair::new(MODULUS, PULL_OFF / (1.5 * std::f64::consts::PI * RADIUS), RADIUS).unwrap()
}

fn law(coefficient: f64) -> ThorntonYin {
    ThorntonYin {
        effective_shear_modulus: SHEAR_MODULUS,
        effective_modulus: MODULUS,
        dashpot: 0.0,
        coefficient,
    }
}

/// The contact under a normal force [N].
fn under(normal_force: f64) -> Load {
    let radius = pair().sheared_radius(normal_force, 0.0, SHEAR_MODULUS);
    Load { pull_off: PULL_OFF, ..Load::new(normal_force + 2.0 * PULL_OFF, radius) }
}

/// ∫ f dT from 0 to `force`, by Simpson's rule in √(T_c − T), in which the radius is smooth.
fn integral(normal_force: f64, force: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
    let peeling = pair().peeling_force(normal_force, SHEAR_MODULUS);
    let (start, end) = (peeling.sqrt(), (peeling - force).max(0.0).sqrt());
    let count = 2000;
    let step = (start - end) / f64::from(count);
    let value = |index: u32| {
        let root = start - step * f64::from(index);
        let tangential = peeling - root * root;
        let radius = pair().sheared_radius(normal_force, tangential, SHEAR_MODULUS);
        f(tangential, 8.0 * SHEAR_MODULUS * radius) * 2.0 * root
    };
    let weight = |index: u32| if index == 0 || index == count { 1.0 } else { f64::from(2 + 2 * (index % 2)) };
    (0..=count).map(|index| weight(index) * value(index)).sum::<f64>() * step / 3.0
}

#[test]
fn peeling_forces_and_sheared_radii_are_the_printed_ones() {
    let close =
        |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    close(pair().peeling_force(1e-6, SHEAR_MODULUS), 1.4869028213033965e-6);
    close(pair().peeling_force(0.0, SHEAR_MODULUS), 8.407615595399209e-7);
    close(pair().sheared_radius(1e-6, 3e-7, SHEAR_MODULUS), 1.388367027204355e-7);
    close(pair().sheared_radius(0.0, 2e-7, SHEAR_MODULUS), 1.1159555263316832e-7);
}

#[test]
fn the_force_follows_the_radius_of_the_peeled_area() {
    for normal_force in [1e-6, 0.0, -4e-7, 1e-3] {
        let force = 0.95 * pair().peeling_force(normal_force, SHEAR_MODULUS);
        let way = integral(normal_force, force, |_, stiffness| 1.0 / stiffness);
        let stored = integral(normal_force, force, |tangential, stiffness| tangential / stiffness);
        let errors = [50, 200].map(|steps: u32| {
            let mut walk = Walk::<_, Along<f64>>::new(law(1e9));
            for _ in 0..steps {
                walk.go(&under(normal_force), Along(way / f64::from(steps)));
            }
            let books = (walk.stored / stored - 1.0).abs();
            // At a constant normal force nothing is lost, but for the error of the step.
            assert!(walk.lost / walk.work < 2.0 / f64::from(steps * steps), "{} of {}", walk.lost, walk.work);
            (-walk.force.0 / force - 1.0).abs().max(books)
        });
        assert!(errors[0] < 1e-3, "{normal_force} N: {errors:?}");
        // Second order: 16 for a fourth of the step.
        assert!(errors[1] < errors[0] / 8.0, "{normal_force} N: {errors:?}");
    }
}

#[test]
fn at_a_constant_normal_force_the_contact_is_elastic() {
    let normal_force = 1e-6;
    let force = 0.9 * pair().peeling_force(normal_force, SHEAR_MODULUS);
    let way = integral(normal_force, force, |_, stiffness| 1.0 / stiffness);
    let mut walk = Walk::<_, Along<f64>>::new(law(1e9));
    for part in [1.0, -2.0, 1.0] {
        for _ in 0..1000 {
            walk.go(&under(normal_force), Along(part * way / 1000.0));
        }
    }
    assert!(walk.work >= 0.0 && walk.work < 1e-5 * walk.turned_over, "{} of {}", walk.work, walk.turned_over);
}

#[test]
fn a_contact_sticks_until_it_has_peeled_and_then_slides_at_the_coulomb_limit() {
    let (normal_force, coefficient) = (1e-6, 0.2);
    let peeling = pair().peeling_force(normal_force, SHEAR_MODULUS);
    let sliding = coefficient * (normal_force + 2.0 * PULL_OFF);
    assert!(sliding < 0.5 * peeling);
    let mut walk = Walk::<_, Along<f64>>::new(law(coefficient));
    let step = 1e-3 * peeling / (8.0 * SHEAR_MODULUS * under(normal_force).radius);
    let mut highest = 0.0_f64;
    for _ in 0..3000 {
        walk.go(&under(normal_force), Along(step));
        highest = highest.max(-walk.force.0);
    }
    // The peak is missed by at most one of its thousand steps.
    assert!(highest <= peeling && highest > 0.998 * peeling, "{highest} of {peeling}");
    assert!((-walk.force.0 / sliding - 1.0).abs() < 1e-13, "{}", walk.force.0);
    // It does not stick up to the peeling force again before it has opened.
    for _ in 0..3000 {
        walk.go(&under(normal_force), Along(-step));
        assert!(walk.force.0 <= sliding * (1.0 + 1e-13), "{}", walk.force.0);
    }
    assert!((walk.force.0 / sliding - 1.0).abs() < 1e-13);
    assert!((walk.work - walk.stored - walk.lost).abs() < 1e-12 * walk.work && walk.lost > 0.0);
}

#[test]
fn a_strong_coulomb_limit_is_what_holds_beyond_peeling() {
    let (normal_force, coefficient) = (1e-6, 3.0);
    let sliding = coefficient * (normal_force + 2.0 * PULL_OFF);
    let mut walk = Walk::<_, Along<f64>>::new(law(coefficient));
    let (mut highest, step) = (0.0_f64, 1e-3 * sliding / (8.0 * SHEAR_MODULUS * 1e-7));
    for _ in 0..5000 {
        walk.go(&under(normal_force), Along(step));
        highest = highest.max(-walk.force.0);
    }
    assert!((highest / sliding - 1.0).abs() < 1e-13, "{highest} of {sliding}");
}

#[test]
fn without_adhesion_it_is_the_law_of_mindlin() {
    use pulvis_contact::friction::{Mindlin, Rescale};
    let mindlin = Mindlin {
        effective_shear_modulus: SHEAR_MODULUS,
        dashpot: 0.0,
        coefficient: 0.4,
        rescale: Rescale::Energy,
    };
    let mut plain = Walk::<_, Along<f64>>::new(mindlin);
    let mut peeling = Walk::<_, Along<f64>>::new(law(0.4));
    for step in 0..500 {
        let phase = 0.05 * f64::from(step);
        let load = Load::new(1e-6 * (1.0 + 0.5 * phase.sin()), 1e-7 * (1.0 + 0.5 * phase.sin()));
        let displacement = Along(1e-10 * (0.7 * phase).cos());
        plain.go(&load, displacement);
        peeling.go(&load, displacement);
        assert_eq!(plain.force.0, peeling.force.0);
        assert_eq!(plain.stored, peeling.stored);
    }
    assert!(plain.lost > 0.0);
}

#[test]
fn a_viscoelastic_neck_peels_as_an_elastic_one_and_contacts_without_a_neck_do_not_peel() {
    use pulvis_contact::catalogue::Values;
    use pulvis_contact::{ContactModel, Normal};
    use pulvis_testkit::bodies::{Couple, Sphere};
    let values = |numbers: &[(&str, f64)]| {
        numbers.iter().fold(Values::new(), |values, (name, number)| values.with(name, *number))
    };
    let (modulus, adhesion) = (("effective_modulus", MODULUS), ("work_of_adhesion", 0.1));
    let build = |name: &str, numbers: &[(&str, f64)]| Normal::build(name, &values(numbers)).unwrap().unwrap();
    let run = |normal: Normal, sliding: pulvis_contact::Friction| {
        let mut model = ContactModel::frictionless(normal);
        model.laws.sliding = Some(sliding);
        let mut sphere = Sphere::at_rest(8e-15, RADIUS, pulvis_math::Vector3::new(0.0, 0.0, RADIUS));
        sphere.velocity = pulvis_math::Vector3::new(0.3, 0.0, -0.2);
        let mut couple = Couple::new(&model, sphere, None);
        (0..2000).for_each(|_| couple.step(1e-10));
        (couple.i.velocity, couple.i.angular_velocity, couple.lost)
    };
    let jkr = run(build("jkr", &[modulus, adhesion]), law(0.3).into());
    let viscoelastic = build("viscoelastic-jkr", &[modulus, adhesion, ("dissipative_time", 0.0)]);
    assert_eq!(jkr, run(viscoelastic, law(0.3).into()));
    assert!(jkr.1.norm() > 0.0 && jkr.2 > 0.0, "{jkr:?}");
    // Without a neck the law is that of Mindlin with the limit that the normal law names: μ (F + 2 π Γ R).
    let dmt = build("dmt", &[modulus, adhesion]);
    let mindlin = pulvis_contact::friction::Mindlin {
        effective_shear_modulus: SHEAR_MODULUS,
        dashpot: 0.0,
        coefficient: 0.3,
        rescale: pulvis_contact::friction::Rescale::Energy,
    };
    assert_eq!(run(dmt, law(0.3).into()), run(dmt, mindlin.into()));
}
