//! A flat disk.

use pulvis_math::Vector3;

use super::meridian::{Meridian, Revolved};
use super::{Shape, check_axis, check_length};

/// A flat disk without thickness around the wall's reference point, with particles on both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    /// Unit normal, the axis of rotations; a pressure moves the disk along it.
    pub normal: Vector3,
    /// Radius [m].
    pub radius: f64,
}

impl Revolved for Disk {
    fn meridian(&self) -> Meridian {
        Meridian::between(self.normal, [0.0, 0.0], [self.radius, 0.0], false)
    }
}

impl Shape for Disk {
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
