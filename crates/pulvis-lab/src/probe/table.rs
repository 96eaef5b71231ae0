//! Curves as tables.

use super::{ProbeCurve, ProbeSample};
use pulvis_io::IoError;
use pulvis_io::table::{Cell, Table};

/// The columns of every table, in SI units.
pub const COLUMNS: [&str; 14] = [
    "time",
    "overlap",
    "force",
    "contact_radius",
    "stored_energy",
    "dissipated",
    "branch",
    "shear",
    "shear_force",
    "roll_torque",
    "twist_torque",
    "roll",
    "twist",
    "work",
];

/// One row an instant; of several curves, the name of the curve stands in one more column, the last.
///
/// # Errors
/// None in practice: every row has all columns.
pub fn result_table(curves: &[ProbeCurve]) -> Result<Table, IoError> {
    table(curves, |_| true)
}

/// As [`result_table`], with the turning points, and the instants before and after a change of branch.
///
/// # Errors
/// None in practice: every row has all columns.
pub fn summary_table(curves: &[ProbeCurve]) -> Result<Table, IoError> {
    table(curves, |around| {
        let [before, here, after] = around;
        let changes = |one: Option<&ProbeSample>| {
            one.is_none_or(|one| Some(one.branch) != here.map(|here| here.branch))
        };
        let turns = here.is_some_and(|here| here.leg.fract() == 0.0);
        turns || changes(before) || changes(after)
    })
}

/// The rows that are `wanted`, judged by the instants before, here and after.
fn table(
    curves: &[ProbeCurve],
    wanted: impl Fn([Option<&ProbeSample>; 3]) -> bool,
) -> Result<Table, IoError> {
    let several = curves.len() > 1;
    let mut table = Table::new(COLUMNS.into_iter().chain(several.then_some("curve")));
    for curve in curves {
        for (number, sample) in curve.samples.iter().enumerate() {
            let at = |number: Option<usize>| number.and_then(|number| curve.samples.get(number));
            if wanted([at(number.checked_sub(1)), Some(sample), at(Some(number + 1))]) {
                let label = several.then(|| Cell::from(curve.label.as_str()));
                table.push(cells(sample).into_iter().chain(label))?;
            }
        }
    }
    Ok(table)
}

fn cells(sample: &ProbeSample) -> [Cell; COLUMNS.len()] {
    [
        sample.time.into(),
        sample.overlap.into(),
        sample.force.into(),
        sample.contact_radius.into(),
        sample.stored_energy.into(),
        sample.dissipated.into(),
        sample.branch.into(),
        sample.shear.into(),
        sample.shear_force.into(),
        sample.roll_torque.into(),
        sample.twist_torque.into(),
        sample.roll.into(),
        sample.twist.into(),
        sample.work.into(),
    ]
}
