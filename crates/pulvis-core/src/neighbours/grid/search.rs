//! Candidate pairs.

use std::ops::Range;

use pulvis_math::Vector3;

use super::CellGrid;
use super::level::{Level, Touched};

/// Rows that are candidates, as stretches of rows.
#[derive(Clone, Debug, Default)]
struct Runs {
    list: Vec<(u32, u32)>,
    /// The cells that they are from, if this is a coarser level's.
    touched: Option<Touched>,
}

impl Runs {
    /// Adds the rows of a cell; those that follow on the last cell's, or on the first's, lengthen its
    /// stretch.
    #[inline(always)]
    fn add(&mut self, (start, end): (u32, u32)) {
        if start == end {
            return;
        }
        if let Some(last) = self.list.last_mut()
            && last.1 == start
        {
            last.1 = end;
            return;
        }
        if let Some(first) = self.list.first_mut()
            && first.1 == start
        {
            first.1 = end;
            return;
        }
        self.list.push((start, end));
    }
}

impl CellGrid {
    /// Calls `see(one, other)` for every pair with `one` in `rows` and `one` < `other` whose centres
    /// may be closer than the sum of their radii and the margin, each once over all rows; distances are
    /// not checked. Positions [m] and radii [m] are those that were sorted, in the new order. The
    /// pairs of a row and their order do not depend on the range that it is in.
    pub(crate) fn for_each_pair_of(
        &self,
        rows: Range<u32>,
        positions: &[Vector3],
        radii: &[f64],
        mut see: impl FnMut(u32, u32),
    ) {
        for (place, level) in self.levels.iter().enumerate() {
            let coarser = &self.levels[place + 1..];
            // The stretches of this level and of each coarser one.
            let mut own = Runs::default();
            let mut others = vec![Runs::default(); coarser.len()];
            let mut row = rows.start.max(level.rows.start);
            let end = rows.end.min(level.rows.end);
            while row < end {
                let places = level.places_at(positions[row as usize]);
                let end_of_cell = self.list_later(level, places, &mut own);
                for one in row..end_of_cell.clamp(row + 1, end) {
                    let (position, radius) = (positions[one as usize], radii[one as usize]);
                    for (runs, coarse) in others.iter_mut().zip(coarser) {
                        self.list_touched(coarse, position, radius, runs);
                    }
                    own.list[0].0 = one + 1;
                    for runs in std::iter::once(&own).chain(&others) {
                        for &(start, end) in &runs.list {
                            for other in start..end {
                                see(one, other);
                            }
                        }
                    }
                }
                row = end_of_cell.max(row + 1);
            }
        }
    }

    /// Lists the rows of the cell at `places`, first, and of the cells beside it that come later.
    /// Answers with the end of the cell's own rows.
    fn list_later(&self, level: &Level, places: [u32; 3], runs: &mut Runs) -> u32 {
        let number =
            |[x, y, z]: [u32; 3]| level.first_cell() + level.term(0, x) + level.term(1, y) + level.term(2, z);
        let cell = number(places);
        let own = self.rows_of(cell);
        runs.list.clear();
        runs.list.push(own);
        self.for_each_cell(level, level.beside(places), |other| {
            if other > cell {
                runs.add(self.rows_of(other));
            }
        });
        own.1
    }

    /// Lists the rows of a coarser level within reach of a centre [m] of a smaller particle of the
    /// given radius [m].
    #[inline(always)]
    fn list_touched(&self, coarse: &Level, position: Vector3, radius: f64, runs: &mut Runs) {
        let touched = coarse.touched(position, radius + coarse.largest + self.margin);
        // Small particles that follow each other are near each other: mostly nothing has changed.
        if touched == runs.touched {
            return;
        }
        runs.touched = touched;
        self.list_cells(coarse, runs);
    }

    fn list_cells(&self, level: &Level, runs: &mut Runs) {
        runs.list.clear();
        if let Some(touched) = runs.touched {
            self.for_each_cell(level, touched, |cell| runs.add(self.rows_of(cell)));
        }
    }

    /// Calls `visit` with the number of each of the cells.
    #[inline(always)]
    fn for_each_cell(&self, level: &Level, touched: Touched, mut visit: impl FnMut(u32)) {
        let terms = |axis: usize| {
            let (first, count) = touched[axis];
            let cells = level.along(axis);
            (first..first + count)
                .map(move |place| level.term(axis, if place < cells { place } else { place - cells }))
        };
        for z in terms(2) {
            for y in terms(1) {
                for x in terms(0) {
                    visit(level.first_cell() + z + y + x);
                }
            }
        }
    }
}
