//! All candidate contacts: listed anew when bodies have moved, and swept every step.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use pulvis_contact::ContactEnergies;
use pulvis_math::{InstructionSet, Vector3};

use super::Interactions;
use super::block::{ContactGroup, Partner};
use super::kernel::{Advance, Ahead, Moving, WallMotionNow, sweep};
use super::piece::{Incoming, Piece, cut};
use super::rebuild::MemoryStore;
use crate::domain::Images;
use crate::neighbours::CellGrid;
use crate::particles::{Load, MaterialIndex, Particles};
use crate::phases::Stopwatch;
use crate::shared::Shared;
use crate::team::Team;
use crate::walls::Wall;

/// The candidates and what they remember.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTable {
    pieces: Vec<Piece>,
    row_count: usize,
    /// The halos of all pieces, one behind the other.
    halos: Vec<u32>,
    /// Where the halo of each piece begins, and the end.
    halo_starts: Vec<usize>,
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
    /// The rows that the particles had when contacts were last listed.
    pub(crate) order: &'a [u32],
    /// The materials of all particles, each once.
    pub(crate) materials: &'a [MaterialIndex],
    pub(crate) interactions: &'a Interactions,
    pub(crate) walls: &'a [Wall],
    pub(crate) images: Images,
    pub(crate) skin: f64,
    pub(crate) instructions: InstructionSet,
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

    /// Lets `store` remember what the contacts remember.
    pub(crate) fn remember(&self, store: &mut MemoryStore, rows: usize) {
        store.gather(self.groups(), rows);
    }

    /// Lists all candidates within reach and skin; contacts keep their `memory`. Answers with the number
    /// of places that the loads need, those of the rows first.
    pub(crate) fn rebuild(
        &mut self,
        around: &Surroundings<'_>,
        grid: &CellGrid,
        memory: &MemoryStore,
        team: &Team,
    ) -> usize {
        if self.pieces.is_empty() {
            self.pieces = cut(around.particles.len());
        }
        team.for_each(&mut self.pieces, |_, piece| piece.list(around, grid, memory));
        self.row_count = around.particles.len();
        self.link(self.row_count)
    }

    /// Gives the halo of every piece its sums, which stand behind those of all `rows`, and tells every
    /// piece whose halos it takes part in. Answers with the end of all sums.
    fn link(&mut self, rows: usize) -> usize {
        self.halos.clear();
        self.halo_starts.clear();
        for number in 0..self.pieces.len() {
            let start = self.halos.len();
            self.halo_starts.push(start);
            self.pieces[number].place_halo(rows + start);
            let halo = std::mem::take(&mut self.pieces[number].halo);
            let mut slot = 0;
            while slot < halo.len() {
                let later = self.pieces.partition_point(|piece| piece.rows.end <= halo[slot] as usize);
                let rows_end = self.pieces[later].rows.end;
                let after = slot + halo[slot..].partition_point(|&row| (row as usize) < rows_end);
                self.pieces[later].incoming.push(Incoming { slots: start + slot..start + after });
                self.pieces[number].dependents.push(later as u32);
                slot = after;
            }
            self.halos.extend_from_slice(&halo);
            self.pieces[number].halo = halo;
        }
        self.halo_starts.push(self.halos.len());
        let counts = self.pieces.iter().map(|piece| 1 + piece.incoming.len() as u32);
        self.pending = counts.map(Countdown::from).collect();
        rows + self.halos.len()
    }

    /// Adds the loads of all contacts to `loads`, which are zero at the start. When those on the rows of
    /// a piece are complete, and nobody uses these rows any more, `finish` is called with the number of
    /// the piece and its rows.
    pub(crate) fn sweep(
        &mut self,
        loads: Shared<'_, Load>,
        moving: Moving<'_>,
        walls: &[WallMotionNow],
        advance: &Advance,
        team: &Team,
        finish: impl Fn(usize, Range<usize>) + Sync,
    ) {
        let count = self.pieces.len();
        let pieces = Shared::new(&mut self.pieces);
        let (pending, halos, halo_starts) = (&self.pending, &self.halos, &self.halo_starts);
        let row_count = self.row_count;
        team.for_each_number(count, |number| {
            // SAFETY: nobody looks at a piece before it has counted down below.
            let Piece { rows, groups, phases, .. } = unsafe { pieces.get_mut(number) };
            let mut clock = Stopwatch::start(advance.timed);
            for (place, group) in groups.iter_mut().enumerate() {
                let ahead = if place == 0 {
                    // The largest group comes first, and the next piece is mostly the one behind this.
                    let next = halo_starts[number + 1]..halo_starts[(number + 2).min(count)];
                    Ahead { rows: rows.end..rows.end + rows.len(), halo: &halos[next] }
                } else {
                    Ahead::default()
                };
                // SAFETY: rows and places were listed for these columns and loads. `finish`, which writes
                // rows, is not called for rows of this piece or its halo before it has counted down.
                unsafe { sweep(group, loads, moving, walls, advance, ahead) };
                clock.lap(match group.partner {
                    Partner::Particle => &mut phases.pairs,
                    Partner::Wall(_) => &mut phases.walls,
                });
            }
            // SAFETY: from here on the piece is only read, until the next sweep.
            let piece = unsafe { pieces.get(number) };
            let dependents = piece.dependents.iter().map(|&dependent| dependent as usize);
            for ready in std::iter::once(number).chain(dependents) {
                if pending[ready].is_over() {
                    // SAFETY: the sweep over the piece and over all with a part in it is over; this
                    // thread alone has seen the end of the countdown.
                    unsafe { complete(pieces.get(ready), halos, loads, row_count) };
                    let rows = unsafe { pieces.get(ready) }.rows.clone();
                    finish(ready, rows);
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
        let halos = 2 * size_of_val(&self.halos[..]);
        self.groups().map(ContactGroup::memory_size).sum::<usize>() + halos
    }
}

/// Adds to the loads on the rows of a piece what earlier pieces' halos hold of them, and leaves zeros
/// there.
///
/// # Safety
/// All contacts of the piece and of those with a part in it have been computed, and no other thread
/// completes the same piece.
unsafe fn complete(piece: &Piece, halos: &[u32], loads: Shared<'_, Load>, rows: usize) {
    for Incoming { slots } in &piece.incoming {
        for slot in slots.clone() {
            // SAFETY: the caller's; a part of a halo belongs to the rows of one piece only.
            let (part, sum) = unsafe { (loads.get_mut(rows + slot), loads.get_mut(halos[slot] as usize)) };
            let part = std::mem::take(part);
            sum.force.vector += part.force.vector;
            sum.torque.vector += part.torque.vector;
        }
    }
}
