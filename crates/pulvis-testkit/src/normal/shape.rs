//! The force over the overlap, for one past.

use std::collections::BTreeMap;

use pulvis_contact::NormalLaw;

use super::Bench;
use crate::draw::Draw;

const POINTS: u32 = 600;

pub(super) fn the_force_is_continuous_and_no_steeper_than_stiffest<N: NormalLaw>(
    bench: &Bench<N>,
    draw: &mut Draw,
) {
    let (memory, _) = bench.with_a_past(draw);
    let max_stiffness = bench.law.max_stiffness(&bench.pair);
    let step = 1.3 * bench.span / f64::from(POINTS);
    let mut before = 0.0;
    for point in 0..=POINTS {
        let answer = bench.respond(step * f64::from(point), &mut memory.clone());
        let rise = (answer.force - before).abs();
        // A jump would exceed this; 1e-12 of the force scale is round-off.
        assert!(
            point == 0 || rise <= max_stiffness * step * (1.0 + 1e-9) + 1e-12 * bench.force,
            "{:?}: the force changes by {rise} N over {step} m, point {point}",
            bench.law
        );
        assert!(answer.friction_reference >= 0.0, "{:?}: {answer:?}", bench.law);
        assert!((0.0..=1.0 + 1e-12).contains(&answer.hardening), "{:?}: {answer:?}", bench.law);
        before = answer.force;
    }
}

pub(super) fn a_branch_has_one_name_and_no_kink<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    let (memory, _) = bench.with_a_past(draw);
    let step = 1.3 * bench.span / f64::from(POINTS);
    let at = |point: u32| {
        let overlap = step * f64::from(point);
        let mut after = memory;
        let force = bench.respond(overlap, &mut after).force;
        (
            force,
            bench.law.branch(&bench.pair, overlap, &memory),
            bench.law.branch(&bench.pair, overlap, &after),
        )
    };
    let mut names = BTreeMap::new();
    let points: Vec<_> = (0..=POINTS).map(at).collect();
    for (_, before, after) in &points {
        for (number, name) in [before, after] {
            assert_eq!(*names.entry(*number).or_insert(*name), *name, "{:?}: branch {number}", bench.law);
        }
    }
    for three in points.windows(3) {
        let same = three.iter().all(|point| point.1 == three[0].1);
        let bend = (three[0].0 - 2.0 * three[1].0 + three[2].0).abs();
        // Smooth branches bend little over 1/600 of the range: a kink of a tenth of the steepest slope
        // would show.
        let allowed = 0.1 * bench.law.max_stiffness(&bench.pair) * step;
        assert!(!same || bend <= allowed, "{:?}: a kink inside branch {:?}", bench.law, three[1].1);
    }
}
