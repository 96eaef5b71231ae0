//! A chunk: consecutive rows, the contacts that they own, and the sums of their forces and torques.

use std::ops::Range;

use super::block::ContactGroup;
use super::totals::ChunkTotals;
use crate::phases::Phases;

/// Smallest and largest number of rows of a chunk: blocks of eight shall be full, and the chunk shall fit into a
/// second-level cache.
const ROWS: Range<usize> = 128..1024;
/// Number of chunks of small systems, so that several threads have work.
const CHUNKS: usize = 12;

/// Consecutive rows, and every contact whose lower row is one of them.
///
/// Threads take their work chunk by chunk. Each chunk sums the forces and torques of its contacts in slots of its own:
/// one for each of its rows, then one for each row of later chunks that it has contacts with (its halo).
/// The force on a particle is the sum of its own chunk plus the halo contributions of earlier chunks, added in chunk
/// order: no two threads write to the same slot, and the order of every sum is fixed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chunk {
    pub(crate) rows: Range<usize>,
    pub(crate) groups: Vec<ContactGroup>,
    /// Rows of later chunks that it has contacts with, in ascending order; copied into the list of all halos.
    pub(crate) halo: Vec<u32>,
    /// The parts of earlier chunks' halos that are rows of this chunk.
    pub(crate) halo_contributions: Vec<HaloContribution>,
    /// By how much the gaps of its contacts can have closed.
    pub(crate) approach: Approach,
    /// Time spent on its contacts since the last rebuild.
    pub(crate) phases: Phases,
    /// Later chunks that this one contributes to.
    pub(crate) dependents: Vec<u32>,
    /// Whether chunks of other ranks contribute to it, so that it is finished only when these have told what.
    pub(crate) awaits_ranks: bool,
    /// What its contacts come to in the last pass.
    pub(crate) totals: ChunkTotals,
}

/// Upper bounds of how much the gaps of a chunk can have closed since the last rebuild [m]: gaps between particles, and
/// gaps between its particles and walls.
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
