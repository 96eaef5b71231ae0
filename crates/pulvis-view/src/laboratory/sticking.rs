//! The velocities between which pairs stick.

use super::{Outcome, document, words};
use pulvis_input::collision::{CollisionCase, CollisionScenario, Method, luding_pair};
use pulvis_lab::collision::{closed_form, sticking_ranges};
use serde_json::{Value, json};

/// For each contact the ranges of velocity \[m/s\] in which pairs stick, and whether a closed form or a search says so. An open end
/// is `null`.
pub(super) fn answer(text: &str) -> Outcome {
    let scenario = CollisionScenario::from_document(&document(text)?).map_err(words)?;
    let first = |number: usize| scenario.cases.iter().find(|case| case.contact_number == number);
    let contacts: Value = (0..scenario.labels.len()).filter_map(first).map(contact).collect();
    Ok(json!({ "contacts": contacts }))
}

fn contact(case: &CollisionCase) -> Value {
    if case.incidence.is_some() {
        return json!({ "ranges": [], "from": "none" });
    }
    if let Some(ranges) = known(case) {
        return json!({ "ranges": ranges, "from": "closed form" });
    }
    // Collisions in steps of one length would take seconds.
    if case.method != Method::Exact {
        return json!({ "ranges": [], "from": "none" });
    }
    match sticking_ranges(case.bodies, &case.contact, &case.surroundings) {
        Ok(ranges) => {
            let open = |[low, high]: [f64; 2]| [(low > 0.0).then_some(low), high.is_finite().then_some(high)];
            json!({ "ranges": ranges.into_iter().map(open).collect::<Vec<_>>(), "from": "search" })
        }
        Err(error) => json!({ "ranges": [], "from": "none", "failure": error.to_string() }),
    }
}

/// Of contacts whose collisions have closed forms in S1 (29) to (40).
fn known(case: &CollisionCase) -> Option<Vec<[Option<f64>; 2]>> {
    closed_form(case)?;
    let critical = luding_pair(&case.contact, &case.bodies.pair())?.critical_velocities();
    let low = critical.low_end.filter(|end| *end > 0.0).map(|end| [None, Some(end)]);
    let high = critical.high_onset.map(|onset| [Some(onset), critical.high_end]);
    Some(low.into_iter().chain(high).collect())
}
