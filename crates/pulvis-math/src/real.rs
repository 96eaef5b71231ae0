//! The scalar trait of the force laws, and its plain instance `f64`.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};

use crate::elementary;

/// The outcome of comparing two [`Real`]s: one truth value a lane.
pub trait Mask: Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// The same truth value in every lane.
    fn splat(value: bool) -> Self;
    /// Whether any lane is true.
    fn any(self) -> bool;
    /// Whether every lane is true.
    fn all(self) -> bool;
    /// The truth value of one lane.
    fn lane(self, lane: usize) -> bool;
    /// One bit a lane, the first lane's the lowest.
    fn bits(self) -> u32;
}

/// A scalar in which a force law is written once: `f64` for one contact, [`F64Array`](crate::F64Array)
/// for eight contacts at a time.
///
/// Laws must be branch-free in values of this type: use [`min`](Real::min), [`max`](Real::max) and
/// [`select`](Real::select). No operation contracts a multiplication and an addition, so every
/// instance gives the same bits on every instruction set.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// What a comparison gives.
    type Mask: Mask;
    /// How many numbers one value holds.
    const LANES: usize;

    /// The same number in every lane.
    fn splat(value: f64) -> Self;
    /// One number a lane, from its index.
    fn from_fn(number: impl FnMut(usize) -> f64) -> Self;
    /// The number in one lane.
    fn lane(self, lane: usize) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self` raised to `exponent`, lane by lane (slow: not vectorised), with the same bits on
    /// every machine ([`elementary`]).
    fn powf(self, exponent: f64) -> Self;
    /// Cube root, lane by lane as [`powf`](Self::powf), in a third of its time.
    fn cbrt(self) -> Self;
    /// e to the power, lane by lane as [`powf`](Self::powf).
    fn exp(self) -> Self;
    /// Natural logarithm, lane by lane as [`powf`](Self::powf).
    fn ln(self) -> Self;
    /// The smaller of two numbers (`other` where either is NaN).
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers (`other` where either is NaN).
    fn max(self, other: Self) -> Self;
    /// `self < other`
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`
    fn le(self, other: Self) -> Self::Mask;
    /// `self > other`
    fn gt(self, other: Self) -> Self::Mask;
    /// `self >= other`
    fn ge(self, other: Self) -> Self::Mask;
    /// `then` where `mask` holds, otherwise `otherwise`. Both are evaluated; a NaN in the branch
    /// not taken does no harm.
    fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self;

    /// Zero in every lane.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }

    /// One in every lane.
    #[inline(always)]
    fn one() -> Self {
        Self::splat(1.0)
    }

    /// `self` where `mask` holds, otherwise zero.
    #[inline(always)]
    fn keep_where(self, mask: Self::Mask) -> Self {
        Self::select(mask, self, Self::zero())
    }

    /// Sum over the lanes, from the first to the last.
    #[inline(always)]
    fn sum_lanes(self) -> f64 {
        let mut sum = 0.0;
        for lane in 0..Self::LANES {
            sum += self.lane(lane);
        }
        sum
    }
}

impl Mask for bool {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        value
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
    #[inline(always)]
    fn lane(self, _lane: usize) -> bool {
        self
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self)
    }
}

impl Real for f64 {
    type Mask = bool;
    const LANES: usize = 1;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn from_fn(mut number: impl FnMut(usize) -> f64) -> Self {
        number(0)
    }
    #[inline(always)]
    fn lane(self, _lane: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn powf(self, exponent: f64) -> Self {
        elementary::powf(self, exponent)
    }
    #[inline(always)]
    fn cbrt(self) -> Self {
        elementary::cbrt(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }
    // `if a < b` and not `f64::min`: one instruction, where the standard function needs three for
    // its rule about NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn gt(self, other: Self) -> bool {
        self > other
    }
    #[inline(always)]
    fn ge(self, other: Self) -> bool {
        self >= other
    }
    #[inline(always)]
    fn select(mask: bool, then: Self, otherwise: Self) -> Self {
        if mask { then } else { otherwise }
    }
}
