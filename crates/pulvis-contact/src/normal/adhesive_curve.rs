//! The one curve that all adhesive elastic spheres share after Johnson, Kendall and Roberts.
//!
//! With y = √(a/a_sep) >= 1, a_sep = (π Γ R²/(8 E*))^(1/3), s = a_sep²/R and the pull-off force F_c = (3/2) π Γ R it is
//! δ = s (y⁴ − 4 y), F = (F_c/9) y³ (y³ − 6), U = (F_c s/9) y⁴ (0.4 y⁶ − 4 y³ + 6), from the break of the neck, y = 1, on.
//!
//! # Source
//! Derived from K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. Lond. A 324, 301 (1971).

use pulvis_math::Real;

/// Loss at snap-in over F_c s/9, −U at y³ = 4: 3.6 · 4^(4/3).
pub(super) const SNAP_IN: f64 = 22.858_575_148_342_073;
/// Loss at snap-off over F_c s/9, U at y = 1.
pub(super) const SNAP_OFF: f64 = 2.4;

/// Force over F_c/9, from y³.
#[inline(always)]
pub(super) fn force<R: Real>(cube: R) -> R {
    cube * (cube - R::splat(6.0))
}

/// Distance of the force from −2 F_c, over F_c/9, from y³: what friction refers to.
#[inline(always)]
pub(super) fn friction_reference<R: Real>(cube: R) -> R {
    let above = cube - R::splat(3.0);
    above * above + R::splat(9.0)
}

/// Energy over F_c s/9, of the surfaces that touch included, from y and y³.
#[inline(always)]
pub(super) fn energy<R: Real>(y: R, cube: R) -> R {
    (y * cube) * (R::splat(0.4) * (cube * cube) - R::splat(4.0) * cube + R::splat(6.0))
}

/// y = 1 + z for z² (z² + 4 z + 6) = e = 3 + δ/s: z does not cancel near the double root at separation.
///
/// The start errs by less than 0.32 %, each step of Halley's method cubes that: after two it is round-off.
#[inline(always)]
pub(super) fn invert<R: Real>(e: R) -> R {
    let number = R::splat;
    let q = e.sqrt();
    let bent = number(1.468) * q;
    let r = (number(4.0) + bent).sqrt();
    let w = q - bent / (r * (r + number(2.0)));
    let mut z = w / (R::one() + (R::one() + w).sqrt());
    for _ in 0..2 {
        let y = z + R::one();
        let p = z * z * (z * (z + number(4.0)) + number(6.0)) - e;
        let d = z * (z * (z + number(3.0)) + number(3.0));
        z -= number(2.0) * p * d / (number(8.0) * d * d - number(3.0) * p * y * y);
    }
    z + R::one()
}

#[cfg(test)]
mod tests {
    use pulvis_math::elementary;

    use super::*;

    #[test]
    fn the_inversion_is_good_to_round_off_from_separation_to_deep_contact() {
        for exponent in -30..=25 {
            for mantissa in [1.0, 2.3, 4.9, 7.7] {
                let e: f64 = mantissa * elementary::powi(10.0, exponent);
                let z = invert(e) - 1.0;
                let error = z * z * (z * z + 4.0 * z + 6.0) / e - 1.0;
                // z itself is taken from y = 1 + z here, which rounds it to one unit of 1.
                assert!(error.abs() < 4e-15 + 4.0 * f64::EPSILON / z.abs().max(1e-16), "{e}: {error}");
            }
        }
    }
}
