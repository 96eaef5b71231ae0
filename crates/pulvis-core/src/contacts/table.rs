//! The neighbour list: rebuilt when bodies have left their skins, and computed in every step.

use std::ops::Range;

use pulvis_math::{InstructionSet, max_or_nan};
use pulvis_parallel::hand_over::HandOver;

use super::Interactions;
use super::block::{ContactGroup, Partner};
use super::chunk::{Approach, Chunk, HaloContribution, cut};
use super::force_pass::{ForcePass, Halos, Sweep};
use super::listing::{Listing, Sources};
use super::rebuild::MemoryStore;
use super::sums::Sums;
use super::view::{Deep, Views};
use crate::neighbours::{CellGrid, Moved, Skin};
use crate::particles::{ForceTorque, MaterialIndex, Particles};
use crate::shared::Shared;
use crate::thread_pool::ThreadPool;
use crate::walls::{Wall, WallNow};
use pulvis_boundary::{Images, UpperTriangular};

/// All neighbour pairs, and the memory of their contacts.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTable {
    chunks: Vec<Chunk>,
    /// The chunks that this rank lists and computes; all of them where it works alone. Of others it knows the halo rows
    /// that are its own.
    own: Range<usize>,
    /// Pairs in the lists of other ranks.
    candidates_elsewhere: usize,
    row_count: usize,
    /// The rows of all halos, chunk after chunk.
    halos: Vec<u32>,
    /// Where the halo of each chunk begins, and the end.
    halo_starts: Vec<usize>,
    /// The chunks of this rank that other ranks contribute to.
    awaiting: Vec<usize>,
    /// Which chunks are complete.
    hand_over: HandOver,
    /// Scratch: one for each worker of the pool.
    sums: Vec<Sums>,
    /// Scratch: one for each worker of the pool.
    listings: Vec<Listing>,
}

/// The inputs of a rebuild.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) particles: &'a Particles,
    /// The row of each particle at the last rebuild; particles inserted since have rows beyond these.
    pub(crate) order: &'a [u32],
    /// The materials of all particles, each once.
    pub(crate) materials: &'a [MaterialIndex],
    pub(crate) interactions: &'a Interactions,
    pub(crate) walls: &'a [Wall],
    pub(crate) images: Images,
    pub(crate) skin: &'a Skin,
    pub(crate) instructions: InstructionSet,
}

impl ContactTable {
    /// All groups, chunk by chunk, in each chunk pairs of particles first.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &ContactGroup> {
        self.chunks.iter().flat_map(|chunk| &chunk.groups)
    }

    /// The same, to be changed.
    pub(super) fn groups_mut(&mut self) -> impl Iterator<Item = &mut ContactGroup> {
        self.chunks.iter_mut().flat_map(|chunk| &mut chunk.groups)
    }

    /// All chunks, to be changed.
    pub(super) fn chunks_mut(&mut self) -> &mut [Chunk] {
        &mut self.chunks
    }

    /// All chunks.
    pub(crate) fn chunks(&self) -> &[Chunk] {
        &self.chunks
    }

    /// Where the halo of a chunk begins among those of all.
    pub(super) fn halo_start(&self, number: usize) -> usize {
        self.halo_starts[number]
    }

    /// Sets how many pairs are in the lists of other ranks.
    pub(crate) fn set_candidates_elsewhere(&mut self, pairs: usize) {
        self.candidates_elsewhere = pairs;
    }

    /// The number of the chunk that has a row.
    pub(crate) fn chunk_of(&self, row: u32) -> usize {
        // All but the last have the same length.
        row as usize / self.chunks.first().map_or(1, |chunk| chunk.rows.len().max(1))
    }

    /// Number of rows.
    pub(crate) fn row_count(&self) -> usize {
        self.row_count
    }

    /// The chunks of this rank.
    pub(crate) fn own(&self) -> Range<usize> {
        self.own.clone()
    }

    /// Copies the memory of all contacts into `store`.
    pub(crate) fn remember(&self, store: &mut MemoryStore, pool: &ThreadPool) {
        store.gather(&self.chunks, pool);
    }

    /// Rebuilds the list: all pairs within interaction range and skins. Contacts get their `memory` back. Returns the
    /// number of slots that forces and torques need: those of the rows, then those of the halos.
    pub(crate) fn rebuild(
        &mut self,
        around: &Surroundings<'_>,
        grid: &CellGrid,
        memory: &MemoryStore,
        pool: &ThreadPool,
    ) -> usize {
        if self.row_count != around.particles.len() {
            self.chunks = cut(around.particles.len());
            self.row_count = around.particles.len();
        }
        self.list(0..self.chunks.len(), around, grid, memory, pool);
        self.candidates_elsewhere = 0;
        self.link()
    }

    /// The same for the chunks of this rank alone; others have none afterwards. They are to be [linked](Self::link) when
    /// the ranks have told each other their halos.
    pub(crate) fn list(
        &mut self,
        own: Range<usize>,
        around: &Surroundings<'_>,
        grid: &CellGrid,
        memory: &MemoryStore,
        pool: &ThreadPool,
    ) {
        self.keep_only(own.clone());
        self.listings.resize_with(pool.threads(), Listing::default);
        let chunks = Shared::new(&mut self.chunks[own.clone()]);
        let listings = Shared::new(&mut self.listings);
        let sources = Sources { around, grid, memory };
        pool.for_each_number(own.len(), |worker, number| {
            // SAFETY: every worker is told its own number, and every chunk is listed once.
            let (listing, chunk) = unsafe { (listings.get_mut(worker), chunks.get_mut(number)) };
            listing.list(chunk, sources);
        });
    }

    /// Works alone again, when the contacts of all chunks are there. Returns the number of all slots.
    pub(crate) fn take_all(&mut self) -> usize {
        (self.own, self.candidates_elsewhere) = (0..self.chunks.len(), 0);
        self.link()
    }

    /// Keeps the contacts of these chunks only.
    pub(crate) fn keep_only(&mut self, own: Range<usize>) {
        for (number, chunk) in self.chunks.iter_mut().enumerate() {
            if !own.contains(&number) {
                chunk.groups.clear();
                chunk.halo.clear();
            }
        }
        self.own = own;
    }

    /// Gives each halo row a slot, after the slots of all rows, and links each chunk with the chunks that it
    /// contributes to. Returns the number of all slots.
    pub(crate) fn link(&mut self) -> usize {
        self.halos.clear();
        self.halo_starts.clear();
        for chunk in &mut self.chunks {
            chunk.halo_contributions.clear();
            chunk.dependents.clear();
        }
        for number in 0..self.chunks.len() {
            let start = self.halos.len();
            self.halo_starts.push(start);
            let halo = std::mem::take(&mut self.chunks[number].halo);
            let mut slot = 0;
            while slot < halo.len() {
                let later = self.chunks.partition_point(|chunk| chunk.rows.end <= halo[slot] as usize);
                let rows_end = self.chunks[later].rows.end;
                let after = slot + halo[slot..].partition_point(|&row| (row as usize) < rows_end);
                self.chunks[later]
                    .halo_contributions
                    .push(HaloContribution { slots: start + slot..start + after });
                self.chunks[number].dependents.push(later as u32);
                slot = after;
            }
            self.halos.extend_from_slice(&halo);
            self.chunks[number].halo = halo;
        }
        self.halo_starts.push(self.halos.len());
        let first_slot = self.halo_starts[self.own.start];
        let of_rank = |part: &&HaloContribution| part.slots.start >= first_slot;
        let own = &mut self.chunks[self.own.clone()];
        self.awaiting.clear();
        for (chunk, number) in own.iter_mut().zip(self.own.clone()) {
            chunk.awaits_ranks = !chunk.halo_contributions.iter().all(|part| of_rank(&part));
            if chunk.awaits_ranks {
                self.awaiting.push(number);
            }
        }
        self.hand_over = HandOver::new(
            own.iter().map(|chunk| chunk.halo_contributions.iter().filter(of_rank).count() as u32),
        );
        self.row_count + self.halos.len()
    }

    /// Bounds by how much gaps can have closed, from the displacements of the rows of every chunk and of walls since the
    /// last rebuild [m]. The two bodies of a contact of a chunk are two of its rows, or one of its rows and one of a
    /// chunk that it contributes to.
    pub(crate) fn close_gaps(&mut self, moved: impl Fn(usize) -> Moved, walls: f64) {
        for (number, chunk) in self.chunks.iter_mut().enumerate().take(self.own.end).skip(self.own.start) {
            let own = moved(number);
            let others = chunk.dependents.iter().map(|&other| moved(other as usize).longest);
            chunk.approach = Approach {
                pairs: own.longest + others.fold(own.second, max_or_nan),
                walls: own.longest + walls,
            };
        }
    }

    /// Computes the forces and torques of all contacts of this rank. `finish` is called with the number of a chunk, its
    /// rows and the forces and torques on them, when these are complete and no thread uses the rows any more.
    ///
    /// `swap` is called when all is computed, where other ranks contribute to chunks of this one: it fills the slots of
    /// their halos. The chunks that await them are finished afterwards, unless it fails.
    pub(crate) fn sweep<E>(
        &mut self,
        sweep: &Sweep<'_>,
        pool: &ThreadPool,
        swap: impl FnOnce() -> Result<(), E>,
        finish: impl Fn(usize, Range<usize>, &mut [ForceTorque]) + Sync,
    ) -> Result<(), E> {
        let Range { start: first, end } = self.own;
        self.sums.resize_with(pool.threads(), Sums::default);
        self.hand_over.begin(pool.threads());
        let pass = ForcePass {
            sweep: *sweep,
            chunks: Shared::new(&mut self.chunks),
            sums: Shared::new(&mut self.sums),
            hand_over: &self.hand_over,
            halos: Halos { rows: &self.halos, starts: &self.halo_starts, row_count: self.row_count },
            first,
            end,
            finish,
        };
        // SAFETY: every worker is told its own number, and every chunk is computed once.
        let compute = |worker, number| unsafe { pass.compute(worker, first + number) };
        pool.for_each_number_in_phases(end - first, compute, |worker, phase| {
            while let Some(number) = pass.hand_over.take(worker, phase) {
                // SAFETY: nobody else has taken it.
                unsafe { pass.finish_stored(first + number) };
            }
        });
        swap()?;
        pool.for_each_number(self.awaiting.len(), |_, number| {
            // SAFETY: all contributions are there, and every number is handed out once.
            unsafe { pass.finish_awaiting(self.awaiting[number]) };
        });
        Ok(())
    }

    /// The candidates that may overlap by more than `least` [m]; and others.
    pub(crate) fn deeper_than<'a>(
        &'a self,
        least: f64,
        particles: &'a Particles,
        images: Images,
        walls: &'a [WallNow],
    ) -> impl Iterator<Item = Deep> + 'a {
        let groups =
            self.chunks.iter().flat_map(|chunk| chunk.groups.iter().map(move |group| (chunk, group)));
        groups.flat_map(move |(chunk, group)| {
            let views = Views { group, particles, images, rate: UpperTriangular::ZERO, walls };
            let closed = match group.partner {
                Partner::Particle => chunk.approach.pairs,
                Partner::Wall => chunk.approach.walls,
            };
            // The gap is that to the interaction range, when it was listed: no overlap is larger than its opposite and what
            // it has closed since. Not `>`: where nothing bounds that, all are looked at.
            let deep = (0..group.gap.len()).filter(move |&block| {
                let shallow = closed - group.gap[block] <= least;
                !shallow
            });
            deep.flat_map(move |block| views.overlaps(block))
        })
    }

    /// Number of neighbour pairs.
    pub(crate) fn candidates(&self) -> usize {
        self.candidates_here() + self.candidates_elsewhere
    }

    /// Number of those that this rank lists.
    pub(crate) fn candidates_here(&self) -> usize {
        self.groups().map(ContactGroup::len).sum()
    }

    /// Memory of the whole table [byte].
    pub(crate) fn memory_size(&self) -> usize {
        let sums: usize = self.sums.iter().map(Sums::memory_size).sum();
        let listings: usize = self.listings.iter().map(Listing::memory_size).sum();
        let halos = 2 * size_of_val(&self.halos[..]) + sums + listings;
        self.groups().map(ContactGroup::memory_size).sum::<usize>() + halos
    }
}
