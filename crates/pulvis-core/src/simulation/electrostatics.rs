//! Charges that act on each other over all distances.

use std::ops::Range;

use pulvis_boundary::Electrostatics;
use pulvis_math::{Packed4, Vector3};
use pulvis_parallel::exchange::ExchangeError;

use super::{SetupError, Simulation};
use crate::electrostatics::{CHARGE, ForcesOfCharges};
use crate::shared::Shared;

impl Simulation {
    /// The force of all other charges on a row [N], where charges act over all
    /// [distances](crate::Interactions::set_electrostatics).
    pub fn electrostatic_force(&self, row: usize) -> Option<Vector3> {
        self.particles.electrostatic.get(row).map(|force| force.vector)
    }

    /// Takes the forces of all charges at the present positions. To be called before a sweep.
    pub(super) fn sum_charges(&mut self) -> Result<(), ExchangeError> {
        if self.interactions.electrostatics().is_some() {
            self.gather_positions()?;
        }
        self.sum_charges_of(self.contacts.own());
        Ok(())
    }

    /// The same for all rows, where this rank knows all positions.
    pub(super) fn sum_charges_of_all(&mut self) {
        self.sum_charges_of(0..self.contacts.chunks().len());
    }

    fn sum_charges_of(&mut self, own: Range<usize>) {
        let charges = self.particles.columns.iter().find(|column| column.name == CHARGE);
        let (Some(electrostatics), Some(column)) = (self.interactions.electrostatics(), charges) else {
            self.particles.electrostatic.clear();
            return;
        };
        self.charges.take_in(electrostatics, &column.values, &self.particles.position);
        let forces = &mut self.particles.electrostatic;
        forces.resize(self.particles.position.len(), Packed4::default());
        let (forces, charges, instructions) = (Shared::new(forces), &self.charges, self.instructions);
        let chunks = &self.contacts.chunks()[own.clone()];
        self.pool.for_each(&mut self.outcomes[own], |number, _| {
            let rows = chunks[number].rows.clone();
            // SAFETY: chunks have different rows.
            let forces = unsafe { forces.range_mut(rows.clone()) };
            instructions.run(ForcesOfCharges { charges, rows, forces });
        });
    }

    /// Whether charges can act over all distances here, if they are to.
    pub(super) fn check_electrostatics(&self) -> Result<(), SetupError> {
        let Some(Electrostatics { relative_permittivity }) = self.interactions.electrostatics().copied()
        else {
            return Ok(());
        };
        let refuse = |problem: String| Err(SetupError::Electrostatics(problem));
        if !(relative_permittivity > 0.0 && relative_permittivity.is_finite()) {
            let found = format!("the relative permittivity is {relative_permittivity}");
            return refuse(format!("{found}, expected a number greater than zero"));
        }
        if self.domain.periodic.contains(&true) {
            return refuse("the domain is periodic, and a sum over all images is not built in".to_owned());
        }
        let mut read = self.interactions.models().flat_map(|model| model.particle_quantities());
        if read.any(|quantity| quantity.name == CHARGE) {
            return refuse("a contact law reads the charge too, which would then act twice".to_owned());
        }
        let Some(column) = self.particles.column(CHARGE) else {
            return refuse(format!("the particles have no quantity `{CHARGE}`"));
        };
        let (found, most) =
            (column.values.iter().filter(|charge| **charge != 0.0).count(), Electrostatics::MOST_CHARGES);
        if found > most {
            return refuse(format!("{found} particles have a charge, more than {most}"));
        }
        Ok(())
    }
}
