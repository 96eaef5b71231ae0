//! What the contacts of each particle come to.

use pulvis_core::Simulation;
use pulvis_core::observation::Tensor;
use pulvis_math::Vector3;
use std::f64::consts::PI;

use super::frame::Contacts;

/// Sums over contacts, looked up by the place of a particle in the order of the ids.
pub(super) struct ParticleSums<'a> {
    contacts: &'a Contacts,
    simulation: &'a Simulation,
    /// Rows in the order of the ids.
    rows: Vec<usize>,
}

impl<'a> ParticleSums<'a> {
    /// `rows` in the order of the ids.
    pub(super) fn new(contacts: &'a Contacts, simulation: &'a Simulation, rows: &[usize]) -> Self {
        Self { contacts, simulation, rows: rows.to_vec() }
    }

    /// The place of the particle with this id; walls have none.
    fn place(&self, id: i64) -> Option<usize> {
        let ids = self.simulation.particles().ids();
        self.rows.binary_search_by_key(&id, |&row| i64::from(ids[row])).ok()
    }

    /// Touching contacts of each particle, walls included.
    pub(super) fn coordination(&self, kept: &[usize]) -> Vec<i64> {
        let mut counts = vec![0; self.rows.len()];
        let Contacts { first, second, overlap, .. } = self.contacts;
        for contact in (0..first.len()).filter(|&contact| overlap[contact] > 0.0) {
            for place in [first[contact], second[contact]].into_iter().filter_map(|id| self.place(id)) {
                counts[place] += 1;
            }
        }
        kept.iter().map(|&place| counts[place]).collect()
    }

    /// The stress in each particle \[Pa\]: σ_km = 1/V Σ f_k l_m over its contacts, with the force f on it, the way l from
    /// the contact point to its centre and its volume V; compression positive. The sum of V σ over all particles is Σ f ⊗ b
    /// over all contacts, since the two ways of a contact add up to its branch: the part of contacts in the stress of
    /// observers, times its volume.
    ///
    /// # Source
    /// The Love-Weber formula: J. Christoffersen, M. M. Mehrabadi, S. Nemat-Nasser, J. Appl. Mech. 48, 339 (1981), with the
    /// contacts of one grain and its volume.
    pub(super) fn stress(&self, kept: &[usize]) -> Vec<[f64; 9]> {
        let mut sums: Vec<Tensor> = vec![Tensor::default(); self.rows.len()];
        let points = self.contacts.points(self.simulation);
        let Contacts { first, second, force, ends, .. } = self.contacts;
        for contact in 0..first.len() {
            let point = Vector3::from(points[contact]);
            for (end, id) in [first[contact], second[contact]].into_iter().enumerate() {
                let Some(place) = self.place(id) else { continue };
                let way = (Vector3::from(ends[contact][end]) - point).to_array();
                let sign = if end == 0 { 1.0 } else { -1.0 };
                for (row, force) in sums[place].iter_mut().zip(force[contact]) {
                    row.iter_mut().zip(way).for_each(|(sum, way)| *sum += sign * force * way);
                }
            }
        }
        let radii = self.simulation.particles().radii();
        let stress = |&place: &usize| {
            let radius = radii[self.rows[place]];
            let volume = 4.0 / 3.0 * PI * radius * radius * radius;
            std::array::from_fn(|part| sums[place][part / 3][part % 3] / volume)
        };
        kept.iter().map(stress).collect()
    }

    /// What contacts store, half of it on each of two particles, all of it where the other body is a wall [J].
    pub(super) fn stored_energy(&self, kept: &[usize]) -> Vec<f64> {
        let mut sums = vec![0.0; self.rows.len()];
        let Contacts { first, second, stored_energy, .. } = self.contacts;
        for contact in 0..first.len() {
            let share = if second[contact] < 0 { 1.0 } else { 0.5 };
            for place in [first[contact], second[contact]].into_iter().filter_map(|id| self.place(id)) {
                sums[place] += share * stored_energy[contact];
            }
        }
        kept.iter().map(|&place| sums[place]).collect()
    }
}
