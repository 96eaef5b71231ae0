//! The law of Thornton and Ning on single pairs, against published numbers and quadratures of the pressure.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use std::f64::consts::PI;

use pulvis_contact::normal::{ThorntonNing, ThorntonNingMemory};
use pulvis_contact::theory::YieldingPair;
use pulvis_contact::{ContactModel, ExpectedLoading, NormalLaw, NormalMotion, NormalResponse, Pair};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::collisions::collide;

#[test]
fn the_yield_velocity_and_the_restitution_are_the_published_ones() {
    let solid = |density: f64, radius: f64| density * 4.0 / 3.0 * PI * radius.powi(3);
    for (modulus, radius, pressure, density, velocity) in
        [(1e9, 1e-4, 1e7, 2000.0, 1.1034553176e-2), (1.2e11, 5e-3, 3e9, 7800.0, 0.6048714595)]
    {
        let pair = YieldingPair::new(modulus, pressure, radius, solid(density, radius)).unwrap();
        assert!((pair.yield_velocity() / velocity - 1.0).abs() < 1e-10, "{}", pair.yield_velocity());
        let printed = [(0.5, 0.9306258773), (0.1, 0.6585583367), (0.01, 0.3742989619)];
        for (ratio, restitution) in printed {
            let found = pair.restitution(pair.yield_velocity() / ratio);
            assert!((found - restitution).abs() < 2e-10, "{found}");
        }
        assert!((pair.restitution(0.9 * pair.yield_velocity()) - 1.0).abs() < 1e-15);
        // e → 1.185 x^(1/4).
        let far = pair.restitution(1e8 * pair.yield_velocity()) * 100.0;
        assert!((far - 1.185).abs() < 1e-3, "{far}");
    }
}

#[test]
fn bodies_without_adhesion_rebound_as_the_closed_form_says() {
    let (modulus, radius, pressure) = (1e9, 1e-4, 1e7);
    let mass = 2000.0 * 4.0 / 3.0 * PI * radius * radius * radius;
    let theory = YieldingPair::new(modulus, pressure, radius, mass).unwrap();
    let law = ThorntonNing::new(modulus, pressure, 0.0, false);
    for ratio in [0.9, 2.0, 10.0, 100.0] {
        let speed = ratio * theory.yield_velocity();
        let expected = ExpectedLoading { speed, force: 0.0, overlap: 0.0 };
        let stiffness = law.max_stiffness(&Pair::wall(mass, radius), &expected);
        let period = 2.0 * PI * (mass / stiffness).sqrt();
        let errors = [100.3, 1600.3].map(|steps| {
            let found = collide(&ContactModel::frictionless(law), (mass, radius), speed, period / steps, 0.0);
            assert!(found.missing < 4.0 / (steps * steps), "{} is missing", found.missing);
            (found.restitution.powi(2) - theory.restitution(speed).powi(2)).abs()
        });
        // Second order: the force has kinks only.
        assert!(errors[0] < 1e-3 && errors[1] < 1e-5, "{ratio} v_y: {errors:?}");
    }
}

/// E* [Pa], R [m], p_y [Pa], Γ [J/m²]; a sphere of 2000 kg/m³ at a wall.
const MODULUS: f64 = 1e9;
const RADIUS: f64 = 1e-6;
const PRESSURE: f64 = 3e7;
const ADHESION: f64 = 0.05;
const MASS: f64 = 8.377580409572781e-15;

fn law(published: bool) -> ThorntonNing {
    ThorntonNing::new(MODULUS, PRESSURE, ADHESION, published)
}

fn pair() -> Pair {
    Pair::wall(MASS, RADIUS)
}

fn rest(law: &ThorntonNing, overlap: f64, memory: &mut ThorntonNingMemory<f64>) -> NormalResponse {
    law.respond(&NormalMotion::at_rest(&pair(), overlap), memory)
}

/// δ(a) of the adhesive curve [m].
fn overlap(radius: f64) -> f64 {
    radius * radius / RADIUS - (2.0 * PI * ADHESION * radius / MODULUS).sqrt()
}

/// Speed [m/s], largest overlap [m] and force [N], R_p [m], δ_p [m], pull-off force [N], restitution.
const COLLISIONS: [[f64; 7]; 2] = [
    [
        2.0,
        2.287160013046916e-08,
        1.7298433311424228e-06,
        1.6317823638260768e-06,
        1.1717556940077131e-08,
        -3.844796614840042e-07,
        0.5339922825473156,
    ],
    [
        10.0,
        9.998214445152083e-08,
        8.733565867930646e-06,
        3.1438937756283405e-06,
        7.514399381201297e-08,
        -7.407625191885504e-07,
        0.4264413235137212,
    ],
];

#[test]
fn a_contact_yields_and_unloads_as_the_published_quadrature_says() {
    let law = law(false);
    // The radius at yield: the force leaves the curve of jkr there.
    let yield_radius = 7.87120498265656e-08;
    let mut memory = ThorntonNingMemory::default();
    rest(&law, overlap(yield_radius) * (1.0 - 1e-9), &mut memory);
    assert_eq!(memory.largest_radius, 0.0);
    rest(&law, overlap(yield_radius) * (1.0 + 1e-9), &mut memory);
    assert!(memory.largest_radius > 0.0);
    for [_, overlap_max, force_max, _, start, pull_off, _] in COLLISIONS {
        let mut memory = ThorntonNingMemory::default();
        let deepest = rest(&law, overlap_max, &mut memory);
        assert!((deepest.force / force_max - 1.0).abs() < 1e-13, "{}", deepest.force);
        // F(δ_p) = −(8/9) of the pull-off force.
        let at = |overlap: f64| rest(&law, overlap, &mut memory.clone());
        assert!((at(start).force / (8.0 / 9.0 * pull_off) - 1.0).abs() < 1e-12, "{}", at(start).force);
        let (mut low, mut high) = (start - 1e-8, start);
        for _ in 0..200 {
            let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if at(left).force < at(right).force { high = right } else { low = left }
        }
        // Apart, the force is zero: the search ends at the least one or at the break.
        assert!((at(high).force / pull_off - 1.0).abs() < 1e-10, "{} {pull_off}", at(high).force);
    }
}

#[test]
fn the_slopes_of_both_variants_are_the_published_ones() {
    // dF/dδ at 1.5 a_y [N/m].
    let radius = 1.5 * 7.87120498265656e-08;
    for (published, slope) in [(false, 85.31131549036643), (true, 86.50134582174367)] {
        let law = law(published);
        let force = |radius: f64| rest(&law, overlap(radius), &mut ThorntonNingMemory::default()).force;
        let (low, high) = (0.9999 * radius, 1.0001 * radius);
        let found = (force(high) - force(low)) / (overlap(high) - overlap(low));
        // A central difference over 1e-4 errs by 1e-8.
        assert!((found / slope - 1.0).abs() < 1e-7, "{found} {slope}");
    }
}

#[test]
fn the_losses_of_a_cycle_are_the_same_in_one_step_and_in_many() {
    for published in [false, true] {
        let law = law(published);
        let path = [1e-8, -1e-8, 4e-8, 1.5e-8, 3e-8, 1.9e-8, 9e-8, 6e-8, 8e-8, -1e-8];
        let run = |steps: u32| {
            let (mut memory, mut at, mut lost) = (ThorntonNingMemory::default(), -1e-8, [0.0, 0.0]);
            for target in path {
                for step in 1..=steps {
                    let overlap = at + (target - at) * f64::from(step) / f64::from(steps);
                    let answer = rest(&law, overlap, &mut memory);
                    lost[0] += answer.dissipated_plastic;
                    lost[1] += answer.dissipated_adhesive;
                }
                at = target;
            }
            assert_eq!(memory, ThorntonNingMemory::default(), "a contact that opened is forgotten");
            lost
        };
        let (one, many) = (run(1), run(313));
        for account in 0..2 {
            assert!((one[account] / many[account] - 1.0).abs() < 1e-12, "{one:?} {many:?}");
        }
    }
}

#[test]
fn adhesive_bodies_rebound_as_published_and_slow_ones_stick() {
    for [speed, overlap_max, .., restitution] in COLLISIONS {
        let expected = ExpectedLoading { speed, force: 0.0, overlap: 0.0 };
        let period = 2.0 * PI * (MASS / law(false).max_stiffness(&pair(), &expected)).sqrt();
        let errors = [100.3, 1600.3].map(|steps| {
            let model = ContactModel::frictionless(law(false));
            let found = collide(&model, (MASS, RADIUS), speed, period / steps, -1e-9);
            assert!(found.missing < 2e-2 / steps, "{} is missing", found.missing);
            (found.restitution - restitution).abs()
        });
        // Snap-in and snap-off are weighted by the part of the step in which the force acts: second order.
        assert!(errors[0] < 4e-3 && errors[1] < 3e-5, "{speed} m/s: {errors:?}");
        assert!(overlap_max > 0.0);
    }
    let mut sphere = Sphere::at_rest(MASS, RADIUS, Vector3::new(0.0, 0.0, RADIUS));
    sphere.velocity.z = -0.5;
    let mut couple = Couple::new(&ContactModel::frictionless(law(false)), sphere, None);
    for _ in 0..20_000 {
        couple.step(5e-11);
        assert!(couple.normal_force != 0.0, "parted at {} m", couple.overlap);
    }
}

#[test]
fn the_name_of_the_branch_does_not_flicker_while_the_contact_yields() {
    let pair = Pair::wall(MASS, RADIUS);
    for adhesion in [ADHESION, 0.0] {
        let law = ThorntonNing::new(MODULUS, PRESSURE, adhesion, false);
        let mut memory = ThorntonNingMemory::default();
        let mut names: Vec<&str> = Vec::new();
        let mut look = |overlap: f64, memory: &mut ThorntonNingMemory<f64>| {
            law.respond(&NormalMotion::at_rest(&pair, overlap), memory);
            let (_, name) = law.branch(&pair, overlap, memory);
            if names.last() != Some(&name) {
                names.push(name);
            }
        };
        (1..=3000).for_each(|step| look(1e-11 * f64::from(step), &mut memory));
        (1..3000).rev().for_each(|step| look(1e-11 * f64::from(step), &mut memory));
        let end = if adhesion > 0.0 { "apart" } else { "free" };
        assert_eq!(names, ["elastic", "plastic", "unloading", end], "Γ = {adhesion}");
    }
}
