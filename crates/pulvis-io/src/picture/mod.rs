//! Pictures of packings: spheres coloured by a quantity, as PNG, drawn in software on any machine.
//!
//! The view is orthographic, so that sizes can be compared everywhere in the picture. Light comes from above the viewer's
//! left shoulder; crevices are darkened and what lies far away fades a little, which is what makes a packing readable.
//!
//! The view holds the boxes and cylinders and the spheres near them, without these the bulk of the spheres; how many lie outside or have
//! no finite position stands in a note on the picture.
//!
//! ```
//! use pulvis_io::picture::{OutlineBox, SphereScene, View, render_spheres};
//!
//! # fn main() -> Result<(), pulvis_io::IoError> {
//! # let scratch = tempfile::tempdir().expect("a temporary folder");
//! # let folder = scratch.path();
//! let scene = SphereScene {
//!     title: "two spheres",
//!     bar_label: "speed [m/s]",
//!     boxes: &[OutlineBox { low: [-0.002, -0.001, -0.001], high: [0.002, 0.001, 0.001] }],
//!     view: View::OBLIQUE,
//!     ..SphereScene::new(&[[-0.001, 0.0, 0.0], [0.001, 0.0, 0.0]], &[0.001, 0.0008], &[0.1, 0.3])
//! };
//! render_spheres(&folder.join("spheres.png"), &scene)?;
//! # Ok(())
//! # }
//! ```

mod bar;
mod camera;
mod depth;
mod furniture;
mod outline;
mod selection;
mod shade;

use crate::plot::raster;
use crate::{Colour, ColourMap, IoError, file};
use camera::Camera;
use depth::DepthBuffer;
use selection::Selection;
use std::path::Path;

pub use outline::{OutlineBox, OutlineCylinder};

/// Where one looks from. Neither vector needs unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Direction of looking, from the eye into the scene.
    pub direction: [f64; 3],
    /// What is up in the picture; only its part across `direction` counts.
    pub up: [f64; 3],
}

impl View {
    /// Along +y, z up: a front view.
    pub const FRONT: Self = Self { direction: [0.0, 1.0, 0.0], up: [0.0, 0.0, 1.0] };

    /// Along -z, y up: a plan view.
    pub const TOP: Self = Self { direction: [0.0, 0.0, -1.0], up: [0.0, 1.0, 0.0] };

    /// From the front, the right and above, z up.
    pub const OBLIQUE: Self = Self { direction: [-0.5, 1.0, -0.45], up: [0.0, 0.0, 1.0] };
}

/// What to draw.
#[derive(Clone, Copy, Debug)]
pub struct SphereScene<'a> {
    /// Centre of each sphere \[m\]; spheres with a coordinate or radius that is not finite are left out and counted in a
    /// note.
    pub centres: &'a [[f64; 3]],
    /// Radius of each sphere \[m\].
    pub radii: &'a [f64],
    /// The quantity that gives each sphere its colour; not-a-number is grey. With `classes`, the number of its class.
    pub values: &'a [f64],
    /// Names of classes, of materials for example, each with a colour of its own in place of the colour bar; empty for a
    /// quantity.
    pub classes: &'a [&'a str],
    /// Ends of the colour bar; `None` takes the smallest and largest finite value.
    pub range: Option<[f64; 2]>,
    /// Colours of the range.
    pub colours: ColourMap,
    /// Where one looks from.
    pub view: View,
    /// Size of the picture \[pixel\].
    pub width: u32,
    /// Size of the picture \[pixel\].
    pub height: u32,
    /// Heading; empty for none.
    pub title: &'a str,
    /// Quantity and unit beside the colour bar; empty for a picture without a colour bar.
    pub bar_label: &'a str,
    /// Boxes shown by their edges.
    pub boxes: &'a [OutlineBox],
    /// Cylinders shown by their outlines.
    pub cylinders: &'a [OutlineCylinder],
    /// Whether a bar shows a length in metres.
    pub scale_bar: bool,
}

impl<'a> SphereScene<'a> {
    /// Smallest and largest side of a picture \[pixel\].
    const SIDES: [u32; 2] = [64, 8192];

    /// Spheres seen obliquely, in viridis, 1200 x 900 pixels, without title, colour bar, outlines and scale bar.
    pub fn new(centres: &'a [[f64; 3]], radii: &'a [f64], values: &'a [f64]) -> Self {
        Self {
            centres,
            radii,
            values,
            classes: &[],
            range: None,
            colours: ColourMap::Viridis,
            view: View::OBLIQUE,
            width: 1200,
            height: 900,
            title: "",
            bar_label: "",
            boxes: &[],
            cylinders: &[],
            scale_bar: false,
        }
    }

    fn check(&self) -> Result<(), IoError> {
        let expected = self.centres.len();
        for (column, found) in [("radii", self.radii.len()), ("values", self.values.len())] {
            if found != expected {
                return Err(IoError::ColumnLength {
                    column: column.to_owned(),
                    rows: "spheres",
                    expected,
                    found,
                });
            }
        }
        let (width, height, [least, most]) = (self.width, self.height, Self::SIDES);
        if [width, height].into_iter().any(|side| !(least..=most).contains(&side)) {
            return Err(IoError::PictureSize { width, height, least, most });
        }
        Ok(())
    }

    /// The edges of all outlines.
    fn edges(&self) -> Vec<[[f64; 3]; 2]> {
        let boxes = self.boxes.iter().flat_map(OutlineBox::edges);
        boxes.chain(self.cylinders.iter().flat_map(|cylinder| cylinder.edges(self.view))).collect()
    }

    /// Ends of the colour bar.
    fn value_range(&self) -> [f64; 2] {
        let usable = |range: &[f64; 2]| range.iter().all(|end| end.is_finite()) && range[0] < range[1];
        self.range.filter(usable).unwrap_or_else(|| {
            let finite = self.values.iter().filter(|value| value.is_finite());
            let ends = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &value| {
                [low.min(value), high.max(value)]
            });
            // A single value is shown against zero; no value at all needs some range for the bar.
            let only = Some(ends[0]).filter(|value| value.is_finite() && *value != 0.0);
            let from_zero = only.map_or([0.0, 1.0], |value| [value.min(0.0), value.max(0.0)]);
            if usable(&ends) { ends } else { from_zero }
        })
    }

    /// Colour of a sphere with this value.
    fn colour(&self, value: f64, range: [f64; 2]) -> Colour {
        if self.classes.is_empty() || !value.is_finite() {
            return self.colours.at((value - range[0]) / (range[1] - range[0]));
        }
        Colour::palette(value.max(0.0) as usize)
    }
}

/// Renders the scene into a PNG file.
///
/// # Errors
/// Columns of unequal length, a size that cannot be drawn, an ending other than `png`, or a file that cannot be written.
pub fn render_spheres(path: &Path, scene: &SphereScene<'_>) -> Result<(), IoError> {
    scene.check()?;
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    if !ending.eq_ignore_ascii_case("png") {
        let (what, given, known) = ("picture", ending.into_owned(), "png".to_owned());
        return Err(IoError::UnknownFormat { what, given, known });
    }
    let range = scene.value_range();
    let mut selection = Selection::of(scene);
    let camera = Camera::fit(scene, &selection);
    let enlarged = camera::shown(scene, &selection).any(|(_, _, radius)| camera.enlarges(radius));
    selection.enlarged = enlarged;
    // The note on it takes room of its own.
    let camera = Camera::fit(scene, &selection);
    let mut depth = DepthBuffer::new(scene.width, scene.height);
    depth.draw_spheres(scene, &selection, &camera);
    depth.draw_edges(&scene.edges(), &camera);
    let mut pixels = shade::shade(&depth, scene, &selection, &camera, range);
    furniture::draw(&mut pixels, scene, &selection, &camera, range)?;
    file::replace(path, |out| raster::encode(out, &pixels, [scene.width, scene.height], raster::DPI))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use crate::plot::raster::Decoded;

    /// Colour of a pixel of the rendered scene.
    fn pixels(scene: &SphereScene<'_>) -> impl Fn(u32, u32) -> [u8; 3] + use<> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        render_spheres(&path, scene).unwrap();
        let image = Decoded::open(&path).unwrap();
        move |x, y| image.pixel(x, y)
    }

    #[test]
    fn the_nearer_sphere_hides_the_farther() {
        let centres = [[0.0, 0.0, 0.0], [0.0, -3.0, 0.0]];
        let (radii, values) = ([1.0, 0.5], [0.0, 1.0]);
        let scene = SphereScene {
            view: View::FRONT,
            width: 200,
            height: 200,
            ..SphereScene::new(&centres, &radii, &values)
        };
        let at = pixels(&scene);
        let centre = at(100, 100);
        assert!(centre[0] > centre[2], "the small yellow sphere is in front: {centre:?}");
        let beside = at(40, 100);
        assert!(beside[2] > beside[1], "the large violet sphere shows beside it: {beside:?}");
        assert_eq!(at(2, 2), [255; 3], "the background is white");
        let behind = SphereScene { view: View { direction: [0.0, -1.0, 0.0], ..View::FRONT }, ..scene };
        let centre = pixels(&behind)(100, 100);
        assert!(centre[2] > centre[1], "seen from behind it is hidden: {centre:?}");
    }

    #[test]
    fn strange_scenes_are_drawn_without_panic() {
        let nan = f64::NAN;
        let centres = [[nan, 0.0, 0.0], [0.0; 3], [1.0, 0.0, f64::INFINITY], [1.0e200, 0.0, 0.0]];
        let radii = [1.0, 1.0, 1.0, -1.0];
        let values = [0.0, nan, f64::INFINITY, 1.0];
        let upright = View { direction: [0.0, 0.0, 1.0], up: [0.0, 0.0, 5.0] };
        let nowhere = View { direction: [0.0; 3], up: [nan; 3] };
        for view in [View::OBLIQUE, upright, nowhere] {
            let boxes = [OutlineBox { low: [nan; 3], high: [1.0; 3] }];
            let small = SphereScene {
                width: 64,
                height: 64,
                bar_label: "v",
                title: "t",
                view,
                boxes: &boxes,
                ..SphereScene::new(&centres, &radii, &values)
            };
            let _ = pixels(&small);
            let _ = pixels(&SphereScene { centres: &[], radii: &[], values: &[], ..small });
            let _ = pixels(&SphereScene { classes: &["a", "b"], scale_bar: true, width: 300, ..small });
        }
    }

    /// Pixels in the colour of notes.
    fn note_pixels(scene: &SphereScene<'_>) -> usize {
        let at = pixels(scene);
        let all = (0..scene.height).flat_map(|y| (0..scene.width).map(move |x| (x, y)));
        all.filter(|&(x, y)| at(x, y)[0] > at(x, y)[1].saturating_add(90)).count()
    }

    #[test]
    fn an_exploded_packing_is_drawn_with_a_note_and_not_as_a_blank_sheet() {
        let flown = |n: u32| [1.0e6 * f64::from(n % 7), 1.0e5 * f64::from(n), 0.0];
        let centres: Vec<[f64; 3]> = (0..60).map(flown).collect();
        let (radii, values) = (vec![1.0; 60], vec![0.0; 60]);
        let scene = SphereScene { width: 300, height: 300, ..SphereScene::new(&centres, &radii, &values) };
        let at = pixels(&scene);
        let inked =
            (0..200).flat_map(|y| (0..300).map(move |x| (x, y))).filter(|&(x, y)| at(x, y) != [255; 3]);
        assert!(inked.count() > 60, "dots where the particles are");
        assert!(note_pixels(&scene) > 50, "and a note that they are enlarged");
        let nowhere = vec![[f64::NAN; 3]; 60];
        assert!(note_pixels(&SphereScene { centres: &nowhere, ..scene }) > 50);
        let sound: Vec<[f64; 3]> = (0..60).map(|n| [2.0 * f64::from(n), 0.0, 0.0]).collect();
        assert_eq!(note_pixels(&SphereScene { centres: &sound, ..scene }), 0);
    }

    #[test]
    fn one_value_is_shown_against_zero() {
        for (value, expected) in [(0.0, [0.0, 1.0]), (3.0, [0.0, 3.0]), (-2.0, [-2.0, 0.0])] {
            assert_eq!(SphereScene::new(&[[0.0; 3]], &[1.0], &[value]).value_range(), expected);
        }
        assert_eq!(SphereScene::new(&[], &[], &[]).value_range(), [0.0, 1.0]);
    }

    #[test]
    fn unequal_columns_and_other_endings_are_refused() {
        let scene = SphereScene::new(&[[0.0; 3]], &[], &[0.0]);
        assert!(matches!(render_spheres(Path::new("a.png"), &scene), Err(IoError::ColumnLength { .. })));
        let scene = SphereScene::new(&[], &[], &[]);
        assert!(matches!(render_spheres(Path::new("a.gif"), &scene), Err(IoError::UnknownFormat { .. })));
        let scene = SphereScene { width: 0, ..scene };
        assert!(matches!(render_spheres(Path::new("a.png"), &scene), Err(IoError::PictureSize { .. })));
    }
}
