//! The piece-wise linear law with a pull-off force of its own, as reconstructed after Walton and Johnson.

use super::error::{TheoryError, not_negative, positive};

/// A pair that loads along `k1`, unloads along `k2` down to the pull-off force `f_po = f_0 + kappa k1 D` of its largest
/// overlap `D`, and from there along a tail of the slope `-k_tail` to zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaltonJohnsonPair {
    k1: f64,
    k2: f64,
    constant_pull_off: f64,
    kappa: f64,
    k_tail: f64,
    reduced_mass: f64,
}

impl WaltonJohnsonPair {
    /// A pair with the stiffnesses `[k1, k2, k_tail]` [N/m], the pull-off force `f_0` \[N\] of a first touch, its growth
    /// `kappa` with the load [-], and the reduced mass `m_r` \[kg\].
    ///
    /// # Errors
    ///
    /// Where a stiffness or the mass are not positive, `f_0` or `kappa` are negative, or `k2 < k1`.
    pub fn new(
        [k1, k2, k_tail]: [f64; 3],
        constant_pull_off: f64,
        kappa: f64,
        reduced_mass: f64,
    ) -> Result<Self, TheoryError> {
        if k2 < k1 {
            return Err(TheoryError::SofterUnloading { k1, kp: k2 });
        }
        Ok(Self {
            k1: positive("loading stiffness", k1)?,
            k2: positive("unloading stiffness", k2)?,
            constant_pull_off: not_negative("pull-off force", constant_pull_off)?,
            kappa: not_negative("kappa", kappa)?,
            k_tail: positive("slope of the tail", k_tail)?,
            reduced_mass: positive("reduced mass", reduced_mass)?,
        })
    }

    /// Largest overlap of a collision with the velocity `v` [m/s], `v sqrt(m_r/k1)` \[m\].
    #[must_use]
    pub fn overlap_max(&self, velocity: f64) -> f64 {
        velocity * (self.reduced_mass / self.k1).sqrt()
    }

    /// Pull-off force after the largest overlap `D` \[m\] \[N\].
    #[must_use]
    pub fn pull_off_force(&self, overlap_max: f64) -> f64 {
        self.constant_pull_off + self.kappa * self.k1 * overlap_max
    }

    /// Overlap at which the tail ends, `(1 - k1/k2) D - f_po (1/k2 + 1/k_tail)`, which may be negative \[m\].
    #[must_use]
    pub fn end_overlap(&self, overlap_max: f64) -> f64 {
        (1.0 - self.k1 / self.k2) * overlap_max
            - self.pull_off_force(overlap_max) * (1.0 / self.k2 + 1.0 / self.k_tail)
    }

    /// Coefficient of restitution at the velocity `v` [m/s], from `E_f = (k1 D)^2/(2 k2) - (f_po^2/2)(1/k2 + 1/k_tail)`;
    /// zero where the bodies stick [-].
    #[must_use]
    pub fn restitution(&self, velocity: f64) -> f64 {
        let overlap = self.overlap_max(velocity);
        let (load, pull) = (self.k1 * overlap, self.pull_off_force(overlap));
        let left = load * load / self.k2 - pull * pull * (1.0 / self.k2 + 1.0 / self.k_tail);
        (left / (self.reduced_mass * velocity * velocity)).max(0.0).sqrt()
    }
}
