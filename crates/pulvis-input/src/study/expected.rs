//! What the numbers of a study have to be.

use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Name, Text};
use pulvis_math::Dimension;

/// What the mean of a measure has to be: |mean − value| ≤ tolerance + 2 standard errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// The value at each point.
    pub values: Vec<f64>,
    /// By how much the mean may differ, beside two standard errors.
    pub tolerance: f64,
    /// Where the value is from.
    pub source: String,
    /// How certain it is: A is exact or stands in the source, B was read off or is disputed, C is an estimate.
    pub certainty: Option<String>,
}

/// Reads `expected`, `tolerance`, `source` and `certainty`. `points` are the choices of the values.
pub(super) fn read_expected(
    table: &mut TableReader<'_>,
    points: &[&[usize]],
) -> Result<Option<Expected>, Reported> {
    let number = QuantityRule::of(Dimension::NONE);
    let expected = table.optional("expected", List::of(number).at_least(1).or_single());
    let tolerance = table.optional("tolerance", number.at_least(0.0));
    let source = table.optional("source", Text);
    let certainty = table.optional("certainty", Name(&["A", "B", "C"]));
    let Some(listed) = expected? else {
        let beside = ["tolerance", "source", "certainty"].into_iter().find(|key| table.value(key).is_some());
        return match beside {
            Some(key) => Err(table.refuse(key, Problem::rule("given without `expected`", "both or none"))),
            None => Ok(None),
        };
    };
    let (tolerance, source, certainty) = (tolerance?, source?, certainty?);
    let missing = |key: &str, expected: &str| {
        table.refuse("", Problem::MissingKey { key: key.to_owned(), expected: expected.to_owned() })
    };
    let tolerance = tolerance
        .ok_or_else(|| missing("tolerance", "by how much the mean may differ, beside two standard errors"))?;
    let source = source.ok_or_else(|| missing("source", "where the expected value is from"))?;
    let values = spread(&listed, points).ok_or_else(|| {
        let first = points.iter().filter_map(|choice| choice.first()).max().map_or(1, |most| most + 1);
        let expected = match (first, points.len()) {
            (_, 1) => "one value".to_owned(),
            (first, all) if first == all => format!("one value, or {all}: one for each point"),
            (first, all) => {
                format!("one value, {first} (one for each value of the first variable), or {all} (one for each point)")
            }
        };
        table.refuse("expected", Problem::WrongLength { found: listed.len(), expected })
    })?;
    Ok(Some(Expected { values, tolerance, source, certainty: certainty.map(str::to_owned) }))
}

/// The value at each point: one for all, one for each value of the first variable, or one for each point.
fn spread(listed: &[f64], points: &[&[usize]]) -> Option<Vec<f64>> {
    if let [only] = listed {
        return Some(vec![*only; points.len()]);
    }
    if listed.len() == points.len() {
        return Some(listed.to_vec());
    }
    let most = points.iter().filter_map(|choice| choice.first()).max()?;
    if listed.len() != most + 1 {
        return None;
    }
    points.iter().map(|choice| listed.get(*choice.first()?).copied()).collect()
}
