//! All candidate contacts: listed anew when bodies have moved, and swept every step.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};

use pulvis_contact::ContactEnergies;
use pulvis_math::{InstructionSet, Lanes, Vector3};

use super::Interactions;
use super::block::{ContactGroup, Partner};
use super::kernel::{self, Advance, Ahead, Moving, WallMotionNow};
use super::leftovers::Leftovers;
use super::piece::{Closed, Incoming, Piece, cut};
use super::rebuild::MemoryStore;
use crate::domain::Images;
use crate::neighbours::{CellGrid, Moved};
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
    /// Scratch: the sums of the piece that each member of the team works on.
    sums: Vec<Vec<Load>>,
    leftovers: Leftovers,
}

/// Pieces whose contacts are still to be computed before the loads on a piece are complete.
#[derive(Debug, Default)]
struct Countdown {
    left: AtomicU32,
    start: u32,
    /// The member of the team that has computed the piece's own contacts.
    member: AtomicUsize,
}

impl Clone for Countdown {
    fn clone(&self) -> Self {
        Self::from(self.start)
    }
}

impl Countdown {
    fn from(start: u32) -> Self {
        Self { left: AtomicU32::new(start), start, ..Self::default() }
    }

    /// Whether this was the last one; the countdown then begins anew.
    fn is_over(&self) -> bool {
        // What others wrote before they counted down is seen by the last one.
        let over = self.left.fetch_sub(1, Ordering::AcqRel) == 1;
        if over {
            self.begin_anew();
        }
        over
    }

    /// Whether only the piece itself has still to count down; then nobody else will.
    fn has_one_left(&self) -> bool {
        self.left.load(Ordering::Acquire) == 1
    }

    fn begin_anew(&self) {
        self.left.store(self.start, Ordering::Relaxed);
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

/// What a sweep over all contacts works on.
#[derive(Clone, Copy)]
pub(crate) struct Sweep<'a> {
    /// Room for loads that are not complete at once: for all rows, and for all halos behind them.
    pub(crate) loads: Shared<'a, Load>,
    pub(crate) moving: Moving<'a>,
    pub(crate) walls: &'a [WallMotionNow],
    pub(crate) advance: &'a Advance,
    /// Whether `loads` are to hold those on all rows at the end, as they were finished.
    pub(crate) keep: bool,
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

    /// Takes in how far the rows of every piece, and walls, have moved since the candidates were listed [m].
    pub(crate) fn close_gaps(&mut self, moved: impl Fn(usize) -> Moved, walls: f64) {
        for (number, piece) in self.pieces.iter_mut().enumerate() {
            let own = moved(number);
            let others = piece.dependents.iter().map(|&other| moved(other as usize).longest);
            piece.closed =
                Closed { pairs: own.longest + others.fold(own.second, f64::max), walls: own.longest + walls };
        }
    }

    /// Computes the loads of all contacts. When those on the rows of a piece are complete, and nobody
    /// uses these rows any more, `finish` is called with the number of the piece, its rows and the loads.
    pub(crate) fn sweep(
        &mut self,
        sweep: &Sweep<'_>,
        team: &Team,
        finish: impl Fn(usize, Range<usize>, &mut [Load]) + Sync,
    ) {
        let Sweep { loads, moving, walls, advance, keep } = *sweep;
        let count = self.pieces.len();
        self.sums.resize_with(team.threads(), Vec::new);
        self.leftovers.clear(team.threads(), count);
        let (pieces, scratch) = (Shared::new(&mut self.pieces), Shared::new(&mut self.sums));
        let leftovers = &self.leftovers;
        let (pending, row_count) = (&self.pending, self.row_count);
        let halos = Halos { rows: &self.halos, starts: &self.halo_starts };
        let finish_stored = |number: usize| {
            // SAFETY: all pieces with a part in this one have counted down, and this thread alone has seen
            // the end of the countdown, or taken the piece from those that were left.
            unsafe {
                let piece = pieces.get(number);
                let own = loads.range_mut(piece.rows.clone());
                complete(piece, own, halos.rows, loads, row_count);
                finish(number, piece.rows.clone(), own);
            }
        };
        let count_down = |member: usize, number: usize| {
            if pending[number].is_over() {
                let owner = pending[number].member.load(Ordering::Relaxed);
                if owner == member {
                    leftovers.count_finished();
                    finish_stored(number);
                } else {
                    leftovers.leave(owner, number);
                }
            }
        };
        let compute = |member: usize, number: usize| {
            // SAFETY: every member has sums of its own.
            let sums = unsafe { scratch.get_mut(member) };
            // SAFETY: nobody looks at a piece before it has counted down below.
            let Piece { rows, groups, phases, closed, .. } = unsafe { pieces.get_mut(number) };
            sums.clear();
            sums.resize(rows.len() + halos.of(number).len(), Load::default());
            let mut clock = Stopwatch::start(advance.timed);
            for (place, group) in groups.iter_mut().enumerate() {
                // The largest group comes first, and the next piece is mostly the one behind this.
                let ahead = match place {
                    0 => Ahead { rows: rows.end..rows.end + rows.len(), halo: halos.of(number + 1) },
                    _ => Ahead::default(),
                };
                // SAFETY: rows and places were listed for these columns and sums. `finish`, which writes
                // rows, is not called for rows of this piece or its halo before it has counted down.
                unsafe { kernel::sweep(group, sums, moving, walls, advance, *closed, ahead) };
                clock.lap(match group.partner {
                    Partner::Particle => &mut phases.pairs,
                    Partner::Wall => &mut phases.walls,
                });
            }
            let rows = rows.clone();
            let (own, halo) = sums.split_at_mut(rows.len());
            let start = row_count + halos.starts[number];
            // SAFETY: only this piece writes these places; they are read after it has counted down.
            unsafe { loads.range_mut(start..start + halo.len()) }.copy_from_slice(halo);
            // SAFETY: from here on the piece is only read, until the next sweep.
            let piece = unsafe { pieces.get(number) };
            if pending[number].has_one_left() {
                pending[number].begin_anew();
                // SAFETY (here and below): all pieces with a part in this one have counted down, and this
                // thread alone has seen the end of the countdown.
                unsafe { complete(piece, own, halos.rows, loads, row_count) };
                finish(number, rows.clone(), own);
                if keep {
                    // SAFETY: the loads of these rows, which this thread alone has finished.
                    unsafe { loads.range_mut(rows) }.copy_from_slice(own);
                }
                leftovers.count_finished();
            } else {
                // SAFETY: the sums of these rows, which are not complete.
                unsafe { loads.range_mut(rows) }.copy_from_slice(own);
                pending[number].member.store(member, Ordering::Relaxed);
                count_down(member, number);
            }
            for &later in &piece.dependents {
                count_down(member, later as usize);
            }
        };
        team.for_each_number_in_turns(count, compute, |member, turn| {
            while let Some(number) = leftovers.take(member, turn) {
                finish_stored(number);
            }
        });
    }

    /// The sum of all contacts' energies, group by group: the same for any number of threads.
    pub(crate) fn energies(&self) -> ContactEnergies {
        let mut sum = ContactEnergies::<Lanes<8>>::default();
        for group in self.groups() {
            sum += group.energies;
        }
        sum.sum_lanes()
    }

    /// Adds the force of every wall on the particles to its place in `forces`.
    pub(crate) fn add_wall_forces(&self, forces: &mut [Vector3]) {
        for group in self.groups() {
            for (sum, &force) in forces.iter_mut().zip(&group.wall_forces) {
                *sum += force;
            }
        }
    }

    /// Number of candidate contacts.
    pub(crate) fn candidates(&self) -> usize {
        self.groups().map(ContactGroup::len).sum()
    }

    /// Memory of the whole table [byte].
    pub(crate) fn memory_size(&self) -> usize {
        let sums: usize = self.sums.iter().map(|sums| size_of_val(&sums[..])).sum();
        let halos = 2 * size_of_val(&self.halos[..]) + sums;
        self.groups().map(ContactGroup::memory_size).sum::<usize>() + halos
    }
}

/// The halos of all pieces.
#[derive(Clone, Copy)]
struct Halos<'a> {
    rows: &'a [u32],
    starts: &'a [usize],
}

impl<'a> Halos<'a> {
    /// The halo of a piece; none behind the last piece.
    fn of(self, number: usize) -> &'a [u32] {
        match self.starts.get(number..number + 2) {
            Some(&[start, end]) => &self.rows[start..end],
            _ => &[],
        }
    }
}

/// Adds to the loads on the rows of a piece what earlier pieces' halos hold of them, in their order.
///
/// # Safety
/// All contacts of the piece and of those with a part in it have been computed.
unsafe fn complete(
    piece: &Piece,
    own: &mut [Load],
    halos: &[u32],
    loads: Shared<'_, Load>,
    row_count: usize,
) {
    for Incoming { slots } in &piece.incoming {
        for slot in slots.clone() {
            // SAFETY: the caller's; places of halos lie behind those of all rows.
            let part = unsafe { loads.get(row_count + slot) };
            let sum = &mut own[halos[slot] as usize - piece.rows.start];
            sum.force.vector += part.force.vector;
            sum.torque.vector += part.torque.vector;
        }
    }
}
