//! The restitution coefficient as the papers print it: functions of plasticity `eta`, adhesivity `beta` and
//! velocity.
//!
//! *Squared* coefficients are returned with their sign: a negative square is the energy that is missing for
//! the separation, and S0 (28) / S1 (33) need exactly that signed number (eta = 4, beta = 1: `e_n1^2(1) =
//! -1/3`). Take the root with [`root_or_zero`].

use pulvis_math::elementary;

/// The coefficient that belongs to a signed square: its root, or zero where the pair sticks [-].
#[must_use]
pub fn root_or_zero(squared: f64) -> f64 {
    squared.max(0.0).sqrt()
}

/// Signed `[e_n^(1)]^2` for `chi <= 1`, `f_a = 0`, linear interpolation: S1 (32), S0 (26) [-].
///
/// Written `(1 + beta - beta x)/(1 + beta + x)` with `x = eta chi`; the two printed terms combined.
#[must_use]
pub fn restitution_squared_plastic(eta: f64, beta: f64, chi: f64) -> f64 {
    let x = eta * chi;
    (1.0 + beta - beta * x) / (1.0 + beta + x)
}

/// Signed `[e_n^(2)]^2` for `chi >= 1`, `f_a = 0`: S1 (33), S0 (27); S0 (33b) prints `= 1` for `= -1` [-].
///
/// `1 - eta (1 + beta)/((1 + eta + beta) chi^2)`; it depends on `k2(dp) = kp` only, so on no interpolation.
#[must_use]
pub fn restitution_squared_limit(eta: f64, beta: f64, chi: f64) -> f64 {
    1.0 - eta * (1.0 + beta) / ((1.0 + eta + beta) * chi * chi)
}

/// Restitution coefficient for `f_a = 0` and the linear interpolation at any `chi` [-].
#[must_use]
pub fn restitution(eta: f64, beta: f64, chi: f64) -> f64 {
    root_or_zero(if chi <= 1.0 {
        restitution_squared_plastic(eta, beta, chi)
    } else {
        restitution_squared_limit(eta, beta, chi)
    })
}

/// Scaled overlap `X = delta_max/dp = (sqrt(1 + alpha^2) + alpha)/psi` below the limit, S1 (28a) [-].
#[must_use]
pub fn scaled_overlap(alpha: f64, psi: f64) -> f64 {
    (elementary::hypot(1.0, alpha) + alpha) / psi
}

/// Signed `[e_n^(1)]^2` with `f_a`, for `X = scaled_overlap(alpha, psi) <= 1`: S1 (30) [-].
///
/// `[(1 + beta - beta x)/(1 + beta + x)] psi^2 X^2 - 2 alpha psi X` with `x = eta X`.
#[must_use]
pub fn restitution_squared_plastic_adhesive(eta: f64, beta: f64, alpha: f64, psi: f64) -> f64 {
    let interaction_range = scaled_overlap(alpha, psi);
    let scaled = psi * interaction_range;
    restitution_squared_plastic(eta, beta, interaction_range) * scaled * scaled - 2.0 * alpha * scaled
}

/// Signed `[e_n^(2)]^2` with `f_a`, for `X >= 1`: S1 (31), which does not contain `f_a` [-].
#[must_use]
pub fn restitution_squared_limit_adhesive(eta: f64, beta: f64, psi: f64) -> f64 {
    restitution_squared_limit(eta, beta, psi.recip())
}

/// Signed `[e_n^(1)]^2` for `chi <= 1` with the square-root interpolation, S1 (21) with (D.1) [-].
#[must_use]
pub fn restitution_squared_square_root(eta: f64, beta: f64, chi: f64) -> f64 {
    restitution_squared_plastic(eta, beta, chi.sqrt())
}
