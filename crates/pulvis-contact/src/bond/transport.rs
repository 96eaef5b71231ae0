//! How the vectors of a bond turn with the two bodies.

use pulvis_math::{Real, Vector3};

/// The turn of a pair in a step: that of its normal, and about the normal that of both bodies on average.
///
/// Vectors keep their length to round-off; a rigid rotation of the pair turns them with it, to second order in the step.
/// Derived here: the rotation that takes the old normal n₀ into the new one n without a turn about it, by c = n₀·n and
/// a = n₀ × n, v ← c v + a × v + a (a·v)/(1 + c); then the one about n by the tangent t of half of its angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transport<R: Real> {
    normal: Vector3<R>,
    /// n₀·n.
    cosine: R,
    /// n₀ × n.
    axis: Vector3<R>,
    /// 1/(1 + n₀·n).
    inverse: R,
    /// Tangent of half of the angle about the normal.
    half_twist: R,
    /// 1/(1 + t²).
    inverse_twist: R,
}

impl<R: Real> Transport<R> {
    /// From the `old` normal, whose length does not count, to the new one, and about it by `twist` [rad].
    #[inline(always)]
    pub(super) fn new(old: Vector3<R>, normal: Vector3<R>, twist: R) -> Self {
        let one = R::one();
        let old = old * (one / old.norm());
        let cosine = old.dot(normal);
        // The tangent of half of the angle, of which two terms are enough in a step.
        let half = R::splat(0.5) * twist;
        let half_twist = half * (one + R::splat(1.0 / 3.0) * (half * half));
        Self {
            normal,
            cosine,
            axis: old.cross(normal),
            // A normal that turns round within a step has no way to do so; the vector is then left as it is.
            inverse: one / (one + cosine).max(R::splat(f64::MIN_POSITIVE)),
            half_twist,
            inverse_twist: one / (one + half_twist * half_twist),
        }
    }

    /// A vector that turned with the pair.
    #[inline(always)]
    pub(super) fn of(&self, v: Vector3<R>) -> Vector3<R> {
        let v = v * self.cosine + self.axis.cross(v) + self.axis * (self.axis.dot(v) * self.inverse);
        let t = self.half_twist;
        let square = t * t;
        let along = self.normal * (R::splat(2.0) * square * self.normal.dot(v));
        let turned = v * (R::one() - square) + self.normal.cross(v) * (R::splat(2.0) * t) + along;
        turned * self.inverse_twist
    }
}
