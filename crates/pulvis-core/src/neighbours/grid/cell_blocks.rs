//! The order of the cells of a level.

/// Cells are numbered in blocks of up to eight cells along each edge, so that cells that are near in space are near in
/// order, and a range of rows is a compact body. Blocks follow each other line by line; the cells of a block are in Morton
/// order.
///
/// The number of a cell is a sum of one term for each axis; the terms are in tables.
#[derive(Clone, Debug)]
pub(super) struct CellBlocks {
    terms: [Vec<u32>; 3],
    /// Cells of all blocks, with those that only fill up incomplete blocks.
    total: u32,
}

/// Edge of the largest blocks: two to this power.
const MOST_BITS: u32 = 3;

impl CellBlocks {
    /// Blocks for this many cells along each axis; their product must be below 2³².
    pub(super) fn new(cells: [u32; 3]) -> Self {
        let bits = cells.map(block_bits);
        let block = 1_u32 << bits.iter().sum::<u32>();
        let mut stride = block;
        let mut terms: [Vec<u32>; 3] = Default::default();
        for axis in 0..3 {
            let mask = (1 << bits[axis]) - 1;
            let term = |cell: u32| (cell >> bits[axis]) * stride + spread(cell & mask, axis, bits);
            terms[axis] = (0..cells[axis]).map(term).collect();
            stride *= cells[axis].div_ceil(1 << bits[axis]);
        }
        Self { terms, total: stride }
    }

    /// Number of cells along an axis when blocks are filled up.
    pub(super) fn padded(cells: f64) -> f64 {
        let edge = f64::from(1_u32 << block_bits(cells as u32));
        (cells / edge).ceil() * edge
    }

    /// Number of cells in all blocks.
    pub(super) fn total(&self) -> u32 {
        self.total
    }

    /// Number of cells along an axis.
    #[inline(always)]
    pub(super) fn along(&self, axis: usize) -> u32 {
        self.terms[axis].len() as u32
    }

    /// What a cell's coordinate along an axis adds to its number.
    #[inline(always)]
    pub(super) fn term(&self, axis: usize, coordinate: u32) -> u32 {
        self.terms[axis][coordinate as usize]
    }
}

/// Edge of the blocks along an axis of this many cells, as a power of two: the largest for which filling blocks up adds no
/// more than a third.
fn block_bits(cells: u32) -> u32 {
    let few_more = |bits: &u32| {
        let padded = u64::from(cells).next_multiple_of(1 << bits);
        3 * padded <= 4 * u64::from(cells)
    };
    (0..=MOST_BITS).rev().find(few_more).unwrap_or(0)
}

/// The bits of a coordinate along an axis, each moved to where it belongs among those of all axes.
fn spread(coordinate: u32, axis: usize, bits: [u32; 3]) -> u32 {
    let mut number = 0;
    let mut position = 0;
    for bit in 0..MOST_BITS {
        for (other, &count) in bits.iter().enumerate() {
            if bit < count {
                if other == axis {
                    number |= (coordinate >> bit & 1) << position;
                }
                position += 1;
            }
        }
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(cells: [u32; 3]) -> Vec<u32> {
        let cell_blocks = CellBlocks::new(cells);
        let mut numbers = Vec::new();
        for z in 0..cells[2] {
            for y in 0..cells[1] {
                numbers.extend(
                    (0..cells[0])
                        .map(|x| cell_blocks.term(0, x) + cell_blocks.term(1, y) + cell_blocks.term(2, z)),
                );
            }
        }
        numbers
    }

    #[test]
    fn every_cell_has_a_number_of_its_own() {
        for cells in [[1, 1, 1], [2, 3, 5], [9, 8, 1], [17, 1, 30], [20, 11, 7], [1, 1, 1000]] {
            let mut found = numbers(cells);
            found.sort_unstable();
            found.dedup();
            assert_eq!(found.len() as u32, cells.iter().product::<u32>());
            assert!(found.iter().all(|&number| number < CellBlocks::new(cells).total()));
        }
    }

    #[test]
    fn filling_up_adds_little_and_is_counted() {
        for cells in 1..100_u32 {
            let padded = CellBlocks::padded(f64::from(cells));
            assert!(padded >= f64::from(cells) && 3.0 * padded <= 4.0 * f64::from(cells));
            assert_eq!(f64::from(CellBlocks::new([cells, 1, 1]).total()), padded);
        }
    }

    #[test]
    fn a_block_is_a_cube_in_morton_order() {
        let cell_blocks = CellBlocks::new([16, 16, 16]);
        assert_eq!((cell_blocks.term(0, 1), cell_blocks.term(1, 1), cell_blocks.term(2, 1)), (1, 2, 4));
        assert_eq!((cell_blocks.term(0, 2), cell_blocks.term(1, 2), cell_blocks.term(2, 2)), (8, 16, 32));
        assert_eq!(
            (cell_blocks.term(0, 8), cell_blocks.term(1, 8), cell_blocks.term(2, 8)),
            (512, 1024, 2048)
        );
    }
}
