//! Closed forms of bonds: two bonded spheres that part, and beams of bonded spheres.

use pulvis_math::elementary;

/// Speed at which two bonded bodies must part, from the force-free distance on, to break a bond with a tensile `strength`
/// [N] and a `stiffness` [N/m]: F/√(k m_r) [m/s].
pub fn breaking_speed(strength: f64, stiffness: f64, reduced_mass: f64) -> f64 {
    strength / (stiffness * reduced_mass).sqrt()
}

/// What is left of the speed of two bodies that part when their bond has broken, over the speed before: √(1 − (v_b/v)²);
/// zero where the bond holds [1].
pub fn restitution(speed: f64, breaking_speed: f64) -> f64 {
    let part = breaking_speed / speed;
    if part >= 1.0 { 0.0 } else { (1.0 - part * part).sqrt() }
}

/// A straight beam between the centres of two bodies, after Timoshenko.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Length L [m].
    pub length: f64,
    /// Radius of the round cross-section r [m].
    pub radius: f64,
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio ν [1].
    pub poisson_ratio: f64,
    /// Whether shear deforms it.
    pub shear_deforms: bool,
}

impl Beam {
    /// Area of the cross-section A [m²].
    pub fn area(&self) -> f64 {
        std::f64::consts::PI * self.radius * self.radius
    }

    /// Second moment of the cross-section I [m⁴].
    pub fn second_moment(&self) -> f64 {
        0.25 * self.area() * self.radius * self.radius
    }

    /// Shear modulus G [Pa].
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.young_modulus / (1.0 + self.poisson_ratio)
    }

    /// Shear coefficient κ of a round cross-section, Cowper 1966 [1].
    pub fn shear_coefficient(&self) -> f64 {
        6.0 * (1.0 + self.poisson_ratio) / (7.0 + 6.0 * self.poisson_ratio)
    }

    /// Φ = 12 E I/(κ G A L²), zero where shear does not deform the beam [1].
    pub fn shear_parameter(&self) -> f64 {
        if !self.shear_deforms {
            return 0.0;
        }
        let shear = self.shear_coefficient() * self.shear_modulus() * self.area();
        12.0 * self.young_modulus * self.second_moment() / (shear * self.length * self.length)
    }

    /// Forces and moments on the two ends against displacements u and rotations θ of both, across the beam in one plane:
    /// (F_1, M_1, F_2, M_2) = K (u_1, θ_1, u_2, θ_2). The stiffness matrix of text books, e.g. Przemieniecki 1968,
    /// equation 5.116.
    pub fn bending_matrix(&self) -> [[f64; 4]; 4] {
        let (length, phi) = (self.length, self.shear_parameter());
        let unit = self.young_modulus * self.second_moment() / ((1.0 + phi) * length * length * length);
        let (side, near) = (6.0 * length * unit, (4.0 + phi) * length * length * unit);
        let far = (2.0 - phi) * length * length * unit;
        let across = 12.0 * unit;
        [
            [across, side, -across, side],
            [side, near, -side, far],
            [-across, -side, across, -side],
            [side, far, -side, near],
        ]
    }

    /// Deflection of the free end of a cantilever of this length under a force [N] there [m]:
    /// F L³/(3 E I) + F L/(κ G A).
    pub fn cantilever_deflection(&self, force: f64) -> f64 {
        let cube = self.length * self.length * self.length;
        let bending = force * cube / (3.0 * self.young_modulus * self.second_moment());
        // Φ L²/(12 E I) is 1/(κ G A).
        bending * (1.0 + 0.25 * self.shear_parameter())
    }

    /// First angular frequency of a cantilever of this length and of `mass_per_length` [kg/m] after Euler and Bernoulli:
    /// (1.8751/L)² √(E I/μ) [rad/s].
    pub fn cantilever_frequency(&self, mass_per_length: f64) -> f64 {
        // The least root of 1 + cos x cosh x = 0.
        let root = 1.875_104_068_711_961_2 / self.length;
        root * root * (self.young_modulus * self.second_moment() / mass_per_length).sqrt()
    }
}

/// Shear strength R_s [N] of the envelope of Jiang et al. under a normal force [N], compression positive: with the tensile
/// and compressive strengths R_nt and R_nc [N], the factor f_s [1] and the exponent n_s [1].
pub fn jiang_shear_strength(
    normal_force: f64,
    tensile: f64,
    compressive: f64,
    factor: f64,
    exponent: f64,
) -> f64 {
    let x = normal_force + tensile;
    factor * x * elementary::powf(elementary::ln((compressive + tensile) / x), exponent)
}
