//! The latching springs of Walton and Braun, with constant and with growing unloading stiffness.

use std::f64::consts::FRAC_PI_2;

use super::error::{TheoryError, not_negative, positive};

/// A pair that loads along `k1` and unloads along `k2`, which is constant or `k1 (1 + S D)` after the largest overlap
/// `D`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaltonBraunPair {
    k1: f64,
    unloading: Unloading,
    reduced_mass: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Unloading {
    Constant(f64),
    Slope(f64),
}

impl WaltonBraunPair {
    /// A pair with the stiffnesses `k1` and `k2` [N/m] and the reduced mass `m_r` \[kg\].
    ///
    /// # Errors
    ///
    /// Where a stiffness or the mass are not positive, or `k2 < k1`.
    pub fn constant(k1: f64, k2: f64, reduced_mass: f64) -> Result<Self, TheoryError> {
        if k2 < k1 {
            return Err(TheoryError::SofterUnloading { k1, kp: k2 });
        }
        let unloading = Unloading::Constant(positive("unloading stiffness", k2)?);
        Self::new(k1, unloading, reduced_mass)
    }

    /// A pair with the loading stiffness `k1` [N/m], the growth `S` [1/m] of the unloading stiffness and the reduced mass
    /// `m_r` \[kg\].
    ///
    /// # Errors
    ///
    /// Where the stiffness or the mass are not positive, or `S` is negative.
    pub fn variable(k1: f64, slope: f64, reduced_mass: f64) -> Result<Self, TheoryError> {
        Self::new(
            k1,
            Unloading::Slope(not_negative("slope of the unloading stiffness", slope)?),
            reduced_mass,
        )
    }

    fn new(k1: f64, unloading: Unloading, reduced_mass: f64) -> Result<Self, TheoryError> {
        Ok(Self {
            k1: positive("loading stiffness", k1)?,
            unloading,
            reduced_mass: positive("reduced mass", reduced_mass)?,
        })
    }

    /// Largest overlap of a collision with the velocity `v` [m/s], `v sqrt(m_r/k1)` \[m\].
    #[must_use]
    pub fn overlap_max(&self, velocity: f64) -> f64 {
        velocity * (self.reduced_mass / self.k1).sqrt()
    }

    /// Unloading stiffness after a collision with the velocity `v` [m/s] [N/m].
    #[must_use]
    pub fn unloading_stiffness(&self, velocity: f64) -> f64 {
        match self.unloading {
            Unloading::Constant(k2) => k2,
            Unloading::Slope(slope) => self.k1 * (1.0 + slope * self.overlap_max(velocity)),
        }
    }

    /// Overlap at which the force ends, `(1 - k1/k2) D` \[m\].
    #[must_use]
    pub fn force_free_overlap(&self, velocity: f64) -> f64 {
        (1.0 - self.k1 / self.unloading_stiffness(velocity)) * self.overlap_max(velocity)
    }

    /// Coefficient of restitution at the velocity `v` [m/s], `sqrt(k1/k2)` [-].
    #[must_use]
    pub fn restitution(&self, velocity: f64) -> f64 {
        (self.k1 / self.unloading_stiffness(velocity)).sqrt()
    }

    /// Time from touch to the end of the force, `(pi/2) (sqrt(m_r/k1) + sqrt(m_r/k2))` \[s\].
    #[must_use]
    pub fn contact_duration(&self, velocity: f64) -> f64 {
        let time = |stiffness: f64| (self.reduced_mass / stiffness).sqrt();
        FRAC_PI_2 * (time(self.k1) + time(self.unloading_stiffness(velocity)))
    }
}
