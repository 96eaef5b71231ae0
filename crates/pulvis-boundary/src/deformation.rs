//! Homogeneous deformations and their rates: matrices without entries below the diagonal.

use std::ops::{Add, Mul, Sub};

use pulvis_math::{Real, Vector3};

/// A matrix without entries below the diagonal: edges of a cell, a deformation gradient, or a velocity gradient
/// ∂v_a/∂x_b. The product and the inverse of two such matrices are of the same form, so that a cell of which x is along an
/// edge and y in a face stays one: the convention of LAMMPS for triclinic boxes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UpperTriangular {
    /// Along x.
    pub xx: f64,
    /// Along y.
    pub yy: f64,
    /// Along z.
    pub zz: f64,
    /// Along x, per length along y.
    pub xy: f64,
    /// Along x, per length along z.
    pub xz: f64,
    /// Along y, per length along z.
    pub yz: f64,
}

impl UpperTriangular {
    /// Nothing.
    pub const ZERO: Self = Self { xx: 0.0, yy: 0.0, zz: 0.0, xy: 0.0, xz: 0.0, yz: 0.0 };
    /// The unit matrix.
    pub const IDENTITY: Self = Self { xx: 1.0, yy: 1.0, zz: 1.0, ..Self::ZERO };
    /// The names of the entries, in the order of [`to_array`](Self::to_array).
    pub const NAMES: [&'static str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];
    /// Row and column of each entry, in the same order.
    pub const INDICES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

    /// The entries in the order of [`NAMES`](Self::NAMES).
    pub const fn to_array(self) -> [f64; 6] {
        [self.xx, self.yy, self.zz, self.xy, self.xz, self.yz]
    }

    /// From the entries in that order.
    pub const fn from_array([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Self {
        Self { xx, yy, zz, xy, xz, yz }
    }

    /// The product with a vector.
    #[inline(always)]
    pub fn times<R: Real>(&self, vector: Vector3<R>) -> Vector3<R> {
        let of = R::splat;
        Vector3::new(
            of(self.xx) * vector.x + of(self.xy) * vector.y + of(self.xz) * vector.z,
            of(self.yy) * vector.y + of(self.yz) * vector.z,
            of(self.zz) * vector.z,
        )
    }

    /// The product with another matrix: the deformation that comes after `first`.
    pub fn after(&self, first: &Self) -> Self {
        Self {
            xx: self.xx * first.xx,
            yy: self.yy * first.yy,
            zz: self.zz * first.zz,
            xy: self.xx * first.xy + self.xy * first.yy,
            xz: self.xx * first.xz + self.xy * first.yz + self.xz * first.zz,
            yz: self.yy * first.yz + self.yz * first.zz,
        }
    }

    /// The inverse matrix; infinite or NaN where a diagonal entry is zero.
    pub fn inverse(&self) -> Self {
        let (xx, yy, zz) = (1.0 / self.xx, 1.0 / self.yy, 1.0 / self.zz);
        let (xy, yz) = (-self.xy * xx * yy, -self.yz * yy * zz);
        Self { xx, yy, zz, xy, xz: -(self.xz * zz + self.xy * yz) * xx, yz }
    }

    /// The product of the diagonal: the ratio of volumes.
    pub fn determinant(&self) -> f64 {
        self.xx * self.yy * self.zz
    }

    /// The largest sum of the sizes of the entries of a row or of a column: no vector is stretched by more.
    pub fn bound(&self) -> f64 {
        let [xx, yy, zz, xy, xz, yz] = self.to_array().map(f64::abs);
        let rows = [xx + xy + xz, yy + yz, zz];
        let columns = [xx, yy + xy, zz + xz + yz];
        rows.into_iter().chain(columns).fold(0.0, pulvis_math::max_or_nan)
    }

    /// No vector becomes shorter than this share of its length: a lower bound of the least singular value, by
    /// Gershgorin's circles about the diagonal of FᵀF. Zero if FᵀF is far from the unit matrix.
    pub fn least_stretch(&self) -> f64 {
        let Self { xx, yy, zz, xy, xz, yz } = *self;
        let squares = [xx * xx, xy * xy + yy * yy, xz * xz + yz * yz + zz * zz];
        let [first, second, third] = [xx * xy, xx * xz, xy * xz + yy * yz].map(f64::abs);
        let others = [first + second, first + third, second + third];
        let least = squares.iter().zip(others).map(|(square, others)| square - others);
        least.fold(f64::INFINITY, pulvis_math::min_or_nan).max(0.0).sqrt()
    }

    /// Whether every entry is a finite number.
    pub fn is_finite(&self) -> bool {
        self.to_array().into_iter().all(f64::is_finite)
    }
}

impl Add for UpperTriangular {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (these, those) = (self.to_array(), other.to_array());
        Self::from_array(std::array::from_fn(|entry| these[entry] + those[entry]))
    }
}

impl Sub for UpperTriangular {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul<f64> for UpperTriangular {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::from_array(self.to_array().map(|entry| entry * factor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOME: UpperTriangular =
        UpperTriangular { xx: 1.25, yy: 0.5, zz: -2.0, xy: 0.75, xz: -3.0, yz: 1.5 };

    #[test]
    fn the_inverse_undoes_a_deformation() {
        let vector = Vector3::new(0.3, -0.7, 1.1);
        let back = SOME.inverse().times(SOME.times(vector));
        assert!((back - vector).norm() < 1e-14, "{back:?}");
        let unit = SOME.after(&SOME.inverse()) - UpperTriangular::IDENTITY;
        assert!(unit.bound() < 1e-14, "{unit:?}");
        assert_eq!(SOME.determinant(), -1.25);
    }

    #[test]
    fn the_stretch_of_no_vector_is_outside_of_its_bounds() {
        let gradient = UpperTriangular { xx: 1.02, yy: 0.97, zz: 1.01, xy: 0.08, xz: -0.03, yz: 0.02 };
        let (least, most) = (gradient.least_stretch(), gradient.bound());
        assert!(least > 0.85 && most < 1.15, "{least} {most}");
        for number in 0..1000 {
            let at = |turn: f64| pulvis_math::elementary::cos(turn * f64::from(number));
            let vector = Vector3::new(at(0.7), at(1.3), at(2.9));
            let stretch = gradient.times(vector).norm() / vector.norm();
            assert!(least <= stretch && stretch <= most, "{stretch}");
        }
        // A simple shear by γ shortens the diagonal by about γ/2.
        let shear = UpperTriangular { xy: 0.1, ..UpperTriangular::IDENTITY };
        assert!((shear.least_stretch() - 0.95).abs() < 0.01);
    }
}
