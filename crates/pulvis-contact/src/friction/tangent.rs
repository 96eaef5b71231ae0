//! What springs against sliding, rolling and torsion have in common as quantities.

use std::ops::{Add, Sub};

use pulvis_math::{Real, Vector3};

/// A vector of the tangent plane, or a number along the line of centres.
pub trait Tangent<R: Real>: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// Nothing.
    fn zero() -> Self;
    /// `self` times a number.
    fn scaled(self, factor: R) -> Self;
    /// Scalar product.
    fn dot(self, other: Self) -> R;
    /// `then` where `mask` holds, otherwise `otherwise`.
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self;

    /// Square of the length.
    #[inline(always)]
    fn norm_squared(self) -> R {
        self.dot(self)
    }
}

impl<R: Real> Tangent<R> for Vector3<R> {
    #[inline(always)]
    fn zero() -> Self {
        Vector3::zero()
    }
    #[inline(always)]
    fn scaled(self, factor: R) -> Self {
        self * factor
    }
    #[inline(always)]
    fn dot(self, other: Self) -> R {
        Vector3::dot(self, other)
    }
    #[inline(always)]
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        Vector3::select(mask, then, otherwise)
    }
    #[inline(always)]
    fn norm_squared(self) -> R {
        Vector3::norm_squared(self)
    }
}

/// A number along the line of centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along<R>(pub R);

impl<R: Real> Add for Along<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<R: Real> Sub for Along<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<R: Real> Tangent<R> for Along<R> {
    #[inline(always)]
    fn zero() -> Self {
        Self(R::zero())
    }
    #[inline(always)]
    fn scaled(self, factor: R) -> Self {
        Self(self.0 * factor)
    }
    #[inline(always)]
    fn dot(self, other: Self) -> R {
        self.0 * other.0
    }
    #[inline(always)]
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        Self(R::select(mask, then.0, otherwise.0))
    }
}
