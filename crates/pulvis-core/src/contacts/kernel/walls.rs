//! Contacts with walls.

use pulvis_contact::levels;
use pulvis_math::{Kernel, Mask, Simd8, Vector3};

use super::super::block::occupied_lanes;
use super::batch::{BATCH, Batch, BlockSums, gather};
use super::hand_over::hand_over;
use super::normal::{NormalCall, Pointed};
use super::{Loop, finish, response, step_middle, wants};
use crate::shared::Shared;
use crate::walls::{WallForce, WallNow};

/// Runs the loop over a group of contacts with walls.
///
/// # Safety
/// As of [`sweep`](super::sweep).
pub(super) unsafe fn sweep(contacts: Loop<'_>, walls: &[WallNow]) {
    // SAFETY: the caller's.
    unsafe { hand_over(contacts.group, walls, contacts.moving) };
    let set = contacts.advance.instructions;
    set.run(WallLoop { contacts, walls });
}

/// The loop over contacts with walls. They are few, so that one loop serves all laws, through pointers, and all levels of
/// resistance.
struct WallLoop<'a> {
    contacts: Loop<'a>,
    walls: &'a [WallNow],
}

impl Kernel for WallLoop<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Simd8>(self) {
        let Self { contacts: Loop { group, sums, moving, advance, approach, .. }, walls } = self;
        let sums = Shared::new(sums);
        let model = group.model;
        let laws = &model.laws;
        let (turns, turning_dashpots) = (laws.has_friction(), laws.has_resistance_dashpot());
        let interaction_range = R::splat(-group.interaction_range);
        let slots = group.layout.slots();
        let call = Pointed::<R, true>::new(&model, slots, step_middle(advance), wants(group, advance));
        let reads = group.reads_quantities();
        let mut response = response(call, group, advance, advance.ledger);
        let mut totals = BlockSums::<R>::new();
        let any_turns = walls.iter().any(|wall| wall.angular_velocity().is_some());
        group.wall_forces.fill(WallForce::default());
        // The forces of one wall are summed at a time.
        let (mut at_wall, mut force, mut torque) = (0, Vector3::<R>::zero(), R::zero());
        let mut arms = [Vector3::<R>::zero(); BATCH];
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
                let [rows, _] = &group.rows[block].0;
                let wall = &walls[group.wall(block)];
                // SAFETY (here and below): rows lie within the columns, as the caller of `sweep` vouches.
                let (centre, radius) = unsafe { gather::<R>(moving.position, rows) };
                let (surface, turning) = match wall.surface(centre) {
                    Some(surface) => (surface, None),
                    None => {
                        let centres = [centre.x, centre.y, centre.z].map(|column| column.to_array());
                        let range = group.interaction_range;
                        let occupancy = group.occupancy(block);
                        let features = group.wall_features(block);
                        let seen = wall.features(features, centres, radius.to_array(), range, occupancy);
                        let (surface, turning) = seen.load();
                        (surface, Some(turning))
                    }
                };
                let overlap = radius - surface.distance;
                let valid = occupied_lanes::<R>(group.occupancy[block]);
                let overlap = R::select(valid, overlap, interaction_range + interaction_range - radius);
                let acts = overlap.gt(interaction_range).any();
                if !acts && !group.active[block] {
                    continue;
                }
                group.active[block] = acts;
                let (mid, inverse_mass) = unsafe { gather::<R>(moving.velocity_mid, rows) };
                let (velocity, inverse_radius) = unsafe { gather::<R>(moving.velocity, rows) };
                // Values that a wall does not have stay zero.
                let inputs = batch.add();
                inputs.block = block;
                inputs.inverse_mass = inverse_mass;
                inputs.inverse_radius = inverse_radius + surface.mean_curvature;
                let motion = &mut inputs.motion;
                (motion.normal, motion.overlap, motion.radius_i) = (surface.normal, overlap, radius);
                (motion.velocity, motion.velocity_mid) = (velocity, mid);
                let arm = wall.move_against(&surface, turning, centre, motion);
                if turns {
                    motion.angular_velocity_i_mid =
                        unsafe { gather::<R>(moving.angular_velocity_mid, rows) }.0;
                    if turning_dashpots {
                        motion.angular_velocity_i = unsafe { gather::<R>(moving.angular_velocity, rows) }.0;
                    }
                    if any_turns {
                        let angular_velocity = wall.angular_velocity().unwrap_or(Vector3::zero());
                        motion.angular_velocity_j_mid = Vector3::splat(angular_velocity);
                        motion.angular_velocity_j = motion.angular_velocity_j_mid;
                    }
                }
                let index = batch.len() - 1;
                arms[index] = arm;
                if reads {
                    response.call.gather_quantities(index, group, moving.quantities, block);
                }
            }
            // SAFETY: every block has its memory; the rest as the caller of `sweep` vouches.
            unsafe {
                batch.respond::<_, { levels::ALL }, true>(&mut response, &mut group.memory, &mut totals);
            }
            for (index, &arm) in arms.iter().enumerate().take(batch.len()) {
                let (block, answer) = batch.response(index);
                let wall = group.wall(block);
                if wall != at_wall {
                    group.wall_forces[at_wall] += sum_of(force, torque);
                    (at_wall, force, torque) = (wall, Vector3::zero(), R::zero());
                }
                force += answer.force;
                if any_turns {
                    torque += walls[wall].torque_on_particles(arm, answer.force, answer.torque_j);
                }
            }
            // SAFETY: as the caller of `sweep` vouches.
            unsafe { batch.add_up::<{ levels::ALL }, false>(&group.sums, sums) };
        }
        group.wall_forces[at_wall] += sum_of(force, torque);
        finish(group, &totals);
    }
}

/// The sum over all lanes.
#[inline(always)]
fn sum_of<R: Simd8>(force: Vector3<R>, torque: R) -> WallForce {
    let force = Vector3::new(force.x.sum_lanes(), force.y.sum_lanes(), force.z.sum_lanes());
    WallForce { force, torque: torque.sum_lanes() }
}
