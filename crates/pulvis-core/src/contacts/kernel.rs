//! The contact loop: the same text for every law and instruction set.

use multiversion::multiversion;
use pulvis_contact::{
    Composition, ContactEnergies, ContactResponse, NormalLaw, NormalLawVisitor, Pair, PairMotion, resistance,
};
use pulvis_math::{Mask, Real, Vector3};

use super::block::{ContactGroup, Partner, WIDTH, filled_lanes};
use super::layout::{Lane, Layout};
use crate::domain::Images;

/// The columns that contacts read.
#[derive(Clone, Copy)]
pub(crate) struct Moving<'a> {
    pub(crate) radius: &'a [f64],
    pub(crate) mass: &'a [f64],
    pub(crate) position: &'a [Vector3],
    /// Velocities at mid-step, which moved the positions.
    pub(crate) velocity_mid: &'a [Vector3],
    /// Velocities at the time of the positions.
    pub(crate) velocity: &'a [Vector3],
    pub(crate) spin_mid: &'a [Vector3],
    pub(crate) spin: &'a [Vector3],
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
    pub(crate) energies: ContactEnergies,
    /// Sum of the forces on the first bodies [N].
    pub(crate) force: Vector3,
}

/// One number of each of eight rows.
#[inline(always)]
fn gather(column: &[f64], rows: &[u32; WIDTH]) -> Lane {
    let mut lanes = [0.0; WIDTH];
    for lane in 0..WIDTH {
        lanes[lane] = column[rows[lane] as usize];
    }
    Lane::from(lanes)
}

/// One vector of each of eight rows.
#[inline(always)]
fn gather3(column: &[Vector3], rows: &[u32; WIDTH]) -> Vector3<Lane> {
    let (mut x, mut y, mut z) = ([0.0; WIDTH], [0.0; WIDTH], [0.0; WIDTH]);
    for lane in 0..WIDTH {
        let vector = column[rows[lane] as usize];
        x[lane] = vector.x;
        y[lane] = vector.y;
        z[lane] = vector.z;
    }
    Vector3::new(Lane::from(x), Lane::from(y), Lane::from(z))
}

/// How far bodies have moved since the candidates were listed, and over which step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Advance {
    /// By how much a gap can have closed at the most [m].
    pub(crate) closed: f64,
    /// The step that led to the present positions [s].
    pub(crate) time_step: f64,
}

/// Computes the forces of a group's contacts, particle pairs or contacts with a wall; they are left in
/// the group, with what they add up to.
pub(crate) fn sweep(
    group: &mut ContactGroup,
    moving: Moving<'_>,
    images: Images,
    walls: &[WallMotionNow],
    advance: Advance,
) {
    let normal = group.model.normal;
    match group.partner {
        Partner::Particle => normal.accept(PairSweep { group, moving, images, advance }),
        Partner::Wall(place) => normal.accept(WallSweep { group, moving, wall: walls[place], advance }),
    }
}

struct PairSweep<'a> {
    group: &'a mut ContactGroup,
    moving: Moving<'a>,
    images: Images,
    advance: Advance,
}

impl NormalLawVisitor for PairSweep<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self { group, moving, images, advance } = self;
        if group.model.composition.has_friction() {
            sweep_pairs::<N, true>(law, group, moving, images, advance);
        } else {
            sweep_pairs::<N, false>(law, group, moving, images, advance);
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw", "x86_64+avx2"), dispatcher = "direct")]
fn sweep_pairs<N: NormalLaw, const FRICTION: bool>(
    law: N,
    group: &mut ContactGroup,
    moving: Moving<'_>,
    images: Images,
    advance: Advance,
) {
    let reach = Lane::splat(-group.model.composition.noncontact.reach());
    let mut energies = ContactEnergies::<Lane>::default();
    let mut bodies = [(Body::default(), Body::default()); BATCH];
    let blocks = group.first.len();
    for start in (0..blocks).step_by(BATCH) {
        let batch = start..(start + BATCH).min(blocks);
        let mut looked_at = 0_u32;
        for block in batch.clone() {
            if group.gap[block] > advance.closed && !group.live[block] {
                continue;
            }
            let (first, second) = &mut bodies[block - start];
            first.gather_place(moving, &group.first[block]);
            second.gather_place(moving, &group.second[block]);
            looked_at |= 1 << (block - start);
        }
        let mut acting = 0_u32;
        for block in batch.clone().filter(|block| looked_at & (1 << (block - start)) != 0) {
            let (first, second) = &bodies[block - start];
            let separation = images.nearest(first.position - second.position);
            let overlap = first.radius + second.radius - separation.norm();
            let valid = filled_lanes(group.filled(block));
            let acts = (overlap.gt(reach) & valid).any();
            if acts || group.live[block] {
                acting |= 1 << (block - start);
            }
            group.live[block] = acts;
        }
        for block in batch.clone().filter(|block| acting & (1 << (block - start)) != 0) {
            let (first, second) = &mut bodies[block - start];
            first.gather_motion::<FRICTION>(moving, &group.first[block]);
            second.gather_motion::<FRICTION>(moving, &group.second[block]);
        }
        for block in batch.filter(|block| acting & (1 << (block - start)) != 0) {
            let (first, second) = &bodies[block - start];
            let separation = images.nearest(first.position - second.position);
            let distance = separation.norm();
            let inverse_distance = Lane::one() / distance;
            // Idle lanes are out of any reach.
            let idle = reach + reach - first.radius;
            let overlap = first.radius + second.radius - distance;
            let motion = PairMotion {
                normal: separation * inverse_distance,
                overlap: Lane::select(filled_lanes(group.filled(block)), overlap, idle),
                inverse_distance,
                radius_i: first.radius,
                radius_j: second.radius,
                velocity: first.velocity - second.velocity,
                velocity_mid: first.velocity_mid - second.velocity_mid,
                spin_i: first.spin,
                spin_j: second.spin,
                spin_i_mid: first.spin_mid,
                spin_j_mid: second.spin_mid,
            };
            let pair = Pair::spheres(first.mass, second.mass, first.radius, second.radius);
            let answer = respond_block::<N, FRICTION>(&law, group, block, &pair, &motion, advance.time_step);
            energies += answer.energies;
        }
    }
    group.totals = ContactTotals { energies: energies.sum_lanes(), force: Vector3::zero() };
}

/// Blocks whose bodies are gathered before any of them is computed. Gathering and computing block by
/// block, the compiler carries the gathered numbers one by one into the arithmetic; from memory it
/// takes them eight at a time.
const BATCH: usize = 8;

/// Eight bodies, one a lane.
#[derive(Clone, Copy, Default)]
struct Body {
    position: Vector3<Lane>,
    radius: Lane,
    mass: Lane,
    velocity: Vector3<Lane>,
    velocity_mid: Vector3<Lane>,
    spin: Vector3<Lane>,
    spin_mid: Vector3<Lane>,
}

impl Body {
    #[inline(always)]
    fn gather_place(&mut self, moving: Moving<'_>, rows: &[u32; WIDTH]) {
        self.position = gather3(moving.position, rows);
        self.radius = gather(moving.radius, rows);
    }

    #[inline(always)]
    fn gather_motion<const FRICTION: bool>(&mut self, moving: Moving<'_>, rows: &[u32; WIDTH]) {
        self.mass = gather(moving.mass, rows);
        self.velocity = gather3(moving.velocity, rows);
        self.velocity_mid = gather3(moving.velocity_mid, rows);
        if FRICTION {
            self.spin = gather3(moving.spin, rows);
            self.spin_mid = gather3(moving.spin_mid, rows);
        }
    }
}

struct WallSweep<'a> {
    group: &'a mut ContactGroup,
    moving: Moving<'a>,
    wall: WallMotionNow,
    advance: Advance,
}

impl NormalLawVisitor for WallSweep<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self { group, moving, wall, advance } = self;
        if group.model.composition.has_friction() {
            sweep_wall::<N, true>(law, group, moving, wall, advance);
        } else {
            sweep_wall::<N, false>(law, group, moving, wall, advance);
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw", "x86_64+avx2"), dispatcher = "direct")]
fn sweep_wall<N: NormalLaw, const FRICTION: bool>(
    law: N,
    group: &mut ContactGroup,
    moving: Moving<'_>,
    wall: WallMotionNow,
    advance: Advance,
) {
    let composition = group.model.composition;
    let reach = Lane::splat(-composition.noncontact.reach());
    let normal = Vector3::<Lane>::splat(wall.normal);
    let wall_now = Vector3::<Lane>::splat(wall.velocity);
    let wall_mid = Vector3::<Lane>::splat(wall.velocity_mid);
    let mut energies = ContactEnergies::<Lane>::default();
    let mut total = Vector3::zero();
    for block in 0..group.first.len() {
        if group.gap[block] > advance.closed && !group.live[block] {
            continue;
        }
        let rows = group.first[block];
        let filled = group.filled(block);
        let radius = gather(moving.radius, &rows);
        let distance = gather3(moving.position, &rows).dot(normal) - Lane::splat(wall.offset);
        let overlap = Lane::select(filled_lanes(filled), radius - distance, reach + reach - radius);
        let acts = overlap.gt(reach).any();
        if !acts && !group.live[block] {
            continue;
        }
        group.live[block] = acts;
        let motion = PairMotion {
            normal,
            overlap,
            inverse_distance: Lane::zero(),
            radius_i: radius,
            radius_j: Lane::zero(),
            velocity: gather3(moving.velocity, &rows) - wall_now,
            velocity_mid: gather3(moving.velocity_mid, &rows) - wall_mid,
            spin_i: gather3(moving.spin, &rows),
            spin_j: Vector3::default(),
            spin_i_mid: gather3(moving.spin_mid, &rows),
            spin_j_mid: Vector3::default(),
        };
        let pair = Pair::wall(gather(moving.mass, &rows), radius);
        let answer = respond_block::<N, FRICTION>(&law, group, block, &pair, &motion, advance.time_step);
        energies += answer.energies;
        for lane in 0..filled {
            total += answer.force.lane(lane);
        }
    }
    group.totals = ContactTotals { energies: energies.sum_lanes(), force: total };
}

/// The response of a block; its memory and its forces are written back.
#[inline(always)]
fn respond_block<N: NormalLaw, const FRICTION: bool>(
    law: &N,
    group: &mut ContactGroup,
    block: usize,
    pair: &Pair<Lane>,
    motion: &PairMotion<Lane>,
    time_step: f64,
) -> ContactResponse<Lane> {
    let columns = group.layout.columns();
    let memory = &mut group.memory[block * columns..(block + 1) * columns];
    let composition = &group.model.composition;
    let answer = respond::<N, FRICTION>(law, composition, &group.layout, pair, motion, time_step, memory);
    let components = if FRICTION { 9 } else { 3 };
    let forces = &mut group.forces[block * components..(block + 1) * components];
    store3(&mut forces[..3], answer.force);
    if FRICTION {
        store3(&mut forces[3..6], answer.torque_i);
        store3(&mut forces[6..9], answer.torque_j);
    }
    answer
}

#[inline(always)]
fn store3(slots: &mut [Lane], vector: Vector3<Lane>) {
    slots[0] = vector.x;
    slots[1] = vector.y;
    slots[2] = vector.z;
}

/// One block: memory in, response, memory out.
#[inline(always)]
pub(crate) fn respond<N: NormalLaw, const FRICTION: bool>(
    law: &N,
    composition: &Composition,
    layout: &Layout,
    pair: &Pair<Lane>,
    motion: &PairMotion<Lane>,
    time_step: f64,
    columns: &mut [Lane],
) -> ContactResponse<Lane> {
    let mut memory = layout.load::<N::Memory<Lane>>(columns);
    let answer = if FRICTION {
        composition.respond::<Lane, N, { resistance::ALL }>(law, pair, motion, time_step, &mut memory)
    } else {
        composition.respond::<Lane, N, { resistance::NONE }>(law, pair, motion, time_step, &mut memory)
    };
    layout.store(&memory, columns);
    answer
}
