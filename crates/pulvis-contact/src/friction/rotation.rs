//! How springs of the tangent plane turn with the contact.

use pulvis_math::{Mask, Real, Vector3};

/// How the sliding and rolling springs follow the contact when it turns in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpringRotation {
    /// Projected into the tangent plane and stretched back to its old length (Luding 2008, eq. 17).
    /// The length is kept, the direction drifts at first order in the step: projection shortens only
    /// the part along the way that the normal turns, stretching lengthens both.
    #[default]
    Rescale,
    /// Projected into the tangent plane only (LIGGGHTS).
    Project,
    /// Turned with the line of centres, and about it with the mean angular velocity of the bodies (YADE): the
    /// spring of a stuck pair that turns as one body turns with it, to second order in the step.
    Twist,
    /// Only the part along the line of centres that the present step brings is removed (MercuryDPM).
    Rate,
}

/// A spring before the step in the tangent plane of the present normal, at the length that it had.
#[inline(always)]
pub(crate) fn rescaled<R: Real>(spring: Vector3<R>, normal: Vector3<R>) -> Vector3<R> {
    let along = spring.dot(normal);
    restored(spring - normal * along, along * along)
}

/// A spring before the step turned with the normal, which has changed by `turned`, and about it by the
/// mean turn `twist` of the bodies.
#[inline(always)]
pub(crate) fn twisted<R: Real>(
    spring: Vector3<R>,
    normal: Vector3<R>,
    turned: Vector3<R>,
    twist: R,
) -> Vector3<R> {
    // Projection loses half the square of the turn along the way of the normal.
    let lost = turned * (R::splat(0.5) * turned.dot(spring));
    let projected = (spring + lost + normal.cross(spring) * twist).tangential_to(normal);
    restored(projected, spring.norm_squared() - projected.norm_squared())
}

/// Beyond this t, √(1 + t) is not taken from its series.
const SERIES_ENDS: f64 = 8e-6;

/// A spring stretched, or shortened, to the length before projection: the square of its length has lost
/// `missing`. The factor is √(1 + t), t = missing/|spring|², and normals turn little in a step.
// A function and not a closure: closures are not inlined by force, and out of line they are compiled
// without the vector instructions of the loop that calls them.
#[inline(always)]
fn restored<R: Real>(spring: Vector3<R>, missing: R) -> Vector3<R> {
    let remaining = spring.norm_squared();
    // No spring: no factor.
    let t = (missing / remaining).keep_where(remaining.gt(R::zero()));
    // The next term, t³/16, is below 2⁻⁵⁴.
    let mut factor = R::one() + t * (R::splat(0.5) - t * R::splat(0.125));
    let far = t.abs().gt(R::splat(SERIES_ENDS));
    if far.any() {
        factor = R::select(far, (R::one() + t).sqrt(), factor);
    }
    spring * factor
}

#[cfg(test)]
mod tests {
    use pulvis_math::elementary;

    use super::*;

    /// A spring of length `length` that leans by `angle` out of the plane at right angles to z.
    fn leaning(length: f64, angle: f64) -> Vector3 {
        Vector3::new(length * elementary::cos(angle), 0.0, length * elementary::sin(angle))
    }

    const NORMAL: Vector3 = Vector3::new(0.0, 0.0, 1.0);

    #[test]
    fn a_spring_is_turned_into_the_tangent_plane_at_its_length() {
        // From angles that change nothing over those of the series to those of the square root.
        for exponent in -12..=0 {
            for mantissa in [1.0, 2.1, 4.7] {
                let angle = mantissa * elementary::powi(10.0, exponent);
                if angle < 1.5 {
                    let spring = rescaled(leaning(3e-7, angle), NORMAL);
                    assert_eq!((spring.y, spring.z), (0.0, 0.0));
                    assert!((spring.x / 3e-7 - 1.0).abs() < 4.0 * f64::EPSILON, "{angle}: {}", spring.x);
                }
            }
        }
    }

    #[test]
    fn series_and_square_root_agree_where_one_takes_over_from_the_other() {
        for t in [0.999 * SERIES_ENDS, 1.001 * SERIES_ENDS, -0.999 * SERIES_ENDS, -1.001 * SERIES_ENDS] {
            let spring = restored(Vector3::new(2.0, 0.0, 0.0), 4.0 * t);
            assert!((spring.x / (2.0 * (1.0 + t).sqrt()) - 1.0).abs() < 2.0 * f64::EPSILON, "{t}");
        }
    }

    #[test]
    fn a_spring_that_lies_along_the_normal_or_is_none_stays_finite() {
        for spring in [Vector3::zero(), Vector3::new(0.0, 0.0, 1e-6)] {
            assert_eq!(rescaled(spring, NORMAL), Vector3::zero());
            assert_eq!(twisted(spring, NORMAL, Vector3::zero(), 0.1), Vector3::zero());
        }
    }
}
