//! What every dashpot promises (see `pulvis_contact::viscosity::ViscousLaw`).

use pulvis_contact::{Normal, NormalLaw, NormalLawVisitor, NormalMotion, Pair, Viscosity};
use pulvis_math::{F64Array, Real};

use crate::draw::Draw;
use crate::for_each_case;
use crate::lanes::{LANES, Lanes};
use crate::loading::ask;
use crate::parameters::{loaded_to, random_law, random_pair};

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

    fn visit<N: NormalLaw>(self, normal: &N) {
        let Self { law, draw } = self;
        let pairs: [Pair; LANES] = std::array::from_fn(|_| random_pair(draw));
        let lanes = Pair::<Lanes>::from_fn(|lane| pairs[lane]);
        let scales = pairs.map(|pair| {
            let at_touch = NormalMotion::at_rest(&pair, 0.0);
            ask(normal, &at_touch, &mut Default::default()).inverse_overlap_scale.recip()
        });
        let mut memories = [<N::Memory<f64>>::default(); LANES];
        let mut memory = <N::Memory<Lanes>>::default();
        for _ in 0..4 {
            let overlaps: [f64; LANES] =
                scales.map(|scale| if draw.chance(0.1) { 0.0 } else { scale * draw.unit() });
            let all = ask(normal, &NormalMotion::at_rest(&lanes, F64Array(overlaps)), &mut memory);
            let together = law.coefficient(&lanes, F64Array(overlaps), &all);
            for lane in 0..LANES {
                let (pair, overlap) = (&pairs[lane], overlaps[lane]);
                let answer = ask(normal, &NormalMotion::at_rest(pair, overlap), &mut memories[lane]);
                let coefficient = law.coefficient(pair, overlap, &answer);
                assert_eq!(together.lane(lane).to_bits(), coefficient.to_bits(), "{law:?}");
                let max_stiffness = normal.max_stiffness(pair, &loaded_to(scales[lane], pair));
                let largest = law.largest_coefficient(pair, max_stiffness);
                // The power γ (dδ/dt)² has the sign of γ.
                assert!(coefficient >= 0.0, "{law:?} drives the contact: {coefficient} kg/s");
                assert!(
                    coefficient <= largest * (1.0 + 1e-12),
                    "{law:?}, {normal:?}: {coefficient} kg/s, bound {largest}"
                );
            }
        }
    }
}
