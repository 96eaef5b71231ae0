//! Quantities of particles by name.

use pulvis_contact::catalogue::Value;

use super::{SetupError, Simulation};
use crate::columns::NamedColumn;
use crate::electrostatics::CHARGE;

/// Columns: quantities that the engine carries along with the particles, such as a charge or a temperature. They are
/// put into a new order with them, exported, and given for particles that are inserted.
impl Simulation {
    /// Gives all particles a quantity, or other values of one that they have. The values are in the order of the ids.
    ///
    /// # Errors
    /// There is not one finite value for each particle, or the column has no name; a law reads it and does not take the
    /// values, or acts as far as half a period with them. Nothing has changed then.
    pub fn set_column(&mut self, column: NamedColumn) -> Result<(), SetupError> {
        check_column(&column, self.particles.len())?;
        let mut values = vec![0.0; column.values.len()];
        for (row, value) in self.particles.rows_by_id().into_iter().zip(column.values) {
            values[row] = value;
        }
        let column = NamedColumn { values, ..column };
        if !self.is_read(&column.name) {
            self.replace_column(column);
            return Ok(());
        }
        let before = self.particles.columns.clone();
        self.replace_column(column);
        self.fit_interactions();
        let checked = self.check_quantities().and_then(|()| self.check_periods());
        let columns = std::mem::replace(&mut self.particles.columns, before);
        if let Err(error) = checked {
            self.fit_interactions();
            return Err(error);
        }
        // Contacts look for their columns when they are listed, and store another energy.
        self.switch(|simulation| {
            simulation.particles.columns = columns;
            simulation.renew_candidates();
        });
        Ok(())
    }

    fn replace_column(&mut self, column: NamedColumn) {
        let columns = &mut self.particles.columns;
        match columns.iter_mut().find(|known| known.name == column.name) {
            Some(known) => *known = column,
            None => columns.push(column),
        }
    }

    /// Whether a law reads the quantity of this name.
    fn is_read(&self, name: &str) -> bool {
        let mut read = self.interactions.models().flat_map(|model| model.particle_quantities());
        let acts = name == CHARGE && self.interactions.electrostatics().is_some();
        acts || read.any(|quantity| quantity.name == name)
    }

    /// Whether particles have all quantities that laws read.
    pub(super) fn check_quantities(&self) -> Result<(), SetupError> {
        for quantity in self.interactions.models().flat_map(|model| model.particle_quantities()) {
            let (name, unit) = (quantity.name.to_owned(), quantity.unit());
            let Some(column) = self.particles.column(quantity.name) else {
                let problem = format!("a law reads it [{unit}], but the particles do not have it");
                return Err(SetupError::Column { name, problem });
            };
            let invalid = |value: &&f64| quantity.check(&Value::Number(**value)).is_err();
            if let Some(value) = column.values.iter().find(invalid) {
                let problem = format!("a value is {value} {unit}, expected {}", quantity.allowed());
                return Err(SetupError::Column { name, problem });
            }
        }
        self.check_electrostatics()
    }

    /// Refuses columns that are not those of the particles, with `count` values each.
    pub(super) fn check_columns(&self, given: &[NamedColumn], count: usize) -> Result<(), SetupError> {
        let known = self.particles.columns();
        for column in known {
            match given.iter().filter(|new| new.name == column.name).count() {
                1 => {}
                0 => {
                    return refuse(
                        column,
                        "particles have it, but no values are given for those that come".into(),
                    );
                }
                _ => return refuse(column, "it is given twice".into()),
            }
        }
        for column in given {
            check_column(column, count)?;
            match self.particles.column(&column.name) {
                None => return refuse(column, "the particles that are there do not have it".into()),
                Some(known) if known.unit != column.unit => {
                    return refuse(
                        column,
                        format!("its unit is `{}`, expected `{}`", column.unit, known.unit),
                    );
                }
                Some(_) => {}
            }
        }
        Ok(())
    }
}

pub(super) fn check_column(column: &NamedColumn, count: usize) -> Result<(), SetupError> {
    if column.name.is_empty() {
        return refuse(column, "a column without a name; give it one".into());
    }
    if column.values.len() != count {
        return refuse(column, format!("{} values for {count} particles", column.values.len()));
    }
    match column.values.iter().find(|value| !value.is_finite()) {
        Some(value) => refuse(column, format!("a value is {value}, expected a finite number")),
        None => Ok(()),
    }
}

fn refuse(column: &NamedColumn, problem: String) -> Result<(), SetupError> {
    Err(SetupError::Column { name: column.name.clone(), problem })
}
