//! Pairs of row ranges that may contain neighbours.

use std::ops::Range;

use pulvis_math::{Packed4, Vector3};

use super::CellGrid;
use super::level::{Level, Touched};

/// Two ranges of rows (first row and end): each row of `ones` may be near each row of `others` that comes later. Of all
/// pairs with the same `ones`, only the first may have `others` that do not come later.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowRangePair {
    pub(crate) ones: (u32, u32),
    pub(crate) others: (u32, u32),
}

/// Rows of the same cell and of adjacent cells, as ranges.
struct Adjacent {
    /// The later rows of the same cell, then the rows of later cells.
    runs: [(u32, u32); 27],
    count: usize,
}

/// Rows of a coarser level, as ranges.
#[derive(Clone, Debug, Default)]
struct Coarser {
    runs: Vec<(u32, u32)>,
    /// The cells that they are in.
    touched: Option<Touched>,
}

impl CellGrid {
    /// Calls `see` with pairs of row ranges that contain every neighbour of each row in `rows`: later rows whose centres may
    /// be closer than the sum of the radii and the margin. Each pair of rows is in exactly one of them; distances are not
    /// checked. `positions` are the sorted centres [m] and radii [m], in the new order. The neighbours of a row and their
    /// order do not depend on `rows`.
    pub(crate) fn for_each_row_range_pair_of(
        &self,
        rows: Range<u32>,
        positions: &[Packed4],
        mut see: impl FnMut(RowRangePair),
    ) {
        let positions = self.in_cells(positions);
        for (index, level) in self.levels.iter().enumerate() {
            let coarser = &self.levels[index + 1..];
            let mut own = Adjacent { runs: [(0, 0); 27], count: 1 };
            let mut others = vec![Coarser::default(); coarser.len()];
            let mut row = rows.start.max(level.rows.start);
            let end = rows.end.min(level.rows.end);
            while row < end {
                let cell = level.cell_coordinates_at(positions[row as usize].vector);
                let end_of_cell = self.list_adjacent(level, cell, &mut own);
                let ones = (row, end_of_cell.clamp(row + 1, end));
                own.runs[0].0 = row;
                for &others in &own.runs[..own.count] {
                    see(RowRangePair { ones, others });
                }
                if !coarser.is_empty() {
                    for one in ones.0..ones.1 {
                        let Packed4 { vector, scalar } = positions[one as usize];
                        for (other, coarse) in others.iter_mut().zip(coarser) {
                            self.list_touched(coarse, vector, scalar, other);
                            for &others in &other.runs {
                                see(RowRangePair { ones: (one, one + 1), others });
                            }
                        }
                    }
                }
                row = ones.1;
            }
        }
    }

    /// Lists the rows of the cell at the coordinates `cell`, then those of adjacent cells that come later. Returns the end of
    /// the rows of the cell itself.
    #[inline(always)]
    fn list_adjacent(&self, level: &Level, cell: [u32; 3], list: &mut Adjacent) -> u32 {
        let number = level.number(cell);
        let own = self.rows_of(number);
        let [x, y, z] = cell;
        let beside = [level.beside(0, x), level.beside(1, y), level.beside(2, z)];
        // Which cells come later and are not empty is unpredictable for a processor, so there is no branch: every cell is
        // written, and the index advances only for a cell that is wanted and does not continue the last range.
        let mut last = own;
        let mut count = 0;
        list.runs[0] = own;
        for &z in beside[2].terms() {
            for &y in beside[1].terms() {
                for &x in beside[0].terms() {
                    let other = level.first_cell() + z + y + x;
                    let (start, end) = self.rows_of(other);
                    let wanted = (other > number) & (start < end);
                    let goes_on = start == last.1;
                    count += usize::from(wanted & !goes_on);
                    last.0 = if wanted & !goes_on { start } else { last.0 };
                    last.1 = if wanted { end } else { last.1 };
                    list.runs[count] = last;
                }
            }
        }
        list.count = count + 1;
        own.1
    }

    /// Lists the rows of a coarser level that may be near a smaller particle with this centre [m] and radius [m].
    #[inline(always)]
    fn list_touched(&self, coarse: &Level, position: Vector3, radius: f64, list: &mut Coarser) {
        let touched = coarse.touched(position, radius + coarse.largest + self.margin);
        // Consecutive small particles are near each other: mostly they touch the same cells.
        if touched != list.touched {
            list.touched = touched;
            self.list_cells(coarse, list);
        }
    }

    fn list_cells(&self, level: &Level, list: &mut Coarser) {
        list.runs.clear();
        let Some(touched) = list.touched else { return };
        let coordinates = |axis: usize| {
            let ((first, count), cells) = (touched[axis], level.along(axis));
            (first..first + count).map(move |along| if along < cells { along } else { along - cells })
        };
        for z in coordinates(2) {
            for y in coordinates(1) {
                for x in coordinates(0) {
                    let (start, end) = self.rows_of(level.number([x, y, z]));
                    match list.runs.last_mut() {
                        _ if start == end => {}
                        Some(last) if last.1 == start => last.1 = end,
                        _ => list.runs.push((start, end)),
                    }
                }
            }
        }
    }
}
