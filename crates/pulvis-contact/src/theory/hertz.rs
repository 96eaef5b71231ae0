//! Elastic spheres: the law of Hertz, its collision, and the dashpot of Tsuji.

use std::f64::consts::PI;

use pulvis_math::elementary;

use super::error::{TheoryError, positive};

/// Duration of a collision over `delta_max/v`: `(4/5) B(2/5, 1/2)`.
const DURATION: f64 = 2.943_275_184_324_704_7;

/// A pair with the force `F = (4/3) E* sqrt(R) delta^(3/2)`.
///
/// # Source
///
/// H. Hertz, J. reine angew. Math. 92, 156 (1882); L. D. Landau, E. M. Lifshitz, *Theory of Elasticity*, section 9, for
/// the collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzPair {
    modulus: f64,
    radius: f64,
    reduced_mass: f64,
}

impl HertzPair {
    /// A pair with the effective modulus `E*` \[Pa\], the effective radius `R = a_i a_j/(a_i + a_j)` \[m\] and the
    /// reduced mass `m_r` \[kg\].
    ///
    /// # Errors
    ///
    /// Where any of them is not positive.
    pub fn new(
        effective_modulus: f64,
        effective_radius: f64,
        reduced_mass: f64,
    ) -> Result<Self, TheoryError> {
        Ok(Self {
            modulus: positive("effective modulus", effective_modulus)?,
            radius: positive("effective radius", effective_radius)?,
            reduced_mass: positive("reduced mass", reduced_mass)?,
        })
    }

    /// `k_H = (4/3) E* sqrt(R)` [N/m^(3/2)].
    #[must_use]
    pub fn coefficient(&self) -> f64 {
        4.0 / 3.0 * self.modulus * self.radius.sqrt()
    }

    /// Force at an overlap `delta` \[m\], zero for bodies apart \[N\].
    #[must_use]
    pub fn force(&self, overlap: f64) -> f64 {
        self.coefficient() * elementary::powf(overlap.max(0.0), 1.5)
    }

    /// Energy `(2/5) F delta` at an overlap \[m\] \[J\].
    #[must_use]
    pub fn energy(&self, overlap: f64) -> f64 {
        0.4 * self.force(overlap) * overlap.max(0.0)
    }

    /// Radius `a = sqrt(R delta)` of the contact area at an overlap \[m\] \[m\].
    #[must_use]
    pub fn contact_radius(&self, overlap: f64) -> f64 {
        (self.radius * overlap.max(0.0)).sqrt()
    }

    /// Largest overlap of a collision with the velocity `v` [m/s], `(5 m_r v^2/(4 k_H))^(2/5)` \[m\].
    #[must_use]
    pub fn overlap_max(&self, velocity: f64) -> f64 {
        elementary::powf(1.25 * self.reduced_mass * velocity * velocity / self.coefficient(), 0.4)
    }

    /// Largest force of a collision with the velocity `v` [m/s] \[N\].
    #[must_use]
    pub fn force_max(&self, velocity: f64) -> f64 {
        self.force(self.overlap_max(velocity))
    }

    /// Duration of a collision with the velocity `v` [m/s], `t_c = 2.94327518 delta_max/v` \[s\]; infinite at rest.
    #[must_use]
    pub fn contact_duration(&self, velocity: f64) -> f64 {
        DURATION * self.overlap_max(velocity) / velocity
    }
}

/// Coefficient of restitution `e = exp(-pi alpha/sqrt(5 - alpha^2))` of elastic spheres with the dashpot `alpha sqrt(m_r
/// k_H) delta^(1/4)`, at any velocity, where the contact ends with the overlap; zero for `alpha >= sqrt(5)`, where the
/// bodies creep apart for ever [-].
///
/// # Source
///
/// D. Antypov, J. A. Elliott, EPL 94, 50004 (2011).
#[must_use]
pub fn tsuji_restitution(alpha: f64) -> f64 {
    let rest = 5.0 - alpha * alpha;
    if rest > 0.0 { elementary::exp(-PI * alpha / rest.sqrt()) } else { 0.0 }
}

/// The coefficient `alpha = -sqrt(5) ln e/sqrt(pi^2 + ln^2 e)` of the dashpot that gives a restitution `e` [-].
///
/// # Errors
///
/// For `e` outside (0, 1].
pub fn tsuji_coefficient(restitution: f64) -> Result<f64, TheoryError> {
    if restitution > 0.0 && restitution <= 1.0 {
        let logarithm = -elementary::ln(restitution);
        Ok(5.0_f64.sqrt() * logarithm / elementary::hypot(PI, logarithm))
    } else {
        Err(TheoryError::RestitutionOutOfRange { value: restitution })
    }
}

/// `C1 = sqrt(pi) Gamma(3/5)/(5^(2/5) 2^(1/5) Gamma(21/10))`.
const VISCOUS: f64 = 1.153_448_858_1;

impl HertzPair {
    /// Coefficient of restitution of a collision with the velocity `v` [m/s], whose material has the dissipative time `A`
    /// \[s\], to second order: `e = 1 - C1 x + (3/5) C1^2 x^2` with `x = (3 A/2) (k_H/m_r)^(2/5) v^(1/5)`. Good to 1e-5 at
    /// `1 - e` = 0.03, to 6e-3 at 0.24 [-].
    ///
    /// # Source
    ///
    /// T. Schwager, T. Poeschel, Phys. Rev. E 57, 650 (1998); R. Ramirez, T. Poeschel, N. V. Brilliantov, T. Schwager, Phys.
    /// Rev. E 60, 4465 (1999).
    #[must_use]
    pub fn viscous_restitution(&self, dissipative_time: f64, velocity: f64) -> f64 {
        let x = 1.5
            * dissipative_time
            * elementary::powf(self.coefficient() / self.reduced_mass, 0.4)
            * elementary::powf(velocity, 0.2);
        let first = VISCOUS * x;
        1.0 - first + 0.6 * first * first
    }
}
