//! Operators and functions that all x86-64 types share.

/// Implements the operators of a vector type by its functions, and the functions that work lane by lane in memory.
macro_rules! simd8_operators {
    ($simd8:ident, $mask:ident) => {
        impl Add for $simd8 {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                self.sum(other)
            }
        }
        impl Sub for $simd8 {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                self.difference(other)
            }
        }
        impl Mul for $simd8 {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                self.product(other)
            }
        }
        impl Div for $simd8 {
            type Output = Self;
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                self.quotient(other)
            }
        }
        impl Neg for $simd8 {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.opposite()
            }
        }
        impl AddAssign for $simd8 {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl SubAssign for $simd8 {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
        impl Default for $simd8 {
            #[inline(always)]
            fn default() -> Self {
                Self::splat(0.0)
            }
        }
        impl PartialEq for $simd8 {
            fn eq(&self, other: &Self) -> bool {
                self.to_array() == other.to_array()
            }
        }
        impl fmt::Debug for $simd8 {
            fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                out.debug_tuple(stringify!($simd8)).field(&self.to_array()).finish()
            }
        }
        impl $simd8 {
            #[inline(always)]
            fn to_array(self) -> [f64; 8] {
                let mut lanes = F64Array::default();
                self.store(&mut lanes);
                lanes.0
            }
        }
        impl BitAnd for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                self.both(other)
            }
        }
        impl BitOr for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, other: Self) -> Self {
                self.either(other)
            }
        }
        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                self.neither()
            }
        }
    };
}

/// The functions of [`Real`](crate::Real) that work lane by lane in memory.
macro_rules! lane_by_lane {
    () => {
        #[inline(always)]
        fn from_fn(mut number: impl FnMut(usize) -> f64) -> Self {
            let mut lanes = F64Array::default();
            for (lane, slot) in lanes.0.iter_mut().enumerate() {
                *slot = number(lane);
            }
            Self::load(&lanes)
        }
        #[inline(always)]
        fn lane(self, lane: usize) -> f64 {
            self.to_array()[lane]
        }
        #[inline(always)]
        fn powf(self, exponent: f64) -> Self {
            Self::load(&F64Array(self.to_array().map(|number| $crate::elementary::powf(number, exponent))))
        }
        #[inline(always)]
        fn cbrt(self) -> Self {
            Self::load(&F64Array(self.to_array().map($crate::elementary::cbrt)))
        }
        #[inline(always)]
        fn exp(self) -> Self {
            Self::load(&F64Array(self.to_array().map($crate::elementary::exp)))
        }
        #[inline(always)]
        fn ln(self) -> Self {
            Self::load(&F64Array(self.to_array().map($crate::elementary::ln)))
        }
    };
}

pub(super) use {lane_by_lane, simd8_operators};
