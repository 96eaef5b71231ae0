//! One sweep over all contacts: piece by piece, each finished when its loads are complete.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};

use super::block::Partner;
use super::kernel::{self, Advance, Ahead, Moving, WallMotionNow};
use super::leftovers::Leftovers;
use super::piece::{Incoming, Piece};
use crate::particles::Load;
use crate::phases::Stopwatch;
use crate::shared::Shared;

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

/// Pieces whose contacts are still to be computed before the loads on a piece are complete.
#[derive(Debug, Default)]
pub(super) struct Countdown {
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
    pub(super) fn from(start: u32) -> Self {
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

/// The halos of all pieces.
#[derive(Clone, Copy)]
pub(super) struct Halos<'a> {
    /// One behind the other.
    pub(super) rows: &'a [u32],
    /// Where the halo of each piece begins, and the end.
    pub(super) starts: &'a [usize],
    /// Number of all rows: the sums of halos stand behind theirs.
    pub(super) row_count: usize,
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

/// Where a member of the team adds up the loads of one piece after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    present: Vec<Load>,
    /// Those of the next piece: the first `cleared` of them are zero.
    next: Vec<Load>,
    cleared: usize,
}

impl Sums {
    /// So many sums, all zero, for the present piece, and as many as the next one is likely to need, which
    /// somebody `clears` on the way: all at once, the processor would wait for its caches.
    fn turn(&mut self, [count, next_count]: [usize; 2], clears: bool) -> (&mut [Load], &mut [Load]) {
        std::mem::swap(&mut self.present, &mut self.next);
        if self.present.len() < count {
            self.present.resize(count, Load::default());
        }
        let (_, left) = self.present[..count].split_at_mut(self.cleared.min(count));
        left.fill(Load::default());
        if self.next.len() < next_count {
            self.next.resize(next_count, Load::default());
        }
        self.cleared = if clears { next_count } else { 0 };
        (&mut self.present[..count], &mut self.next[..next_count])
    }

    /// Memory [byte].
    pub(super) fn memory_size(&self) -> usize {
        size_of_val(&self.present[..]) + size_of_val(&self.next[..])
    }
}

/// A sweep on its way; see [`Sweep`].
pub(super) struct Sweeping<'a, F> {
    pub(super) sweep: Sweep<'a>,
    pub(super) pieces: Shared<'a, Piece>,
    /// One for each member of the team.
    pub(super) sums: Shared<'a, Sums>,
    pub(super) pending: &'a [Countdown],
    pub(super) leftovers: &'a Leftovers,
    pub(super) halos: Halos<'a>,
    /// Told the number of a piece, its rows and the complete loads on them.
    pub(super) finish: F,
}

impl<F: Fn(usize, Range<usize>, &mut [Load])> Sweeping<'_, F> {
    /// Computes the contacts of a piece, and finishes what is complete with it.
    ///
    /// # Safety
    /// No other thread works as this `member`, and none computes this piece.
    pub(super) unsafe fn compute(&self, member: usize, number: usize) {
        let Sweep { loads, keep, .. } = self.sweep;
        let pending = &self.pending[number];
        // SAFETY: the caller's; nobody looks at a piece before it has counted down below.
        let (sums, piece) = unsafe { (self.sums.get_mut(member), self.pieces.get_mut(number)) };
        let sums = self.sum_contacts(number, piece, sums);
        // From here on the piece is only read, until the next sweep.
        let (piece, rows) = (&*piece, piece.rows.clone());
        let (own, halo) = sums.split_at_mut(rows.len());
        let start = self.halos.row_count + self.halos.starts[number];
        // SAFETY: only this piece writes these places; they are read after it has counted down.
        unsafe { loads.range_mut(start..start + halo.len()) }.copy_from_slice(halo);
        if pending.has_one_left() {
            pending.begin_anew();
            // SAFETY (here and below): all pieces with a part in this one have counted down, and this
            // thread alone has seen the end of the countdown.
            unsafe { self.complete(piece, own) };
            (self.finish)(number, rows.clone(), own);
            if keep {
                // SAFETY: the loads of these rows, which this thread alone has finished.
                unsafe { loads.range_mut(rows) }.copy_from_slice(own);
            }
            self.leftovers.count_finished();
        } else {
            // SAFETY: the sums of these rows, which are not complete.
            unsafe { loads.range_mut(rows) }.copy_from_slice(own);
            pending.member.store(member, Ordering::Relaxed);
            self.count_down(member, number);
        }
        for &later in &piece.dependents {
            self.count_down(member, later as usize);
        }
    }

    /// Adds up the loads of a piece's contacts: those on its rows, then those on its halo.
    fn sum_contacts<'b>(&self, number: usize, piece: &mut Piece, sums: &'b mut Sums) -> &'b mut [Load] {
        let Sweep { moving, walls, advance, .. } = self.sweep;
        let Piece { rows, groups, phases, closed, .. } = piece;
        // The largest group comes first, and the next piece is mostly the one behind this.
        let next_halo = self.halos.of(number + 1);
        let counts = [rows.len() + self.halos.of(number).len(), rows.len() + next_halo.len()];
        let pairs_come_first = groups.first().is_some_and(|group| group.partner == Partner::Particle);
        let (sums, next_sums) = sums.turn(counts, pairs_come_first);
        let mut ahead = Ahead { rows: rows.end..rows.end + rows.len(), halo: next_halo, sums: next_sums };
        let mut clock = Stopwatch::start(advance.timed);
        for group in groups {
            let ahead = std::mem::take(&mut ahead);
            // SAFETY: rows and places were listed for these columns and sums. `finish`, which writes rows, is
            // not called for rows of this piece or its halo before it has counted down.
            unsafe { kernel::sweep(group, sums, moving, walls, advance, *closed, ahead) };
            clock.lap(match group.partner {
                Partner::Particle => &mut phases.pairs,
                Partner::Wall => &mut phases.walls,
            });
        }
        sums
    }

    /// Counts a piece with a part in another one. Who does the last of them finishes the other at once if it has
    /// computed its contacts too.
    fn count_down(&self, member: usize, number: usize) {
        let pending = &self.pending[number];
        if pending.is_over() {
            let owner = pending.member.load(Ordering::Relaxed);
            if owner == member {
                self.leftovers.count_finished();
                // SAFETY: this thread alone has seen the end of the countdown.
                unsafe { self.finish_stored(number) };
            } else {
                self.leftovers.leave(owner, number);
            }
        }
    }

    /// Finishes a piece whose sums stand in the loads of its rows.
    ///
    /// # Safety
    /// All pieces with a part in this one have counted down, and no other thread finishes it.
    pub(super) unsafe fn finish_stored(&self, number: usize) {
        // SAFETY: the caller's.
        unsafe {
            let piece = self.pieces.get(number);
            let own = self.sweep.loads.range_mut(piece.rows.clone());
            self.complete(piece, own);
            (self.finish)(number, piece.rows.clone(), own);
        }
    }

    /// Adds to the loads on the rows of a piece what earlier pieces' halos hold of them, in their order.
    ///
    /// # Safety
    /// All contacts of the piece and of those with a part in it have been computed.
    unsafe fn complete(&self, piece: &Piece, own: &mut [Load]) {
        let Halos { rows, row_count, .. } = self.halos;
        for Incoming { slots } in &piece.incoming {
            for slot in slots.clone() {
                // SAFETY: the caller's; places of halos lie behind those of all rows.
                let part = unsafe { self.sweep.loads.get(row_count + slot) };
                let sum = &mut own[rows[slot] as usize - piece.rows.start];
                sum.force.vector += part.force.vector;
                sum.torque.vector += part.torque.vector;
            }
        }
    }
}
