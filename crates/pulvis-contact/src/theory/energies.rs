//! The energies of S1 Fig. 15, which the paper shows but does not define.
//!
//! Two pictures: the *potential* energy follows the branch that the contact is on, and jumps where the branch
//! changes; the *available* energy is what the contact would give back if it were unloaded from here along
//! `k2`.

/// Potential energy `k1 delta^2/2` on the loading branch \[J\].
#[must_use]
pub fn loading_potential(k1: f64, overlap: f64) -> f64 {
    0.5 * k1 * overlap * overlap
}

/// Potential energy `f_hys^2/(2 k2)` on the elastic branch; `force` without `f_a` \[J\].
#[must_use]
pub fn unloading_potential(force: f64, k2: f64) -> f64 {
    force * force / (2.0 * k2)
}

/// Potential energy `-kc delta^2/2` on the tensile branch: hence the drop to a negative value at `delta_min`
/// \[J\].
#[must_use]
pub fn tensile_potential(kc: f64, overlap: f64) -> f64 {
    -0.5 * kc * overlap * overlap
}

/// Available energy `f_hys^2/(2 k2(D))`, never negative, with the stiffness `k2` of the *present* history
/// \[J\].
#[must_use]
pub fn available(force: f64, k2: f64) -> f64 {
    force * force / (2.0 * k2)
}
