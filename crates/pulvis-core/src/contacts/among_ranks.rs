//! What ranks tell each other of chunks and of their contacts.

use std::ops::Range;

use pulvis_math::F64Array;
use pulvis_parallel::exchange::{ExchangeError, Message};

use super::Interactions;
use super::block::{ContactGroup, LaneIndices, Partner, WIDTH};
use super::chunk::{Approach, Chunk};
use super::table::ContactTable;
use crate::columns::NamedColumn;
use crate::ranks::halo::HaloRows;
use crate::ranks::message::Numbers;
use crate::walls::WallForce;

type Heard = Result<(), ExchangeError>;

/// The halos of a rank and of others, as far as they concern each other; see [`HaloPlan`](crate::ranks::halo::HaloPlan).
#[derive(Debug, Default)]
pub(crate) struct HaloParts {
    pub(crate) rows_to: Vec<HaloRows>,
    pub(crate) rows_from: Vec<HaloRows>,
    pub(crate) slots_to: Vec<(usize, Vec<Range<usize>>)>,
    pub(crate) slots_from: Vec<(usize, Range<usize>)>,
}

impl ContactTable {
    /// The rows of a range of chunks.
    pub(crate) fn rows_of(&self, chunks: Range<usize>) -> Range<usize> {
        if chunks.is_empty() {
            return 0..0;
        }
        self.chunks()[chunks.start].rows.start..self.chunks()[chunks.end - 1].rows.end
    }

    /// Tells a higher rank with these `rows` which of them are in the halos of this rank's chunks.
    pub(crate) fn tell_halos(&self, rows: &Range<usize>, message: &mut Message) {
        for number in self.own() {
            let halo = &self.chunks()[number].halo;
            let there = part_within(halo, rows);
            if !there.is_empty() {
                message.extend([number as f64, there.len() as f64]);
                message.extend(halo[there].iter().map(|&row| f64::from(row)));
            }
        }
    }

    /// Takes in what a lower rank has told of its halos.
    ///
    /// # Errors
    /// The message is damaged.
    pub(crate) fn hear_halos(&mut self, mut numbers: Numbers<'_>) -> Heard {
        while !numbers.is_empty() {
            let (chunk, count) = (numbers.next_index()?, numbers.next_index()?);
            let rows = numbers.take(count)?.iter().map(|&row| row as u32);
            self.chunks_mut()[chunk].halo = rows.collect();
        }
        Ok(())
    }

    /// Which rows and slots of the linked halos the rank `own_rank` shares with others, if these are the chunks of each.
    pub(crate) fn halo_parts(&self, chunks_of: &[Range<usize>], own_rank: usize) -> HaloParts {
        let own = self.own();
        let own_rows = self.rows_of(own.clone());
        let mut parts = HaloParts::default();
        for (rank, chunks) in chunks_of.iter().enumerate() {
            if chunks.is_empty() || own.is_empty() || rank == own_rank {
                continue;
            }
            let (halos, readers) = if rank < own_rank {
                (own_rows.clone(), chunks.clone())
            } else {
                (self.rows_of(chunks.clone()), own.clone())
            };
            let mut rows: Vec<u32> = Vec::new();
            let mut slots: Vec<Range<usize>> = Vec::new();
            for number in readers {
                let halo = &self.chunks()[number].halo;
                let there = part_within(halo, &halos);
                if there.is_empty() {
                    continue;
                }
                rows.extend_from_slice(&halo[there.clone()]);
                let start = self.halo_start(number);
                slots.push(start + there.start..start + there.end);
            }
            rows.sort_unstable();
            rows.dedup();
            let chunk_of = |row: &u32| self.chunk_of(*row) as u32;
            let mut chunks: Vec<u32> = rows.iter().map(chunk_of).collect();
            chunks.dedup();
            let rows = HaloRows { rank, rows, chunks };
            if let (Some(first), Some(last)) = (slots.first(), slots.last()) {
                if rank < own_rank {
                    parts.slots_from.push((rank, first.start..last.end));
                    parts.rows_to.push(rows);
                } else {
                    parts.slots_to.push((rank, slots));
                    parts.rows_from.push(rows);
                }
            }
        }
        parts
    }

    /// Tells all contacts of a chunk.
    pub(crate) fn tell_chunk(&self, number: usize, message: &mut Message) {
        let Chunk { halo, groups, approach, .. } = &self.chunks()[number];
        message.extend([approach.pairs, approach.walls, halo.len() as f64, groups.len() as f64]);
        message.extend(halo.iter().map(|&row| f64::from(row)));
        groups.iter().for_each(|group| group.tell(message));
    }

    /// Takes in all contacts of a chunk of another rank.
    ///
    /// # Errors
    /// The message is damaged.
    pub(crate) fn hear_chunk(&mut self, number: usize, numbers: &mut Numbers<'_>, known: Known<'_>) -> Heard {
        let approach = Approach { pairs: numbers.next()?, walls: numbers.next()? };
        let [halo, groups] = [numbers.next_index()?, numbers.next_index()?];
        let halo = numbers.take(halo)?.iter().map(|&row| row as u32).collect();
        let groups: Result<Vec<_>, _> = (0..groups).map(|_| ContactGroup::hear(numbers, known)).collect();
        let chunk = &mut self.chunks_mut()[number];
        (chunk.approach, chunk.halo, chunk.groups) = (approach, halo, groups?);
        Ok(())
    }
}

/// What all ranks know of contacts without a word.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known<'a> {
    pub(crate) interactions: &'a Interactions,
    pub(crate) columns: &'a [NamedColumn],
    /// Number of walls.
    pub(crate) walls: usize,
}

impl ContactGroup {
    fn tell(&self, message: &mut Message) {
        let with_walls = f64::from(u8::from(self.partner == Partner::Wall));
        message.extend([self.number as f64, with_walls, self.rows.len() as f64]);
        for block in 0..self.rows.len() {
            for LaneIndices(indices) in [&self.rows[block], &self.sums[block]] {
                message.extend(indices.as_flattened().iter().map(|&index| f64::from(index)));
            }
            let flag = |flag: bool| f64::from(u8::from(flag));
            message.extend([
                f64::from(self.occupancy[block]),
                flag(self.active[block]),
                flag(self.crosses_boundary[block]),
                self.gap[block],
            ]);
            self.columns(block).iter().for_each(|column| message.extend_from_slice(&column.0));
        }
    }

    fn hear(numbers: &mut Numbers<'_>, known: Known<'_>) -> Result<Self, ExchangeError> {
        let Known { interactions, columns, walls } = known;
        let [number, with_walls, blocks] =
            [numbers.next_index()?, numbers.next_index()?, numbers.next_index()?];
        let partner = if with_walls == 1 { Partner::Wall } else { Partner::Particle };
        let model = (number < interactions.groups()).then(|| interactions.model(number)).flatten();
        let model = *model.ok_or_else(|| ExchangeError {
            reason: format!("contacts of group {number}, which this rank does not know"),
        })?;
        let mut group = Self::new(number, model, interactions.range(number), partner, None);
        group.find_quantities(columns);
        group.reserve(blocks * WIDTH);
        if partner == Partner::Wall {
            group.wall_forces.resize(walls, WallForce::default());
        }
        for _ in 0..blocks {
            let mut indices = [LaneIndices([[0; WIDTH]; 2]); 2];
            for LaneIndices(lanes) in &mut indices {
                let told = numbers.take(2 * WIDTH)?;
                lanes.as_flattened_mut().iter_mut().zip(told).for_each(|(lane, &index)| *lane = index as u32);
            }
            let [rows, sums] = indices;
            group.rows.push(rows);
            group.sums.push(sums);
            group.occupancy.push(numbers.next()? as u8);
            group.active.push(numbers.next()? != 0.0);
            group.crosses_boundary.push(numbers.next()? != 0.0);
            group.gap.push(numbers.next()?);
            for _ in 0..group.layout.columns() {
                let mut column = F64Array::<8>::default();
                column.0.copy_from_slice(numbers.take(WIDTH)?);
                group.memory.push(column);
            }
        }
        Ok(group)
    }
}

/// Where the rows of a range stand in an ascending list.
fn part_within(ascending: &[u32], rows: &Range<usize>) -> Range<usize> {
    let before = |end: usize| ascending.partition_point(|&row| (row as usize) < end);
    before(rows.start)..before(rows.end)
}
