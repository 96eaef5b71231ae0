//! The energy balance of a contact along any path.

use pulvis_contact::NormalLaw;

use super::Bench;
use crate::draw::Draw;

const SWEEPS: usize = 8;
const STEPS: u32 = 1000;

pub(super) fn work_is_stored_or_dissipated<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    let mut turning_points: Vec<f64> = (0..SWEEPS - 1).map(|_| bench.span * draw.between(0.0, 1.0)).collect();
    turning_points.push(0.0);
    let law = bench.law;
    let max_stiffness = law.max_stiffness(&bench.pair);
    let step = bench.span / f64::from(STEPS);
    let scale = bench.force * bench.span;
    // The trapezoidal rule errs by step²/8 times the total variation of the slope. A sweep passes
    // at most four branches, and at its end the slope may jump: five changes of at most 2 max_stiffness.
    let integration = SWEEPS as f64 * 10.0 * max_stiffness * step * step / 8.0;
    let round_off = 1e-12 * scale;

    let mut memory = <N::Memory<f64>>::default();
    let (mut overlap, mut force) = (0.0, 0.0);
    let (mut work, mut lost) = (0.0, 0.0);
    for target in turning_points {
        let steps = ((target - overlap).abs() / step).ceil().max(1.0) as u32;
        let start = overlap;
        for index in 1..=steps {
            let next = if index == steps {
                target
            } else {
                start + (target - start) * f64::from(index) / f64::from(steps)
            };
            let answer = bench.respond(next, &mut memory);
            work += 0.5 * (force + answer.force) * (next - overlap);
            for loss in [answer.dissipated_plastic, answer.dissipated_adhesive] {
                assert!(loss >= -round_off, "{law:?}: loses {loss} J of {scale} J at {next} m");
            }
            assert!(answer.stored_energy >= 0.0, "{law:?}: stores {} J", answer.stored_energy);
            lost += answer.dissipated_plastic + answer.dissipated_adhesive;
            let error = (work - lost - answer.stored_energy).abs();
            assert!(
                error <= integration + round_off,
                "{law:?}: {error} J of {scale} J are missing at {next} m, allowed {integration} J"
            );
            (overlap, force) = (next, answer.force);
        }
    }
    // The cycle is closed: nothing is stored, so the work done is what was lost, never negative.
    assert!(work >= -integration - round_off, "{law:?}: a cycle gives {} J", -work);
}
