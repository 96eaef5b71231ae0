//! Elastic-perfectly plastic spheres without adhesion: the law of Thornton and Ning.

use std::f64::consts::PI;

use pulvis_math::elementary;

use super::error::{TheoryError, positive};

/// A Hertz contact whose pressure is limited to `p_y`.
///
/// # Source
///
/// C. Thornton, Z. Ning, Powder Technol. 99, 154 (1998).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldingPair {
    modulus: f64,
    pressure: f64,
    radius: f64,
    reduced_mass: f64,
}

impl YieldingPair {
    /// A pair with the effective modulus `E*` and the limiting contact pressure `p_y` \[Pa\], the effective radius
    /// `R = a_i a_j/(a_i + a_j)` \[m\] and the reduced mass `m_r` \[kg\].
    ///
    /// # Errors
    ///
    /// Where any of them is not positive.
    pub fn new(
        effective_modulus: f64,
        yield_pressure: f64,
        effective_radius: f64,
        reduced_mass: f64,
    ) -> Result<Self, TheoryError> {
        Ok(Self {
            modulus: positive("effective modulus", effective_modulus)?,
            pressure: positive("yield pressure", yield_pressure)?,
            radius: positive("effective radius", effective_radius)?,
            reduced_mass: positive("reduced mass", reduced_mass)?,
        })
    }

    /// Velocity above which a collision yields, `v_y = (pi/(2 E*))^2 sqrt(8 pi R^3/(15 m_r)) p_y^(5/2)` [m/s].
    #[must_use]
    pub fn yield_velocity(&self) -> f64 {
        let ratio = PI / (2.0 * self.modulus);
        let inertia = 8.0 * PI * elementary::powi(self.radius, 3) / (15.0 * self.reduced_mass);
        ratio * ratio * inertia.sqrt() * elementary::powf(self.pressure, 2.5)
    }

    /// Coefficient of restitution at the velocity `v` [m/s], with `x = v_y/v <= 1`:
    /// `e = sqrt(6 sqrt(3)/5) sqrt(1 - x^2/6) (x/(x + 2 sqrt(6/5 - x^2/5)))^(1/4)`; 1 below the yield velocity [-].
    #[must_use]
    pub fn restitution(&self, velocity: f64) -> f64 {
        let x = (self.yield_velocity() / velocity).min(1.0);
        let square = x * x;
        let ratio = x / (x + 2.0 * (1.2 - square / 5.0).sqrt());
        (1.2 * 3.0_f64.sqrt() * (1.0 - square / 6.0)).sqrt() * elementary::powf(ratio, 0.25)
    }
}
