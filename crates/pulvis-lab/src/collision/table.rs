//! Results as tables.

use super::SweepPoint;
use super::outcome::Sample;
use pulvis_input::collision::{CollisionScenario, SweptVariable, luding_pair};
use pulvis_io::IoError;
use pulvis_io::table::{Cell, Table};

/// The columns of every result table, in SI units.
pub const COLUMNS: [&str; 14] = [
    // The first ten are what people look at.
    "velocity",
    "chi",
    "zeta",
    "restitution",
    "restitution_theory",
    "overlap_max",
    "overlap_end",
    "regime",
    "contact_duration",
    "energy_dissipated",
    "overlap_max_theory",
    "overlap_end_theory",
    "stop_branch",
    "energy_error",
];

/// The columns of a trajectory, in SI units.
pub const TRAJECTORY_COLUMNS: [&str; 10] = [
    "time",
    "overlap",
    "velocity",
    "force",
    "delta_max",
    "kinetic",
    "potential_available",
    "potential_plastic",
    "dissipated",
    "potential_attraction",
];

/// How many of the columns a table for the screen has.
const BRIEF: usize = 10;

/// One row a collision; where a parameter is swept, its value stands in one more column, the last.
/// A `brief` table leaves out what would not fit on a screen.
///
/// # Errors
/// None in practice: every row has all columns.
pub fn result_table(
    scenario: &CollisionScenario,
    points: &[SweepPoint],
    brief: bool,
) -> Result<Table, IoError> {
    let count = if brief { BRIEF } else { COLUMNS.len() };
    let key = match &scenario.variable {
        SweptVariable::Key { path, .. } => Some(path.as_str()),
        _ => None,
    };
    let mut table = Table::new(COLUMNS.into_iter().take(count).chain(key));
    for point in points {
        let value = key.map(|_| Cell::Number(point.case.value));
        table.push(cells(point).into_iter().take(count).chain(value))?;
    }
    Ok(table)
}

fn cells(point: &SweepPoint) -> [Cell; COLUMNS.len()] {
    let outcome = &point.collision.outcome;
    let velocity = point.case.velocity;
    let pair =
        luding_pair(&point.case.contact, &point.case.bodies.pair()).filter(|pair| pair.dp().is_finite());
    let touch = pair.map(|pair| pair.touch_velocity(velocity));
    let theory = point.theory;
    [
        velocity.into(),
        pair.zip(touch).map(|(pair, touch)| pair.chi(touch)).into(),
        pair.zip(touch).and_then(|(pair, touch)| pair.zeta(touch)).into(),
        outcome.restitution.into(),
        theory.map(|theory| theory.restitution).into(),
        outcome.overlap_max.into(),
        outcome.overlap_end.into(),
        outcome.regime.name().into(),
        outcome.contact_duration.into(),
        outcome.energy_dissipated.into(),
        theory.map(|theory| theory.overlap_max).into(),
        theory.map(|theory| theory.overlap_end).into(),
        outcome.stop_branch.into(),
        outcome.energy_error.into(),
    ]
}

/// The course of one collision.
///
/// # Errors
/// None in practice: every row has all columns.
pub fn trajectory_table(course: &[Sample]) -> Result<Table, IoError> {
    let mut table = Table::new(TRAJECTORY_COLUMNS);
    for sample in course {
        let row = [
            sample.time,
            sample.overlap,
            sample.velocity,
            sample.force,
            sample.delta_max,
            sample.kinetic,
            sample.potential_available,
            sample.potential_plastic,
            sample.dissipated,
            sample.potential_attraction,
        ];
        table.push(row.map(Cell::Number))?;
    }
    Ok(table)
}
