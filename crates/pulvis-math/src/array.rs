//! Eight numbers at a time, in plain Rust that the compiler turns into vector instructions.

use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};

use crate::elementary;
use crate::real::{Mask, Real};

/// `N` numbers on which every operation acts lane by lane.
///
/// Element-wise loops over a fixed array, always inlined: inside a function that is compiled for
/// AVX2 or AVX-512 they become vector instructions, without intrinsics and without a compiler flag.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct F64Array<const N: usize>(pub [f64; N]);

/// One truth value a lane, as an integer of all ones or all zeros: in this form the compiler keeps
/// masks in vector registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C, align(64))]
pub struct ArrayMask<const N: usize>([u64; N]);

impl<const N: usize> Default for F64Array<N> {
    #[inline(always)]
    fn default() -> Self {
        Self([0.0; N])
    }
}

impl<const N: usize> From<[f64; N]> for F64Array<N> {
    #[inline(always)]
    fn from(numbers: [f64; N]) -> Self {
        Self(numbers)
    }
}

macro_rules! lane_operator {
    ($operator:ident, $method:ident, $assign:tt) => {
        impl<const N: usize> $operator for F64Array<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for lane in 0..N {
                    self.0[lane] $assign other.0[lane];
                }
                self
            }
        }
    };
}
lane_operator!(Add, add, +=);
lane_operator!(Sub, sub, -=);
lane_operator!(Mul, mul, *=);
lane_operator!(Div, div, /=);

impl<const N: usize> Neg for F64Array<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        for lane in 0..N {
            self.0[lane] = -self.0[lane];
        }
        self
    }
}

impl<const N: usize> AddAssign for F64Array<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> SubAssign for F64Array<N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

macro_rules! mask_operator {
    ($operator:ident, $method:ident, $assign:tt) => {
        impl<const N: usize> $operator for ArrayMask<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for lane in 0..N {
                    self.0[lane] $assign other.0[lane];
                }
                self
            }
        }
    };
}
mask_operator!(BitAnd, bitand, &=);
mask_operator!(BitOr, bitor, |=);

impl<const N: usize> Not for ArrayMask<N> {
    type Output = Self;
    #[inline(always)]
    fn not(mut self) -> Self {
        for lane in 0..N {
            self.0[lane] = !self.0[lane];
        }
        self
    }
}

impl<const N: usize> Mask for ArrayMask<N> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self([(value as u64).wrapping_neg(); N])
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0.iter().fold(0, |union, lane| union | lane) != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0.iter().fold(u64::MAX, |common, lane| common & lane) != 0
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        self.0[lane] != 0
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.iter().enumerate().fold(0, |bits, (lane, &value)| bits | ((value & 1) as u32) << lane)
    }
}

macro_rules! lane_comparison {
    ($method:ident, $symbol:tt) => {
        #[inline(always)]
        fn $method(self, other: Self) -> ArrayMask<N> {
            let mut mask = [0; N];
            for lane in 0..N {
                mask[lane] = ((self.0[lane] $symbol other.0[lane]) as u64).wrapping_neg();
            }
            ArrayMask(mask)
        }
    };
}

macro_rules! lane_function {
    ($method:ident) => {
        #[inline(always)]
        fn $method(mut self) -> Self {
            for lane in 0..N {
                self.0[lane] = self.0[lane].$method();
            }
            self
        }
    };
}

impl<const N: usize> Real for F64Array<N> {
    type Mask = ArrayMask<N>;
    const LANES: usize = N;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; N])
    }
    #[inline(always)]
    fn from_fn(mut number: impl FnMut(usize) -> f64) -> Self {
        let mut lanes = [0.0; N];
        for (lane, slot) in lanes.iter_mut().enumerate() {
            *slot = number(lane);
        }
        Self(lanes)
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
    lane_function!(sqrt);
    lane_function!(abs);
    fn powf(mut self, exponent: f64) -> Self {
        for lane in 0..N {
            self.0[lane] = elementary::powf(self.0[lane], exponent);
        }
        self
    }
    fn cbrt(self) -> Self {
        Self(self.0.map(elementary::cbrt))
    }
    fn exp(self) -> Self {
        Self(self.0.map(elementary::exp))
    }
    fn ln(self) -> Self {
        Self(self.0.map(elementary::ln))
    }
    #[inline(always)]
    fn min(mut self, other: Self) -> Self {
        for lane in 0..N {
            self.0[lane] = if self.0[lane] < other.0[lane] { self.0[lane] } else { other.0[lane] };
        }
        self
    }
    #[inline(always)]
    fn max(mut self, other: Self) -> Self {
        for lane in 0..N {
            self.0[lane] = if self.0[lane] > other.0[lane] { self.0[lane] } else { other.0[lane] };
        }
        self
    }
    lane_comparison!(lt, <);
    lane_comparison!(le, <=);
    lane_comparison!(gt, >);
    lane_comparison!(ge, >=);
    #[inline(always)]
    fn select(mask: ArrayMask<N>, mut then: Self, otherwise: Self) -> Self {
        for lane in 0..N {
            then.0[lane] = if mask.0[lane] != 0 { then.0[lane] } else { otherwise.0[lane] };
        }
        then
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn law_like<R: Real>(x: R, y: R) -> R {
        let limit = (x * x + y * y).sqrt();
        let chosen = R::select(x.lt(y) & !y.ge(R::splat(3.0)), limit - x, y / (limit + R::one()));
        chosen.max(-limit).min(x.abs() + y) - chosen.keep_where(x.gt(y) | y.le(x))
    }

    proptest! {
        #[test]
        fn every_lane_gives_the_bits_of_the_plain_number(
            x in prop::array::uniform8(-10.0..10.0_f64),
            y in prop::array::uniform8(-10.0..10.0_f64),
        ) {
            let lanes = law_like(F64Array(x), F64Array(y));
            for lane in 0..8 {
                prop_assert_eq!(lanes.lane(lane).to_bits(), law_like(x[lane], y[lane]).to_bits());
            }
        }
    }

    #[test]
    fn masks_know_any_and_all() {
        let x = F64Array([1.0, 2.0, 3.0, 4.0]);
        assert!(x.gt(F64Array::splat(3.0)).any());
        assert!(!x.gt(F64Array::splat(3.0)).all());
        assert!(x.gt(F64Array::splat(0.0)).all());
        assert!(!ArrayMask::<4>::splat(false).any());
        assert_eq!(x.sum_lanes(), 10.0);
    }
}
