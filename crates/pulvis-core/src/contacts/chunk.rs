//! A run of rows, the contacts that it owns, and the sums of their forces and torques.

use std::ops::Range;

use super::block::ContactGroup;
use crate::phases::Phases;

/// Rows of a chunk at the least, so that its blocks are full, and at the most, so that it fits into a
/// second-level cache.
const ROWS: Range<usize> = 128..1024;
/// Chunks that small systems are cut into, so that several threads find work.
const CHUNKS: usize = 12;

/// Consecutive rows, and every contact whose lower row is one of them.
///
/// Chunks are what threads take their work by. Each sums the forces and torques of its contacts in slots of its own:
/// one for each of its rows, then one for each row of later chunks that it has contacts with (its halo).
/// A row's load is the sum of its own index and of the halos of earlier chunks, in their order: no two
/// threads write to the same index, and the order of every sum is fixed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chunk {
    pub(crate) rows: Range<usize>,
    pub(crate) groups: Vec<ContactGroup>,
    /// Rows of later chunks, in ascending order: what listing gives to the list of all halos.
    pub(crate) halo: Vec<u32>,
    /// Parts of the halos of earlier chunks that are rows of this one.
    pub(crate) halo_contributions: Vec<HaloContribution>,
    /// How far the bodies of its contacts have moved.
    pub(crate) approach: Approach,
    /// Time spent on its contacts since it was listed.
    pub(crate) phases: Phases,
    /// Later chunks that wait for this one.
    pub(crate) dependents: Vec<u32>,
}

/// By how much gaps can have closed since candidates were listed [m]: those between the particles that
/// contacts of a chunk are of, and those between its rows and walls.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Approach {
    pub(crate) pairs: f64,
    pub(crate) walls: f64,
}

/// A part of an earlier chunk's halo.
#[derive(Clone, Debug)]
pub(crate) struct HaloContribution {
    /// Indices in the list of the halos of all chunks.
    pub(crate) slots: Range<usize>,
}

/// Cuts all rows into chunks, the same for any number of threads.
pub(crate) fn cut(rows: usize) -> Vec<Chunk> {
    let length = (rows / CHUNKS).clamp(ROWS.start, ROWS.end);
    let starts = (0..rows).step_by(length);
    starts.map(|start| Chunk { rows: start..(start + length).min(rows), ..Chunk::default() }).collect()
}

impl Chunk {
    /// Takes in a group, unless it is empty.
    pub(super) fn keep(&mut self, group: ContactGroup) {
        if group.len() > 0 {
            self.groups.push(group);
        }
    }
}
