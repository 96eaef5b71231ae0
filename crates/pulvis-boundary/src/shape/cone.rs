//! A cone or the frustum of a cone, with ends.

use pulvis_math::Vector3;

use super::meridian::{Meridian, Revolved};
use super::{Shape, check_axis, check_length};

/// A cone or the frustum of a cone, a thin shell with particles inside and outside. The axis goes through the wall's
/// reference point, which is the middle of the first end.
///
/// The principal curvature around the axis is cos θ/r at the distance r from the axis, θ half the angle at the tip, as
/// differential geometry has it; that along the surface is zero. Contacts take the mean of both, as with a
/// [`Cylinder`](super::Cylinder).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Unit vector along the axis, from the first end to the second; a positive rotation is by the right-hand rule
    /// about it.
    pub axis: Vector3,
    /// Radii at both ends [m]; one may be zero, which is a tip.
    pub radii: [f64; 2],
    /// Distance of the ends along the axis [m].
    pub height: f64,
}

impl Revolved for Cone {
    fn meridian(&self) -> Meridian {
        let [first, second] = self.radii;
        Meridian::between(self.axis, [first, 0.0], [second, self.height], true)
    }
}

impl Shape for Cone {
    fn least_mean_curvature(&self) -> f64 {
        self.meridian().least_mean_curvature()
    }

    fn axis(&self) -> Option<Vector3> {
        Some(self.axis)
    }

    fn distance_from_axis(&self) -> f64 {
        self.meridian().distance_from_axis()
    }

    fn check(&self, _largest_radius: f64) -> Result<(), String> {
        check_axis(self.axis)?;
        check_length("height", self.height)?;
        let [first, second] = self.radii;
        if first.min(second) >= 0.0 && first.max(second) > 0.0 && first.max(second).is_finite() {
            return Ok(());
        }
        Err(format!("its radii are {first} m and {second} m, not lengths of which one is greater than zero"))
    }
}
