//! What can be seen of a simulation: the ledger and the contacts.

use pulvis_math::max_or_nan;

use super::sums::RowSums;
use super::{Group, Simulation};
use crate::contacts::{
    Binding, BondCount, Chunk, ContactGroup, ContactTotals, ContactView, Views, view_bindings, view_contacts,
};
use crate::ledger::Ledger;
use crate::walls::WallNow;
use pulvis_boundary::Background;

impl Simulation {
    /// Gravity and drag.
    pub fn background(&self) -> &Background {
        &self.background
    }

    /// Draws up the energy ledger. Looking changes nothing: the scale of relative errors is the largest energy in
    /// motion at the start, at every 64th step and now.
    pub fn ledger(&self) -> Ledger {
        match self.row_sums {
            Some((step, rows)) if self.is_shared() && step == self.step => self.ledger_of(rows),
            _ => self.ledger_of(self.sum_rows()),
        }
    }

    /// The same from sums over all rows.
    pub(super) fn ledger_of(&self, rows: RowSums) -> Ledger {
        let RowSums { translation, rotation, discretisation, potential, electrostatic, fastest: _ } = rows;
        let unknown = if self.accounting { 0.0 } else { f64::NAN };
        let stored = self.running.contacts;
        let mut ledger = Ledger {
            kinetic_translation: translation,
            kinetic_rotation: rotation,
            kinetic_discretisation: -0.125 * self.time_step * self.time_step * discretisation,
            elastic_normal: stored.elastic_normal + unknown,
            elastic_sliding: stored.elastic_sliding + unknown,
            elastic_rolling: stored.elastic_rolling + unknown,
            elastic_torsion: stored.elastic_torsion + unknown,
            elastic_bond: stored.elastic_bond + unknown,
            adhesive: stored.adhesive_potential + unknown,
            capillary: stored.capillary + unknown,
            electrostatic: stored.electrostatic + electrostatic + unknown,
            gravity: potential + self.running.gravity_wrapped,
            dissipated_plastic: stored.dissipated_plastic + unknown,
            dissipated_adhesive: stored.dissipated_adhesive + unknown,
            dissipated_capillary: stored.dissipated_capillary + unknown,
            dissipated_fracture: stored.dissipated_fracture + unknown,
            dissipated_thermal: stored.dissipated_thermal + unknown,
            dissipated_viscous: self.running.viscous + unknown,
            dissipated_sliding: stored.dissipated_sliding + unknown,
            dissipated_rolling: stored.dissipated_rolling + unknown,
            dissipated_torsion: stored.dissipated_torsion + unknown,
            dissipated_background: self.running.background,
            work_walls: self.wall_states.iter().map(|state| state.work_prescribed).sum::<f64>()
                + self.groups.iter().map(Group::work).sum::<f64>(),
            work_servo: self.wall_states.iter().map(|state| state.work_servo).sum(),
            work_cell: self.cell.work,
            switched: self.running.switched,
            inflow: self.running.inflow,
            outflow: self.running.outflow,
            initial: self.running.initial,
            scale: 0.0,
        };
        // Adhesive and gravity potentials have arbitrary zeros, so only energy that moves counts.
        let turnover = ledger.kinetic() + ledger.elastic() + ledger.dissipated();
        ledger.scale = max_or_nan(self.running.scale, turnover);
        ledger
    }

    /// The bonds that hold, and those that have broken so far.
    pub fn bonds(&self) -> BondCount {
        self.contacts.count_bonds(&self.particles.id, &self.broken_bonds)
    }

    /// How all walls lie and move, without a step.
    pub(super) fn walls_at_rest(&self) -> Vec<WallNow> {
        self.wall_states.iter().zip(&self.walls).map(|(state, wall)| state.now_at_rest(wall)).collect()
    }

    /// Sums over all contacts, as the loops have added them up at the end of the last advance.
    pub fn contact_totals(&self) -> ContactTotals {
        self.pass.observed
    }

    /// Hands every contact that acts to `see`, chunk by chunk, in each chunk pairs first, then walls.
    pub fn for_each_contact(&self, see: &mut dyn FnMut(&ContactView)) {
        debug_assert!(self.knows_everything(), "contacts of other ranks are not known");
        let walls = self.walls_at_rest();
        for chunk in self.contacts.chunks() {
            self.view_chunk(chunk, &walls, &mut |contact, _| see(contact));
        }
    }

    /// Hands every contact that acts to `see`, with what is gathered of its chunk, and answers with that of every chunk. The
    /// threads share the chunks; contacts and chunks come in the order of [`for_each_contact`](Self::for_each_contact)
    /// for any number of them.
    pub fn gather_contacts<T: Default + Send + Sync>(
        &self,
        see: impl Fn(&mut T, &ContactView<'_>) + Sync,
    ) -> Vec<T> {
        self.gather_contacts_of_rows(|gathered, contact, _| see(gathered, contact))
    }

    /// The same with what holds each contact together. Some hundred evaluations of the laws for each.
    pub fn gather_bindings<T: Default + Send + Sync>(
        &self,
        see: impl Fn(&mut T, &ContactView<'_>, &Binding) + Sync,
    ) -> Vec<T> {
        debug_assert!(self.knows_everything(), "contacts of other ranks are not known");
        let (walls, chunks) = (self.walls_at_rest(), self.contacts.chunks());
        let mut parts: Vec<T> = Vec::new();
        parts.resize_with(chunks.len(), T::default);
        self.pool.for_each(&mut parts, |number, part| {
            for group in &chunks[number].groups {
                view_bindings(self.views(group, &walls), &mut |contact, binding| see(part, contact, binding));
            }
        });
        parts
    }

    /// The same as [`gather_contacts`](Self::gather_contacts) with the rows of the bodies; of a wall the second one means nothing.
    pub(super) fn gather_contacts_of_rows<T: Default + Send + Sync>(
        &self,
        see: impl Fn(&mut T, &ContactView<'_>, [usize; 2]) + Sync,
    ) -> Vec<T> {
        debug_assert!(self.knows_everything(), "contacts of other ranks are not known");
        let (walls, chunks) = (self.walls_at_rest(), self.contacts.chunks());
        let mut parts: Vec<T> = Vec::new();
        parts.resize_with(chunks.len(), T::default);
        self.pool.for_each(&mut parts, |number, part| {
            self.view_chunk(&chunks[number], &walls, &mut |contact, rows| see(part, contact, rows));
        });
        parts
    }

    fn view_chunk(
        &self,
        chunk: &Chunk,
        walls: &[WallNow],
        see: &mut dyn FnMut(&ContactView<'_>, [usize; 2]),
    ) {
        for group in &chunk.groups {
            view_contacts(self.views(group, walls), see);
        }
    }

    fn views<'a>(&'a self, group: &'a ContactGroup, walls: &'a [WallNow]) -> Views<'a> {
        let (particles, images, rate) = (&self.particles, self.domain.images(), self.cell.rate);
        Views { group, particles, images, rate, walls }
    }
}
