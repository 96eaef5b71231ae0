//! Contacts between particles.

use pulvis_contact::{ContactEnergies, NormalLaw, NormalLawVisitor, Pair, resistance};
use pulvis_math::{Kernel, Mask, Octet};

use super::super::block::filled_lanes;
use super::batch::{BATCH, Batch, Response, gather, gather_apart};
use super::{Advance, Loop};
use crate::particles::Load;
use crate::shared::Shared;

/// The loop over a group, with the type of its law.
pub(super) struct PairSweep<'a>(pub(super) Loop<'a>);

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

struct PairLoop<'a, N, const RESISTANCE: u8, const LEDGER: bool> {
    law: N,
    contacts: Loop<'a>,
}

impl<N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool> Kernel for PairLoop<'_, N, RESISTANCE, LEDGER> {
    type Output = ();

    #[inline(always)]
    fn run<R: Octet>(self) {
        let Self { law, contacts: Loop { group, sums, moving, advance, closed, mut ahead } } = self;
        let sums = Shared::new(sums);
        // By value: not to be read anew after every store.
        let (composition, advance) = (group.model.composition, *advance);
        let turning_dashpots = composition.has_resistance_dashpot();
        let reach = R::splat(-composition.noncontact.reach());
        let Advance { time_step, held, .. } = advance;
        let (layout, with_memory) = (group.layout, composition.remembers_normal_motion::<N>());
        let response = Response { law, composition, layout, time_step, with_memory, held };
        let mut energies = ContactEnergies::<R>::default();
        let mut batch = Batch::<R>::new();
        let blocks = group.rows.len();
        let mut next = 0;
        let expected = if group.batches > 0 { group.batches } else { blocks.div_ceil(BATCH) };
        let counts = ahead.in_rounds(expected);
        group.batches = 0;
        while next < blocks {
            ahead.make_ready(moving, counts);
            group.batches += 1;
            while next < blocks && !batch.is_full() {
                let block = next;
                next += 1;
                // SAFETY (here and below): every block has its gap, its flag and so on, and rows lie
                // within the columns, as the caller of `sweep` vouches.
                let live = unsafe { group.live.get_unchecked_mut(block) };
                if unsafe { *group.gap.get_unchecked(block) } > closed && !*live {
                    continue;
                }
                let rows = unsafe { &group.rows.get_unchecked(block).0 };
                let [first, second] = rows;
                let (centre_i, radius_i) = unsafe { gather::<R>(moving.place, first) };
                let (centre_j, radius_j) = unsafe { gather::<R>(moving.place, second) };
                let mut separation = centre_i - centre_j;
                if unsafe { *group.across.get_unchecked(block) } {
                    separation = advance.images.nearest(separation);
                }
                let distance = separation.norm();
                let overlap = radius_i + radius_j - distance;
                // Idle lanes are out of any reach.
                let filled = filled_lanes::<R>(unsafe { *group.filled.get_unchecked(block) });
                let overlap = R::select(filled, overlap, reach + reach - radius_i);
                let acts = overlap.gt(reach).any();
                if !acts && !*live {
                    continue;
                }
                *live = acts;
                let inverse_distance = R::one() / distance;
                let (velocity_mid, inverse_mass) = unsafe { gather_apart::<R>(moving.velocity_mid, rows) };
                let (velocity, twice_curvature) = unsafe { gather_apart::<R>(moving.velocity, rows) };
                let gathered = batch.add();
                gathered.block = block;
                gathered.pair = Pair::from_sums(inverse_mass, twice_curvature);
                let motion = &mut gathered.motion;
                motion.normal = separation * inverse_distance;
                (motion.overlap, motion.inverse_distance) = (overlap, inverse_distance);
                (motion.radius_i, motion.radius_j) = (radius_i, radius_j);
                (motion.velocity, motion.velocity_mid) = (velocity, velocity_mid);
                if RESISTANCE != resistance::NONE {
                    motion.spin_i_mid = unsafe { gather::<R>(moving.spin_mid, first) }.0;
                    motion.spin_j_mid = unsafe { gather::<R>(moving.spin_mid, second) }.0;
                    if turning_dashpots {
                        motion.spin_i = unsafe { gather::<R>(moving.spin, first) }.0;
                        motion.spin_j = unsafe { gather::<R>(moving.spin, second) }.0;
                    }
                }
            }
            // SAFETY: every block has its memory; the rest as the caller of `sweep` vouches.
            unsafe { batch.respond::<N, RESISTANCE, LEDGER>(&response, &mut group.memory, &mut energies) };
            unsafe { batch.add_up::<RESISTANCE, true>(&group.sums, sums) };
        }
        ahead.sums.fill(Load::default());
        group.energies = energies.to_lanes();
    }
}
