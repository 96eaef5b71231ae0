//! The contact loop: the same text for every law and instruction set.

use std::mem::MaybeUninit;
use std::ops::Range;

use pulvis_contact::{
    Composition, ContactEnergies, ContactResponse, NormalLaw, NormalLawVisitor, Pair, PairMotion, resistance,
};
use pulvis_math::{InstructionSet, Kernel, Mask, Octet, Quad, Row, Vector3};

use super::block::{ContactGroup, Partner, WIDTH, filled_lanes};
use super::layout::{Lane, Layout};
use crate::domain::Images;
use crate::particles::Load;
use crate::shared::Shared;

/// The columns that contacts read. See [`Particles`](crate::Particles) for what the quads hold.
#[derive(Clone, Copy)]
pub(crate) struct Moving<'a> {
    pub(crate) place: Shared<'a, Quad>,
    /// Velocities at mid-step, which moved the positions.
    pub(crate) velocity_mid: Shared<'a, Quad>,
    /// Velocities at the time of the positions.
    pub(crate) velocity: Shared<'a, Quad>,
    pub(crate) spin_mid: Shared<'a, Quad>,
    pub(crate) spin: Shared<'a, Quad>,
}

/// A plane wall at the time of the positions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallMotionNow {
    /// Unit normal, pointing to the particles.
    pub(crate) normal: Vector3,
    /// Place of the plane along its normal [m].
    pub(crate) offset: f64,
    /// Velocity at mid-step [m/s].
    pub(crate) velocity_mid: Vector3,
    /// Velocity at the time of the positions [m/s].
    pub(crate) velocity: Vector3,
}

/// What a sweep over a group's contacts adds up to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ContactTotals {
    /// Lane by lane.
    pub(crate) energies: ContactEnergies<Lane>,
    /// Sum of the forces on the first bodies [N].
    pub(crate) force: Vector3,
}

/// How far bodies have moved since the candidates were listed, over which step, and how the loop is to
/// run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Advance {
    /// By how much a gap can have closed at the most [m].
    pub(crate) closed: f64,
    /// The step that led to the present positions [s].
    pub(crate) time_step: f64,
    /// The nearest-image rule.
    pub(crate) images: Images,
    /// Whether times are taken.
    pub(crate) timed: bool,
    /// Whether energies are summed up.
    pub(crate) ledger: bool,
    /// What the processor can do.
    pub(crate) instructions: InstructionSet,
}

/// Computes a group's contacts, particle pairs or contacts with a wall, and adds their loads to `sums`.
///
/// # Safety
/// The group's rows lie within the columns of `moving`, its places of sums within `sums`, and nobody
/// writes those rows meanwhile.
pub(crate) unsafe fn sweep(
    group: &mut ContactGroup,
    sums: &mut [Load],
    moving: Moving<'_>,
    walls: &[WallMotionNow],
    advance: &Advance,
    ahead: Ahead<'_>,
) {
    let normal = group.model.normal;
    let partner = group.partner;
    let contacts = Loop { group, sums, moving, advance, ahead };
    match partner {
        Partner::Particle => normal.accept(PairSweep(contacts)),
        Partner::Wall(place) => normal.accept(WallSweep(contacts, walls[place])),
    }
}

/// What a loop works on.
struct Loop<'a> {
    group: &'a mut ContactGroup,
    sums: &'a mut [Load],
    moving: Moving<'a>,
    advance: &'a Advance,
    ahead: Ahead<'a>,
}

/// Rows that are likely to be needed next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ahead<'a> {
    /// One behind the other.
    pub(crate) rows: Range<usize>,
    /// Here and there.
    pub(crate) halo: &'a [u32],
}

impl Loop<'_> {
    /// Has the next `count` of the rows ahead brought near.
    #[inline(always)]
    fn look_ahead(moving: Moving<'_>, ahead: &mut Ahead<'_>, counts: [usize; 2]) {
        // Two quads in a cache line.
        let end = (ahead.rows.start + counts[0]).min(ahead.rows.end);
        for row in (ahead.rows.start..end).step_by(2) {
            moving.place.prefetch(row);
            moving.velocity_mid.prefetch(row);
            moving.velocity.prefetch(row);
            moving.spin_mid.prefetch(row);
        }
        ahead.rows.start = end;
        let (near, later) = ahead.halo.split_at(counts[1].min(ahead.halo.len()));
        for &row in near {
            moving.place.prefetch(row as usize);
            moving.velocity_mid.prefetch(row as usize);
            moving.velocity.prefetch(row as usize);
            moving.spin_mid.prefetch(row as usize);
        }
        ahead.halo = later;
    }
}

struct PairSweep<'a>(Loop<'a>);

impl NormalLawVisitor for PairSweep<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self(contacts) = self;
        let (level, advance) = (contacts.group.model.composition.resistance_level(), contacts.advance);
        let set = advance.instructions;
        match (level, advance.ledger) {
            (resistance::NONE, true) => set.run(PairLoop::<N, { resistance::NONE }, true> { law, contacts }),
            (resistance::NONE, false) => {
                set.run(PairLoop::<N, { resistance::NONE }, false> { law, contacts });
            }
            (resistance::SLIDING, true) => {
                set.run(PairLoop::<N, { resistance::SLIDING }, true> { law, contacts });
            }
            (resistance::SLIDING, false) => {
                set.run(PairLoop::<N, { resistance::SLIDING }, false> { law, contacts });
            }
            (_, true) => set.run(PairLoop::<N, { resistance::ALL }, true> { law, contacts }),
            (_, false) => set.run(PairLoop::<N, { resistance::ALL }, false> { law, contacts }),
        }
    }
}

/// The columns of eight rows.
///
/// # Safety
/// The rows lie within the column, and nobody writes them meanwhile.
#[inline(always)]
unsafe fn gather<R: Octet>(column: Shared<'_, Quad>, rows: &[u32; WIDTH]) -> (Vector3<R>, R) {
    // SAFETY: the caller's.
    let [x, y, z, scalar] = unsafe {
        R::columns([
            R::Row::load(column.get_at_number(rows[0])),
            R::Row::load(column.get_at_number(rows[1])),
            R::Row::load(column.get_at_number(rows[2])),
            R::Row::load(column.get_at_number(rows[3])),
            R::Row::load(column.get_at_number(rows[4])),
            R::Row::load(column.get_at_number(rows[5])),
            R::Row::load(column.get_at_number(rows[6])),
            R::Row::load(column.get_at_number(rows[7])),
        ])
    };
    (Vector3::new(x, y, z), scalar)
}

/// The rows of a vector; their scalars are zero.
#[inline(always)]
fn rows_of<R: Octet>(vector: Vector3<R>) -> [R::Row; WIDTH] {
    R::rows([vector.x, vector.y, vector.z, R::zero()])
}

/// Adds eight rows to the sums, one after the other: several lanes may have the same place.
macro_rules! add_rows {
    ($sums:expr, $places:expr, $part:ident, $sum:ident, $rows:expr) => {
        for lane in 0..WIDTH {
            // SAFETY: places lie within the sums, as the caller of `sweep` vouches.
            let slot = unsafe { &mut $sums.get_mut_at_number($places[lane]).$part };
            R::Row::load(slot).$sum($rows[lane]).store(slot);
        }
    };
}

/// Blocks that are gathered before any of them is computed, and computed before any of them is added
/// up. A block takes more instructions than a processor looks ahead; short loops one after the other
/// let it work on several blocks at a time, and need fewer registers.
const BATCH: usize = 4;

/// A block that has been gathered.
#[derive(Clone, Copy)]
struct Gathered<R> {
    block: usize,
    pair: Pair<R>,
    motion: PairMotion<R>,
}

/// A block that has been computed.
#[derive(Clone, Copy)]
struct Answered<R> {
    force: Vector3<R>,
    torque_i: Vector3<R>,
    torque_j: Vector3<R>,
}

struct PairLoop<'a, N, const RESISTANCE: u8, const LEDGER: bool> {
    law: N,
    contacts: Loop<'a>,
}

impl<N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool> Kernel for PairLoop<'_, N, RESISTANCE, LEDGER> {
    type Output = ();

    #[inline(always)]
    fn run<R: Octet>(self) {
        let Self { law, contacts: Loop { group, sums, moving, advance, mut ahead } } = self;
        let sums = Shared::new(sums);
        // By value: not to be read anew after every store.
        let (composition, layout, advance) = (group.model.composition, group.layout, *advance);
        let columns = layout.columns();
        let turning_dashpots = composition.has_resistance_dashpot();
        let reach = R::splat(-composition.noncontact.reach());
        let mut energies = ContactEnergies::<R>::default();
        let mut batch = [const { MaybeUninit::<Gathered<R>>::uninit() }; BATCH];
        let mut answers = [const { MaybeUninit::<Answered<R>>::uninit() }; BATCH];
        let blocks = group.first.len();
        let mut next = 0;
        let a_batch = |rows: usize| (rows * BATCH).div_ceil(blocks).next_multiple_of(2);
        let counts = [a_batch(ahead.rows.len()), a_batch(ahead.halo.len())];
        while next < blocks {
            Loop::look_ahead(moving, &mut ahead, counts);
            let mut count = 0;
            while next < blocks && count < BATCH {
                let block = next;
                next += 1;
                if group.gap[block] > advance.closed && !group.live[block] {
                    continue;
                }
                let (first, second) = (&group.first[block], &group.second[block]);
                // SAFETY (here and below): rows lie within the columns, as the caller of `sweep` vouches.
                let (centre_i, radius_i) = unsafe { gather::<R>(moving.place, first) };
                let (centre_j, radius_j) = unsafe { gather::<R>(moving.place, second) };
                let separation = advance.images.nearest(centre_i - centre_j);
                let distance = separation.norm();
                let overlap = radius_i + radius_j - distance;
                // Idle lanes are out of any reach.
                let filled = filled_lanes::<R>(group.filled(block));
                let overlap = R::select(filled, overlap, reach + reach - radius_i);
                let acts = overlap.gt(reach).any();
                if !acts && !group.live[block] {
                    continue;
                }
                group.live[block] = acts;
                let inverse_distance = R::one() / distance;
                let (mid_i, inverse_mass_i) = unsafe { gather::<R>(moving.velocity_mid, first) };
                let (mid_j, inverse_mass_j) = unsafe { gather::<R>(moving.velocity_mid, second) };
                let (velocity_i, inverse_radius_i) = unsafe { gather::<R>(moving.velocity, first) };
                let (velocity_j, inverse_radius_j) = unsafe { gather::<R>(moving.velocity, second) };
                let (mut spin_i_mid, mut spin_j_mid) = (Vector3::zero(), Vector3::zero());
                let (mut spin_i, mut spin_j) = (Vector3::zero(), Vector3::zero());
                if RESISTANCE != resistance::NONE {
                    spin_i_mid = unsafe { gather::<R>(moving.spin_mid, first) }.0;
                    spin_j_mid = unsafe { gather::<R>(moving.spin_mid, second) }.0;
                    if turning_dashpots {
                        spin_i = unsafe { gather::<R>(moving.spin, first) }.0;
                        spin_j = unsafe { gather::<R>(moving.spin, second) }.0;
                    }
                }
                batch[count].write(Gathered {
                    block,
                    pair: Pair::spheres_from_inverses(
                        inverse_mass_i,
                        inverse_mass_j,
                        inverse_radius_i,
                        inverse_radius_j,
                    ),
                    motion: PairMotion {
                        normal: separation * inverse_distance,
                        overlap,
                        inverse_distance,
                        radius_i,
                        radius_j,
                        velocity: velocity_i - velocity_j,
                        velocity_mid: mid_i - mid_j,
                        spin_i,
                        spin_j,
                        spin_i_mid,
                        spin_j_mid,
                    },
                });
                count += 1;
            }
            for place in 0..count {
                // SAFETY: the first `count` have been gathered.
                let gathered = unsafe { batch[place].assume_init_ref() };
                let block = gathered.block;
                let memory = &mut group.memory[block * columns..(block + 1) * columns];
                let answer = respond::<R, N, RESISTANCE>(
                    &law,
                    &composition,
                    &layout,
                    &gathered.pair,
                    &gathered.motion,
                    advance.time_step,
                    memory,
                );
                let ContactResponse { force, torque_i, torque_j, energies: now, .. } = answer;
                answers[place].write(Answered { force, torque_i, torque_j });
                if LEDGER {
                    energies += now;
                }
            }
            for place in 0..count {
                // SAFETY: the first `count` have been gathered and computed.
                let (gathered, answer) =
                    unsafe { (batch[place].assume_init_ref(), answers[place].assume_init_ref()) };
                let (first, second) = (&group.first_sum[gathered.block], &group.second_sum[gathered.block]);
                let force = rows_of::<R>(answer.force);
                add_rows!(sums, first, force, plus, force);
                add_rows!(sums, second, force, minus, force);
                if RESISTANCE != resistance::NONE {
                    let torque = rows_of::<R>(answer.torque_i);
                    add_rows!(sums, first, torque, plus, torque);
                    let torque = rows_of::<R>(answer.torque_j);
                    add_rows!(sums, second, torque, plus, torque);
                }
            }
        }
        group.totals = ContactTotals { energies: energies.to_lanes(), force: Vector3::zero() };
    }
}

struct WallSweep<'a>(Loop<'a>, WallMotionNow);

impl NormalLawVisitor for WallSweep<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self(contacts, wall) = self;
        contacts.advance.instructions.run(WallLoop { law, contacts, wall });
    }
}

/// Walls have few contacts: one loop for all resistances serves.
struct WallLoop<'a, N> {
    law: N,
    contacts: Loop<'a>,
    wall: WallMotionNow,
}

impl<N: NormalLaw> Kernel for WallLoop<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<R: Octet>(self) {
        let Self { law, contacts: Loop { group, sums, moving, advance, .. }, wall } = self;
        let sums = Shared::new(sums);
        let (composition, layout, advance) = (group.model.composition, group.layout, *advance);
        let columns = layout.columns();
        let reach = R::splat(-composition.noncontact.reach());
        let turning_dashpots = composition.has_resistance_dashpot();
        let normal = Vector3::<R>::splat(wall.normal);
        let wall_now = Vector3::<R>::splat(wall.velocity);
        let wall_mid = Vector3::<R>::splat(wall.velocity_mid);
        let mut energies = ContactEnergies::<R>::default();
        let mut total = Vector3::<R>::zero();
        for block in 0..group.first.len() {
            if group.gap[block] > advance.closed && !group.live[block] {
                continue;
            }
            let rows = &group.first[block];
            // SAFETY (here and below): rows lie within the columns, as the caller of `sweep` vouches.
            let (centre, radius) = unsafe { gather::<R>(moving.place, rows) };
            let overlap = radius - (centre.dot(normal) - R::splat(wall.offset));
            let valid = filled_lanes::<R>(group.filled(block));
            let overlap = R::select(valid, overlap, reach + reach - radius);
            let acts = overlap.gt(reach).any();
            if !acts && !group.live[block] {
                continue;
            }
            group.live[block] = acts;
            let (mid, inverse_mass) = unsafe { gather::<R>(moving.velocity_mid, rows) };
            let (velocity, inverse_radius) = unsafe { gather::<R>(moving.velocity, rows) };
            let spin_mid = unsafe { gather::<R>(moving.spin_mid, rows) }.0;
            let mut spin = Vector3::zero();
            if turning_dashpots {
                spin = unsafe { gather::<R>(moving.spin, rows) }.0;
            }
            let motion = PairMotion {
                normal,
                overlap,
                inverse_distance: R::zero(),
                radius_i: radius,
                radius_j: R::zero(),
                velocity: velocity - wall_now,
                velocity_mid: mid - wall_mid,
                spin_i: spin,
                spin_j: Vector3::zero(),
                spin_i_mid: spin_mid,
                spin_j_mid: Vector3::zero(),
            };
            let pair = Pair::wall_from_inverses(inverse_mass, inverse_radius);
            let memory = &mut group.memory[block * columns..(block + 1) * columns];
            let answer = respond::<R, N, { resistance::ALL }>(
                &law,
                &composition,
                &layout,
                &pair,
                &motion,
                advance.time_step,
                memory,
            );
            let force = rows_of::<R>(answer.force);
            let torque = rows_of::<R>(answer.torque_i);
            add_rows!(sums, group.first_sum[block], force, plus, force);
            add_rows!(sums, group.first_sum[block], torque, plus, torque);
            total += answer.force;
            energies += answer.energies;
        }
        let force = Vector3::new(total.x.sum_lanes(), total.y.sum_lanes(), total.z.sum_lanes());
        group.totals = ContactTotals { energies: energies.to_lanes(), force };
    }
}

/// One block: memory in, response, memory out.
#[inline(always)]
pub(crate) fn respond<R: Octet, N: NormalLaw, const RESISTANCE: u8>(
    law: &N,
    composition: &Composition,
    layout: &Layout,
    pair: &Pair<R>,
    motion: &PairMotion<R>,
    time_step: f64,
    columns: &mut [Lane],
) -> ContactResponse<R> {
    let mut memory = layout.load::<R, N::Memory<R>>(columns);
    let answer = composition.respond::<R, N, RESISTANCE>(law, pair, motion, time_step, &mut memory);
    layout.store(&memory, columns);
    answer
}
