//! Units as text: `kg/m^3`, `kN/m`, `rad/s`, `g/cm3`.

use crate::problem::{LONGEST_VALUE, shortened};
use pulvis_math::{Dimension, elementary};
use thiserror::Error;

/// A unit with its dimension and the factor that leads to SI.
///
/// The factor is 10^decimal · numerator / denominator. The power of ten stays apart, because it can
/// be folded into the text of a number before rounding: `1.1 mm` becomes `1.1e-3`, not 1.1 · 0.001.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Dimension in kilogram, metre, second, ampere, kelvin.
    pub dimension: Dimension,
    /// Power of ten of the factor to SI.
    pub decimal: i32,
    /// What remains of the factor above the line, for example 60 for `min`.
    pub numerator: f64,
    /// What remains of the factor below the line, for example 180 for `deg`.
    pub denominator: f64,
}

/// Why a text is no unit.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum UnitError {
    /// A symbol that stands for no unit.
    #[error("unknown unit `{symbol}`")]
    Unknown {
        /// The symbol as written.
        symbol: String,
        /// The symbol that was probably meant.
        similar: Option<String>,
    },
    /// An exponent that is no small whole number.
    #[error("cannot read the exponent of `{factor}`; write for example `m^2`")]
    Exponent {
        /// The factor as written.
        factor: String,
    },
    /// `N/m s`: is the second above or below the line?
    #[error("`{unit}` is ambiguous; write a slash before every factor below the line, `N/m/s`")]
    ProductAfterSlash {
        /// The unit as written.
        unit: String,
    },
    /// `kg/` or `N//m`.
    #[error("`{unit}` has a slash without a factor behind it")]
    NothingAfterSlash {
        /// The unit as written.
        unit: String,
    },
}

impl UnitError {
    /// The symbol that was probably meant.
    pub fn similar(&self) -> Option<&str> {
        match self {
            Self::Unknown { similar, .. } => similar.as_deref(),
            _ => None,
        }
    }
}

/// SI prefixes, the usual ones of granular matter first: suggestions are tried in this order.
const PREFIXES: &[(&str, i32)] = &[
    ("m", -3),
    ("k", 3),
    ("u", -6),
    ("M", 6),
    ("G", 9),
    ("n", -9),
    ("c", -2),
    ("µ", -6), // U+00B5, the key of most keyboards
    ("μ", -6), // U+03BC, the Greek letter
    ("d", -1),
    ("da", 1),
    ("h", 2),
    ("T", 12),
    ("P", 15),
    ("E", 18),
    ("Z", 21),
    ("Y", 24),
    ("p", -12),
    ("f", -15),
    ("a", -18),
    ("z", -21),
    ("y", -24),
];

/// Units that take prefixes, with the power of ten to SI.
const PREFIXED: &[(&str, Dimension, i32)] = &[
    ("m", Dimension::LENGTH, 0),
    ("g", Dimension::MASS, -3),
    ("s", Dimension::TIME, 0),
    ("N", Dimension::FORCE, 0),
    ("Pa", Dimension::PRESSURE, 0),
    ("J", Dimension::ENERGY, 0),
    ("W", Dimension::POWER, 0),
    ("Hz", Dimension::RATE, 0),
    ("rad", Dimension::NONE, 0),
    ("A", Dimension::CURRENT, 0),
    ("C", Dimension::CHARGE, 0),
    ("V", Dimension::VOLTAGE, 0),
    ("K", Dimension::TEMPERATURE, 0),
];

/// Units that take none: (symbol, dimension, power of ten, numerator, denominator).
const PLAIN: &[(&str, Dimension, i32, f64, f64)] = &[
    ("1", Dimension::NONE, 0, 1.0, 1.0),
    ("%", Dimension::NONE, -2, 1.0, 1.0),
    ("min", Dimension::TIME, 0, 60.0, 1.0),
    ("h", Dimension::TIME, 0, 3600.0, 1.0),
    ("deg", Dimension::NONE, 0, std::f64::consts::PI, 180.0),
    ("°", Dimension::NONE, 0, std::f64::consts::PI, 180.0),
];

/// Beyond this an exponent is a slip of the keyboard, and the sums below stay far from overflow.
const LARGEST_EXPONENT: i32 = 12;

impl Unit {
    /// The unit of a pure number.
    pub const ONE: Self = Self { dimension: Dimension::NONE, decimal: 0, numerator: 1.0, denominator: 1.0 };

    /// Reads factors with exponents, joined by space, `*` or `·`, and below the line by `/`.
    ///
    /// # Errors
    /// [`UnitError`] tells which factor cannot be read.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        let mut unit = Self::ONE;
        let mut exponents = [0_i32; 5];
        for (position, part) in text.split('/').enumerate() {
            let mut factors = part.split([' ', '\t', '*', '·', '⋅']).filter(|factor| !factor.is_empty());
            if position == 0 {
                factors.try_for_each(|factor| unit.multiply(factor, 1, &mut exponents))?;
                continue;
            }
            let below = factors
                .next()
                .ok_or_else(|| UnitError::NothingAfterSlash { unit: shortened(text, LONGEST_VALUE) })?;
            if factors.next().is_some() {
                return Err(UnitError::ProductAfterSlash { unit: shortened(text.trim(), LONGEST_VALUE) });
            }
            unit.multiply(below, -1, &mut exponents)?;
        }
        let mut read = [0; 5];
        for (exponent, sum) in read.iter_mut().zip(exponents) {
            *exponent = i8::try_from(sum)
                .map_err(|_| UnitError::Exponent { factor: shortened(text, LONGEST_VALUE) })?;
        }
        let [mass, length, time, current, temperature] = read;
        unit.dimension = Dimension { mass, length, time, current, temperature };
        Ok(unit)
    }

    /// Multiplies by one factor such as `cm3`, or divides by it where `sign` is -1.
    fn multiply(&mut self, factor: &str, sign: i32, exponents: &mut [i32; 5]) -> Result<(), UnitError> {
        let (base, exponent) = read_factor(factor)?;
        let exponent = sign * exponent;
        self.decimal += exponent * base.decimal;
        let (above, below) = if exponent < 0 {
            (base.denominator, base.numerator)
        } else {
            (base.numerator, base.denominator)
        };
        self.numerator *= elementary::powi(above, exponent.abs());
        self.denominator *= elementary::powi(below, exponent.abs());
        let Dimension { mass, length, time, current, temperature } = base.dimension;
        for (sum, part) in exponents.iter_mut().zip([mass, length, time, current, temperature]) {
            *sum += exponent * i32::from(part);
        }
        Ok(())
    }
}

/// Splits `cm3`, `cm^3` or `cm³` into the symbol's unit and the exponent.
fn read_factor(factor: &str) -> Result<(Unit, i32), UnitError> {
    if factor == "1" {
        return Ok((Unit::ONE, 1));
    }
    let is_exponent = |c: char| c.is_ascii_digit() || matches!(c, '^' | '+' | '-' | '⁻' | '²' | '³' | '¹');
    let split = factor.find(is_exponent).unwrap_or(factor.len());
    let (symbol, exponent) = factor.split_at(split);
    let unit = look_up(symbol).ok_or_else(|| UnitError::Unknown {
        symbol: shortened(factor, LONGEST_VALUE),
        similar: suggest(symbol),
    })?;
    if exponent.is_empty() {
        return Ok((unit, 1));
    }
    let digits: String = exponent.strip_prefix('^').unwrap_or(exponent).chars().map(lower_digit).collect();
    match digits.parse::<i32>() {
        Ok(exponent) if exponent.abs() <= LARGEST_EXPONENT => Ok((unit, exponent)),
        _ => Err(UnitError::Exponent { factor: shortened(factor, LONGEST_VALUE) }),
    }
}

fn lower_digit(digit: char) -> char {
    match digit {
        '⁻' => '-',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        other => other,
    }
}

/// The unit of one symbol. Whole symbols win over prefix and unit: `min` is no milli-inch.
fn look_up(symbol: &str) -> Option<Unit> {
    if let Some(&(_, dimension, decimal, numerator, denominator)) = PLAIN.iter().find(|row| row.0 == symbol) {
        return Some(Unit { dimension, decimal, numerator, denominator });
    }
    PREFIXED.iter().find_map(|&(base, dimension, decimal)| {
        let prefix = symbol.strip_suffix(base)?;
        let power = match prefix {
            "" => 0,
            _ => PREFIXES.iter().find(|row| row.0 == prefix)?.1,
        };
        Some(Unit { dimension, decimal: decimal + power, ..Unit::ONE })
    })
}

/// A symbol that differs only in upper and lower case, such as `kN` for `kn`.
///
/// Not more: with three letters almost every symbol is one edit from another one.
fn suggest(symbol: &str) -> Option<String> {
    let prefixes = [""].into_iter().chain(PREFIXES.iter().map(|row| row.0));
    let prefixed = prefixes.flat_map(|prefix| PREFIXED.iter().map(move |row| format!("{prefix}{}", row.0)));
    prefixed
        .chain(PLAIN.iter().map(|row| row.0.to_owned()))
        .find(|known| known.to_lowercase() == symbol.to_lowercase())
}

#[cfg(test)]
#[path = "unit_tests.rs"]
mod tests;
