//! Eight numbers in one 512-bit register.

use std::arch::x86_64::*;
use std::fmt;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};

use super::avx2::Ymm;
use super::operators::{lane_by_lane, simd8_operators};
use super::{Kernel, Packed4, Pointer, Routine, Simd4Pair, Simd8, Task};
use crate::array::F64Array;
use crate::real::{Mask, Real};

/// The kernel compiled for AVX-512.
///
/// # Safety
/// The processor must have the instructions.
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,avx2")]
pub(super) unsafe fn run<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Zmm>()
}

/// Eight numbers.
#[derive(Clone, Copy)]
pub(super) struct Zmm(__m512d);

/// Two packed vectors.
#[derive(Clone, Copy)]
pub(super) struct Packed4s(__m512d);

/// One bit a lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bits(__mmask8);

// SAFETY of all blocks below: values of these types exist only within a kernel that `run` has been
// called for, so the processor has the instructions.

simd8_operators!(Zmm, Bits);

impl Zmm {
    #[inline(always)]
    fn sum(self, other: Self) -> Self {
        unsafe { Self(_mm512_add_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn difference(self, other: Self) -> Self {
        unsafe { Self(_mm512_sub_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn product(self, other: Self) -> Self {
        unsafe { Self(_mm512_mul_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn quotient(self, other: Self) -> Self {
        unsafe { Self(_mm512_div_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn opposite(self) -> Self {
        unsafe { Self(_mm512_xor_pd(self.0, _mm512_set1_pd(-0.0))) }
    }
}

impl Bits {
    #[inline(always)]
    fn both(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
    #[inline(always)]
    fn either(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
    #[inline(always)]
    fn neither(self) -> Self {
        Self(!self.0)
    }
}

impl Mask for Bits {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self(if value { 0xff } else { 0 })
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0 != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0 == 0xff
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        self.0 & (1 << lane) != 0
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self.0)
    }
}

impl Real for Zmm {
    type Mask = Bits;
    const LANES: usize = 8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        unsafe { Self(_mm512_set1_pd(value)) }
    }
    lane_by_lane!();
    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { Self(_mm512_sqrt_pd(self.0)) }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        unsafe { Self(_mm512_abs_pd(self.0)) }
    }
    // The instructions answer with the second operand for equal numbers and for NaN, as the trait says.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        unsafe { Self(_mm512_min_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        unsafe { Self(_mm512_max_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Bits {
        unsafe { Bits(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0)) }
    }
    #[inline(always)]
    fn le(self, other: Self) -> Bits {
        unsafe { Bits(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0)) }
    }
    #[inline(always)]
    fn gt(self, other: Self) -> Bits {
        unsafe { Bits(_mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, other.0)) }
    }
    #[inline(always)]
    fn ge(self, other: Self) -> Bits {
        unsafe { Bits(_mm512_cmp_pd_mask::<_CMP_GE_OQ>(self.0, other.0)) }
    }
    #[inline(always)]
    fn select(mask: Bits, then: Self, otherwise: Self) -> Self {
        unsafe { Self(_mm512_mask_blend_pd(mask.0, otherwise.0, then.0)) }
    }
}

// Functions and not closures, which are not inlined by force.

#[inline(always)]
fn joined(low: Ymm, high: Ymm) -> __m512d {
    unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low.0), high.0) }
}

#[inline(always)]
fn low(pair: __m512d) -> Ymm {
    unsafe { Ymm(_mm512_castpd512_pd256(pair)) }
}

#[inline(always)]
fn high(pair: __m512d) -> Ymm {
    unsafe { Ymm(_mm512_extractf64x4_pd::<1>(pair)) }
}

/// Rows 0 and 4, 1 and 5, 2 and 6, 3 and 7 side by side: what follows acts on both halves alike.
#[inline(always)]
fn pairs(rows: [Ymm; 8]) -> [__m512d; 4] {
    [joined(rows[0], rows[4]), joined(rows[1], rows[5]), joined(rows[2], rows[6]), joined(rows[3], rows[7])]
}

/// The columns of rows that stand in [`pairs`].
#[inline(always)]
fn columns_of_pairs([a, b, c, d]: [__m512d; 4]) -> [Zmm; 4] {
    unsafe {
        let (xz_ab, yw_ab) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
        let (xz_cd, yw_cd) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
        let first = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
        let second = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
        [
            Zmm(_mm512_permutex2var_pd(xz_ab, first, xz_cd)),
            Zmm(_mm512_permutex2var_pd(yw_ab, first, yw_cd)),
            Zmm(_mm512_permutex2var_pd(xz_ab, second, xz_cd)),
            Zmm(_mm512_permutex2var_pd(yw_ab, second, yw_cd)),
        ]
    }
}

/// Two rows less two others, but for the scalars, which are added.
#[inline(always)]
fn vectors_less(ones: __m512d, others: __m512d) -> __m512d {
    // Products with ±1 are exact: the same bits as of differences and sums.
    unsafe {
        let signs = _mm512_set_pd(1.0, -1.0, -1.0, -1.0, 1.0, -1.0, -1.0, -1.0);
        _mm512_fmadd_pd(others, signs, ones)
    }
}

#[inline(always)]
fn lows(one: __m512d, other: __m512d) -> Packed4s {
    unsafe { Packed4s(_mm512_shuffle_f64x2::<0b01_00_01_00>(one, other)) }
}

#[inline(always)]
fn highs(one: __m512d, other: __m512d) -> Packed4s {
    unsafe { Packed4s(_mm512_shuffle_f64x2::<0b11_10_11_10>(one, other)) }
}

/// Rows 0 and 4, 1 and 5, 2 and 6, 3 and 7 of four columns.
#[inline(always)]
fn pairs_of_rows(columns: [Zmm; 4]) -> [__m512d; 4] {
    unsafe {
        let [x, y, z, w] = [columns[0].0, columns[1].0, columns[2].0, columns[3].0];
        // Pairs x y of lanes 0, 2, 4, 6 and of lanes 1, 3, 5, 7; pairs z w alike.
        let (xy_even, xy_odd) = (_mm512_unpacklo_pd(x, y), _mm512_unpackhi_pd(x, y));
        let (zw_even, zw_odd) = (_mm512_unpacklo_pd(z, w), _mm512_unpackhi_pd(z, w));
        let first = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
        let second = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
        [
            _mm512_permutex2var_pd(xy_even, first, zw_even),
            _mm512_permutex2var_pd(xy_odd, first, zw_odd),
            _mm512_permutex2var_pd(xy_even, second, zw_even),
            _mm512_permutex2var_pd(xy_odd, second, zw_odd),
        ]
    }
}

impl Simd8 for Zmm {
    type Simd4 = Ymm;
    type Simd4Pair = Packed4s;

    #[inline(always)]
    fn load(source: &F64Array<8>) -> Self {
        unsafe { Self(_mm512_load_pd(source.0.as_ptr())) }
    }
    #[inline(always)]
    fn store(self, target: &mut F64Array<8>) {
        unsafe { _mm512_store_pd(target.0.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn columns(rows: [Ymm; 8]) -> [Self; 4] {
        columns_of_pairs(pairs(rows))
    }
    #[inline(always)]
    fn apart(ones: [Ymm; 8], others: [Ymm; 8]) -> [Self; 4] {
        let ([a, b, c, d], other) = (pairs(ones), pairs(others));
        columns_of_pairs([
            vectors_less(a, other[0]),
            vectors_less(b, other[1]),
            vectors_less(c, other[2]),
            vectors_less(d, other[3]),
        ])
    }
    #[inline(always)]
    fn rows(columns: [Self; 4]) -> [Ymm; 8] {
        let [rows_0_4, rows_1_5, rows_2_6, rows_3_7] = pairs_of_rows(columns);
        [
            low(rows_0_4),
            low(rows_1_5),
            low(rows_2_6),
            low(rows_3_7),
            high(rows_0_4),
            high(rows_1_5),
            high(rows_2_6),
            high(rows_3_7),
        ]
    }
    #[inline(always)]
    fn row_pairs(first: [Self; 4], second: [Self; 4]) -> [Packed4s; 8] {
        let [a_0_4, a_1_5, a_2_6, a_3_7] = pairs_of_rows(first);
        let [b_0_4, b_1_5, b_2_6, b_3_7] = pairs_of_rows(second);
        [
            lows(a_0_4, b_0_4),
            lows(a_1_5, b_1_5),
            lows(a_2_6, b_2_6),
            lows(a_3_7, b_3_7),
            highs(a_0_4, b_0_4),
            highs(a_1_5, b_1_5),
            highs(a_2_6, b_2_6),
            highs(a_3_7, b_3_7),
        ]
    }

    fn pointer<T: Task, P: Routine<T>>() -> Pointer<T, Self> {
        #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,avx2")]
        fn call<T: Task, P: Routine<T>>(data: &mut T::Data<'_, Zmm>) {
            P::call::<Zmm>(data);
        }
        Pointer(call::<T, P>)
    }
}

impl Simd4Pair for Packed4s {
    #[inline(always)]
    fn load(packed: &[Packed4; 2]) -> Self {
        unsafe { Self(_mm512_loadu_pd((&raw const *packed).cast())) }
    }
    #[inline(always)]
    fn store(self, packed: &mut [Packed4; 2]) {
        unsafe { _mm512_storeu_pd((&raw mut *packed).cast(), self.0) }
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        unsafe { Self(_mm512_add_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn minus_plus(self, other: Self) -> Self {
        // Products with ±1 are exact: the same bits as of a difference and a sum.
        unsafe {
            let signs = _mm512_set_pd(1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0);
            Self(_mm512_fmadd_pd(other.0, signs, self.0))
        }
    }
}
