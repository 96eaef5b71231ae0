//! Light, crevices and distance.

use super::camera::Camera;
use super::depth::{DepthBuffer, NOTHING, SAMPLES};
use super::scene::Paper;
use super::shapes::Shape;
use super::vector::Vector;
use crate::Colour;
use pulvis_parallel::thread_pool::ThreadPool;

/// Direction to the lamp: left, above and before the picture (x right, y down, z away from the eye), unit length.
const LAMP: Vector = Vector([-0.408, -0.557, -0.723]);

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
const PROBES: usize = 24;

/// How much the share of probes that stand above the surface counts, and how fast it falls with the distance.
const STRENGTH: f64 = 2.2;
const FALL: f64 = 1.0;

/// Rows of pixels that one thread shades in one go.
const ROWS: usize = 16;

/// What is shaded: the shapes, each with a colour, and how many of them, the first ones, have light and shadow; the others are
/// lines.
pub(super) struct Shaded<'a> {
    pub(super) shapes: &'a [Shape],
    pub(super) colours: &'a [Colour],
    pub(super) solid: usize,
    /// Radius of a typical sphere in the picture \[pixel\].
    pub(super) typical: f64,
    pub(super) paper: Paper,
}

/// Colours of all pixels (red, green, blue).
pub(super) fn shade(
    depth: &DepthBuffer,
    shaded: &Shaded<'_>,
    camera: &Camera,
    threads: &ThreadPool,
) -> Vec<u8> {
    let light = Light { depth, shaded, camera, probes: probes(shaded.typical) };
    let (width, height) = (depth.width / SAMPLES, depth.height / SAMPLES);
    let mut pixels = vec![0; 3 * width * height];
    let mut bands: Vec<&mut [u8]> = pixels.chunks_mut(3 * width * ROWS).collect();
    threads.for_each(&mut bands, |band, rows| {
        for (number, pixel) in rows.chunks_exact_mut(3).enumerate() {
            let colour = light.pixel(number % width, band * ROWS + number / width);
            for (part, value) in pixel.iter_mut().zip(colour) {
                *part = value.round().clamp(0.0, 255.0) as u8;
            }
        }
    });
    pixels
}

struct Light<'a> {
    depth: &'a DepthBuffer,
    shaded: &'a Shaded<'a>,
    camera: &'a Camera,
    probes: Probes,
}

struct Probes {
    /// Distances right and down [sample].
    offsets: [(isize, isize); PROBES],
    /// Radius of the probed disc \[pixel\].
    reach: f64,
}

/// Probes reach about as far as a typical sphere, since that is the size of the crevices.
fn probes(typical: f64) -> Probes {
    let reach = (1.2 * typical).clamp(2.0, 60.0);
    let offsets = std::array::from_fn(|number| {
        let radius = reach * SAMPLES as f64 * ((number as f64 + 0.5) / PROBES as f64).sqrt();
        let angle = 2.399_963_229_728_653 * number as f64;
        ((radius * angle.cos()).round() as isize, (radius * angle.sin()).round() as isize)
    });
    Probes { offsets, reach }
}

impl Light<'_> {
    /// Colour of a pixel, parts from 0 to 255.
    fn pixel(&self, column: usize, row: usize) -> [f64; 3] {
        let places: [[usize; 2]; SAMPLES * SAMPLES] = std::array::from_fn(|sample| {
            [column * SAMPLES + sample % SAMPLES, row * SAMPLES + sample / SAMPLES]
        });
        let owners = places.map(|[x, y]| self.depth.owner[y * self.depth.width + x]);
        if owners == [NOTHING; SAMPLES * SAMPLES] {
            return parts(self.shaded.paper.ground());
        }
        // The sky of one sample, of the last that shows a surface, is that of the pixel.
        let solid = places.iter().zip(owners).rev().find(|(_, owner)| (*owner as usize) < self.shaded.solid);
        let open = solid.map_or(1.0, |(&place, owner)| self.openness(place, owner));
        let mut sum = [0.0; 3];
        for ([x, y], owner) in places.into_iter().zip(owners) {
            let colour = self.sample([x, y], owner, open);
            sum.iter_mut().zip(colour).for_each(|(sum, part)| *sum += part);
        }
        sum.map(|part| part / (SAMPLES * SAMPLES) as f64)
    }

    /// Share of the sky that a pixel sees, from the surfaces around it: 1 in the open, 0 in a closed crevice.
    fn openness(&self, [x, y]: [usize; 2], owner: u32) -> f64 {
        if owner as usize >= self.shaded.solid {
            return 1.0;
        }
        let here = self.point([x, y]);
        let normal = self.shaded.shapes[owner as usize].normal(here);
        let reach = self.probes.reach / self.camera.scale_at(here.0[2]);
        let mut hidden = 0.0;
        for (dx, dy) in self.probes.offsets {
            let (Some(x), Some(y)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else { continue };
            if x >= self.depth.width
                || y >= self.depth.height
                || self.depth.owner[y * self.depth.width + x] as usize >= self.shaded.solid
            {
                continue;
            }
            // What stands above the surface hides the sky, the less the farther it is; the surface itself, which bends away,
            // does not.
            let away = self.point([x, y]).minus(here);
            let above = normal.dot(away);
            if above > 0.0 {
                let square = away.dot(away);
                hidden += above / square.sqrt() / (1.0 + FALL * square / (reach * reach));
            }
        }
        (1.0 - STRENGTH * hidden / PROBES as f64).max(0.0)
    }

    /// The place of a sample in coordinates of the camera.
    fn point(&self, [x, y]: [usize; 2]) -> Vector {
        let at = |sample: usize| (sample as f64 + 0.5) / SAMPLES as f64;
        self.camera.ray(at(x), at(y)).at(f64::from(self.depth.depth[y * self.depth.width + x]))
    }

    /// Colour of a sample, parts from 0 to 255.
    fn sample(&self, [x, y]: [usize; 2], owner: u32, open: f64) -> [f64; 3] {
        let ground = parts(self.shaded.paper.ground());
        if owner == NOTHING {
            return ground;
        }
        let number = owner as usize;
        let depth = f64::from(self.depth.depth[y * self.depth.width + x]);
        let [near, far] = self.camera.depths;
        let distance = ((depth - near) / (far - near).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let colour = parts(self.shaded.colours[number]);
        if number >= self.shaded.solid {
            return mix(colour, ground, 0.4 * distance);
        }
        let at = |sample: usize| (sample as f64 + 0.5) / SAMPLES as f64;
        let ray = self.camera.ray(at(x), at(y));
        let normal = self.shaded.shapes[number].normal(ray.at(depth));
        let towards = normal.dot(LAMP);
        let lit = towards.max(0.0);
        // The mirrored lamp's part towards the eye.
        let to_eye = ray.direction.times(-1.0 / ray.direction.norm());
        let mirrored = (2.0 * lit * normal.dot(to_eye) - LAMP.dot(to_eye)).max(0.0);
        let crevice = 1.0 - OCCLUSION * (1.0 - open);
        let strength = (AMBIENT + LAMBERT * lit) * crevice;
        let shine = 255.0 * HIGHLIGHT * mirrored.powi(SHARPNESS) * crevice;
        mix(colour.map(|part| (part * strength + shine).min(255.0)), ground, FADING * distance)
    }
}

fn parts(Colour { red, green, blue }: Colour) -> [f64; 3] {
    [red, green, blue].map(f64::from)
}

fn mix(from: [f64; 3], to: [f64; 3], share: f64) -> [f64; 3] {
    std::array::from_fn(|part| from[part] + share * (to[part] - from[part]))
}
