//! A run of rows, the contacts that it owns, and the sums of their loads.

use std::ops::Range;

use pulvis_math::{Quad, Vector3};

use super::block::{Candidate, ContactGroup, Partner};
use super::candidates;
use super::rebuild::{MemoryStore, wall_partner};
use super::table::Surroundings;
use crate::neighbours::CellGrid;
use crate::phases::Phases;

/// Rows of a piece at the least, so that its blocks are full, and at the most, so that it fits into a
/// second-level cache.
const ROWS: Range<usize> = 128..1024;
/// Pieces that small systems are cut into, so that several threads find work.
const PIECES: usize = 8;

/// Candidates are sorted into blocks by their gap over the skin, up to these bounds: what touches now
/// fills whole blocks, and blocks of what is far apart are passed over until something has moved.
const GAP_CLASSES: [f64; CLASSES] = [0.01, 0.06, 0.3, f64::INFINITY];
const CLASSES: usize = 4;

/// Two rows near each other, the lower one first, and the gap between their reaches [m].
#[derive(Clone, Copy, Debug)]
struct Near {
    rows: [u32; 2],
    gap: f64,
}

/// Consecutive rows, and every contact whose lower row is one of them.
///
/// Pieces are what threads take their work by. Each sums the loads of its contacts in places of its own:
/// one for each of its rows, then one for each row of later pieces that it has contacts with (its halo).
/// A row's load is the sum of its own place and of the halos of earlier pieces, in their order: no two
/// threads write to the same place, and the order of every sum is fixed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Piece {
    pub(crate) rows: Range<usize>,
    pub(crate) groups: Vec<ContactGroup>,
    /// Rows of later pieces, in ascending order: what listing gives to the list of all halos.
    pub(crate) halo: Vec<u32>,
    /// Parts of the halos of earlier pieces that are rows of this one.
    pub(crate) incoming: Vec<Incoming>,
    /// How far the bodies of its contacts have moved.
    pub(crate) closed: Closed,
    /// Time spent on its contacts since it was listed.
    pub(crate) phases: Phases,
    /// Later pieces that wait for this one.
    pub(crate) dependents: Vec<u32>,
}

/// By how much gaps can have closed since candidates were listed [m]: those between the particles that
/// contacts of a piece are of, and those between its rows and walls.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Closed {
    pub(crate) pairs: f64,
    pub(crate) walls: f64,
}

/// A part of an earlier piece's halo.
#[derive(Clone, Debug)]
pub(crate) struct Incoming {
    /// Places in the list of the halos of all pieces.
    pub(crate) slots: Range<usize>,
}

/// Cuts all rows into pieces, the same for any number of threads.
pub(crate) fn cut(rows: usize) -> Vec<Piece> {
    let length = (rows / PIECES).clamp(ROWS.start, ROWS.end);
    let starts = (0..rows).step_by(length);
    starts.map(|start| Piece { rows: start..(start + length).min(rows), ..Piece::default() }).collect()
}

impl Piece {
    /// Lists the candidates anew; contacts keep their `memory`.
    pub(crate) fn list(&mut self, around: &Surroundings<'_>, grid: &CellGrid, memory: &MemoryStore) {
        let mut spare = std::mem::take(&mut self.groups);
        self.incoming.clear();
        self.dependents.clear();
        self.closed = Closed::default();
        self.phases = Phases::default();
        self.list_pairs(around, grid, memory, &mut spare);
        self.list_walls(around, memory, &mut spare);
    }

    /// Pairs that may touch before the next list, and how far they are from touching [m], for each pair of
    /// materials and each class of gaps in cell order.
    fn near_pairs(&mut self, around: &Surroundings<'_>, grid: &CellGrid) -> Vec<[Vec<Near>; CLASSES]> {
        let Surroundings { particles, interactions, images, skin, .. } = *around;
        let places = &particles.place;
        let (mut stretches, mut pairs) = (Vec::new(), Vec::new());
        let rows = self.rows.start as u32..self.rows.end as u32;
        grid.for_each_stretch_of(rows.clone(), places, |stretch| stretches.push(stretch));
        let margin = interactions.reach() + skin;
        let near = candidates::Near { stretches: &stretches, places, images, margin, pairs: &mut pairs };
        around.instructions.run(near);
        let mut listed: Vec<[Vec<Near>; CLASSES]> = vec![Default::default(); interactions.groups()];
        self.halo.clear();
        for rows_of_pair in pairs {
            let [i, j] = rows_of_pair.map(|row| row as usize);
            let place = interactions.group(particles.material[i], particles.material[j]);
            let Some(model) = interactions.model(place) else { continue };
            let touch = places[i].scalar + places[j].scalar + model.reach();
            let gap = images.nearest(places[i].vector - places[j].vector).norm() - touch;
            if gap < skin {
                listed[place][gap_class(gap, skin)].push(Near { rows: rows_of_pair, gap });
                if rows_of_pair[1] >= rows.end {
                    self.halo.push(rows_of_pair[1]);
                }
            }
        }
        self.halo.sort_unstable();
        self.halo.dedup();
        listed
    }

    fn list_pairs(
        &mut self,
        around: &Surroundings<'_>,
        grid: &CellGrid,
        memory: &MemoryStore,
        spare: &mut Vec<ContactGroup>,
    ) {
        let listed = self.near_pairs(around, grid);
        let id = &around.particles.id;
        for (place, classes) in listed.into_iter().enumerate() {
            let Some(&model) = around.interactions.model(place) else { continue };
            let mut group = ContactGroup::new(model, Partner::Particle, spare.pop());
            for Near { rows: [one, other], gap } in classes.into_iter().flatten() {
                // The first body of a contact is the one of the lower id: what the contact remembers
                // does not change its sign when rows change their order.
                let lower_first = id[one as usize] < id[other as usize];
                let rows = if lower_first { [one, other] } else { [other, one] };
                let candidate = Candidate { rows, sums: rows.map(|row| self.place_of_sum(row)), gap };
                let record = memory.find(rows.map(|row| around.order[row as usize]), &group);
                group.push(&candidate, record.as_deref());
            }
            self.keep(group);
        }
    }

    /// The place among the piece's sums for the load on a row.
    fn place_of_sum(&self, row: u32) -> u32 {
        if (row as usize) < self.rows.end {
            return row - self.rows.start as u32;
        }
        (self.rows.len() + self.halo.partition_point(|&other| other < row)) as u32
    }

    /// Lists what may touch walls: one group for each model, in it wall by wall.
    fn list_walls(&mut self, around: &Surroundings<'_>, memory: &MemoryStore, spare: &mut Vec<ContactGroup>) {
        let Surroundings { particles, interactions, walls, skin, .. } = *around;
        let mut groups: Vec<Option<ContactGroup>> = vec![None; interactions.groups()];
        for (number, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.present) {
            for &material in around.materials {
                let Some(&model) = interactions.get(material, wall.material) else { continue };
                let group = groups[interactions.group(material, wall.material)]
                    .get_or_insert_with(|| ContactGroup::new(model, Partner::Wall, spare.pop()));
                group.wall_forces.resize(walls.len(), Vector3::zero());
                let touch = wall.offset() + model.reach();
                for row in self.rows.clone().filter(|&row| particles.material[row] == material) {
                    let Quad { vector, scalar } = particles.place[row];
                    let gap = vector.dot(wall.normal) - scalar - touch;
                    if gap < skin {
                        let record = memory.find([around.order[row], wall_partner(number)], group);
                        let sum = (row - self.rows.start) as u32;
                        let candidate = Candidate { rows: [row as u32, number as u32], sums: [sum, 0], gap };
                        group.push(&candidate, record.as_deref());
                    }
                }
            }
        }
        groups.into_iter().flatten().for_each(|group| self.keep(group));
    }

    fn keep(&mut self, group: ContactGroup) {
        if group.len() > 0 {
            self.groups.push(group);
        }
    }
}

fn gap_class(gap: f64, skin: f64) -> usize {
    GAP_CLASSES.iter().position(|&bound| gap <= bound * skin).unwrap_or(GAP_CLASSES.len() - 1)
}
