//! The parameters of a motion, as a scenario names them.

use pulvis_math::{Dimension, Vector3};
use thiserror::Error;

/// A parameter of a motion: its description, and where its value stands. Scenarios are read into `value` and
/// written from it.
#[derive(Debug)]
pub struct Parameter<'m> {
    /// The key in a scenario.
    pub name: &'static str,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// Range of the value.
    pub range: Range,
    /// Whether the key may be left out.
    pub presence: Presence,
    /// The value, in SI.
    pub value: Slot<'m>,
}

/// Range of a number; a vector has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Zero or more.
    NonNegative,
    /// More than zero.
    Positive,
}

/// Whether a key may be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// It must be there.
    Required,
    /// It has the value of the motion's `Default`.
    Optional,
    /// It is the same as that of an earlier key.
    SameAs(&'static str),
}

/// Where a value stands.
#[derive(Debug)]
pub enum Slot<'m> {
    /// A number.
    Number(&'m mut f64),
    /// Three components.
    Vector(&'m mut Vector3),
}

impl<'m> Parameter<'m> {
    /// A number that must be there.
    pub fn number(name: &'static str, dimension: Dimension, value: &'m mut f64) -> Self {
        let (range, presence) = (Range::Any, Presence::Required);
        Self { name, dimension, range, presence, value: Slot::Number(value) }
    }

    /// A vector that must be there.
    pub fn vector(name: &'static str, dimension: Dimension, value: &'m mut Vector3) -> Self {
        let (range, presence) = (Range::Any, Presence::Required);
        Self { name, dimension, range, presence, value: Slot::Vector(value) }
    }

    /// The same in another range.
    pub fn within(self, range: Range) -> Self {
        Self { range, ..self }
    }

    /// The same, but it may be left out.
    pub fn or(self, presence: Presence) -> Self {
        Self { presence, ..self }
    }
}

/// Parameters that contradict each other.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("`{parameter}`: {found}; expected {expected}")]
pub struct InvalidMotion {
    /// The key in a scenario.
    pub parameter: &'static str,
    /// What was found, as a clause.
    pub found: String,
    /// What must hold.
    pub expected: String,
}
