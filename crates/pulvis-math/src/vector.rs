//! Vectors in space over any scalar.

use std::ops::{Add, AddAssign, Index, Mul, Neg, Sub, SubAssign};

use crate::real::Real;

/// A vector in space with components over `R`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Vector3<R = f64> {
    /// Component along x.
    pub x: R,
    /// Component along y.
    pub y: R,
    /// Component along z.
    pub z: R,
}

impl<R: Real> Vector3<R> {
    /// The vector with the given components.
    #[inline(always)]
    pub const fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::splat(Vector3::new(0.0, 0.0, 0.0))
    }

    /// The same vector in every lane.
    #[inline(always)]
    pub fn splat(vector: Vector3<f64>) -> Self {
        Self::new(R::splat(vector.x), R::splat(vector.y), R::splat(vector.z))
    }

    /// The vector in one lane.
    #[inline(always)]
    pub fn lane(self, lane: usize) -> Vector3<f64> {
        Vector3::new(self.x.lane(lane), self.y.lane(lane), self.z.lane(lane))
    }

    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Vector product.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Square of the length.
    #[inline(always)]
    pub fn norm_squared(self) -> R {
        self.dot(self)
    }

    /// Length.
    #[inline(always)]
    pub fn norm(self) -> R {
        self.norm_squared().sqrt()
    }

    /// The part at right angles to the unit vector `normal`.
    #[inline(always)]
    pub fn tangential_to(self, normal: Self) -> Self {
        self - normal * self.dot(normal)
    }

    /// `self` where `mask` holds, otherwise the zero vector.
    #[inline(always)]
    pub fn keep_where(self, mask: R::Mask) -> Self {
        Self::new(self.x.keep_where(mask), self.y.keep_where(mask), self.z.keep_where(mask))
    }

    /// `then` where `mask` holds, otherwise `otherwise`.
    #[inline(always)]
    pub fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        Self::new(
            R::select(mask, then.x, otherwise.x),
            R::select(mask, then.y, otherwise.y),
            R::select(mask, then.z, otherwise.z),
        )
    }
}

impl Vector3<f64> {
    /// The components in the order x, y, z.
    #[inline(always)]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Whether every component is a finite number.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// The component along axis 0 (x), 1 (y) or any other (z), for writing.
    #[inline(always)]
    pub fn component_mut(&mut self, axis: usize) -> &mut f64 {
        match axis {
            0 => &mut self.x,
            1 => &mut self.y,
            _ => &mut self.z,
        }
    }

    /// The unit vector along `self`, or `None` for a vector without a direction.
    pub fn unit(self) -> Option<Self> {
        let norm = self.norm();
        (norm.is_finite() && norm > 0.0).then(|| self * (1.0 / norm))
    }
}

// Not derived: what is derived is not inlined by force, and out of line it is compiled without the vector
// instructions of the loop that calls it.
impl<R: Default> Default for Vector3<R> {
    #[inline(always)]
    fn default() -> Self {
        Self { x: R::default(), y: R::default(), z: R::default() }
    }
}

impl From<[f64; 3]> for Vector3<f64> {
    #[inline(always)]
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }
}

/// Components by axis: 0 is x, 1 is y, any other is z.
impl<R> Index<usize> for Vector3<R> {
    type Output = R;
    #[inline(always)]
    fn index(&self, axis: usize) -> &R {
        match axis {
            0 => &self.x,
            1 => &self.y,
            _ => &self.z,
        }
    }
}

impl<R: Real> Add for Vector3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<R: Real> Sub for Vector3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<R: Real> Mul<R> for Vector3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<R: Real> Neg for Vector3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<R: Real> AddAssign for Vector3<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<R: Real> SubAssign for Vector3<R> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cross_product_is_at_right_angles_and_right_handed() {
        let (x, y) = (Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 1.0, 0.0));
        assert_eq!(x.cross(y), Vector3::new(0.0, 0.0, 1.0));
        let (a, b) = (Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.25, 4.0, -1.0));
        assert_eq!(a.cross(b).dot(a), 0.0);
    }

    #[test]
    fn a_tangential_part_has_no_normal_component() {
        let normal = Vector3::new(0.6, 0.0, 0.8);
        let tangential = Vector3::new(1.0, 2.0, 3.0).tangential_to(normal);
        assert!(tangential.dot(normal).abs() < 1e-15);
    }

    #[test]
    fn a_vector_of_no_length_has_no_direction() {
        assert_eq!(Vector3::<f64>::zero().unit(), None);
        assert_eq!(Vector3::new(0.0, 0.0, 4.0).unit(), Some(Vector3::new(0.0, 0.0, 1.0)));
    }
}
