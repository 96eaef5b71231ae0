//! Moving the plastic limit out of reach without changing softer contacts, S1 appendix A.

use super::error::{TheoryError, positive};
use super::parameters::{Interpolation, LudingPair, LudingParameters};

/// Limit stiffness `kp'` [N/m] that keeps `k2(D)` when the plasticity depth becomes `phi_f'`: S1 (A.3).
///
/// `kp' = k1 + AB/2 + sqrt((AB/2)^2 + k1 AB)` with `A = (kp - k1)^2/kp`, `B = phi_f'/phi_f`. The text before
/// (A.1) cites Eq. (10) for what is Eq. (9).
#[must_use]
pub fn tuned_limit_stiffness(k1: f64, kp: f64, depth_ratio: f64) -> f64 {
    let excess = kp - k1;
    let half = 0.5 * depth_ratio * excess * (excess / kp);
    k1 + half + (half * (half + 2.0 * k1)).sqrt()
}

impl LudingPair {
    /// The pair with the plasticity depth `phi_f'` [-] whose contacts below the old limit behave as before.
    ///
    /// # Errors
    ///
    /// For another interpolation than the linear one (the appendix rests on S1 (9)), and where `phi_f'` is
    /// not positive.
    pub fn tuned(&self, phi_f: f64) -> Result<Self, TheoryError> {
        if self.p.interpolation != Interpolation::Linear {
            return Err(TheoryError::NotLinearInterpolation);
        }
        positive("phi_f", phi_f)?;
        let kp = tuned_limit_stiffness(self.p.k1, self.p.kp, phi_f / self.p.phi_f);
        Self::new(LudingParameters { phi_f, kp, ..self.p })
    }
}
