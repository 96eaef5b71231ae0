//! What a law may know of the two bodies in contact.

use pulvis_math::Real;

/// Constants of a pair of spheres, or of a sphere and a plane wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair<R = f64> {
    /// Reduced mass m_r = m_i m_j / (m_i + m_j), of a wall contact m_i [kg].
    pub reduced_mass: R,
    /// Harmonic mean of the radii a12 = 2 a_i a_j / (a_i + a_j), of a wall contact 2 a_i [m]. The
    /// papers call it the reduced radius; it is twice the effective radius of contact mechanics.
    pub harmonic_radius: R,
}

impl<R: Real> Pair<R> {
    /// Two spheres with masses [kg] and radii [m].
    #[inline(always)]
    pub fn spheres(mass_i: R, mass_j: R, radius_i: R, radius_j: R) -> Self {
        Self {
            reduced_mass: mass_i * mass_j / (mass_i + mass_j),
            harmonic_radius: R::splat(2.0) * radius_i * radius_j / (radius_i + radius_j),
        }
    }

    /// A sphere with mass [kg] and radius [m] at a plane wall that does not give way.
    #[inline(always)]
    pub fn wall(mass: R, radius: R) -> Self {
        Self { reduced_mass: mass, harmonic_radius: R::splat(2.0) * radius }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_huge_partner_is_a_wall() {
        let near_wall: Pair = Pair::spheres(1e-6, 1e12, 1e-3, 1e12);
        let wall = Pair::wall(1e-6, 1e-3);
        assert!((near_wall.reduced_mass / wall.reduced_mass - 1.0).abs() < 1e-14);
        assert!((near_wall.harmonic_radius / wall.harmonic_radius - 1.0).abs() < 1e-14);
    }
}
