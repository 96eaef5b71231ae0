//! Drawing in points, whatever the picture is made of.

use super::geometry::Point;
use crate::{Colour, IoError, font};
use plotters::coord::Shift;
use plotters::prelude::{
    Circle, DrawingArea, DrawingBackend, IntoFont, PathElement, Polygon, RGBAColor, ShapeStyle,
};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform, TextStyle};

/// Where the given place lies in a text, along the line of writing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Along {
    Start,
    Middle,
    End,
}

/// Where the given place lies in a text, across the line of writing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Across {
    Top,
    Middle,
    Bottom,
}

/// How a text is set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting {
    /// Height of the font \[pt\].
    pub(crate) size: f64,
    pub(crate) colour: Colour,
    pub(crate) along: Along,
    pub(crate) across: Across,
    /// Whether the text runs upwards.
    pub(crate) upwards: bool,
}

/// How lines are made by the drawing library below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stroke {
    /// The format knows lines with a width.
    Native,
    /// Lines are filled quadrilaterals with round joints: the library's own wide lines show spikes at sharp bends.
    Filled,
}

/// The library's pixel fonts are larger than its SVG fonts of the same nominal size, and sit higher in their line, both in
/// proportion to the size. Measured on figures drawn both ways.
const RASTER_SIZE: f64 = 0.94;
const RASTER_DROP: f64 = 0.13;

/// A drawing area of the library, addressed in points of `scale` pixels each.
pub(crate) struct Canvas<DB: DrawingBackend> {
    area: DrawingArea<DB, Shift>,
    scale: f64,
    stroke: Stroke,
}

impl<DB: DrawingBackend> Canvas<DB> {
    pub(crate) fn new(area: DrawingArea<DB, Shift>, scale: f64, stroke: Stroke) -> Result<Self, IoError> {
        font::register()?;
        Ok(Self { area, scale, stroke })
    }

    /// A polyline `width` points wide.
    pub(crate) fn line(&self, points: &[Point], colour: Colour, width: f64) -> Result<(), IoError> {
        if self.stroke == Stroke::Native {
            let stroke_width = (width * self.scale).round().max(1.0) as u32;
            let style = ShapeStyle { color: opaque(colour), filled: false, stroke_width };
            let points: Vec<_> = points.iter().map(|&point| self.pixel(point)).collect();
            return self.area.draw(&PathElement::new(points, style)).map_err(IoError::drawing);
        }
        let half = 0.5 * width;
        for pair in points.windows(2) {
            let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
            let length = (x1 - x0).hypot(y1 - y0);
            if length > 0.0 {
                let (nx, ny) = (half * (y0 - y1) / length, half * (x1 - x0) / length);
                let corners =
                    [(x0 + nx, y0 + ny), (x1 + nx, y1 + ny), (x1 - nx, y1 - ny), (x0 - nx, y0 - ny)];
                self.fill(&corners, colour, 1.0)?;
            }
        }
        // Joints only: the ends of axes and dashes stay square.
        points.iter().skip(1).rev().skip(1).try_for_each(|&joint| self.disc(joint, half, colour))
    }

    /// A filled polygon; opacity 1 hides what is below.
    pub(crate) fn fill(&self, corners: &[Point], colour: Colour, opacity: f64) -> Result<(), IoError> {
        let corners: Vec<_> = corners.iter().map(|&corner| self.pixel(corner)).collect();
        let style = ShapeStyle { color: opaque(colour).mix(opacity), filled: true, stroke_width: 0 };
        self.area.draw(&Polygon::new(corners, style)).map_err(IoError::drawing)
    }

    /// A filled disc.
    pub(crate) fn disc(&self, centre: Point, radius: f64, colour: Colour) -> Result<(), IoError> {
        let style = ShapeStyle { color: opaque(colour), filled: true, stroke_width: 0 };
        let radius = (radius * self.scale).round() as i32;
        self.area.draw(&Circle::new(self.pixel(centre), radius, style)).map_err(IoError::drawing)
    }

    /// A text at a place.
    pub(crate) fn text(&self, at: Point, text: &str, setting: Setting) -> Result<(), IoError> {
        if text.trim().is_empty() {
            return Ok(());
        }
        let turn = if setting.upwards { FontTransform::Rotate270 } else { FontTransform::None };
        let raster = self.stroke == Stroke::Filled;
        let size = if raster { RASTER_SIZE * setting.size } else { setting.size };
        let font = (font::FAMILY, size * self.scale).into_font().transform(turn);
        let along = match setting.along {
            Along::Start => HPos::Left,
            Along::Middle => HPos::Center,
            Along::End => HPos::Right,
        };
        let across = match setting.across {
            Across::Top => VPos::Top,
            Across::Middle => VPos::Center,
            Across::Bottom => VPos::Bottom,
        };
        let colour = opaque(setting.colour);
        let style = TextStyle::from(font).color(&colour).pos(Pos::new(along, across));
        let drop = if raster { RASTER_DROP * size } else { 0.0 };
        let at = if setting.upwards { (at.0 + drop, at.1) } else { (at.0, at.1 + drop) };
        self.area.draw_text(text, &style, self.pixel(at)).map_err(IoError::drawing)
    }

    /// Completes the drawing, for formats that have an end.
    pub(crate) fn finish(&self) -> Result<(), IoError> {
        self.area.present().map_err(IoError::drawing)
    }

    fn pixel(&self, (x, y): Point) -> (i32, i32) {
        ((x * self.scale).round() as i32, (y * self.scale).round() as i32)
    }
}

/// Width of a text \[pt\] in a font of the given height \[pt\].
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    // Measured large, since the library rounds to whole pixels.
    const LARGE: f64 = 200.0;
    if font::register().is_err() {
        return 0.0;
    }
    let width = (font::FAMILY, LARGE).into_font().box_size(text).map_or(0, |(width, _)| width);
    f64::from(width) * RASTER_SIZE * size / LARGE
}

fn opaque(colour: Colour) -> RGBAColor {
    RGBAColor(colour.red, colour.green, colour.blue, 1.0)
}
