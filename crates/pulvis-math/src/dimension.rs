//! Physical dimensions as exponents of kilogram, metre, second, ampere and kelvin.

use std::fmt;

/// The dimension of a quantity in SI base units: kg^mass · m^length · s^time · A^current · K^temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of the kilogram.
    pub mass: i8,
    /// Exponent of the metre.
    pub length: i8,
    /// Exponent of the second.
    pub time: i8,
    /// Exponent of the ampere.
    pub current: i8,
    /// Exponent of the kelvin.
    pub temperature: i8,
}

impl Dimension {
    /// A pure number [1].
    pub const NONE: Self = Self::new(0, 0, 0);
    /// Length [m].
    pub const LENGTH: Self = Self::new(0, 1, 0);
    /// Volume [m^3].
    pub const VOLUME: Self = Self::new(0, 3, 0);
    /// One over a length [1/m].
    pub const INVERSE_LENGTH: Self = Self::new(0, -1, 0);
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
    /// Stiffness over an area [Pa/m].
    pub const STIFFNESS_PER_AREA: Self = Self::new(1, -2, -2);
    /// Power [W].
    pub const POWER: Self = Self::new(1, 2, -3);
    /// Electric current [A].
    pub const CURRENT: Self = Self { current: 1, ..Self::NONE };
    /// Electric charge [C].
    pub const CHARGE: Self = Self { current: 1, ..Self::TIME };
    /// Voltage [V].
    pub const VOLTAGE: Self = Self { current: -1, ..Self::POWER };
    /// Temperature [K].
    pub const TEMPERATURE: Self = Self { temperature: 1, ..Self::NONE };

    /// The dimension of mechanics with the given exponents.
    pub const fn new(mass: i8, length: i8, time: i8) -> Self {
        Self { mass, length, time, current: 0, temperature: 0 }
    }

    /// The name of the SI unit and of the quantity, where the dimension has a usual one.
    const fn usual(self) -> Option<(&'static str, &'static str)> {
        match (self.current, self.temperature) {
            (0, 0) => {}
            (1, 0) if self.is_like(Self::CURRENT) => return Some(("A", "electric current")),
            (1, 0) if self.is_like(Self::CHARGE) => return Some(("C", "electric charge")),
            (-1, 0) if self.is_like(Self::VOLTAGE) => return Some(("V", "voltage")),
            (0, 1) if self.is_like(Self::TEMPERATURE) => return Some(("K", "temperature")),
            _ => return None,
        }
        Some(match (self.mass, self.length, self.time) {
            (0, 0, 0) => ("1", "pure number"),
            (0, 1, 0) => ("m", "length"),
            (0, 3, 0) => ("m^3", "volume"),
            (1, 0, 0) => ("kg", "mass"),
            (0, 0, 1) => ("s", "time"),
            (0, -1, 0) => ("1/m", "inverse length"),
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
            (1, 2, -3) => ("W", "power"),
            (1, -2, -2) => ("Pa/m", "stiffness per area"),
            _ => return None,
        })
    }

    /// Whether the exponents of mechanics are the same.
    const fn is_like(self, other: Self) -> bool {
        self.mass == other.mass && self.length == other.length && self.time == other.time
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
        Self {
            mass: self.mass + other.mass,
            length: self.length + other.length,
            time: self.time + other.time,
            current: self.current + other.current,
            temperature: self.temperature + other.temperature,
        }
    }
}

/// Prints the exponents, for example `kg^1 m^0 s^-2`; those of ampere and kelvin where they are not zero.
impl fmt::Display for Dimension {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "kg^{} m^{} s^{}", self.mass, self.length, self.time)?;
        for (unit, exponent) in [("A", self.current), ("K", self.temperature)] {
            if exponent != 0 {
                write!(out, " {unit}^{exponent}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_over_a_length_is_a_stiffness() {
        let per_length = Dimension::INVERSE_LENGTH;
        assert_eq!(Dimension::FORCE * per_length, Dimension::STIFFNESS);
        assert_eq!(Dimension::STIFFNESS.unit(), "N/m");
    }

    #[test]
    fn an_unusual_dimension_is_spelled_out() {
        assert_eq!(Dimension::new(2, 0, 1).unit(), "kg^2 m^0 s^1");
        let heat_capacity = Dimension { temperature: -1, ..Dimension::ENERGY };
        assert_eq!(heat_capacity.unit(), "kg^1 m^2 s^-2 K^-1");
        assert_eq!((heat_capacity * Dimension::TEMPERATURE).unit(), "J");
        assert_eq!((Dimension::CHARGE * Dimension::VOLTAGE).unit(), "J");
        assert_eq!((Dimension::CURRENT * Dimension::TIME).unit(), "C");
    }
}
