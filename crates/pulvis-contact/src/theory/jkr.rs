//! Adhesive elastic spheres: the law of Johnson, Kendall and Roberts.

use std::f64::consts::PI;

use pulvis_math::elementary;

use super::error::{TheoryError, positive};

/// A pair with the force `F = 4 E* a^3/(3 R) - sqrt(8 pi Gamma E* a^3)` at the overlap `delta = a^2/R - sqrt(2 pi Gamma
/// a/E*)`, `a` the radius of the contact area, that attaches at `delta >= 0` and parts at `delta_sep < 0`.
///
/// # Source
///
/// K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. Lond. A 324, 301 (1971).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JkrPair {
    modulus: f64,
    work_of_adhesion: f64,
    radius: f64,
}

impl JkrPair {
    /// A pair with the effective modulus `E*` \[Pa\], the work of adhesion `Gamma` of both surfaces together [J/m^2] and
    /// the effective radius `R = a_i a_j/(a_i + a_j)` \[m\].
    ///
    /// # Errors
    ///
    /// Where any of them is not positive.
    pub fn new(
        effective_modulus: f64,
        work_of_adhesion: f64,
        effective_radius: f64,
    ) -> Result<Self, TheoryError> {
        Ok(Self {
            modulus: positive("effective modulus", effective_modulus)?,
            work_of_adhesion: positive("work of adhesion", work_of_adhesion)?,
            radius: positive("effective radius", effective_radius)?,
        })
    }

    /// Pull-off force under a constant load, `F_c = (3/2) pi Gamma R` \[N\].
    #[must_use]
    pub fn pull_off_force(&self) -> f64 {
        1.5 * PI * self.work_of_adhesion * self.radius
    }

    /// Overlap at which bodies part whose distance is given, `delta_sep = -(3 F_c^2/(16 R E*^2))^(1/3)`, negative \[m\].
    #[must_use]
    pub fn separation_overlap(&self) -> f64 {
        let ratio = self.pull_off_force() / self.modulus;
        -elementary::cbrt(3.0 * ratio * ratio / (16.0 * self.radius))
    }

    /// Force there, `-(5/9) F_c` \[N\].
    #[must_use]
    pub fn separation_force(&self) -> f64 {
        -5.0 / 9.0 * self.pull_off_force()
    }

    /// Radius of the contact area there, `a_sep = (pi Gamma R^2/(8 E*))^(1/3)` \[m\].
    #[must_use]
    pub fn separation_radius(&self) -> f64 {
        let square = self.radius * self.radius;
        elementary::cbrt(PI * self.work_of_adhesion * square / (8.0 * self.modulus))
    }

    /// Radius of the contact area without load, `a_eq = (9 pi Gamma R^2/(2 E*))^(1/3)` \[m\].
    #[must_use]
    pub fn unloaded_radius(&self) -> f64 {
        let square = self.radius * self.radius;
        elementary::cbrt(4.5 * PI * self.work_of_adhesion * square / self.modulus)
    }

    /// Force at the radius `a` \[m\] of the contact area \[N\].
    #[must_use]
    pub fn force(&self, contact_radius: f64) -> f64 {
        let cube = contact_radius * contact_radius * contact_radius;
        4.0 * self.modulus * cube / (3.0 * self.radius)
            - (8.0 * PI * self.work_of_adhesion * self.modulus * cube).sqrt()
    }

    /// Overlap at the radius `a` \[m\] of the contact area \[m\].
    #[must_use]
    pub fn overlap(&self, contact_radius: f64) -> f64 {
        contact_radius * contact_radius / self.radius
            - (2.0 * PI * self.work_of_adhesion * contact_radius / self.modulus).sqrt()
    }

    /// Energy that a pair loses once it has touched and parted: what the force between `delta = 0` and `delta_sep` does
    /// on the way out only, `7.0921959719 (Gamma^5 R^4/E*^2)^(1/3)` \[J\].
    #[must_use]
    pub fn collision_loss(&self) -> f64 {
        // (pi^(5/3)/24) (3.6 * 4^(4/3) + 2.4).
        let coefficient = elementary::cbrt(elementary::powi(PI, 5)) / 24.0
            * (3.6 * elementary::cbrt(elementary::powi(4.0, 4)) + 2.4);
        let adhesion = elementary::powi(self.work_of_adhesion, 5) * elementary::powi(self.radius, 4);
        coefficient * elementary::cbrt(adhesion / (self.modulus * self.modulus))
    }

    /// Tangential force at which a contact under the normal force `P` \[N\] has peeled completely, `T_c = 4 sqrt((P F_c +
    /// F_c^2) G*/E*)`, for the effective shear modulus `G*` \[Pa\] \[N\]. C. Thornton, K. K. Yin, Powder Technol. 65, 153
    /// (1991).
    #[must_use]
    pub fn peeling_force(&self, load: f64, effective_shear_modulus: f64) -> f64 {
        let pull_off = self.pull_off_force();
        4.0 * ((load + pull_off) * pull_off * effective_shear_modulus / self.modulus).sqrt()
    }

    /// Radius of the contact area under the normal force `P` \[N\] and the tangential force `T` \[N\], at most that of
    /// complete peeling, `a^3 = 3 R/(4 E*) (P + 2 F_c + sqrt(4 P F_c + 4 F_c^2 - T^2 E*/(4 G*)))` \[m\]. Source as of
    /// [`peeling_force`](Self::peeling_force).
    #[must_use]
    pub fn sheared_radius(&self, load: f64, tangential_force: f64, effective_shear_modulus: f64) -> f64 {
        let pull_off = self.pull_off_force();
        let sheared = tangential_force * tangential_force * self.modulus / (4.0 * effective_shear_modulus);
        let root = (4.0 * pull_off * (load + pull_off) - sheared).max(0.0).sqrt();
        elementary::cbrt(0.75 * self.radius / self.modulus * (load + 2.0 * pull_off + root))
    }

    /// Velocity `v_s = sqrt(2 W/m_r)` below which bodies of the reduced mass `m_r` \[kg\] stick [m/s].
    #[must_use]
    pub fn sticking_velocity(&self, reduced_mass: f64) -> f64 {
        (2.0 * self.collision_loss() / reduced_mass).sqrt()
    }

    /// Coefficient of restitution `e = sqrt(1 - (v_s/v)^2)` at the velocity `v` [m/s], zero where the bodies stick [-].
    #[must_use]
    pub fn restitution(&self, velocity: f64, reduced_mass: f64) -> f64 {
        let ratio = self.sticking_velocity(reduced_mass) / velocity;
        ((1.0 - ratio) * (1.0 + ratio)).max(0.0).sqrt()
    }
}
