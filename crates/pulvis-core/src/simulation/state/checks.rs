//! What a state must be before anything is made of it.

use super::{CellState, GroupRecord, ListState, ParticleState, State, StateError};
use crate::particles::ParticleId;
use crate::simulation::checks::check_cell_motion;
use crate::simulation::{SetupError, check_count};
use crate::walls::Wall;

const FINITE: &str = "a finite number";
const POSITIVE: &str = "a finite number greater than zero";
const NOT_NEGATIVE: &str = "a finite number, zero at least";

impl State {
    /// Refuses what no simulation can have exported with these walls.
    pub(super) fn check(&self, walls: &[Wall]) -> Result<(), StateError> {
        let rows = self.particles.id.len();
        check_count(rows)?;
        check_values("time", [self.time], NOT_NEGATIVE)?;
        check_values("time_step", [self.time_step], POSITIVE)?;
        check_values("domain.lower", self.domain.extent.lower.to_array(), FINITE)?;
        check_values("domain.upper", self.domain.extent.upper.to_array(), FINITE)?;
        check_values("domain.tilts", self.domain.tilts, FINITE)?;
        let CellState { motion, listed, numbers } = &self.cell;
        check_values("cell.listed.lower", listed.extent.lower.to_array(), FINITE)?;
        check_values("cell.listed.upper", listed.extent.upper.to_array(), FINITE)?;
        check_values("cell.listed.tilts", listed.tilts, FINITE)?;
        check_numbers("the cell", numbers)?;
        if listed.periodic != self.domain.periodic {
            let problem = "other directions were periodic when it was made".to_owned();
            return Err(StateError::List { problem });
        }
        check_cell_motion(motion, &self.domain, self.time_step)?;
        check_values("gravity", self.background.gravity.to_array(), FINITE)?;
        check_values("drag", [self.background.drag, self.background.rotational_drag], NOT_NEGATIVE)?;
        self.particles.check(rows)?;
        self.check_ids()?;
        self.list.check(rows)?;
        self.check_walls(walls)?;
        self.check_groups()?;
        if self.keeps_ledger {
            check_numbers("ledger", &self.ledger)?;
        }
        Ok(())
    }

    fn check_ids(&self) -> Result<(), StateError> {
        let mut ids: Vec<ParticleId> = self.particles.id.clone();
        ids.sort_unstable();
        if let Some(twice) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(StateError::Id { id: twice[0], problem: "stands there twice" });
        }
        match ids.last() {
            Some(&id) if id >= self.next_id => {
                Err(StateError::Id { id, problem: "has not been given yet: it is not below `next_id`" })
            }
            _ => Ok(()),
        }
    }

    fn check_groups(&self) -> Result<(), StateError> {
        let mut prescribed: Vec<ParticleId> = Vec::new();
        let mut known = self.particles.id.clone();
        known.sort_unstable();
        for GroupRecord { name, ids, motion, start, travelled, work } in &self.groups {
            let owner = |of: &str| format!("{of} of group `{name}`");
            check_values(&owner("start"), [*start], FINITE)?;
            check_values(&owner("travelled"), *travelled, FINITE)?;
            check_values(&owner("work"), [*work], FINITE)?;
            let sorted = ids.windows(2).all(|pair| pair[0] < pair[1]);
            if let Some(&id) = ids.iter().find(|id| !sorted || known.binary_search(id).is_err()) {
                return Err(StateError::Id { id, problem: "of a group is not there, or not in order" });
            }
            if let Err(invalid) = motion.check() {
                let (name, problem) = (name.clone(), invalid.to_string());
                return Err(SetupError::GroupMotion { name, problem }.into());
            }
            prescribed.extend(ids.iter().filter(|_| motion.is_prescribed()));
        }
        prescribed.sort_unstable();
        match prescribed.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(twice) => Err(StateError::Id { id: twice[0], problem: "is prescribed by two groups" }),
            None => Ok(()),
        }
    }

    fn check_walls(&self, walls: &[Wall]) -> Result<(), StateError> {
        check_length("walls", self.walls.len(), walls.len())?;
        for (index, (record, wall)) in self.walls.iter().zip(walls).enumerate() {
            if record.name != wall.name {
                let (found, expected) = (format!("`{}`", record.name), format!("`{}`", wall.name));
                return Err(StateError::Wall { index, found, expected });
            }
            let name = |of: &str| format!("{of} of wall `{}`", record.name);
            check_values(&name("point"), record.point, FINITE)?;
            check_values(&name("listed_point"), record.listed_point, FINITE)?;
            check_values(&name("angle"), [record.angle, record.listed_angle], FINITE)?;
            check_values(&name("motion_start"), [record.motion_start], FINITE)?;
            check_numbers(&name("motion"), &record.motion)?;
        }
        Ok(())
    }
}

impl ParticleState {
    fn check(&self, rows: usize) -> Result<(), StateError> {
        check_length("material", self.material.len(), rows)?;
        check_column("radius", &self.radius, rows, POSITIVE)?;
        check_column("mass", &self.mass, rows, POSITIVE)?;
        check_vectors("position", &self.position, rows)?;
        check_vectors("velocity", &self.velocity, rows)?;
        check_vectors("angular_velocity", &self.angular_velocity, rows)?;
        check_vectors("force", &self.force, rows)?;
        check_vectors("torque", &self.torque, rows)?;
        if !self.applied_force.is_empty() {
            check_vectors("applied_force", &self.applied_force, rows)?;
        }
        for column in &self.columns {
            check_column(&column.name, &column.values, rows, FINITE)?;
        }
        Ok(())
    }
}

impl ListState {
    fn check(&self, rows: usize) -> Result<(), StateError> {
        check_values("mean_radius", [self.mean_radius], NOT_NEGATIVE)?;
        check_values("skin", [self.skin_thickest, self.skin_thinnest], NOT_NEGATIVE)?;
        check_vectors("list.position", &self.position, rows)?;
        check_column("radius_with_skin", &self.radius_with_skin, rows, POSITIVE)?;
        self.check_former_rows(rows)?;
        let chunks = self.displacement_largest.len();
        check_column("displacement_largest", &self.displacement_largest, chunks, NOT_NEGATIVE)?;
        check_column("displacement_second", &self.displacement_second, chunks, NOT_NEGATIVE)?;
        check_column("remaining_skin", &self.remaining_skin, chunks, FINITE)
    }

    fn check_former_rows(&self, rows: usize) -> Result<(), StateError> {
        check_length("former_row", self.former_row.len(), rows)?;
        let mut seen = vec![false; rows];
        for (index, &row) in self.former_row.iter().enumerate() {
            match seen.get_mut(row as usize) {
                Some(seen) if !*seen => *seen = true,
                _ => {
                    let (column, value) = ("former_row".to_owned(), f64::from(row));
                    return Err(StateError::Value { column, index, value, expected: "each row once" });
                }
            }
        }
        Ok(())
    }
}

fn check_length(column: &str, found: usize, expected: usize) -> Result<(), StateError> {
    if found == expected {
        Ok(())
    } else {
        Err(StateError::Length { column: column.to_owned(), found, expected })
    }
}

fn check_values(
    column: &str,
    values: impl IntoIterator<Item = f64>,
    expected: &'static str,
) -> Result<(), StateError> {
    let wrong = |value: f64| match expected {
        POSITIVE => !(value > 0.0 && value.is_finite()),
        NOT_NEGATIVE => !(value >= 0.0 && value.is_finite()),
        _ => !value.is_finite(),
    };
    match values.into_iter().enumerate().find(|(_, value)| wrong(*value)) {
        Some((index, value)) => Err(StateError::Value { column: column.to_owned(), index, value, expected }),
        None => Ok(()),
    }
}

fn check_column(column: &str, values: &[f64], rows: usize, expected: &'static str) -> Result<(), StateError> {
    check_length(column, values.len(), rows)?;
    check_values(column, values.iter().copied(), expected)
}

fn check_vectors(column: &str, vectors: &[[f64; 3]], rows: usize) -> Result<(), StateError> {
    check_length(column, vectors.len(), rows)?;
    for (index, vector) in vectors.iter().enumerate() {
        if let Some(&value) = vector.iter().find(|value| !value.is_finite()) {
            return Err(StateError::Value { column: column.to_owned(), index, value, expected: FINITE });
        }
    }
    Ok(())
}

fn check_numbers(owner: &str, numbers: &[(String, f64)]) -> Result<(), StateError> {
    for (name, value) in numbers {
        check_values(&format!("{name} in {owner}"), [*value], FINITE)?;
    }
    Ok(())
}
