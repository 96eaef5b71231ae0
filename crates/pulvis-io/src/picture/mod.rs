//! Pictures of packings: spheres and tubes coloured by a quantity, as PNG, drawn in software on any machine.
//!
//! Light comes from above the viewer's left shoulder; crevices are darkened and what lies far away fades a little, which is
//! what makes a packing readable. In perspective the scale bar holds in the middle of the scene; with parallel lines of sight
//! it holds everywhere.
//!
//! The view holds the boxes and cylinders and the spheres near them, without these the bulk of the spheres; how many lie
//! outside or have no finite position stands in a note on the picture.
//!
//! The same scene gives the same pixels for any number of threads.
//!
//! ```
//! use pulvis_io::picture::{OutlineBox, Scene, View, render};
//!
//! # fn main() -> Result<(), pulvis_io::IoError> {
//! # let scratch = tempfile::tempdir().expect("a temporary folder");
//! # let folder = scratch.path();
//! let scene = Scene {
//!     title: "two spheres",
//!     bar_label: "speed [m/s]",
//!     edges: &OutlineBox { low: [-0.002, -0.001, -0.001], high: [0.002, 0.001, 0.001] }.edges(),
//!     view: View::OBLIQUE,
//!     ..Scene::new(&[[-0.001, 0.0, 0.0], [0.001, 0.0, 0.0]], &[0.001, 0.0008], &[0.1, 0.3])
//! };
//! let threads = 2;
//! render(&scene, threads)?.write(&folder.join("spheres.png"))?;
//! # Ok(())
//! # }
//! ```

mod bar;
mod camera;
mod depth;
mod film;
mod furniture;
mod outline;
mod scene;
mod selection;
mod shade;
mod shapes;
mod vector;
mod view;

use crate::plot::raster;
use crate::{IoError, file};
use camera::Camera;
use depth::DepthBuffer;
use pulvis_parallel::thread_pool::ThreadPool;
use selection::Selection;
use shapes::Shape;
use std::path::Path;
use vector::Vector;

pub use film::Film;
pub use outline::{Edge, OutlineBox, OutlineCylinder};
pub use scene::{Paint, Paper, Scene, Tube};
pub use view::{Projection, View};

/// Half the width of an outline in the middle of the scene \[pixel\].
const OUTLINE: f64 = 0.7;

/// Outlines are cut into pieces of this share of the scene's depth: a long one would keep most tiles busy in vain.
const PIECE: f64 = 1.0 / 32.0;

/// A drawn picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    height: u32,
    /// Red, green and blue of the pixels, row by row.
    pixels: Vec<u8>,
    /// Pixels to the inch on paper.
    dpi: u32,
}

impl Picture {
    /// Width and height \[pixel\].
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Red, green and blue of all pixels, row by row from the top.
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// Sets the number of pixels to the inch on paper, 144 unless told otherwise; the pixels stay as they are.
    #[must_use]
    pub fn dpi(self, dpi: u32) -> Self {
        Self { dpi, ..self }
    }

    /// Writes the picture into a PNG file.
    ///
    /// # Errors
    /// An ending other than `png`, or a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), IoError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        if !ending.eq_ignore_ascii_case("png") {
            let (what, given, known) = ("picture", ending.into_owned(), "png".to_owned());
            return Err(IoError::UnknownFormat { what, given, known });
        }
        file::replace(path, |out| raster::encode(out, &self.pixels, self.size(), self.dpi))
    }
}

/// Draws a scene with this number of threads, on which no pixel depends.
///
/// # Errors
/// Columns of unequal length, or a size that cannot be drawn.
pub fn render(scene: &Scene<'_>, threads: usize) -> Result<Picture, IoError> {
    scene.check()?;
    // Where the system starts no further threads, this one draws the same picture.
    let threads = ThreadPool::of(threads).unwrap_or_default();
    let range = scene.value_range();
    let mut selection = Selection::of(scene);
    let camera = Camera::fit(scene, &selection);
    let enlarged =
        camera::shown(scene, &selection).any(|(_, centre, radius)| camera.enlarges(centre, radius));
    selection.enlarged = enlarged;
    // The note on it takes room of its own.
    let camera = Camera::fit(scene, &selection);
    let Collected { shapes, colours, solid, typical } = collect(scene, &selection, &camera, range);
    let depth = DepthBuffer::draw(&shapes, &camera, [scene.width, scene.height], &threads);
    let shaded = shade::Shaded { shapes: &shapes, colours: &colours, solid, typical, paper: scene.paper };
    let mut pixels = shade::shade(&depth, &shaded, &camera, &threads);
    furniture::draw(&mut pixels, scene, &selection, &camera, range)?;
    Ok(Picture { width: scene.width, height: scene.height, pixels, dpi: raster::DPI })
}

/// What can be seen: first what is solid, then lines.
struct Collected {
    shapes: Vec<Shape>,
    colours: Vec<crate::Colour>,
    solid: usize,
    /// Mean radius of the spheres in the picture \[pixel\].
    typical: f64,
}

fn collect(scene: &Scene<'_>, selection: &Selection, camera: &Camera, range: [f64; 2]) -> Collected {
    let (mut shapes, mut colours) = (Vec::new(), Vec::new());
    let palette = scene.sphere_colours(range);
    let mut radii = 0.0;
    for (number, centre, radius) in camera::shown(scene, selection) {
        let centre = camera.to_camera(Vector(centre));
        let radius = camera.visible_radius(radius, centre.0[2]);
        radii += radius * camera.scale_at(centre.0[2]);
        shapes.push(Shape::Ball { centre, radius });
        colours.push(palette[number]);
    }
    let typical = radii / shapes.len().max(1) as f64;
    let is_finite = |end: &[f64; 3]| end.iter().all(|x| x.abs() < outline::LARGEST);
    for tube in scene.tubes.iter().filter(|tube| tube.radius > 0.0 && tube.ends.iter().all(is_finite)) {
        let [from, to] = tube.ends.map(|end| camera.to_camera(Vector(end)));
        let radius = camera.visible_radius(tube.radius, from.0[2]);
        shapes.push(Shape::Tube { from, axis: to.minus(from), radius });
        colours.push(scene.tube_colour(tube, range));
    }
    let solid = shapes.len();
    let sides = scene.cylinders.iter().flat_map(|cylinder| cylinder.sides(camera));
    let longest = PIECE * (camera.depths[1] - camera.depths[0]).max(f64::MIN_POSITIVE);
    for edge in scene.all_edges().into_iter().chain(sides) {
        let [from, to] = edge.map(|end| camera.to_camera(Vector(end)));
        let axis = to.minus(from);
        let pieces = (axis.norm() / longest).ceil().clamp(1.0, 1000.0);
        let axis = axis.times(1.0 / pieces);
        for piece in 0..pieces as usize {
            let from = from.plus(axis.times(piece as f64));
            shapes.push(Shape::Tube { from, axis, radius: OUTLINE / camera.scale });
        }
    }
    colours.resize(shapes.len(), scene.paper.outline());
    Collected { shapes, colours, solid, typical }
}

#[cfg(test)]
mod tests;
