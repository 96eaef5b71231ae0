//! The parameters of a law, read as its entry in the catalogue describes them.

use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_contact::catalogue::{InvalidParameter, Kind, Parameter, Presence, Range, Value, Values};
use pulvis_math::Dimension;

/// Reads every parameter that stands in the table, in SI and within its own range.
///
/// Defaults are not filled in: `LawEntry::complete` does that, and it alone, so that a law means the
/// same from a file and from a program. The table is left open for keys that are no parameters, such
/// as `law`.
///
/// # Errors
/// Parameters are missing, of another shape, or out of range; all of that has been reported.
pub fn read_parameters(table: &mut TableReader<'_>, parameters: &[Parameter]) -> Result<Values, Reported> {
    let mut values = Values::new();
    let mut failure = None;
    for parameter in parameters {
        match read_parameter(table, parameter) {
            Ok(Some(value)) => values.set(parameter.name, value),
            Ok(None) => {}
            Err(reported) => failure = Some(reported),
        }
    }
    failure.map_or(Ok(values), Err)
}

fn read_parameter(table: &mut TableReader<'_>, parameter: &Parameter) -> Result<Option<Value>, Reported> {
    // What can follow from the materials may be left out.
    let required = parameter.presence == Presence::Required && parameter.mixing.is_none();
    match parameter.kind {
        Kind::Number { dimension, range, may_be_infinite } => {
            let rule = rule(dimension, range, may_be_infinite);
            let number = if required {
                table.required(parameter.name, rule).map(Some)
            } else {
                table.optional(parameter.name, rule)
            };
            Ok(number?.map(Value::Number))
        }
        Kind::Numbers { dimension, range, length: (least, most) } => {
            let shape = List::of(rule(dimension, range, false)).at_least(least).at_most(most);
            let numbers = if required {
                table.required(parameter.name, shape).map(Some)
            } else {
                table.optional(parameter.name, shape)
            };
            Ok(numbers?.map(Value::Numbers))
        }
        Kind::Choice(options) => {
            let names: Vec<&str> = options.iter().map(|option| option.name).collect();
            let shape = Name(&names);
            let name = if required {
                table.required(parameter.name, shape).map(Some)
            } else {
                table.optional(parameter.name, shape)
            };
            Ok(name?.map(|name| Value::Choice(name.to_owned())))
        }
    }
}

pub(crate) fn rule(dimension: Dimension, range: Range, may_be_infinite: bool) -> QuantityRule {
    let rule = QuantityRule::of(dimension);
    let rule = match range {
        Range::Any => rule,
        Range::Positive => rule.above(0.0),
        Range::NonNegative => rule.at_least(0.0),
        Range::AtLeast(least) => rule.at_least(least),
        Range::Within(above, up_to) => rule.above(above).at_most(up_to),
        Range::Between(from, up_to) => rule.at_least(from).at_most(up_to),
    };
    if may_be_infinite { rule.or_infinite() } else { rule }
}

/// Reports that a law refuses its parameters, at the value that it names.
pub fn refuse_parameter(table: &TableReader<'_>, error: InvalidParameter) -> Reported {
    let name = error.name().to_owned();
    table.refuse(&name, Problem::Refused(Box::new(error)))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;
    use crate::{Document, InputErrors};
    use pulvis_contact::catalogue::Choice;

    const CHOICES: &[Choice] = &[
        Choice { name: "linear", meaning: "proportional" },
        Choice { name: "square-root", meaning: "steeper at first" },
    ];
    const PARAMETERS: &[Parameter] = &[
        Parameter::number("k1", "k₁", Dimension::STIFFNESS, Range::Positive, "loading"),
        Parameter::number("kc", "k_c", Dimension::STIFFNESS, Range::NonNegative, "cohesion").or(0.0),
        Parameter::number("kc_a", "k_c^a", Dimension::STIFFNESS, Range::Positive, "reach").or_infinite(),
        Parameter::number("phi_f", "φ_f", Dimension::NONE, Range::Within(0.0, 1.0), "depth"),
        Parameter::choice("interpolation", "", CHOICES, "linear", "between k1 and kp"),
    ];

    fn read(text: &str) -> Result<Values, InputErrors> {
        Document::from_str("law.toml", text)?.read(|mut table| {
            let values = read_parameters(&mut table, PARAMETERS);
            table.finish();
            values
        })
    }

    #[test]
    fn parameters_arrive_in_si_and_defaults_are_left_to_the_law() {
        let values = read("k1 = \"0.1 kN/m\"\nkc_a = \"inf\"\nphi_f = 0.05").unwrap();
        let expected = Values::new().with("k1", 100.0).with("kc_a", f64::INFINITY).with("phi_f", 0.05);
        assert_eq!(values, expected);
    }

    #[test]
    fn every_parameter_that_is_wrong_is_named_in_one_run() {
        let text = "kc = \"-1 N/m\"\nkc_a = \"inf\"\nphi_f = 1.5\ninterpolation = \"cubic\"\nkp = 2";
        let errors = read(text).unwrap_err();
        let lines: Vec<String> = errors.errors().iter().map(|error| error.headline()).collect();
        assert_eq!(
            lines,
            [
                "1:6: kc: \"-1 N/m\" is out of range; expected a stiffness [N/m] of at least 0",
                "3:9: phi_f: 1.5 is out of range; expected a pure number greater than 0 and at most 1",
                "4:17: interpolation: found \"cubic\"; expected \"linear\" or \"square-root\"",
                "5:1: kp: unknown key",
                "1:1: missing `k1`; expected a stiffness [N/m] greater than 0",
            ]
        );
    }

    #[test]
    fn the_refusal_of_a_law_points_at_the_parameter() {
        let document = Document::from_str("law.toml", "k1 = \"1 N/m\"\nkc = \"2 N/m\"").unwrap();
        let errors = document
            .read(|table| -> Result<(), Reported> {
                let error = InvalidParameter::OutOfRange {
                    name: "kc",
                    found: "2 N/m".to_owned(),
                    expected: "at most k1".to_owned(),
                };
                Err(refuse_parameter(&table, error))
            })
            .unwrap_err();
        assert_eq!(errors.errors()[0].headline(), "2:6: kc: `kc` is 2 N/m, expected at most k1");
    }
}
