//! Which shape each sample of the picture shows.
//!
//! The picture is cut into bands of tiles. Threads take bands, and a band is drawn by one thread alone, so that the picture
//! does not depend on their number. Within a tile shapes come the nearest first, until the next one lies behind everything
//! that the tile shows: in a dense packing most spheres cost nothing.

use super::camera::Camera;
use super::shapes::Shape;
use pulvis_parallel::thread_pool::ThreadPool;

/// Samples per pixel in each direction.
pub(super) const SAMPLES: usize = 2;

/// The mark of samples that show nothing.
pub(super) const NOTHING: u32 = u32::MAX;

/// Side of a tile [sample]: a multiple of [`SAMPLES`].
const TILE: usize = 32;

/// After so many shapes it is looked up how deep a tile is.
const LOOK: usize = 4;

/// Depth and owner of every sample.
#[derive(Debug)]
pub(super) struct DepthBuffer {
    /// Samples per row.
    pub(super) width: usize,
    pub(super) height: usize,
    /// Depth of what is seen \[m\]; infinite for the background.
    pub(super) depth: Vec<f32>,
    /// Number of the shape that is seen, or [`NOTHING`].
    pub(super) owner: Vec<u32>,
}

/// A shape that is in the picture.
struct Placed {
    number: u32,
    nearest: f32,
    /// Columns and rows from – to, the last one included [sample].
    columns: [usize; 2],
    rows: [usize; 2],
}

/// Rows of tiles, drawn by one thread.
struct Band<'a> {
    depth: &'a mut [f32],
    owner: &'a mut [u32],
}

impl DepthBuffer {
    /// Draws all shapes into a picture of this size \[pixel\].
    pub(super) fn draw(
        shapes: &[Shape],
        camera: &Camera,
        [width, height]: [u32; 2],
        threads: &ThreadPool,
    ) -> Self {
        let [width, height] = [width, height].map(|side| side as usize * SAMPLES);
        let placed = place(shapes, camera, [width, height]);
        let tiles = Tiles::of(&placed, width, height);
        let mut depth = vec![f32::INFINITY; width * height];
        let mut owner = vec![NOTHING; width * height];
        let rows = depth.chunks_mut(width * TILE).zip(owner.chunks_mut(width * TILE));
        let mut bands: Vec<_> = rows.map(|(depth, owner)| Band { depth, owner }).collect();
        threads.for_each(&mut bands, |row, band| {
            for column in 0..tiles.across {
                let inside = tiles.of_tile(row, column).iter().map(|&index| &placed[index as usize]);
                let tile = Tile { width, left: column * TILE, top: row * TILE };
                tile.draw(band, inside, shapes, camera);
            }
        });
        Self { width, height, depth, owner }
    }
}

/// Shapes that are in the picture, the nearest first.
fn place(shapes: &[Shape], camera: &Camera, [width, height]: [usize; 2]) -> Vec<Placed> {
    let samples = SAMPLES as f64;
    let mut placed: Vec<Placed> = shapes
        .iter()
        .enumerate()
        .filter_map(|(number, shape)| {
            let [[left, right], [top, bottom]] = shape.bounds(camera);
            let columns = covered(left * samples, right * samples, width)?;
            let rows = covered(top * samples, bottom * samples, height)?;
            // Rounded down, so that no part of the shape is nearer.
            let nearest = (shape.nearest() as f32).next_down();
            Some(Placed { number: number as u32, nearest, columns, rows })
        })
        .collect();
    placed.sort_by(|a, b| a.nearest.total_cmp(&b.nearest));
    placed
}

/// The places of shapes by tile.
struct Tiles {
    across: usize,
    /// Where the shapes of each tile begin.
    starts: Vec<usize>,
    places: Vec<u32>,
}

impl Tiles {
    fn of(placed: &[Placed], width: usize, height: usize) -> Self {
        let (across, down) = (width.div_ceil(TILE), height.div_ceil(TILE));
        let tiles_of = |shape: &Placed| {
            let [left, right] = shape.columns.map(|column| column / TILE);
            let [top, bottom] = shape.rows.map(|row| row / TILE);
            (top..=bottom).flat_map(move |row| (left..=right).map(move |column| row * across + column))
        };
        let mut starts = vec![0; across * down + 1];
        for tile in placed.iter().flat_map(tiles_of) {
            starts[tile + 1] += 1;
        }
        for tile in 0..across * down {
            starts[tile + 1] += starts[tile];
        }
        let mut next = starts.clone();
        let mut places = vec![0; starts[across * down]];
        for (index, shape) in placed.iter().enumerate() {
            for tile in tiles_of(shape) {
                places[next[tile]] = index as u32;
                next[tile] += 1;
            }
        }
        Self { across, starts, places }
    }

    /// Places of the shapes in a tile, the nearest first.
    fn of_tile(&self, row: usize, column: usize) -> &[u32] {
        let tile = row * self.across + column;
        &self.places[self.starts[tile]..self.starts[tile + 1]]
    }
}

/// A tile of the picture [sample].
struct Tile {
    /// Width of the picture.
    width: usize,
    left: usize,
    top: usize,
}

impl Tile {
    fn draw<'a>(
        &self,
        band: &mut Band<'_>,
        inside: impl Iterator<Item = &'a Placed>,
        shapes: &[Shape],
        camera: &Camera,
    ) {
        let mut deepest = f32::INFINITY;
        for (count, placed) in inside.enumerate() {
            if count % LOOK == 0 && count > 0 {
                deepest = self.deepest(band);
            }
            if placed.nearest > deepest {
                return;
            }
            self.draw_shape(band, placed, &shapes[placed.number as usize], camera);
        }
    }

    fn draw_shape(&self, band: &mut Band<'_>, placed: &Placed, shape: &Shape, camera: &Camera) {
        let height = band.depth.len() / self.width;
        let [top, bottom] =
            [placed.rows[0].max(self.top), (placed.rows[1] + 1).min(self.top + height)].map(|y| y - self.top);
        let left = placed.columns[0].max(self.left);
        let right = (placed.columns[1] + 1).min(self.left + TILE).min(self.width);
        let at = |sample: usize| (sample as f64 + 0.5) / SAMPLES as f64;
        for row in top..bottom {
            for column in left..right {
                let place = row * self.width + column;
                if band.depth[place] <= placed.nearest {
                    continue;
                }
                let ray = camera.ray(at(column), at(self.top + row));
                let Some(depth) = shape.depth(&ray) else { continue };
                let depth = depth as f32;
                if depth < band.depth[place] {
                    band.depth[place] = depth;
                    band.owner[place] = placed.number;
                }
            }
        }
    }

    /// Depth of the deepest sample.
    fn deepest(&self, band: &Band<'_>) -> f32 {
        let right = (self.left + TILE).min(self.width);
        let rows = band.depth.chunks_exact(self.width);
        rows.flat_map(|row| &row[self.left..right]).fold(0.0, |deepest, &depth| deepest.max(depth))
    }
}

/// Samples whose middles lie between these places, and one more to either side for round-off, cut to `0..count`.
fn covered(from: f64, to: f64, count: usize) -> Option<[usize; 2]> {
    let low = (from - 1.5).ceil().max(0.0);
    let high = (to + 0.5).floor().min(count as f64 - 1.0);
    (low <= high).then_some([low as usize, high as usize])
}
