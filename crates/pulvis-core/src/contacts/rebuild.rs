//! How contact memory survives a new list of candidates.

use std::borrow::Cow;

use pulvis_contact::MemoryLayout;

use super::block::{ContactGroup, Partner};
use super::chunk::Chunk;
use crate::thread_pool::ThreadPool;
use crate::walls::WallFeature;

/// The memory of all contacts that remember anything, by the rows that their bodies had when it was
/// inputs: rows that follow each other are near each other, ids are not.
#[derive(Clone, Debug, Default)]
pub(crate) struct MemoryStore {
    /// One for each chunk of then.
    chunks: Vec<ChunkMemory>,
    /// Rows of a chunk, but for the last one.
    length: u32,
    /// The layouts that records are written with.
    layouts: Vec<MemoryLayout>,
}

/// The index of a group's layout among those of a store; none if nothing was written with it.
pub(crate) type LayoutNumber = Option<u32>;

/// The memory of the contacts that a chunk owned, by the lower row.
#[derive(Clone, Debug, Default)]
struct ChunkMemory {
    first_row: usize,
    /// First entry of each row, and one more at the end.
    starts: Vec<u32>,
    /// The higher row of each entry, or what stands for a wall; and then some more, to be read eight at a time.
    partners: Vec<u32>,
    entries: Vec<Entry>,
    records: Vec<f64>,
    /// Scratch.
    unsorted: Vec<([u32; 2], Entry)>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    layout: u32,
    /// First index among the records.
    record: u32,
}

/// What stands for a feature of a wall where other contacts have the row of their second body.
pub(crate) fn wall_partner(feature: WallFeature) -> u32 {
    u32::MAX - feature.number()
}

impl MemoryStore {
    /// Takes in the memory of the contacts of all chunks; what was in it before is forgotten.
    pub(crate) fn gather(&mut self, chunks: &[Chunk], pool: &ThreadPool) {
        self.length = chunks.first().map_or(0, |chunk| chunk.rows.len() as u32);
        self.layouts.clear();
        for group in chunks.iter().flat_map(|chunk| &chunk.groups) {
            if self.layout_number(group).is_none() {
                self.layouts.push(group.layout);
            }
        }
        let mut memories = std::mem::take(&mut self.chunks);
        memories.resize_with(chunks.len(), ChunkMemory::default);
        pool.for_each(&mut memories, |number, memory| memory.gather(&chunks[number], self));
        self.chunks = memories;
    }

    /// The number that [`find`](Self::find) asks for, for all contacts of a group.
    pub(crate) fn layout_number(&self, group: &ContactGroup) -> LayoutNumber {
        self.layouts.iter().position(|known| *known == group.layout).map(|number| number as u32)
    }

    /// Memory [byte].
    pub(crate) fn memory_size(&self) -> usize {
        self.chunks.iter().map(ChunkMemory::memory_size).sum()
    }

    /// The memory of the contact between two bodies, by their rows of then, in the layout of the group that
    /// it now belongs to, which has this `number` here.
    #[inline(always)]
    pub(crate) fn find(
        &self,
        rows: [u32; 2],
        group: &ContactGroup,
        number: LayoutNumber,
    ) -> Option<Cow<'_, [f64]>> {
        let [low, high] = [rows[0].min(rows[1]), rows[0].max(rows[1])];
        let memory = self.chunks.get(low.checked_div(self.length)? as usize)?;
        let (layout, records) = memory.find(low, high)?;
        if Some(layout) == number {
            return records.get(..group.layout.columns()).map(Cow::from);
        }
        let before = &self.layouts[layout as usize];
        Some(group.layout.translate(before, &records[..before.columns()]).into())
    }
}

impl ChunkMemory {
    fn gather(&mut self, chunk: &Chunk, store: &MemoryStore) {
        self.starts.clear();
        self.records.clear();
        self.first_row = chunk.rows.start;
        self.starts.resize(chunk.rows.len() + 1, 0);
        let mut unsorted = std::mem::take(&mut self.unsorted);
        for group in &chunk.groups {
            let layout = store.layout_number(group).unwrap_or_default();
            group.for_each_memory(&mut self.records, |block, lane, record| {
                let first = group.first_row(block, lane);
                let partner = match group.partner {
                    Partner::Particle => group.second_row(block, lane),
                    Partner::Wall => wall_partner(WallFeature::from_number(group.second_row(block, lane))),
                };
                let index = first.min(partner) - self.first_row as u32;
                unsorted.push(([index, first.max(partner)], Entry { layout, record: record as u32 }));
                self.starts[index as usize + 1] += 1;
            });
        }
        for row in 0..chunk.rows.len() {
            self.starts[row + 1] += self.starts[row];
        }
        self.entries.resize(unsorted.len(), Entry::default());
        self.partners.resize(unsorted.len() + 8, 0);
        // Every row's next free index is kept where the row begins, until all are moved back by one.
        for &([row, partner], entry) in &unsorted {
            let index = &mut self.starts[row as usize];
            self.partners[*index as usize] = partner;
            self.entries[*index as usize] = entry;
            *index += 1;
        }
        self.starts.rotate_right(1);
        self.starts[0] = 0;
        unsorted.clear();
        self.unsorted = unsorted;
    }

    fn memory_size(&self) -> usize {
        self.starts.capacity() * size_of::<u32>()
            + self.partners.capacity() * size_of::<u32>()
            + self.entries.capacity() * size_of::<Entry>()
            + self.records.capacity() * size_of::<f64>()
            + self.unsorted.capacity() * size_of::<([u32; 2], Entry)>()
    }

    /// The number of the layout of what two rows' contact remembers, and the records from there on.
    #[inline(always)]
    fn find(&self, row: u32, partner: u32) -> Option<(u32, &[f64])> {
        let index = row as usize - self.first_row;
        let (mut start, end) = (*self.starts.get(index)?, *self.starts.get(index + 1)?);
        while start < end {
            let eight = self.partners.get(start as usize..)?.first_chunk::<8>()?;
            // Without a branch for each: how many a row has follows no pattern.
            let equal = (0..8).fold(0_u32, |bits, lane| bits | u32::from(eight[lane] == partner) << lane);
            let found = start + equal.trailing_zeros();
            if found < end.min(start + 8) {
                let entry = self.entries.get(found as usize)?;
                return Some((entry.layout, self.records.get(entry.record as usize..)?));
            }
            start += 8;
        }
        None
    }
}
