//! Directions of space and faces of a box, by the names that users write.

use crate::context::Reported;
use crate::shape::{Name, Shape};
use crate::value_reader::ValueReader;
use pulvis_math::Vector3;

/// A direction of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
    /// Along z.
    Z,
}

impl Axis {
    /// All directions, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// 0, 1 or 2: the index of the component of a vector.
    pub const fn index(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
            Self::Z => 2,
        }
    }

    /// `x`, `y` or `z`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }

    /// The unit vector along the axis.
    pub const fn unit(self) -> Vector3 {
        match self {
            Self::X => Vector3::new(1.0, 0.0, 0.0),
            Self::Y => Vector3::new(0.0, 1.0, 0.0),
            Self::Z => Vector3::new(0.0, 0.0, 1.0),
        }
    }
}

/// Which of the two faces of a box along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The face at the lower coordinate; particles are above it.
    Low,
    /// The face at the upper coordinate; particles are below it.
    High,
}

/// A face of the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BoxFace {
    /// The direction of its normal.
    pub axis: Axis,
    /// At the lower or the upper end of the box.
    pub side: Side,
}

impl BoxFace {
    /// All faces: x-low, x-high, y-low, …
    pub const ALL: [Self; 6] = [
        Self { axis: Axis::X, side: Side::Low },
        Self { axis: Axis::X, side: Side::High },
        Self { axis: Axis::Y, side: Side::Low },
        Self { axis: Axis::Y, side: Side::High },
        Self { axis: Axis::Z, side: Side::Low },
        Self { axis: Axis::Z, side: Side::High },
    ];

    /// The names of [`Self::ALL`].
    pub const NAMES: [&'static str; 6] = ["x-low", "x-high", "y-low", "y-high", "z-low", "z-high"];

    /// `x-low`, which is also the name of the wall.
    pub const fn name(self) -> &'static str {
        match (self.axis, self.side) {
            (Axis::X, Side::Low) => "x-low",
            (Axis::X, Side::High) => "x-high",
            (Axis::Y, Side::Low) => "y-low",
            (Axis::Y, Side::High) => "y-high",
            (Axis::Z, Side::Low) => "z-low",
            (Axis::Z, Side::High) => "z-high",
        }
    }

    /// The unit vector that points into the box.
    pub fn normal(self) -> Vector3 {
        match self.side {
            Side::Low => self.axis.unit(),
            Side::High => -self.axis.unit(),
        }
    }
}

/// Reads `"x"`, `"y"` or `"z"`.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisShape;

impl Shape for AxisShape {
    type Output = Axis;

    fn describe(&self) -> String {
        Name(&["x", "y", "z"]).describe()
    }

    fn example(&self) -> Option<String> {
        Some("\"x\"".to_owned())
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<Axis, Reported> {
        Ok(match Name(&["x", "y", "z"]).read(value)? {
            "x" => Axis::X,
            "y" => Axis::Y,
            _ => Axis::Z,
        })
    }
}
