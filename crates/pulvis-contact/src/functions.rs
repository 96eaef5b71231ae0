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
