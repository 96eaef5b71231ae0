//! Parameter values by name, and why a law refuses one.

use thiserror::Error;

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A quantity in SI units.
    Number(f64),
    /// A name.
    Choice(String),
    /// A list of quantities in SI units.
    Numbers(Vec<f64>),
}

/// Parameter values by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values(Vec<(String, Value)>);

impl Values {
    /// No values.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds or replaces a value.
    pub fn set(&mut self, name: &str, value: Value) {
        match self.0.iter_mut().find(|(known, _)| known == name) {
            Some((_, slot)) => *slot = value,
            None => self.0.push((name.to_owned(), value)),
        }
    }

    /// The same values and a number [SI].
    pub fn with(mut self, name: &str, number: f64) -> Self {
        self.set(name, Value::Number(number));
        self
    }

    /// The same values and a choice.
    pub fn with_choice(mut self, name: &str, choice: &str) -> Self {
        self.set(name, Value::Choice(choice.to_owned()));
        self
    }

    /// The same values and a list of numbers [SI].
    pub fn with_numbers(mut self, name: &str, numbers: &[f64]) -> Self {
        self.set(name, Value::Numbers(numbers.to_vec()));
        self
    }

    /// The value of `name`.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }

    /// The number [SI] of `name`, if it is given.
    pub fn optional_number(&self, name: &str) -> Option<f64> {
        match self.get(name) {
            Some(Value::Number(number)) => Some(*number),
            _ => None,
        }
    }

    /// The number [SI] of `name`.
    pub fn number(&self, name: &'static str) -> Result<f64, InvalidParameter> {
        self.optional_number(name).ok_or(InvalidParameter::Missing { name })
    }

    /// The list of numbers [SI] of `name`.
    pub fn numbers(&self, name: &'static str) -> Result<&[f64], InvalidParameter> {
        match self.get(name) {
            Some(Value::Numbers(numbers)) => Ok(numbers),
            _ => Err(InvalidParameter::Missing { name }),
        }
    }

    /// The choice made for `name`.
    pub fn choice(&self, name: &'static str) -> Result<&str, InvalidParameter> {
        match self.get(name) {
            Some(Value::Choice(choice)) => Ok(choice),
            _ => Err(InvalidParameter::Missing { name }),
        }
    }

    /// Names and values, in the order in which they were set.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }
}

/// A parameter value that a law refuses.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InvalidParameter {
    /// The law has no such parameter.
    #[error("unknown parameter `{name}`; expected one of {known}")]
    Unknown {
        /// What was given.
        name: String,
        /// The law's parameters.
        known: String,
    },
    /// A required parameter is not given.
    #[error("`{name}` is missing")]
    Missing {
        /// The parameter.
        name: &'static str,
    },
    /// A value outside the parameter's range, or no value of its kind.
    #[error("`{name}` is {found}, expected {expected}")]
    OutOfRange {
        /// The parameter.
        name: &'static str,
        /// What was given, with its unit.
        found: String,
        /// What is allowed.
        expected: String,
    },
    /// A value that does not fit another parameter.
    #[error("`{name}` is {found}, expected {expected}: {reason}")]
    Inconsistent {
        /// The parameter.
        name: &'static str,
        /// What was given, with its unit.
        found: String,
        /// What is allowed, and what it depends on.
        expected: String,
        /// Why.
        reason: &'static str,
    },
}

impl InvalidParameter {
    /// The parameter that is refused.
    pub fn name(&self) -> &str {
        match self {
            Self::Unknown { name, .. } => name,
            Self::Missing { name } | Self::OutOfRange { name, .. } | Self::Inconsistent { name, .. } => name,
        }
    }
}
