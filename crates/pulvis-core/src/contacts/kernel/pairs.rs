//! Contacts between particles.

use pulvis_boundary::Images;
use pulvis_contact::friction::CommonFriction;
use pulvis_contact::normal::{CommonLawVisitor, Inlined, NormalSource};
use pulvis_contact::{NormalLaw, levels};
use pulvis_math::{Kernel, Mask, Simd8};

use super::super::block::{ContactGroup, occupied_lanes};
use super::batch::{BATCH, Batch, BlockSums, Response, gather, gather_apart};
use super::normal::{NormalCall, Pointed};
use super::{Flow, KinematicColumns, Loop, finish, response, step_middle, wants};
use crate::particles::ForceTorque;
use crate::shared::Shared;

/// Runs the loop over a group: for a common contact the loop that is compiled for its normal law, otherwise the loop that
/// calls laws through pointers.
///
/// # Safety
/// As of [`sweep`](super::sweep).
pub(super) unsafe fn sweep(contacts: Loop<'_>) {
    let model = &contacts.group.model;
    // In a flow, only the loops that call laws through pointers are compiled: a loop takes seconds.
    if model.is_common() && !contacts.advance.pointers && contacts.advance.flow.is_none() {
        let normal = model.normal;
        // A common contact has a common law.
        let _ = normal.accept_common(CommonPairs(contacts));
        return;
    }
    run_pointed(contacts);
}

/// Runs the loop that calls laws through pointers.
fn run_pointed(contacts: Loop<'_>) {
    match contacts.advance.flow {
        None => run_level::<false>(contacts),
        Some(_) => run_level::<true>(contacts),
    }
}

fn run_level<const FLOW: bool>(contacts: Loop<'_>) {
    let model = &contacts.group.model;
    let set = contacts.advance.instructions;
    match model.laws.resistance_level() {
        levels::NONE => set.run(PointedPairs::<{ levels::NONE }, FLOW>(contacts)),
        levels::SLIDING => set.run(PointedPairs::<{ levels::SLIDING }, FLOW>(contacts)),
        _ => set.run(PointedPairs::<{ levels::ALL }, FLOW>(contacts)),
    }
}

/// The loop over common contacts, with the type of their law.
struct CommonPairs<'a>(Loop<'a>);

impl CommonLawVisitor for CommonPairs<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self(contacts) = self;
        let (level, ledger) = (contacts.group.model.laws.resistance_level(), contacts.advance.ledger);
        let set = contacts.advance.instructions;
        // Loops cost seconds of compilation each: laws with a law against sliding of their own have only those that most
        // of their contacts take, and these keep the ledger or not at run time.
        let ledger = ledger || !const { every_loop::<N>() };
        match (level, ledger) {
            (levels::NONE, true) => set.run(InlinedPairs::<N, { levels::NONE }, true> { law, contacts }),
            (levels::NONE, false) if const { every_loop::<N>() } => {
                set.run(InlinedPairs::<N, { levels::NONE }, false> { law, contacts });
            }
            (levels::SLIDING, true) => {
                set.run(InlinedPairs::<N, { levels::SLIDING }, true> { law, contacts });
            }
            (levels::SLIDING, false) if const { every_loop::<N>() } => {
                set.run(InlinedPairs::<N, { levels::SLIDING }, false> { law, contacts });
            }
            (_, true) if const { every_loop::<N>() } => {
                set.run(InlinedPairs::<N, { levels::ALL }, true> { law, contacts });
            }
            (_, false) if const { every_loop::<N>() } => {
                set.run(InlinedPairs::<N, { levels::ALL }, false> { law, contacts });
            }
            _ => run_pointed(contacts),
        }
    }
}

/// Whether a common law has loops for every level of resistance, with and without the ledger.
const fn every_loop<N: NormalLaw>() -> bool {
    matches!(N::COMMON_SLIDING, CommonFriction::SpringSlider)
}

struct InlinedPairs<'a, N, const RESISTANCE: u8, const LEDGER: bool> {
    law: N,
    contacts: Loop<'a>,
}

impl<N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool> Kernel
    for InlinedPairs<'_, N, RESISTANCE, LEDGER>
{
    type Output = ();

    #[inline(always)]
    fn run<R: Simd8>(self) {
        let ledger = const { every_loop::<N>() } || self.contacts.advance.ledger;
        let response = response(Inlined(self.law), self.contacts.group, self.contacts.advance, ledger);
        // SAFETY: as the caller of `sweep` vouches.
        unsafe { sweep_pairs::<R, _, RESISTANCE, LEDGER, false>(response, self.contacts) };
    }
}

/// The loop over contacts whose normal law is called through a pointer.
struct PointedPairs<'a, const RESISTANCE: u8, const FLOW: bool>(Loop<'a>);

impl<const RESISTANCE: u8, const FLOW: bool> Kernel for PointedPairs<'_, RESISTANCE, FLOW> {
    type Output = ();

    #[inline(always)]
    fn run<R: Simd8>(self) {
        let Self(contacts) = self;
        let (group, advance) = (&*contacts.group, contacts.advance);
        let (model, slots) = (group.model, group.layout.slots());
        let call = Pointed::<R, false>::new(&model, slots, step_middle(advance), wants(group, advance));
        let response = response(call, group, advance, advance.ledger);
        // SAFETY: as the caller of `sweep` vouches.
        unsafe { sweep_pairs::<R, _, RESISTANCE, true, FLOW>(response, contacts) };
    }
}

/// The loop: gathers blocks of eight, computes them and adds up their forces, one batch at a time.
///
/// # Safety
/// As of [`sweep`](super::sweep).
#[inline(always)]
unsafe fn sweep_pairs<
    R: Simd8,
    C: NormalCall<R>,
    const RESISTANCE: u8,
    const LEDGER: bool,
    const FLOW: bool,
>(
    mut response: Response<C>,
    contacts: Loop<'_>,
) {
    let Loop { group, sums, moving, advance, approach, mut prefetch } = contacts;
    let sums = Shared::new(sums);
    // By value, as far as every block needs it: otherwise the compiler reads it again after every store.
    let gathering = Gathering {
        moving,
        images: advance.images,
        flow: advance.flow.as_ref(),
        approach,
        range: group.interaction_range,
        turning_dashpots: group.model.laws.has_resistance_dashpot(),
    };
    // Common contacts read none.
    let reads = <C::Source<'_> as NormalSource<R>>::COMMON.is_none() && group.reads_quantities();
    let mut totals = BlockSums::<R>::new();
    let mut batch = Batch::<R>::new();
    let blocks = group.rows.len();
    let mut next = 0;
    let expected = if group.batches > 0 { group.batches } else { blocks.div_ceil(BATCH) };
    let counts = prefetch.in_rounds(expected);
    group.batches = 0;
    while next < blocks {
        prefetch.make_ready(moving, counts);
        group.batches += 1;
        while next < blocks && !batch.is_full() {
            // SAFETY: `next` is a block of the group; the rest as the caller vouches.
            unsafe { gathering.gather::<R, RESISTANCE, FLOW>(group, next, &mut batch) };
            if reads && let Some(index) = batch.index_of_last(next) {
                response.call.gather_quantities(index, group, moving.quantities, next);
            }
            next += 1;
        }
        // SAFETY: every block has its memory and its slots of sums; the rest as the caller vouches.
        unsafe {
            batch.respond::<C, RESISTANCE, LEDGER>(&mut response, &mut group.memory, &mut totals);
            batch.add_up::<RESISTANCE, true>(&group.sums, sums);
        }
    }
    prefetch.sums.fill(ForceTorque::default());
    finish(group, &totals);
}

/// The inputs of gathering a block.
#[derive(Clone, Copy)]
struct Gathering<'a> {
    moving: KinematicColumns<'a>,
    images: Images,
    /// The flow of the cell, if there is one.
    flow: Option<&'a Flow>,
    approach: f64,
    /// How far beyond touching the contacts act [m].
    range: f64,
    turning_dashpots: bool,
}

impl Gathering<'_> {
    /// Gathers a block into the batch, unless none of its contacts acts or acted in the last step.
    ///
    /// 1. Skip the block if its smallest gap cannot have closed and it did not act in the last step.
    /// 2. Load positions and compute overlaps.
    /// 3. Skip the block if no contact acts and none acted in the last step.
    /// 4. Load velocities, and angular velocities where resistances need them.
    ///
    /// # Safety
    /// `block` is one of the group's, whose rows lie within the columns; nobody writes those meanwhile.
    #[inline(always)]
    unsafe fn gather<R: Simd8, const RESISTANCE: u8, const FLOW: bool>(
        self,
        group: &mut ContactGroup,
        block: usize,
        batch: &mut Batch<R>,
    ) {
        let Self { moving, images, flow, approach, range, turning_dashpots } = self;
        // SAFETY (here and below): every block has its gap, its flags and its rows.
        let active = unsafe { group.active.get_unchecked_mut(block) };
        if unsafe { *group.gap.get_unchecked(block) } > approach && !*active {
            return;
        }
        let rows = unsafe { &group.rows.get_unchecked(block).0 };
        let [first, second] = rows;
        // SAFETY (here and below): the rows lie within the columns.
        let (centre_i, radius_i) = unsafe { gather::<R>(moving.position, first) };
        let (centre_j, radius_j) = unsafe { gather::<R>(moving.position, second) };
        let mut separation = centre_i - centre_j;
        if unsafe { *group.crosses_boundary.get_unchecked(block) } {
            separation = images.nearest(separation);
        }
        let distance = separation.norm();
        let overlap = radius_i + radius_j - distance;
        // Idle lanes get an overlap outside the interaction range.
        let occupied = occupied_lanes::<R>(unsafe { *group.occupancy.get_unchecked(block) });
        let end = R::splat(-range);
        let overlap = R::select(occupied, overlap, end + end - radius_i);
        let acts = overlap.gt(end).any();
        if !acts && !*active {
            return;
        }
        *active = acts;
        let inverse_distance = R::one() / distance;
        let (velocity_mid, inverse_mass) = unsafe { gather_apart::<R>(moving.velocity_mid, rows) };
        let (velocity, inverse_radius_sum) = unsafe { gather_apart::<R>(moving.velocity, rows) };
        let gathered = batch.add();
        gathered.block = block;
        (gathered.inverse_mass, gathered.inverse_radius) = (inverse_mass, inverse_radius_sum);
        let motion = &mut gathered.motion;
        motion.normal = separation * inverse_distance;
        (motion.overlap, motion.inverse_distance) = (overlap, inverse_distance);
        (motion.radius_i, motion.radius_j) = (radius_i, radius_j);
        (motion.velocity, motion.velocity_mid) = (velocity, velocity_mid);
        if FLOW && let Some(flow) = flow {
            motion.velocity += flow.end.times(separation);
            motion.velocity_mid += flow.mid.times(separation);
        }
        if RESISTANCE != levels::NONE {
            motion.angular_velocity_i_mid = unsafe { gather::<R>(moving.angular_velocity_mid, first) }.0;
            motion.angular_velocity_j_mid = unsafe { gather::<R>(moving.angular_velocity_mid, second) }.0;
            if turning_dashpots {
                motion.angular_velocity_i = unsafe { gather::<R>(moving.angular_velocity, first) }.0;
                motion.angular_velocity_j = unsafe { gather::<R>(moving.angular_velocity, second) }.0;
            }
        }
    }
}
