//! Light, crevices and distance.

use super::SphereScene;
use super::camera::{Camera, shown};
use super::depth::{DepthBuffer, EDGE, NOTHING, SAMPLES};
use super::selection::Selection;
use crate::Colour;

/// Direction to the lamp: left, above and before the picture (x right, y down, z towards the eye), unit length.
const LAMP: [f64; 3] = [-0.408, -0.557, 0.723];

/// Shares of light that come from everywhere and from the lamp.
const AMBIENT: f64 = 0.52;
const LAMBERT: f64 = 0.62;

/// Strength of the small highlight that makes spheres look round, and its sharpness.
const HIGHLIGHT: f64 = 0.18;
const SHARPNESS: i32 = 24;

/// Darkening of fully enclosed crevices, and fading of what is farthest.
const OCCLUSION: f64 = 0.62;
const FADING: f64 = 0.16;

/// Places around a pixel that are asked whether they stand before it: golden-angle spiral, evenly dense in a disc.
const PROBES: usize = 20;

/// Colours of all pixels (red, green, blue).
pub(super) fn shade(
    depth: &DepthBuffer,
    scene: &SphereScene<'_>,
    selection: &Selection,
    camera: &Camera,
    range: [f64; 2],
) -> Vec<u8> {
    let palette: Vec<Colour> = scene.values.iter().map(|&value| scene.colour(value, range)).collect();
    let light = Light { depth, scene, camera, palette, probes: probes(scene, selection, camera) };
    let (width, height) = (depth.width / SAMPLES, depth.height / SAMPLES);
    let mut pixels = Vec::with_capacity(3 * width * height);
    for row in 0..height {
        for column in 0..width {
            let mut sum = [0.0; 3];
            let open = light.openness(column, row);
            for sample in 0..SAMPLES * SAMPLES {
                let x = column * SAMPLES + sample % SAMPLES;
                let y = row * SAMPLES + sample / SAMPLES;
                let colour = light.sample(x, y, open);
                sum.iter_mut().zip(colour).for_each(|(sum, part)| *sum += part);
            }
            let count = (SAMPLES * SAMPLES) as f64;
            pixels.extend(sum.map(|part| (part / count).round().clamp(0.0, 255.0) as u8));
        }
    }
    pixels
}

struct Light<'a> {
    depth: &'a DepthBuffer,
    scene: &'a SphereScene<'a>,
    camera: &'a Camera,
    palette: Vec<Colour>,
    probes: Probes,
}

struct Probes {
    /// Distances right and down [sample].
    offsets: [(isize, isize); PROBES],
    /// Radius of the probed disc \[pixel\].
    reach: f32,
}

/// Probes reach about as far as a typical sphere, since that is the size of the crevices.
fn probes(scene: &SphereScene<'_>, selection: &Selection, camera: &Camera) -> Probes {
    let radii: Vec<f64> = shown(scene, selection).map(|(_, _, radius)| camera.radius(radius)).collect();
    let mean = radii.iter().sum::<f64>() / radii.len().max(1) as f64;
    let reach = (1.2 * mean).clamp(2.0, 60.0);
    let offsets = std::array::from_fn(|number| {
        let radius = reach * SAMPLES as f64 * ((number as f64 + 0.5) / PROBES as f64).sqrt();
        let angle = 2.399_963_229_728_653 * number as f64;
        ((radius * angle.cos()).round() as isize, (radius * angle.sin()).round() as isize)
    });
    Probes { offsets, reach: reach as f32 }
}

impl Light<'_> {
    /// Share of the sky that a pixel sees, from the depths around it: 1 in the open, 0 in a closed crevice.
    fn openness(&self, column: usize, row: usize) -> f64 {
        let (x, y) = (column * SAMPLES + SAMPLES / 2, row * SAMPLES + SAMPLES / 2);
        let here = self.depth.depth[y * self.depth.width + x];
        if here.is_infinite() {
            return 1.0;
        }
        let mut hidden = 0.0;
        for (dx, dy) in self.probes.offsets {
            let (Some(x), Some(y)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else { continue };
            if x >= self.depth.width || y >= self.depth.height {
                continue;
            }
            // A sphere just before the pixel hides it fully; one far before it is another layer and hides less.
            let before = (here - self.depth.depth[y * self.depth.width + x]) / self.probes.reach;
            if before > 0.0 {
                hidden += (before / 0.9).min(1.0) / (1.0 + (before - 2.5).max(0.0) * 0.4);
            }
        }
        f64::from(1.0 - hidden / PROBES as f32)
    }

    /// Colour of a sample, parts from 0 to 255.
    fn sample(&self, x: usize, y: usize, open: f64) -> [f64; 3] {
        let place = y * self.depth.width + x;
        let owner = self.depth.owner[place];
        if owner == NOTHING {
            return [255.0; 3];
        }
        let depth = f64::from(self.depth.depth[place]);
        let [near, far] = self.camera.depths;
        let distance = ((depth - near) / (far - near).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        if owner == EDGE {
            return [70.0 + 70.0 * distance; 3];
        }
        let number = owner as usize;
        let centre = self.camera.project(self.scene.centres[number]);
        let radius = self.camera.radius(self.scene.radii[number]);
        let samples = SAMPLES as f64;
        let nx = ((x as f64 + 0.5) / samples - centre.x) / radius;
        let ny = ((y as f64 + 0.5) / samples - centre.y) / radius;
        let nz = (1.0 - nx * nx - ny * ny).max(0.0).sqrt();
        let towards = (nx * LAMP[0] + ny * LAMP[1] + nz * LAMP[2]).max(0.0);
        // The mirrored lamp's part towards the eye (z).
        let mirrored = (2.0 * towards * nz - LAMP[2]).max(0.0);
        let crevice = 1.0 - OCCLUSION * (1.0 - open);
        let strength = (AMBIENT + LAMBERT * towards) * crevice;
        let shine = 255.0 * HIGHLIGHT * mirrored.powi(SHARPNESS) * crevice;
        let Colour { red, green, blue } = self.palette[number];
        [red, green, blue].map(|part| {
            let lit = (f64::from(part) * strength + shine).min(255.0);
            lit + FADING * distance * (255.0 - lit)
        })
    }
}
