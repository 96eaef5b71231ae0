//! Keeps the memory of contacts over a rebuild of the neighbour list.

use std::borrow::Cow;

use pulvis_contact::MemoryLayout;
use pulvis_parallel::exchange::{ExchangeError, Message};

use super::block::{ContactGroup, Partner};
use super::chunk::Chunk;
use crate::ranks::message::Numbers;
use crate::thread_pool::ThreadPool;
use crate::walls::WallFeature;

/// The memory of all contacts that remember anything, by the rows that their bodies had when it was stored. Rows are used
/// and not ids, because neighbouring rows are near each other in space and in memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct MemoryStore {
    /// One for each chunk at that time.
    chunks: Vec<ChunkMemory>,
    /// Rows per chunk, except in the last one.
    length: u32,
    /// The layouts of the records.
    layouts: Vec<MemoryLayout>,
}

/// The index of a group's layout among those of a store; `None` if the store has no record of this layout.
pub(crate) type LayoutNumber = Option<u32>;

/// The memory of the contacts that a chunk owned, by the lower row.
#[derive(Clone, Debug, Default)]
struct ChunkMemory {
    first_row: usize,
    /// First entry of each row, and one more at the end.
    starts: Vec<u32>,
    /// The higher row of each entry, or the number of a wall partner; padded so that eight can be read at a time.
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

/// The number of a wall feature, used where contacts between particles have the row of the second body.
pub(crate) fn wall_partner(feature: WallFeature) -> u32 {
    u32::MAX - feature.number()
}

impl MemoryStore {
    /// Stores the memory of the contacts of all chunks, in place of what was stored before.
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

    /// Writes the memory of every contact that other ranks will own into the message to its owner. `owner` answers with the
    /// rank of a contact by its stored rows, the second of which may be that of a wall, and `layouts` are those of all
    /// models in an order that all ranks know.
    pub(crate) fn tell(
        &self,
        layouts: &[MemoryLayout],
        own: usize,
        owner: impl Fn(u32, u32) -> usize,
        messages: &mut [Message],
    ) {
        let known = |layout: u32| layouts.iter().position(|known| *known == self.layouts[layout as usize]);
        let known: Vec<usize> =
            (0..self.layouts.len() as u32).map(|one| known(one).unwrap_or(usize::MAX)).collect();
        for memory in &self.chunks {
            for (index, entries) in memory.starts.windows(2).enumerate() {
                let row = (memory.first_row + index) as u32;
                for entry in entries[0] as usize..entries[1] as usize {
                    let partner = memory.partners[entry];
                    let rank = owner(row, partner);
                    if rank == own {
                        continue;
                    }
                    let Entry { layout, record } = memory.entries[entry];
                    let width = self.layouts[layout as usize].columns();
                    let head = [row, partner].map(f64::from);
                    messages[rank].extend(head);
                    messages[rank].push(known[layout as usize] as f64);
                    messages[rank]
                        .extend_from_slice(&memory.records[record as usize..record as usize + width]);
                }
            }
        }
    }

    /// Takes in what other ranks have told, each of the chunks that it stored.
    ///
    /// # Errors
    /// A message is damaged.
    pub(crate) fn hear(&mut self, layouts: &[MemoryLayout], message: &[f64]) -> Result<(), ExchangeError> {
        let damaged = || ExchangeError { reason: "memory of a contact that no rank can have".to_owned() };
        let mut numbers = Numbers::of(message);
        let mut touched = Vec::new();
        while !numbers.is_empty() {
            let [row, partner] = [numbers.next()? as u32, numbers.next()? as u32];
            let layout = *layouts.get(numbers.next_index()?).ok_or_else(damaged)?;
            let records = numbers.take(layout.columns())?;
            let number = match self.layouts.iter().position(|known| *known == layout) {
                Some(number) => number,
                None => {
                    self.layouts.push(layout);
                    self.layouts.len() - 1
                }
            };
            let chunk = row.checked_div(self.length).ok_or_else(damaged)? as usize;
            let memory = self.chunks.get_mut(chunk).ok_or_else(damaged)?;
            if touched.last() != Some(&chunk) {
                touched.push(chunk);
            }
            let entry = Entry { layout: number as u32, record: memory.records.len() as u32 };
            let index = row - memory.first_row as u32;
            memory.records.extend_from_slice(records);
            memory.unsorted.push(([index, partner], entry));
            memory.starts[index as usize + 1] += 1;
        }
        for chunk in touched {
            self.chunks[chunk].place();
        }
        Ok(())
    }

    /// The layout number of a group, for [`find`](Self::find).
    pub(crate) fn layout_number(&self, group: &ContactGroup) -> LayoutNumber {
        self.layouts.iter().position(|known| *known == group.layout).map(|number| number as u32)
    }

    /// Memory [byte].
    pub(crate) fn memory_size(&self) -> usize {
        self.chunks.iter().map(ChunkMemory::memory_size).sum()
    }

    /// The memory of the contact between two bodies, by their stored rows, in the layout of the group that it now
    /// belongs to. `number` is the [layout number](Self::layout_number) of that group.
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
        for group in &chunk.groups {
            let layout = store.layout_number(group).unwrap_or_default();
            group.for_each_memory(&mut self.records, |block, lane, record| {
                let first = group.first_row(block, lane);
                let partner = match group.partner {
                    Partner::Particle => group.second_row(block, lane),
                    Partner::Wall => wall_partner(WallFeature::from_number(group.second_row(block, lane))),
                };
                let index = first.min(partner) - self.first_row as u32;
                let entry = Entry { layout, record: record as u32 };
                self.unsorted.push(([index, first.max(partner)], entry));
                self.starts[index as usize + 1] += 1;
            });
        }
        self.place();
    }

    /// Puts the unsorted entries in the order of their rows; `starts` holds the number of those of each row, one further.
    fn place(&mut self) {
        let mut unsorted = std::mem::take(&mut self.unsorted);
        for row in 1..self.starts.len() {
            self.starts[row] += self.starts[row - 1];
        }
        self.entries.resize(unsorted.len(), Entry::default());
        self.partners.resize(unsorted.len() + 8, 0);
        // While entries are placed, `starts[row]` is the next free index of the row. At the end it is the start of the
        // next row, so that a shift by one restores the starts.
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

    /// The layout number of the contact of two rows, and the records from its first value on.
    #[inline(always)]
    fn find(&self, row: u32, partner: u32) -> Option<(u32, &[f64])> {
        let index = row as usize - self.first_row;
        let (mut start, end) = (*self.starts.get(index)?, *self.starts.get(index + 1)?);
        while start < end {
            let eight = self.partners.get(start as usize..)?.first_chunk::<8>()?;
            // Without a branch for each entry: branches would be unpredictable here.
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
