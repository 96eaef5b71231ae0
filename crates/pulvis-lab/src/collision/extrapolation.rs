//! One step of an ordinary differential equation by extrapolation.
//!
//! Gragg's modified midpoint rule has an error in even powers of the substep; polynomial
//! extrapolation to substep zero removes them one after another (W. B. Gragg, SIAM J. Numer. Anal. 2,
//! 384 (1965); R. Bulirsch, J. Stoer, Numer. Math. 8, 1 (1966)). Eight columns give order 16 without
//! a table of coefficients: the branches of contact laws are smooth, so that a few long steps reach
//! round-off, which thousands of low-order steps would spoil.

use pulvis_math::elementary;

/// Columns of the extrapolation.
const COLUMNS: usize = 8;

/// Order of the difference between the last two columns, which steers the step.
const ERROR_ORDER: i32 = 2 * COLUMNS as i32 - 1;

/// Local error allowed, relative to the scales of the problem. Round-off of the extrapolation itself is
/// near 1e-15, and the last column is far better than the difference that is compared with this.
const TOLERANCE: f64 = 5e-14;

/// A state of `N` numbers.
pub(super) type State<const N: usize> = [f64; N];

/// A step that was tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial<const N: usize> {
    /// The state at its end.
    pub end: State<N>,
    /// Its error over the allowed one; at most 1 is good.
    pub error: f64,
}

impl<const N: usize> Trial<N> {
    /// By which factor the next step may be longer, or has to be shorter.
    pub fn factor(&self) -> f64 {
        0.9 * elementary::powf(self.error.max(1e-30), -1.0 / f64::from(ERROR_ORDER)).clamp(0.1, 4.0)
    }
}

/// Tries a step of length `step` from `start`; `scale` says how large each number is.
pub(super) fn try_step<const N: usize>(
    start: &State<N>,
    step: f64,
    scale: &State<N>,
    rate: impl Fn(&State<N>) -> State<N>,
) -> Trial<N> {
    let start_rate = rate(start);
    let substeps = |column: usize| 2.0 * (column as f64 + 1.0);
    let mut table = [[0.0; N]; COLUMNS];
    let mut error = f64::INFINITY;
    for column in 0..COLUMNS {
        let mut entry = midpoint(start, &start_rate, step, 2 * (column + 1), &rate);
        // Neville's scheme, in place: `table[m]` is the row before, of degree m.
        for (degree, slot) in table.iter_mut().enumerate().take(column) {
            let ratio = substeps(column) / substeps(column - degree - 1);
            let weight = 1.0 / (ratio * ratio - 1.0);
            let before = std::mem::replace(slot, entry);
            for n in 0..N {
                entry[n] += (entry[n] - before[n]) * weight;
            }
        }
        table[column] = entry;
        if column + 1 == COLUMNS {
            error = (0..N).fold(0.0, |worst: f64, n| {
                let difference = (entry[n] - table[column - 1][n]).abs();
                // Nothing at all may be off where nothing is expected.
                worst.max(if difference == 0.0 { 0.0 } else { difference / (TOLERANCE * scale[n]) })
            });
        }
    }
    Trial { end: table[COLUMNS - 1], error }
}

/// Gragg's midpoint rule with smoothing, `count` substeps.
fn midpoint<const N: usize>(
    start: &State<N>,
    start_rate: &State<N>,
    step: f64,
    count: usize,
    rate: &impl Fn(&State<N>) -> State<N>,
) -> State<N> {
    let substep = step / count as f64;
    let advanced = |from: &State<N>, rate: &State<N>, by: f64| -> State<N> {
        std::array::from_fn(|n| from[n] + by * rate[n])
    };
    let mut before = *start;
    let mut now = advanced(start, start_rate, substep);
    for _ in 1..count {
        let next = advanced(&before, &rate(&now), 2.0 * substep);
        before = now;
        now = next;
    }
    let last = advanced(&before, &rate(&now), substep);
    std::array::from_fn(|n| 0.5 * (now[n] + last[n]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oscillator_returns_after_a_period_to_round_off() {
        let mut state = [1.0, 0.0];
        let steps = 16;
        for _ in 0..steps {
            let trial =
                try_step(&state, std::f64::consts::TAU / f64::from(steps), &[1.0, 1.0], |s| [s[1], -s[0]]);
            assert!(trial.error < 1.0, "{}", trial.error);
            state = trial.end;
        }
        // 16 steps of an extrapolation that adds a few 1e-16 each.
        assert!((state[0] - 1.0).abs() < 2e-14 && state[1].abs() < 2e-14, "{state:?}");
    }

    #[test]
    fn a_step_that_is_too_long_is_seen() {
        let trial = try_step(&[1.0, 0.0], 12.0, &[1.0, 1.0], |s| [s[1], -s[0]]);
        assert!(trial.error > 1.0 && trial.factor() < 0.9, "{}", trial.error);
    }
}
