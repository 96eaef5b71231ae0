//! All candidate contacts: listed anew when bodies have moved, swept every step, and summed up for
//! each particle.

use pulvis_contact::ContactEnergies;
use pulvis_math::Vector3;

use super::block::{CAPACITY, ContactGroup, Partner};
use super::kernel::{Advance, Moving, WallMotionNow, sweep};
use super::rebuild::MemoryStore;
use super::{Interactions, adjacency::Adjacency};
use crate::domain::Images;
use crate::neighbours::CellGrid;
use crate::particles::Particles;
use crate::team::Team;
use crate::walls::Wall;

/// Candidates are sorted into blocks by their gap over the skin, up to these bounds: what touches now
/// fills whole blocks, and blocks of what is far apart are passed over until something has moved.
const GAP_CLASSES: [f64; 3] = [0.05, 0.4, f64::INFINITY];

/// The candidates and what they remember.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTable {
    groups: Vec<ContactGroup>,
    adjacency: Adjacency,
}

/// What the list of candidates depends on.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) particles: &'a Particles,
    pub(crate) interactions: &'a Interactions,
    pub(crate) walls: &'a [Wall],
    pub(crate) images: Images,
    pub(crate) skin: f64,
}

impl ContactTable {
    /// All groups, particle pairs first.
    pub(crate) fn groups(&self) -> &[ContactGroup] {
        &self.groups
    }

    /// What the contacts remember.
    pub(crate) fn memory(&self, particles: &Particles) -> MemoryStore {
        MemoryStore::gather(self.groups.iter(), &particles.id)
    }

    /// Lists all candidates within reach and skin; contacts keep their `memory`.
    pub(crate) fn rebuild(&mut self, around: Surroundings<'_>, grid: &CellGrid, memory: &MemoryStore) {
        self.groups.clear();
        self.list_pairs(around, grid, memory);
        self.list_walls(around, memory);
        self.adjacency = Adjacency::of(&self.groups, around.particles.len());
    }

    fn list_pairs(&mut self, around: Surroundings<'_>, grid: &CellGrid, memory: &MemoryStore) {
        let Surroundings { particles, interactions, images, skin, .. } = around;
        // For each pair of materials and each class of gaps, the candidates in cell order.
        let mut listed: Vec<[Vec<(u32, u32, f64)>; GAP_CLASSES.len()]> =
            vec![Default::default(); interactions.groups()];
        let all = 0..particles.len() as u32;
        grid.for_each_pair_of(all, &particles.position, &particles.radius, |one, other| {
            let (i, j) = (one as usize, other as usize);
            let place = interactions.group(particles.material[i], particles.material[j]);
            let Some(model) = interactions.model(place) else { return };
            let touch = particles.radius[i] + particles.radius[j] + model.reach();
            let separation = images.nearest(particles.position[i] - particles.position[j]);
            let squared = separation.norm_squared();
            if squared < (touch + skin) * (touch + skin) {
                let gap = squared.sqrt() - touch;
                listed[place][gap_class(gap, skin)].push((one, other, gap));
            }
        });
        for (place, classes) in listed.into_iter().enumerate() {
            let Some(&model) = interactions.model(place) else { continue };
            for (one, other, gap) in classes.into_iter().flatten() {
                let group = self.open_group(model, Partner::Particle);
                memory.push_pair(group, (one, other), gap, &particles.id);
            }
        }
    }

    fn list_walls(&mut self, around: Surroundings<'_>, memory: &MemoryStore) {
        let Surroundings { particles, interactions, walls, skin, .. } = around;
        let mut materials = particles.material.clone();
        materials.sort_unstable();
        materials.dedup();
        for (place, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.present) {
            for &material in &materials {
                let Some(&model) = interactions.get(material, wall.material) else { continue };
                let touch = wall.offset() + model.reach();
                for row in (0..particles.len()).filter(|&row| particles.material[row] == material) {
                    let gap = particles.position[row].dot(wall.normal) - particles.radius[row] - touch;
                    if gap < skin {
                        let group = self.open_group(model, Partner::Wall(place));
                        memory.push_wall(group, place, row as u32, gap, &particles.id);
                    }
                }
            }
        }
    }

    /// The last group if it is of this kind and has room, otherwise a new one.
    fn open_group(&mut self, model: pulvis_contact::ContactModel, partner: Partner) -> &mut ContactGroup {
        let fits = self
            .groups
            .last()
            .is_some_and(|group| group.partner == partner && group.model == model && !group.is_full());
        if !fits {
            self.groups.push(ContactGroup::new(model, partner));
        }
        let last = self.groups.len() - 1;
        &mut self.groups[last]
    }

    /// Computes the forces of all contacts.
    pub(crate) fn sweep(
        &mut self,
        moving: Moving<'_>,
        images: Images,
        walls: &[WallMotionNow],
        advance: Advance,
        team: &Team,
    ) {
        team.for_each(&mut self.groups, |group| sweep(group, moving, images, walls, advance));
    }

    /// The sum of all contacts' energies, group by group: the same for any number of threads.
    pub(crate) fn energies(&self) -> ContactEnergies {
        let mut sum = ContactEnergies::default();
        for group in &self.groups {
            sum += group.totals.energies;
        }
        sum
    }

    /// Adds the force of every wall on the particles to its place in `forces`.
    pub(crate) fn add_wall_forces(&self, forces: &mut [Vector3]) {
        for group in &self.groups {
            if let Partner::Wall(place) = group.partner {
                forces[place] += group.totals.force;
            }
        }
    }

    /// Force and torque of all contacts on the particle of a row, in the order of the list.
    #[inline(always)]
    pub(crate) fn on_particle(&self, row: usize) -> (Vector3, Vector3) {
        let (mut force, mut torque) = (Vector3::zero(), Vector3::zero());
        for entry in self.adjacency.of_row(row) {
            let (contact, second) = ((entry >> 1) as usize, entry & 1 == 1);
            let group = &self.groups[contact / CAPACITY];
            if let Some((push, turn)) = group.force_on(contact % CAPACITY, second) {
                force += push;
                torque += turn;
            }
        }
        (force, torque)
    }

    /// Number of candidate contacts.
    pub(crate) fn candidates(&self) -> usize {
        self.groups.iter().map(ContactGroup::len).sum()
    }

    /// Memory of the whole table [byte].
    pub(crate) fn memory_size(&self) -> usize {
        self.groups.iter().map(ContactGroup::memory_size).sum::<usize>() + self.adjacency.memory_size()
    }
}

fn gap_class(gap: f64, skin: f64) -> usize {
    GAP_CLASSES.iter().position(|&bound| gap <= bound * skin).unwrap_or(GAP_CLASSES.len() - 1)
}
