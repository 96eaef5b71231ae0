//! How contact memory survives a new list of candidates.

use super::block::{ContactGroup, Partner};
use super::layout::Layout;
use crate::particles::ParticleId;

/// Who is in contact: the ids of two particles, the lower first, or a particle's id and a wall.
type Key = (u32, ParticleId, ParticleId);

/// The memory of all contacts that remember anything, sorted for searching.
#[derive(Clone, Debug, Default)]
pub(crate) struct MemoryStore {
    /// Key, layout and first place among the records, sorted by key.
    entries: Vec<(Key, u16, usize)>,
    records: Vec<f64>,
    /// The layouts that records were written with, and the names of their normal laws.
    layouts: Vec<(Layout, &'static str)>,
}

const NO_WALL: u32 = u32::MAX;

impl MemoryStore {
    /// The memory of the groups' contacts.
    pub(crate) fn gather<'a>(groups: impl Iterator<Item = &'a ContactGroup>, ids: &[ParticleId]) -> Self {
        let mut store = Self::default();
        for group in groups {
            let layout = store.layouts.len() as u16;
            store.layouts.push((group.layout, group.model.normal.entry().name));
            group.for_each_memory(|block, lane, record| {
                let first = ids[group.first[block][lane] as usize];
                let key = match group.partner {
                    Partner::Particle => (NO_WALL, first, ids[group.second[block][lane] as usize]),
                    Partner::Wall(wall) => (wall as u32, first, 0),
                };
                store.entries.push((key, layout, store.records.len()));
                store.records.extend_from_slice(record);
            });
        }
        store.entries.sort_unstable_by_key(|&(key, ..)| key);
        store
    }

    /// The memory of a contact in the layout of the group that it now belongs to.
    fn find(&self, key: Key, group: &ContactGroup) -> Option<std::borrow::Cow<'_, [f64]>> {
        let entry = self.entries.binary_search_by_key(&key, |&(key, ..)| key).ok()?;
        let (_, layout, start) = self.entries[entry];
        let (layout, law) = &self.layouts[usize::from(layout)];
        let record = &self.records[start..start + layout.columns()];
        let same_law = *law == group.model.normal.entry().name;
        if same_law && *layout == group.layout {
            return Some(record.into());
        }
        Some(group.layout.translate(layout, record, same_law).into())
    }

    /// Adds the candidate pair of two rows to `group`, the lower id first, with its memory.
    pub(crate) fn push_pair(&self, group: &mut ContactGroup, rows: (u32, u32), gap: f64, ids: &[ParticleId]) {
        let (one, other) = (ids[rows.0 as usize], ids[rows.1 as usize]);
        let (rows, key) = if one < other {
            (rows, (NO_WALL, one, other))
        } else {
            ((rows.1, rows.0), (NO_WALL, other, one))
        };
        let record = self.find(key, group);
        group.push(rows.0, rows.1, gap, record.as_deref());
    }

    /// Adds the particle of a row as a candidate of the group's wall, with its memory.
    pub(crate) fn push_wall(
        &self,
        group: &mut ContactGroup,
        wall: usize,
        row: u32,
        gap: f64,
        ids: &[ParticleId],
    ) {
        let record = self.find((wall as u32, ids[row as usize], 0), group);
        group.push(row, row, gap, record.as_deref());
    }
}
