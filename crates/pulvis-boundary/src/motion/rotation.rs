//! A wall that rotates about its axis.

use pulvis_math::{Dimension, Vector3};

use super::{Motion, Parameter};

/// Constant angular velocity about the axis of the wall's shape. The surface stays where it is and drags on
/// particles that touch it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rotation {
    /// Angular velocity, by the right-hand rule about the axis [rad/s].
    pub angular_velocity: f64,
}

impl Motion for Rotation {
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![Parameter::number("angular_velocity", Dimension::RATE, &mut self.angular_velocity)]
    }

    fn needs_axis(&self) -> bool {
        true
    }

    fn constant_velocity(&self) -> Option<Vector3> {
        Some(Vector3::zero())
    }

    fn angular_velocity(&self) -> f64 {
        self.angular_velocity
    }
}
