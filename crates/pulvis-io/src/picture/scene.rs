//! What is to be drawn.

use super::camera;
use super::outline::{self, Edge, OutlineCylinder};
use super::selection::Selection;
use super::view::{Projection, View};
use crate::{Colour, ColourMap, IoError};

/// Colours around the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Paper {
    /// Dark ink on white.
    #[default]
    White,
    /// Light ink on near black, for dark slides and pages.
    Black,
}

/// What gives a tube its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// A value of the colour bar; grey if it is not a number.
    Value(f64),
    /// This colour.
    Plain(Colour),
}

/// A straight tube with round ends: a contact, for example.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// Ends of its axis \[m\].
    pub ends: [[f64; 3]; 2],
    /// Radius \[m\]; thinner ones than a pixel are drawn a pixel thick.
    pub radius: f64,
    /// Its colour.
    pub paint: Paint,
}

/// What to draw.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// Centre of each sphere \[m\]; spheres with a coordinate or radius that is not finite are left out and counted in a
    /// note.
    pub centres: &'a [[f64; 3]],
    /// Radius of each sphere \[m\].
    pub radii: &'a [f64],
    /// The quantity that gives each sphere its colour; not-a-number is grey. With `classes`, the number of its class. Empty
    /// for grey spheres that mean no value.
    pub values: &'a [f64],
    /// Names of classes, of materials for example, each with a colour of its own in place of the colour bar; empty for a
    /// quantity.
    pub classes: &'a [&'a str],
    /// Tubes between spheres.
    pub tubes: &'a [Tube],
    /// Ends of the colour bar; `None` takes the smallest and largest finite value.
    pub range: Option<[f64; 2]>,
    /// Colours of the range.
    pub colours: ColourMap,
    /// Where one looks from.
    pub view: View,
    /// Whether what is farther looks smaller.
    pub projection: Projection,
    /// The box that the picture holds \[m\], the same in a sequence of pictures; `None` fits the picture to the scene.
    pub limits: Option<[[f64; 3]; 2]>,
    /// Size of the picture \[pixel\].
    pub width: u32,
    /// Size of the picture \[pixel\].
    pub height: u32,
    /// Heading; empty for none.
    pub title: &'a str,
    /// Quantity and unit beside the colour bar; empty for a picture without a colour bar.
    pub bar_label: &'a str,
    /// A line below the scene; empty for none.
    pub caption: &'a str,
    /// Straight lines: the edges of boxes, [`OutlineBox::edges`](super::OutlineBox::edges) for example.
    pub edges: &'a [Edge],
    /// Cylinders shown by their outlines.
    pub cylinders: &'a [OutlineCylinder],
    /// Whether a bar shows a length in metres.
    pub scale_bar: bool,
    /// Colours around the scene.
    pub paper: Paper,
}

impl<'a> Scene<'a> {
    /// Smallest and largest side of a picture \[pixel\].
    pub const SIDES: [u32; 2] = [64, 8192];

    /// Spheres seen obliquely, in viridis, 1200 x 900 pixels, without title, colour bar, outlines and scale bar.
    pub fn new(centres: &'a [[f64; 3]], radii: &'a [f64], values: &'a [f64]) -> Self {
        Self {
            centres,
            radii,
            values,
            classes: &[],
            tubes: &[],
            range: None,
            colours: ColourMap::Viridis,
            view: View::OBLIQUE,
            projection: Projection::Perspective,
            limits: None,
            width: 1200,
            height: 900,
            title: "",
            bar_label: "",
            caption: "",
            edges: &[],
            cylinders: &[],
            scale_bar: false,
            paper: Paper::White,
        }
    }

    pub(super) fn check(&self) -> Result<(), IoError> {
        let expected = self.centres.len();
        let values = if self.values.is_empty() { expected } else { self.values.len() };
        for (column, found) in [("radii", self.radii.len()), ("values", values)] {
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

    /// The edges of all outlines that are there for every viewer.
    pub(super) fn all_edges(&self) -> Vec<Edge> {
        let finite = |edge: &&Edge| edge.iter().flatten().all(|x| x.abs() < outline::LARGEST);
        let edges = self.edges.iter().filter(finite).copied();
        edges.chain(self.cylinders.iter().flat_map(OutlineCylinder::circles)).collect()
    }

    /// The box around all that a picture of this scene shows \[m\]; `None` where it shows nothing.
    pub fn shown_limits(&self) -> Option<[[f64; 3]; 2]> {
        let selection = Selection::of(self);
        let spheres = camera::shown(self, &selection)
            .flat_map(|(_, centre, radius)| [centre.map(|x| x - radius), centre.map(|x| x + radius)]);
        let points: Vec<Edge> = spheres.map(|corner| [corner; 2]).chain(self.all_edges()).collect();
        outline::limits(&points)
    }

    /// All values that the colour bar stands for.
    pub(super) fn all_values(&self) -> impl Iterator<Item = f64> + '_ {
        let of_tube = |tube: &Tube| if let Paint::Value(value) = tube.paint { Some(value) } else { None };
        self.values.iter().copied().chain(self.tubes.iter().filter_map(of_tube))
    }

    /// Ends of the colour bar.
    pub fn value_range(&self) -> [f64; 2] {
        let usable = |range: &[f64; 2]| range.iter().all(|end| end.is_finite()) && range[0] < range[1];
        self.range.filter(usable).unwrap_or_else(|| {
            let finite = self.all_values().filter(|value| value.is_finite());
            let ends = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(value), high.max(value)]
            });
            // A single value is shown against zero; no value at all needs some range for the bar.
            let only = Some(ends[0]).filter(|value| value.is_finite() && *value != 0.0);
            let from_zero = only.map_or([0.0, 1.0], |value| [value.min(0.0), value.max(0.0)]);
            if usable(&ends) { ends } else { from_zero }
        })
    }

    /// Colours of all spheres.
    pub(super) fn sphere_colours(&self, range: [f64; 2]) -> Vec<Colour> {
        let grey = self.values.is_empty().then_some(Colour::grey(0xB8));
        let plain = grey.into_iter().cycle().take(self.centres.len());
        plain.chain(self.values.iter().map(|&value| self.colour(value, range))).collect()
    }

    /// Colour of a tube.
    pub(super) fn tube_colour(&self, tube: &Tube, range: [f64; 2]) -> Colour {
        match tube.paint {
            Paint::Plain(colour) => colour,
            Paint::Value(value) => self.colours.at((value - range[0]) / (range[1] - range[0])),
        }
    }

    fn colour(&self, value: f64, range: [f64; 2]) -> Colour {
        if self.classes.is_empty() || !value.is_finite() {
            return self.colours.at((value - range[0]) / (range[1] - range[0]));
        }
        Colour::palette(value.max(0.0) as usize)
    }
}

impl Paper {
    /// What is drawn on.
    pub(super) const fn ground(self) -> Colour {
        match self {
            Self::White => Colour::WHITE,
            Self::Black => Colour::grey(0x16),
        }
    }

    /// Texts and lines.
    pub(super) const fn ink(self) -> Colour {
        match self {
            Self::White => Colour::grey(0x22),
            Self::Black => Colour::grey(0xE6),
        }
    }

    /// Warnings.
    pub(super) const fn note_ink(self) -> Colour {
        match self {
            Self::White => Colour::new(0xA0, 0x10, 0x10),
            Self::Black => Colour::new(0xFF, 0x8A, 0x80),
        }
    }

    /// Outlines of walls.
    pub(super) const fn outline(self) -> Colour {
        match self {
            Self::White => Colour::grey(0x50),
            Self::Black => Colour::grey(0xA8),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_ends_at_the_least_and_largest_finite_value() {
        let values = [f64::NAN, 3.0, -2.5, f64::INFINITY, 7.25];
        let centres = [[0.0; 3]; 5];
        let radii = [1.0; 5];
        let scene = Scene::new(&centres, &radii, &values);
        assert_eq!(scene.value_range(), [-2.5, 7.25]);
        let tube = Tube { ends: [[0.0; 3]; 2], radius: 1.0, paint: Paint::Value(9.0) };
        assert_eq!(Scene { tubes: &[tube], ..scene }.value_range(), [-2.5, 9.0]);
        assert_eq!(Scene { range: Some([0.0, 1.0]), ..scene }.value_range(), [0.0, 1.0]);
        let [low, high] = [-2.5, 7.25].map(|value| scene.colour(value, scene.value_range()));
        assert_eq!([low, high], [ColourMap::Viridis.at(0.0), ColourMap::Viridis.at(1.0)]);
    }

    #[test]
    fn one_value_is_shown_against_zero() {
        for (value, expected) in [(0.0, [0.0, 1.0]), (3.0, [0.0, 3.0]), (-2.0, [-2.0, 0.0])] {
            assert_eq!(Scene::new(&[[0.0; 3]], &[1.0], &[value]).value_range(), expected);
        }
        assert_eq!(Scene::new(&[], &[], &[]).value_range(), [0.0, 1.0]);
    }
}
