//! Where pairs stick, and where they come to rest, for `f_a = 0` and the linear interpolation.
//!
//! [`super::LudingPair::restitution`] gives the stop overlap for every parameter set; the functions here are
//! the printed formulas in `eta`, `beta`, `chi`. The papers' sticking overlaps (S1 (35)-(39), S0 (31)-(37))
//! assume that the pair stops on the tensile branch. That holds for `beta (x - 1) <= 1 + x` with `x = eta
//! min(chi, 1)` below the limit; a strongly cohesive pair (`beta > 1`, `x > (1 + beta)/(beta - 1)`) stops
//! earlier, on the branch of slope `k2`. Example: eta = 4, beta = 3, chi = 1: S1 (39) gives 0.577 dp, beyond
//! the tensile extremum 0.5 dp; the pair stops at 0.6 dp.

use super::dimensionless::{restitution_squared_limit, restitution_squared_plastic};
use pulvis_math::elementary;

/// Onset `chi_c^(b) = (1 + beta)/(beta eta)` of the high-velocity sticking, S1 (34), S0 (30): the printed
/// root of a square reduces to this. Meaningful where it is at most 1; infinite for `beta = 0` [-].
#[must_use]
pub fn chi_onset(eta: f64, beta: f64) -> f64 {
    (1.0 + beta) / (beta * eta)
}

/// End `chi_c^(c) = sqrt(eta (1 + beta)/(1 + eta + beta))` of the high-velocity sticking, S1 (37), S0 (33).
///
/// Meaningful where it is at least 1, that is for `beta >= beta*` [-].
#[must_use]
pub fn chi_end(eta: f64, beta: f64) -> f64 {
    (eta * (1.0 + beta) / (1.0 + eta + beta)).sqrt()
}

/// Interval `[chi_b, chi_c]` in which the pair sticks; `None` for `beta < beta*` [-].
#[must_use]
pub fn sticking_interval(eta: f64, beta: f64) -> Option<(f64, f64)> {
    let onset = chi_onset(eta, beta);
    (onset <= 1.0).then(|| (onset, chi_end(eta, beta).max(1.0)))
}

/// Smallest adhesivity with sticking, `beta* = 1/(eta - 1)`, S1 (40b), S0 (37); `None` for `eta <= 1` [-].
#[must_use]
pub fn critical_adhesivity(eta: f64) -> Option<f64> {
    (eta > 1.0).then(|| (eta - 1.0).recip())
}

/// Whether a pair that sticks at `chi` stops on the tensile branch, so that S1 (35)-(39) apply.
///
/// Above the limit: `chi^2 >= q - beta (delta_min^p/dp)^2` with `q = eta (1 + beta)/(1 + eta + beta)`.
#[must_use]
pub fn stops_on_tensile_branch(eta: f64, beta: f64, chi: f64) -> bool {
    if chi <= 1.0 {
        let x = eta * chi;
        return beta * (x - 1.0) <= 1.0 + x;
    }
    let minimum = eta / (1.0 + eta + beta);
    chi * chi + beta * minimum * minimum >= elementary::powi(chi_end(eta, beta), 2)
}

/// Overlap `delta_c/dp` on the tensile branch, `chi <= 1`: `chi sqrt(-[e_n^(1)]^2/beta)`, S1 (36) [-].
///
/// `None` outside the sticking interval. S0 (31a) prints `kc (delta_min delta_0 - kc delta_c^2/2)/2` on the
/// way to it (dimensionally wrong; it is `- delta_c^2`). Valid only where [`stops_on_tensile_branch`].
#[must_use]
pub fn tensile_stop_plastic(eta: f64, beta: f64, chi: f64) -> Option<f64> {
    let missing = -restitution_squared_plastic(eta, beta, chi);
    (missing >= 0.0 && beta > 0.0).then(|| chi * (missing / beta).sqrt())
}

/// Overlap `delta_c/dp` on the tensile branch, `chi >= 1`: `chi sqrt(-[e_n^(2)]^2/beta)`, S1 (38) [-].
///
/// `None` outside the sticking interval. Valid only where [`stops_on_tensile_branch`].
#[must_use]
pub fn tensile_stop_limit(eta: f64, beta: f64, chi: f64) -> Option<f64> {
    let missing = -restitution_squared_limit(eta, beta, chi);
    (missing >= 0.0 && beta > 0.0).then(|| chi * (missing / beta).sqrt())
}

/// Overlap `delta/dp` at which a strongly cohesive pair stops on the branch of slope `k2`.
///
/// Not in the papers: `delta_0 - sqrt(2 E_0/k2)`; for `chi <= 1` the mirror image `chi (x - 1)/(x + 1)` of
/// `delta_max` [-].
#[must_use]
pub fn unloading_stop(eta: f64, chi: f64) -> f64 {
    if chi <= 1.0 {
        let x = eta * chi;
        return chi * (x - 1.0) / (x + 1.0);
    }
    let softness = (1.0 + eta).recip();
    eta * softness - (softness * (softness + (chi - 1.0) * (chi + 1.0))).sqrt()
}

/// Overlap `delta/dp` at which a sticking pair stops, whatever the branch; `None` where it separates [-].
#[must_use]
pub fn sticking_overlap(eta: f64, beta: f64, chi: f64) -> Option<f64> {
    let tensile =
        if chi <= 1.0 { tensile_stop_plastic(eta, beta, chi) } else { tensile_stop_limit(eta, beta, chi) };
    tensile.map(
        |overlap| {
            if stops_on_tensile_branch(eta, beta, chi) { overlap } else { unloading_stop(eta, chi) }
        },
    )
}

/// Largest stop overlap over `dp`, reached at `chi = 1`: S1 (39), and its counterpart on the branch `k2` for
/// a strongly cohesive pair. `None` for `beta < beta*` [-].
#[must_use]
pub fn maximum_sticking_overlap(eta: f64, beta: f64) -> Option<f64> {
    sticking_overlap(eta, beta, 1.0)
}
