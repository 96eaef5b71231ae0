//! What a value can be: quantity, whole number, text, choice, list, vector.

use crate::context::Reported;
use crate::problem::{Problem, one_of};
use crate::quantity::{QuantityRule, check_si, parse_bare, parse_quantity};
use crate::value::Value;
use crate::value_reader::ValueReader;
use pulvis_math::Dimension;

/// A kind of value that a key can demand.
pub trait Shape {
    /// What is read.
    type Output;

    /// The expectation in words, with article: `a stiffness [N/m]`.
    fn describe(&self) -> String;

    /// How such a value is written in the file.
    fn example(&self) -> Option<String> {
        None
    }

    /// Reads a value.
    ///
    /// # Errors
    /// It has another shape; that has been reported.
    fn read(&self, value: &ValueReader<'_>) -> Result<Self::Output, Reported>;
}

impl Shape for QuantityRule {
    type Output = f64;

    fn describe(&self) -> String {
        QuantityRule::describe(self)
    }

    fn example(&self) -> Option<String> {
        Some(QuantityRule::example(self, "1"))
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<f64, Reported> {
        let result = match value.raw() {
            Value::Text(text) => parse_quantity(text, *self),
            Value::Integer(digits) | Value::Number(digits) => parse_bare(digits, *self),
            Value::Si(number) => check_si(*number, *self),
            _ => return Err(value.wrong_type(&QuantityRule::describe(self))),
        };
        result.map_err(|error| value.refuse(error.into()))
    }
}

impl Shape for Dimension {
    type Output = f64;

    fn describe(&self) -> String {
        Shape::describe(&QuantityRule::of(*self))
    }

    fn example(&self) -> Option<String> {
        Shape::example(&QuantityRule::of(*self))
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<f64, Reported> {
        Shape::read(&QuantityRule::of(*self), value)
    }
}

/// A whole number in a range. `1e6` counts as one: it is how large counts are written.
#[derive(Clone, Copy, Debug)]
pub struct Integer {
    least: i64,
    most: i64,
}

impl Integer {
    /// Any whole number.
    pub const ANY: Self = Self { least: i64::MIN, most: i64::MAX };

    /// A whole number of at least `least`.
    pub const fn at_least(least: i64) -> Self {
        Self { least, ..Self::ANY }
    }

    /// A whole number from `least` to `most`.
    pub const fn between(least: i64, most: i64) -> Self {
        Self { least, most }
    }
}

/// Beyond 2^53 neighbouring whole numbers share one double.
const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;

impl Shape for Integer {
    type Output = i64;

    fn describe(&self) -> String {
        match (self.least, self.most) {
            (i64::MIN, i64::MAX) => "a whole number".to_owned(),
            (least, i64::MAX) => format!("a whole number of at least {least}"),
            (least, most) => format!("a whole number from {least} to {most}"),
        }
    }

    fn example(&self) -> Option<String> {
        Some(self.least.max(1).min(self.most).to_string())
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<i64, Reported> {
        let whole = |number: f64| {
            let exact = number.fract() == 0.0 && number.abs() <= LARGEST_EXACT;
            #[allow(clippy::cast_possible_truncation)] // whole and in range, so exact
            exact.then_some(number as i64)
        };
        let (number, found) = match value.raw() {
            Value::Integer(digits) => (digits.parse().ok(), digits.clone()),
            Value::Number(digits) => match digits.parse().ok().and_then(whole) {
                None => return Err(value.wrong_type(&self.describe())),
                number => (number, digits.clone()),
            },
            Value::Si(number) => (whole(*number), number.to_string()),
            _ => return Err(value.wrong_type(&self.describe())),
        };
        match number {
            Some(number) if (self.least..=self.most).contains(&number) => Ok(number),
            _ => Err(value.refuse(Problem::IntegerRange { found, expected: self.describe() })),
        }
    }
}

/// True or false.
#[derive(Clone, Copy, Debug)]
pub struct Boolean;

impl Shape for Boolean {
    type Output = bool;

    fn describe(&self) -> String {
        "true or false".to_owned()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<bool, Reported> {
        match value.raw() {
            Value::Boolean(boolean) => Ok(*boolean),
            _ => Err(value.wrong_type(&self.describe())),
        }
    }
}

/// A text that is not empty.
#[derive(Clone, Copy, Debug)]
pub struct Text;

impl Shape for Text {
    type Output = String;

    fn describe(&self) -> String {
        "a text in quotes".to_owned()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<String, Reported> {
        match value.raw() {
            Value::Text(text) if !text.trim().is_empty() => Ok(text.clone()),
            Value::Text(_) => Err(value.wrong_type("a text that is not empty")),
            _ => Err(value.wrong_type(&self.describe())),
        }
    }
}

/// One of some names, for example of the laws in the catalogue; gives the name back.
#[derive(Clone, Copy, Debug)]
pub struct Name<'n>(pub &'n [&'n str]);

impl<'n> Shape for Name<'n> {
    type Output = &'n str;

    fn describe(&self) -> String {
        let names: Vec<String> = self.0.iter().map(|&name| name.to_owned()).collect();
        one_of(&names)
    }

    fn example(&self) -> Option<String> {
        self.0.first().map(|name| format!("\"{name}\""))
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<&'n str, Reported> {
        let Value::Text(text) = value.raw() else { return Err(value.wrong_type(&self.describe())) };
        let chosen = self.0.iter().copied().find(|name| name == text);
        chosen.ok_or_else(|| value.refuse(Problem::unknown_choice(text, self.0)))
    }
}

/// One of some names, each of which stands for a value.
#[derive(Clone, Copy, Debug)]
pub struct Choice<'n, T>(pub &'n [(&'n str, T)]);

impl<T: Copy> Choice<'_, T> {
    fn names(&self) -> Vec<&str> {
        self.0.iter().map(|(name, _)| *name).collect()
    }
}

impl<T: Copy> Shape for Choice<'_, T> {
    type Output = T;

    fn describe(&self) -> String {
        Name(&self.names()).describe()
    }

    fn example(&self) -> Option<String> {
        Name(&self.names()).example()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<T, Reported> {
        let names = self.names();
        let name = Name(&names).read(value)?;
        let chosen = self.0.iter().find(|(known, _)| *known == name).map(|(_, meaning)| *meaning);
        chosen.ok_or_else(|| value.refuse(Problem::unknown_choice(name, &names)))
    }
}
