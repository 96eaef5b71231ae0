//! Straight lines of the force law: stiffness, force-free overlap, tensile extremum, loop area.

use super::parameters::{Interpolation, LudingPair};
use pulvis_math::elementary;

impl LudingPair {
    /// Excess `s = (k2(D) - k1)/k1` of the unloading stiffness after the history overlap `D` \[m\].
    ///
    /// Linear: `s = eta D/dp`, written without `dp` so that `kp = k1` needs no division by zero [-].
    #[must_use]
    pub fn stiffness_excess(&self, history: f64) -> f64 {
        let eta = self.eta();
        if self.p.interpolation == Interpolation::Constant || eta == 0.0 {
            return eta;
        }
        let scaled = (history / self.dp()).clamp(0.0, 1.0);
        match self.p.interpolation {
            Interpolation::SquareRoot => eta * scaled.sqrt(),
            Interpolation::Linear | Interpolation::Constant => eta * scaled,
        }
    }

    /// Unloading stiffness after the history overlap `D` \[m\]: S1 (9), (D.1), S0 (7) [N/m].
    #[must_use]
    pub fn k2(&self, history: f64) -> f64 {
        // Above the limit the constant itself, so that k2(dp) = kp holds without round-off.
        if self.p.interpolation == Interpolation::Constant || history >= self.dp() {
            return self.p.kp;
        }
        self.p.k1 * (1.0 + self.stiffness_excess(history))
    }

    /// Force-free overlap `delta_0(D) = (1 - k1/k2) D` of the unloading branch without `f_a`, S1 (7) \[m\].
    #[must_use]
    pub fn delta_0(&self, history: f64) -> f64 {
        let s = self.stiffness_excess(history);
        s / (1.0 + s) * history
    }

    /// Overlap of the largest tension, `delta_min(D) = (k2 - k1)/(k2 + kc) D`, S1 after (20d) \[m\].
    #[must_use]
    pub fn delta_min(&self, history: f64) -> f64 {
        let s = self.stiffness_excess(history);
        s / (1.0 + self.beta() + s) * history
    }

    /// Hysteretic force at the tensile extremum, `-kc delta_min(D)` (without `f_a`) \[N\].
    #[must_use]
    pub fn pull_off_force(&self, history: f64) -> f64 {
        -self.p.kc * self.delta_min(history)
    }

    /// History overlap `D` whose unloading branch passes through the point `(delta, -kc delta)`.
    ///
    /// The inverse of [`Self::delta_min`], which a contact needs that turns round on the tensile branch.
    /// Linear: root of a square, square root: the positive root of `z^3 - y z - y (1 + beta)/eta = 0` with `z
    /// = sqrt(D/dp)`, `y = delta/dp`, by Cardano and one Newton step. `None` without tensile branch (`kp =
    /// k1`) \[m\].
    #[must_use]
    pub fn history_on_tensile_branch(&self, overlap: f64) -> Option<f64> {
        let eta = self.eta();
        if eta == 0.0 {
            return None;
        }
        if overlap <= 0.0 {
            return Some(0.0);
        }
        let c = (1.0 + self.beta()) / eta;
        let y = overlap / self.dp();
        Some(match self.p.interpolation {
            Interpolation::Constant => overlap * (1.0 + c),
            Interpolation::Linear => 0.5 * self.dp() * (y + (y * (y + 4.0 * c)).sqrt()),
            Interpolation::SquareRoot => self.dp() * elementary::powi(depressed_cubic_root(y, y * c), 2),
        })
    }

    /// Share `q(s) = s (1 + beta)/(1 + beta + s)` of `(1/2) k1 D^2` that one loop dissipates [-].
    pub(super) fn loop_share(&self, excess: f64) -> f64 {
        let one_plus_beta = 1.0 + self.beta();
        // Divided by (1 + beta) so that a huge beta does not overflow into inf/inf.
        excess / (1.0 + excess / one_plus_beta)
    }

    /// Area of one full loop, `W = (1/2) delta_0 (k1 D + kc delta_min)`, independent of `f_a` \[J\].
    ///
    /// Evaluated as `(1/2) k1 D^2 q(s)`, the same thing in one product.
    #[must_use]
    pub fn loop_area(&self, history: f64) -> f64 {
        0.5 * self.p.k1 * history * history * self.loop_share(self.stiffness_excess(history))
    }
}

/// The positive root of `z^3 - p z - q = 0` for `p, q > 0`.
fn depressed_cubic_root(p: f64, q: f64) -> f64 {
    let half = 0.5 * q;
    let third = p / 3.0;
    let discriminant = half * half - third * third * third;
    let z = if discriminant >= 0.0 {
        let u = elementary::cbrt(half + discriminant.sqrt());
        // The textbook's second cube root is third/u; taking it from there avoids a difference of near
        // equals.
        u + third / u
    } else {
        let cosine = (half / (third * third.sqrt())).min(1.0);
        2.0 * third.sqrt() * elementary::cos(elementary::acos(cosine) / 3.0)
    };
    let slope = 3.0 * z * z - p;
    if slope > 0.0 { z - (z * z * z - p * z - q) / slope } else { z }
}
