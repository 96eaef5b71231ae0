//! Contacts with walls.

use pulvis_contact::{ContactEnergies, NormalLaw, NormalLawVisitor, Pair, PairMotion, resistance};
use pulvis_math::{Kernel, Mask, Octet, Vector3};

use super::super::block::{WIDTH, filled_lanes};
use super::batch::{Batch, Gathered, Response, gather};
use super::{ContactTotals, Loop, WallMotionNow};
use crate::shared::Shared;

/// The loop over a group, with the type of its law.
pub(super) struct WallSweep<'a>(pub(super) Loop<'a>, pub(super) WallMotionNow);

impl NormalLawVisitor for WallSweep<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self(contacts, wall) = self;
        let (level, set) =
            (contacts.group.model.composition.resistance_level(), contacts.advance.instructions);
        match level {
            resistance::NONE => set.run(WallLoop::<N, { resistance::NONE }> { law, contacts, wall }),
            resistance::SLIDING => set.run(WallLoop::<N, { resistance::SLIDING }> { law, contacts, wall }),
            _ => set.run(WallLoop::<N, { resistance::ALL }> { law, contacts, wall }),
        }
    }
}

/// Walls have few contacts: their energies are always accounted for.
struct WallLoop<'a, N, const RESISTANCE: u8> {
    law: N,
    contacts: Loop<'a>,
    wall: WallMotionNow,
}

impl<N: NormalLaw, const RESISTANCE: u8> Kernel for WallLoop<'_, N, RESISTANCE> {
    type Output = ();

    #[inline(always)]
    fn run<R: Octet>(self) {
        let Self { law, contacts: Loop { group, sums, moving, advance, closed, .. }, wall } = self;
        let sums = Shared::new(sums);
        let (composition, advance) = (group.model.composition, *advance);
        let turning_dashpots = composition.has_resistance_dashpot();
        let reach = R::splat(-composition.noncontact.reach());
        let response = Response { law, composition, layout: group.layout, time_step: advance.time_step };
        let normal = Vector3::<R>::splat(wall.normal);
        let wall_now = Vector3::<R>::splat(wall.velocity);
        let wall_mid = Vector3::<R>::splat(wall.velocity_mid);
        let mut energies = ContactEnergies::<R>::default();
        let mut total = Vector3::<R>::zero();
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
                let [rows, _] = &group.rows[block].0;
                // SAFETY (here and below): rows lie within the columns, as the caller of `sweep` vouches.
                let (centre, radius) = unsafe { gather::<R>(moving.place, rows) };
                let overlap = radius - (centre.dot(normal) - R::splat(wall.offset));
                let valid = filled_lanes::<R>(group.len() - block * WIDTH);
                let overlap = R::select(valid, overlap, reach + reach - radius);
                let acts = overlap.gt(reach).any();
                if !acts && !group.live[block] {
                    continue;
                }
                group.live[block] = acts;
                let (mid, inverse_mass) = unsafe { gather::<R>(moving.velocity_mid, rows) };
                let (velocity, inverse_radius) = unsafe { gather::<R>(moving.velocity, rows) };
                let (mut spin_mid, mut spin) = (Vector3::zero(), Vector3::zero());
                if RESISTANCE != resistance::NONE {
                    spin_mid = unsafe { gather::<R>(moving.spin_mid, rows) }.0;
                    if turning_dashpots {
                        spin = unsafe { gather::<R>(moving.spin, rows) }.0;
                    }
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
                batch.push(Gathered { block, pair, motion });
            }
            // SAFETY: every block has its memory; the rest as the caller of `sweep` vouches.
            total +=
                unsafe { batch.respond::<N, RESISTANCE, true>(&response, &mut group.memory, &mut energies) };
            unsafe { batch.add_up::<RESISTANCE, false>(&group.sums, sums) };
        }
        let force = Vector3::new(total.x.sum_lanes(), total.y.sum_lanes(), total.z.sum_lanes());
        group.totals = ContactTotals { energies: energies.to_lanes(), force };
    }
}
