//! A plane without end.

use pulvis_math::{Real, Vector3};

use super::{EdgelessShape, Shape, Surface, UNIT, is_unit};

/// A plane through the wall's reference point, without end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal, towards the particles.
    pub normal: Vector3,
}

impl EdgelessShape for Plane {
    #[inline(always)]
    fn surface<R: Real>(&self, point: Vector3, centre: Vector3<R>) -> Surface<R> {
        let normal = Vector3::<R>::splat(self.normal);
        Surface {
            normal,
            distance: centre.dot(normal) - R::splat(point.dot(self.normal)),
            mean_curvature: R::zero(),
            turning: R::zero(),
        }
    }

    #[inline(always)]
    fn normal_rate<R: Real>(&self, _surface: &Surface<R>, _velocity: Vector3<R>) -> Option<Vector3<R>> {
        None
    }
}

impl Shape for Plane {
    fn least_mean_curvature(&self) -> f64 {
        0.0
    }

    fn approach(&self, displacement: Vector3) -> f64 {
        displacement.dot(self.normal).abs()
    }

    fn axis(&self) -> Option<Vector3> {
        None
    }

    fn direction_of_push(&self) -> Option<Vector3> {
        Some(self.normal)
    }

    fn is_invariant_along(&self, direction: Vector3) -> bool {
        self.normal.dot(direction).abs() <= UNIT
    }

    fn check(&self, _largest_radius: f64) -> Result<(), String> {
        if is_unit(self.normal) {
            return Ok(());
        }
        let Vector3 { x, y, z } = self.normal;
        Err(format!("its normal ({x}, {y}, {z}) is not of length 1"))
    }
}
