//! A quantity of any dimension.

use crate::context::Reported;
use crate::decimal::split_number;
use crate::problem::Problem;
use crate::quantity::{QuantityRule, check_si, parse_bare, parse_quantity};
use crate::shape::Shape;
use crate::unit::Unit;
use crate::value::Value;
use crate::value_reader::ValueReader;
use pulvis_math::Dimension;

/// A finite number with any unit, or none; gives its value in SI and its dimension.
#[derive(Clone, Copy, Debug)]
pub struct AnyQuantity;

impl Shape for AnyQuantity {
    type Output = (f64, Dimension);

    fn describe(&self) -> String {
        "a quantity with its unit, or a pure number".to_owned()
    }

    fn example(&self) -> Option<String> {
        Some("\"1 pC\"".to_owned())
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<(f64, Dimension), Reported> {
        let (read, dimension) = match value.raw() {
            Value::Text(text) => {
                let unit = split_number(text.trim()).map_or("", |(_, unit)| unit);
                let dimension = Unit::parse(unit).map(|unit| unit.dimension).map_err(|error| {
                    value.refuse(Problem::rule(format!("\"{text}\": {error}"), self.describe()))
                })?;
                (parse_quantity(text, QuantityRule::of(dimension)), dimension)
            }
            Value::Integer(digits) | Value::Number(digits) => {
                (parse_bare(digits, QuantityRule::of(Dimension::NONE)), Dimension::NONE)
            }
            // A program that gives no unit means a pure number here as everybody does.
            Value::Si(number) => (check_si(*number, QuantityRule::of(Dimension::NONE)), Dimension::NONE),
            _ => return Err(value.wrong_type(&self.describe())),
        };
        Ok((read.map_err(|error| value.refuse(error.into()))?, dimension))
    }
}
