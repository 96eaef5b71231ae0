//! The Edinburgh elasto-plastic adhesive law.

use pulvis_math::elementary::powf;

/// Coefficient of restitution of bodies that do not adhere, with the plasticity `lambda_p` and the exponent `n` [-]: the
/// same at any speed.
///
/// `e^2 = (1 - L^(n+1) - (n+1) lambda_p (1 - L))/(1 - lambda_p)` with `L = lambda_p^(1/n)`: the area under the unloading
/// curve over that under loading. Derived from Thakur et al., Granular Matter 16, 383 (2014).
#[must_use]
pub fn restitution_without_adhesion(lambda_p: f64, exponent: f64) -> f64 {
    let share = powf(lambda_p, 1.0 / exponent);
    let returned = 1.0 - powf(share, exponent + 1.0) - (exponent + 1.0) * lambda_p * (1.0 - share);
    (returned / (1.0 - lambda_p)).max(0.0).sqrt()
}
