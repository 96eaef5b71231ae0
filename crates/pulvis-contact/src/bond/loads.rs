//! What loads a bond.

use pulvis_math::Real;

/// The elastic forces and moments of a bond, and the lengths by which criteria of breaking turn them into stresses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BondLoads<R = f64> {
    /// Normal force, compression positive [N].
    pub normal: R,
    /// Size of the shear force [N].
    pub shear: R,
    /// Size of the bending moment [N m].
    pub bending: R,
    /// Size of the torsion moment [N m].
    pub torsion: R,
    /// Radius of the cross-section, zero for a bond that has none [m].
    pub section_radius: R,
    /// Harmonic mean of the radii of the bodies a12 [m].
    pub harmonic_radius: R,
}

impl<R: Real> BondLoads<R> {
    /// Size of the moment from bending and torsion together [N m].
    #[inline(always)]
    pub fn moment(&self) -> R {
        (self.bending * self.bending + self.torsion * self.torsion).sqrt()
    }
}
