//! A run of rows, the contacts that it owns, and the sums of their loads.

use std::ops::Range;

use pulvis_math::Quad;

use super::block::{Candidate, ContactGroup, Partner};
use super::rebuild::{MemoryStore, wall_partner};
use super::table::Surroundings;
use crate::neighbours::CellGrid;
use crate::phases::Phases;

/// Rows of a piece at the most, and at the least where there are enough for several pieces.
const ROWS: Range<usize> = 64..1024;
/// Pieces that small systems are cut into, so that several threads find work.
const PIECES: usize = 16;

/// Beyond any row.
const HALO: u32 = 1 << 31;

/// Candidates are sorted into blocks by their gap over the skin, up to these bounds: what touches now
/// fills whole blocks, and blocks of what is far apart are passed over until something has moved.
const GAP_CLASSES: [f64; 3] = [0.05, 0.4, f64::INFINITY];

/// Consecutive rows, and every contact whose lower row is one of them.
///
/// Pieces are what threads take their work by. Each sums the loads of its contacts in places of its own:
/// those of its rows, and one for each row of later pieces that it has contacts with (its halo). A row's
/// load is the sum of its own place and of the halos of earlier pieces, in their order: no two threads
/// write to the same place, and the order of every sum is fixed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Piece {
    pub(crate) rows: Range<usize>,
    pub(crate) groups: Vec<ContactGroup>,
    /// Rows of later pieces, in ascending order.
    pub(crate) halo: Vec<u32>,
    /// Where the sums of its halo begin.
    pub(crate) halo_sums: usize,
    /// Parts of the halos of earlier pieces that are rows of this one.
    pub(crate) incoming: Vec<Incoming>,
    /// Time spent on its contacts since it was listed.
    pub(crate) phases: Phases,
    /// Later pieces that wait for this one.
    pub(crate) dependents: Vec<u32>,
}

/// A part of a piece's halo.
#[derive(Clone, Debug)]
pub(crate) struct Incoming {
    pub(crate) source: u32,
    pub(crate) slots: Range<u32>,
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
        self.groups.clear();
        self.list_pairs(around, grid, memory);
        self.list_walls(around, memory);
    }

    fn list_pairs(&mut self, around: &Surroundings<'_>, grid: &CellGrid, memory: &MemoryStore) {
        let Surroundings { particles, interactions, images, skin, .. } = *around;
        // For each pair of materials and each class of gaps, the candidates in cell order.
        let mut listed: Vec<[Vec<(u32, u32, f64)>; GAP_CLASSES.len()]> =
            vec![Default::default(); interactions.groups()];
        let rows = self.rows.start as u32..self.rows.end as u32;
        let mut halo = Vec::new();
        grid.for_each_pair_of(rows.clone(), around.positions, &particles.radius, |one, other| {
            let (i, j) = (one as usize, other as usize);
            let place = interactions.group(particles.material[i], particles.material[j]);
            let Some(model) = interactions.model(place) else { return };
            let (first, second) = (&particles.place[i], &particles.place[j]);
            let touch = first.scalar + second.scalar + model.reach();
            let squared = images.nearest(first.vector - second.vector).norm_squared();
            if squared < (touch + skin) * (touch + skin) {
                let gap = squared.sqrt() - touch;
                listed[place][gap_class(gap, skin)].push((one, other, gap));
                if other >= rows.end {
                    halo.push(other);
                }
            }
        });
        halo.sort_unstable();
        halo.dedup();
        self.halo = halo;
        for (place, classes) in listed.into_iter().enumerate() {
            let Some(&model) = interactions.model(place) else { continue };
            let mut group = ContactGroup::new(model, Partner::Particle);
            for (one, other, gap) in classes.into_iter().flatten() {
                let (first, second) = (particles.id[one as usize], particles.id[other as usize]);
                // The first body of a contact is the one of the lower id: what the contact remembers
                // does not change its sign when rows change their order.
                let rows = if first < second { [one, other] } else { [other, one] };
                let candidate = Candidate { rows, sums: rows.map(|row| self.place_of_sum(row)), gap };
                let record = memory.find(first.min(second), first.max(second), &group);
                group.push(&candidate, record.as_deref());
            }
            self.keep(group);
        }
    }

    /// Where the load on a row is summed; places in the halo are counted from [`HALO`] on until it is
    /// known where they begin.
    fn place_of_sum(&self, row: u32) -> u32 {
        if (row as usize) < self.rows.end {
            return row;
        }
        HALO + self.halo.partition_point(|&other| other < row) as u32
    }

    /// Tells the contacts where the sums of the halo begin.
    pub(crate) fn place_halo(&mut self, start: usize) {
        self.halo_sums = start;
        for group in &mut self.groups {
            let places = group.first_sum.iter_mut().chain(&mut group.second_sum).flatten();
            for place in places.filter(|place| **place >= HALO) {
                *place = *place - HALO + start as u32;
            }
        }
    }

    fn list_walls(&mut self, around: &Surroundings<'_>, memory: &MemoryStore) {
        let Surroundings { particles, interactions, walls, skin, .. } = *around;
        for (place, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.present) {
            for &material in around.materials {
                let Some(&model) = interactions.get(material, wall.material) else { continue };
                let touch = wall.offset() + model.reach();
                let mut group = ContactGroup::new(model, Partner::Wall(place));
                for row in self.rows.clone().filter(|&row| particles.material[row] == material) {
                    let Quad { vector, scalar } = particles.place[row];
                    let gap = vector.dot(wall.normal) - scalar - touch;
                    if gap < skin {
                        let record = memory.find(particles.id[row], wall_partner(place), &group);
                        let rows = [row as u32; 2];
                        let candidate = Candidate { rows, sums: rows, gap };
                        group.push(&candidate, record.as_deref());
                    }
                }
                self.keep(group);
            }
        }
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
