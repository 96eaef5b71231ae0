//! Paths of many turns.

use pulvis_contact::{NormalLaw, NormalResponse};

use super::{Bench, columns};
use crate::draw::Draw;

/// Random paths for each set of parameters: with three hundred sets ten thousand paths a law.
const PATHS: u32 = 34;
/// One of so many paths is gone once more in small steps.
const IN_STEPS: u32 = 6;

/// A contact on a path and what it has lost.
struct Walk<N: NormalLaw> {
    memory: N::Memory<f64>,
    plastic: f64,
    adhesive: f64,
    thermal: f64,
}

impl<N: NormalLaw> Walk<N> {
    fn new() -> Self {
        Self { memory: <N::Memory<f64>>::default(), plastic: 0.0, adhesive: 0.0, thermal: 0.0 }
    }

    fn step(&mut self, bench: &Bench<N>, overlap: f64) -> NormalResponse {
        let answer = bench.respond(overlap, &mut self.memory);
        self.plastic += answer.dissipated_plastic;
        self.adhesive += answer.dissipated_adhesive;
        self.thermal += answer.dissipated_thermal;
        answer
    }
}

/// Whatever way the overlap goes from apart to apart, in whatever steps, it costs work: all that is done is stored or
/// lost (see `energy`), nothing is left of what was stored, and no loss is negative.
pub(super) fn no_path_creates_energy<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    for path in 0..PATHS {
        let in_steps = N::PATH_ONLY && path % IN_STEPS == 0;
        let legs = 12 + (draw.unit() * 28.0) as u32;
        let (mut once, mut often) = (Walk::<N>::new(), Walk::<N>::new());
        let apart = -1.2 * bench.range - 0.1 * bench.span;
        let mut overlap = apart;
        for leg in 1..=legs {
            let target = match draw.unit() {
                _ if leg == legs => apart,
                share if share < 0.1 => apart,
                share if share < 0.4 => bench.span * draw.log_between(1e-3, 1.0),
                _ => bench.random_overlap(draw),
            };
            let answer = once.step(bench, target);
            gains_nothing(bench, &answer, target);
            if in_steps {
                let steps = 1 + (draw.unit() * 30.0) as u32;
                for step in 1..steps {
                    let share = f64::from(step) / f64::from(steps);
                    gains_nothing(bench, &often.step(bench, overlap + (target - overlap) * share), target);
                }
                often.step(bench, target);
                agree(bench, &once, &often, f64::from(leg));
            }
            overlap = target;
        }
        let least = -1e-12 * f64::from(legs) * energy_scale(bench);
        assert!(
            once.plastic + once.adhesive + once.thermal >= least,
            "{:?}: a closed path creates energy",
            bench.law
        );
    }
}

fn energy_scale<N: NormalLaw>(bench: &Bench<N>) -> f64 {
    bench.force * (bench.span + bench.range)
}

fn gains_nothing<N: NormalLaw>(bench: &Bench<N>, answer: &NormalResponse, overlap: f64) {
    let least = -1e-12 * energy_scale(bench);
    let losses = [answer.dissipated_plastic, answer.dissipated_adhesive, answer.stored_energy];
    assert!(losses.iter().all(|loss| *loss >= least), "{:?}: {answer:?} at {overlap} m", bench.law);
}

/// One step a leg or many: the same losses and the same memory, but for round-off.
fn agree<N: NormalLaw>(bench: &Bench<N>, once: &Walk<N>, often: &Walk<N>, legs: f64) {
    let energy = 1e-11 * legs * energy_scale(bench);
    let losses = [(once.plastic, often.plastic), (once.adhesive, often.adhesive)];
    for (one, other) in losses {
        assert!((one - other).abs() <= energy, "{:?}: lost {one} J, in steps {other} J", bench.law);
    }
    for (one, other) in columns(&once.memory).into_iter().zip(columns(&often.memory)) {
        let allowed = 1e-9 * one.abs().max(other.abs());
        assert!((one - other).abs() <= allowed, "{:?}: memory {one}, in steps {other}", bench.law);
    }
}
