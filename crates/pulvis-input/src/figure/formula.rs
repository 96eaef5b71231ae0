//! Closed forms of the course of a run, given by numbers.

use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_math::{Dimension, elementary};

/// y = offset + amplitude (1 + (x − start)/scale)^exponent: relaxation by a power law, as of a gas that cools, or a law that
/// saturates. All in the SI units of the columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Formula {
    /// y at the start.
    pub amplitude: f64,
    /// What x − start is compared with.
    pub scale: f64,
    /// The power.
    pub exponent: f64,
    /// x at the start.
    pub start: f64,
    /// What is added.
    pub offset: f64,
}

impl Formula {
    /// y at x; not a number before the formula begins.
    pub fn at(&self, x: f64) -> f64 {
        let base = 1.0 + (x - self.start) / self.scale;
        if base > 0.0 {
            self.offset + self.amplitude * elementary::powf(base, self.exponent)
        } else {
            f64::NAN
        }
    }
}

/// Reads the table `formula`, if it is there.
pub(super) fn read_formula(table: &mut TableReader<'_>) -> Result<Option<Formula>, Reported> {
    let Some(mut table) = table.optional_table("formula")? else { return Ok(None) };
    let amplitude = table.required("amplitude", Dimension::NONE);
    let scale = table.required("scale", QuantityRule::of(Dimension::NONE).above(0.0));
    let exponent = table.required("exponent", Dimension::NONE);
    let start = table.or("start", QuantityRule::of(Dimension::NONE), 0.0);
    let offset = table.or("offset", Dimension::NONE, 0.0);
    table.finish();
    Ok(Some(Formula {
        amplitude: amplitude?,
        scale: scale?,
        exponent: exponent?,
        start: start?,
        offset: offset?,
    }))
}

/// Refuses a formula that nothing asks for, and its absence where something does; `key` is what asks.
pub(super) fn needed(
    table: &TableReader<'_>,
    formula: Option<Formula>,
    key: &str,
    asked: bool,
) -> Result<Option<Formula>, Reported> {
    match (formula, asked) {
        (Some(_), false) => {
            let problem = Problem::rule(format!("`{key}` does not ask for one"), "no `formula`");
            Err(table.refuse("formula", problem))
        }
        (None, true) => {
            let expected = "formula = { amplitude = 1.0, scale = 0.5, exponent = -2 }, in SI units";
            let problem = Problem::MissingKey { key: "formula".to_owned(), expected: expected.to_owned() };
            Err(table.refuse("", problem))
        }
        (formula, _) => Ok(formula),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_values_at_the_start_and_one_scale_later() {
        let formula = Formula { amplitude: 8.0, scale: 0.5, exponent: -2.0, start: 1.0, offset: 0.0 };
        assert!((formula.at(1.0) - 8.0).abs() < 1e-14 && (formula.at(1.5) - 2.0).abs() < 1e-14);
        assert!(formula.at(0.4).is_nan());
        let raised = Formula { offset: 3.0, ..formula };
        assert!((raised.at(1.5) - 5.0).abs() < 1e-14);
    }
}
