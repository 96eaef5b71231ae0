//! All candidate contacts: listed anew when bodies have moved, and swept every step.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use pulvis_contact::ContactEnergies;
use pulvis_math::Vector3;

use super::Interactions;
use super::block::{ContactGroup, Partner};
use super::kernel::{Advance, Load, Moving, WallMotionNow, sweep};
use super::piece::{Incoming, Piece, cut};
use super::rebuild::MemoryStore;
use crate::domain::Images;
use crate::neighbours::CellGrid;
use crate::particles::{MaterialIndex, Particles};
use crate::shared::Shared;
use crate::team::Team;
use crate::walls::Wall;

/// The candidates and what they remember.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTable {
    pieces: Vec<Piece>,
    /// Loads on the rows of each piece and of its halo.
    sums: Vec<Load>,
    pending: Vec<Countdown>,
}

/// Pieces whose contacts are still to be computed before the loads on a piece are complete.
#[derive(Debug, Default)]
struct Countdown {
    left: AtomicU32,
    start: u32,
}

impl Clone for Countdown {
    fn clone(&self) -> Self {
        Self::from(self.start)
    }
}

impl Countdown {
    fn from(start: u32) -> Self {
        Self { left: AtomicU32::new(start), start }
    }

    /// Whether this was the last one; the countdown then begins anew.
    fn is_over(&self) -> bool {
        // What others wrote before they counted down is seen by the last one.
        let over = self.left.fetch_sub(1, Ordering::AcqRel) == 1;
        if over {
            self.left.store(self.start, Ordering::Relaxed);
        }
        over
    }
}

/// What the list of candidates depends on.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) particles: &'a Particles,
    pub(crate) positions: &'a [Vector3],
    /// The materials of all particles, each once.
    pub(crate) materials: &'a [MaterialIndex],
    pub(crate) interactions: &'a Interactions,
    pub(crate) walls: &'a [Wall],
    pub(crate) images: Images,
    pub(crate) skin: f64,
}

impl ContactTable {
    /// All groups, piece by piece, in each piece pairs of particles first.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &ContactGroup> {
        self.pieces.iter().flat_map(|piece| &piece.groups)
    }

    /// The runs of rows that threads take their work by.
    pub(crate) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// What the contacts remember.
    pub(crate) fn memory(&self, particles: &Particles) -> MemoryStore {
        MemoryStore::gather(self.groups(), &particles.id)
    }

    /// Lists all candidates within reach and skin; contacts keep their `memory`.
    pub(crate) fn rebuild(
        &mut self,
        around: &Surroundings<'_>,
        grid: &CellGrid,
        memory: &MemoryStore,
        team: &Team,
    ) {
        self.pieces = cut(around.particles.len());
        team.for_each(&mut self.pieces, |_, piece| piece.list(around, grid, memory));
        self.link();
    }

    /// Gives every piece its sums, and tells it whose halos it takes part in.
    fn link(&mut self) {
        let mut end = 0;
        for number in 0..self.pieces.len() {
            let piece = &mut self.pieces[number];
            piece.sums = end..end + piece.rows.len() + piece.halo.len();
            end = piece.sums.end;
            let halo = piece.halo.clone();
            let mut slot = 0;
            while slot < halo.len() {
                let later = self.pieces.partition_point(|piece| piece.rows.end <= halo[slot] as usize);
                let rows_end = self.pieces[later].rows.end;
                let after = slot + halo[slot..].partition_point(|&row| (row as usize) < rows_end);
                let slots = slot as u32..after as u32;
                self.pieces[later].incoming.push(Incoming { source: number as u32, slots });
                self.pieces[number].dependents.push(later as u32);
                slot = after;
            }
        }
        self.sums.clear();
        self.sums.resize(end, Load::default());
        let counts = self.pieces.iter().map(|piece| 1 + piece.incoming.len() as u32);
        self.pending = counts.map(Countdown::from).collect();
    }

    /// Computes the loads of all contacts. When those on the rows of a piece are complete, and nobody
    /// reads these rows any more, `finish` is called with the number of the piece, its rows and the
    /// loads.
    pub(crate) fn sweep(
        &mut self,
        moving: Moving<'_>,
        walls: &[WallMotionNow],
        advance: &Advance,
        team: &Team,
        finish: impl Fn(usize, Range<usize>, &[Load]) + Sync,
    ) {
        let count = self.pieces.len();
        let (pieces, sums) = (Shared::new(&mut self.pieces), Shared::new(&mut self.sums));
        let pending = &self.pending;
        team.for_each_number(count, |number| {
            {
                // SAFETY: nobody looks at a piece, or at its sums, before it has counted down below.
                let piece = unsafe { pieces.get_mut(number) };
                let own = unsafe { sums.range_mut(piece.sums.clone()) };
                own.fill(Load::default());
                for group in &mut piece.groups {
                    // SAFETY: rows and places were listed for these columns and sums. `finish`, which
                    // writes rows, is not called for rows of this piece or its halo before it has
                    // counted down.
                    unsafe { sweep(group, own, moving, walls, advance) };
                }
            }
            // SAFETY: from here on the piece is only read, until the next sweep.
            let piece = unsafe { pieces.get(number) };
            let dependents = piece.dependents.iter().map(|&dependent| dependent as usize);
            for ready in std::iter::once(number).chain(dependents) {
                if pending[ready].is_over() {
                    // SAFETY: the sweep over the piece and over all with a part in it is over; this
                    // thread alone has seen the end of the countdown.
                    let loads = unsafe { complete(pieces, sums, ready) };
                    let rows = unsafe { pieces.get(ready) }.rows.clone();
                    finish(ready, rows, loads);
                }
            }
        });
    }

    /// The sum of all contacts' energies, group by group: the same for any number of threads.
    pub(crate) fn energies(&self) -> ContactEnergies {
        let mut sum = ContactEnergies::default();
        for group in self.groups() {
            sum += group.totals.energies;
        }
        sum
    }

    /// Adds the force of every wall on the particles to its place in `forces`.
    pub(crate) fn add_wall_forces(&self, forces: &mut [Vector3]) {
        for group in self.groups() {
            if let Partner::Wall(place) = group.partner {
                forces[place] += group.totals.force;
            }
        }
    }

    /// Number of candidate contacts.
    pub(crate) fn candidates(&self) -> usize {
        self.groups().map(ContactGroup::len).sum()
    }

    /// Memory of the whole table [byte].
    pub(crate) fn memory_size(&self) -> usize {
        let halos: usize = self.pieces.iter().map(|piece| size_of_val(&piece.halo[..])).sum();
        self.groups().map(ContactGroup::memory_size).sum::<usize>() + halos + size_of_val(&self.sums[..])
    }
}

/// The loads on the rows of a piece, with what earlier pieces' halos hold of them.
///
/// # Safety
/// All contacts of the piece and of those with a part in it have been computed, and no other thread
/// completes the same piece.
unsafe fn complete<'a>(pieces: Shared<'_, Piece>, sums: Shared<'a, Load>, number: usize) -> &'a [Load] {
    // SAFETY: the caller's; own sums of a piece and its halo's are different parts of `sums`.
    unsafe {
        let piece = pieces.get(number);
        let start = piece.sums.start;
        let own = sums.range_mut(start..start + piece.rows.len());
        for Incoming { source, slots } in &piece.incoming {
            let source = pieces.get(*source as usize);
            let halo_start = source.sums.start + source.rows.len();
            for slot in slots.start as usize..slots.end as usize {
                let part = sums.get(halo_start + slot);
                let sum = &mut own[source.halo[slot] as usize - piece.rows.start];
                sum.force.vector += part.force.vector;
                sum.torque.vector += part.torque.vector;
            }
        }
        own
    }
}
