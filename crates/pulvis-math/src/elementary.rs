//! Elementary functions that give the same bits on every machine.
//!
//! The standard library leaves `f64::sin`, `f64::powf` and their like to the C library, which has several
//! versions of each and takes one by the processor it finds: the last bit depends on the machine. The functions
//! here are made of additions, multiplications, divisions and square roots, which IEEE 754 fixes to the last bit.
//! All results that a simulation depends on are computed with them; `clippy.toml` refuses the standard ones.
//! `f64::sqrt` and `f64::mul_add` are rounded correctly everywhere and stay.
//!
//! # Errors
//! At most 1 unit in the last place, 2 for [`atan2`], [`asinh`], [`cosh`], [`sinh`] and [`tanh`]. Arguments outside of a
//! function's domain give NaN, as in the standard library.
//!
//! # Source
//! The [libm](https://docs.rs/libm) crate, which carries the functions of FreeBSD, musl and CORE-MATH over to Rust.

/// Defines functions of one argument by their name in libm.
macro_rules! of_one_argument {
    ($($(#[$meta:meta])* $name:ident = $libm:ident;)*) => {$(
        $(#[$meta])*
        #[inline]
        pub fn $name(x: f64) -> f64 {
            libm::$libm(x)
        }
    )*};
}

of_one_argument! {
    /// Sine of an angle x [rad].
    sin = sin;
    /// Cosine of an angle x [rad].
    cos = cos;
    /// Tangent of an angle x [rad].
    tan = tan;
    /// Angle in [−π/2, π/2] whose sine is x [rad]; NaN for |x| > 1.
    asin = asin;
    /// Angle in [0, π] whose cosine is x [rad]; NaN for |x| > 1.
    acos = acos;
    /// Angle in [−π/2, π/2] whose tangent is x [rad].
    atan = atan;
    /// Hyperbolic sine of x.
    sinh = sinh;
    /// Hyperbolic cosine of x.
    cosh = cosh;
    /// Hyperbolic tangent of x.
    tanh = tanh;
    /// The number whose hyperbolic sine is x.
    asinh = asinh;
    /// e to the power x.
    exp = exp;
    /// e to the power x, less 1; accurate near 0.
    exp_m1 = expm1;
    /// Natural logarithm of x; NaN for x < 0.
    ln = log;
    /// Natural logarithm of 1 + x, accurate near 0; NaN for x < −1.
    ln_1p = log1p;
    /// Logarithm of x to the base 10; NaN for x < 0.
    log10 = log10;
    /// Cube root of x, rounded correctly.
    cbrt = cbrt;
}

/// Sine and cosine of an angle x [rad], the same bits as of [`sin`] and [`cos`].
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// Angle of the point (x, y) from the positive x axis, in [−π, π] \[rad\].
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Length √(x² + y²) without overflow of the squares.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// `base` to the power `exponent`; NaN for a negative base and an exponent that is no integer.
#[inline]
pub fn powf(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// `base` to the power `exponent`, by repeated squaring from the lowest bit of the exponent on; for a negative
/// exponent the reciprocal of the positive power (0 where that overflows).
///
/// `f64::powi` promises no order of its multiplications, so that the result may change with the compiler and its
/// level of optimisation. The error grows with the exponent: each multiplication adds half a unit in the last place.
#[inline]
pub fn powi(base: f64, exponent: i32) -> f64 {
    let mut remaining = exponent.unsigned_abs();
    let (mut square, mut product) = (base, 1.0);
    loop {
        if remaining & 1 == 1 {
            product *= square;
        }
        remaining >>= 1;
        if remaining == 0 {
            break;
        }
        square *= square;
    }
    if exponent < 0 { 1.0 / product } else { product }
}
