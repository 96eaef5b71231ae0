//! Which contacts act on which particle.

use super::block::{CAPACITY, ContactGroup, Partner, WIDTH};

/// For each particle its contacts, in the order of the list: every sum over them has a fixed order,
/// whatever the number of threads.
#[derive(Clone, Debug, Default)]
pub(crate) struct Adjacency {
    starts: Vec<u32>,
    /// Twice the contact's number in the whole table, plus one where the particle is the second body.
    entries: Vec<u32>,
}

impl Adjacency {
    /// The contacts of `particles` particles.
    pub(crate) fn of(groups: &[ContactGroup], particles: usize) -> Self {
        let mut starts = vec![0_u32; particles + 1];
        for_each_end(groups, |row, _| starts[row as usize + 1] += 1);
        for row in 0..particles {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut entries = vec![0; next[particles] as usize];
        for_each_end(groups, |row, entry| {
            let place = &mut next[row as usize];
            entries[*place as usize] = entry;
            *place += 1;
        });
        Self { starts, entries }
    }

    /// The entries of a particle.
    #[inline(always)]
    pub(crate) fn of_row(&self, row: usize) -> &[u32] {
        &self.entries[self.starts[row] as usize..self.starts[row + 1] as usize]
    }

    /// Memory [byte].
    pub(crate) fn memory_size(&self) -> usize {
        size_of_val(&self.starts[..]) + size_of_val(&self.entries[..])
    }
}

/// Calls `see` with the row and the entry of both ends of every contact.
fn for_each_end(groups: &[ContactGroup], mut see: impl FnMut(u32, u32)) {
    for (number, group) in groups.iter().enumerate() {
        for place in 0..group.len() {
            let entry = 2 * (number * CAPACITY + place) as u32;
            see(group.first[place / WIDTH][place % WIDTH], entry);
            if group.partner == Partner::Particle {
                see(group.second[place / WIDTH][place % WIDTH], entry + 1);
            }
        }
    }
}
