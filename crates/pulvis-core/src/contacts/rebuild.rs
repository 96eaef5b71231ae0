//! How contact memory survives a new list of candidates.

use std::borrow::Cow;

use super::block::{ContactGroup, Partner};
use super::layout::Layout;
use super::piece::Piece;
use crate::team::Team;

/// The memory of all contacts that remember anything, by the rows that their bodies had when it was
/// gathered: rows that follow each other are near each other, ids are not.
#[derive(Clone, Debug, Default)]
pub(crate) struct MemoryStore {
    /// One for each piece of then.
    pieces: Vec<PieceMemory>,
    /// Rows of a piece, but for the last one.
    length: usize,
}

/// The memory of the contacts that a piece owned, by the lower row.
#[derive(Clone, Debug, Default)]
struct PieceMemory {
    first_row: usize,
    /// First entry of each row, and one more at the end.
    starts: Vec<u32>,
    entries: Vec<Entry>,
    records: Vec<f64>,
    /// The layouts that records were written with, and the names of their normal laws.
    layouts: Vec<(Layout, &'static str)>,
    /// Scratch.
    unsorted: Vec<(u32, Entry)>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    /// The higher row, or what stands for a wall.
    partner: u32,
    layout: u32,
    /// First place among the records.
    record: u32,
}

/// What stands for a wall where other contacts have the row of their second body.
pub(crate) fn wall_partner(wall: usize) -> u32 {
    u32::MAX - wall as u32
}

impl MemoryStore {
    /// Takes in the memory of the contacts of all pieces; what was in it before is forgotten.
    pub(crate) fn gather(&mut self, pieces: &[Piece], team: &Team) {
        self.length = pieces.first().map_or(0, |piece| piece.rows.len());
        self.pieces.resize_with(pieces.len(), PieceMemory::default);
        team.for_each(&mut self.pieces, |number, memory| memory.gather(&pieces[number]));
    }

    /// Memory [byte].
    pub(crate) fn memory_size(&self) -> usize {
        self.pieces.iter().map(PieceMemory::memory_size).sum()
    }

    /// The memory of the contact between two bodies, by their rows of then, in the layout of the group that
    /// it now belongs to.
    pub(crate) fn find(&self, rows: [u32; 2], group: &ContactGroup) -> Option<Cow<'_, [f64]>> {
        let [low, high] = [rows[0].min(rows[1]), rows[0].max(rows[1])];
        self.pieces.get((low as usize).checked_div(self.length)?)?.find(low, high, group)
    }
}

impl PieceMemory {
    fn gather(&mut self, piece: &Piece) {
        self.forget();
        self.first_row = piece.rows.start;
        self.starts.resize(piece.rows.len() + 1, 0);
        let mut unsorted = std::mem::take(&mut self.unsorted);
        for group in &piece.groups {
            let layout = self.number_of(group);
            group.for_each_memory(|block, lane, record| {
                let first = group.first_row(block, lane);
                let partner = match group.partner {
                    Partner::Particle => group.second_row(block, lane),
                    Partner::Wall => wall_partner(group.second_row(block, lane) as usize),
                };
                let place = first.min(partner) - self.first_row as u32;
                let record_place = self.records.len() as u32;
                unsorted.push((place, Entry { partner: first.max(partner), layout, record: record_place }));
                self.starts[place as usize + 1] += 1;
                self.records.extend_from_slice(record);
            });
        }
        for row in 0..piece.rows.len() {
            self.starts[row + 1] += self.starts[row];
        }
        self.entries.resize(unsorted.len(), Entry::default());
        // Every row's next free place is kept where the row begins, until all are moved back by one.
        for &(row, entry) in &unsorted {
            let place = &mut self.starts[row as usize];
            self.entries[*place as usize] = entry;
            *place += 1;
        }
        self.starts.rotate_right(1);
        self.starts[0] = 0;
        unsorted.clear();
        self.unsorted = unsorted;
    }

    fn memory_size(&self) -> usize {
        self.starts.capacity() * size_of::<u32>()
            + self.entries.capacity() * size_of::<Entry>()
            + self.records.capacity() * size_of::<f64>()
            + self.unsorted.capacity() * size_of::<(u32, Entry)>()
    }

    /// Forgets everything, but keeps the room.
    fn forget(&mut self) {
        self.starts.clear();
        self.entries.clear();
        self.records.clear();
        self.layouts.clear();
    }

    fn number_of(&mut self, group: &ContactGroup) -> u32 {
        let layout = (group.layout, group.model.normal.entry().name);
        let known = self.layouts.iter().position(|known| *known == layout);
        known.unwrap_or_else(|| {
            self.layouts.push(layout);
            self.layouts.len() - 1
        }) as u32
    }

    fn find(&self, row: u32, partner: u32, group: &ContactGroup) -> Option<Cow<'_, [f64]>> {
        let place = row as usize - self.first_row;
        let range = *self.starts.get(place)? as usize..*self.starts.get(place + 1)? as usize;
        let entry = self.entries[range].iter().find(|entry| entry.partner == partner)?;
        let (layout, law) = &self.layouts[entry.layout as usize];
        let record = &self.records[entry.record as usize..entry.record as usize + layout.columns()];
        let same_law = *law == group.model.normal.entry().name;
        if same_law && *layout == group.layout {
            return Some(record.into());
        }
        Some(group.layout.translate(layout, record, same_law).into())
    }
}
