//! Linked cells by counting sort.

use pulvis_math::Vector3;

use crate::domain::Domain;

/// Particles sorted into cubic cells that are at least as wide as the search radius, so that
/// neighbours are in the same or in adjacent cells.
#[derive(Clone, Debug)]
pub(crate) struct CellGrid {
    lower: Vector3,
    inverse_width: Vector3,
    cells: [usize; 3],
    periodic: [bool; 3],
    /// First place of each cell among the sorted rows, and one more at the end.
    starts: Vec<u32>,
}

/// Cells per particle at the most: fragments that fly apart must not make the grid grow with the
/// volume that they span.
const CELLS_PER_PARTICLE: usize = 4;

impl CellGrid {
    /// Sorts `positions` (wrapped into the domain) into cells at least `width` [m] wide; also
    /// answers with the order of the rows, cell by cell and by row within a cell.
    pub(crate) fn sort(domain: &Domain, positions: &[Vector3], width: f64) -> (Self, Vec<u32>) {
        let mut grid = Self::sized(domain, positions, width);
        let cells: Vec<u32> = positions.iter().map(|&position| grid.cell_of(position) as u32).collect();
        grid.starts = vec![0; grid.cells.iter().product::<usize>() + 1];
        for &cell in &cells {
            grid.starts[cell as usize + 1] += 1;
        }
        for cell in 1..grid.starts.len() {
            grid.starts[cell] += grid.starts[cell - 1];
        }
        let mut next = grid.starts.clone();
        let mut order = vec![0; positions.len()];
        for (row, &cell) in cells.iter().enumerate() {
            let place = &mut next[cell as usize];
            order[*place as usize] = row as u32;
            *place += 1;
        }
        (grid, order)
    }

    fn sized(domain: &Domain, positions: &[Vector3], width: f64) -> Self {
        let mut lower = domain.lower();
        let mut upper = domain.upper();
        for axis in (0..3).filter(|&axis| domain.period(axis).is_none()) {
            let along = positions.iter().map(|position| position[axis]);
            let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            });
            *lower.component_mut(axis) = low;
            *upper.component_mut(axis) = high;
        }
        let span = upper - lower;
        let most = (CELLS_PER_PARTICLE * positions.len()).max(64) as f64;
        let mut width = width;
        let cells = loop {
            let cells = [0, 1, 2].map(|axis| (span[axis] / width).floor().max(1.0));
            let product = cells[0] * cells[1] * cells[2];
            if product <= most {
                break cells.map(|count| count as usize);
            }
            width *= (product / most).cbrt().max(1.05);
        };
        let inverse = |axis: usize| if span[axis] > 0.0 { cells[axis] as f64 / span[axis] } else { 0.0 };
        Self {
            lower,
            inverse_width: Vector3::new(inverse(0), inverse(1), inverse(2)),
            cells,
            periodic: [0, 1, 2].map(|axis| domain.period(axis).is_some()),
            starts: Vec::new(),
        }
    }

    fn cell_of(&self, position: Vector3) -> usize {
        let along = |axis: usize| {
            let cell = (position[axis] - self.lower[axis]) * self.inverse_width[axis];
            // Round-off may put a wrapped particle on the upper face.
            (cell as usize).min(self.cells[axis] - 1)
        };
        (along(2) * self.cells[1] + along(1)) * self.cells[0] + along(0)
    }

    /// Calls `pair` for every two places of the sorted order that lie in the same or in adjacent
    /// cells, each pair once.
    pub(crate) fn for_each_pair(&self, mut pair: impl FnMut(u32, u32)) {
        let mut adjacent = Vec::with_capacity(27);
        for cell in 0..self.starts.len() - 1 {
            let own = self.starts[cell]..self.starts[cell + 1];
            if own.is_empty() {
                continue;
            }
            self.later_neighbours(cell, &mut adjacent);
            for one in own.clone() {
                for other in one + 1..own.end {
                    pair(one, other);
                }
                for &neighbour in &adjacent {
                    for other in self.starts[neighbour]..self.starts[neighbour + 1] {
                        pair(one, other);
                    }
                }
            }
        }
    }

    /// The cells adjacent to `cell` that come after it, each once: with few cells along a periodic
    /// axis, several directions lead to the same cell.
    fn later_neighbours(&self, cell: usize, adjacent: &mut Vec<usize>) {
        adjacent.clear();
        let place = [
            cell % self.cells[0],
            cell / self.cells[0] % self.cells[1],
            cell / self.cells[0] / self.cells[1],
        ];
        let along = |axis: usize, step: isize| -> Option<usize> {
            let count = self.cells[axis] as isize;
            let moved = place[axis] as isize + step;
            if self.periodic[axis] {
                return Some(moved.rem_euclid(count) as usize);
            }
            (0..count).contains(&moved).then_some(moved as usize)
        };
        for dz in -1..=1 {
            for dy in -1..=1 {
                for dx in -1..=1 {
                    if let (Some(x), Some(y), Some(z)) = (along(0, dx), along(1, dy), along(2, dz)) {
                        let other = (z * self.cells[1] + y) * self.cells[0] + x;
                        if other > cell {
                            adjacent.push(other);
                        }
                    }
                }
            }
        }
        adjacent.sort_unstable();
        adjacent.dedup();
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    fn pairs_within(domain: &Domain, positions: &[Vector3], cutoff: f64) -> BTreeSet<(usize, usize)> {
        let images = domain.images();
        let near = |i: usize, j: usize| images.nearest(positions[i] - positions[j]).norm() < cutoff;
        let all = (0..positions.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
        all.filter(|&(j, i)| near(i, j)).collect()
    }

    proptest! {
        #[test]
        fn no_pair_within_the_search_radius_is_missed_or_doubled(
            coordinates in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64), 1..120),
            cutoff in 0.05..0.45_f64,
            periodic in prop::array::uniform3(any::<bool>()),
        ) {
            let domain = Domain::periodic(Vector3::zero(), Vector3::new(1.0, 1.0, 1.0), periodic);
            let positions: Vec<_> =
                coordinates.iter().map(|&(x, y, z)| Vector3::new(x, y, z)).collect();
            let (grid, order) = CellGrid::sort(&domain, &positions, cutoff);
            let mut found = BTreeSet::new();
            let mut doubled = false;
            grid.for_each_pair(|a, b| {
                let (a, b) = (order[a as usize] as usize, order[b as usize] as usize);
                doubled |= !found.insert((a.min(b), a.max(b)));
            });
            prop_assert!(!doubled);
            prop_assert!(pairs_within(&domain, &positions, cutoff).is_subset(&found));
        }
    }

    #[test]
    fn fragments_far_apart_do_not_blow_the_grid_up() {
        let positions = vec![Vector3::zero(), Vector3::new(1e6, 1e6, 1e6), Vector3::new(0.1, 0.0, 0.0)];
        let (grid, _) = CellGrid::sort(&Domain::unbounded(), &positions, 1.0);
        assert!(grid.starts.len() < 100);
    }
}
