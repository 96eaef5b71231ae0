//! What every dashpot promises (see `pulvis_contact::viscosity::ViscousLaw`).

use pulvis_contact::{Normal, NormalLaw, NormalLawVisitor, NormalResponse, Pair, Viscosity};
use pulvis_math::{F64Array, Real};

use crate::draw::Draw;
use crate::for_each_case;
use crate::parameters::{random_law, random_pair};

/// Checks every viscous law of the catalogue, beside random normal laws, in `count` random cases.
pub fn check_all(count: u64) {
    for entry in Viscosity::ENTRIES {
        for_each_case(entry.name, count, |draw| {
            let law = random_law(entry, draw, Viscosity::build);
            let normal_entry = draw.one_of(Normal::ENTRIES);
            random_law(normal_entry, draw, Normal::build).accept(Suite { law, draw });
        });
    }
}

struct Suite<'a> {
    law: Viscosity,
    draw: &'a mut Draw,
}

impl NormalLawVisitor for Suite<'_> {
    type Output = ();

    fn visit<N: NormalLaw>(self, normal: N) {
        let Self { law, draw } = self;
        let pairs: [Pair; 8] = std::array::from_fn(|_| random_pair(draw));
        let mut answers = [NormalResponse::default(); 8];
        let mut overlaps = [0.0; 8];
        for lane in 0..8 {
            let mut memory = <N::Memory<f64>>::default();
            let scale = normal.respond(&pairs[lane], 0.0, &mut memory).inverse_overlap_scale.recip();
            for _ in 0..4 {
                overlaps[lane] = if draw.chance(0.1) { 0.0 } else { scale * draw.unit() };
                answers[lane] = normal.respond(&pairs[lane], overlaps[lane], &mut memory);
            }
            let coefficient = law.coefficient(&pairs[lane], overlaps[lane], &answers[lane]);
            let largest = law.largest_coefficient(&pairs[lane]);
            // The power γ (dδ/dt)² has the sign of γ.
            assert!(coefficient >= 0.0, "{law:?} drives the contact: {coefficient} kg/s");
            assert!(coefficient <= largest * (1.0 + 1e-12), "{law:?}: {coefficient} kg/s, bound {largest}");
        }
        let together = law.coefficient(
            &Pair::from_fn(|lane| pairs[lane]),
            F64Array(overlaps),
            &NormalResponse {
                force: lanes(|lane| answers[lane].force),
                friction_reference: lanes(|lane| answers[lane].friction_reference),
                hardening: lanes(|lane| answers[lane].hardening),
                inverse_overlap_scale: lanes(|lane| answers[lane].inverse_overlap_scale),
                stored_energy: lanes(|lane| answers[lane].stored_energy),
                dissipated_plastic: lanes(|lane| answers[lane].dissipated_plastic),
                dissipated_adhesive: lanes(|lane| answers[lane].dissipated_adhesive),
            },
        );
        for lane in 0..8 {
            let alone = law.coefficient(&pairs[lane], overlaps[lane], &answers[lane]);
            assert_eq!(together.lane(lane).to_bits(), alone.to_bits(), "{law:?}");
        }
    }
}

fn lanes(number: impl FnMut(usize) -> f64) -> F64Array<8> {
    F64Array::from_fn(number)
}
