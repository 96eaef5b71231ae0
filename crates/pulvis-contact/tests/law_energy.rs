//! Whole contacts close their energy balance and turn in space without losing their springs.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::conventions::{FrictionReference, LeverArm, RollingLever, SlipDashpot};
use pulvis_contact::friction::SpringRotation;
use pulvis_contact::normal::Interpolation;
use pulvis_contact::{ContactLaws, ContactModel, Conventions, Friction, Luding, Normal, SpringSlider};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::pair_motion;
use pulvis_testkit::contact::{Dance, RigidRotation, closing_errors, random_model, rigid_rotation};
use pulvis_testkit::{LiveContact, for_each_case};

#[test]
fn the_energy_balance_closes_at_its_order_for_any_laws_and_conventions() {
    for_each_case("energy balance", 150, |draw| {
        let model = random_model(draw);
        let dance = Dance::in_contact(&model, draw);
        closes_at_its_order(&model, &dance);
    });
}

#[test]
fn every_combination_of_conventions_closes_its_energy_balance() {
    for_each_case("conventions", 2, |draw| {
        let mut model = random_model(draw);
        let dance = Dance::in_contact(&model, draw);
        for conventions in all_conventions() {
            model.laws.conventions = conventions;
            closes_at_its_order(&model, &dance);
        }
    });
}

fn closes_at_its_order(model: &ContactModel, dance: &Dance) {
    let [fine, coarse @ ..] = closing_errors(model, dance, [8000, 900, 1000, 1100]);
    let coarse = coarse.into_iter().fold(0.0, f64::max);
    let laws = &model.laws;
    // Only the spring-slider knows another way.
    let in_series = laws.conventions.slip_dashpot == SlipDashpot::Series
        || [laws.sliding, laws.rolling, laws.torsion]
            .into_iter()
            .flatten()
            .any(|law| law.dashpot() != 0.0 && !matches!(law, Friction::SpringSlider(_)));
    // Bodies that detach and attach anew while they overlap: in the step of the event the books are half-way. And an
    // attraction over less than a step.
    // Or whose own dashpot sets in with a jump, where they snap into contact.
    let snaps = matches!(
        model.normal,
        Normal::Pasha(_) | Normal::ThorntonNing(_) | Normal::Tomas(_) | Normal::ViscoelasticJkr(_)
    );
    if snaps || in_series && laws.has_resistance_dashpot() {
        // The books of a dashpot in series with a slider run ahead by half a step of what it loses by slip: first order,
        // with the same margin of 4.
        assert!(fine <= coarse / 2.0 + 1e-10, "{coarse} falls to {fine} with a time step of 1/8: {model:?}");
        assert!(coarse < 1e-2, "{coarse}: {model:?}");
        return;
    }
    // Second order falls by 64, first order by 8. What a kink costs depends on where in a step it lies: hence the largest
    // of three coarse runs, and the bound between the two.
    // 1e-10 is round-off of positions in the mid-step velocities.
    assert!(fine <= coarse / 16.0 + 1e-10, "{coarse} falls to {fine} with a time step of 1/8: {model:?}");
    // The coarse steps may pass over the unloading of a contact that is a thousand times stiffer there.
    assert!(fine < 1e-2, "{fine}: {model:?}");
}

fn all_conventions() -> Vec<Conventions> {
    let references =
        [FrictionReference::AdhesiveLimit, FrictionReference::Total, FrictionReference::TotalAdhesiveLimit];
    let rotations =
        [SpringRotation::Rescale, SpringRotation::Project, SpringRotation::Twist, SpringRotation::Rate];
    let mut all = Vec::new();
    for friction_reference in references {
        for lever_arm in [LeverArm::Corrected, LeverArm::Radius] {
            for rolling_lever in [RollingLever::Harmonic, RollingLever::Reduced] {
                for spring_rotation in rotations {
                    for slip_dashpot in [SlipDashpot::Series, SlipDashpot::Printed] {
                        all.push(Conventions {
                            friction_reference,
                            lever_arm,
                            rolling_lever,
                            spring_rotation,
                            slip_dashpot,
                        });
                    }
                }
            }
        }
    }
    all
}

/// A contact that sticks: strong friction, no dashpots.
fn sticking(conventions: Conventions) -> ContactModel {
    let spring = |stiffness| {
        let (dynamic_coefficient, static_coefficient) = (10.0, 10.0);
        Some(SpringSlider { stiffness, dashpot: 0.0, dynamic_coefficient, static_coefficient }.into())
    };
    let normal = Luding { k1: 1e2, kp: 5e2, kc: 1e2, phi_f: 0.05, interpolation: Interpolation::Linear };
    let laws = ContactLaws {
        sliding: spring(20.0),
        rolling: spring(10.0),
        torsion: spring(15.0),
        conventions,
        ..ContactLaws::default()
    };
    ContactModel { normal: normal.into(), laws }
}

fn rotated(spring_rotation: SpringRotation, axis: Vector3, steps: u32) -> RigidRotation {
    let conventions = Conventions { spring_rotation, ..Conventions::default() };
    rigid_rotation(&sticking(conventions), 1e-4, axis, 2.0, steps)
}

const ACROSS: Vector3 = Vector3::new(0.6, 0.8, 0.0);
const ALONG: Vector3 = Vector3::new(0.0, 0.0, 1.0);
const OBLIQUE: Vector3 = Vector3::new(0.48, 0.64, 0.6);

/// Relative change of the length of the sliding, rolling and torsion springs.
fn stretching(turn: &RigidRotation) -> f64 {
    let relative = |after: f64, before: f64| (after / before - 1.0).abs();
    relative(turn.after.sliding.norm(), turn.before.sliding.norm())
        .max(relative(turn.after.rolling.norm(), turn.before.rolling.norm()))
        .max(relative(turn.after.torsion, turn.before.torsion))
}

/// Relative change of the sliding and rolling springs as vectors that turn with the pair.
fn deviation(turn: &RigidRotation) -> f64 {
    let relative = |after: Vector3, before: Vector3| (after - before).norm() / before.norm();
    relative(turn.after.sliding, turn.before.sliding).max(relative(turn.after.rolling, turn.before.rolling))
}

#[test]
fn a_stuck_pair_that_turns_as_one_body_keeps_its_springs_and_their_energy() {
    for rotation in [SpringRotation::Rescale, SpringRotation::Twist] {
        for axis in [ACROSS, ALONG, OBLIQUE] {
            let [coarse, fine] = [500, 2000].map(|steps| rotated(rotation, axis, steps));
            // What is left is the chord that replaces the arc within a step, second order in the angle.
            let (first, second) = (stretching(&coarse), stretching(&fine));
            assert!(second <= first / 12.0 + 1e-9, "{rotation:?} about {axis:?}: {first}, {second}");
            let energy = (fine.energy_after / fine.energy_before - 1.0).abs();
            assert!(energy < 3.0 * second + 1e-9, "{rotation:?} about {axis:?}: energy changes by {energy}");
            assert!(fine.lost.abs() <= 1e-9 * fine.energy_before, "{rotation:?} loses {}", fine.lost);
            assert!(second < 1e-3, "{rotation:?} about {axis:?}: {second}");
        }
    }
}

#[test]
fn twisted_springs_turn_with_the_pair_and_rescaled_ones_lag_behind() {
    for (rotation, axis) in
        [(SpringRotation::Twist, ACROSS), (SpringRotation::Twist, ALONG), (SpringRotation::Twist, OBLIQUE)]
    {
        let [coarse, fine] = [500, 2000].map(|steps| deviation(&rotated(rotation, axis, steps)));
        assert!(fine <= coarse / 12.0 + 1e-9 && fine < 1e-4, "{rotation:?} about {axis:?}: {coarse}, {fine}");
    }
    // Stretching after projection bends a spring at first order in the step.
    let [coarse, fine] = [500, 2000].map(|steps| deviation(&rotated(SpringRotation::Rescale, ACROSS, steps)));
    assert!(fine <= coarse / 3.0 && fine < 1e-3, "{coarse}, {fine}");
    // Turned about the line of centres, a spring that is only projected stays behind by the whole angle.
    let behind = rotated(SpringRotation::Rescale, ALONG, 500);
    let angle = behind.after.sliding.dot(behind.before.sliding)
        / (behind.after.sliding.norm() * behind.before.sliding.norm());
    assert!((angle - 2.0_f64.cos()).abs() < 1e-6, "{angle}");
}

#[test]
fn projected_and_rate_springs_lose_length_at_first_order_and_the_loss_is_booked() {
    for rotation in [SpringRotation::Project, SpringRotation::Rate] {
        let [coarse, fine] = [500, 2000].map(|steps| rotated(rotation, ACROSS, steps));
        let (first, second) = (stretching(&coarse), stretching(&fine));
        let order = (first / second).log(4.0);
        assert!((order - 1.0).abs() < 0.1, "{rotation:?}: order {order}, {first} {second}");
        let missing = [coarse, fine]
            .map(|turn| (turn.energy_before - turn.energy_after - turn.lost).abs() / turn.energy_before);
        // The chord that replaces the arc does work at second order in the step.
        assert!(missing[1] <= missing[0] / 12.0 && missing[1] < 1e-4, "{rotation:?}: {missing:?}");
    }
}

#[test]
fn uncorrected_arms_make_a_turning_pair_slide_by_overlap_times_angle() {
    let conventions = Conventions { lever_arm: LeverArm::Radius, ..Conventions::default() };
    let mut model = sticking(conventions);
    model.laws.rolling = None;
    let (overlap, angle) = (1e-4, 1e-3);
    let turn = rigid_rotation(&model, overlap, ACROSS, angle, 100);
    let slid = (turn.after.sliding - turn.before.sliding).norm();
    // Contact points of arms a_i + a_j = d + δ move apart by δ φ; curvature enters at φ².
    assert!((slid / (overlap * angle) - 1.0).abs() < 1e-2, "{slid}");
}

#[test]
fn friction_stays_in_the_tangent_plane_whatever_slips_and_however_fast_the_pair_turns() {
    for_each_case("direction of friction", 200, |draw| {
        let mut model = random_model(draw);
        let dance = Dance::random(&model, draw);
        model.laws.conventions.slip_dashpot = SlipDashpot::Series;
        let mut contact = LiveContact::new(&model, dance.pair);
        for step in 0..=200 {
            let [i, j] = dance.step(step, 200);
            let motion = pair_motion(dance.radius_i, &i, Some((dance.radius_j, &j)));
            let answer = contact.respond(&motion, dance.duration / 200.0);
            let leaning = answer.force.dot(motion.normal) - answer.normal_force;
            // `rate` leaves a spring out of the plane by what the normal turns in a step.
            let allowed = match model.laws.conventions.spring_rotation {
                SpringRotation::Rate => 0.2,
                _ => 1e-12,
            };
            assert!(leaning.abs() <= allowed * answer.force.norm(), "{leaning} N: {answer:?} {model:?}");
        }
    });
}
