//! How contact memory survives a new list of candidates.

use std::borrow::Cow;

use super::block::{ContactGroup, Partner};
use super::layout::Layout;

/// The memory of all contacts that remember anything, by the row of their first body when they were
/// gathered: rows that follow each other are near each other, ids are not.
#[derive(Clone, Debug, Default)]
pub(crate) struct MemoryStore {
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
    /// Row of the second body, or what stands for a wall.
    partner: u32,
    layout: u32,
    /// First place among the records.
    record: usize,
}

/// What stands for a wall where other contacts have the row of their second body.
pub(crate) fn wall_partner(wall: usize) -> u32 {
    u32::MAX - wall as u32
}

impl MemoryStore {
    /// Takes in the memory of the groups' contacts between `rows` rows; what was in it before is
    /// forgotten.
    pub(crate) fn gather<'a>(&mut self, groups: impl Iterator<Item = &'a ContactGroup>, rows: usize) {
        let store = self;
        store.forget();
        store.starts.resize(rows + 1, 0);
        let mut unsorted = std::mem::take(&mut store.unsorted);
        for group in groups {
            let layout = store.number_of(group);
            group.for_each_memory(|block, lane, record| {
                let first = group.first_row(block, lane);
                let partner = match group.partner {
                    Partner::Particle => group.second_row(block, lane),
                    Partner::Wall => wall_partner(group.second_row(block, lane) as usize),
                };
                unsorted.push((first, Entry { partner, layout, record: store.records.len() }));
                store.starts[first as usize + 1] += 1;
                store.records.extend_from_slice(record);
            });
        }
        for row in 0..rows {
            store.starts[row + 1] += store.starts[row];
        }
        store.entries.resize(unsorted.len(), Entry::default());
        // Every row's next free place is kept where the row begins, until all are moved back by one.
        for &(first, entry) in &unsorted {
            let place = &mut store.starts[first as usize];
            store.entries[*place as usize] = entry;
            *place += 1;
        }
        store.starts.rotate_right(1);
        store.starts[0] = 0;
        unsorted.clear();
        store.unsorted = unsorted;
    }

    /// Memory [byte].
    pub(crate) fn memory_size(&self) -> usize {
        self.starts.capacity() * size_of::<u32>()
            + self.entries.capacity() * size_of::<Entry>()
            + self.records.capacity() * size_of::<f64>()
            + self.unsorted.capacity() * size_of::<(u32, Entry)>()
    }

    /// Forgets everything, but keeps the room.
    pub(crate) fn forget(&mut self) {
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

    /// The memory of the contact of the first body with its partner, by their rows of then, in the layout of the group that it
    /// now belongs to.
    pub(crate) fn find(&self, first: u32, partner: u32, group: &ContactGroup) -> Option<Cow<'_, [f64]>> {
        let row = first as usize;
        let range = *self.starts.get(row)? as usize..*self.starts.get(row + 1)? as usize;
        let entry = self.entries[range].iter().find(|entry| entry.partner == partner)?;
        let (layout, law) = &self.layouts[entry.layout as usize];
        let record = &self.records[entry.record..entry.record + layout.columns()];
        let same_law = *law == group.model.normal.entry().name;
        if same_law && *layout == group.layout {
            return Some(record.into());
        }
        Some(group.layout.translate(layout, record, same_law).into())
    }
}
