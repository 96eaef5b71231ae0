//! What a quantity of a scenario has to be.

use pulvis_math::Dimension;

/// What a quantity has to be: its dimension, its range, and what may be left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuantityRule {
    /// Dimension that the unit must have.
    pub dimension: Dimension,
    /// Whether `inf` is a value.
    pub infinite: bool,
    /// Whether a bare number is taken as SI. Elsewhere it is refused, except for pure numbers.
    pub bare: bool,
    /// Lower limit in SI, and whether the limit itself is allowed.
    pub lower: Option<(f64, bool)>,
    /// Upper limit in SI, and whether the limit itself is allowed.
    pub upper: Option<(f64, bool)>,
}

impl QuantityRule {
    /// Any finite quantity of this dimension, written with its unit.
    pub const fn of(dimension: Dimension) -> Self {
        Self { dimension, infinite: false, bare: false, lower: None, upper: None }
    }

    /// Allows `"inf"`, with or without a unit.
    pub const fn or_infinite(self) -> Self {
        Self { infinite: true, ..self }
    }

    /// Takes a number without unit as SI.
    pub const fn or_bare(self) -> Self {
        Self { bare: true, ..self }
    }

    /// Demands a value greater than `limit`, in SI.
    pub const fn above(self, limit: f64) -> Self {
        Self { lower: Some((limit, false)), ..self }
    }

    /// Demands `limit`, in SI, or more.
    pub const fn at_least(self, limit: f64) -> Self {
        Self { lower: Some((limit, true)), ..self }
    }

    /// Demands a value smaller than `limit`, in SI.
    pub const fn below(self, limit: f64) -> Self {
        Self { upper: Some((limit, false)), ..self }
    }

    /// Demands `limit`, in SI, or less.
    pub const fn at_most(self, limit: f64) -> Self {
        Self { upper: Some((limit, true)), ..self }
    }

    /// The expectation in words, for example `a stiffness [N/m] greater than 0`.
    pub fn describe(&self) -> String {
        let mut text = describe(self.dimension);
        let lower =
            self.lower.map(|(limit, equal)| (if equal { "of at least" } else { "greater than" }, limit));
        let upper = self.upper.map(|(limit, equal)| (if equal { "at most" } else { "smaller than" }, limit));
        for (position, (words, limit)) in lower.into_iter().chain(upper).enumerate() {
            let joint = if position == 0 { "" } else { " and" };
            text.push_str(&format!("{joint} {words} {limit}"));
        }
        text
    }

    /// How a value is written, for example `"2.5 mm"`; pure numbers need no quotes.
    pub fn example(&self, number: &str) -> String {
        // Thousands of digits are no example.
        let number = if number.len() <= LONGEST_NUMBER { number } else { "1" };
        match self.dimension {
            Dimension::NONE => number.to_owned(),
            // Nobody writes grain sizes in metres.
            Dimension::LENGTH => format!("\"{number} mm\""),
            other => format!("\"{number} {}\"", other.unit()),
        }
    }

    /// Whether a value in SI lies in the range.
    pub(crate) fn includes(&self, value: f64) -> bool {
        let above = self.lower.is_none_or(|(limit, equal)| value > limit || (equal && value == limit));
        let below = self.upper.is_none_or(|(limit, equal)| value < limit || (equal && value == limit));
        above && below
    }
}

impl From<Dimension> for QuantityRule {
    fn from(dimension: Dimension) -> Self {
        Self::of(dimension)
    }
}

/// The longest number that an example repeats.
const LONGEST_NUMBER: usize = 30;

/// `a stiffness [N/m]`.
pub(crate) fn describe(dimension: Dimension) -> String {
    match dimension {
        Dimension::NONE => "a pure number".to_owned(),
        other if other.unit() == other.to_string() => format!("a quantity in [{other}]"),
        other => format!("{} [{}]", with_article(&other.quantity()), other.unit()),
    }
}

/// `an energy`, `a length`.
pub(crate) fn with_article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}
