//! A regular grid of cells, and how the kernel spreads a point over it.

use pulvis_boundary::Domain;
use pulvis_math::Vector3;

use super::kernel::Kernel;

/// Cells of equal size in a block; periodic directions go around.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Lower corner of the block \[m\].
    pub lower: [f64; 3],
    /// Edges of a cell \[m\].
    pub cell: [f64; 3],
    /// Number of cells along each axis.
    pub counts: [usize; 3],
    pub(super) domain: Domain,
}

/// The share of a point that a cell takes.
pub(super) type Share = (usize, f64);

impl Grid {
    /// A grid with cells of about this size over a block from `lower` to `upper`; along periodic directions over a period.
    pub(super) fn new(lower: [f64; 3], upper: [f64; 3], size: f64, domain: Domain) -> Self {
        let (mut lower, mut upper) = (lower, upper);
        for axis in (0..3).filter(|&axis| domain.periodic[axis]) {
            (lower[axis], upper[axis]) = (domain.extent.lower[axis], domain.extent.upper[axis]);
        }
        let length = [0, 1, 2].map(|axis| upper[axis] - lower[axis]);
        let counts = length.map(|length| ((length / size).round() as usize).max(1));
        let cell = [0, 1, 2].map(|axis| length[axis] / counts[axis] as f64);
        Self { lower, cell, counts, domain }
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.counts.iter().product()
    }

    /// Whether there is no cell; there always is one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Volume of a cell \[m³\].
    pub fn volume(&self) -> f64 {
        self.cell.iter().product()
    }

    /// The middle of a cell \[m\].
    pub fn middle(&self, index: usize) -> [f64; 3] {
        let [nx, ny, _] = self.counts;
        let place = [index % nx, index / nx % ny, index / (nx * ny)];
        [0, 1, 2].map(|axis| self.lower[axis] + (place[axis] as f64 + 0.5) * self.cell[axis])
    }

    /// How much of a point each cell takes: the kernel at the distance of its middle, over the sum of that over all cells, so
    /// that the shares of a point add up to one. What lies beyond the block, along directions that do not repeat, is lost.
    /// Middles of cells beyond a periodic face count for the cell that holds their image.
    pub(super) fn shares(&self, at: Vector3, kernel: Kernel, width: f64, shares: &mut Vec<Share>) {
        shares.clear();
        if !at.to_array().iter().all(|x| x.is_finite()) {
            return;
        }
        let reach = kernel.reach(width);
        let range = [0, 1, 2].map(|axis| {
            let first = (at[axis] - reach - self.lower[axis]) / self.cell[axis] - 0.5;
            let last = (at[axis] + reach - self.lower[axis]) / self.cell[axis] - 0.5;
            [first.ceil() as i64, last.floor() as i64]
        });
        let mut sum = 0.0;
        for z in range[2][0]..=range[2][1] {
            for y in range[1][0]..=range[1][1] {
                for x in range[0][0]..=range[0][1] {
                    let middle = Vector3::from(self.middle_of([x, y, z]));
                    let value = kernel.shape((middle - at).norm(), width);
                    if value > 0.0 {
                        sum += value;
                        shares.extend(self.cell_of([x, y, z], middle).map(|index| (index, value)));
                    }
                }
            }
        }
        if sum > 0.0 {
            shares.iter_mut().for_each(|(_, share)| *share /= sum);
        } else {
            // A kernel narrower than the cells: all of it in the cell that holds the point.
            let place =
                [0, 1, 2].map(|axis| ((at[axis] - self.lower[axis]) / self.cell[axis]).floor() as i64);
            shares.extend(self.cell_of(place, at).map(|index| (index, 1.0)));
        }
    }

    fn middle_of(&self, place: [i64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.lower[axis] + (place[axis] as f64 + 0.5) * self.cell[axis])
    }

    /// The cell at integer coordinates, whose middle is given; `None` beyond the block.
    fn cell_of(&self, place: [i64; 3], middle: Vector3) -> Option<usize> {
        let inside = |axis: usize, place: i64| (0..self.counts[axis] as i64).contains(&place);
        let mut place = place;
        if !(0..3).all(|axis| inside(axis, place[axis])) {
            if (0..3).any(|axis| !self.domain.periodic[axis] && !inside(axis, place[axis])) {
                return None;
            }
            // In a tilted cell the image of a middle is no middle.
            let image = self.domain.wrapped(middle);
            place = [0, 1, 2].map(|axis| {
                let along = ((image[axis] - self.lower[axis]) / self.cell[axis]).floor() as i64;
                // Rounding may leave an image on the upper face.
                along.clamp(0, self.counts[axis] as i64 - 1)
            });
        }
        let [x, y, z] = place.map(|along| along as usize);
        Some((z * self.counts[1] + y) * self.counts[0] + x)
    }
}
