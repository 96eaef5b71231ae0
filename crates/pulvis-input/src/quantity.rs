//! Quantities as text: a number with its unit, `"1.1 mm"`, checked and turned into SI.

use crate::decimal::{split_number, split_special};
use crate::problem::{LONGEST_VALUE, or_similar, shortened};
use crate::rule::{describe, with_article};
use crate::unit::{Unit, UnitError};

pub use crate::rule::QuantityRule;
use pulvis_math::Dimension;
use thiserror::Error;

/// Why a text is not the wanted quantity. `found` is what was written, texts in quotes.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum QuantityError {
    /// A number alone.
    #[error("{found} has no unit; expected {}, write for example {example}", with_article(&.expected.quantity()))]
    #[allow(missing_docs)]
    NoUnit { found: String, expected: Dimension, example: String },
    /// A unit of another dimension.
    #[error("{found} is {}, expected {}; write for example {example}", describe(*.dimension), describe(*.expected))]
    #[allow(missing_docs)]
    OtherDimension { found: String, dimension: Dimension, expected: Dimension, example: String },
    /// A text that does not begin with digits.
    #[error("{found} does not begin with a number; expected {}, write for example {example}", describe(*.expected))]
    #[allow(missing_docs)]
    NoNumber { found: String, expected: Dimension, example: String },
    /// A unit that cannot be read.
    #[error("{found}: {reason}; expected {}{}", describe(*.expected), or_similar(.reason.similar()))]
    #[allow(missing_docs)]
    Unit { found: String, reason: UnitError, expected: Dimension },
    /// `nan`.
    #[error("{found} is not a number; expected {}", describe(*.expected))]
    #[allow(missing_docs)]
    NotANumber { found: String, expected: Dimension },
    /// `inf` where a finite value is needed.
    #[error("{found} is not finite; expected a finite value, {}", describe(*.expected))]
    #[allow(missing_docs)]
    Infinite { found: String, expected: Dimension },
    /// A number beyond the range of `f64`.
    #[error("{found} cannot be represented (beyond 1e-308 .. 1e308 in SI); expected {}", describe(*.expected))]
    #[allow(missing_docs)]
    NotRepresentable { found: String, expected: Dimension },
    /// A value outside the range of the rule.
    #[error("{found} is out of range; expected {}", .rule.describe())]
    #[allow(missing_docs)]
    OutOfRange { found: String, rule: Box<QuantityRule> },
}

/// Reads a quantity such as `"1.1 mm"` into SI.
///
/// # Errors
/// [`QuantityError`] tells what was found, what was expected and how to write it.
pub fn parse_quantity(text: &str, rule: impl Into<QuantityRule>) -> Result<f64, QuantityError> {
    read(text, &format!("\"{}\"", shortened(text, LONGEST_VALUE)), rule.into())
}

/// Reads a number of the file that stands without quotes.
pub(crate) fn parse_bare(text: &str, rule: QuantityRule) -> Result<f64, QuantityError> {
    read(text, &shortened(text, LONGEST_VALUE), rule)
}

/// Checks a value that is already in SI, for example one of a sweep.
pub(crate) fn check_si(value: f64, rule: QuantityRule) -> Result<f64, QuantityError> {
    let found = match rule.dimension {
        Dimension::NONE => value.to_string(),
        other => format!("{value} {}", other.unit()),
    };
    check(value, &found, rule)
}

fn read(text: &str, found: &str, rule: QuantityRule) -> Result<f64, QuantityError> {
    let expected = rule.dimension;
    let found = || found.to_owned();
    let text = text.trim();
    if let Some((value, rest)) = split_special(text) {
        let unit =
            Unit::parse(rest).map_err(|reason| QuantityError::Unit { found: found(), reason, expected })?;
        if !rest.trim().is_empty() && unit.dimension != expected {
            return Err(other_dimension(found(), &unit, rule, "1"));
        }
        return check(value, &found(), rule);
    }
    let Some((number, rest)) = split_number(text) else {
        return Err(QuantityError::NoNumber { found: found(), expected, example: rule.example("1") });
    };
    let unit = match rest.trim() {
        "" if expected == Dimension::NONE || rule.bare => Unit { dimension: expected, ..Unit::ONE },
        "" => {
            let example = rule.example(number.mantissa);
            return Err(QuantityError::NoUnit { found: found(), expected, example });
        }
        unit => {
            Unit::parse(unit).map_err(|reason| QuantityError::Unit { found: found(), reason, expected })?
        }
    };
    if unit.dimension != expected {
        return Err(other_dimension(found(), &unit, rule, number.mantissa));
    }
    let value = number.in_si(&unit).ok_or(QuantityError::NotRepresentable { found: found(), expected })?;
    check(value, &found(), rule)
}

fn other_dimension(found: String, unit: &Unit, rule: QuantityRule, number: &str) -> QuantityError {
    let (dimension, expected) = (unit.dimension, rule.dimension);
    QuantityError::OtherDimension { found, dimension, expected, example: rule.example(number) }
}

fn check(value: f64, found: &str, rule: QuantityRule) -> Result<f64, QuantityError> {
    let (found, expected) = (found.to_owned(), rule.dimension);
    if value.is_nan() {
        Err(QuantityError::NotANumber { found, expected })
    } else if value.is_infinite() && !(rule.infinite && value > 0.0) {
        Err(QuantityError::Infinite { found, expected })
    } else if !rule.includes(value) {
        Err(QuantityError::OutOfRange { found, rule: Box::new(rule) })
    } else {
        Ok(value)
    }
}

#[cfg(test)]
#[path = "quantity_tests.rs"]
mod tests;
