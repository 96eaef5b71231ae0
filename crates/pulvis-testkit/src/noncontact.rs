//! What every attraction at a distance promises (see `pulvis_contact::noncontact::NonContactLaw`).

use pulvis_contact::catalogue::Law;
use pulvis_contact::noncontact::NonContactResponse;
use pulvis_contact::{Linear, NonContact, NormalMotion, Pair};
use pulvis_math::{F64Array, Real};

use crate::draw::Draw;
use crate::for_each_case;
use crate::lanes::{LANES, Lanes};
use crate::parameters::{random_law, random_pair, with_random_quantities};

/// Checks every non-contact law of the catalogue with `count` random sets of parameters.
pub fn check_all(count: u64) {
    for entry in NonContact::ENTRIES {
        for_each_case(entry.name, count, |draw| {
            let law = random_law(entry, draw, NonContact::build);
            let bench = Bench::new(law, draw);
            bench.the_force_is_the_slope_of_the_potential();
            bench.beyond_its_range_nothing_acts(draw);
            bench.a_cycle_costs_what_is_booked(draw);
            bench.only_memory_makes_a_difference_between_approach_and_separation(draw);
            bench.lanes_give_the_bits_of_the_plain_number(draw);
        });
    }
}

const POINTS: i32 = 500;

/// One law at one pair of bodies.
struct Bench {
    law: NonContact,
    pair: Pair,
    /// How far from touching the tests go, in both directions [m].
    span: f64,
}

/// A random pair with the quantities that the law reads.
fn random_pair_of(law: &NonContact, draw: &mut Draw) -> Pair {
    let pair = random_pair(draw);
    with_random_quantities(pair, &Linear::ENTRY, Some(law.entry()), draw)
}

impl Bench {
    fn new(law: NonContact, draw: &mut Draw) -> Self {
        let pair = random_pair_of(&law, draw);
        let range = law.interaction_range(&pair);
        assert!(range >= 0.0 && range.is_finite(), "{law:?}: acts at a distance of {range} m");
        Self { law, pair, span: if range > 0.0 { range } else { draw.log_between(1e-8, 1e-4) } }
    }

    fn respond(&self, overlap: f64, memory: &mut [f64]) -> NonContactResponse {
        self.law.respond(&NormalMotion::at_rest(&self.pair, overlap), memory, 0)
    }

    fn virgin(&self) -> Vec<f64> {
        vec![0.0; self.law.entry().memory.len()]
    }

    /// The memory of bodies that touch.
    fn touched(&self) -> Vec<f64> {
        let mut memory = self.virgin();
        self.respond(0.1 * self.span, &mut memory);
        memory
    }

    fn the_force_is_the_slope_of_the_potential(&self) {
        let Self { law, pair, span } = self;
        let max_stiffness = law.max_stiffness(pair);
        let step = 3.0 * span / f64::from(POINTS);
        for past in [self.virgin(), self.touched()] {
            let at = |point: i32| {
                let overlap = step * (f64::from(point) + 0.3) - 1.5 * span;
                (self.respond(overlap, &mut past.clone()), law.branch(pair, overlap, &past, 0))
            };
            for point in 1..POINTS {
                let (before, here, after) = (at(point - 1), at(point), at(point + 1));
                if before.1 != here.1 || here.1 != after.1 {
                    continue;
                }
                // Central differences over 1e-5 of the step err by less than 1e-9 even where the attraction falls within
                // a hundredth of its range; the potential's round-off, over that step, is of the same size.
                let middle = step * (f64::from(point) + 0.3) - 1.5 * span;
                let (low, high) = (middle - 1e-5 * step, middle + 1e-5 * step);
                let potential = |overlap: f64| self.respond(overlap, &mut past.clone()).potential;
                let slope = (potential(high) - potential(low)) / (high - low);
                let tolerance = 1e-8 * (max_stiffness * span + here.0.force.abs());
                let error = (here.0.force - slope).abs();
                assert!(error <= tolerance, "{law:?}: {} and {slope} N", here.0.force);
                let rise = (after.0.force - before.0.force).abs();
                assert!(rise <= 2.0 * step * max_stiffness * (1.0 + 1e-9) + tolerance, "{law:?}: too steep");
            }
        }
    }

    fn beyond_its_range_nothing_acts(&self, draw: &mut Draw) {
        let Self { law, span, .. } = self;
        for mut memory in [self.virgin(), self.touched()] {
            let distance = law.interaction_range(&self.pair) + 1e-9 * span + span * draw.unit();
            let answer = self.respond(-distance, &mut memory);
            assert_eq!((answer.force, answer.potential), (0.0, 0.0), "{law:?} at {distance} m");
            assert_eq!(answer.dissipated, 0.0, "{law:?}: an attraction that ends must not cost at its end");
            assert_eq!(memory, self.virgin(), "{law:?} remembers a touch out of its range");
        }
    }

    fn a_cycle_costs_what_is_booked(&self, draw: &mut Draw) {
        let Self { law, span, .. } = self;
        let depth = span * draw.between(0.1, 1.0);
        let outside = 1.2 * span;
        let step = span * 1e-4;
        let mut memory = self.virgin();
        let (mut overlap, mut force, mut strongest) = (-outside, 0.0, 0.0_f64);
        let (mut work, mut lost) = (0.0, 0.0);
        for target in [depth, -0.5 * span, 0.5 * depth, -outside] {
            let steps = ((target - overlap).abs() / step).ceil();
            let start = overlap;
            for index in 1..=steps as u32 {
                let next = start + (target - start) * (f64::from(index) / steps);
                let answer = self.respond(next, &mut memory);
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

    fn only_memory_makes_a_difference_between_approach_and_separation(&self, draw: &mut Draw) {
        let overlap = self.span * draw.between(-1.2, 1.0);
        let (mut fresh, mut touched) = (self.virgin(), self.touched());
        let approach = self.respond(overlap, &mut fresh);
        let separation = self.respond(overlap, &mut touched);
        let law = self.law;
        if law.acts_on_approach() || overlap >= 0.0 {
            assert_eq!(approach.force, separation.force, "{law:?}");
        } else {
            assert_eq!(approach.force, 0.0, "{law:?} pulls before touch");
        }
        if fresh.is_empty() {
            assert_eq!(approach, separation, "{law:?}");
        }
    }

    fn lanes_give_the_bits_of_the_plain_number(&self, draw: &mut Draw) {
        let law = self.law;
        let pairs: [Pair; LANES] = std::array::from_fn(|_| random_pair_of(&law, draw));
        let lanes = Pair::<Lanes>::from_fn(|lane| pairs[lane]);
        let mut plain = vec![self.virgin(); LANES];
        let mut memory = vec![Lanes::zero(); self.virgin().len()];
        for _ in 0..40 {
            let overlaps: [f64; LANES] =
                std::array::from_fn(
                    |_| {
                        if draw.chance(0.1) { 0.0 } else { self.span * draw.between(-1.3, 1.0) }
                    },
                );
            let answer = law.respond(&NormalMotion::at_rest(&lanes, F64Array(overlaps)), &mut memory[..], 0);
            for lane in 0..LANES {
                let motion = NormalMotion::at_rest(&pairs[lane], overlaps[lane]);
                let one = law.respond(&motion, &mut plain[lane][..], 0);
                let of_lane = [answer.force, answer.potential, answer.dissipated];
                let of_lane = of_lane.iter().chain(&memory).map(|x| x.lane(lane).to_bits());
                let alone = [one.force, one.potential, one.dissipated];
                let alone = alone.iter().chain(&plain[lane]).map(|x| x.to_bits());
                assert!(of_lane.eq(alone), "{law:?}: {one:?}");
            }
        }
    }
}
