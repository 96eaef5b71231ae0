//! A plane with a circular hole.

use pulvis_math::Vector3;

use super::meridian::{Meridian, Revolved};
use super::{Shape, check_axis, check_length};

/// A plane without end and without thickness, with a circular hole around the wall's reference point: the floor of a
/// hopper and its orifice. Particles are on both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneWithHole {
    /// Unit normal, the axis of rotations; a pressure moves the plane along it.
    pub normal: Vector3,
    /// Radius of the hole [m].
    pub radius: f64,
}

impl Revolved for PlaneWithHole {
    fn meridian(&self) -> Meridian {
        Meridian {
            axis: self.normal,
            start: [self.radius, 0.0],
            direction: [1.0, 0.0],
            length: f64::INFINITY,
            has_far_side: true,
        }
    }
}

impl Shape for PlaneWithHole {
    fn least_mean_curvature(&self) -> f64 {
        self.meridian().least_mean_curvature()
    }

    fn axis(&self) -> Option<Vector3> {
        Some(self.normal)
    }

    fn distance_from_axis(&self) -> f64 {
        self.meridian().distance_from_axis()
    }

    fn direction_of_push(&self) -> Option<Vector3> {
        Some(self.normal)
    }

    fn check(&self, _largest_radius: f64) -> Result<(), String> {
        check_axis(self.normal)?;
        check_length("radius", self.radius)
    }
}
