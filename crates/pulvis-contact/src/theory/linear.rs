//! The linear spring and dashpot: the one law whose viscous collision is closed.

use pulvis_math::elementary;
use std::f64::consts::PI;

use super::error::{TheoryError, not_negative, positive};

/// A pair with the force `f = k delta + gamma u`, S1 (2), S0 (3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearSpringDashpot {
    stiffness: f64,
    damping: f64,
    reduced_mass: f64,
}

impl LinearSpringDashpot {
    /// A pair with the stiffness `k` [N/m], the damping `gamma` [kg/s] and the reduced mass `m_r` \[kg\].
    ///
    /// # Errors
    ///
    /// Where stiffness or mass are not positive, or the damping is negative; overdamped pairs are allowed.
    pub fn new(stiffness: f64, damping: f64, reduced_mass: f64) -> Result<Self, TheoryError> {
        Ok(Self {
            stiffness: positive("stiffness", stiffness)?,
            damping: not_negative("damping", damping)?,
            reduced_mass: positive("reduced mass", reduced_mass)?,
        })
    }

    /// The pair with the coefficient of restitution `e` [-], the stiffness `k` [N/m] and the reduced mass
    /// `m_r` \[kg\]: `gamma = -2 ln e sqrt(k m_r/(pi^2 + ln^2 e))`.
    ///
    /// # Errors
    ///
    /// For `e` outside (0, 1] and for stiffness or mass that are not positive.
    pub fn from_restitution(
        restitution: f64,
        stiffness: f64,
        reduced_mass: f64,
    ) -> Result<Self, TheoryError> {
        let logarithm = logarithm_of(restitution)?;
        positive("stiffness", stiffness)?;
        positive("reduced mass", reduced_mass)?;
        let damping = 2.0 * logarithm * (stiffness * reduced_mass).sqrt() / elementary::hypot(PI, logarithm);
        Self::new(stiffness, damping, reduced_mass)
    }

    /// The pair with the contact duration `t_c` \[s\], the restitution `e` [-] and the reduced mass `m_r`
    /// \[kg\]: `gamma = -2 m_r ln e/t_c`, `k = m_r (pi^2 + ln^2 e)/t_c^2`.
    ///
    /// # Errors
    ///
    /// For `e` outside (0, 1] and for duration or mass that are not positive.
    pub fn from_duration(duration: f64, restitution: f64, reduced_mass: f64) -> Result<Self, TheoryError> {
        let logarithm = logarithm_of(restitution)?;
        positive("contact duration", duration)?;
        positive("reduced mass", reduced_mass)?;
        let frequency = elementary::hypot(PI, logarithm) / duration;
        Self::new(
            reduced_mass * frequency * frequency,
            2.0 * reduced_mass * logarithm / duration,
            reduced_mass,
        )
    }

    /// Stiffness `k` [N/m].
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Damping `gamma` [kg/s].
    #[must_use]
    pub fn damping(&self) -> f64 {
        self.damping
    }

    /// Reduced mass `m_r` \[kg\].
    #[must_use]
    pub fn reduced_mass(&self) -> f64 {
        self.reduced_mass
    }

    /// Decay rate `h = gamma/(2 m_r)` [1/s].
    #[must_use]
    pub fn decay_rate(&self) -> f64 {
        0.5 * self.damping / self.reduced_mass
    }

    /// Frequency without damping, `w_0 = sqrt(k/m_r)` [1/s].
    #[must_use]
    pub fn natural_frequency(&self) -> f64 {
        (self.stiffness / self.reduced_mass).sqrt()
    }

    /// Frequency `w = sqrt(w_0^2 - h^2)`; zero where the pair is overdamped [1/s].
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.frequency_squared().max(0.0).sqrt()
    }

    /// `w_0^2 - h^2` as a product, accurate close to critical damping; negative where overdamped.
    fn frequency_squared(&self) -> f64 {
        let (h, w0) = (self.decay_rate(), self.natural_frequency());
        (w0 - h) * (w0 + h)
    }

    /// Contact duration `t_c = pi/w`, S1 (3); infinite where the pair is overdamped and never opens \[s\].
    #[must_use]
    pub fn contact_duration(&self) -> f64 {
        PI / self.frequency()
    }

    /// Coefficient of restitution `e = exp(-pi h/w)`, S1 (4); zero where overdamped [-].
    #[must_use]
    pub fn restitution(&self) -> f64 {
        elementary::exp(-self.decay_rate() * self.contact_duration())
    }

    /// Time to the largest overlap, `atan(w/h)/w`; overdamped `atanh(w'/h)/w'` with `w'^2 = h^2 - w_0^2`
    /// \[s\].
    #[must_use]
    pub fn loading_duration(&self) -> f64 {
        let h = self.decay_rate();
        let squared = self.frequency_squared();
        let w = squared.abs().sqrt();
        if w < 1e-8 * h {
            // Both forms are 1/h (1 + O(w^2/h^2)) here.
            h.recip()
        } else if squared > 0.0 {
            elementary::atan2(w, h) / w
        } else {
            // atanh(w/h) = asinh(w/w_0) for h^2 = w_0^2 + w^2: no pole at large damping.
            elementary::asinh(w / self.natural_frequency()) / w
        }
    }

    /// Largest overlap for the impact velocity `v` [m/s]: `(v/w_0) exp(-(h/w) atan(w/h))` \[m\].
    #[must_use]
    pub fn overlap_max(&self, velocity: f64) -> f64 {
        velocity / self.natural_frequency() * elementary::exp(-self.decay_rate() * self.loading_duration())
    }

    /// Duration of a contact that ends where the force vanishes instead of where the overlap does.
    ///
    /// `2 atan(w/h)/w`: twice the loading time, because the force is the same function of time as the
    /// overlap, shifted in phase. This is what a law without attraction does, and it holds for overdamped
    /// pairs too \[s\].
    #[must_use]
    pub fn duration_to_zero_force(&self) -> f64 {
        2.0 * self.loading_duration()
    }

    /// Restitution of a contact that ends at zero force: `e = exp(-2 (h/w) atan(w/h))`; `exp(-2)` at critical
    /// damping [-].
    #[must_use]
    pub fn restitution_to_zero_force(&self) -> f64 {
        elementary::exp(-self.decay_rate() * self.duration_to_zero_force())
    }

    /// Overlap that is left where the force vanishes, for the impact velocity `v` [m/s]: `gamma e v/k` \[m\].
    #[must_use]
    pub fn overlap_at_zero_force(&self, velocity: f64) -> f64 {
        self.damping / self.stiffness * self.restitution_to_zero_force() * velocity
    }
}

/// `-ln e` for a coefficient in (0, 1].
fn logarithm_of(restitution: f64) -> Result<f64, TheoryError> {
    if restitution > 0.0 && restitution <= 1.0 {
        Ok(-elementary::ln(restitution))
    } else {
        Err(TheoryError::RestitutionOutOfRange { value: restitution })
    }
}
