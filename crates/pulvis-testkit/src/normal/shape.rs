//! The force over the overlap, for one past.

use std::collections::BTreeMap;

use pulvis_contact::NormalLaw;

use super::Bench;
use crate::draw::Draw;

const POINTS: u32 = 600;

impl<N: NormalLaw> Bench<N> {
    /// Points of the force's shape with the past of `memory` [m]: up to 1.3 times the largest overlap, from where on the
    /// slope is bounded. Where a contact breaks with a jump, the slope may grow without bound shortly before.
    fn shape(&self, memory: &N::Memory<f64>) -> (f64, f64) {
        let (mut begins, ends) = (-self.range, 1.3 * self.span);
        if N::JUMPS {
            let acts = |overlap: f64| self.respond(overlap, &mut memory.clone()).in_contact;
            let (mut apart, mut acting) = (begins, ends);
            for _ in 0..60 {
                let middle = 0.5 * (apart + acting);
                if acts(middle) { acting = middle } else { apart = middle }
            }
            begins = acting + 0.2 * self.range.min(ends - acting);
        }
        (begins, (ends - begins) / f64::from(POINTS))
    }
}

pub(super) fn the_force_is_continuous_and_no_steeper_than_max_stiffness<N: NormalLaw>(
    bench: &Bench<N>,
    draw: &mut Draw,
) {
    let (memory, _) = bench.with_a_past(draw);
    let (begins, step) = bench.shape(&memory);
    let mut before: Option<(f64, u8)> = None;
    for point in 0..=POINTS {
        let overlap = begins + step * f64::from(point);
        let mut after = memory;
        let answer = bench.respond(overlap, &mut after);
        let branch = bench.law.branch(&bench.pair, overlap, &after).0;
        if let Some((force, branch_before)) = before {
            let rise = (answer.force - force).abs();
            // A jump would exceed this; 1e-12 of the force scale is round-off.
            let allowed = bench.max_stiffness * step * (1.0 + 1e-9) + 1e-12 * bench.force;
            let may_jump = N::JUMPS && branch_before != branch;
            assert!(
                may_jump || rise <= allowed,
                "{:?}: the force changes by {rise} N over {step} m, allowed {allowed} N, at {overlap} m",
                bench.law
            );
        }
        before = Some((answer.force, branch));
    }
}

pub(super) fn a_branch_has_one_name_and_no_kink<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    let (memory, _) = bench.with_a_past(draw);
    let (begins, step) = bench.shape(&memory);
    let at = |point: u32| {
        let overlap = begins + step * f64::from(point);
        let mut after = memory;
        let answer = bench.respond(overlap, &mut after);
        let branches = [&memory, &after].map(|memory| bench.law.branch(&bench.pair, overlap, memory));
        // Zero is the number of bodies that do not act on each other, as it is after the response. Without a range only
        // bodies in contact do.
        let acts = branches[1].0 != 0;
        let agrees = if bench.range > 0.0 { acts || !answer.in_contact } else { acts == answer.in_contact };
        assert!(agrees, "{:?}: {branches:?} at {overlap} m", bench.law);
        (answer.force, branches)
    };
    let mut names = BTreeMap::new();
    let points: Vec<_> = (0..=POINTS).map(at).collect();
    for (_, branches) in &points {
        for (number, name) in branches {
            assert_eq!(*names.entry(*number).or_insert(*name), *name, "{:?}: branch {number}", bench.law);
        }
    }
    for (index, three) in points.windows(3).enumerate() {
        let same = three.iter().all(|point| point.1[0] == three[0].1[0]);
        let bend = (three[0].0 - 2.0 * three[1].0 + three[2].0).abs();
        // Smooth branches bend little over 1/600 of the range: a kink of a tenth of the steepest slope
        // would show.
        let allowed = 0.1 * bench.max_stiffness * step;
        if same && bend > allowed {
            let middle = begins + step * f64::from(index as u32 + 1);
            let refined = largest_bend(bench, &memory, middle, step);
            let allowed = allowed / f64::from(REFINED);
            assert!(refined <= allowed, "{:?}: a kink inside branch {:?}", bench.law, three[1].1[0]);
        }
    }
}

/// How much finer a bend is looked at that may be a kink: attractions may act over a small part of a step.
const REFINED: u32 = 256;

/// The largest bend of the force within one step on both sides of `middle`, in steps that are finer: that of a smooth
/// branch falls with the square of the step, that of a kink with the step.
fn largest_bend<N: NormalLaw>(bench: &Bench<N>, memory: &N::Memory<f64>, middle: f64, step: f64) -> f64 {
    let fine = step / f64::from(REFINED);
    let forces: Vec<f64> = (0..=2 * REFINED)
        .map(|point| bench.respond(middle - step + fine * f64::from(point), &mut memory.clone()).force)
        .collect();
    forces.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]).abs()).fold(0.0, f64::max)
}
