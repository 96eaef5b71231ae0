//! Which of the rows that may be near each other are.

use pulvis_math::{Kernel, Mask, Octet, Quad, Row, Vector3};

use crate::domain::Images;
use crate::neighbours::Stretch;

/// Lists the pairs of rows whose surfaces are closer than `margin` [m].
pub(super) struct Near<'a> {
    pub(super) stretches: &'a [Stretch],
    pub(super) places: &'a [Quad],
    pub(super) images: Images,
    pub(super) margin: f64,
    pub(super) pairs: &'a mut Vec<[u32; 2]>,
}

impl Kernel for Near<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Octet>(self) {
        let Self { mut stretches, places, images, margin, pairs } = self;
        // Stretches of the same rows, one behind the other: short ones would leave most lanes idle.
        let mut others: Vec<u32> = Vec::new();
        while let Some(&Stretch { ones, .. }) = stretches.first() {
            let same = stretches.iter().take_while(|stretch| stretch.ones == ones).count();
            others.clear();
            for stretch in &stretches[..same] {
                others.extend(stretch.others.0..stretch.others.1);
            }
            stretches = &stretches[same..];
            for some in others.chunks(8) {
                let [x, y, z, radius] = columns::<R>(places, some);
                let centres = Vector3::new(x, y, z);
                for one in ones.0..ones.1 {
                    let Quad { vector, scalar } = places[one as usize];
                    let apart = images.nearest(Vector3::<R>::splat(vector) - centres).norm_squared();
                    let near = R::splat(scalar + margin) + radius;
                    let mut found = apart.lt(near * near).bits() & ((1 << some.len()) - 1);
                    while found != 0 {
                        let other = some[found.trailing_zeros() as usize];
                        if other > one {
                            pairs.push([one, other]);
                        }
                        found &= found - 1;
                    }
                }
            }
        }
    }
}

/// The columns of up to eight rows: the last is repeated.
#[inline(always)]
fn columns<R: Octet>(places: &[Quad], rows: &[u32]) -> [R; 4] {
    let mut eight = [rows[rows.len() - 1]; 8];
    eight[..rows.len()].copy_from_slice(rows);
    R::columns([
        R::Row::load(&places[eight[0] as usize]),
        R::Row::load(&places[eight[1] as usize]),
        R::Row::load(&places[eight[2] as usize]),
        R::Row::load(&places[eight[3] as usize]),
        R::Row::load(&places[eight[4] as usize]),
        R::Row::load(&places[eight[5] as usize]),
        R::Row::load(&places[eight[6] as usize]),
        R::Row::load(&places[eight[7] as usize]),
    ])
}

#[cfg(test)]
mod tests {
    use pulvis_math::InstructionSet;

    use super::*;
    use crate::domain::Domain;

    #[test]
    fn near_rows_are_found_in_stretches_of_any_length() {
        let places: Vec<Quad> =
            (0..40).map(|row| Quad::new(Vector3::new(0.3 * f64::from(row), 0.0, 0.0), 0.5)).collect();
        for length in 0..40 {
            let half = length / 2;
            let stretches = [(0, half), (half, length)].map(|others| Stretch { ones: (0, 1), others });
            for set in InstructionSet::available() {
                let mut pairs = Vec::new();
                let images = Domain::unbounded().images();
                set.run(Near {
                    stretches: &stretches,
                    places: &places,
                    images,
                    margin: 0.55,
                    pairs: &mut pairs,
                });
                // Nearer than 1.55: up to row 5.
                let expected: Vec<[u32; 2]> = (1..length.min(6)).map(|row| [0, row]).collect();
                assert_eq!(pairs, expected, "{set}");
            }
        }
    }
}
