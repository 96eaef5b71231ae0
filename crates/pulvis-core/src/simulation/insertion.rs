//! Insertion and removal of particles between steps.

use pulvis_boundary::Region;

use super::{Simulation, check_count, checks};
use crate::columns::NamedColumn;
use crate::particles::{Particle, ParticleId};
use crate::{Particles, SetupError};

/// Insertion and removal. Both rebuild the neighbour list. Contacts of the remaining particles keep their memory. The ledger
/// books the change of the stored energy as inflow or outflow: kinetic energy, potential energy, and the energy stored in the
/// contacts of these particles.
impl Simulation {
    /// Inserts particles and returns their ids, in the given order. Ids continue from the last id ever used: none is used
    /// twice.
    ///
    /// # Errors
    /// What [`new`](Self::new) refuses, more particles than there are ids left, and particles without values where
    /// there are [columns](Self::set_column). The simulation is unchanged then.
    pub fn insert(&mut self, particles: &[Particle]) -> Result<Vec<ParticleId>, SetupError> {
        self.insert_with(particles, &[])
    }

    /// Inserts particles with the values that they have in all [columns](Self::set_column), in the order of the
    /// particles.
    ///
    /// # Errors
    /// As those of [`insert`](Self::insert), and columns that are not those of the particles that are there.
    pub fn insert_with(
        &mut self,
        particles: &[Particle],
        columns: &[NamedColumn],
    ) -> Result<Vec<ParticleId>, SetupError> {
        self.check_columns(columns, particles.len())?;
        if particles.is_empty() {
            return Ok(Vec::new());
        }
        checks::check_particles(particles)?;
        let before = self.particles.len();
        check_count(before + particles.len())?;
        let next = self.particles.next_id;
        // `check_count` has made sure that the number fits.
        if next.checked_add(particles.len() as ParticleId).is_none() {
            let (inserted, most) = (particles.len(), ParticleId::MAX - 1);
            return Err(SetupError::IdsUsedUp { inserted, next, most });
        }
        let (skin, mean_radius) = (self.skin.sizes(), self.mean_radius);
        // The ledger is taken before there are rows without forces.
        let closing_error = self.ledger().closing_error();
        self.note_broken_bonds();
        let ids = self.particles.append(particles);
        for column in &mut self.particles.columns {
            let new = columns.iter().filter(|new| new.name == column.name);
            new.for_each(|new| column.values.extend_from_slice(&new.values));
        }
        self.take_in_particles();
        let checked = self.check_models().and_then(|()| self.check_walls());
        if let Err(error) = checked.and_then(|()| self.check_periods()) {
            self.particles.truncate(before);
            self.particles.next_id = next;
            self.list_materials();
            self.skin.set_sizes(skin);
            self.mean_radius = mean_radius;
            return Err(error);
        }
        // Rows beyond the former ones stand for particles without memory.
        let former: Vec<u32> = (0..self.particles.len() as u32).collect();
        self.renew_after_exchange(&former);
        self.running.inflow += self.ledger().closing_error() - closing_error;
        Ok(ids.collect())
    }

    /// Removes the particles with these ids; an id may be given twice.
    ///
    /// # Errors
    /// There is no particle with one of the ids. The simulation is unchanged then.
    pub fn remove(&mut self, ids: &[ParticleId]) -> Result<(), SetupError> {
        let mut wanted = ids.to_vec();
        wanted.sort_unstable();
        wanted.dedup();
        let mut found = vec![false; wanted.len()];
        let stays: Vec<bool> = self
            .particles
            .id
            .iter()
            .map(|id| match wanted.binary_search(id) {
                Ok(index) => {
                    found[index] = true;
                    false
                }
                Err(_) => true,
            })
            .collect();
        if let Some(missing) = found.iter().position(|found| !found) {
            return Err(SetupError::UnknownParticle { id: wanted[missing] });
        }
        self.keep(&stays);
        Ok(())
    }

    /// Removes the particles for which `is_removed` is true, given all particles and a row. Returns their ids in ascending
    /// order.
    pub fn remove_where(&mut self, mut is_removed: impl FnMut(&Particles, usize) -> bool) -> Vec<ParticleId> {
        let particles = &self.particles;
        let stays: Vec<bool> = (0..particles.len()).map(|row| !is_removed(particles, row)).collect();
        let leaving = particles.id.iter().zip(&stays).filter(|(_, stays)| !**stays);
        let mut ids: Vec<ParticleId> = leaving.map(|(id, _)| *id).collect();
        ids.sort_unstable();
        self.keep(&stays);
        ids
    }

    /// Removes the particles whose centres lie in a region. Along periodic directions, any image of a centre counts. Returns
    /// their ids in ascending order.
    pub fn remove_within(&mut self, region: &Region) -> Vec<ParticleId> {
        let domain = self.domain;
        self.remove_where(|particles, row| region.contains(particles.positions()[row], &domain))
    }

    /// Removes the rows for which `stays` is false.
    fn keep(&mut self, stays: &[bool]) {
        let rows = (0..self.particles.len() as u32).zip(stays);
        let former: Vec<u32> = rows.filter(|(_, stays)| **stays).map(|(row, _)| row).collect();
        if former.len() == self.particles.len() {
            return;
        }
        let closing_error = self.ledger().closing_error();
        self.note_broken_bonds();
        self.particles.reorder(&former, &self.pool);
        self.take_in_particles();
        self.renew_after_exchange(&former);
        self.running.outflow -= self.ledger().closing_error() - closing_error;
    }

    /// Updates everything that depends on the set of particles.
    fn take_in_particles(&mut self) {
        self.list_materials();
        self.fit_skin();
    }

    /// Rebuilds the neighbour list after an insertion or removal, and computes the forces again. `former` holds the row of each
    /// particle at the last rebuild; new particles have rows beyond these.
    fn renew_after_exchange(&mut self, former: &[u32]) {
        self.phases = self.phases();
        self.contacts.remember(&mut self.memory, &self.pool);
        let was_empty = self.outcomes.is_empty();
        self.rebuild(Some(former));
        if was_empty && self.choose_skin() {
            self.rebuild(None);
        }
        self.rebuilds += 1;
        // Energy that inserted contacts dissipated before is not booked.
        let losses = self.running.contacts;
        self.evaluate_at_rest();
        self.running.set_losses(&losses);
    }
}
