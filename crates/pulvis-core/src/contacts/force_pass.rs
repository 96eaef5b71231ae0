//! One pass over all contacts, chunk by chunk. Each chunk is finished when its forces and torques are complete.

use std::ops::Range;

use pulvis_parallel::hand_over::HandOver;

use super::block::Partner;
use super::chunk::{Chunk, HaloContribution};
use super::kernel::{self, Advance, KinematicColumns, Prefetch};
use super::sums::{ChunkSums, Sums};
use crate::particles::ForceTorque;
use crate::phases::Stopwatch;
use crate::shared::Shared;
use crate::walls::WallNow;

/// The inputs of a pass over all contacts.
#[derive(Clone, Copy)]
pub(crate) struct Sweep<'a> {
    /// Forces and torques that are not complete yet: one slot per row, then one per halo row of any chunk.
    pub(crate) forces_and_torques: Shared<'a, ForceTorque>,
    pub(crate) moving: KinematicColumns<'a>,
    pub(crate) walls: &'a [WallNow],
    pub(crate) advance: &'a Advance,
    /// Whether `forces_and_torques` shall hold the complete ones of all rows at the end.
    pub(crate) keep: bool,
}

/// The halos of all chunks.
#[derive(Clone, Copy)]
pub(super) struct Halos<'a> {
    /// The rows of all halos, chunk after chunk.
    pub(super) rows: &'a [u32],
    /// Where the halo of each chunk begins, and the end.
    pub(super) starts: &'a [usize],
    /// Number of all rows; the slots of halos follow the slots of rows.
    pub(super) row_count: usize,
}

impl<'a> Halos<'a> {
    /// The halo of a chunk; empty beyond the last chunk.
    fn of(self, number: usize) -> &'a [u32] {
        match self.starts.get(number..number + 2) {
            Some(&[start, end]) => &self.rows[start..end],
            _ => &[],
        }
    }
}

/// A pass over all contacts; see [`Sweep`].
pub(super) struct ForcePass<'a, F> {
    pub(super) sweep: Sweep<'a>,
    pub(super) chunks: Shared<'a, Chunk>,
    /// One for each worker of the pool.
    pub(super) sums: Shared<'a, Sums>,
    pub(super) hand_over: &'a HandOver,
    pub(super) halos: Halos<'a>,
    /// The number of the first chunk of this rank, from which its hand-over counts, and the end.
    pub(super) first: usize,
    pub(super) end: usize,
    /// Called with the number of a chunk, its rows and the complete forces and torques on them.
    pub(super) finish: F,
}

impl<F: Fn(usize, Range<usize>, &mut [ForceTorque])> ForcePass<'_, F> {
    /// Computes the contacts of a chunk, and finishes the chunks that are complete thereby.
    ///
    /// # Safety
    /// No other thread works as this `worker`, and none computes this chunk.
    pub(super) unsafe fn compute(&self, worker: usize, number: usize) {
        let Sweep { forces_and_torques, keep, .. } = self.sweep;
        // SAFETY: the caller's; no other thread reads a chunk before it has counted down below.
        let (sums, chunk) = unsafe { (self.sums.get_mut(worker), self.chunks.get_mut(number)) };
        let sums = self.sum_contacts(number, chunk, sums);
        chunk.totals.take_in(&chunk.groups, self.sweep.advance.stored);
        // From here on the chunk is only read, until the next pass.
        let (chunk, rows) = (&*chunk, chunk.rows.clone());
        let (own, halo) = sums.split_at_mut(rows.len());
        let start = self.halos.row_count + self.halos.starts[number];
        // SAFETY: only this chunk writes these slots; they are read after it has counted down.
        unsafe { forces_and_torques.range_mut(start..start + halo.len()) }.copy_from_slice(halo);
        let own_number = number - self.first;
        let completes = self.hand_over.completes_at_once(own_number);
        if completes && !chunk.awaits_ranks {
            // SAFETY: all chunks that contribute to this one have counted down, and no other thread finishes it.
            unsafe { self.complete(chunk, own) };
            (self.finish)(number, rows.clone(), own);
            if keep {
                // SAFETY: the forces and torques of these rows, which this thread alone has finished.
                unsafe { forces_and_torques.range_mut(rows) }.copy_from_slice(own);
            }
        } else {
            // SAFETY: the sums of these rows, which are not complete.
            unsafe { forces_and_torques.range_mut(rows) }.copy_from_slice(own);
            if !completes && self.hand_over.count_own(worker, own_number) {
                // SAFETY: the hand-over has told this thread alone to finish the chunk.
                unsafe { self.finish_stored(number) };
            }
        }
        for later in self.own_dependents(chunk) {
            if self.hand_over.count_down(worker, later - self.first) {
                // SAFETY: as above.
                unsafe { self.finish_stored(later) };
            }
        }
    }

    /// Sums the forces and torques of a chunk's contacts: those on its rows, then those on its halo.
    fn sum_contacts<'b>(
        &self,
        number: usize,
        chunk: &mut Chunk,
        sums: &'b mut Sums,
    ) -> &'b mut [ForceTorque] {
        let Sweep { moving, walls, advance, .. } = self.sweep;
        let Chunk { rows, groups, phases, approach, .. } = chunk;
        // Prefetching happens in the first group, which is the largest. The next chunk is usually the following one.
        let next_halo = self.halos.of(number + 1);
        let count = rows.len() + self.halos.of(number).len();
        let ChunkSums { sums, next: next_sums, next_zeroed } =
            sums.of_chunk(count, rows.len() + next_halo.len());
        let next_count = next_sums.len();
        let pairs_come_first = groups.first().is_some_and(|group| group.partner == Partner::Particle);
        let mut prefetch =
            Prefetch { rows: rows.end..rows.end + rows.len(), halo: next_halo, sums: next_sums };
        let mut clock = Stopwatch::start(advance.timed);
        for group in groups {
            let prefetch = std::mem::take(&mut prefetch);
            // SAFETY: rows and slots were listed for these columns and sums. `finish`, which writes rows, is
            // not called for rows of this chunk or its halo before it has counted down.
            unsafe { kernel::sweep(group, sums, moving, walls, advance, *approach, prefetch) };
            clock.lap(match group.partner {
                Partner::Particle => &mut phases.pairs,
                Partner::Wall => &mut phases.walls,
            });
        }
        if pairs_come_first {
            *next_zeroed = next_count;
        }
        sums
    }

    /// The chunks of this rank that a chunk contributes to.
    fn own_dependents<'b>(&self, chunk: &'b Chunk) -> impl Iterator<Item = usize> + use<'b, F> {
        let end = self.end;
        chunk.dependents.iter().map(|&later| later as usize).take_while(move |&later| later < end)
    }

    /// Finishes a chunk whose own sums are stored in the slots of its rows, unless other ranks contribute to it.
    ///
    /// # Safety
    /// All chunks of this rank that contribute to this one have counted down, and no other thread finishes it.
    pub(super) unsafe fn finish_stored(&self, number: usize) {
        // SAFETY: the caller's.
        unsafe {
            if !self.chunks.get(number).awaits_ranks {
                self.finish_awaiting(number);
            }
        }
    }

    /// The same where the contributions of other ranks are there.
    ///
    /// # Safety
    /// As above.
    pub(super) unsafe fn finish_awaiting(&self, number: usize) {
        // SAFETY: the caller's.
        unsafe {
            let chunk = self.chunks.get(number);
            let own = self.sweep.forces_and_torques.range_mut(chunk.rows.clone());
            self.complete(chunk, own);
            (self.finish)(number, chunk.rows.clone(), own);
        }
    }

    /// Adds the halo contributions of earlier chunks to the forces and torques on the rows of a chunk, in chunk order.
    ///
    /// # Safety
    /// All contacts of the chunk and of those that contribute to it have been computed.
    unsafe fn complete(&self, chunk: &Chunk, own: &mut [ForceTorque]) {
        let Halos { rows, row_count, .. } = self.halos;
        for HaloContribution { slots } in &chunk.halo_contributions {
            for slot in slots.clone() {
                // SAFETY: the caller's; the slots of halos follow those of all rows.
                let part = unsafe { self.sweep.forces_and_torques.get(row_count + slot) };
                let sum = &mut own[rows[slot] as usize - chunk.rows.start];
                sum.force.vector += part.force.vector;
                sum.torque.vector += part.torque.vector;
            }
        }
    }
}
