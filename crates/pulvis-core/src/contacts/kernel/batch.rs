//! Blocks on their way through the loops: gathered, computed, added up.

use pulvis_contact::{Composition, ContactEnergies, NormalLaw, Pair, PairMotion, resistance};
use pulvis_math::{Octet, Quad, Row, Twin, Vector3};

use super::super::block::{Places, WIDTH};
use super::super::layout::{Lane, Layout};
use crate::particles::Load;
use crate::shared::Shared;

/// Blocks that are gathered before any of them is computed, and computed before any of them is added
/// up. A block takes more instructions than a processor looks ahead; short loops one after the other
/// let it work on several blocks at a time, and need fewer registers.
pub(super) const BATCH: usize = 2;

/// A block that has been gathered.
#[derive(Clone, Copy)]
pub(super) struct Gathered<R> {
    pub(super) block: usize,
    pub(super) pair: Pair<R>,
    pub(super) motion: PairMotion<R>,
}

/// A block that has been computed.
#[derive(Clone, Copy)]
struct Answered<R> {
    force: Vector3<R>,
    torque_i: Vector3<R>,
    torque_j: Vector3<R>,
}

/// What the blocks of a group are computed with.
pub(super) struct Response<N> {
    pub(super) law: N,
    pub(super) composition: Composition,
    pub(super) layout: Layout,
    /// The step that led to the present positions [s].
    pub(super) time_step: f64,
    /// Whether anything can be lost along the normal.
    pub(super) with_memory: bool,
    /// Whether what contacts hold is asked for, beside what they lose.
    pub(super) held: bool,
}

/// Adds eight loads to the sums, one after the other: several lanes may have the same place.
macro_rules! add_loads {
    ($sums:expr, $places:expr, $sum:ident, $loads:expr) => {
        for lane in 0..WIDTH {
            // SAFETY: places lie within the sums, as the caller vouches.
            let quads = unsafe { $sums.get_mut_at_number($places[lane]) }.quads_mut();
            R::Twin::load(quads).$sum($loads[lane]).store(quads);
        }
    };
}

/// The same for forces alone.
macro_rules! add_forces {
    ($sums:expr, $places:expr, $sum:ident, $forces:expr) => {
        for lane in 0..WIDTH {
            // SAFETY: places lie within the sums, as the caller vouches.
            let force = unsafe { &mut $sums.get_mut_at_number($places[lane]).force };
            R::Row::load(force).$sum($forces[lane]).store(force);
        }
    };
}

/// Some blocks.
pub(super) struct Batch<R> {
    gathered: [Gathered<R>; BATCH],
    answered: [Answered<R>; BATCH],
    count: usize,
}

impl<R: Octet> Batch<R> {
    /// No blocks yet.
    #[inline(always)]
    pub(super) fn new() -> Self {
        let (zero, none) = (R::zero(), Vector3::zero());
        let motion = PairMotion {
            normal: none,
            overlap: zero,
            inverse_distance: zero,
            radius_i: zero,
            radius_j: zero,
            velocity: none,
            velocity_mid: none,
            spin_i: none,
            spin_j: none,
            spin_i_mid: none,
            spin_j_mid: none,
        };
        let gathered = Gathered { block: 0, pair: Pair::from_sums(zero, zero), motion };
        let answered = Answered { force: none, torque_i: none, torque_j: none };
        Self { gathered: [gathered; BATCH], answered: [answered; BATCH], count: 0 }
    }

    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.count == BATCH
    }

    /// Room for one more block. What nobody fills in of any block stays zero: what a contact has no use for
    /// is not written again and again.
    #[inline(always)]
    pub(super) fn add(&mut self) -> &mut Gathered<R> {
        self.count += 1;
        &mut self.gathered[self.count - 1]
    }

    /// Computes all blocks, updates their `memory`, and adds their energies to `energies` if the ledger is
    /// kept.
    ///
    /// # Safety
    /// `memory` holds that of every block, as `response` lays it out.
    #[inline(always)]
    pub(super) unsafe fn respond<N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool>(
        &mut self,
        response: &Response<N>,
        memory: &mut [Lane],
        energies: &mut ContactEnergies<R>,
    ) {
        let columns = response.layout.columns();
        for place in 0..self.count {
            let gathered = &self.gathered[place];
            // SAFETY: the caller's.
            let memory =
                unsafe { memory.get_unchecked_mut(gathered.block * columns..(gathered.block + 1) * columns) };
            let mut before = response.layout.load::<R, N::Memory<R>, RESISTANCE>(memory);
            let answer = response.composition.respond::<R, N, RESISTANCE>(
                &response.law,
                &gathered.pair,
                &gathered.motion,
                response.time_step,
                &mut before,
            );
            response.layout.store::<R, N::Memory<R>, RESISTANCE>(&before, memory);
            self.answered[place] =
                Answered { force: answer.force, torque_i: answer.torque_i, torque_j: answer.torque_j };
            if LEDGER {
                energies.add_lost::<RESISTANCE>(&answer.energies, response.with_memory);
                // What is held is not even computed where nobody asks for it.
                if response.held {
                    energies.add_held(&answer.energies);
                }
            }
        }
    }

    /// How many blocks there are.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// A block, and the forces on its first bodies [N] once they have been computed.
    #[inline(always)]
    pub(super) fn force(&self, place: usize) -> (usize, Vector3<R>) {
        (self.gathered[place].block, self.answered[place].force)
    }

    /// Adds the loads to `sums`, at the `places` of each block; the batch is empty afterwards.
    ///
    /// # Safety
    /// Every block has its places, and they lie within the sums.
    #[inline(always)]
    pub(super) unsafe fn add_up<const RESISTANCE: u8, const PAIRS: bool>(
        &mut self,
        places: &[Places],
        sums: Shared<'_, Load>,
    ) {
        for place in 0..self.count {
            let (block, answer) = (self.gathered[place].block, &self.answered[place]);
            // SAFETY: the caller's.
            let [first, second] = unsafe { &places.get_unchecked(block).0 };
            if RESISTANCE == resistance::NONE {
                let forces = R::rows(columns_of(answer.force));
                add_forces!(sums, first, plus, forces);
                if PAIRS {
                    add_forces!(sums, second, minus, forces);
                }
                continue;
            }
            let loads = R::twins(columns_of(answer.force), columns_of(answer.torque_i));
            add_loads!(sums, first, plus, loads);
            if PAIRS {
                let loads = R::twins(columns_of(answer.force), columns_of(answer.torque_j));
                add_loads!(sums, second, minus_plus, loads);
            }
        }
        self.count = 0;
    }
}

/// The columns of eight rows.
///
/// # Safety
/// The rows lie within the column, and nobody writes them meanwhile.
#[inline(always)]
pub(super) unsafe fn gather<R: Octet>(column: Shared<'_, Quad>, rows: &[u32; WIDTH]) -> (Vector3<R>, R) {
    // SAFETY: the caller's.
    let [x, y, z, scalar] = R::columns(unsafe { load::<R>(column, rows) });
    (Vector3::new(x, y, z), scalar)
}

/// The vectors of eight rows less those of eight others, and the sums of the scalars.
///
/// # Safety
/// The rows lie within the column, and nobody writes them meanwhile.
#[inline(always)]
pub(super) unsafe fn gather_apart<R: Octet>(
    column: Shared<'_, Quad>,
    [ones, others]: &[[u32; WIDTH]; 2],
) -> (Vector3<R>, R) {
    // SAFETY: the caller's.
    let [x, y, z, scalar] = unsafe { R::apart(load::<R>(column, ones), load::<R>(column, others)) };
    (Vector3::new(x, y, z), scalar)
}

/// Eight rows.
///
/// # Safety
/// The rows lie within the column, and nobody writes them meanwhile.
#[inline(always)]
unsafe fn load<R: Octet>(column: Shared<'_, Quad>, rows: &[u32; WIDTH]) -> [R::Row; WIDTH] {
    // SAFETY: the caller's.
    unsafe {
        [
            R::Row::load(column.get_at_number(rows[0])),
            R::Row::load(column.get_at_number(rows[1])),
            R::Row::load(column.get_at_number(rows[2])),
            R::Row::load(column.get_at_number(rows[3])),
            R::Row::load(column.get_at_number(rows[4])),
            R::Row::load(column.get_at_number(rows[5])),
            R::Row::load(column.get_at_number(rows[6])),
            R::Row::load(column.get_at_number(rows[7])),
        ]
    }
}

/// The columns of a vector; the scalars are zero.
#[inline(always)]
fn columns_of<R: Octet>(vector: Vector3<R>) -> [R; 4] {
    [vector.x, vector.y, vector.z, R::zero()]
}
