//! The directions in which space repeats itself.

use pulvis_math::{Real, Vector3};

use crate::Cuboid;

/// Space, periodic in some directions. Directions that are not periodic are unbounded; what keeps
/// particles together there is walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// The block that repeats; along directions that are not periodic it means nothing.
    pub extent: Cuboid,
    /// Whether x, y, z repeat.
    pub periodic: [bool; 3],
}

impl Domain {
    /// Space without any periodic direction.
    pub fn unbounded() -> Self {
        Self::periodic(Vector3::zero(), Vector3::zero(), [false; 3])
    }

    /// A box from `lower` to `upper` [m], which repeats itself in the marked directions.
    pub fn periodic(lower: Vector3, upper: Vector3, periodic: [bool; 3]) -> Self {
        Self { extent: Cuboid { lower, upper }, periodic }
    }

    /// The period along an axis [m], `None` where it is not periodic.
    pub fn period(&self, axis: usize) -> Option<f64> {
        self.periodic[axis].then(|| self.extent.size()[axis])
    }

    /// The position brought back into the box along the periodic directions.
    #[inline]
    pub fn wrapped(&self, mut position: Vector3) -> Vector3 {
        for axis in 0..3 {
            if let Some(period) = self.period(axis) {
                let turns = ((position[axis] - self.extent.lower[axis]) / period).floor();
                *position.component_mut(axis) -= turns * period;
            }
        }
        position
    }

    /// Periods for the contact loop, infinite where there is none.
    pub fn images(&self) -> Images {
        let periods = [0, 1, 2].map(|axis| self.period(axis).unwrap_or(f64::INFINITY));
        Images { periods, any: self.periodic.contains(&true) }
    }
}

/// The nearest-image rule.
#[derive(Clone, Copy, Debug)]
pub struct Images {
    periods: [f64; 3],
    any: bool,
}

impl Images {
    /// The shortest of the vectors that differ from `separation` by whole periods, for separations
    /// below one and a half periods.
    #[inline(always)]
    pub fn nearest<R: Real>(&self, separation: Vector3<R>) -> Vector3<R> {
        if !self.any {
            return separation;
        }
        Vector3::new(
            nearest_along(separation.x, self.periods[0]),
            nearest_along(separation.y, self.periods[1]),
            nearest_along(separation.z, self.periods[2]),
        )
    }

    /// Whether the nearest image of a separation is another one.
    #[inline(always)]
    pub fn are_crossed(&self, separation: Vector3) -> bool {
        let beyond = |axis: usize| separation[axis].abs() > 0.5 * self.periods[axis];
        self.any && (beyond(0) | beyond(1) | beyond(2))
    }
}

/// One component of the nearest image.
#[inline(always)]
fn nearest_along<R: Real>(component: R, period: f64) -> R {
    let (whole, half) = (R::splat(period), R::splat(0.5 * period));
    let lowered = R::select(component.gt(half), component - whole, component);
    R::select(component.lt(-half), component + whole, lowered)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_image_is_never_farther_than_half_a_period() {
        let domain = Domain::periodic(Vector3::zero(), Vector3::new(1.0, 2.0, 3.0), [true, false, true]);
        let images = domain.images();
        let nearest = images.nearest(Vector3::new(0.9, 1.9, -2.0));
        assert!((nearest.x + 0.1).abs() < 1e-15);
        assert_eq!(nearest.y, 1.9);
        assert_eq!(nearest.z, 1.0);
        assert!(
            images.are_crossed(Vector3::new(0.9, 1.9, 0.0))
                && images.are_crossed(Vector3::new(0.0, 0.0, -1.6))
        );
        assert!(!images.are_crossed(Vector3::new(0.4, 1.9, -1.4)));
    }

    #[test]
    fn wrapping_leaves_open_directions_alone() {
        let domain = Domain::periodic(Vector3::zero(), Vector3::new(1.0, 1.0, 1.0), [true, false, false]);
        assert_eq!(domain.wrapped(Vector3::new(-0.25, 7.0, -3.0)), Vector3::new(0.75, 7.0, -3.0));
    }
}
