//! Physical dimensions as exponents of kilogram, metre and second.

use std::fmt;

/// The dimension of a quantity in SI base units: kg^mass · m^length · s^time.
///
/// Mechanics of grains needs no ampere, kelvin or mole; a law that does extends this type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of the kilogram.
    pub mass: i8,
    /// Exponent of the metre.
    pub length: i8,
    /// Exponent of the second.
    pub time: i8,
}

impl Dimension {
    /// A pure number [1].
    pub const NONE: Self = Self::new(0, 0, 0);
    /// Length [m].
    pub const LENGTH: Self = Self::new(0, 1, 0);
    /// Mass [kg].
    pub const MASS: Self = Self::new(1, 0, 0);
    /// Time [s].
    pub const TIME: Self = Self::new(0, 0, 1);
    /// Rate, frequency or angular velocity [1/s].
    pub const RATE: Self = Self::new(0, 0, -1);
    /// Velocity [m/s].
    pub const VELOCITY: Self = Self::new(0, 1, -1);
    /// Acceleration [m/s^2].
    pub const ACCELERATION: Self = Self::new(0, 1, -2);
    /// Mass density [kg/m^3].
    pub const DENSITY: Self = Self::new(1, -3, 0);
    /// Force [N].
    pub const FORCE: Self = Self::new(1, 1, -2);
    /// Stiffness of a spring [N/m].
    pub const STIFFNESS: Self = Self::new(1, 0, -2);
    /// Coefficient of a dashpot [kg/s].
    pub const DASHPOT: Self = Self::new(1, 0, -1);
    /// Coefficient of a rotational dashpot [kg m^2/s].
    pub const ROTATIONAL_DASHPOT: Self = Self::new(1, 2, -1);
    /// Energy [J].
    pub const ENERGY: Self = Self::new(1, 2, -2);
    /// Pressure, stress or modulus [Pa].
    pub const PRESSURE: Self = Self::new(1, -1, -2);

    /// The dimension with the given exponents.
    pub const fn new(mass: i8, length: i8, time: i8) -> Self {
        Self { mass, length, time }
    }

    /// The name of the SI unit and of the quantity, where the dimension has a usual one.
    const fn usual(self) -> Option<(&'static str, &'static str)> {
        Some(match (self.mass, self.length, self.time) {
            (0, 0, 0) => ("1", "pure number"),
            (0, 1, 0) => ("m", "length"),
            (1, 0, 0) => ("kg", "mass"),
            (0, 0, 1) => ("s", "time"),
            (0, 0, -1) => ("1/s", "rate"),
            (0, 1, -1) => ("m/s", "velocity"),
            (0, 1, -2) => ("m/s^2", "acceleration"),
            (1, -3, 0) => ("kg/m^3", "density"),
            (1, 1, -2) => ("N", "force"),
            (1, 0, -2) => ("N/m", "stiffness"),
            (1, 0, -1) => ("kg/s", "dashpot coefficient"),
            (1, 2, -1) => ("kg m^2/s", "rotational dashpot coefficient"),
            (1, 2, -2) => ("J", "energy"),
            (1, -1, -2) => ("Pa", "pressure"),
            _ => return None,
        })
    }

    /// The SI unit as text, for example `N/m`.
    pub fn unit(self) -> String {
        match self.usual() {
            Some((unit, _)) => unit.to_owned(),
            None => self.to_string(),
        }
    }

    /// What a quantity of this dimension is called, for example `stiffness`.
    pub fn quantity(self) -> String {
        match self.usual() {
            Some((_, quantity)) => quantity.to_owned(),
            None => format!("quantity in {self}"),
        }
    }
}

impl std::ops::Mul for Dimension {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.mass + other.mass, self.length + other.length, self.time + other.time)
    }
}

/// Prints the exponents, for example `kg^1 m^0 s^-2`.
impl fmt::Display for Dimension {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "kg^{} m^{} s^{}", self.mass, self.length, self.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_over_a_length_is_a_stiffness() {
        let per_length = Dimension::new(0, -1, 0);
        assert_eq!(Dimension::FORCE * per_length, Dimension::STIFFNESS);
        assert_eq!(Dimension::STIFFNESS.unit(), "N/m");
    }

    #[test]
    fn an_unusual_dimension_is_spelled_out() {
        assert_eq!(Dimension::new(2, 0, 1).unit(), "kg^2 m^0 s^1");
    }
}
