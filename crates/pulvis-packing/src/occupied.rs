//! Where spheres are, to find room for others.

use std::collections::HashMap;

use pulvis_boundary::Domain;
use pulvis_math::Vector3;

/// Cells on either side of the origin that have numbers.
const MOST_CELLS: f64 = 1e18;

/// Spheres, found by the cell that their centre lies in. Periodic domains are not tilted.
#[derive(Clone, Debug)]
pub struct OccupiedSpace {
    width: f64,
    domain: Domain,
    cells: HashMap<[i64; 3], Vec<(Vector3, f64)>>,
}

impl OccupiedSpace {
    /// Nothing yet; no sphere is wider than `width` [m].
    pub fn new(width: f64, domain: Domain) -> Self {
        Self { width, domain, cells: HashMap::new() }
    }

    fn cell(&self, position: Vector3) -> [i64; 3] {
        // Far beyond all digits of a position; a neighbour of the last cell still has a number.
        [0, 1, 2].map(|axis| (position[axis] / self.width).floor().clamp(-MOST_CELLS, MOST_CELLS) as i64)
    }

    /// Takes a sphere in, by its centre and radius [m].
    pub fn add(&mut self, centre: Vector3, radius: f64) {
        let centre = self.domain.wrapped(centre);
        let cell = self.cell(centre);
        self.cells.entry(cell).or_default().push((centre, radius));
    }

    /// Whether a sphere, by its centre and radius [m], overlaps none of the spheres or their images.
    pub fn is_free(&self, centre: Vector3, radius: f64) -> bool {
        // The images of the centre that can see spheres across a periodic boundary.
        let shifts = |axis: usize| match self.domain.period(axis) {
            Some(period) => vec![-period, 0.0, period],
            None => vec![0.0],
        };
        let centre = self.domain.wrapped(centre);
        let (xs, ys, zs) = (shifts(0), shifts(1), shifts(2));
        xs.iter().all(|&x| {
            ys.iter().all(|&y| zs.iter().all(|&z| self.is_free_image(centre + Vector3::new(x, y, z), radius)))
        })
    }

    fn is_free_image(&self, centre: Vector3, radius: f64) -> bool {
        let [x, y, z] = self.cell(centre);
        let overlaps = |(other, size): &(Vector3, f64)| {
            let apart = radius + size;
            (*other - centre).norm_squared() < apart * apart
        };
        (x - 1..=x + 1).all(|x| {
            (y - 1..=y + 1).all(|y| {
                (z - 1..=z + 1)
                    .all(|z| self.cells.get(&[x, y, z]).is_none_or(|cell| !cell.iter().any(overlaps)))
            })
        })
    }
}
