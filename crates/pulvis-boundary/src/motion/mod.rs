//! How walls move. One file a motion; the list is at the end of this file.

mod cell;
mod cosine;
mod group;
mod parameter;
mod rotation;
mod servo;
mod velocity;

pub use cell::{CellContent, CellControl, CellMotion};
pub use cosine::Cosine;
pub use group::{AxisRotation, GroupMotion};
pub use parameter::{InvalidMotion, Parameter, Presence, Range, Slot};
pub use rotation::Rotation;
pub use servo::{PressureRamp, Servo};
pub use velocity::Velocity;

use pulvis_math::Vector3;

/// What a motion has to say. Times are counted from its beginning.
///
/// A motion either leads the wall, by [`displacement`](Self::displacement) and [`velocity`](Self::velocity), or
/// leaves it to the forces, by [`acceleration`](Self::acceleration).
pub trait Motion {
    /// The parameters by their keys in a scenario, in the order in which they are written out.
    fn parameters(&mut self) -> Vec<Parameter<'_>>;

    /// Checks what no parameter can tell by itself.
    ///
    /// # Errors
    /// Parameters contradict each other.
    fn check(&self) -> Result<(), InvalidMotion> {
        Ok(())
    }

    /// Whether the wall must have an area.
    fn needs_area(&self) -> bool {
        false
    }

    /// After which time the wall stands still [s]; `None` for motions without end. A stage without a rule ends
    /// with the longest one.
    fn duration(&self) -> Option<f64> {
        None
    }

    /// The velocity, where it is the same at all times [m/s].
    fn constant_velocity(&self) -> Option<Vector3> {
        None
    }

    /// The highest speed that the motion leads the wall with [m/s].
    fn highest_speed(&self) -> f64 {
        self.constant_velocity().map_or(0.0, Vector3::norm)
    }

    /// The pressure on the wall's face at a time [s], [Pa]; `None` where there is none.
    fn pressure(&self, _time: f64) -> Option<f64> {
        None
    }

    /// Mass [kg] and damping [kg/s] of a wall that forces move.
    fn mass_and_damping(&self) -> Option<(f64, f64)> {
        None
    }

    /// Displacement since the beginning at `time + time_step` [s], where it was `before` at `time` [m].
    fn displacement(&self, before: Vector3, _time: f64, _time_step: f64) -> Vector3 {
        before
    }

    /// Whether the wall must have an axis to rotate about.
    fn needs_axis(&self) -> bool {
        false
    }

    /// Angular velocity about the axis of the wall, by the right-hand rule [rad/s].
    fn angular_velocity(&self) -> f64 {
        0.0
    }

    /// Velocity at a time [s], [m/s].
    fn velocity(&self, _time: f64) -> Vector3 {
        Vector3::zero()
    }

    /// Whether forces move the wall: then it goes on with the velocity that it had before.
    fn is_pushed(&self) -> bool {
        false
    }

    /// Acceleration along the wall's normal under a push [m/s²]; `None` for motions that lead the wall.
    fn acceleration(&self, _push: &Push) -> Option<f64> {
        None
    }
}

/// What acts on a wall at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// Force of the particles along the wall's normal, which points to them: negative if they push it away [N].
    pub force: f64,
    /// Velocity of the wall along its normal [m/s].
    pub speed: f64,
    /// Area of the wall's face [m²].
    pub area: f64,
    /// Time [s].
    pub time: f64,
}

/// A wall that stands still.
struct Standing;

impl Motion for Standing {
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        Vec::new()
    }

    fn constant_velocity(&self) -> Option<Vector3> {
        Some(Vector3::zero())
    }
}

/// Makes the list of motions: their names in a scenario, and their types.
macro_rules! motions {
    ($($(#[$meta:meta])* $name:literal => $motion:ident;)*) => {
        /// How a wall moves.
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub enum WallMotion {
            /// It stands still.
            #[default]
            Fixed,
            $($(#[$meta])* $motion($motion),)*
        }

        impl WallMotion {
            /// The names in a scenario.
            pub const NAMES: &'static [&'static str] = &["fixed", $($name),*];

            /// A motion by its name, with the parameters of its `Default`.
            pub fn named(name: &str) -> Option<Self> {
                match name {
                    "fixed" => Some(Self::Fixed),
                    $($name => Some(Self::$motion($motion::default())),)*
                    _ => None,
                }
            }

            /// The name in a scenario.
            pub fn name(&self) -> &'static str {
                match self {
                    Self::Fixed => "fixed",
                    $(Self::$motion(_) => $name,)*
                }
            }

            /// The parameters by their keys in a scenario; none for a wall that stands still.
            pub fn parameters(&mut self) -> Vec<Parameter<'_>> {
                match self {
                    Self::Fixed => Vec::new(),
                    $(Self::$motion(motion) => motion.parameters(),)*
                }
            }

            /// What the motion says about itself.
            pub fn law(&self) -> &dyn Motion {
                match self {
                    Self::Fixed => &Standing,
                    $(Self::$motion(motion) => motion,)*
                }
            }
        }

    };
}

motions! {
    /// It moves with a given velocity.
    "velocity" => Velocity;
    /// It moves to and fro with a cosine profile.
    "cosine" => Cosine;
    /// It follows a pressure.
    "servo" => Servo;
    /// It rotates about its axis.
    "rotation" => Rotation;
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn every_motion_is_found_by_its_name_and_stands_still_after_its_duration() {
        for name in WallMotion::NAMES {
            let Some(mut motion) = WallMotion::named(name) else { panic!("{name} is not in the list") };
            assert_eq!(motion.name(), *name);
            for parameter in motion.parameters() {
                match parameter.value {
                    Slot::Number(number) => *number = 2.0,
                    Slot::Vector(vector) => *vector = Vector3::new(1.0, -2.0, 3.0),
                }
            }
            let motion = motion.law();
            let push = Push { force: -1.0, speed: 0.0, area: 1.0, time: 0.0 };
            assert_eq!(motion.is_pushed(), motion.acceleration(&push).is_some(), "{name}");
            assert_eq!(motion.check(), Ok(()), "{name}");
            assert_eq!(motion.is_pushed(), motion.mass_and_damping().is_some(), "{name}");
            let fastest = (0..=1000).map(|instant| motion.velocity(f64::from(instant) * 4e-3).norm());
            let fastest = fastest.fold(0.0, pulvis_math::max_or_nan);
            assert!((fastest - motion.highest_speed()).abs() <= 1e-5 * fastest, "{name}: {fastest}");
            if let Some(velocity) = motion.constant_velocity() {
                let moved = motion.displacement(Vector3::zero(), 7.0, 0.5);
                assert_eq!((motion.velocity(7.0), moved), (velocity, velocity * 0.5), "{name}");
            }
            if let Some(duration) = motion.duration() {
                assert_eq!(motion.velocity(duration), Vector3::zero(), "{name}");
                let arrived = motion.displacement(Vector3::zero(), duration, 0.0);
                assert_eq!(motion.displacement(arrived, duration, 5.0), arrived, "{name}");
            }
        }
        assert_eq!(WallMotion::named("cosinus"), None);
    }

    #[test]
    fn parameters_that_contradict_each_other_are_refused_by_name() {
        let still = Cosine { period: 1.0, ..Cosine::default() };
        assert_eq!(still.check().map_err(|invalid| invalid.parameter), Err("displacement"));
        let pressure = PressureRamp { from: 1.0, to: 2.0, duration: 0.0 };
        let jump = Servo { pressure, mass: 1.0, damping: 0.0 };
        assert_eq!(jump.check().map_err(|invalid| invalid.parameter), Err("from"));
    }
}
