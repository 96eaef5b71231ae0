//! Checks of the contact laws against values that are not theirs: closed forms, published numbers, and what another
//! program computed.
//!
//! Found values come from the laws as a simulation uses them: on a path of overlaps or shear, in a collision, or in the
//! engine. One file of `suites/` holds the checks of related laws; a new law gets its checks there, and its line in the
//! list of that file.

mod bench;
mod contact;
mod data;
mod motion;
mod search;
mod suites;

use pulvis_contact::catalogue::Role;
use pulvis_input::contact::entries;
use pulvis_io::IoError;
use pulvis_io::table::{Cell, Table};

use bench::Bench;

/// One quantity of a law, expected and found.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The law, by its name in the catalogue.
    pub law: &'static str,
    /// What is compared.
    pub quantity: &'static str,
    /// The parameters and the motion, in SI units.
    pub case: String,
    /// What it should be [SI].
    pub expected: f64,
    /// What the law gives [SI]; NaN where it gives nothing.
    pub found: f64,
    /// How large the error may be, over the expected value; over 1 where that is zero.
    pub tolerance: f64,
    /// Why that large.
    pub reason: &'static str,
    /// Where the expected value is from.
    pub source: &'static str,
}

impl Check {
    /// How far the found value is from the expected one, over the latter; over 1 where that is zero.
    pub fn error(&self) -> f64 {
        let scale = if self.expected == 0.0 { 1.0 } else { self.expected.abs() };
        (self.found - self.expected).abs() / scale
    }

    /// Whether the error is within the tolerance; a NaN is not.
    pub fn passes(&self) -> bool {
        self.error() <= self.tolerance
    }
}

/// The laws that have checks, in the order of the catalogue.
pub fn verified_laws() -> Vec<&'static str> {
    let names = suites::ALL.iter().flat_map(|suite| suite.iter().map(|(name, _)| *name));
    let mut verified: Vec<&str> = names.filter(|name| exists(name)).collect();
    verified.sort_by_key(|name| catalogue().position(|known| known == *name));
    verified
}

/// All checks of a law, none where it has none.
pub fn verify(law: &str) -> Vec<Check> {
    let mut checks = Vec::new();
    for (name, run) in suites::ALL.iter().flat_map(|suite| suite.iter()) {
        if *name == law && exists(name) {
            let mut bench = Bench::new(name);
            run(&mut bench);
            checks.extend(bench.into_checks());
        }
    }
    checks
}

/// The names of all laws, some of which play several roles.
fn catalogue() -> impl Iterator<Item = &'static str> {
    Role::ALL.into_iter().flat_map(entries).map(|entry| entry.name)
}

fn exists(law: &str) -> bool {
    catalogue().any(|known| known == law)
}

/// The checks as a table; a `brief` one leaves out what would not fit on a screen.
///
/// # Errors
/// None in practice: every row has all columns.
pub fn verification_table(checks: &[Check], brief: bool) -> Result<Table, IoError> {
    const COLUMNS: [&str; 10] =
        ["law", "quantity", "expected", "found", "error", "tolerance", "result", "reason", "source", "case"];
    let count = if brief { 7 } else { COLUMNS.len() };
    let mut table = Table::new(COLUMNS.into_iter().take(count));
    for check in checks {
        let cells = [
            Cell::from(check.law),
            check.quantity.into(),
            check.expected.into(),
            check.found.into(),
            check.error().into(),
            check.tolerance.into(),
            if check.passes() { "ok" } else { "MISS" }.into(),
            check.reason.into(),
            check.source.into(),
            check.case.as_str().into(),
        ];
        table.push(cells.into_iter().take(count))?;
    }
    Ok(table)
}

/// Quantities in the file of values that no law of the catalogue has, by model.
#[cfg(test)]
const NOT_CHECKED: &[(&str, &[&str])] = &[
    // Contacts end with the overlap here, not with the force; the series is checked where it is good.
    ("linear_spring_dashpot", &["e_F0", "tc_F0"]),
    ("hertz_kuwabara_kono", &["e_end_at_force0", "e_series_2"]),
    // Numbers that describe a material.
    ("dmt", &["tabor"]),
    ("tomas_published", &["kappa"]),
];

/// Models whose law may not be in the catalogue yet; then their values wait for it.
#[cfg(test)]
const AWAITED: &[(&str, &str)] = &[
    ("brilliantov2007", "viscoelastic-jkr"),
    ("lee_radok_sls", "lee-radok"),
    ("thornton_no_adhesion", "thornton-ning"),
    ("thornton_ning", "thornton-ning"),
    ("tomas_published", "tomas"),
    ("tomas_continuous", "tomas"),
];

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    fn check(expected: f64, found: f64) -> Check {
        let text = "";
        let (case, tolerance) = (String::new(), 1e-6);
        Check { law: text, quantity: text, case, expected, found, tolerance, reason: text, source: text }
    }

    #[test]
    fn a_check_passes_within_its_tolerance_and_never_without_a_number() {
        assert!(
            check(2.0, 2.000_001).passes() && check(-2.0, -2.000_001).passes() && check(0.0, 1e-7).passes()
        );
        for (expected, found) in [(2.0, 2.000_01), (2.0, -2.0), (0.0, 1e-5), (2.0, f64::NAN), (f64::NAN, 2.0)]
        {
            assert!(!check(expected, found).passes(), "{found} for {expected}");
        }
    }

    #[test]
    fn every_law_gives_what_is_expected_of_it_and_every_value_in_the_file_is_used() {
        let checks: Vec<Check> = verified_laws().into_iter().flat_map(verify).collect();
        let missed: Vec<&Check> = checks.iter().filter(|check| !check.passes()).collect();
        assert!(missed.is_empty(), "{missed:#?}");
        assert!(checks.iter().all(|check| !check.source.is_empty() && !check.reason.is_empty()));
        let used = |row: &data::Row| {
            let of_row = |check: &Check| check.quantity == row.quantity && check.case == row.parameters;
            checks.iter().any(of_row)
                || NOT_CHECKED
                    .iter()
                    .any(|(model, named)| *model == row.model && named.contains(&row.quantity))
                || AWAITED.iter().any(|(model, law)| *model == row.model && !exists(law))
        };
        let unused: Vec<_> = data::rows().filter(|row| !used(row)).collect();
        assert!(unused.is_empty(), "{unused:#?}");
    }
}
