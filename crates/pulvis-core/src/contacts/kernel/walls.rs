//! Contacts with walls.

use pulvis_contact::{ContactEnergies, NormalLaw, NormalLawVisitor, Pair, resistance};
use pulvis_math::{Kernel, Mask, Octet, Vector3};

use super::super::block::{QUAD, filled_lanes};
use super::batch::{Batch, Response, gather};
use super::{Advance, Loop, WallMotionNow};
use crate::shared::Shared;

/// The loop over a group, with the type of its law.
pub(super) struct WallSweep<'a>(pub(super) Loop<'a>, pub(super) &'a [WallMotionNow]);

impl NormalLawVisitor for WallSweep<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self(contacts, walls) = self;
        let (level, set) =
            (contacts.group.model.composition.resistance_level(), contacts.advance.instructions);
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
    fn run<R: Octet>(self) {
        let Self { law, contacts: Loop { group, sums, moving, advance, closed, .. }, walls } = self;
        let sums = Shared::new(sums);
        let (composition, advance) = (group.model.composition, *advance);
        let turning_dashpots = composition.has_resistance_dashpot();
        let reach = R::splat(-composition.noncontact.reach());
        let Advance { time_step, held, .. } = advance;
        let (layout, with_memory) = (group.layout, composition.remembers_normal_motion::<N>());
        let response = Response { law, composition, layout, time_step, with_memory, held };
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
                if group.gap[block] > closed && !group.live[block] {
                    continue;
                }
                let [rows, [wall, ..]] = &group.rows[block].0;
                let wall = walls[(wall / QUAD) as usize];
                let normal = Vector3::<R>::splat(wall.normal);
                // SAFETY (here and below): rows lie within the columns, as the caller of `sweep` vouches.
                let (centre, radius) = unsafe { gather::<R>(moving.place, rows) };
                let overlap = radius - (centre.dot(normal) - R::splat(wall.offset));
                let valid = filled_lanes::<R>(group.filled[block]);
                let overlap = R::select(valid, overlap, reach + reach - radius);
                let acts = overlap.gt(reach).any();
                if !acts && !group.live[block] {
                    continue;
                }
                group.live[block] = acts;
                let (mid, inverse_mass) = unsafe { gather::<R>(moving.velocity_mid, rows) };
                let (velocity, inverse_radius) = unsafe { gather::<R>(moving.velocity, rows) };
                // What a wall has none of stays zero.
                let gathered = batch.add();
                gathered.block = block;
                gathered.pair = Pair::wall_from_inverses(inverse_mass, inverse_radius);
                let motion = &mut gathered.motion;
                (motion.normal, motion.overlap, motion.radius_i) = (normal, overlap, radius);
                motion.velocity = velocity - Vector3::splat(wall.velocity);
                motion.velocity_mid = mid - Vector3::splat(wall.velocity_mid);
                if RESISTANCE != resistance::NONE {
                    motion.spin_i_mid = unsafe { gather::<R>(moving.spin_mid, rows) }.0;
                    if turning_dashpots {
                        motion.spin_i = unsafe { gather::<R>(moving.spin, rows) }.0;
                    }
                }
            }
            // SAFETY: every block has its memory; the rest as the caller of `sweep` vouches.
            unsafe { batch.respond::<N, RESISTANCE, true>(&response, &mut group.memory, &mut energies) };
            for place in 0..batch.len() {
                let (block, force) = batch.force(place);
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
        group.energies = energies.to_lanes();
    }
}

/// The sum of the vectors in all lanes.
#[inline(always)]
fn sum_of<R: Octet>(vectors: Vector3<R>) -> Vector3 {
    Vector3::new(vectors.x.sum_lanes(), vectors.y.sum_lanes(), vectors.z.sum_lanes())
}
