//! One text of the law serves a number and several numbers.

use pulvis_contact::{Memory, NormalLaw, NormalMotion, Pair};
use pulvis_math::{F64Array, Real};

use super::{bits, columns};
use crate::draw::Draw;
use crate::lanes::{LANES, Lanes};
use crate::loading::ask;
use crate::parameters::{random_pair, with_random_quantities};

pub(super) fn lanes_give_the_bits_of_the_plain_number<N: NormalLaw>(law: N, draw: &mut Draw) {
    let pairs: Vec<Pair> =
        (0..LANES).map(|_| with_random_quantities(random_pair(draw), &N::ENTRY, None, draw)).collect();
    let lanes = Pair::<Lanes>::from_fn(|lane| pairs[lane]);
    let mut memories = [<N::Memory<f64>>::default(); LANES];
    let mut memory = <N::Memory<Lanes>>::default();
    let mut overlaps = [0.0; LANES];
    let relative_span = draw.log_between(1e-4, 0.3);
    let spans: Vec<(f64, f64)> = pairs
        .iter()
        .map(|pair| {
            let range = law.interaction_range(pair);
            // Laws that act at a distance half the time near there.
            let near = range > 0.0 && draw.chance(0.5);
            (-1.3 * range, if near { 3.0 * range } else { pair.harmonic_radius() * relative_span })
        })
        .collect();
    for _ in 0..40 {
        let growths: [f64; LANES] = std::array::from_fn(|lane| {
            let (least, most) = spans[lane];
            let before = overlaps[lane];
            overlaps[lane] = if draw.chance(0.1) { 0.0 } else { draw.between(least, most) };
            overlaps[lane] - before
        });
        let closing_rate = draw.between(-1.0, 1.0);
        let motion = NormalMotion {
            closing_rate: Lanes::splat(closing_rate),
            growth: F64Array(growths),
            time_step: 1e-6,
            ..NormalMotion::at_rest(&lanes, F64Array(overlaps))
        };
        let answer = ask(&law, &motion, &mut memory);
        for lane in 0..LANES {
            let motion = NormalMotion {
                closing_rate,
                growth: growths[lane],
                time_step: 1e-6,
                ..NormalMotion::at_rest(&pairs[lane], overlaps[lane])
            };
            let plain = ask(&law, &motion, &mut memories[lane]);
            let mut of_lane = vec![0.0; <N::Memory<f64> as Memory<f64>>::COLUMNS];
            memory.store(|index, value: Lanes| of_lane[index] = value.lane(lane));
            let memory_bits = |numbers: Vec<f64>| numbers.into_iter().map(f64::to_bits).collect::<Vec<_>>();
            assert_eq!(memory_bits(of_lane), memory_bits(columns(&memories[lane])), "{law:?}: memory");
            assert_eq!(bits(&answer, lane), bits(&plain, 0), "{law:?}: {plain:?}");
        }
    }
}
