//! Contacts with walls.

use pulvis_contact::{Pair, levels};
use pulvis_math::{Kernel, Mask, Simd8, Vector3};

use super::super::block::{PACKED4_NUMBERS, occupied_lanes};
use super::batch::{Batch, BlockSums, gather};
use super::normal::Pointed;
use super::{Loop, WallMotionNow, finish, response, wants};
use crate::shared::Shared;

/// Runs the loop over a group of contacts with walls.
///
/// # Safety
/// As of [`sweep`](super::sweep).
pub(super) unsafe fn sweep(contacts: Loop<'_>, walls: &[WallMotionNow]) {
    let set = contacts.advance.instructions;
    set.run(WallLoop { contacts, walls });
}

/// Contacts with walls are few: one loop does for all laws, called through pointers, and for all levels of resistance.
struct WallLoop<'a> {
    contacts: Loop<'a>,
    walls: &'a [WallMotionNow],
}

impl Kernel for WallLoop<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Simd8>(self) {
        let Self { contacts: Loop { group, sums, moving, advance, approach, .. }, walls } = self;
        let sums = Shared::new(sums);
        let (laws, normal) = (group.model.laws, group.model.normal);
        let (turns, turning_dashpots) = (laws.has_friction(), laws.has_resistance_dashpot());
        let interaction_range = R::splat(-group.interaction_range);
        let columns = group.layout.columns();
        let call = Pointed::<R>::new(&normal, columns, advance.time_step, wants(group, advance));
        let mut response = response(call, group, advance, advance.ledger);
        let mut totals = BlockSums::<R>::new();
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
                if turns {
                    motion.angular_velocity_i_mid =
                        unsafe { gather::<R>(moving.angular_velocity_mid, rows) }.0;
                    if turning_dashpots {
                        motion.angular_velocity_i = unsafe { gather::<R>(moving.angular_velocity, rows) }.0;
                    }
                }
            }
            // SAFETY: every block has its memory; the rest as the caller of `sweep` vouches.
            unsafe {
                batch.respond::<_, { levels::ALL }, true>(&mut response, &mut group.memory, &mut totals);
            }
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
            unsafe { batch.add_up::<{ levels::ALL }, false>(&group.sums, sums) };
        }
        group.wall_forces[at_wall] += sum_of(total);
        finish(group, &totals);
    }
}

/// The sum of the vectors in all lanes.
#[inline(always)]
fn sum_of<R: Simd8>(vectors: Vector3<R>) -> Vector3 {
    Vector3::new(vectors.x.sum_lanes(), vectors.y.sum_lanes(), vectors.z.sum_lanes())
}
