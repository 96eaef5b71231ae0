//! The contact loop: the same text for every law and instruction set.

use multiversion::multiversion;
use pulvis_contact::{
    Composition, ContactEnergies, ContactResponse, NormalLaw, NormalLawVisitor, Pair, PairMotion,
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

/// Where contacts add their forces and torques.
pub(crate) struct Totals<'a> {
    pub(crate) force: &'a mut [Vector3],
    pub(crate) torque: &'a mut [Vector3],
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

struct PairSweep<'a, 'b> {
    group: &'a mut ContactGroup,
    moving: Moving<'a>,
    images: Images,
    time_step: f64,
    totals: &'a mut Totals<'b>,
}

impl NormalLawVisitor for PairSweep<'_, '_> {
    type Output = ContactTotals;
    fn visit<N: NormalLaw>(self, law: N) -> ContactTotals {
        let Self { group, moving, images, time_step, totals } = self;
        if group.model.composition.has_friction() {
            sweep_pairs::<N, true>(law, group, moving, images, time_step, totals)
        } else {
            sweep_pairs::<N, false>(law, group, moving, images, time_step, totals)
        }
    }
}

/// Forces between the particles of a group's pairs.
pub(crate) fn pair_forces(
    group: &mut ContactGroup,
    moving: Moving<'_>,
    images: Images,
    time_step: f64,
    totals: &mut Totals<'_>,
) -> ContactTotals {
    let normal = group.model.normal;
    normal.accept(PairSweep { group, moving, images, time_step, totals })
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw", "x86_64+avx2"), dispatcher = "direct")]
fn sweep_pairs<N: NormalLaw, const FRICTION: bool>(
    law: N,
    group: &mut ContactGroup,
    moving: Moving<'_>,
    images: Images,
    time_step: f64,
    totals: &mut Totals<'_>,
) -> ContactTotals {
    let composition = group.model.composition;
    let layout = group.layout;
    let columns = layout.columns();
    let reach = Lane::splat(-composition.noncontact.reach());
    let mut energies = ContactEnergies::<Lane>::default();
    for block in 0..group.first.len() {
        let (first, second) = (group.first[block], group.second[block]);
        let filled = group.filled(block);
        let separation = gather3(moving.position, &first) - gather3(moving.position, &second);
        let separation = images.nearest(separation);
        let radius_i = gather(moving.radius, &first);
        let radius_j = gather(moving.radius, &second);
        let distance = separation.norm();
        let overlap = radius_i + radius_j - distance;
        // Idle lanes are out of any reach.
        let overlap = Lane::select(filled_lanes(filled), overlap, reach + reach - radius_i);
        let acts = overlap.gt(reach).any();
        if !acts && !group.live[block] {
            continue;
        }
        group.live[block] = acts;
        let inverse_distance = Lane::one() / distance;
        let (mid_i, mid_j) = (gather3(moving.velocity_mid, &first), gather3(moving.velocity_mid, &second));
        let (now_i, now_j) = (gather3(moving.velocity, &first), gather3(moving.velocity, &second));
        let spins = if FRICTION {
            [
                gather3(moving.spin, &first),
                gather3(moving.spin, &second),
                gather3(moving.spin_mid, &first),
                gather3(moving.spin_mid, &second),
            ]
        } else {
            [Vector3::default(); 4]
        };
        let motion = PairMotion {
            normal: separation * inverse_distance,
            overlap,
            inverse_distance,
            radius_i,
            radius_j,
            velocity: now_i - now_j,
            velocity_mid: mid_i - mid_j,
            spin_i: spins[0],
            spin_j: spins[1],
            spin_i_mid: spins[2],
            spin_j_mid: spins[3],
        };
        let pair =
            Pair::spheres(gather(moving.mass, &first), gather(moving.mass, &second), radius_i, radius_j);
        let memory = &mut group.memory[block * columns..(block + 1) * columns];
        let answer = respond::<N, FRICTION>(&law, &composition, &layout, &pair, &motion, time_step, memory);
        energies += answer.energies;
        for lane in 0..filled {
            let (i, j) = (first[lane] as usize, second[lane] as usize);
            let force = answer.force.lane(lane);
            totals.force[i] += force;
            totals.force[j] -= force;
            if FRICTION {
                totals.torque[i] += answer.torque_i.lane(lane);
                totals.torque[j] += answer.torque_j.lane(lane);
            }
        }
    }
    ContactTotals { energies: energies.sum_lanes(), force: Vector3::zero() }
}

struct WallSweep<'a, 'b> {
    group: &'a mut ContactGroup,
    moving: Moving<'a>,
    wall: WallMotionNow,
    time_step: f64,
    totals: &'a mut Totals<'b>,
}

impl NormalLawVisitor for WallSweep<'_, '_> {
    type Output = ContactTotals;
    fn visit<N: NormalLaw>(self, law: N) -> ContactTotals {
        let Self { group, moving, wall, time_step, totals } = self;
        if group.model.composition.has_friction() {
            sweep_wall::<N, true>(law, group, moving, wall, time_step, totals)
        } else {
            sweep_wall::<N, false>(law, group, moving, wall, time_step, totals)
        }
    }
}

/// Forces of a wall on the particles of a group; the sum is what the wall exerts on them.
pub(crate) fn wall_forces(
    group: &mut ContactGroup,
    moving: Moving<'_>,
    wall: WallMotionNow,
    time_step: f64,
    totals: &mut Totals<'_>,
) -> ContactTotals {
    debug_assert!(group.partner != Partner::Particle);
    let normal = group.model.normal;
    normal.accept(WallSweep { group, moving, wall, time_step, totals })
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw", "x86_64+avx2"), dispatcher = "direct")]
fn sweep_wall<N: NormalLaw, const FRICTION: bool>(
    law: N,
    group: &mut ContactGroup,
    moving: Moving<'_>,
    wall: WallMotionNow,
    time_step: f64,
    totals: &mut Totals<'_>,
) -> ContactTotals {
    let composition = group.model.composition;
    let layout = group.layout;
    let columns = layout.columns();
    let reach = Lane::splat(-composition.noncontact.reach());
    let normal = Vector3::<Lane>::splat(wall.normal);
    let wall_now = Vector3::<Lane>::splat(wall.velocity);
    let wall_mid = Vector3::<Lane>::splat(wall.velocity_mid);
    let mut energies = ContactEnergies::<Lane>::default();
    let mut total = Vector3::zero();
    for block in 0..group.first.len() {
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
        let memory = &mut group.memory[block * columns..(block + 1) * columns];
        let answer = respond::<N, FRICTION>(&law, &composition, &layout, &pair, &motion, time_step, memory);
        energies += answer.energies;
        for (lane, &row) in rows.iter().enumerate().take(filled) {
            let row = row as usize;
            let force = answer.force.lane(lane);
            totals.force[row] += force;
            total += force;
            if FRICTION {
                totals.torque[row] += answer.torque_i.lane(lane);
            }
        }
    }
    ContactTotals { energies: energies.sum_lanes(), force: total }
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
    let answer = composition.respond::<Lane, N, FRICTION>(law, pair, motion, time_step, &mut memory);
    layout.store(&memory, columns);
    answer
}
