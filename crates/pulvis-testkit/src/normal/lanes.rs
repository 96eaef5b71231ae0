//! One text of the law serves a number and eight numbers.

use pulvis_contact::{Memory, NormalLaw, NormalResponse, Pair};
use pulvis_math::{F64Array, Real};

use crate::draw::Draw;
use crate::parameters::random_pair;

type Eight = F64Array<8>;

pub(super) fn lanes_give_the_bits_of_the_plain_number<N: NormalLaw>(law: N, draw: &mut Draw) {
    let pairs: Vec<Pair> = (0..8).map(|_| random_pair(draw)).collect();
    let lanes = Pair::<Eight>::from_fn(|lane| pairs[lane]);
    let mut memories = [<N::Memory<f64>>::default(); 8];
    let mut memory = <N::Memory<Eight>>::default();
    let interaction_range = draw.log_between(1e-4, 0.3);
    for _ in 0..40 {
        let overlaps: Vec<f64> = pairs
            .iter()
            .map(|pair| {
                if draw.chance(0.1) { 0.0 } else { pair.harmonic_radius() * interaction_range * draw.unit() }
            })
            .collect();
        let answer = law.respond(&lanes, Eight::from_fn(|lane| overlaps[lane]), &mut memory);
        for lane in 0..8 {
            let plain = law.respond(&pairs[lane], overlaps[lane], &mut memories[lane]);
            let mut of_lane = vec![0.0; <N::Memory<f64> as Memory<f64>>::COLUMNS];
            memory.store(|index, value: Eight| of_lane[index] = value.lane(lane));
            let bits = |numbers: Vec<f64>| numbers.into_iter().map(f64::to_bits).collect::<Vec<_>>();
            assert_eq!(bits(of_lane), bits(super::columns(&memories[lane])), "{law:?}: memory");
            assert_eq!(numbers(&answer, lane), numbers(&plain, 0), "{law:?}: {plain:?}");
            assert_eq!(
                law.dashpot(&lanes).lane(lane).to_bits(),
                law.dashpot(&pairs[lane]).to_bits(),
                "{law:?}: dashpot"
            );
        }
    }
}

fn numbers<R: Real>(answer: &NormalResponse<R>, lane: usize) -> [u64; 7] {
    [
        answer.force,
        answer.friction_reference,
        answer.hardening,
        answer.inverse_overlap_scale,
        answer.stored_energy,
        answer.dissipated_plastic,
        answer.dissipated_adhesive,
    ]
    .map(|number| number.lane(lane).to_bits())
}
