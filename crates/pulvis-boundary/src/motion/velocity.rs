//! A wall that moves with a given velocity.

use pulvis_math::{Dimension, Vector3};

use super::{Motion, Parameter};

/// Constant velocity; the part along the wall's normal moves the plane, the part within the plane
/// drags on particles that touch it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Velocity {
    /// Velocity [m/s].
    pub velocity: Vector3,
}

impl Motion for Velocity {
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![Parameter::vector("velocity", Dimension::VELOCITY, &mut self.velocity)]
    }

    fn constant_velocity(&self) -> Option<Vector3> {
        Some(self.velocity)
    }

    fn displacement(&self, before: Vector3, _time: f64, time_step: f64) -> Vector3 {
        before + self.velocity * time_step
    }

    fn velocity(&self, _time: f64) -> Vector3 {
        self.velocity
    }
}
