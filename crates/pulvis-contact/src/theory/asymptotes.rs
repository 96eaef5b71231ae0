//! Limits of the restitution coefficient for small and for large velocity, S1 appendices C and D.

/// Low-velocity limit `e = 1 - eta chi/2`, for any `beta`, S1 section 5.1; the next term is of order `chi^2`
/// [-].
#[must_use]
pub fn low_velocity(eta: f64, chi: f64) -> f64 {
    1.0 - 0.5 * eta * chi
}

/// `e = 1/sqrt(1 + eta chi)` without cohesion, `chi <= 1`: exact, S1 (C.1a) [-].
#[must_use]
pub fn cohesionless(eta: f64, chi: f64) -> f64 {
    (1.0 + eta * chi).sqrt().recip()
}

/// The same in the variables of Walton and Braun: `e = 1/sqrt(1 + S v/omega_0)` with `S = (kp - k1)/(k1 dp)`
/// [1/m] and `omega_0 = sqrt(k1/m_r)` [1/s], S1 (C.1c) [-].
#[must_use]
pub fn walton_braun(stiffening: f64, frequency: f64, velocity: f64) -> f64 {
    (1.0 + stiffening * velocity / frequency).sqrt().recip()
}

/// `e = (eta chi)^(-1/2)` for `eta chi >> 1` without cohesion, S1 (C.2) [-].
#[must_use]
pub fn power_law(eta: f64, chi: f64) -> f64 {
    (eta * chi).sqrt().recip()
}

/// `e = sqrt(1/(eta chi) - beta)` for weak cohesion, S1 (C.3), S0 (40); `None` where the root is imaginary.
///
/// Valid for `eta chi >> 1` and `beta << 1`; S1 and S0 ask for `eta chi >> beta` [-].
#[must_use]
pub fn weakly_cohesive(eta: f64, beta: f64, chi: f64) -> Option<f64> {
    let squared = (eta * chi).recip() - beta;
    (squared >= 0.0).then(|| squared.sqrt())
}

/// `e = eta^(-1/2) chi^(-1/4)` for the square-root interpolation, `eta sqrt(chi) >> 1`, small `beta`.
///
/// S1 (D.2), S0 (42) print `eta^(+1/2)` (eta = 50, chi = 1: exact 0.14003, this 0.14142, printed 7.07) [-].
#[must_use]
pub fn power_law_square_root(eta: f64, chi: f64) -> f64 {
    (eta * chi.sqrt()).sqrt().recip()
}

/// Local exponent `d ln e/d ln chi` below the limit with the linear interpolation [-].
///
/// `-(x/2) (1 + beta)^2/((1 + beta - beta x)(1 + beta + x))`, `x = eta chi`. Without cohesion it runs from 0
/// through -1/4 at `x = 1` to -1/2: the "chi^(-1/4)" of S1 Fig. 13 is this crossover, no asymptote.
#[must_use]
pub fn local_exponent(eta: f64, beta: f64, chi: f64) -> f64 {
    let x = eta * chi;
    let b = 1.0 + beta;
    -0.5 * x * b / (b - beta * x) * (b / (b + x))
}

/// Local exponent for the square-root interpolation: half of the linear one at `s = eta sqrt(chi)`; tends to
/// -1/4 without cohesion [-].
#[must_use]
pub fn local_exponent_square_root(eta: f64, beta: f64, chi: f64) -> f64 {
    0.5 * local_exponent(eta, beta, chi.sqrt())
}
