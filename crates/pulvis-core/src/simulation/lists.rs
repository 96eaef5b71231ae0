//! Rebuilds of the neighbour list.

use std::ops::Range;

use pulvis_parallel::exchange::ExchangeError;

use super::{Outcome, Simulation};
use crate::contacts::Surroundings;
use crate::neighbours::{CellGrid, Moved};
use crate::particles::ForceTorque;
use crate::phases::Stopwatch;
use crate::shared::Shared;

/// The thickest skin of a particle over the mean radius, in a packing and in a gas. Lists with thicker skins are rebuilt less
/// often but contain more pairs that do not touch; a gas has few pairs.
const SKIN_IN_PACKING: f64 = 0.3;
const SKIN_IN_GAS: f64 = 0.8;
/// The skin if periods are too short for a thicker one.
const SKIN_IN_SHORT_PERIODS: f64 = 0.1;
/// Neighbour pairs per particle below which a system counts as a gas, and above which it counts as a packing.
const GAS: f64 = 1.5;
const PACKING: f64 = 3.0;

impl Simulation {
    fn take_mean_radius(&mut self) {
        let count = self.particles.len().max(1) as f64;
        self.mean_radius = self.particles.radius.iter().sum::<f64>() / count;
    }

    /// Sets the skin after an insertion or removal: its ratio to the mean radius stays, as far as periods allow.
    pub(super) fn fit_skin(&mut self) {
        let (before, [thickest, thinnest]) = (self.mean_radius, self.skin.sizes());
        self.take_mean_radius();
        if !self.chooses_skin {
            return;
        }
        let of_mean = [SKIN_IN_PACKING, SKIN_IN_GAS, SKIN_IN_SHORT_PERIODS];
        match of_mean.into_iter().find(|factor| (factor * before).to_bits() == thickest.to_bits()) {
            Some(factor) if thickest > 0.0 => {
                let thickest_now = factor * self.mean_radius;
                self.skin.set_sizes([thickest_now, thinnest * (thickest_now / thickest)]);
            }
            _ => self.choose_first_skin(),
        }
        if self.check_periods().is_err() {
            self.choose_first_skin();
        }
        // The removal of small particles increases the mean radius, and with it the skin.
        if self.check_periods().is_err() {
            self.skin.set_sizes([thickest, thinnest]);
        }
    }

    /// Sets the first skin, as far as periods allow.
    pub(super) fn choose_first_skin(&mut self) {
        self.take_mean_radius();
        self.skin.set_thickest(SKIN_IN_PACKING * self.mean_radius);
        if self.check_periods().is_err() {
            self.skin.set_thickest(SKIN_IN_SHORT_PERIODS * self.mean_radius);
        }
    }

    pub(super) fn renew_candidates(&mut self) {
        let mut clock = Stopwatch::start(self.phases.is_some());
        self.remember_contacts();
        self.rebuild(None);
        self.note_time_of_list(&mut clock);
    }

    /// The same within an advance that ranks share, where all rows are known to all.
    pub(super) fn renew_among_ranks(&mut self) -> Result<(), ExchangeError> {
        let mut clock = Stopwatch::start(self.phases.is_some());
        self.tell_broken_bonds()?;
        self.remember_contacts();
        let (grid, order) = self.sort_rows();
        self.list_among_ranks(&grid, &order)?;
        self.former_rows = order;
        self.find_rows_of_groups();
        self.note_time_of_list(&mut clock);
        Ok(())
    }

    fn remember_contacts(&mut self) {
        self.phases = self.phases();
        self.choose_skin();
        self.note_broken_bonds();
        self.contacts.remember(&mut self.memory, &self.pool);
    }

    fn note_time_of_list(&mut self, clock: &mut Stopwatch) {
        self.rebuilds += 1;
        if let Some(phases) = &mut self.phases {
            clock.lap(&mut phases.neighbours);
        }
    }

    /// Takes note of bonds that have broken since the last rebuild. To be called before rows change.
    pub(super) fn note_broken_bonds(&mut self) {
        self.broken_bonds.take_in(self.contacts.broken(&self.particles.id));
    }

    /// Sets the skin that suits the number of neighbour pairs in the present list, as far as periods allow. Returns whether
    /// it has changed.
    pub(super) fn choose_skin(&mut self) -> bool {
        if !self.chooses_skin {
            return false;
        }
        let candidates = self.candidates() as f64 / self.particles.len().max(1) as f64;
        let suited = if candidates < GAS {
            SKIN_IN_GAS
        } else if candidates > PACKING {
            SKIN_IN_PACKING
        } else {
            return false;
        };
        let before = (self.skin.thickest, self.skin.thinnest);
        let suited = suited * self.mean_radius;
        if suited.to_bits() == before.0.to_bits() {
            return false;
        }
        self.skin.set_thickest(suited);
        let fits = self.check_periods().is_ok();
        if !fits {
            (self.skin.thickest, self.skin.thinnest) = before;
        }
        fits
    }

    /// Brings all positions back into the periodic box.
    fn wrap(&mut self) {
        let (domain, gravity) = (&self.domain, self.background.gravity);
        let masses = &self.particles.mass;
        let positions = Shared::new(&mut self.particles.position);
        let [fallen] = self.pool.sum_over(masses.len(), |rows| {
            // SAFETY: the ranges have no common rows.
            let positions = unsafe { positions.range_mut(rows.clone()) };
            let mut fallen = 0.0;
            for (position, mass) in positions.iter_mut().zip(&masses[rows]) {
                let wrapped = domain.wrapped(position.vector);
                // A particle that falls through a periodic boundary falls on: its potential must not jump.
                fallen += mass * gravity.dot(wrapped - position.vector);
                position.vector = wrapped;
            }
            [fallen]
        });
        self.running.gravity_wrapped += fallen;
    }

    /// Puts the particles into cell order and lists all pairs within interaction range and skins. If particles were inserted
    /// or removed since the last rebuild, `former` holds the row at that time for each present row.
    pub(super) fn rebuild(&mut self, former: Option<&[u32]>) {
        let (grid, order) = self.sort_rows();
        match former {
            Some(former) => {
                let former_rows: Vec<u32> = order.iter().map(|&row| former[row as usize]).collect();
                self.list_candidates(&grid, &former_rows);
            }
            None => self.list_candidates(&grid, &order),
        }
        self.former_rows = order;
        self.find_rows_of_groups();
    }

    /// Puts the particles into cell order; row k is what was row `order[k]`.
    fn sort_rows(&mut self) -> (CellGrid, Vec<u32>) {
        self.wrap();
        // The flow brings touching particles nearer by about half of their strain.
        let flow = self.cell.rate.bound() * self.mean_radius;
        self.skin.renew(&self.particles, flow, self.time_step, &self.pool);
        self.note_list_of_cell();
        self.skin.renew_walls(&self.walls);
        let (grid, order) =
            CellGrid::sort(&self.domain, self.skin.positions(), self.interactions.longest_range());
        self.particles.reorder(&order, &self.pool);
        self.skin.reorder(&order, &self.pool);
        (grid, order)
    }

    /// Lists the neighbour pairs of particles in cell order. `former_rows` are their rows at the last rebuild.
    pub(super) fn list_candidates(&mut self, grid: &CellGrid, former_rows: &[u32]) {
        let mut contacts = std::mem::take(&mut self.contacts);
        let slots = contacts.rebuild(&self.surroundings(former_rows), grid, &self.memory, &self.pool);
        self.contacts = contacts;
        self.particles.forces_and_torques.resize(slots, ForceTorque::default());
        self.finish_list();
    }

    /// The same for the chunks of this rank; others have none.
    pub(super) fn list_own(&mut self, own: Range<usize>, grid: &CellGrid, former_rows: &[u32]) {
        let mut contacts = std::mem::take(&mut self.contacts);
        contacts.list(own, &self.surroundings(former_rows), grid, &self.memory, &self.pool);
        self.contacts = contacts;
        self.finish_list();
    }

    /// What a list is made from.
    fn surroundings<'a>(&'a self, former_rows: &'a [u32]) -> Surroundings<'a> {
        Surroundings {
            particles: &self.particles,
            order: former_rows,
            materials: &self.materials,
            interactions: &self.interactions,
            walls: &self.walls,
            images: self.domain.images(),
            skin: &self.skin,
            instructions: self.instructions,
        }
    }

    fn finish_list(&mut self) {
        self.contacts.restore_broken(&self.particles.id, &self.broken_bonds, &self.pool);
        self.outcomes.clear();
        let moved = Moved::nowhere(self.skin.thinnest);
        self.outcomes.resize(self.contacts.chunks().len(), Outcome { moved, ..Outcome::default() });
    }
}
