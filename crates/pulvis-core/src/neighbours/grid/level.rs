//! One level of the grid: where its cells are, and which of them a box touches.

use std::ops::Range;

use pulvis_math::Vector3;

use super::cell_blocks::CellBlocks;
use super::classes::Class;
use pulvis_boundary::Domain;

/// The cells of particles of like sizes. Particles beyond the outermost cells of an open axis belong
/// to these: two that are near each other are still in the same or in adjacent cells.
#[derive(Clone, Debug)]
pub(super) struct Level {
    /// Its rows.
    pub(super) rows: Range<u32>,
    /// Largest radius [m].
    pub(super) largest: f64,
    /// Number of its first cell among those of all levels.
    first_cell: u32,
    cell_blocks: CellBlocks,
    lower: [f64; 3],
    inverse_width: [f64; 3],
    periodic: [bool; 3],
    /// By how much separations are longer along each axis in a straight cell than they are, at most [1].
    straightening: [f64; 3],
    /// The box around the centres [m], without end along periodic axes.
    bounds: [[f64; 2]; 3],
}

/// Cell coordinates along each axis: the first and their number, continued over the end of periodic axes.
pub(super) type Touched = [(u32, u32); 3];

/// The terms that a cell coordinate along an axis and its neighbours add to the number of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    terms: [u32; 3],
    count: usize,
}

impl Beside {
    #[inline(always)]
    pub(super) fn terms(&self) -> &[u32] {
        &self.terms[..self.count]
    }
}

/// Largest number of cells per particle, with those that only fill up blocks: the grid must not grow with the volume that
/// fragments span when they fly apart.
const CELLS_PER_PARTICLE: u64 = 8;
/// Number of cells that is always allowed.
const FREE_CELLS: u64 = 64;
/// Largest number of cells of a level: the numbers of all levels together must fit into 32 bits.
const MOST_CELLS: u64 = 1 << 27;
/// Number of particles that are sampled to find where most of them are.
const SAMPLE: usize = 4096;

impl Level {
    /// The level of a class, with cells wide enough for pairs up to `margin` [m] beyond touching;
    /// `centres` are those of its particles [m], `first` its first cell and row.
    pub(super) fn new<Centres: Iterator<Item = Vector3>>(
        domain: &Domain,
        class: &Class,
        centres: impl Fn() -> Centres,
        margin: f64,
        first: (u32, u32),
    ) -> Self {
        let periodic = [0, 1, 2].map(|axis| domain.period(axis).is_some());
        let mut bounds = [0, 1, 2].map(|axis| [class.lower[axis], class.upper[axis]]);
        for axis in (0..3).filter(|&axis| periodic[axis]) {
            bounds[axis] = [domain.extent.lower[axis], domain.extent.upper[axis]];
        }
        let most = (CELLS_PER_PARTICLE * u64::from(class.count)).clamp(FREE_CELLS, MOST_CELLS) as f64;
        let straightening = domain.straightening();
        let edge = straightening.map(|longer| longer * (2.0 * class.largest + margin));
        let mut spans = bounds;
        let mut cells = cells_within(spans, edge, most);
        if cells.is_none() {
            let step = class.count as usize / SAMPLE + 1;
            let sample: Vec<Vector3> = centres().step_by(step).collect();
            for axis in (0..3).filter(|&axis| !periodic[axis]) {
                spans[axis] = crowded(&sample, axis, bounds[axis]);
            }
            cells = cells_within(spans, edge, most);
        }
        let cells = cells.unwrap_or_else(|| wider_cells_within(spans, edge, most));
        let per_length = |axis: usize| {
            let span = spans[axis][1] - spans[axis][0];
            if span > 0.0 { f64::from(cells[axis]) / span } else { 0.0 }
        };
        for axis in (0..3).filter(|&axis| periodic[axis]) {
            bounds[axis] = [f64::NEG_INFINITY, f64::INFINITY];
        }
        Self {
            rows: first.1..first.1 + class.count,
            largest: class.largest,
            first_cell: first.0,
            cell_blocks: CellBlocks::new(cells),
            lower: spans.map(|[lower, _]| lower),
            inverse_width: [0, 1, 2].map(per_length),
            periodic,
            straightening,
            bounds,
        }
    }

    /// One past the number of the last cell.
    pub(super) fn end_of_cells(&self) -> u32 {
        self.first_cell + self.cell_blocks.total()
    }

    /// Coordinates of the cell that a centre [m] is in.
    #[inline(always)]
    pub(super) fn cell_coordinates_at(&self, position: Vector3) -> [u32; 3] {
        let along = |axis: usize| {
            // The conversion takes negative values to zero; round-off may put a wrapped particle on the upper face.
            let along = (position[axis] - self.lower[axis]) * self.inverse_width[axis];
            (along as u32).min(self.cell_blocks.along(axis) - 1)
        };
        [along(0), along(1), along(2)]
    }

    /// Number of the cell at these coordinates.
    #[inline(always)]
    pub(super) fn number(&self, [x, y, z]: [u32; 3]) -> u32 {
        self.first_cell
            + self.cell_blocks.term(0, x)
            + self.cell_blocks.term(1, y)
            + self.cell_blocks.term(2, z)
    }

    /// Number of the first cell.
    #[inline(always)]
    pub(super) fn first_cell(&self) -> u32 {
        self.first_cell
    }

    /// A cell coordinate along an axis and its neighbours, each once: with few cells along a periodic axis both directions
    /// lead to the same coordinate.
    #[inline(always)]
    pub(super) fn beside(&self, axis: usize, coordinate: u32) -> Beside {
        let cells = self.cell_blocks.along(axis);
        let (coordinates, count) = if 0 < coordinate && coordinate + 1 < cells {
            ([coordinate - 1, coordinate, coordinate + 1], 3)
        } else if cells <= 3 && self.periodic[axis] {
            ([0, 1, 2], cells)
        } else if self.periodic[axis] {
            let (before, after) = (coordinate.checked_sub(1), coordinate + 1);
            ([before.unwrap_or(cells - 1), coordinate, if after < cells { after } else { 0 }], 3)
        } else {
            let first = coordinate.saturating_sub(1);
            ([first, first + 1, 0], cells.min(2))
        };
        let mut terms = [0; 3];
        for (term, coordinate) in terms.iter_mut().zip(coordinates).take(count as usize) {
            *term = self.cell_blocks.term(axis, coordinate);
        }
        Beside { terms, count: count as usize }
    }

    /// Cells that may hold centres less than `interaction_range` [m] away from `position` along each axis, if there are any.
    #[inline(always)]
    pub(super) fn touched(&self, position: Vector3, interaction_range: f64) -> Option<Touched> {
        let mut touched = [(0, 0); 3];
        for axis in 0..3 {
            let range = self.straightening[axis] * interaction_range;
            let (low, high) = (position[axis] - range, position[axis] + range);
            if high < self.bounds[axis][0] || low > self.bounds[axis][1] {
                return None;
            }
            let coordinate = |at: f64| floor((at - self.lower[axis]) * self.inverse_width[axis]);
            let (first, last) = (coordinate(low), coordinate(high));
            let cells = i64::from(self.cell_blocks.along(axis));
            touched[axis] = if !self.periodic[axis] {
                let (first, last) = (first.clamp(0, cells - 1), last.clamp(0, cells - 1));
                (first as u32, (last - first + 1) as u32)
            } else if last.saturating_sub(first) >= cells - 1 {
                (0, cells as u32)
            } else {
                // Most are within already; a division is slow.
                let within = if (0..cells).contains(&first) { first } else { first.rem_euclid(cells) };
                (within as u32, (last - first + 1) as u32)
            };
        }
        Some(touched)
    }

    /// Number of cells along an axis.
    #[inline(always)]
    pub(super) fn along(&self, axis: usize) -> u32 {
        self.cell_blocks.along(axis)
    }
}

/// Not `f64::floor`, which is a function call on processors without an instruction for it.
#[inline(always)]
fn floor(value: f64) -> i64 {
    let cut = value as i64;
    cut.saturating_sub(i64::from(cut as f64 > value))
}

/// Numbers of cells along each axis if they are at least these `widths` [m] wide, unless there would be more
/// than `most` of them.
fn cells_within(spans: [[f64; 2]; 3], widths: [f64; 3], most: f64) -> Option<[u32; 3]> {
    // A NaN counts as one cell.
    let along = |widths: f64| if widths >= 1.0 { widths.min(1e9).floor() } else { 1.0 };
    let cells: [f64; 3] = std::array::from_fn(|axis| along((spans[axis][1] - spans[axis][0]) / widths[axis]));
    let padded = cells.map(CellBlocks::padded);
    (padded[0] * padded[1] * padded[2] <= most).then(|| cells.map(|count| count as u32))
}

/// Numbers of cells along each axis, at least these `widths` [m] wide and as much wider as it takes for no
/// more than `most` of them.
fn wider_cells_within(spans: [[f64; 2]; 3], widths: [f64; 3], most: f64) -> [u32; 3] {
    let longest = spans.iter().map(|[lower, upper]| upper - lower).fold(0.0, f64::max);
    // The longest side alone must not have too many. An infinite span gets one cell.
    let mut widths = widths.map(|width| width.max(longest / most));
    while widths.iter().all(|width| width.is_finite()) {
        if let Some(cells) = cells_within(spans, widths, most) {
            return cells;
        }
        widths = widths.map(|width| 1.1 * width);
    }
    [1; 3]
}

/// The interval along an axis [m] within `bounds` that contains nearly all of the `sample`: no cells are wasted on the space
/// between the sample and a few particles far away.
fn crowded(sample: &[Vector3], axis: usize, bounds: [f64; 2]) -> [f64; 2] {
    let mut along: Vec<f64> = sample.iter().map(|position| position[axis]).collect();
    along.sort_unstable_by(f64::total_cmp);
    let few = along.len() / 50;
    let (Some(low), Some(high)) = (along.get(few), along.iter().nth_back(few)) else { return bounds };
    let beyond = 0.2 * (high - low);
    [bounds[0].max(low - beyond), bounds[1].min(high + beyond)]
}
