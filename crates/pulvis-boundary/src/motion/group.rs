//! How groups of particles are led.

use pulvis_math::{Dimension, Vector3, elementary};

use super::{Cosine, InvalidMotion, Motion, Parameter, Velocity};

/// Rotation as a rigid body about an axis that stands still.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisRotation {
    /// A point of the axis [m].
    pub point: Vector3,
    /// Direction of the axis, of any length but zero.
    pub axis: Vector3,
    /// Angular velocity, by the right-hand rule about the axis [rad/s].
    pub angular_velocity: f64,
}

impl Motion for AxisRotation {
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::vector("point", Dimension::LENGTH, &mut self.point),
            Parameter::vector("axis", Dimension::NONE, &mut self.axis),
            Parameter::number("angular_velocity", Dimension::RATE, &mut self.angular_velocity),
        ]
    }

    fn check(&self) -> Result<(), InvalidMotion> {
        let square = self.axis.norm_squared();
        if square > 0.0 && square.is_finite() {
            return Ok(());
        }
        Err(InvalidMotion {
            parameter: "axis",
            found: "the axis has no direction".to_owned(),
            expected: "a direction, for example [0, 0, 1]".to_owned(),
        })
    }
}

impl AxisRotation {
    /// The angular velocity as a vector [rad/s].
    pub fn vector(&self) -> Vector3 {
        self.axis * (self.angular_velocity / self.axis.norm())
    }

    /// Where a position is carried in a time [s], as the way to there \[m\]: (R − 1) r with r from the axis, by the formula of
    /// Rodrigues. 1 − cos as 2 sin² of the half, which is exact for small angles too.
    pub fn way(&self, position: Vector3, time: f64) -> Vector3 {
        let unit = self.axis * (1.0 / self.axis.norm());
        let (angle, arm) = (self.angular_velocity * time, position - self.point);
        let half = elementary::sin(0.5 * angle);
        let across = unit.cross(arm);
        across * elementary::sin(angle) + unit.cross(across) * (2.0 * half * half)
    }

    /// The velocity of what is carried along at a position [m/s].
    pub fn velocity_at(&self, position: Vector3) -> Vector3 {
        self.vector().cross(position - self.point)
    }
}

/// How a group of particles moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum GroupMotion {
    /// As forces move its particles.
    #[default]
    Free,
    /// It stands still, and its particles do not turn.
    Fixed,
    /// It moves with a given velocity; its particles do not turn.
    Velocity(Velocity),
    /// It moves to and fro with a cosine profile; its particles do not turn.
    Cosine(Cosine),
    /// It rotates about an axis as a rigid body.
    Rotation(AxisRotation),
}

impl GroupMotion {
    /// The names in a scenario.
    pub const NAMES: [&'static str; 5] = ["free", "fixed", "velocity", "cosine", "rotation"];

    /// A motion by its name, with the parameters of its `Default`.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "free" => Self::Free,
            "fixed" => Self::Fixed,
            "velocity" => Self::Velocity(Velocity::default()),
            "cosine" => Self::Cosine(Cosine::default()),
            "rotation" => Self::Rotation(AxisRotation::default()),
            _ => return None,
        })
    }

    /// The name in a scenario.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Fixed => "fixed",
            Self::Velocity(_) => "velocity",
            Self::Cosine(_) => "cosine",
            Self::Rotation(_) => "rotation",
        }
    }

    /// The parameters by their keys in a scenario.
    pub fn parameters(&mut self) -> Vec<Parameter<'_>> {
        match self {
            Self::Free | Self::Fixed => Vec::new(),
            Self::Velocity(motion) => motion.parameters(),
            Self::Cosine(motion) => motion.parameters(),
            Self::Rotation(motion) => motion.parameters(),
        }
    }

    fn law(&self) -> Option<&dyn Motion> {
        match self {
            Self::Free | Self::Fixed => None,
            Self::Velocity(motion) => Some(motion),
            Self::Cosine(motion) => Some(motion),
            Self::Rotation(motion) => Some(motion),
        }
    }

    /// Checks what no parameter can tell by itself.
    ///
    /// # Errors
    /// Parameters contradict each other.
    pub fn check(&self) -> Result<(), InvalidMotion> {
        self.law().map_or(Ok(()), |law| law.check())
    }

    /// Whether the path is given, whatever the forces are.
    pub const fn is_prescribed(&self) -> bool {
        !matches!(self, Self::Free)
    }

    /// Whether it is led, and not just held.
    pub const fn is_led(&self) -> bool {
        !matches!(self, Self::Free | Self::Fixed)
    }

    /// After which time the group stands still [s]; `None` for motions without end.
    pub fn duration(&self) -> Option<f64> {
        self.law()?.duration()
    }

    /// The highest speed of a translation [m/s]; zero for others.
    pub fn highest_speed(&self) -> f64 {
        self.law().map_or(0.0, |law| law.highest_speed())
    }

    /// Displacement since the beginning at `time + time_step` [s], where it was `before` at `time` [m]; a rotation has none.
    pub fn displacement(&self, before: Vector3, time: f64, time_step: f64) -> Vector3 {
        self.law().map_or(before, |law| law.displacement(before, time, time_step))
    }

    /// The velocity at a position and a time since the motion began [m/s].
    pub fn velocity(&self, position: Vector3, time: f64) -> Vector3 {
        match self {
            Self::Rotation(rotation) => rotation.velocity_at(position),
            _ => self.law().map_or(Vector3::zero(), |law| law.velocity(time)),
        }
    }

    /// Angular velocity of each particle [rad/s].
    pub fn angular_velocity(&self) -> Vector3 {
        match self {
            Self::Rotation(rotation) => rotation.vector(),
            _ => Vector3::zero(),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::super::Slot;
    use super::*;

    #[test]
    fn every_motion_of_groups_is_found_by_its_name() {
        for name in GroupMotion::NAMES {
            let mut motion = GroupMotion::named(name).unwrap();
            assert_eq!(motion.name(), name);
            for parameter in motion.parameters() {
                match parameter.value {
                    Slot::Number(number) => *number = 2.0,
                    Slot::Vector(vector) => *vector = Vector3::new(1.0, -2.0, 3.0),
                }
            }
            assert_eq!(motion.check(), Ok(()), "{name}");
        }
        assert_eq!(GroupMotion::named("frozen"), None);
        let nowhere = GroupMotion::Rotation(AxisRotation::default());
        assert_eq!(nowhere.check().map_err(|invalid| invalid.parameter), Err("axis"));
    }

    #[test]
    fn a_quarter_of_a_turn_carries_x_to_y_and_keeps_what_lies_along_the_axis() {
        let (point, axis) = (Vector3::new(1.0, 1.0, 0.0), Vector3::new(0.0, 0.0, 2.0));
        let rotation = AxisRotation { point, axis, angular_velocity: std::f64::consts::FRAC_PI_2 };
        let way = rotation.way(Vector3::new(3.0, 1.0, 5.0), 1.0);
        assert!((way - Vector3::new(-2.0, 2.0, 0.0)).norm() < 1e-15, "{way:?}");
        // For a short time it is the velocity: the rest is of second order, ½ ω² r dt².
        let short = rotation.way(Vector3::new(3.0, 1.0, 5.0), 1e-9) * 1e9;
        assert!((short - rotation.velocity_at(Vector3::new(3.0, 1.0, 5.0))).norm() < 1e-8, "{short:?}");
    }
}
