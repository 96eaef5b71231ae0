//! Values of a variable: a list, or equal steps or ratios from one end to the other.

use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Integer, Name};
use pulvis_math::elementary;

/// More values than any picture needs.
const MOST_VALUES: i64 = 100_000;

/// The keys of equal steps or ratios.
pub(crate) const RANGE_KEYS: [&str; 4] = ["from", "to", "points", "spacing"];

/// Reads a list of `values`, or `from`, `to`, `points` and `spacing`; and whether they are spaced by equal ratios.
pub(crate) fn read_values(
    table: &mut TableReader<'_>,
    rule: QuantityRule,
) -> Result<(Vec<f64>, bool), Reported> {
    let listed = table.optional("values", List::of(rule).at_least(1))?;
    let mut logarithmic = false;
    let values = match listed {
        Some(values) => {
            if let Some(key) = RANGE_KEYS.into_iter().find(|key| table.value(key).is_some()) {
                return Err(table.refuse(
                    key,
                    Problem::rule("given beside `values`", "either `values` or `from`, `to`, `points`"),
                ));
            }
            values
        }
        None if !RANGE_KEYS.into_iter().any(|key| table.keys().contains(&key)) => {
            let expected = "a list of values, or `from`, `to` and `points`".to_owned();
            return Err(table.refuse("values", Problem::MissingKey { key: "values".to_owned(), expected }));
        }
        None => read_range(table, rule, &mut logarithmic)?,
    };
    Ok((values, logarithmic))
}

/// Reads `from`, `to`, `points` and `spacing`.
pub(crate) fn read_range(
    table: &mut TableReader<'_>,
    rule: QuantityRule,
    logarithmic: &mut bool,
) -> Result<Vec<f64>, Reported> {
    let from = table.required("from", rule);
    let to = table.required("to", rule);
    let points = table.required("points", Integer::between(2, MOST_VALUES));
    let spacing = table.or("spacing", Name(&["linear", "log"]), "linear");
    let (from, to, points) = (from?, to?, points?);
    *logarithmic = spacing? == "log";
    for (key, end) in [("from", from), ("to", to)] {
        if *logarithmic && end <= 0.0 {
            let found = format!("{end} has no logarithm");
            return Err(
                table.refuse(key, Problem::rule(found, "a value greater than 0, or spacing = \"linear\""))
            );
        }
    }
    let between = |share: f64| {
        if *logarithmic { from * elementary::powf(to / from, share) } else { from + (to - from) * share }
    };
    #[allow(clippy::cast_precision_loss)] // few
    let inner = (1..points - 1).map(|number| between(number as f64 / (points - 1) as f64));
    // The ends exactly as written.
    Ok(std::iter::once(from).chain(inner).chain(std::iter::once(to)).collect())
}
