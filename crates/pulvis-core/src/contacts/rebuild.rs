//! How contact memory survives a new list of candidates.

use std::borrow::Cow;

use super::block::{ContactGroup, Partner};
use super::layout::Layout;
use crate::particles::ParticleId;

/// The memory of all contacts that remember anything, by the id of their first body.
#[derive(Clone, Debug, Default)]
pub(crate) struct MemoryStore {
    /// First entry of each id, and one more at the end.
    starts: Vec<u32>,
    entries: Vec<Entry>,
    records: Vec<f64>,
    /// The layouts that records were written with, and the names of their normal laws.
    layouts: Vec<(Layout, &'static str)>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    /// Id of the second body, or what stands for a wall.
    partner: u32,
    layout: u32,
    /// First place among the records.
    record: usize,
}

/// What stands for a wall where other contacts have the id of their second body.
pub(crate) fn wall_partner(wall: usize) -> u32 {
    u32::MAX - wall as u32
}

impl MemoryStore {
    /// The memory of the groups' contacts.
    pub(crate) fn gather<'a>(groups: impl Iterator<Item = &'a ContactGroup>, ids: &[ParticleId]) -> Self {
        let mut store = Self { starts: vec![0; ids.len() + 1], ..Self::default() };
        let mut unsorted: Vec<(ParticleId, Entry)> = Vec::new();
        for group in groups {
            let layout = store.number_of(group);
            group.for_each_memory(|block, lane, record| {
                let first = ids[group.first[block][lane] as usize];
                let partner = match group.partner {
                    Partner::Particle => ids[group.second[block][lane] as usize],
                    Partner::Wall(wall) => wall_partner(wall),
                };
                unsorted.push((first, Entry { partner, layout, record: store.records.len() }));
                store.starts[first as usize + 1] += 1;
                store.records.extend_from_slice(record);
            });
        }
        for id in 0..ids.len() {
            store.starts[id + 1] += store.starts[id];
        }
        let mut next = store.starts.clone();
        store.entries.resize(unsorted.len(), Entry::default());
        for (first, entry) in unsorted {
            let place = &mut next[first as usize];
            store.entries[*place as usize] = entry;
            *place += 1;
        }
        store
    }

    fn number_of(&mut self, group: &ContactGroup) -> u32 {
        let layout = (group.layout, group.model.normal.entry().name);
        let known = self.layouts.iter().position(|known| *known == layout);
        known.unwrap_or_else(|| {
            self.layouts.push(layout);
            self.layouts.len() - 1
        }) as u32
    }

    /// The memory of the contact of the first body with its partner, in the layout of the group that it
    /// now belongs to.
    pub(crate) fn find(
        &self,
        first: ParticleId,
        partner: u32,
        group: &ContactGroup,
    ) -> Option<Cow<'_, [f64]>> {
        let id = first as usize;
        let range = *self.starts.get(id)? as usize..*self.starts.get(id + 1)? as usize;
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
