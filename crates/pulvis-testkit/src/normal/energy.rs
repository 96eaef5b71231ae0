//! The energy balance of a contact along any path.

use pulvis_contact::NormalLaw;

use super::Bench;
use crate::draw::Draw;

const SWEEPS: usize = 8;
const STEPS: u32 = 1000;

/// A path and what has become of the work that was done along it.
struct Path<'a, N: NormalLaw> {
    bench: &'a Bench<N>,
    memory: N::Memory<f64>,
    overlap: f64,
    force: f64,
    branch: (u8, bool),
    work: f64,
    lost: f64,
    strongest_pull: f64,
}

impl<N: NormalLaw> Path<'_, N> {
    /// The branch at an overlap and whether the contact is closed there: where one of them changes the force may jump.
    fn branch_at(&self, overlap: f64) -> (u8, bool) {
        let mut memory = self.memory;
        let answer = self.bench.respond(overlap, &mut memory);
        (self.bench.law.branch(&self.bench.pair, overlap, &memory).0, answer.in_contact)
    }

    /// Goes to an overlap; where the force may jump on the way, up to the jump and over it in a step of round-off, so
    /// that the trapezoidal rule takes the jump where it is.
    fn go(&mut self, overlap: f64) {
        // A step passes a few branches at the most.
        for _ in 0..6 {
            if !N::JUMPS || self.branch_at(overlap) == self.branch {
                break;
            }
            let (mut near, mut far) = (self.overlap, overlap);
            for _ in 0..60 {
                let middle = 0.5 * (near + far);
                let side = if self.branch_at(middle) == self.branch { &mut near } else { &mut far };
                *side = middle;
            }
            self.step(near);
            self.step(far);
        }
        self.step(overlap);
    }

    fn step(&mut self, overlap: f64) {
        let bench = self.bench;
        let answer = bench.respond(overlap, &mut self.memory);
        let scale = bench.force * (bench.span + bench.range);
        let state = || format!("{:?}: {answer:?}, of {scale} J, at {overlap} m", bench.law);
        self.work += 0.5 * (self.force + answer.force) * (overlap - self.overlap);
        for loss in [answer.dissipated_plastic, answer.dissipated_adhesive, answer.dissipated_thermal] {
            assert!(loss >= -1e-12 * scale || !bench.law.is_passive(), "{}", state());
            self.lost += loss;
        }
        assert!(answer.stored_energy >= 0.0, "{}", state());
        self.strongest_pull = self.strongest_pull.max(-answer.force);
        let error = (self.work - self.lost - answer.stored_energy - answer.adhesive_potential).abs();
        let allowed = self.allowed();
        assert!(error <= allowed, "{error} J are missing, allowed {allowed} J: {}", state());
        (self.overlap, self.force) = (overlap, answer.force);
        self.branch = (bench.law.branch(&bench.pair, overlap, &self.memory).0, answer.in_contact);
    }

    /// What the trapezoidal rule may err [J].
    fn allowed(&self) -> f64 {
        let bench = self.bench;
        let length = bench.span + 1.2 * bench.range;
        let step = length / f64::from(STEPS);
        // By step²/8 times the total variation of the slope. A sweep passes at most four branches, and at its end the
        // slope may jump: five changes of at most twice the stiffness.
        let kinks = 10.0 * bench.max_stiffness * step * step / 8.0;
        // Where a contact breaks, its force may begin like a square root of the distance from there: F √(δ/range) is
        // integrated to within 0.21 F step √(step/range).
        let breaks = if !N::JUMPS || bench.range == 0.0 {
            0.0
        } else {
            0.25 * self.strongest_pull * step * (step / bench.range).sqrt()
        };
        SWEEPS as f64 * (kinks + breaks) + 1e-12 * (bench.force + self.strongest_pull) * length
    }
}

pub(super) fn work_is_stored_or_dissipated<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    let apart = -1.2 * bench.range;
    let mut turning_points: Vec<f64> =
        (0..SWEEPS - 1).map(|_| draw.between(apart, bench.span).max(-0.9 * bench.range)).collect();
    // Twice in a path the bodies part.
    turning_points[SWEEPS / 2] = apart;
    turning_points.push(apart);
    let memory = <N::Memory<f64>>::default();
    let mut path = Path {
        bench,
        memory,
        overlap: apart,
        force: 0.0,
        branch: (0, false),
        work: 0.0,
        lost: 0.0,
        strongest_pull: 0.0,
    };
    let step = (bench.span - apart) / f64::from(STEPS);
    for target in turning_points {
        let start = path.overlap;
        let steps = ((target - start).abs() / step).ceil().max(1.0) as u32;
        for index in 1..steps {
            path.go(start + (target - start) * f64::from(index) / f64::from(steps));
        }
        path.go(target);
    }
    // The cycle is closed: nothing is stored, so the work done is what was lost, never negative.
    let passive = bench.law.is_passive();
    assert!(path.work >= -path.allowed() || !passive, "{:?}: a cycle gives {} J", bench.law, -path.work);
}
