//! What a law may know of the two bodies in contact.

use pulvis_math::Real;

/// Constants of a pair of spheres, or of a sphere and a plane wall.
///
/// Kept as the inverses 1/m_r and 1/a12, which are sums of the inverses of the two bodies: a loop over
/// contacts that knows those builds a pair without a division, the slowest of the instructions that
/// contacts need, and a law pays one only if it asks for the mass or for the radius itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair<R = f64> {
    inverse_reduced_mass: R,
    inverse_harmonic_radius: R,
    quantities: Quantities<R>,
}

/// The largest number of particle quantities that a law may read.
pub const MOST_QUANTITIES: usize = 2;

/// The quantities of both bodies that laws [ask for](crate::catalogue::LawEntry::particle_quantities), in SI; zero where
/// none does, and for walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantities<R = f64> {
    /// Those of the normal law, each of body i and of body j.
    pub normal: [[R; 2]; MOST_QUANTITIES],
    /// Those of the attraction.
    pub attraction: [[R; 2]; MOST_QUANTITIES],
}

/// How large a quantity of the particles that there are is, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// The least size that is not zero; infinite where there is none.
    pub least: f64,
    /// The largest size; zero where there is none.
    pub largest: f64,
}

impl FromIterator<f64> for Sizes {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        let none = Self { least: f64::INFINITY, largest: 0.0 };
        values.into_iter().map(f64::abs).fold(none, |Self { least, largest }, size| Self {
            least: if size > 0.0 { least.min(size) } else { least },
            largest: largest.max(size),
        })
    }
}

// Not derived: what is derived is not inlined by force.
impl<R: Real> Default for Quantities<R> {
    #[inline(always)]
    fn default() -> Self {
        let zero = [[R::zero(); 2]; MOST_QUANTITIES];
        Self { normal: zero, attraction: zero }
    }
}

impl<R: Real> Quantities<R> {
    /// Those of one pair a lane, from its index.
    pub fn from_fn(of: impl Fn(usize) -> Quantities<f64>) -> Self {
        let each = |role: fn(&Quantities<f64>) -> &[[f64; 2]; MOST_QUANTITIES]| {
            std::array::from_fn(|quantity| {
                std::array::from_fn(|body| R::from_fn(|lane| role(&of(lane))[quantity][body]))
            })
        };
        Self { normal: each(|all| &all.normal), attraction: each(|all| &all.attraction) }
    }
}

impl<R: Real> Pair<R> {
    /// Two spheres with masses [kg] and radii [m].
    #[inline(always)]
    pub fn spheres(mass_i: R, mass_j: R, radius_i: R, radius_j: R) -> Self {
        let one = R::one();
        Self::from_sums(one / mass_i + one / mass_j, one / radius_i + one / radius_j)
    }

    /// A sphere with mass [kg] and radius [m] at a plane wall that does not give way.
    #[inline(always)]
    pub fn wall(mass: R, radius: R) -> Self {
        Self::wall_from_inverses(R::one() / mass, R::one() / radius)
    }

    /// A sphere at a plane wall, from one over its mass [1/kg] and one over its radius [1/m]. The same
    /// bits as of [`wall`](Self::wall).
    #[inline(always)]
    pub fn wall_from_inverses(inverse_mass: R, inverse_radius: R) -> Self {
        Self::from_sums(inverse_mass, inverse_radius)
    }

    /// Two spheres, from the sum of one over their masses [1/kg] and that of one over their radii [1/m]. The
    /// same bits as of [`spheres`](Self::spheres).
    #[inline(always)]
    pub fn from_sums(inverse_masses: R, inverse_radii: R) -> Self {
        Self {
            inverse_reduced_mass: inverse_masses,
            inverse_harmonic_radius: R::splat(0.5) * inverse_radii,
            quantities: Quantities::default(),
        }
    }

    /// The same bodies with the quantities that laws ask for.
    #[must_use]
    #[inline(always)]
    pub fn with_quantities(self, quantities: Quantities<R>) -> Self {
        Self { quantities, ..self }
    }

    /// The quantities that laws ask for.
    #[inline(always)]
    pub fn quantities(&self) -> &Quantities<R> {
        &self.quantities
    }

    /// One pair a lane, from its index.
    pub fn from_fn(pair: impl Fn(usize) -> Pair<f64>) -> Self {
        Self {
            inverse_reduced_mass: R::from_fn(|lane| pair(lane).inverse_reduced_mass),
            inverse_harmonic_radius: R::from_fn(|lane| pair(lane).inverse_harmonic_radius),
            quantities: Quantities::from_fn(|lane| pair(lane).quantities),
        }
    }

    /// One over the reduced mass, 1/m_i + 1/m_j, of a wall contact 1/m_i [1/kg].
    #[inline(always)]
    pub fn inverse_reduced_mass(&self) -> R {
        self.inverse_reduced_mass
    }

    /// One over the harmonic mean of the radii, (1/a_i + 1/a_j)/2, of a wall contact 1/(2 a_i) [1/m].
    #[inline(always)]
    pub fn inverse_harmonic_radius(&self) -> R {
        self.inverse_harmonic_radius
    }

    /// Reduced mass m_r = m_i m_j / (m_i + m_j), of a wall contact m_i [kg]. Costs a division.
    #[inline(always)]
    pub fn reduced_mass(&self) -> R {
        R::one() / self.inverse_reduced_mass
    }

    /// Harmonic mean of the radii a12 = 2 a_i a_j / (a_i + a_j), of a wall contact 2 a_i [m]. The
    /// papers call it the reduced radius; it is twice the effective radius of contact mechanics. Costs
    /// a division.
    #[inline(always)]
    pub fn harmonic_radius(&self) -> R {
        R::one() / self.inverse_harmonic_radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_huge_partner_is_a_wall() {
        let near_wall: Pair = Pair::spheres(1e-6, 1e12, 1e-3, 1e12);
        let wall = Pair::wall(1e-6, 1e-3);
        assert!((near_wall.reduced_mass() / wall.reduced_mass() - 1.0).abs() < 1e-14);
        assert!((near_wall.harmonic_radius() / wall.harmonic_radius() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn masses_and_radii_are_those_of_the_formulas() {
        let pair: Pair = Pair::spheres(2e-6, 3e-6, 1e-3, 4e-3);
        assert!((pair.reduced_mass() / 1.2e-6 - 1.0).abs() < 1e-15);
        assert!((pair.harmonic_radius() / 1.6e-3 - 1.0).abs() < 1e-15);
        let wall: Pair = Pair::wall(2e-6, 1e-3);
        assert!((wall.reduced_mass() / 2e-6 - 1.0).abs() < 1e-15);
        assert!((wall.harmonic_radius() / 2e-3 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn both_ways_to_make_a_pair_give_the_same_bits() {
        let (mass_i, mass_j, radius_i, radius_j): (f64, f64, f64, f64) = (3.1e-6, 7.3e-6, 0.7e-3, 1.9e-3);
        assert_eq!(
            Pair::spheres(mass_i, mass_j, radius_i, radius_j),
            Pair::from_sums(1.0 / mass_i + 1.0 / mass_j, 1.0 / radius_i + 1.0 / radius_j)
        );
        assert_eq!(Pair::wall(mass_i, radius_i), Pair::wall_from_inverses(1.0 / mass_i, 1.0 / radius_i));
    }
}
