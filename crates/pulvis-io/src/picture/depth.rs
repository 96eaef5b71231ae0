//! Which sphere or line each sample of the picture shows.

use super::SphereScene;
use super::camera::{Camera, Projected, shown};
use super::selection::Selection;

/// Samples per pixel in each direction.
pub(super) const SAMPLES: usize = 2;

/// Marks of samples that show no sphere.
pub(super) const NOTHING: u32 = u32::MAX;
pub(super) const EDGE: u32 = u32::MAX - 1;

/// Width of the edges of boxes [sample].
const EDGE_WIDTH: f64 = 2.6;

/// Depth and owner of every sample.
#[derive(Debug)]
pub(super) struct DepthBuffer {
    /// Samples per row.
    pub(super) width: usize,
    pub(super) height: usize,
    /// Depth of what is seen \[pixel\]; infinite for the background.
    pub(super) depth: Vec<f32>,
    /// Number of the sphere that is seen, [`EDGE`] or [`NOTHING`].
    pub(super) owner: Vec<u32>,
}

impl DepthBuffer {
    pub(super) fn new(width: u32, height: u32) -> Self {
        let (width, height) = (width as usize * SAMPLES, height as usize * SAMPLES);
        let count = width * height;
        Self { width, height, depth: vec![f32::INFINITY; count], owner: vec![NOTHING; count] }
    }

    /// Draws the chosen spheres, the nearest first, so that most of the hidden ones cost one comparison per sample.
    pub(super) fn draw_spheres(&mut self, scene: &SphereScene<'_>, selection: &Selection, camera: &Camera) {
        let mut spheres: Vec<(u32, Projected, f64)> = shown(scene, selection)
            .map(|(number, centre, radius)| (number as u32, camera.project(centre), camera.radius(radius)))
            .collect();
        spheres.sort_by(|a, b| (a.1.depth - a.2).total_cmp(&(b.1.depth - b.2)));
        for (number, centre, radius) in spheres {
            self.draw_sphere(number, centre, radius);
        }
    }

    fn draw_sphere(&mut self, number: u32, centre: Projected, radius: f64) {
        let samples = SAMPLES as f64;
        let (x, y, reach) = (centre.x * samples, centre.y * samples, radius * samples);
        let nearest = (centre.depth - radius) as f32;
        let Some((top, bottom)) = span(y, reach, self.height) else { return };
        for row in top..=bottom {
            let dy = (row as f64 + 0.5 - y) / reach;
            let half = reach * (1.0 - dy * dy).max(0.0).sqrt();
            let Some((left, right)) = span(x, half, self.width) else { continue };
            for place in row * self.width + left..=row * self.width + right {
                if self.depth[place] <= nearest {
                    continue;
                }
                let dx = ((place - row * self.width) as f64 + 0.5 - x) / reach;
                let height = 1.0 - dx * dx - dy * dy;
                if height < 0.0 {
                    continue;
                }
                let depth = (centre.depth - radius * height.sqrt()) as f32;
                if depth < self.depth[place] {
                    self.depth[place] = depth;
                    self.owner[place] = number;
                }
            }
        }
    }

    /// Draws edges, hidden where spheres are nearer.
    pub(super) fn draw_edges(&mut self, edges: &[[[f64; 3]; 2]], camera: &Camera) {
        for &[from, to] in edges {
            self.draw_edge(camera.project(from), camera.project(to));
        }
    }

    /// Draws a line as dots half a sample apart.
    fn draw_edge(&mut self, from: Projected, to: Projected) {
        let samples = SAMPLES as f64;
        let length = (to.x - from.x).hypot(to.y - from.y) * samples;
        // The camera fits every outline, so no edge is longer than the diagonal; the bound is for the arithmetic only.
        let steps = (2.0 * length).clamp(1.0, 1.0e6) as usize;
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let mix = |a: f64, b: f64| a + share * (b - a);
            let (x, y) = (mix(from.x, to.x) * samples, mix(from.y, to.y) * samples);
            let depth = mix(from.depth, to.depth) as f32;
            let half = 0.5 * EDGE_WIDTH;
            let (Some((top, bottom)), Some((left, right))) =
                (span(y, half, self.height), span(x, half, self.width))
            else {
                continue;
            };
            for place in (top..=bottom).flat_map(|row| row * self.width + left..=row * self.width + right) {
                if depth < self.depth[place] {
                    self.depth[place] = depth;
                    self.owner[place] = EDGE;
                }
            }
        }
    }
}

/// Samples whose middles lie within `reach` of `centre`, cut to `0..count`.
fn span(centre: f64, reach: f64, count: usize) -> Option<(usize, usize)> {
    let low = (centre - reach - 0.5).ceil().max(0.0);
    let high = (centre + reach - 0.5).floor().min(count as f64 - 1.0);
    (low <= high).then_some((low as usize, high as usize))
}
