//! Particles that come and go between steps.

use pulvis_boundary::Region;

use super::{Simulation, check_count, checks};
use crate::columns::NamedColumn;
use crate::particles::{Particle, ParticleId};
use crate::{Particles, SetupError};

/// Insertion and removal. Both renew the neighbour list. Contacts of the particles that stay keep their memory.
/// The ledger books what the system stores more or less afterwards as inflow or outflow: kinetic energy, potential
/// energy, and what the contacts of these particles store.
impl Simulation {
    /// Inserts particles and answers with their ids, in the given order. Ids count on from the last one ever given:
    /// none is given twice.
    ///
    /// # Errors
    /// What [`new`](Self::new) refuses, more particles than there are ids left, and particles without values where
    /// there are [columns](Self::set_column). Nothing has changed then.
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
        // The ledger is drawn up before there are rows without forces.
        let closing_error = self.ledger().closing_error();
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
        // Rows behind those of then stand for particles without memory.
        let former: Vec<u32> = (0..self.particles.len() as u32).collect();
        self.renew_after_exchange(&former);
        self.running.inflow += self.ledger().closing_error() - closing_error;
        Ok(ids.collect())
    }

    /// Removes the particles of these ids; an id may stand there twice.
    ///
    /// # Errors
    /// There is no particle of one of the ids. Nothing has changed then.
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

    /// Removes the particles that `is_removed` picks, given all particles and a row, and answers with their ids in
    /// ascending order.
    pub fn remove_where(&mut self, mut is_removed: impl FnMut(&Particles, usize) -> bool) -> Vec<ParticleId> {
        let particles = &self.particles;
        let stays: Vec<bool> = (0..particles.len()).map(|row| !is_removed(particles, row)).collect();
        let leaving = particles.id.iter().zip(&stays).filter(|(_, stays)| !**stays);
        let mut ids: Vec<ParticleId> = leaving.map(|(id, _)| *id).collect();
        ids.sort_unstable();
        self.keep(&stays);
        ids
    }

    /// Removes the particles whose centres lie in a region, and answers with their ids in ascending order. Along
    /// periodic directions, any image of a centre counts.
    pub fn remove_within(&mut self, region: &Region) -> Vec<ParticleId> {
        let domain = self.domain;
        self.remove_where(|particles, row| region.contains(particles.positions()[row], &domain))
    }

    /// Removes the rows that do not stay.
    fn keep(&mut self, stays: &[bool]) {
        let rows = (0..self.particles.len() as u32).zip(stays);
        let former: Vec<u32> = rows.filter(|(_, stays)| **stays).map(|(row, _)| row).collect();
        if former.len() == self.particles.len() {
            return;
        }
        let closing_error = self.ledger().closing_error();
        self.particles.reorder(&former, &self.pool);
        self.take_in_particles();
        self.renew_after_exchange(&former);
        self.running.outflow -= self.ledger().closing_error() - closing_error;
    }

    /// Works out again what follows from which particles there are.
    fn take_in_particles(&mut self) {
        self.list_materials();
        self.fit_skin();
    }

    /// Renews the neighbour list after particles have come or gone, and computes the forces anew. `former` gives the
    /// row that each particle had when contacts were last listed; of new ones, rows behind these.
    fn renew_after_exchange(&mut self, former: &[u32]) {
        self.phases = self.phases();
        self.contacts.remember(&mut self.memory, &self.pool);
        let was_empty = self.outcomes.is_empty();
        self.rebuild(Some(former));
        if was_empty && self.choose_skin() {
            self.rebuild(None);
        }
        self.rebuilds += 1;
        // Contacts that come with an overlap have lost what they lost before.
        let losses = self.running.contacts;
        self.evaluate_at_rest();
        self.running.set_losses(&losses);
    }
}
