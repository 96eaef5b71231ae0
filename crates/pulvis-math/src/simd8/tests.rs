//! Every instruction set against plain Rust.

use proptest::prelude::*;

use super::*;
use crate::real::Mask;

/// Every operation of the trait, on the numbers of two arrays.
struct Everything<'a> {
    x: &'a F64Array<8>,
    y: &'a F64Array<8>,
}

impl Kernel for Everything<'_> {
    type Output = Vec<[u64; 8]>;
    #[inline(always)]
    fn run<R: Simd8>(self) -> Vec<[u64; 8]> {
        let (x, y) = (R::load(self.x), R::load(self.y));
        let (one, zero) = (R::one(), R::zero());
        let flag = |mask: R::Mask| R::select(mask, one, zero);
        let columns = R::columns(R::rows([x, y, x + y, x * y]));
        let apart = R::apart(R::rows([x, y, x + y, x * y]), R::rows([y, x * y, x, x + y]));
        let mut sum = x;
        sum += y;
        sum -= one;
        let answers = [
            x + y,
            x - y,
            x * y,
            x / y,
            -x,
            sum,
            x.abs().sqrt(),
            x.min(y),
            x.max(y),
            x.abs().powf(1.5),
            x.cbrt(),
            flag(x.lt(y)),
            flag(x.le(y)),
            flag(x.gt(y)),
            flag(x.ge(y)),
            flag(!x.lt(y) & y.ge(zero) | x.gt(one)),
            R::splat(x.sum_lanes()),
            R::splat(f64::from(u8::from(x.lt(y).any())) + 2.0 * f64::from(u8::from(x.lt(y).all()))),
            R::splat(f64::from(x.lt(y).bits())),
            R::from_fn(|lane| x.lane(7 - lane)),
            R::from_fn(|lane| if x.lt(y).lane(lane) { 1.0 } else { 0.0 }),
            columns[0],
            columns[1],
            columns[2],
            columns[3],
            apart[0],
            apart[1],
            apart[2],
            apart[3],
        ];
        let bits = |answer: R| {
            let mut stored = F64Array::default();
            answer.store(&mut stored);
            stored.0.map(f64::to_bits)
        };
        let mut all = answers.map(bits).to_vec();
        // Forces and torques that are added to the sums of one body and subtracted from those of the other.
        let mut sums = [Packed4::new(Vector3::new(0.1, 0.2, 0.3), 0.4); 2];
        for twin in R::row_pairs([x, y, x + y, x * y], [y, x * y, x, x + y]) {
            for sum in [R::Simd4Pair::load(&sums).plus(twin), R::Simd4Pair::load(&sums).minus_plus(twin)] {
                sum.store(&mut sums);
                let [one, other] = sums;
                let [a, b] = [one, other]
                    .map(|packed| [packed.vector.x, packed.vector.y, packed.vector.z, packed.scalar]);
                all.push([a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]].map(f64::to_bits));
            }
        }
        all
    }
}

/// Sums of rows.
struct RowSums<'a>(&'a [Packed4; 2]);

impl Kernel for RowSums<'_> {
    type Output = [Packed4; 5];
    #[inline(always)]
    fn run<R: Simd8>(self) -> [Packed4; 5] {
        let (one, other) = (R::Simd4::load(&self.0[0]), R::Simd4::load(&self.0[1]));
        let answers = [
            one.plus(other),
            one.minus(other),
            one.times(other),
            one.with_scalar_of(other),
            R::Simd4::splat(self.0[0].scalar),
        ];
        answers.map(|row| {
            let mut packed = Packed4::default();
            row.store(&mut packed);
            packed
        })
    }
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![8 => -10.0..10.0_f64, 1 => Just(0.0), 1 => Just(-0.0), 1 => Just(2.0), 1 => Just(f64::INFINITY)]
}

proptest! {
    #[test]
    fn every_instruction_set_gives_the_same_bits(
        x in prop::array::uniform8(any_number()),
        y in prop::array::uniform8(any_number()),
    ) {
        let (x, y) = (F64Array(x), F64Array(y));
        let plain = run_plain(Everything { x: &x, y: &y });
        let packed = [0, 1].map(|part| Packed4::new(Vector3::new(x.0[part], y.0[part], x.0[part + 2]), y.0[part + 2]));
        let rows = run_plain(RowSums(&packed));
        for set in InstructionSet::available() {
            let answers = set.run(Everything { x: &x, y: &y });
            for (place, (answer, expected)) in answers.iter().zip(&plain).enumerate() {
                for lane in 0..8 {
                    // A NaN (of infinity minus infinity) may have either sign.
                    let both_nan = f64::from_bits(answer[lane]).is_nan() && f64::from_bits(expected[lane]).is_nan();
                    prop_assert!(both_nan || answer[lane] == expected[lane], "{set}, operation {place}");
                }
            }
            let same = set.run(RowSums(&packed)).iter().zip(&rows).all(|(a, b)| {
                [(a.vector.x, b.vector.x), (a.vector.y, b.vector.y), (a.vector.z, b.vector.z), (a.scalar, b.scalar)]
                    .iter().all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan())
            });
            prop_assert!(same, "{set}, rows");
        }
    }
}

#[test]
fn the_plainest_set_comes_first_and_the_widest_is_the_default() {
    let sets = InstructionSet::available();
    assert_eq!(sets[0].to_string(), if cfg!(target_arch = "x86_64") { "sse2" } else { "plain" });
    assert_eq!(sets.last(), Some(&InstructionSet::default()));
}
