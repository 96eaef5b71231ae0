//! The pair of particles that the closed forms speak about.

use super::error::{TheoryError, not_negative, positive};

/// How the unloading stiffness `k2` depends on the remembered overlap `D`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// `k2 = k1 (1 + eta D/dp)`, S1 (9).
    Linear,
    /// `k2 = k1 (1 + eta sqrt(D/dp))`, S1 (D.1), S0 (41).
    SquareRoot,
    /// `k2 = kp` always, S0 (7): the model of Walton and Braun, which knows no plastic limit.
    Constant,
}

/// What the adhesive force `f_a` does while the particles are apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NonContact {
    /// No adhesive force at all.
    None,
    /// Attracts on approach and on separation, S1 (14).
    Reversible,
    /// Attracts only after the first touch ("jump-in"), S1 (15).
    JumpIn,
}

/// Constants of one pair, not yet checked; [`LudingPair::new`] checks them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LudingParameters {
    /// Loading (plastic) stiffness `k1`, positive [N/m].
    pub k1: f64,
    /// Limit stiffness `kp`, not below `k1` [N/m].
    pub kp: f64,
    /// Cohesive stiffness `kc` of the tensile branch, not negative [N/m].
    pub kc: f64,
    /// Plasticity depth `phi_f`, S1 (11); without effect for [`Interpolation::Constant`] and for `kp = k1`
    /// [-].
    pub phi_f: f64,
    /// Reduced mass `m_r = m1 m2/(m1 + m2)`, at a wall the mass of the particle \[kg\].
    pub reduced_mass: f64,
    /// Harmonic mean radius `a12 = 2 a1 a2/(a1 + a2)`, at a wall `2 a` (the papers' "reduced radius") \[m\].
    pub harmonic_radius: f64,
    /// How `k2` interpolates between `k1` and `kp`.
    pub interpolation: Interpolation,
    /// Constant adhesive force `f_a` \[N\].
    pub adhesion_force: f64,
    /// What `f_a` does out of contact.
    pub noncontact: NonContact,
    /// Slope `k_c^a` of the non-contact branch; infinite for zero range [N/m].
    pub noncontact_stiffness: f64,
}

impl LudingParameters {
    /// Parameters of a pair without adhesive force and with the linear interpolation.
    #[must_use]
    pub fn new(k1: f64, kp: f64, kc: f64, phi_f: f64, reduced_mass: f64, harmonic_radius: f64) -> Self {
        Self {
            k1,
            kp,
            kc,
            phi_f,
            reduced_mass,
            harmonic_radius,
            interpolation: Interpolation::Linear,
            adhesion_force: 0.0,
            noncontact: NonContact::None,
            noncontact_stiffness: f64::INFINITY,
        }
    }

    /// The same parameters with another interpolation of `k2`.
    #[must_use]
    pub fn with_interpolation(self, interpolation: Interpolation) -> Self {
        Self { interpolation, ..self }
    }

    /// The same parameters with an adhesive force `f_a` \[N\] and the slope `k_c^a` [N/m] of its non-contact
    /// branch.
    #[must_use]
    pub fn with_adhesion(
        self,
        noncontact: NonContact,
        adhesion_force: f64,
        noncontact_stiffness: f64,
    ) -> Self {
        Self { noncontact, adhesion_force, noncontact_stiffness, ..self }
    }
}

/// A checked pair; the methods are the closed forms of S0 and S1 for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LudingPair {
    pub(super) p: LudingParameters,
}

impl LudingPair {
    /// Checks the parameters.
    ///
    /// # Errors
    ///
    /// Where a stiffness, mass, radius or depth is not positive and finite (`kc`, `f_a`: not negative;
    /// `k_c^a` may be infinite), where `kp < k1`, and where `f_a > 0` comes with [`NonContact::None`].
    pub fn new(parameters: LudingParameters) -> Result<Self, TheoryError> {
        let p = parameters;
        positive("k1", p.k1)?;
        positive("kp", p.kp)?;
        not_negative("kc", p.kc)?;
        positive("phi_f", p.phi_f)?;
        positive("reduced mass", p.reduced_mass)?;
        positive("harmonic mean radius", p.harmonic_radius)?;
        not_negative("adhesive force f_a", p.adhesion_force)?;
        if p.noncontact_stiffness != f64::INFINITY {
            positive("non-contact stiffness k_c^a", p.noncontact_stiffness)?;
        }
        if p.kp < p.k1 {
            return Err(TheoryError::SofterUnloading { k1: p.k1, kp: p.kp });
        }
        if p.noncontact == NonContact::None && p.adhesion_force > 0.0 {
            return Err(TheoryError::AdhesionWithoutRule { adhesion_force: p.adhesion_force });
        }
        Ok(Self { p })
    }

    /// The constants this pair was made of.
    #[must_use]
    pub fn parameters(&self) -> &LudingParameters {
        &self.p
    }

    /// Plasticity `eta = (kp - k1)/k1`, S1 (27a), S0 (24a); the text of S0 4.4 and S1 App. C prints `kp/k1`
    /// [-].
    #[must_use]
    pub fn eta(&self) -> f64 {
        (self.p.kp - self.p.k1) / self.p.k1
    }

    /// Contact adhesivity `beta = kc/k1`, S1 (27b) [-].
    #[must_use]
    pub fn beta(&self) -> f64 {
        self.p.kc / self.p.k1
    }

    /// Non-contact adhesivity `alpha = f_a/sqrt(k1 m_r v_i^2)` at the touch velocity `v_i` [m/s], S1 (27c)
    /// [-].
    #[must_use]
    pub fn alpha(&self, touch_velocity: f64) -> f64 {
        self.p.adhesion_force / ((self.p.k1 * self.p.reduced_mass).sqrt() * touch_velocity)
    }

    /// Inverse impact velocity `psi = sqrt(E_p/E_i) = v_p0/v_i`, S1 (27d) [-].
    #[must_use]
    pub fn psi(&self, touch_velocity: f64) -> f64 {
        self.v_p0() / touch_velocity
    }

    /// Impact velocity `chi = v_i/v_p0`; equals `delta_max/dp` only for `f_a = 0` and `chi <= 1`.
    ///
    /// S0 (24c) prints `chi = dp/dp`. Zero where there is no plastic limit [-].
    #[must_use]
    pub fn chi(&self, touch_velocity: f64) -> f64 {
        touch_velocity / self.v_p0()
    }

    /// Impact velocity `zeta = v_i/v_p` with `f_a` in `v_p`, S1 (28b); `None` where every contact reaches the
    /// limit branch (see [`Self::v_p`]) [-].
    #[must_use]
    pub fn zeta(&self, touch_velocity: f64) -> Option<f64> {
        self.v_p().map(|v_p| touch_velocity / v_p)
    }

    /// Scaled maximal overlap `delta_max/dp = (sqrt(1 + alpha^2) + alpha)/psi` below the limit, S1 (28a) [-].
    #[must_use]
    pub fn scaled_overlap(&self, touch_velocity: f64) -> f64 {
        self.loading_overlap(touch_velocity) / self.dp()
    }

    /// Force-free overlap on the limit branch, `phi_f a12`, S1 (11) \[m\].
    #[must_use]
    pub fn limit_force_free_overlap(&self) -> f64 {
        self.p.phi_f * self.p.harmonic_radius
    }

    /// Plastic limit overlap `dp = kp/(kp - k1) phi_f a12`, S1 (10).
    ///
    /// Infinite for `kp = k1` (elastic) and for [`Interpolation::Constant`] (never limited) \[m\].
    #[must_use]
    pub fn dp(&self) -> f64 {
        if self.p.interpolation == Interpolation::Constant || self.p.kp == self.p.k1 {
            f64::INFINITY
        } else {
            self.p.kp / (self.p.kp - self.p.k1) * self.limit_force_free_overlap()
        }
    }

    /// Overlap at which the non-contact branch begins, `delta_a = -f_a/k_c^a <= 0`, S1 (14).
    ///
    /// S1 also writes `delta_a^(1)`, `delta_a^(2)` for *positive* overlaps, which are unrelated \[m\].
    #[must_use]
    pub fn noncontact_overlap(&self) -> f64 {
        if self.p.adhesion_force == 0.0 { 0.0 } else { -self.p.adhesion_force / self.p.noncontact_stiffness }
    }

    /// Depth of the non-contact well, `f_a^2/(2 k_c^a)` \[J\].
    #[must_use]
    pub fn noncontact_energy(&self) -> f64 {
        0.5 * self.p.adhesion_force * -self.noncontact_overlap()
    }
}
