//! Contacts between particles.

use pulvis_contact::{ContactEnergies, NormalLaw, NormalLawVisitor, Pair, resistance};
use pulvis_math::{Kernel, Mask, Simd8};

use super::super::block::occupied_lanes;
use super::batch::{BATCH, Batch, Response, gather, gather_apart};
use super::{Advance, Loop};
use crate::particles::ForceTorque;
use crate::shared::Shared;

/// The loop over a group, with the type of its law.
pub(super) struct PairSweep<'a>(pub(super) Loop<'a>);

impl NormalLawVisitor for PairSweep<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self(contacts) = self;
        let (level, advance) = (contacts.group.model.laws.resistance_level(), contacts.advance);
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

struct PairLoop<'a, N, const RESISTANCE: u8, const LEDGER: bool> {
    law: N,
    contacts: Loop<'a>,
}

impl<N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool> Kernel for PairLoop<'_, N, RESISTANCE, LEDGER> {
    type Output = ();

    #[inline(always)]
    fn run<R: Simd8>(self) {
        let Self { law, contacts: Loop { group, sums, moving, advance, approach, mut prefetch } } = self;
        let sums = Shared::new(sums);
        // By value: not to be read anew after every store.
        let (laws, advance) = (group.model.laws, *advance);
        let turning_dashpots = laws.has_resistance_dashpot();
        let interaction_range = R::splat(-laws.noncontact.interaction_range());
        let Advance { time_step, stored, .. } = advance;
        let (layout, with_memory) = (group.layout, laws.remembers_normal_motion::<N>());
        let response = Response { law, laws, layout, time_step, with_memory, stored };
        let mut energies = ContactEnergies::<R>::default();
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
                let block = next;
                next += 1;
                // SAFETY (here and below): every block has its gap, its flag and so on, and rows lie
                // within the columns, as the caller of `sweep` vouches.
                let active = unsafe { group.active.get_unchecked_mut(block) };
                if unsafe { *group.gap.get_unchecked(block) } > approach && !*active {
                    continue;
                }
                let rows = unsafe { &group.rows.get_unchecked(block).0 };
                let [first, second] = rows;
                let (centre_i, radius_i) = unsafe { gather::<R>(moving.position, first) };
                let (centre_j, radius_j) = unsafe { gather::<R>(moving.position, second) };
                let mut separation = centre_i - centre_j;
                if unsafe { *group.crosses_boundary.get_unchecked(block) } {
                    separation = advance.images.nearest(separation);
                }
                let distance = separation.norm();
                let overlap = radius_i + radius_j - distance;
                // Idle lanes are out of any reach.
                let occupancy = occupied_lanes::<R>(unsafe { *group.occupancy.get_unchecked(block) });
                let overlap = R::select(occupancy, overlap, interaction_range + interaction_range - radius_i);
                let acts = overlap.gt(interaction_range).any();
                if !acts && !*active {
                    continue;
                }
                *active = acts;
                let inverse_distance = R::one() / distance;
                let (velocity_mid, inverse_mass) = unsafe { gather_apart::<R>(moving.velocity_mid, rows) };
                let (velocity, inverse_radius_sum) = unsafe { gather_apart::<R>(moving.velocity, rows) };
                let inputs = batch.add();
                inputs.block = block;
                inputs.pair = Pair::from_sums(inverse_mass, inverse_radius_sum);
                let motion = &mut inputs.motion;
                motion.normal = separation * inverse_distance;
                (motion.overlap, motion.inverse_distance) = (overlap, inverse_distance);
                (motion.radius_i, motion.radius_j) = (radius_i, radius_j);
                (motion.velocity, motion.velocity_mid) = (velocity, velocity_mid);
                if RESISTANCE != resistance::NONE {
                    motion.angular_velocity_i_mid =
                        unsafe { gather::<R>(moving.angular_velocity_mid, first) }.0;
                    motion.angular_velocity_j_mid =
                        unsafe { gather::<R>(moving.angular_velocity_mid, second) }.0;
                    if turning_dashpots {
                        motion.angular_velocity_i = unsafe { gather::<R>(moving.angular_velocity, first) }.0;
                        motion.angular_velocity_j = unsafe { gather::<R>(moving.angular_velocity, second) }.0;
                    }
                }
            }
            // SAFETY: every block has its memory; the rest as the caller of `sweep` vouches.
            unsafe { batch.respond::<N, RESISTANCE, LEDGER>(&response, &mut group.memory, &mut energies) };
            unsafe { batch.add_up::<RESISTANCE, true>(&group.sums, sums) };
        }
        prefetch.sums.fill(ForceTorque::default());
        group.energies = energies.to_array();
    }
}
