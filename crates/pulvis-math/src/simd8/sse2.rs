//! Eight numbers in four 128-bit registers, which every x86-64 processor has.

use std::arch::x86_64::*;
use std::fmt;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};

use super::operators::{lane_by_lane, simd8_operators};
use super::{Kernel, Packed4, Pointer, Routine, Simd4, Simd8, Task, side_by_side};
use crate::array::F64Array;
use crate::real::{Mask, Real};

/// The kernel compiled for the instructions of every x86-64 processor.
#[inline(never)]
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Xmm4>()
}

/// Four numbers.
#[derive(Clone, Copy)]
pub(super) struct Xmm2(__m128d, __m128d);

/// Eight numbers, in the order of their lanes.
#[derive(Clone, Copy)]
pub(super) struct Xmm4(__m128d, __m128d, __m128d, __m128d);

/// All ones or all zeros a lane.
#[derive(Clone, Copy)]
pub(super) struct Mask4(__m128d, __m128d, __m128d, __m128d);

// SAFETY of all blocks below: SSE2 is part of x86-64, and loads and stores are of aligned memory that
// is borrowed.

/// One instruction on both halves of a row.
macro_rules! halves {
    ($function:ident($($operand:expr),*)) => {
        unsafe { Self($function($($operand.0),*), $function($($operand.1),*)) }
    };
}

impl Simd4 for Xmm2 {
    #[inline(always)]
    fn load(packed: &Packed4) -> Self {
        let start: *const f64 = (&raw const *packed).cast();
        unsafe { Self(_mm_load_pd(start), _mm_load_pd(start.add(2))) }
    }
    #[inline(always)]
    fn store(self, packed: &mut Packed4) {
        let start: *mut f64 = (&raw mut *packed).cast();
        unsafe {
            _mm_store_pd(start, self.0);
            _mm_store_pd(start.add(2), self.1);
        }
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        unsafe { Self(_mm_set1_pd(value), _mm_set1_pd(value)) }
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        halves!(_mm_add_pd(self, other))
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        halves!(_mm_sub_pd(self, other))
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        halves!(_mm_mul_pd(self, other))
    }
    #[inline(always)]
    fn with_scalar_of(self, other: Self) -> Self {
        unsafe { Self(self.0, _mm_shuffle_pd::<0b10>(self.1, other.1)) }
    }
}

simd8_operators!(Xmm4, Mask4);

/// One instruction on all quarters.
macro_rules! quarters {
    ($wrap:ident, $function:ident($($operand:expr),*)) => {
        unsafe {
            $wrap(
                $function($($operand.0),*),
                $function($($operand.1),*),
                $function($($operand.2),*),
                $function($($operand.3),*),
            )
        }
    };
}

impl Xmm4 {
    #[inline(always)]
    fn sum(self, other: Self) -> Self {
        quarters!(Self, _mm_add_pd(self, other))
    }
    #[inline(always)]
    fn difference(self, other: Self) -> Self {
        quarters!(Self, _mm_sub_pd(self, other))
    }
    #[inline(always)]
    fn product(self, other: Self) -> Self {
        quarters!(Self, _mm_mul_pd(self, other))
    }
    #[inline(always)]
    fn quotient(self, other: Self) -> Self {
        quarters!(Self, _mm_div_pd(self, other))
    }
    #[inline(always)]
    fn opposite(self) -> Self {
        let sign = Self::splat(-0.0);
        quarters!(Self, _mm_xor_pd(self, sign))
    }
}

impl Mask4 {
    #[inline(always)]
    fn both(self, other: Self) -> Self {
        quarters!(Self, _mm_and_pd(self, other))
    }
    #[inline(always)]
    fn either(self, other: Self) -> Self {
        quarters!(Self, _mm_or_pd(self, other))
    }
    #[inline(always)]
    fn neither(self) -> Self {
        let ones = Self::splat(true);
        quarters!(Self, _mm_xor_pd(self, ones))
    }
}

impl fmt::Debug for Mask4 {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "Mask4({:08b})", self.bits())
    }
}

impl Mask for Mask4 {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        let bits = if value { -1 } else { 0 };
        unsafe {
            let quarter = _mm_castsi128_pd(_mm_set1_epi64x(bits));
            Self(quarter, quarter, quarter, quarter)
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
        unsafe {
            (_mm_movemask_pd(self.0)
                | _mm_movemask_pd(self.1) << 2
                | _mm_movemask_pd(self.2) << 4
                | _mm_movemask_pd(self.3) << 6) as u32
        }
    }
}

impl Real for Xmm4 {
    type Mask = Mask4;
    const LANES: usize = 8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        unsafe {
            let quarter = _mm_set1_pd(value);
            Self(quarter, quarter, quarter, quarter)
        }
    }
    lane_by_lane!();
    #[inline(always)]
    fn sqrt(self) -> Self {
        quarters!(Self, _mm_sqrt_pd(self))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        let sign = Self::splat(-0.0);
        quarters!(Self, _mm_andnot_pd(sign, self))
    }
    // The instructions answer with the second operand for equal numbers and for NaN, as the trait says.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        quarters!(Self, _mm_min_pd(self, other))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        quarters!(Self, _mm_max_pd(self, other))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Mask4 {
        quarters!(Mask4, _mm_cmplt_pd(self, other))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Mask4 {
        quarters!(Mask4, _mm_cmple_pd(self, other))
    }
    #[inline(always)]
    fn gt(self, other: Self) -> Mask4 {
        quarters!(Mask4, _mm_cmpgt_pd(self, other))
    }
    #[inline(always)]
    fn ge(self, other: Self) -> Mask4 {
        quarters!(Mask4, _mm_cmpge_pd(self, other))
    }
    #[inline(always)]
    fn select(mask: Mask4, then: Self, otherwise: Self) -> Self {
        let (kept, other) =
            (quarters!(Self, _mm_and_pd(mask, then)), quarters!(Self, _mm_andnot_pd(mask, otherwise)));
        quarters!(Self, _mm_or_pd(kept, other))
    }
}

/// The even and the odd lanes of two pairs of numbers.
macro_rules! even_and_odd {
    ($one:expr, $other:expr) => {
        (_mm_unpacklo_pd($one, $other), _mm_unpackhi_pd($one, $other))
    };
}

impl Simd8 for Xmm4 {
    type Simd4 = Xmm2;
    type Simd4Pair = [Self::Simd4; 2];

    #[inline(always)]
    fn load(source: &F64Array<8>) -> Self {
        let start = source.0.as_ptr();
        unsafe {
            Self(
                _mm_load_pd(start),
                _mm_load_pd(start.add(2)),
                _mm_load_pd(start.add(4)),
                _mm_load_pd(start.add(6)),
            )
        }
    }
    #[inline(always)]
    fn store(self, target: &mut F64Array<8>) {
        let start = target.0.as_mut_ptr();
        unsafe {
            _mm_store_pd(start, self.0);
            _mm_store_pd(start.add(2), self.1);
            _mm_store_pd(start.add(4), self.2);
            _mm_store_pd(start.add(6), self.3);
        }
    }
    #[inline(always)]
    fn columns(rows: [Xmm2; 8]) -> [Self; 4] {
        let [a, b, c, d, e, f, g, h] = rows;
        unsafe {
            let ((x0, y0), (z0, w0)) = (even_and_odd!(a.0, b.0), even_and_odd!(a.1, b.1));
            let ((x1, y1), (z1, w1)) = (even_and_odd!(c.0, d.0), even_and_odd!(c.1, d.1));
            let ((x2, y2), (z2, w2)) = (even_and_odd!(e.0, f.0), even_and_odd!(e.1, f.1));
            let ((x3, y3), (z3, w3)) = (even_and_odd!(g.0, h.0), even_and_odd!(g.1, h.1));
            [Self(x0, x1, x2, x3), Self(y0, y1, y2, y3), Self(z0, z1, z2, z3), Self(w0, w1, w2, w3)]
        }
    }
    #[inline(always)]
    fn rows(columns: [Self; 4]) -> [Xmm2; 8] {
        let [x, y, z, w] = columns;
        unsafe {
            let ((a0, b0), (a1, b1)) = (even_and_odd!(x.0, y.0), even_and_odd!(z.0, w.0));
            let ((c0, d0), (c1, d1)) = (even_and_odd!(x.1, y.1), even_and_odd!(z.1, w.1));
            let ((e0, f0), (e1, f1)) = (even_and_odd!(x.2, y.2), even_and_odd!(z.2, w.2));
            let ((g0, h0), (g1, h1)) = (even_and_odd!(x.3, y.3), even_and_odd!(z.3, w.3));
            [
                Xmm2(a0, a1),
                Xmm2(b0, b1),
                Xmm2(c0, c1),
                Xmm2(d0, d1),
                Xmm2(e0, e1),
                Xmm2(f0, f1),
                Xmm2(g0, g1),
                Xmm2(h0, h1),
            ]
        }
    }

    #[inline(always)]
    fn row_pairs(first: [Self; 4], second: [Self; 4]) -> [Self::Simd4Pair; 8] {
        side_by_side(Self::rows(first), Self::rows(second))
    }

    fn pointer<T: Task, P: Routine<T>>() -> Pointer<T, Self> {
        #[inline(never)]
        fn call<T: Task, P: Routine<T>>(data: &mut T::Data<'_, Xmm4>) {
            P::call::<Xmm4>(data);
        }
        Pointer(call::<T, P>)
    }
}
