//! Rolling and torsion of laws that follow the normal contact, against closed forms.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::catalogue::{Role, Values};
use pulvis_contact::friction::{self, Along, ConstantTorque, ElasticPlastic, Marshall};
use pulvis_contact::normal::Interpolation;
use pulvis_contact::theory::JkrPair;
use pulvis_contact::{ContactLaws, ContactModel, Jkr, Linear, Luding, SpringSlider};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::friction::{Load, Walk};
use pulvis_testkit::oscillation::oscillates_at;

const MASS: f64 = 1e-3;
const RADIUS: f64 = 1e-2;
const INERTIA: f64 = 0.4 * MASS * RADIUS * RADIUS;
const X: Vector3 = Vector3::new(1.0, 0.0, 0.0);
const Y: Vector3 = Vector3::new(0.0, 1.0, 0.0);
const Z: Vector3 = Vector3::new(0.0, 0.0, 1.0);

/// Two spheres that turn against each other, held together without load by `model` at the overlap [m].
fn turning(model: &ContactModel, overlap: f64, angular_velocity: Vector3) -> Couple {
    let first = Sphere::at_rest(MASS, RADIUS, Z * (2.0 * RADIUS - overlap));
    let mut couple = Couple::new(model, first, Some(Sphere::at_rest(MASS, RADIUS, Vector3::zero())));
    couple.i.angular_velocity = angular_velocity;
    couple.j.as_mut().unwrap().angular_velocity = -angular_velocity;
    couple
}

#[test]
fn an_elastic_plastic_contact_rolls_with_the_stiffness_of_its_normal_force() {
    // Pressed to the plastic limit and back to the force-free overlap φ_f a12, the normal stiffness is kp.
    let (kp, overlap) = (2e3, 1e-7 * RADIUS);
    let normal = Luding { k1: 1e3, kp, kc: 1e3, phi_f: 1e-7, interpolation: Interpolation::Linear };
    let coefficient = 0.4;
    for (given, stiffness) in [(None, 2.25 * kp * coefficient * coefficient), (Some(500.0), 500.0)] {
        let rolling = ElasticPlastic { stiffness: given, dashpot: 0.0, coefficient };
        let laws = ContactLaws { rolling: Some(rolling.into()), ..ContactLaws::default() };
        let model = ContactModel { normal: normal.into(), laws };
        let start = || {
            let mut couple = turning(&model, 2.0 * overlap, Vector3::zero());
            couple.i.position = Z * (2.0 * RADIUS - overlap);
            couple.step(0.0);
            couple.step(0.0);
            couple.i.angular_velocity = Y * 1e-6;
            couple.j.as_mut().unwrap().angular_velocity = Y * -1e-6;
            couple
        };
        // ω = L √(k_r (1/I_i + 1/I_j)) with L = a12 = a.
        let expected = RADIUS * (2.0 * stiffness / INERTIA).sqrt();
        oscillates_at(expected, start, |couple| couple.springs().rolling.x);
    }
}

#[test]
fn an_adhesive_contact_twists_with_the_stiffness_of_its_area() {
    // ω² = (8 G* a) (a²/2) (1/I_i + 1/I_j): Marshall's k_Q is half of the stiffness of sliding times a².
    // Of real materials torsion is so much slower than the normal motion, by a/R, that no step would resolve both.
    let (modulus, adhesion, effective_shear_modulus) = (1e12, 0.05, 4e18);
    let pair = JkrPair::new(modulus, adhesion, 0.5 * RADIUS).unwrap();
    let area = pair.unloaded_radius();
    let torsion = Marshall { effective_shear_modulus, sliding_dashpot: 0.0, coefficient: 1e6 };
    let laws = ContactLaws { torsion: Some(torsion.into()), ..ContactLaws::default() };
    let model = ContactModel { normal: Jkr::new(modulus, adhesion).into(), laws };
    let expected = (4.0 * effective_shear_modulus * area * area * area * 2.0 / INERTIA).sqrt();
    let start = || turning(&model, pair.overlap(area), Z * 1e-6);
    oscillates_at(expected, start, |couple| couple.springs().torsion);
}

#[test]
fn a_twisted_area_slides_at_two_thirds_of_friction_times_its_radius() {
    let (radius, lever, reference, coefficient) = (2e-5, 1e-3, 0.3, 0.5);
    let law = Marshall { effective_shear_modulus: 1e7, sliding_dashpot: 0.0, coefficient };
    let load = Load { lever, ..Load::new(reference, radius) };
    let mut walk = Walk::<_, Along<f64>>::new(law);
    for _ in 0..100 {
        walk.go(&load, Along(0.2 * lever));
    }
    // A uniform pressure over the area, every part of which slides: ∫ μ p r dA = (2/3) μ N a.
    let moment = -walk.force.0 * lever;
    assert!((moment / (2.0 / 3.0 * coefficient * reference * radius) - 1.0).abs() < 1e-13, "{moment}");
}

#[test]
fn a_dashpot_of_torsion_is_half_of_that_of_sliding_times_the_square_of_the_area() {
    let (radius, lever, gamma) = (2e-5, 1e-3, 0.7);
    let law = Marshall { effective_shear_modulus: 1e-30, sliding_dashpot: gamma, coefficient: 1e9 };
    let load = Load { lever, ..Load::new(1.0, radius) };
    let mut walk = Walk::<_, Along<f64>>::new(law);
    // L φ in one second.
    walk.go(&load, Along(3.0 * lever));
    let moment = -walk.force.0 * lever;
    assert!((moment / (0.5 * gamma * radius * radius * 3.0) - 1.0).abs() < 1e-13, "{moment}");
}

#[test]
fn a_dashpot_of_rolling_acts_below_the_limit_and_not_at_it() {
    let law = ElasticPlastic { stiffness: Some(100.0), dashpot: 5.0, coefficient: 0.2 };
    let load = Load::new(1.0, 1e-4);
    let mut walk = Walk::<_, Along<f64>>::new(law);
    walk.go(&load, Along(1e-3));
    assert!((walk.force.0 + 0.1 + 5e-3).abs() < 1e-15, "spring and dashpot: {} N", walk.force.0);
    walk.go(&load, Along(2e-3));
    assert!((walk.force.0 + 0.2).abs() < 1e-15, "at the limit: {} N", walk.force.0);
}

#[test]
fn a_constant_torque_slows_a_rolling_sphere_down_evenly() {
    // m dv/dt = −F, I dω/dt = F a − M, v = ω a: dv/dt = −M/(a m (1 + 2/5)) with M = μ_r N L, L = 2 a at a wall.
    let (coefficient, gravity, speed, stiffness) = (0.01, 9.81, 1.0, 2e6);
    let sliding = SpringSlider { stiffness, dashpot: 5.0, dynamic_coefficient: 0.5, static_coefficient: 0.5 };
    let rolling = ConstantTorque { coefficient };
    let laws = ContactLaws {
        sliding: Some(sliding.into()),
        rolling: Some(rolling.into()),
        ..ContactLaws::default()
    };
    let model = ContactModel { normal: Linear::new(stiffness, 0.0).into(), laws };
    let overlap = MASS * gravity / stiffness;
    let mut couple = Couple::new(&model, Sphere::at_rest(MASS, RADIUS, Z * (RADIUS - overlap)), None);
    couple.gravity = -Z * gravity;
    couple.i.velocity = X * speed;
    couple.i.angular_velocity = Y * (speed / RADIUS);
    let (steps, dt) = (200_000, 1e-6);
    let energy = couple.kinetic_energy();
    couple.steps(steps, dt);
    let deceleration = coefficient * 2.0 * gravity / 1.4;
    let expected = speed - deceleration * steps as f64 * dt;
    // The overlap, 5e-9 m of 1e-2 m, and the friction spring, which takes up the inertial force in the beginning.
    assert!((couple.i.velocity.x / expected - 1.0).abs() < 1e-5, "{} {expected}", couple.i.velocity.x);
    let fallen = energy - couple.kinetic_energy();
    assert!((couple.lost / fallen - 1.0).abs() < 1e-5, "{} of {fallen} J are booked", couple.lost);
}

#[test]
fn a_constant_torque_along_any_bend_costs_its_share_of_the_way() {
    // Trapezoidal work of a piece: μ_r N (1 + cos φ)/2 of its length, φ the bend before it.
    let load = Load::new(3.0, 1e-4);
    let mut walk = Walk::<_, Vector3>::new(ConstantTorque { coefficient: 0.1 });
    walk.go(&load, X * 1e-3);
    let first = walk.work;
    assert!((first - 0.5 * 0.3 * 1e-3).abs() < 1e-18, "the force sets in with the motion: {first}");
    for (piece, cosine) in [(Y * 2e-3, 0.0), (Y * 1e-3, 1.0), (Y * -5e-3, -1.0)] {
        let before = walk.work;
        walk.go(&load, piece);
        let expected = 0.3 * 0.5 * (1.0 + cosine) * piece.norm();
        assert!((walk.work - before - expected).abs() < 1e-18, "{cosine}: {}", walk.work - before);
    }
    assert!((walk.work - walk.lost).abs() < 1e-18);
}

#[test]
fn a_rolling_law_resists_no_other_motion() {
    for role in [Role::Sliding, Role::Torsion] {
        assert!(friction::build(role, "constant-torque", &Values::new()).is_none());
        assert!(friction::build(role, "elastic-plastic", &Values::new()).is_none());
    }
}
