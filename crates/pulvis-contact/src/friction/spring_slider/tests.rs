//! Stick, slip and their energies.

use pulvis_math::{Vector3, elementary};

use super::super::Along;
use super::*;

const LAW: SpringSlider =
    SpringSlider { stiffness: 100.0, dashpot: 0.0, dynamic_coefficient: 0.5, static_coefficient: 0.8 };

/// A displacement [m] within a second, at a speed that nothing but a dashpot would feel.
fn motion<T: Tangent<f64>>(displacement: T, reference: f64) -> SpringMotion<T, f64> {
    SpringMotion {
        velocity: displacement,
        displacement,
        elapsed: 1.0,
        in_contact: reference > 0.0,
        friction_reference: reference,
        contact_radius: 0.0,
        pull_off_force: 0.0,
        normal_stiffness: 0.0,
        lever: 0.0,
        slip_dashpot: SlipDashpot::Series,
    }
}

fn pull(displacement: f64, reference: f64, spring: &mut Vector3) -> FrictionResponse<Vector3> {
    LAW.respond(&motion(Vector3::new(displacement, 0.0, 0.0), reference), spring, &mut ()).0
}

#[test]
fn a_contact_sticks_up_to_the_static_limit_and_slides_at_the_dynamic_one() {
    let mut spring = Vector3::zero();
    assert_eq!(pull(7.9e-3, 1.0, &mut spring).force.x, -0.79);
    let sliding = pull(0.2e-3, 1.0, &mut spring);
    assert!((sliding.force.x + 0.5).abs() < 1e-15);
    assert!((spring.x - 5e-3).abs() < 1e-18);
}

#[test]
fn without_a_limit_a_contact_sticks_whatever_pulls() {
    for coefficient in [1e200, f64::INFINITY] {
        let law = SpringSlider { dynamic_coefficient: coefficient, static_coefficient: coefficient, ..LAW };
        let motion = motion(Vector3::new(3.0, 4.0, 0.0), 1e-3);
        let mut spring = Vector3::zero();
        assert_eq!(law.respond(&motion, &mut spring, &mut ()).0.force, Vector3::new(-300.0, -400.0, 0.0));
        assert_eq!(spring, motion.displacement);
    }
}

#[test]
fn slip_loses_what_the_spring_does_not_keep() {
    let mut spring = Vector3::zero();
    let (mut work, mut lost, mut force) = (0.0, 0.0, 0.0);
    let step = 1e-6;
    let mut stored = 0.0;
    for _ in 0..20_010 {
        let answer = pull(step, 1.0, &mut spring);
        work += 0.5 * (force - answer.force.x) * step;
        force = -answer.force.x;
        lost += answer.dissipated_slip;
        stored = answer.stored_energy;
    }
    assert!((work - lost - stored).abs() < 1e-12 * work);
    // Slip sets in at 8 mm of stretch, drops the force from 0.8 N to 0.5 N and leaves 5 mm; the
    // spring sticks again and slips every 3 mm: at 8, 11, 14, 17 and 20 mm, each time losing the
    // slipped 3 mm at the mean force.
    let expected = 5.0 * 0.5 * (0.8 + 0.5) * 3e-3;
    // Each slip starts up to one step of 1e-6 m late.
    assert!((lost - expected).abs() < 1e-3 * expected, "{lost} {expected}");
}

#[test]
fn an_opening_contact_loses_its_spring() {
    let mut spring = Vector3::zero();
    let stored = pull(1e-3, 1.0, &mut spring).stored_energy;
    let opened = pull(0.0, 0.0, &mut spring);
    assert_eq!(opened.force, Vector3::zero());
    assert_eq!(spring, Vector3::zero());
    assert!((opened.dissipated_slip - stored).abs() < 1e-20);
}

#[test]
fn the_torsion_spring_is_the_sliding_spring_in_one_dimension() {
    let (mut along, mut plane) = (Along(0.0), Vector3::zero());
    for step in 0..200 {
        let displacement = 1e-3 * elementary::sin(0.1 * f64::from(step));
        let (one, _) = LAW.respond(&motion(Along(displacement), 0.3), &mut along, &mut ());
        let three = pull(displacement, 0.3, &mut plane);
        assert_eq!(one.force.0, three.force.x);
        assert_eq!(one.dissipated_slip, three.dissipated_slip);
    }
}

/// The work [J] on a contact of unit friction limit along a path of displacements [m], each in its time [s].
fn work_along(law: &SpringSlider, slip_dashpot: SlipDashpot, path: &[(f64, f64)]) -> f64 {
    let (mut spring, mut force, mut work) = (Along(0.0), 0.0, 0.0);
    for &(displacement, elapsed) in path {
        let velocity = Along(displacement / elapsed);
        let calm = motion(Along(displacement), 1.0);
        let motion = SpringMotion { velocity, elapsed, slip_dashpot, ..calm };
        let answer = law.respond(&motion, &mut spring, &mut ()).0;
        work += 0.5 * (force - answer.force.0) * displacement;
        force = -answer.force.0;
    }
    work
}

/// A fast slide of a tenth of the spring's length at the limit, and a creep of a whole length onwards that no
/// dashpot feels.
fn slide_and_creep(law: &SpringSlider, ratio: f64) -> Vec<(f64, f64)> {
    const STEPS: u32 = 1000;
    let length = 1.0 / law.stiffness / f64::from(STEPS);
    let speed = ratio / law.dashpot;
    let slide = (0..STEPS).map(|_| (0.1 * length, 0.1 * length / speed));
    let creep = (0..STEPS).map(|_| (length, 1e3 * length / speed.min(1e-3 / law.dashpot)));
    slide.chain(creep).collect()
}

#[test]
fn a_directed_cycle_costs_work_at_any_speed_of_slip_and_gains_some_by_the_printed_rule() {
    let law = SpringSlider { dashpot: 3.0, dynamic_coefficient: 1.0, static_coefficient: 1.0, ..LAW };
    for ratio in [0.02, 0.2, 2.0, 20.0, 200.0] {
        let work = work_along(&law, SlipDashpot::Series, &slide_and_creep(&law, ratio));
        assert!(work > 0.0, "{ratio}: {work}");
    }
    let printed = work_along(&law, SlipDashpot::Printed, &slide_and_creep(&law, 2.0));
    assert!(printed < 0.0, "{printed}");
}

#[test]
fn steady_sliding_leaves_the_spring_at_the_limit_and_the_dashpot_at_rest() {
    let law = SpringSlider { dashpot: 3.0, dynamic_coefficient: 1.0, static_coefficient: 1.0, ..LAW };
    let path = vec![(1e-4, 1e-3); 2000];
    let steady =
        work_along(&law, SlipDashpot::Series, &path) - work_along(&law, SlipDashpot::Series, &path[..1000]);
    // The limit of 1 N over the second thousand steps; the spring relaxes within γ/k = 30 steps.
    assert!((steady / 0.1 - 1.0).abs() < 1e-12, "{steady}");
}
