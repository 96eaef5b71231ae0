//! Finds the pairs that are near each other among the rows of adjacent cells.

use std::ops::Range;

use pulvis_math::{F64Array, Kernel, Mask, Packed4, Simd4, Simd8, Vector3};

use crate::neighbours::RowRangePair;
use pulvis_boundary::Images;

/// Two rows that are near each other, the lower one first, and the gap between their surfaces [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Near {
    pub(super) rows: [u32; 2],
    pub(super) gap: f64,
}

/// Lists the pairs of rows whose surfaces are closer than `margin` [m].
pub(super) struct Search<'a> {
    pub(super) row_ranges: &'a [RowRangePair],
    pub(super) positions: &'a [Packed4],
    pub(super) images: Images,
    pub(super) margin: f64,
    pub(super) near: &'a mut Vec<Near>,
}

/// Rows that are compared together: one bit for each.
const TILE: usize = u64::BITS as usize;
const EIGHTS: usize = TILE / 8;

/// Up to [`TILE`] rows in columns.
#[derive(Default)]
struct Tile {
    /// x, y, z of the centres and the radius [m].
    columns: [[F64Array<8>; 4]; EIGHTS],
    /// Squared distances from one row [m²].
    squares: [F64Array<8>; EIGHTS],
}

impl Kernel for Search<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Simd8>(self) {
        let Self { mut row_ranges, positions, images, margin, near } = self;
        let mut others = Vec::new();
        let mut tile = Tile::default();
        while let Some(&RowRangePair { ones, others: first }) = row_ranges.first() {
            // All ranges with the same `ones` are joined: a short range alone would leave most lanes idle.
            let count = write_out(&mut row_ranges, ones, &mut others);
            for start in (0..count).step_by(TILE) {
                let end = count.min(start + TILE);
                let some = &others[start..end.next_multiple_of(8)];
                tile.fill::<R>(positions, some);
                for one in ones.0..ones.1 {
                    // Only the first range may contain rows that are not later.
                    let earlier = ((one + 1).clamp(first.0, first.1) - first.0) as usize;
                    let Packed4 { vector, scalar } = positions[one as usize];
                    let found = tile.near::<R>(end - start, vector, scalar + margin, images);
                    let found = found & bits(earlier.saturating_sub(start)..end - start);
                    tile.write_down(found, (one, scalar), some, near);
                }
            }
        }
    }
}

/// Takes the leading ranges with the same `ones` off `row_ranges` and writes their rows into `rows`. Returns the number
/// of rows. The last row is repeated so that eight can be loaded at any position.
#[inline(always)]
fn write_out(row_ranges: &mut &[RowRangePair], ones: (u32, u32), rows: &mut Vec<u32>) -> usize {
    let mut count = 0;
    while let Some((&RowRangePair { ones: same, others: (start, end) }, left)) = row_ranges.split_first()
        && same == ones
    {
        let length = (end - start) as usize;
        if rows.len() < count + length + 16 {
            rows.resize(2 * (count + length + 16), 0);
        }
        // Always eight at a time; what is written too much is overwritten.
        for written in (0..length).step_by(8) {
            let row = start + written as u32;
            rows[count + written..count + written + 8].copy_from_slice(&[
                row,
                row + 1,
                row + 2,
                row + 3,
                row + 4,
                row + 5,
                row + 6,
                row + 7,
            ]);
        }
        count += length;
        *row_ranges = left;
    }
    if count > 0 {
        let last = rows[count - 1];
        rows[count..count + 8].fill(last);
    }
    count
}

/// A word with ones in a range of bit positions.
#[inline(always)]
fn bits(positions: Range<usize>) -> u64 {
    let below = |index: usize| u64::MAX.checked_shr((TILE - index.min(TILE)) as u32).unwrap_or(0);
    below(positions.end) & !below(positions.start)
}

impl Tile {
    #[inline(always)]
    fn fill<R: Simd8>(&mut self, positions: &[Packed4], rows: &[u32]) {
        for (columns, eight) in self.columns.iter_mut().zip(rows.as_chunks::<8>().0) {
            for (column, value) in columns.iter_mut().zip(columns_of::<R>(positions, eight)) {
                value.store(column);
            }
        }
    }

    /// One bit per row: whether its centre is nearer to `centre` than `interaction_range` [m] plus its radius. Bits beyond
    /// the first `count` rows have no meaning.
    #[inline(always)]
    fn near<R: Simd8>(
        &mut self,
        count: usize,
        centre: Vector3,
        interaction_range: f64,
        images: Images,
    ) -> u64 {
        let (centre, interaction_range) = (Vector3::<R>::splat(centre), R::splat(interaction_range));
        let mut found = 0;
        for (eight, (columns, squares)) in
            self.columns.iter().zip(&mut self.squares).take(count.div_ceil(8)).enumerate()
        {
            let [x, y, z, radius] = columns;
            let other = Vector3::new(R::load(x), R::load(y), R::load(z));
            let apart = images.nearest(centre - other).norm_squared();
            let near = interaction_range + R::load(radius);
            found |= u64::from(apart.lt(near * near).bits()) << (8 * eight);
            apart.store(squares);
        }
        found
    }

    /// Appends the pairs of a row, given with its radius [m], and the rows that were `found` near it.
    #[inline(always)]
    fn write_down(&self, mut found: u64, (one, radius): (u32, f64), rows: &[u32], near: &mut Vec<Near>) {
        near.reserve(TILE);
        let mut count = 0;
        let room = near.spare_capacity_mut();
        while found != 0 {
            let index = found.trailing_zeros() as usize;
            found &= found - 1;
            let (eight, lane) = (index / 8, index % 8);
            let both = radius + self.columns[eight][3].0[lane];
            let gap = self.squares[eight].0[lane].sqrt() - both;
            room[count].write(Near { rows: [one, rows[index]], gap });
            count += 1;
        }
        // SAFETY: so many have been written behind the last one.
        unsafe { near.set_len(near.len() + count) };
    }
}

/// The columns of eight rows.
#[inline(always)]
fn columns_of<R: Simd8>(positions: &[Packed4], rows: &[u32; 8]) -> [R; 4] {
    R::columns([
        R::Simd4::load(&positions[rows[0] as usize]),
        R::Simd4::load(&positions[rows[1] as usize]),
        R::Simd4::load(&positions[rows[2] as usize]),
        R::Simd4::load(&positions[rows[3] as usize]),
        R::Simd4::load(&positions[rows[4] as usize]),
        R::Simd4::load(&positions[rows[5] as usize]),
        R::Simd4::load(&positions[rows[6] as usize]),
        R::Simd4::load(&positions[rows[7] as usize]),
    ])
}

#[cfg(test)]
mod tests {
    use pulvis_math::InstructionSet;

    use super::*;
    use pulvis_boundary::Domain;

    /// Rows in a line, 0.3 m apart, and pairs whose surfaces are closer than 0.55 m: up to the fifth row
    /// behind one.
    fn found(rows: u32, row_ranges: &[RowRangePair], set: InstructionSet) -> Vec<Near> {
        let line = |row| Packed4::new(Vector3::new(0.3 * f64::from(row), 0.0, 0.0), 0.5);
        let positions: Vec<Packed4> = (0..rows).map(line).collect();
        let mut near = Vec::new();
        let images = Domain::unbounded().images();
        set.run(Search { row_ranges, positions: &positions, images, margin: 0.55, near: &mut near });
        near
    }

    #[test]
    fn near_rows_are_found_in_stretches_of_any_length() {
        for length in 0..40_u32 {
            let half = length.div_ceil(2);
            let row_ranges = [(0, half), (half, length)].map(|others| RowRangePair { ones: (0, 1), others });
            for set in InstructionSet::available() {
                let found = found(40, &row_ranges, set);
                assert!(
                    found.iter().map(|near| near.rows).eq((1..length.min(6)).map(|row| [0, row])),
                    "{set}"
                );
                for near in found {
                    assert!((near.gap - (0.3 * f64::from(near.rows[1]) - 1.0)).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn more_rows_than_are_looked_at_together_are_found_once_each() {
        for (start, end) in [(0, 200), (70, 140), (63, 64), (64, 66)] {
            let row_ranges = [RowRangePair { ones: (start, end), others: (start, 200) }];
            let of_one = |one: u32| (one + 1..(one + 6).min(200)).map(move |other| [one, other]);
            let mut expected: Vec<[u32; 2]> = (start..end).flat_map(of_one).collect();
            expected.sort_unstable();
            for set in InstructionSet::available() {
                let mut rows: Vec<_> = found(200, &row_ranges, set).iter().map(|near| near.rows).collect();
                rows.sort_unstable();
                assert_eq!(rows, expected, "{set}");
            }
        }
    }
}
