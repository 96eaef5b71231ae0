//! Linked cells in levels, one level for each class of sizes, by counting sort.

mod cell_blocks;
mod classes;
mod level;
mod search;
#[cfg(test)]
mod tests;

use std::borrow::Cow;

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
    /// The sorted centres in a straight cell [m] and radii [m], where the domain is tilted.
    straight: Option<Vec<Packed4>>,
}

impl CellGrid {
    /// Sorts rows by level, then by cell, then by row. Pairs are found up to `margin` [m] beyond touching, the interaction
    /// range. `positions` are centres [m], wrapped into the domain, and radii with skins [m]. Also returns the order: row k
    /// shall become what was row `order[k]`.
    pub(crate) fn sort(domain: &Domain, positions: &[Packed4], margin: f64) -> (Self, Vec<u32>) {
        let straight = straightened(domain, positions);
        let positions = &straight[..];
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
        let sorted = || order.iter().map(|&row| positions[row as usize]).collect();
        let straight = domain.is_tilted().then(sorted);
        (Self { levels, starts, margin, straight }, order)
    }

    /// The positions that cells are made of: the sorted ones, or those in a straight cell.
    fn in_cells<'a>(&'a self, positions: &'a [Packed4]) -> &'a [Packed4] {
        self.straight.as_deref().unwrap_or(positions)
    }

    /// The rows of a cell.
    #[inline(always)]
    fn rows_of(&self, cell: u32) -> (u32, u32) {
        let cell = cell as usize;
        (self.starts[cell], self.starts[cell + 1])
    }
}

/// Positions as a straight cell would have them.
fn straightened<'a>(domain: &Domain, positions: &'a [Packed4]) -> Cow<'a, [Packed4]> {
    if !domain.is_tilted() {
        return Cow::Borrowed(positions);
    }
    let straight = |packed: &Packed4| Packed4::new(domain.straightened(packed.vector), packed.scalar);
    Cow::Owned(positions.iter().map(straight).collect())
}
