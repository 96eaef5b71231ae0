//! Functions that laws need, for one contact or eight, without branches: each lane gives the bits of the scalar result.

use pulvis_math::Real;

/// Cube root of a positive number between 1e-58 and 1e57: scaled by exact powers of two into [1, 8), a parabola, and
/// two steps of Halley's method. The error is below 4e-16.
#[inline(always)]
pub fn cbrt<R: Real>(x: R) -> R {
    let (mut x, mut scale) = (x, R::one());
    for exponent in [192, 96, 48, 24, 12, 6, 3] {
        let (power, root) = (two_to(exponent), two_to(exponent / 3));
        let (inverse_power, inverse_root) = (1.0 / power, 1.0 / root);
        let large = x.ge(R::splat(power));
        let small = x.lt(R::splat(inverse_power));
        let factor = R::select(large, R::splat(inverse_power), R::select(small, R::splat(power), R::one()));
        let back = R::select(large, R::splat(root), R::select(small, R::splat(inverse_root), R::one()));
        (x, scale) = (x * factor, scale * back);
    }
    let below = x.lt(R::one());
    x = R::select(below, x * R::splat(8.0), x);
    scale = R::select(below, scale * R::splat(0.5), scale);
    let mut root = R::splat(0.7625) + x * (R::splat(0.2681) - R::splat(0.0147) * x);
    for _ in 0..2 {
        let cube = root * root * root;
        root = root * (cube + R::splat(2.0) * x) / (R::splat(2.0) * cube + x);
    }
    root * scale
}

/// Arc tangent of a number t >= 0: halved three times by t/(1 + √(1 + t²)), then the odd series of eleven terms, whose
/// argument is at most tan(π/16). The error is below 8e-16.
#[inline(always)]
pub fn atan<R: Real>(t: R) -> R {
    let one = R::one();
    let mut t = t;
    for _ in 0..3 {
        t = t / (one + (one + t * t).sqrt());
    }
    let square = t * t;
    let mut series = R::zero();
    for term in (0..11_u32).rev() {
        let sign = if term % 2 == 0 { 1.0 } else { -1.0 };
        series = R::splat(sign / f64::from(2 * term + 1)) + square * series;
    }
    R::splat(8.0) * t * series
}

/// A power of a number that is not negative: products and a square root where the exponent is a small multiple of one
/// half, otherwise lane by lane, which is slow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    exponent: f64,
    /// The whole part of the exponent and whether one half is left, where both are to be had.
    products: Option<(u8, bool)>,
}

impl Power {
    /// The power with this exponent, at least zero.
    pub fn new(exponent: f64) -> Self {
        let whole = exponent.floor();
        let half = exponent - whole == 0.5;
        let fits = whole <= 8.0 && (half || exponent == whole);
        Self { exponent, products: fits.then_some((whole as u8, half)) }
    }

    /// The exponent.
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// `x` to the power.
    #[inline(always)]
    pub fn of<R: Real>(&self, x: R) -> R {
        let Some((whole, half)) = self.products else {
            return x.powf(self.exponent);
        };
        let mut product = if half { x.sqrt() } else { R::one() };
        for _ in 0..whole {
            product = product * x;
        }
        product
    }

    /// ∫ (t^n − y^n) dt from y to x, never negative, for y > 0 and the powers `x_n`, `y_n` of x and y.
    ///
    /// The plain sum of three terms cancels at x = y: written out where the power is known, otherwise a series there.
    #[inline(always)]
    pub fn area_above<R: Real>(&self, x: R, x_n: R, y: R, y_n: R) -> R {
        let number = R::splat;
        let n = self.exponent;
        let apart = x - y;
        if n == 1.0 {
            return number(0.5) * apart * apart;
        }
        if n == 1.5 {
            // With a = √x, b = √y: 2 a⁵ − 5 a² b³ + 3 b⁵ = (a − b)² (2 a³ + 4 a² b + 6 a b² + 3 b³), over 5.
            let (a, b) = (x.sqrt(), y.sqrt());
            let cubes = (number(2.0) * a + number(4.0) * b) * x + (number(6.0) * a + number(3.0) * b) * y;
            return number(0.2) * (a - b) * (a - b) * cubes;
        }
        let sum = (number(1.0 / (n + 1.0)) * x_n - y_n) * x + number(n / (n + 1.0)) * y_n * y;
        let step = apart / y.max(number(f64::MIN_POSITIVE));
        let near = step.abs().lt(number(0.01));
        let mut series = R::zero();
        for term in (0..5_i32).rev() {
            // The binomial coefficients of (1 + step)^(n + 1), one over the next.
            let ratio = (n - 1.0 - f64::from(term)) / f64::from(term + 3);
            series = R::one() + number(ratio) * step * series;
        }
        let square = number(0.5 * n) * y_n * y * step * step;
        R::select(near, square * series, sum.max(R::zero()))
    }

    /// The number whose power is `y`; the exponent must not be zero.
    #[inline(always)]
    pub fn inverse<R: Real>(&self, y: R) -> R {
        match self.products {
            Some((1, false)) => y,
            Some((1, true)) => cbrt(y * y).keep_where(y.gt(R::zero())),
            Some((2, false)) => y.sqrt(),
            _ => y.powf(1.0 / self.exponent),
        }
    }
}

/// Cube root of a number from 1/2 to 1: a ratio of two lines, and two steps of Halley's method. The error is below 5e-16.
#[inline(always)]
pub fn cbrt_near_one<R: Real>(x: R) -> R {
    let two = R::splat(2.0);
    let mut root = (R::one() + two * x) / (two + x);
    for _ in 0..2 {
        let cube = root * root * root;
        root = root * (cube + two * x) / (two * cube + x);
    }
    root
}

/// 2 to a small power.
const fn two_to(exponent: u64) -> f64 {
    f64::from_bits((1023 + exponent) << 52)
}

#[cfg(test)]
mod tests {
    use pulvis_math::elementary;

    use super::*;

    #[test]
    fn the_arc_tangent_is_good_to_round_off_over_all_sizes() {
        for exponent in -20..20 {
            for mantissa in [1.0, 1.7, 2.0, 3.1, 5.3, 9.9] {
                let t: f64 = mantissa * elementary::powi(10.0, exponent);
                // Ten roundings.
                assert!((atan(t) / elementary::atan(t) - 1.0).abs() < 8e-16, "{t}: {}", atan(t));
            }
        }
        assert_eq!(atan(0.0), 0.0);
    }

    #[test]
    fn powers_agree_with_the_elementary_function_and_are_inverted() {
        for exponent in [0.0, 0.5, 1.0, 1.3, 1.5, 2.0, 2.5, 5.0, 8.5, 17.0] {
            let power = Power::new(exponent);
            for x in [0.0, 3e-9, 1.0, 7.0] {
                let expected = elementary::powf(x, exponent);
                let found = power.of(x);
                // One rounding a product.
                assert!((found - expected).abs() <= 1e-15 * expected, "{x}^{exponent}: {found}");
                if exponent > 0.0 {
                    assert!((power.inverse(found) - x).abs() <= 2e-15 * x, "{x}^{exponent}");
                }
            }
        }
    }

    #[test]
    fn the_cube_root_near_one_is_good_to_round_off() {
        for step in 0..=1000 {
            let x = 0.5 + 0.5e-3 * f64::from(step);
            let error = cbrt_near_one(x) / elementary::cbrt(x) - 1.0;
            assert!(error.abs() < 5e-16, "{x}: {error}");
        }
    }

    #[test]
    fn areas_above_a_power_neither_cancel_nor_jump() {
        for exponent in [1.0, 1.3, 1.5, 2.0, 2.9] {
            let power = Power::new(exponent);
            for step in [-0.9, -0.5, -0.0101, -0.0099, -1e-5, 1e-7, 1e-3, 0.0099, 0.0101, 0.5, 3.0] {
                let (x, y) = (3e-6 * (1.0 + step), 3e-6);
                let found = power.area_above(x, power.of(x), y, power.of(y));
                // The mean of the second derivative: Gauss-Legendre integration of n (1 + s step)^(n − 1) (1 − s) from 0
                // to 1, in a hundred parts of two points.
                let mean: f64 = (0..200)
                    .map(|index| {
                        let side = if index % 2 == 0 { -1.0 } else { 1.0 } / 3.0_f64.sqrt();
                        let s = (f64::from(index / 2) + 0.5 + 0.5 * side) / 100.0;
                        exponent * elementary::powf(1.0 + s * step, exponent - 1.0) * (1.0 - s) / 200.0
                    })
                    .sum();
                let expected = mean * step * step * power.of(y) * y;
                // Rounding of x and y, and the plain sum where it begins: 1e-16 of terms 1e4 times greater.
                let allowed = 2e-7 * step * step + 4e-12 + 8.0 * f64::EPSILON / step.abs();
                assert!((found / expected - 1.0).abs() < allowed, "{exponent}, {step}: {found} {expected}");
            }
        }
    }

    #[test]
    fn the_cube_root_is_good_to_round_off_over_all_sizes() {
        for exponent in -57..57 {
            for mantissa in [1.0, 1.7, 2.0, 3.1, 5.3, 9.9] {
                let x: f64 = mantissa * elementary::powi(10.0, exponent);
                let root = cbrt(x);
                // The cube of a correctly rounded root errs by up to three times its half unit in the last place.
                assert!((root * root * root / x - 1.0).abs() < 8.0 * f64::EPSILON, "{x}: {root}");
            }
        }
    }
}
