//! Contacts with walls.

use pulvis_contact::{ContactEnergies, NormalLaw, NormalLawVisitor, Pair, resistance};
use pulvis_math::{Kernel, Mask, Simd8, Vector3};

use super::super::block::{PACKED4_NUMBERS, occupied_lanes};
use super::batch::{Batch, Response, gather};
use super::{Advance, Loop, WallMotionNow};
use crate::shared::Shared;

/// The loop over a group, with the type of its law.
pub(super) struct WallSweep<'a>(pub(super) Loop<'a>, pub(super) &'a [WallMotionNow]);

impl NormalLawVisitor for WallSweep<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self(contacts, walls) = self;
        let (level, set) = (contacts.group.model.laws.resistance_level(), contacts.advance.instructions);
        match level {
            resistance::NONE => set.run(WallLoop::<N, { resistance::NONE }> { law, contacts, walls }),
            resistance::SLIDING => set.run(WallLoop::<N, { resistance::SLIDING }> { law, contacts, walls }),
            _ => set.run(WallLoop::<N, { resistance::ALL }> { law, contacts, walls }),
        }
    }
}

/// Walls have few contacts: their energies are always accounted for.
struct WallLoop<'a, N, const RESISTANCE: u8> {
    law: N,
    contacts: Loop<'a>,
    walls: &'a [WallMotionNow],
}

impl<N: NormalLaw, const RESISTANCE: u8> Kernel for WallLoop<'_, N, RESISTANCE> {
    type Output = ();

    #[inline(always)]
    fn run<R: Simd8>(self) {
        let Self { law, contacts: Loop { group, sums, moving, advance, approach, .. }, walls } = self;
        let sums = Shared::new(sums);
        let (laws, advance) = (group.model.laws, *advance);
        let turning_dashpots = laws.has_resistance_dashpot();
        let interaction_range = R::splat(-laws.noncontact.interaction_range());
        let Advance { time_step, stored, .. } = advance;
        let (layout, with_memory) = (group.layout, laws.remembers_normal_motion::<N>());
        let response = Response { law, laws, layout, time_step, with_memory, stored };
        let mut energies = ContactEnergies::<R>::default();
        group.wall_forces.fill(Vector3::zero());
        // The forces of one wall at a time.
        let (mut at_wall, mut total) = (0, Vector3::<R>::zero());
        let mut batch = Batch::<R>::new();
        let blocks = group.rows.len();
        let mut next = 0;
        while next < blocks {
            while next < blocks && !batch.is_full() {
                let block = next;
                next += 1;
                if group.gap[block] > approach && !group.active[block] {
                    continue;
                }
                let [rows, [wall, ..]] = &group.rows[block].0;
                let wall = walls[(wall / PACKED4_NUMBERS) as usize];
                let normal = Vector3::<R>::splat(wall.normal);
                // SAFETY (here and below): rows lie within the columns, as the caller of `sweep` vouches.
                let (centre, radius) = unsafe { gather::<R>(moving.position, rows) };
                let overlap = radius - (centre.dot(normal) - R::splat(wall.offset));
                let valid = occupied_lanes::<R>(group.occupancy[block]);
                let overlap = R::select(valid, overlap, interaction_range + interaction_range - radius);
                let acts = overlap.gt(interaction_range).any();
                if !acts && !group.active[block] {
                    continue;
                }
                group.active[block] = acts;
                let (mid, inverse_mass) = unsafe { gather::<R>(moving.velocity_mid, rows) };
                let (velocity, inverse_radius) = unsafe { gather::<R>(moving.velocity, rows) };
                // What a wall has none of stays zero.
                let inputs = batch.add();
                inputs.block = block;
                inputs.pair = Pair::wall_from_inverses(inverse_mass, inverse_radius);
                let motion = &mut inputs.motion;
                (motion.normal, motion.overlap, motion.radius_i) = (normal, overlap, radius);
                motion.velocity = velocity - Vector3::splat(wall.velocity);
                motion.velocity_mid = mid - Vector3::splat(wall.velocity_mid);
                if RESISTANCE != resistance::NONE {
                    motion.angular_velocity_i_mid =
                        unsafe { gather::<R>(moving.angular_velocity_mid, rows) }.0;
                    if turning_dashpots {
                        motion.angular_velocity_i = unsafe { gather::<R>(moving.angular_velocity, rows) }.0;
                    }
                }
            }
            // SAFETY: every block has its memory; the rest as the caller of `sweep` vouches.
            unsafe { batch.respond::<N, RESISTANCE, true>(&response, &mut group.memory, &mut energies) };
            for index in 0..batch.len() {
                let (block, force) = batch.force(index);
                let wall = group.second_row(block, 0) as usize;
                if wall != at_wall {
                    group.wall_forces[at_wall] += sum_of(total);
                    (at_wall, total) = (wall, Vector3::zero());
                }
                total += force;
            }
            // SAFETY: as the caller of `sweep` vouches.
            unsafe { batch.add_up::<RESISTANCE, false>(&group.sums, sums) };
        }
        group.wall_forces[at_wall] += sum_of(total);
        group.energies = energies.to_array();
    }
}

/// The sum of the vectors in all lanes.
#[inline(always)]
fn sum_of<R: Simd8>(vectors: Vector3<R>) -> Vector3 {
    Vector3::new(vectors.x.sum_lanes(), vectors.y.sum_lanes(), vectors.z.sum_lanes())
}
