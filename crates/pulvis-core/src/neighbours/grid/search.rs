//! Candidate pairs.

use std::ops::Range;

use pulvis_math::{Packed4, Vector3};

use super::CellGrid;
use super::level::{Level, Touched};

/// Rows, each of which may be near the later ones among other rows; as first row and end. Of the stretches of the
/// same ones, only the first may hold others that are not later.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowRangePair {
    pub(crate) ones: (u32, u32),
    pub(crate) others: (u32, u32),
}

/// Candidates in the own and in the adjacent cells, as stretches of rows.
struct Adjacent {
    /// What comes later in the own cell, then what is in later cells.
    runs: [(u32, u32); 27],
    count: usize,
}

/// Candidates in a coarser level, as stretches of rows.
#[derive(Clone, Debug, Default)]
struct Coarser {
    runs: Vec<(u32, u32)>,
    /// The cells that they are in.
    touched: Option<Touched>,
}

impl CellGrid {
    /// Calls `see` with stretches of rows in which every partner of each row in `rows` is found: later
    /// rows whose centres may be closer than the sum of the radii and the margin. Each pair of a row and
    /// a later one is in one stretch over all rows; distances are not checked. `positions` are the centres
    /// [m] and radii [m] that were sorted, in the new order. The partners of a row and their order do
    /// not depend on the range that it is in.
    pub(crate) fn for_each_row_range_pair_of(
        &self,
        rows: Range<u32>,
        positions: &[Packed4],
        mut see: impl FnMut(RowRangePair),
    ) {
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

    /// Lists the rows of the cell at the coordinates `cell`, first, and of the cells beside it that come later.
    /// Answers with the end of the cell's own rows.
    #[inline(always)]
    fn list_adjacent(&self, level: &Level, cell: [u32; 3], list: &mut Adjacent) -> u32 {
        let number = level.number(cell);
        let own = self.rows_of(number);
        let [x, y, z] = cell;
        let beside = [level.beside(0, x), level.beside(1, y), level.beside(2, z)];
        // Which cells come later and hold anything follows no pattern that a processor could learn:
        // every cell is written down, and what is not wanted or goes on where the last stretch ends
        // takes no new index.
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

    /// Lists the rows of a coarser level within reach of a centre [m] of a smaller particle of the
    /// given radius [m].
    #[inline(always)]
    fn list_touched(&self, coarse: &Level, position: Vector3, radius: f64, list: &mut Coarser) {
        let touched = coarse.touched(position, radius + coarse.largest + self.margin);
        // Small particles that follow each other are near each other: mostly nothing has changed.
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
