//! What every attraction at a distance promises (see `pulvis_contact::noncontact::NonContactLaw`).

use pulvis_contact::NonContact;
use pulvis_math::{F64Array, Real};

use crate::draw::Draw;
use crate::for_each_case;
use crate::parameters::random_law;

/// Checks every non-contact law of the catalogue with `count` random sets of parameters.
pub fn check_all(count: u64) {
    for entry in NonContact::ENTRIES {
        for_each_case(entry.name, count, |draw| {
            let law = random_law(entry, draw, NonContact::build);
            assert!(
                law.interaction_range() >= 0.0 && law.interaction_range().is_finite(),
                "{law:?}: reach {}",
                law.interaction_range()
            );
            let span = if law.interaction_range() > 0.0 {
                law.interaction_range()
            } else {
                draw.log_between(1e-8, 1e-4)
            };
            the_force_is_the_slope_of_the_potential(&law, span);
            beyond_its_reach_nothing_acts(&law, span, draw);
            a_cycle_costs_what_is_booked(&law, span, draw);
            only_memory_makes_a_difference_between_approach_and_separation(&law, span, draw);
            lanes_give_the_bits_of_the_plain_number(&law, span, draw);
        });
    }
}

const POINTS: i32 = 500;

fn the_force_is_the_slope_of_the_potential(law: &NonContact, span: f64) {
    let step = 3.0 * span / f64::from(POINTS);
    for touched in [0.0, 1.0] {
        let at = |point: i32| {
            let overlap = step * (f64::from(point) + 0.3) - 1.5 * span;
            let mut memory = touched;
            (law.respond(overlap, &mut memory), law.branch(overlap, touched))
        };
        for point in 1..POINTS {
            let (before, here, after) = (at(point - 1), at(point), at(point + 1));
            if before.1 != here.1 || here.1 != after.1 {
                continue;
            }
            let slope = (after.0.potential - before.0.potential) / (2.0 * step);
            // Central differences of parabolas are exact; potentials carry round-off 1e-16 V/step.
            let tolerance = 1e-9 * (law.max_stiffness() * span + here.0.force.abs());
            assert!((here.0.force - slope).abs() <= tolerance, "{law:?}: {} and {slope} N", here.0.force);
            let rise = (after.0.force - before.0.force).abs();
            assert!(
                rise <= 2.0 * step * law.max_stiffness() * (1.0 + 1e-9) + tolerance,
                "{law:?}: too steep"
            );
        }
    }
}

fn beyond_its_reach_nothing_acts(law: &NonContact, span: f64, draw: &mut Draw) {
    for touched in [0.0, 1.0] {
        let mut memory = touched;
        let distance = law.interaction_range() + 1e-9 * span + span * draw.unit();
        let answer = law.respond(-distance, &mut memory);
        assert_eq!((answer.force, answer.potential), (0.0, 0.0), "{law:?} at {distance} m");
        assert_eq!(answer.dissipated, 0.0, "{law:?}: an attraction that ends must not cost at its end");
        assert!(!law.remembers_touch() || memory == 0.0, "{law:?} remembers a touch out of reach");
    }
}

fn a_cycle_costs_what_is_booked(law: &NonContact, span: f64, draw: &mut Draw) {
    let depth = span * draw.between(0.1, 1.0);
    let outside = 1.2 * span;
    let step = span * 1e-4;
    let (mut touched, mut overlap, mut force, mut strongest) = (0.0, -outside, 0.0, 0.0_f64);
    let (mut work, mut lost) = (0.0, 0.0);
    for target in [depth, -0.5 * span, 0.5 * depth, -outside] {
        let steps = ((target - overlap).abs() / step).ceil();
        let start = overlap;
        for index in 1..=steps as u32 {
            let next = start + (target - start) * (f64::from(index) / steps);
            let answer = law.respond(next, &mut touched);
            work += 0.5 * (force + answer.force) * (next - overlap);
            lost += answer.dissipated;
            assert!(answer.dissipated >= 0.0, "{law:?}: {answer:?}");
            strongest = strongest.max(answer.force.abs());
            (overlap, force) = (next, answer.force);
        }
    }
    // A jump of the force within a step is integrated to half a step; there are at most four.
    let tolerance = 4.0 * 0.5 * strongest * step + 1e-12 * strongest * span;
    assert!((work - lost).abs() <= tolerance, "{law:?}: the cycle took {work} J and booked {lost} J");
}

fn only_memory_makes_a_difference_between_approach_and_separation(
    law: &NonContact,
    span: f64,
    draw: &mut Draw,
) {
    let overlap = span * draw.between(-1.2, 1.0);
    let (mut fresh, mut touched) = (0.0, 1.0);
    let (approach, separation) = (law.respond(overlap, &mut fresh), law.respond(overlap, &mut touched));
    if law.remembers_touch() {
        // In contact the two are one; the flag is 0 or 1.
        assert!(overlap < 0.0 || approach.force == separation.force, "{law:?}");
        assert!(fresh == 0.0 || fresh == 1.0, "{law:?}: {fresh}");
    } else {
        assert_eq!((fresh, touched), (0.0, 1.0), "{law:?} writes into a memory that it does not have");
        assert_eq!(approach, separation, "{law:?}");
    }
}

fn lanes_give_the_bits_of_the_plain_number(law: &NonContact, span: f64, draw: &mut Draw) {
    type Eight = F64Array<8>;
    let mut plain = [0.0; 8];
    let mut touched = Eight::zero();
    for _ in 0..40 {
        let overlaps: [f64; 8] =
            std::array::from_fn(|_| if draw.chance(0.1) { 0.0 } else { span * draw.between(-1.3, 1.0) });
        let answer = law.respond(F64Array(overlaps), &mut touched);
        for lane in 0..8 {
            let one = law.respond(overlaps[lane], &mut plain[lane]);
            let of_lane = [answer.force, answer.potential, answer.dissipated, touched];
            let alone = [one.force, one.potential, one.dissipated, plain[lane]];
            assert_eq!(of_lane.map(|x| x.lane(lane).to_bits()), alone.map(f64::to_bits), "{law:?}: {one:?}");
        }
    }
}
