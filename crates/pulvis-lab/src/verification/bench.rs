//! Where the checks of a law are collected.

use super::Check;
use super::data::{Row, rows};

/// How far a found value may be from the expected one, over the latter, and why.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    pub relative: f64,
    pub reason: &'static str,
}

/// The checks of one law.
#[derive(Debug)]
pub(super) struct Bench {
    law: &'static str,
    source: &'static str,
    checks: Vec<Check>,
}

impl Bench {
    pub fn new(law: &'static str) -> Self {
        Self { law, source: "", checks: Vec::new() }
    }

    /// Names where the expected values of the following checks are from.
    pub fn expect_from(&mut self, source: &'static str) {
        self.source = source;
    }

    /// One check. What could not be found is a miss.
    pub fn check(
        &mut self,
        quantity: &'static str,
        case: impl Into<String>,
        expected: f64,
        found: Option<f64>,
        tolerance: Tolerance,
    ) {
        self.checks.push(Check {
            law: self.law,
            quantity,
            case: case.into(),
            expected,
            found: found.unwrap_or(f64::NAN),
            tolerance: tolerance.relative,
            reason: tolerance.reason,
            source: self.source,
        });
    }

    /// One check for each row of a model in the file of values that is of one of the quantities.
    pub fn rows(
        &mut self,
        model: &str,
        quantities: &[&str],
        tolerance: Tolerance,
        found: impl Fn(&Row) -> Option<f64>,
    ) {
        self.source = "independent program (models.csv)";
        for row in rows().filter(|row| row.model == model && quantities.contains(&row.quantity)) {
            self.check(row.quantity, row.parameters, row.value, found(&row), tolerance);
        }
    }

    pub fn into_checks(self) -> Vec<Check> {
        self.checks
    }
}
