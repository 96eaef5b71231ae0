//! Motions of one pair that have a closed form: oscillations, oblique impacts, sliding to rolling.
//!
//! Steps of the synchronised velocity-Verlet method are small fractions of the shortest period; what a
//! test allows beyond the step's error is the size of the overlap against the radius, which the closed
//! forms neglect.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use std::f64::consts::PI;

use pulvis_contact::friction::mindlin::Rescale;
use pulvis_contact::normal::Interpolation;
use pulvis_contact::theory::JkrPair;
use pulvis_contact::{
    ContactLaws, ContactModel, Friction, Hertz, Jkr, Linear, Luding, Mindlin, Normal, SpringSlider,
};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::oscillation::oscillates_at;

const MASS: f64 = 1e-3;
const RADIUS: f64 = 1e-2;
const X: Vector3 = Vector3::new(1.0, 0.0, 0.0);
const Y: Vector3 = Vector3::new(0.0, 1.0, 0.0);
const Z: Vector3 = Vector3::new(0.0, 0.0, 1.0);

fn slider(stiffness: f64, coefficient: f64) -> SpringSlider {
    SpringSlider {
        stiffness,
        dashpot: 0.0,
        dynamic_coefficient: coefficient,
        static_coefficient: coefficient,
    }
}

fn spring(stiffness: f64, coefficient: f64) -> Option<Friction> {
    Some(slider(stiffness, coefficient).into())
}

fn model(normal: impl Into<Normal>, laws: ContactLaws) -> ContactModel {
    ContactModel { normal: normal.into(), laws }
}

/// A contact that holds without load: it rests at the force-free overlap of a plastic contact.
fn holding(laws: ContactLaws) -> (ContactModel, f64) {
    let law = Luding { k1: 1e3, kp: 2e3, kc: 1e3, phi_f: 1e-7, interpolation: Interpolation::Linear };
    (model(law, laws), 1e-7)
}

/// Two spheres, or a sphere and a wall, pressed to the plastic limit and back to rest.
fn resting_pair(laws: ContactLaws, with_partner: bool) -> Couple {
    let (model, phi_f) = holding(laws);
    // δ_p = kp/(kp − k1) φ_f a12 = 2 φ_f a12, force-free at φ_f a12; a wall has a12 = 2 a.
    let harmonic = if with_partner { RADIUS } else { 2.0 * RADIUS };
    let force_free = phi_f * harmonic;
    let distance = if with_partner { 2.0 * RADIUS } else { RADIUS };
    let partner = with_partner.then(|| Sphere::at_rest(MASS, RADIUS, Vector3::zero()));
    let mut couple =
        Couple::new(&model, Sphere::at_rest(MASS, RADIUS, Z * (distance - 2.0 * force_free)), partner);
    couple.i.position = Z * (distance - force_free);
    couple.step(0.0);
    couple.step(0.0);
    assert!(couple.normal_force.abs() < 1e-12, "{} N", couple.normal_force);
    couple
}

#[test]
fn a_sticking_contact_point_oscillates_at_its_frequency() {
    let laws = ContactLaws { sliding: spring(1e3, 1e3), ..ContactLaws::default() };
    // ω² = k_t (1/m_r + a²/I_i + a²/I_j) = 7 k_t/m for two spheres, 7 k_t/(2 m) at a wall.
    for (with_partner, expected) in [(true, 2645.7513110646), (false, 1870.8286933870)] {
        let start = || {
            let mut couple = resting_pair(laws, with_partner);
            couple.i.velocity = X * 1e-7;
            couple
        };
        oscillates_at(expected, start, |couple| couple.springs().sliding.x);
    }
}

/// A contact of the tangential stiffness 8 G* a.
fn sheared(normal: impl Into<Normal>, effective_shear_modulus: f64, rescale: Rescale) -> ContactModel {
    let law = Mindlin { effective_shear_modulus, dashpot: 0.0, coefficient: 1e3, rescale };
    model(normal, ContactLaws { sliding: Some(law.into()), ..ContactLaws::default() })
}

#[test]
fn elastic_spheres_oscillate_sideways_with_the_stiffness_of_their_contact_area() {
    // ω² = 8 G* a (1/m_r + a_i²/I_i + a_j²/I_j). Overlaps are 1e-7 of the radii.
    let (modulus, shear_modulus) = (1e12, 4e11);
    for rescale in [Rescale::Energy, Rescale::Unloading] {
        // A sphere that its weight presses to a wall: δ = 1 nm, a = √(R δ).
        let overlap = 1e-9;
        let load = 4.0 / 3.0 * modulus * RADIUS.sqrt() * overlap * overlap.sqrt();
        let on_wall = || {
            let model = sheared(Hertz { effective_modulus: modulus }, shear_modulus, rescale);
            let mut couple = Couple::new(&model, Sphere::at_rest(MASS, RADIUS, Z * (RADIUS - overlap)), None);
            couple.gravity = -Z * (load / MASS);
            couple.step(0.0);
            couple.step(0.0);
            couple.i.velocity = X * 1e-7;
            couple
        };
        let stiffness = 8.0 * shear_modulus * (RADIUS * overlap).sqrt();
        oscillates_at((3.5 * stiffness / MASS).sqrt(), on_wall, |couple| couple.springs().sliding.x);
        // Two spheres that hang together without load.
        let (adhesion, effective_radius) = (0.05, 0.5 * RADIUS);
        let pair = JkrPair::new(modulus, adhesion, effective_radius).unwrap();
        let area = pair.unloaded_radius();
        let hanging = || {
            let model = sheared(Jkr::new(modulus, adhesion), shear_modulus, rescale);
            let partner = Sphere::at_rest(MASS, RADIUS, Vector3::zero());
            let first = Sphere::at_rest(MASS, RADIUS, Z * (2.0 * RADIUS - pair.overlap(area)));
            let mut couple = Couple::new(&model, first, Some(partner));
            couple.i.velocity = X * 1e-7;
            couple
        };
        let stiffness = 8.0 * shear_modulus * area;
        oscillates_at((7.0 * stiffness / MASS).sqrt(), hanging, |couple| couple.springs().sliding.x);
    }
}

#[test]
fn rolling_and_torsion_oscillate_at_their_frequencies() {
    // ω = L √(k (1/I_i + 1/I_j)) with L = a12: a for two spheres, 2 a at a wall.
    for (with_partner, expected) in [(true, 2236.0679774998), (false, 3162.2776601684)] {
        let turning = |laws: ContactLaws, angular_velocity: Vector3| {
            move || {
                let mut couple = resting_pair(laws, with_partner);
                // Opposite angular velocities: contact points do not slide.
                couple.i.angular_velocity = angular_velocity;
                if let Some(j) = couple.j.as_mut() {
                    j.angular_velocity = -angular_velocity;
                }
                couple
            }
        };
        let rolling = ContactLaws { rolling: spring(1e3, 1e3), ..ContactLaws::default() };
        oscillates_at(expected, turning(rolling, Y * 1e-6), |couple| couple.springs().rolling.x);
        let torsion = ContactLaws { torsion: spring(1e3, 1e3), ..ContactLaws::default() };
        oscillates_at(expected, turning(torsion, Z * 1e-6), |couple| couple.springs().torsion);
    }
}

/// An oblique impact of two equal spheres; returns the tangential velocity of the contact point after it
/// and the speed of separation [m/s].
fn impact(normal: Linear, sliding: SpringSlider, approach: f64, sideways: f64, steps: f64) -> (f64, f64) {
    let laws = ContactLaws { sliding: Some(sliding.into()), ..ContactLaws::default() };
    let mut first = Sphere::at_rest(MASS, RADIUS, Z * (2.0 * RADIUS));
    first.velocity = X * sideways - Z * approach;
    let mut couple =
        Couple::new(&model(normal, laws), first, Some(Sphere::at_rest(MASS, RADIUS, Vector3::zero())));
    let dt = PI * (0.5 * MASS / STIFFNESS).sqrt() / steps;
    couple.step_until(dt, 100_000, |couple| couple.overlap <= 0.0);
    let separation = (couple.i.velocity - couple.j.unwrap().velocity).z;
    (couple.contact_point_velocity().x, separation)
}

const STIFFNESS: f64 = 1e7;

#[test]
fn a_sticking_oblique_impact_reverses_the_contact_point_by_a_cosine() {
    // v_ct'/v_ct = cos(π √(7 k_t/(2 k))), and −1 at k_t/k = 2/7, where both half periods agree.
    for (ratio, expected) in [(0.2, -0.8712035704), (2.0 / 7.0, -1.0), (0.5, -0.5281772577)] {
        let sliding = slider(ratio * STIFFNESS, 1e9);
        let after = |steps: f64| impact(Linear::new(STIFFNESS, 0.0), sliding, 1e-3, 1e-5, steps).0 / 1e-5;
        let (coarse, fine) = (after(400.3), after(6400.3));
        // Contact ends up to a step late, where the force is not small: first order in the step.
        assert!((fine - expected).abs() < 1e-3, "k_t/k = {ratio}: {fine}, expected {expected}");
        assert!((fine - expected).abs() < 0.5 * (coarse - expected).abs() + 1e-4, "{ratio}: {coarse} {fine}");
    }
}

#[test]
fn gross_sliding_takes_seven_halves_of_friction_times_the_normal_impulse() {
    for restitution in [1.0, 0.6] {
        let (friction, approach, sideways) = (0.2, 1e-3, 5e-3);
        let law = Linear::from_restitution(STIFFNESS, restitution);
        let sliding = slider(STIFFNESS, friction);
        let after = |steps: f64| impact(law, sliding, approach, sideways, steps);
        let (fine, separation) = after(1600.3);
        // Friction refers to the elastic force, whose impulse is m_r (1 + e) v_n also with a dashpot, as
        // long as the dashpot's own impulse γ ∫ dδ is zero: from δ = 0 to δ = 0.
        let expected = sideways - 3.5 * friction * (1.0 + restitution) * approach;
        // Relative to the change; the turn of the normal, v_t²/(v_n d) t_c = 3e-5, and the last step.
        assert!((fine - expected).abs() < 2e-3 * (sideways - expected), "{fine}, expected {expected}");
        assert!((separation / approach - restitution).abs() < 2e-3, "{separation}");
    }
}

#[test]
fn a_sphere_that_slides_on_a_plane_comes_to_roll_with_five_sevenths_of_its_speed() {
    let (friction, speed, gravity) = (0.3, 1.0, 9.81);
    let stiffness = 1e6;
    let slider = SpringSlider { dashpot: 5.0, ..slider(2e5, friction) };
    let laws = ContactLaws { sliding: Some(slider.into()), ..ContactLaws::default() };
    let load = MASS * gravity / stiffness;
    let mut sphere = Sphere::at_rest(MASS, RADIUS, Z * (RADIUS - load));
    sphere.velocity = X * speed;
    let mut couple = Couple::new(&model(Linear::new(stiffness, 0.0), laws), sphere, None);
    couple.gravity = -Z * gravity;
    couple.step(0.0);
    let dt = 2e-6;
    let steps = couple.step_until(dt, 100_000, |couple| couple.contact_point_velocity().x <= 0.0);
    let expected = 2.0 * speed / (7.0 * friction * gravity);
    assert!((expected - 0.0970826658900).abs() < 1e-12);
    // The spring is stretched within μ m g/(k_t v) = 1.5e-8 s; near the end the dashpot takes over for
    // γ v ~ μ m g, v ~ 6e-4 m/s: 6e-4 of the duration.
    assert!((steps as f64 * dt / expected - 1.0).abs() < 2e-3, "{} s", steps as f64 * dt);
    couple.steps(5_000, dt);
    // Afterwards it rolls.
    assert!((couple.i.velocity.x / (5.0 / 7.0 * speed) - 1.0).abs() < 1e-5, "{}", couple.i.velocity.x);
    assert!(
        (couple.i.angular_velocity.y * RADIUS / couple.i.velocity.x - 1.0).abs() < 1e-5,
        "{}",
        couple.i.angular_velocity.y
    );
    // And what it lost is 2/7 of its kinetic energy.
    assert!((couple.lost / (0.5 * MASS * speed * speed) - 2.0 / 7.0).abs() < 1e-4, "{}", couple.lost);
}

#[test]
fn coulomb_limits_refer_to_the_distance_from_the_tensile_limit() {
    // f_hys = 1 N at δ = 2 mm with kc = 100 N/m and μ = 0.5: 0.5 (1 + 0.2) = 0.6 N; and in tension.
    for (elastic, expected) in [(1.0, 0.6), (-0.1, 0.05), (-0.2, 0.0)] {
        let law =
            Luding { k1: 800.0, kp: 2000.0, kc: 100.0, phi_f: 0.5, interpolation: Interpolation::Constant };
        let overlap = 2e-3;
        // kp δ − (kp − k1) D = f_hys gives the largest overlap D of the past.
        let past = (law.kp * overlap - elastic) / (law.kp - law.k1);
        let laws = ContactLaws { sliding: spring(1e3, 0.5), ..ContactLaws::default() };
        let mut couple = Couple::new(&model(law, laws), Sphere::at_rest(1.0, 0.1, Z * (0.1 - past)), None);
        couple.i.position = Z * (0.1 - overlap);
        couple.i.velocity = Vector3::zero();
        couple.step(0.0);
        assert!((couple.normal_force - elastic).abs() < 1e-12, "{}", couple.normal_force);
        // 1 m of sliding in one step, too far for any spring.
        couple.i.velocity = X * 1e6;
        let before = couple.i.velocity.x;
        couple.step(1e-6);
        let friction = couple.springs().sliding.x * 1e3;
        assert!((friction - expected).abs() < 1e-9, "{friction} N, expected {expected} N ({before})");
    }
}
