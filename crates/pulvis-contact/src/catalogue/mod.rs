//! How a law describes itself: its parameters, equations and source, in one table.
//!
//! Help texts, scenario keys, documentation tables and conformance tests all follow from the
//! [`LawEntry`] that stands in the law's own file.

use std::fmt;

use pulvis_math::Dimension;

mod list;
pub mod mixing;
mod values;

pub(crate) use list::law_list;
pub use values::{InvalidParameter, Value, Values};

/// Which part of a contact a law is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// Force along the line of centres while the bodies overlap.
    Normal,
    /// Attraction that also acts at a distance.
    NonContact,
    /// Dashpot along the line of centres.
    Viscosity,
    /// Resistance against sliding.
    Sliding,
    /// Resistance against rolling.
    Rolling,
    /// Resistance against torsion (spinning about the line of centres).
    Torsion,
    /// Springs that hold two bodies together until they break.
    Bond,
    /// Choices in which codes differ.
    Conventions,
    /// What contacts are expected to go through.
    Expected,
}

impl Role {
    /// Every role, in the order in which a contact is described.
    pub const ALL: [Self; 9] = [
        Self::Normal,
        Self::NonContact,
        Self::Viscosity,
        Self::Sliding,
        Self::Rolling,
        Self::Torsion,
        Self::Bond,
        Self::Conventions,
        Self::Expected,
    ];

    /// The key of the table that holds this law in a scenario, for example `normal`.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::NonContact => "noncontact",
            Self::Viscosity => "viscosity",
            Self::Sliding => "sliding",
            Self::Rolling => "rolling",
            Self::Torsion => "torsion",
            Self::Bond => "bond",
            Self::Conventions => "conventions",
            Self::Expected => "expected",
        }
    }
}

/// Which numbers a parameter takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Every finite number.
    Any,
    /// Greater than zero.
    Positive,
    /// Zero or greater.
    NonNegative,
    /// At least this.
    AtLeast(f64),
    /// Greater than the first and at most the second.
    Within(f64, f64),
    /// At least the first and at most the second.
    Between(f64, f64),
}

impl Range {
    /// Whether the range holds `value`; an infinite value is judged by its sign only.
    pub fn holds(self, value: f64) -> bool {
        match self {
            Self::Any => !value.is_nan(),
            Self::Positive => value > 0.0,
            Self::NonNegative => value >= 0.0,
            Self::AtLeast(least) => value >= least,
            Self::Within(above, up_to) => value > above && value <= up_to,
            Self::Between(from, up_to) => value >= from && value <= up_to,
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => write!(out, "any number"),
            Self::Positive => write!(out, "> 0"),
            Self::NonNegative => write!(out, ">= 0"),
            Self::AtLeast(least) => write!(out, ">= {least}"),
            Self::Within(above, up_to) => write!(out, "> {above} and <= {up_to}"),
            Self::Between(from, up_to) => write!(out, ">= {from} and <= {up_to}"),
        }
    }
}

/// One of the names that a choice parameter takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// What the user writes.
    pub name: &'static str,
    /// What it means.
    pub meaning: &'static str,
}

/// What a parameter is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A quantity.
    Number {
        /// Its dimension.
        dimension: Dimension,
        /// The numbers allowed, in SI units.
        range: Range,
        /// Whether `inf` is a value of it.
        may_be_infinite: bool,
    },
    /// One name of several.
    Choice(&'static [Choice]),
    /// A list of quantities.
    Numbers {
        /// The dimension of each.
        dimension: Dimension,
        /// The numbers allowed, in SI units.
        range: Range,
        /// The least and the largest length.
        length: (usize, usize),
    },
}

/// Whether a parameter must be given, and what holds where it is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Presence {
    /// It must be given.
    Required,
    /// It may be left out; the law's file says what that means.
    Optional,
    /// A number in SI units.
    Default(f64),
    /// A name.
    DefaultChoice(&'static str),
}

/// One parameter of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The key in a scenario, the papers' symbol in plain letters: `k1`, `phi_f`.
    pub name: &'static str,
    /// The symbol in equations: `k₁`, `φ_f`.
    pub symbol: &'static str,
    /// What it is.
    pub kind: Kind,
    /// Whether it must be given.
    pub presence: Presence,
    /// What it means, in one sentence.
    pub meaning: &'static str,
    /// How it follows from the two materials where it is not given.
    pub mixing: Option<&'static mixing::Mixing>,
}

impl Parameter {
    /// A quantity that must be given and is finite.
    pub const fn number(
        name: &'static str,
        symbol: &'static str,
        dimension: Dimension,
        range: Range,
        meaning: &'static str,
    ) -> Self {
        let kind = Kind::Number { dimension, range, may_be_infinite: false };
        Self { name, symbol, kind, presence: Presence::Required, meaning, mixing: None }
    }

    /// One name of several, with the one that holds where none is given.
    pub const fn choice(
        name: &'static str,
        symbol: &'static str,
        options: &'static [Choice],
        default: &'static str,
        meaning: &'static str,
    ) -> Self {
        let presence = Presence::DefaultChoice(default);
        Self { name, symbol, kind: Kind::Choice(options), presence, meaning, mixing: None }
    }

    /// A list of quantities that must be given, of a least and a largest length.
    pub const fn numbers(
        name: &'static str,
        symbol: &'static str,
        dimension: Dimension,
        range: Range,
        length: (usize, usize),
        meaning: &'static str,
    ) -> Self {
        let kind = Kind::Numbers { dimension, range, length };
        Self { name, symbol, kind, presence: Presence::Required, meaning, mixing: None }
    }

    /// The same parameter with a number [SI] that holds where none is given.
    pub const fn or(self, default: f64) -> Self {
        Self { presence: Presence::Default(default), ..self }
    }

    /// The same parameter, which follows from the properties of the two materials where it is not given.
    pub const fn from_materials(self, mixing: &'static mixing::Mixing) -> Self {
        Self { mixing: Some(mixing), ..self }
    }

    /// The same parameter, not required.
    pub const fn optional(self) -> Self {
        Self { presence: Presence::Optional, ..self }
    }

    /// The same parameter, which may also be infinite.
    pub const fn or_infinite(self) -> Self {
        let kind = match self.kind {
            Kind::Number { dimension, range, .. } => Kind::Number { dimension, range, may_be_infinite: true },
            kind @ (Kind::Choice(_) | Kind::Numbers { .. }) => kind,
        };
        Self { kind, ..self }
    }

    /// The unit of a quantity, `choice` for a choice.
    pub fn unit(&self) -> String {
        match self.kind {
            Kind::Number { dimension, .. } | Kind::Numbers { dimension, .. } => dimension.unit(),
            Kind::Choice(_) => "choice".to_owned(),
        }
    }

    /// The values allowed, as text.
    pub fn allowed(&self) -> String {
        match self.kind {
            Kind::Number { range, may_be_infinite: true, .. } => format!("{range}, or inf"),
            Kind::Number { range, .. } => range.to_string(),
            Kind::Numbers { range, length: (least, most), .. } => {
                format!("list of {least} to {most}, each {range}")
            }
            Kind::Choice(options) => {
                let names: Vec<_> = options.iter().map(|option| format!("\"{}\"", option.name)).collect();
                names.join(" | ")
            }
        }
    }

    /// The default as text, or what stands in its place.
    pub fn default_text(&self) -> String {
        match self.presence {
            Presence::Required => "required".to_owned(),
            Presence::Optional => "optional".to_owned(),
            Presence::Default(value) => value.to_string(),
            Presence::DefaultChoice(name) => format!("\"{name}\""),
        }
    }
}

/// Everything that a reader, a scenario file and a test need to know of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawEntry {
    /// Which part of a contact it is.
    pub role: Role,
    /// The name in a scenario: `luding`.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// The equations, as lines of plain text.
    pub equations: &'static str,
    /// Publication and equation numbers.
    pub source: &'static str,
    /// The parameters, in the order of the documentation.
    pub parameters: &'static [Parameter],
    /// Quantities of each particle that it reads, numbers that have a column of this name; at most
    /// [`MOST_QUANTITIES`](crate::pair::MOST_QUANTITIES). Laws along the line of centres only. One that is optional is
    /// read where the parameters say so.
    pub particle_quantities: &'static [Parameter],
    /// The columns of memory that each contact carries, with their units.
    pub memory: &'static [&'static str],
    /// The closed form that the law is verified against, and the test that does it.
    pub closed_form: &'static str,
    /// A scenario table that works, in TOML.
    pub example: &'static str,
}

/// A law that stands in the catalogue.
pub trait Law: Copy + fmt::Debug + Send + Sync + 'static {
    /// The law's own description.
    const ENTRY: LawEntry;

    /// The law with these parameters, which [`LawEntry::complete`] has checked one by one; what is
    /// left to check is how they fit together.
    fn from_values(values: &Values) -> Result<Self, InvalidParameter>;
}

impl LawEntry {
    /// The parameter called `name`.
    pub fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    /// Checks each value against its parameter and adds the defaults.
    pub fn complete(&self, given: &Values) -> Result<Values, InvalidParameter> {
        for (name, _) in given.iter() {
            if self.parameter(name).is_none() {
                let known: Vec<_> = self.parameters.iter().map(|known| format!("`{}`", known.name)).collect();
                return Err(InvalidParameter::Unknown { name: name.to_owned(), known: known.join(", ") });
            }
        }
        let mut complete = Values::new();
        for parameter in self.parameters {
            match (given.get(parameter.name), parameter.presence) {
                (Some(value), _) => complete.set(parameter.name, parameter.check(value)?),
                (None, Presence::Required) => {
                    return Err(InvalidParameter::Missing { name: parameter.name });
                }
                (None, Presence::Optional) => {}
                (None, Presence::Default(number)) => complete.set(parameter.name, Value::Number(number)),
                (None, Presence::DefaultChoice(name)) => {
                    complete.set(parameter.name, Value::Choice(name.to_owned()));
                }
            }
        }
        Ok(complete)
    }
}

impl Parameter {
    /// The value itself where the parameter takes it.
    pub fn check(&self, value: &Value) -> Result<Value, InvalidParameter> {
        let allowed = match (self.kind, value) {
            (Kind::Number { range, may_be_infinite, .. }, Value::Number(number)) => {
                range.holds(*number) && (number.is_finite() || may_be_infinite)
            }
            (Kind::Numbers { range, length: (least, most), .. }, Value::Numbers(numbers)) => {
                (least..=most).contains(&numbers.len())
                    && numbers.iter().all(|number| range.holds(*number) && number.is_finite())
            }
            (Kind::Choice(options), Value::Choice(name)) => options.iter().any(|option| option.name == name),
            _ => false,
        };
        if allowed {
            return Ok(value.clone());
        }
        let found = match value {
            Value::Number(number) => format!("{number} {}", self.unit()),
            Value::Choice(name) => format!("\"{name}\""),
            Value::Numbers(numbers) => format!("{numbers:?} {}", self.unit()),
        };
        Err(InvalidParameter::OutOfRange { name: self.name, found, expected: self.allowed() })
    }
}
