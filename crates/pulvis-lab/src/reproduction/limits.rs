//! The speeds at which pairs begin and cease to stick.

use super::ReproductionError;
use crate::collision::sticking_ranges;
use pulvis_input::collision::{CollisionCase, CollisionScenario, luding_pair};
use pulvis_input::figure::limited_pair;

/// The quantity by which checks name them.
pub(super) const QUANTITY: &str = "limits";

/// A search takes some eighty collisions: of many contacts so many are searched, spread over all.
const MOST_SEARCHED: usize = 6;

/// The search begins at this part of v_p0, give or take a step.
const BELOW_SEARCH: f64 = 1.3e-3;

/// The three limits, as speeds out of reach of all forces [m/s].
pub(super) type Limits = [Option<f64>; 3];

/// What the three limits are called.
pub(super) const NAMES: [&str; 3] = ["sticks below", "sticks from", "sticks up to"];

/// Ends of a range that lie nearer than this ratio may be passed over by the search, which goes in tenths of a decade.
const FOUND_FOR_SURE: f64 = 1.3;

/// End of the first range of sticking, beginning and end of the second, as speeds out of reach of all forces [m/s];
/// `None` where there is none, or where nothing is known of the contact.
pub(super) fn in_theory(case: &CollisionCase) -> Limits {
    let Some(pair) = luding_pair(&case.contact, &case.bodies.pair()) else { return [None; 3] };
    let limits = pair.critical_velocities();
    let real = |limit: &f64| *limit > 0.0 && limit.is_finite();
    [limits.low_end, limits.high_onset, limits.high_end].map(|limit| limit.filter(real))
}

/// The limits of contacts of a sweep, found by collisions, with the numbers of the contacts.
pub(super) fn search(scenario: &CollisionScenario) -> Result<Vec<(usize, Limits)>, ReproductionError> {
    let count = scenario.labels.len();
    let chosen = count.min(MOST_SEARCHED);
    let number = |place: usize| if chosen > 1 { place * (count - 1) / (chosen - 1) } else { 0 };
    let of = |contact: usize| {
        let case = first_case(scenario, contact)?;
        Some(searched(case).map(|limits| (contact, limits)))
    };
    (0..chosen).map(number).filter_map(of).collect()
}

/// The first collision of a contact.
pub(super) fn first_case(scenario: &CollisionScenario, contact: usize) -> Option<&CollisionCase> {
    scenario.cases.iter().find(|case| case.contact_number == contact)
}

fn searched(case: &CollisionCase) -> Result<Limits, ReproductionError> {
    let mut limits = [None; 3];
    for [from, to] in sticking_ranges(case.bodies, &case.contact, &case.surroundings)? {
        let end = Some(to).filter(|to| to.is_finite());
        if from > 0.0 {
            (limits[1], limits[2]) = (Some(from), end);
        } else {
            limits[0] = end;
        }
    }
    // One range from zero on is both in one where the two have merged.
    if limits[1].is_none() && in_theory(case)[0].is_none() {
        limits.swap(0, 2);
    }
    Ok(limits)
}

/// By how much what was `found` is off, relative, for each limit of theory that a search has to find.
pub(super) fn deviations(case: &CollisionCase, found: Limits) -> Vec<(f64, &'static str)> {
    let theory = in_theory(case);
    let wide = theory[1].zip(theory[2]).is_none_or(|(from, to)| to > FOUND_FOR_SURE * from);
    let least = limited_pair(case).map_or(0.0, |pair| BELOW_SEARCH * pair.v_p0());
    let deviation = |(number, name): (usize, &'static str)| {
        let limit = theory[number]?;
        match found[number] {
            Some(found) => Some(((found / limit - 1.0).abs(), name)),
            None if limit < least || (number > 0 && !wide) => None,
            None => Some((f64::NAN, name)),
        }
    };
    NAMES.into_iter().enumerate().filter_map(deviation).collect()
}
