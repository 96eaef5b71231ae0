//! Linked cells in levels, one level for each class of sizes, by counting sort.

mod cell_blocks;
mod classes;
mod level;
mod search;
#[cfg(test)]
mod tests;

use pulvis_math::Packed4;

use self::classes::Classes;
use self::level::Level;
pub(crate) use self::search::RowRangePair;
use crate::counting_sort::counting_sort;
use pulvis_boundary::Domain;

/// Particles sorted into levels by size, finest first, and in each level into cells that are wide
/// enough for its largest particle.
///
/// Cells as wide as the largest particle would each hold very many small ones, all of them candidate neighbours of each
/// other. Here a pair of unlike sizes is found from the smaller particle, which searches the few cells of the coarser level
/// within its search radius.
#[derive(Clone, Debug)]
pub(crate) struct CellGrid {
    levels: Vec<Level>,
    /// First row of each cell, level by level; at the end the number of rows.
    starts: Vec<u32>,
    /// How far beyond touching pairs are looked for [m].
    margin: f64,
}

impl CellGrid {
    /// Sorts rows by level, then by cell, then by row. Pairs are found up to `margin` [m] beyond touching, the interaction
    /// range. `positions` are centres [m], wrapped into the domain, and radii with skins [m]. Also returns the order: row k
    /// shall become what was row `order[k]`.
    pub(crate) fn sort(domain: &Domain, positions: &[Packed4], margin: f64) -> (Self, Vec<u32>) {
        let classes = Classes::of(positions, margin);
        let mut levels: Vec<Level> = Vec::with_capacity(classes.list.len());
        for index in 0..classes.list.len() {
            let (first_cell, first_row) =
                levels.last().map_or((0, 0), |finer| (finer.end_of_cells(), finer.rows.end));
            let centres = || classes.centres(index, positions);
            levels.push(Level::new(domain, &classes.list[index], centres, margin, (first_cell, first_row)));
        }
        let number = |(position, &class): (&Packed4, &u8)| {
            let level = &levels[usize::from(class)];
            level.number(level.cell_coordinates_at(position.vector))
        };
        let cells: Vec<u32> = positions.iter().zip(&classes.of_row).map(number).collect();
        let count = levels.last().map_or(0, Level::end_of_cells);
        let (mut starts, mut order) = (Vec::new(), Vec::new());
        counting_sort(&cells, count as usize, &mut starts, &mut order);
        (Self { levels, starts, margin }, order)
    }

    /// The rows of a cell.
    #[inline(always)]
    fn rows_of(&self, cell: u32) -> (u32, u32) {
        let cell = cell as usize;
        (self.starts[cell], self.starts[cell + 1])
    }
}
