//! Results as tables.

use super::SweepPoint;
use super::outcome::{Regime, Sample};
use pulvis_input::collision::{Bodies, CollisionScenario, SweptVariable, luding_pair};
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

/// The columns that results of oblique collisions have beside [`COLUMNS`], in SI units.
pub const OBLIQUE_COLUMNS: [&str; 14] = [
    "angle",
    "restitution_tangential",
    "restitution_contact",
    "rebound_angle",
    "rebound_angle_contact",
    "impulse_ratio",
    "omega_i_x",
    "omega_i_y",
    "omega_i_z",
    "omega_j_x",
    "omega_j_y",
    "omega_j_z",
    "momentum_error",
    "angular_momentum_error",
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

/// The columns that trajectories of oblique collisions have beside [`TRAJECTORY_COLUMNS`], in SI units.
pub const OBLIQUE_TRAJECTORY_COLUMNS: [&str; 5] =
    ["tangential_velocity", "contact_velocity", "tangential_force", "omega_i_z", "omega_j_z"];

/// How many of the columns a table for the screen has.
const BRIEF: usize = 10;

/// What a table of oblique collisions for the screen has.
const BRIEF_OBLIQUE: [&str; 10] = [
    "velocity",
    "angle",
    "restitution",
    "restitution_tangential",
    "restitution_contact",
    "rebound_angle",
    "impulse_ratio",
    "omega_i_z",
    "omega_j_z",
    "regime",
];

/// One row a collision. Where contacts are compared, the name of the contact stands in one more column; where a parameter
/// is swept, its value in the last, that of a second variable in the one before. A `brief` table leaves out what would not fit on a screen.
///
/// # Errors
/// None in practice: every row has all columns.
pub fn result_table(
    scenario: &CollisionScenario,
    points: &[SweepPoint],
    brief: bool,
) -> Result<Table, IoError> {
    let oblique = scenario.cases.iter().any(|case| case.incidence.is_some());
    let wanted = |(number, name): &(usize, &str)| match (brief, oblique) {
        (true, true) => BRIEF_OBLIQUE.contains(name),
        (true, false) => *number < BRIEF,
        (false, oblique) => oblique || *number < COLUMNS.len(),
    };
    let columns = || COLUMNS.into_iter().chain(OBLIQUE_COLUMNS).enumerate().filter(wanted);
    let key = match &scenario.variable {
        SweptVariable::Key { path, .. } => Some(path.as_str()),
        _ => None,
    };
    let family = scenario.family.as_ref();
    let several = scenario.labels.len() > 1 && family.is_none();
    let names = columns().map(|(_, name)| name);
    let second = family.map(|family| family.path.as_str());
    let mut table = Table::new(names.chain(several.then_some("contact")).chain(second).chain(key));
    for point in points {
        let label = scenario.labels.get(point.case.contact_number).filter(|_| several);
        let label = label.map(|label| Cell::from(label.as_str()));
        let value = key.map(|_| Cell::Number(point.case.value));
        let cells: Vec<Cell> = cells(point).into_iter().chain(oblique_cells(point)).collect();
        let wanted = columns().map(|(number, _)| cells.get(number).cloned().unwrap_or(Cell::Empty));
        let second = family.map(|family| family.values.get(point.case.contact_number).copied().into());
        table.push(wanted.chain(label).chain(second).chain(value))?;
    }
    Ok(table)
}

fn oblique_cells(point: &SweepPoint) -> [Cell; OBLIQUE_COLUMNS.len()] {
    let outcome = point.collision.outcome;
    let rebounds = outcome.regime == Regime::Rebound;
    let oblique = outcome.oblique.filter(|_| rebounds);
    let spins = oblique.map(|oblique| oblique.angular_velocities);
    // A wall does not spin.
    let spin_j = spins.filter(|_| matches!(point.case.bodies, Bodies::Pair(_)));
    let errors = outcome.oblique.and_then(|oblique| oblique.momentum_errors);
    [
        point.case.incidence.map(|incidence| incidence.angle).into(),
        oblique.and_then(|oblique| oblique.restitution_tangential).into(),
        oblique.and_then(|oblique| oblique.restitution_contact).into(),
        oblique.map(|oblique| oblique.rebound_angle).into(),
        oblique.map(|oblique| oblique.rebound_angle_contact).into(),
        oblique.map(|oblique| oblique.impulse_ratio).into(),
        spins.map(|[spin, _]| spin.x).into(),
        spins.map(|[spin, _]| spin.y).into(),
        spins.map(|[spin, _]| spin.z).into(),
        spin_j.map(|[_, spin]| spin.x).into(),
        spin_j.map(|[_, spin]| spin.y).into(),
        spin_j.map(|[_, spin]| spin.z).into(),
        errors.map(|[linear, _]| linear).into(),
        errors.map(|[_, angular]| angular).into(),
    ]
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
        theory.and_then(|theory| theory.overlap_max).into(),
        theory.and_then(|theory| theory.overlap_end).into(),
        outcome.stop_branch.into(),
        outcome.energy_error.into(),
    ]
}

/// The course of one collision.
///
/// # Errors
/// None in practice: every row has all columns.
pub fn trajectory_table(course: &[Sample]) -> Result<Table, IoError> {
    let oblique = course.iter().any(|sample| sample.oblique.is_some());
    let more = OBLIQUE_TRAJECTORY_COLUMNS.into_iter().filter(|_| oblique);
    let mut table = Table::new(TRAJECTORY_COLUMNS.into_iter().chain(more));
    for sample in course {
        let tangential = sample.oblique.map(|oblique| {
            let [spin_i, spin_j] = oblique.angular_velocities;
            [oblique.velocity, oblique.contact_velocity, oblique.force, spin_i, spin_j]
        });
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
        table.push(row.into_iter().chain(tangential.into_iter().flatten()).map(Cell::Number))?;
    }
    Ok(table)
}
