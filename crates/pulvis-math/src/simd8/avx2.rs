//! Eight numbers in two 256-bit registers.

use std::arch::x86_64::*;
use std::fmt;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};

use super::operators::{lane_by_lane, simd8_operators};
use super::{Kernel, Packed4, Pointer, Routine, Simd4, Simd8, Task, side_by_side};
use crate::array::F64Array;
use crate::real::{Mask, Real};

/// The kernel compiled for AVX2.
///
/// # Safety
/// The processor must have the instructions.
#[target_feature(enable = "avx2")]
pub(super) unsafe fn run<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Ymm2>()
}

/// Four numbers.
#[derive(Clone, Copy)]
pub(super) struct Ymm(pub(super) __m256d);

/// Eight numbers, the lower four lanes first.
#[derive(Clone, Copy)]
pub(super) struct Ymm2(__m256d, __m256d);

/// All ones or all zeros a lane.
#[derive(Clone, Copy)]
pub(super) struct Mask2(__m256d, __m256d);

// SAFETY of all blocks below: values of these types exist only within a kernel that `run` has been
// called for, so the processor has the instructions.

impl Simd4 for Ymm {
    #[inline(always)]
    fn load(packed: &Packed4) -> Self {
        unsafe { Self(_mm256_load_pd((&raw const *packed).cast())) }
    }
    #[inline(always)]
    fn store(self, packed: &mut Packed4) {
        unsafe { _mm256_store_pd((&raw mut *packed).cast(), self.0) }
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        unsafe { Self(_mm256_set1_pd(value)) }
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        unsafe { Self(_mm256_add_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        unsafe { Self(_mm256_sub_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        unsafe { Self(_mm256_mul_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn with_scalar_of(self, other: Self) -> Self {
        unsafe { Self(_mm256_blend_pd::<0b1000>(self.0, other.0)) }
    }
}

simd8_operators!(Ymm2, Mask2);

/// One instruction on both halves.
macro_rules! halves {
    ($wrap:ident, $function:ident($($operand:expr),*)) => {
        unsafe { $wrap($function($($operand.0),*), $function($($operand.1),*)) }
    };
    ($wrap:ident, $function:ident::<$constant:ident>($($operand:expr),*)) => {
        unsafe { $wrap($function::<$constant>($($operand.0),*), $function::<$constant>($($operand.1),*)) }
    };
}

impl Ymm2 {
    #[inline(always)]
    fn sum(self, other: Self) -> Self {
        halves!(Self, _mm256_add_pd(self, other))
    }
    #[inline(always)]
    fn difference(self, other: Self) -> Self {
        halves!(Self, _mm256_sub_pd(self, other))
    }
    #[inline(always)]
    fn product(self, other: Self) -> Self {
        halves!(Self, _mm256_mul_pd(self, other))
    }
    #[inline(always)]
    fn quotient(self, other: Self) -> Self {
        halves!(Self, _mm256_div_pd(self, other))
    }
    #[inline(always)]
    fn opposite(self) -> Self {
        let sign = Self::splat(-0.0);
        halves!(Self, _mm256_xor_pd(self, sign))
    }
}

impl Mask2 {
    #[inline(always)]
    fn both(self, other: Self) -> Self {
        halves!(Self, _mm256_and_pd(self, other))
    }
    #[inline(always)]
    fn either(self, other: Self) -> Self {
        halves!(Self, _mm256_or_pd(self, other))
    }
    #[inline(always)]
    fn neither(self) -> Self {
        let ones = Self::splat(true);
        halves!(Self, _mm256_xor_pd(self, ones))
    }
}

impl fmt::Debug for Mask2 {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "Mask2({:08b})", self.bits())
    }
}

impl Mask for Mask2 {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        let bits = if value { -1 } else { 0 };
        unsafe {
            let half = _mm256_castsi256_pd(_mm256_set1_epi64x(bits));
            Self(half, half)
        }
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.bits() == 0xff
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        self.bits() & (1 << lane) != 0
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        unsafe { (_mm256_movemask_pd(self.0) | _mm256_movemask_pd(self.1) << 4) as u32 }
    }
}

impl Real for Ymm2 {
    type Mask = Mask2;
    const LANES: usize = 8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        unsafe { Self(_mm256_set1_pd(value), _mm256_set1_pd(value)) }
    }
    lane_by_lane!();
    #[inline(always)]
    fn sqrt(self) -> Self {
        halves!(Self, _mm256_sqrt_pd(self))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        let sign = Self::splat(-0.0);
        halves!(Self, _mm256_andnot_pd(sign, self))
    }
    // The instructions answer with the second operand for equal numbers and for NaN, as the trait says.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        halves!(Self, _mm256_min_pd(self, other))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        halves!(Self, _mm256_max_pd(self, other))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Mask2 {
        halves!(Mask2, _mm256_cmp_pd::<_CMP_LT_OQ>(self, other))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Mask2 {
        halves!(Mask2, _mm256_cmp_pd::<_CMP_LE_OQ>(self, other))
    }
    #[inline(always)]
    fn gt(self, other: Self) -> Mask2 {
        halves!(Mask2, _mm256_cmp_pd::<_CMP_GT_OQ>(self, other))
    }
    #[inline(always)]
    fn ge(self, other: Self) -> Mask2 {
        halves!(Mask2, _mm256_cmp_pd::<_CMP_GE_OQ>(self, other))
    }
    #[inline(always)]
    fn select(mask: Mask2, then: Self, otherwise: Self) -> Self {
        halves!(Self, _mm256_blendv_pd(otherwise, then, mask))
    }
}

/// Four rows of four numbers, turned into four columns; its own inverse.
///
/// # Safety
/// The processor must have AVX.
#[inline(always)]
unsafe fn transposed(rows: [__m256d; 4]) -> [__m256d; 4] {
    unsafe {
        let [a, b, c, d] = rows;
        let (xz_ab, yw_ab) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (xz_cd, yw_cd) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(xz_ab, xz_cd),
            _mm256_permute2f128_pd::<0x20>(yw_ab, yw_cd),
            _mm256_permute2f128_pd::<0x31>(xz_ab, xz_cd),
            _mm256_permute2f128_pd::<0x31>(yw_ab, yw_cd),
        ]
    }
}

impl Simd8 for Ymm2 {
    type Simd4 = Ymm;
    type Simd4Pair = [Self::Simd4; 2];

    #[inline(always)]
    fn load(source: &F64Array<8>) -> Self {
        let start = source.0.as_ptr();
        unsafe { Self(_mm256_load_pd(start), _mm256_load_pd(start.add(4))) }
    }
    #[inline(always)]
    fn store(self, target: &mut F64Array<8>) {
        let start = target.0.as_mut_ptr();
        unsafe {
            _mm256_store_pd(start, self.0);
            _mm256_store_pd(start.add(4), self.1);
        }
    }
    #[inline(always)]
    fn columns(rows: [Ymm; 8]) -> [Self; 4] {
        let [a, b, c, d, e, f, g, h] = rows;
        let (low, high) = unsafe { (transposed([a.0, b.0, c.0, d.0]), transposed([e.0, f.0, g.0, h.0])) };
        [Self(low[0], high[0]), Self(low[1], high[1]), Self(low[2], high[2]), Self(low[3], high[3])]
    }
    #[inline(always)]
    fn rows(columns: [Self; 4]) -> [Ymm; 8] {
        let [x, y, z, w] = columns;
        let (low, high) = unsafe { (transposed([x.0, y.0, z.0, w.0]), transposed([x.1, y.1, z.1, w.1])) };
        [
            Ymm(low[0]),
            Ymm(low[1]),
            Ymm(low[2]),
            Ymm(low[3]),
            Ymm(high[0]),
            Ymm(high[1]),
            Ymm(high[2]),
            Ymm(high[3]),
        ]
    }

    #[inline(always)]
    fn row_pairs(first: [Self; 4], second: [Self; 4]) -> [Self::Simd4Pair; 8] {
        side_by_side(Self::rows(first), Self::rows(second))
    }

    fn pointer<T: Task, P: Routine<T>>() -> Pointer<T, Self> {
        #[target_feature(enable = "avx2")]
        fn call<T: Task, P: Routine<T>>(data: &mut T::Data<'_, Ymm2>) {
            P::call::<Ymm2>(data);
        }
        Pointer(call::<T, P>)
    }
}
