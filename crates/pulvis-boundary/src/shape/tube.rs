//! A circular cylinder with two open ends.

use pulvis_math::Vector3;

use super::meridian::{Meridian, Revolved};
use super::{Shape, check_axis, check_length};

/// A circular cylinder with two open ends, a thin shell with particles inside and outside. The axis goes through the
/// wall's reference point, which is the middle of the first end. For a [`Cylinder`](super::Cylinder) without ends the
/// contact loop is faster.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// Unit vector along the axis, from the first end to the second; a positive rotation is by the right-hand rule
    /// about it.
    pub axis: Vector3,
    /// Radius [m].
    pub radius: f64,
    /// Length along the axis [m].
    pub length: f64,
}

impl Revolved for Tube {
    fn meridian(&self) -> Meridian {
        Meridian::between(self.axis, [self.radius, 0.0], [self.radius, self.length], true)
    }
}

impl Shape for Tube {
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
        check_length("radius", self.radius)?;
        check_length("length", self.length)
    }
}
