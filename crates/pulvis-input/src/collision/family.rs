//! A second variable of a sweep: one curve for each of its values.

use super::sweep::{STEPS, swept_parameter};
use crate::comparison::LabelledContact;
use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Text;
use crate::spacing::read_values;
use pulvis_contact::catalogue::Value;
use pulvis_math::Dimension;

/// The second variable of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepFamily {
    /// Its dotted path in the file.
    pub path: String,
    /// Its symbol, with subscripts in `_{}`.
    pub symbol: String,
    /// Its unit.
    pub unit: String,
    /// Its values, in SI; the contact of number n has the n-th.
    pub values: Vec<f64>,
}

/// Keys of `[collision]` that can be the second variable: name, symbol, dimension.
const KEYS: [(&str, &str, Dimension); 6] = [
    ("collision.velocity", "v", Dimension::VELOCITY),
    ("collision.chi", "χ", Dimension::NONE),
    ("collision.zeta", "ζ", Dimension::NONE),
    ("collision.radius", "a", Dimension::LENGTH),
    ("collision.density", "ρ", Dimension::DENSITY),
    (STEPS, "steps per contact", Dimension::NONE),
];

impl SweepFamily {
    /// What the curve of a value is called in pictures.
    pub fn label(&self, value: f64) -> String {
        let unit = if self.unit == "1" { "" } else { &self.unit };
        format!("{} = {} {unit}", self.symbol, four_digits(value)).trim_end().to_owned()
    }
}

/// Reads `[collision.family]`.
pub(super) fn read_family(
    mut table: TableReader<'_>,
    contacts: &[LabelledContact],
) -> Result<SweepFamily, Reported> {
    let path = table.required("variable", Text)?;
    let [LabelledContact { contact, .. }] = contacts else {
        let found = "a second variable beside [[compare]]";
        return Err(table.refuse("variable", Problem::rule(found, "one of the two")));
    };
    let parameter = swept_parameter(&path, contact);
    let (symbol, unit, rule) = match (parameter, KEYS.into_iter().find(|(key, _, _)| *key == path)) {
        (Some((parameter, dimension, rule)), _) => (with_subscript(parameter.symbol), dimension.unit(), rule),
        (None, Some((_, symbol, dimension))) => {
            (symbol.to_owned(), dimension.unit(), QuantityRule::of(dimension).above(0.0).or_bare())
        }
        (None, None) => {
            let keys: Vec<&str> =
                KEYS.iter().map(|(key, _, _)| *key).chain(["contact.<role>.<parameter>"]).collect();
            return Err(table.refuse("variable", Problem::unknown_choice(&path, &keys)));
        }
    };
    let (values, _) = read_values(&mut table, rule)?;
    for value in &values {
        if let Some((parameter, _, _)) = parameter
            && let Err(error) = parameter.check(&Value::Number(*value))
        {
            return Err(table.refuse("values", Problem::Refused(Box::new(error))));
        }
    }
    table.finish();
    Ok(SweepFamily { path, symbol, unit, values })
}

/// `k_c^a` as `k_{c}^{a}`.
fn with_subscript(symbol: &str) -> String {
    let mut marked = String::new();
    let mut inside = false;
    for letter in symbol.chars() {
        if inside && !letter.is_alphanumeric() {
            marked.push('}');
            inside = false;
        }
        marked.push(letter);
        if matches!(letter, '_' | '^') {
            marked.push('{');
            inside = true;
        }
    }
    if inside { marked + "}" } else { marked }
}

/// A number with four significant digits at most.
fn four_digits(value: f64) -> String {
    let exact = value.to_string();
    if exact.len() <= 6 || value == 0.0 {
        return exact;
    }
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if (1e-3..1e5).contains(&value.abs()) { rounded.to_string() } else { format!("{rounded:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_short_and_have_subscripts() {
        let family = |symbol: &str, unit: &str| SweepFamily {
            path: String::new(),
            symbol: with_subscript(symbol),
            unit: unit.to_owned(),
            values: Vec::new(),
        };
        assert_eq!(family("k_c", "N/m").label(100.0 / 3.0), "k_{c} = 33.33 N/m");
        assert_eq!(family("k_c^a", "N/m").label(50.0), "k_{c}^{a} = 50 N/m");
        assert_eq!(family("χ", "1").label(1.0), "χ = 1");
        assert_eq!(family("φ_f'", "1").label(0.05), "φ_{f}' = 0.05");
        assert_eq!(family("a", "m").label(1.25e-5), "a = 1.25e-5 m");
    }
}
