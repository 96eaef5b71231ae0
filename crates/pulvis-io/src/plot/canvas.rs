//! Drawing in points, whatever the picture is made of.

use super::geometry::Point;
use super::script::{self, Run};
use super::text;
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

impl Along {
    /// Start of a text from the given place, over its width.
    fn share(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => -0.5,
            Self::End => -1.0,
        }
    }
}

impl Across {
    /// The baseline below the given place \[em\].
    fn below(self) -> f64 {
        match self {
            Self::Top => text::BELOW_TOP,
            Self::Middle => text::BELOW_MIDDLE,
            Self::Bottom => -text::ABOVE_BOTTOM,
        }
    }
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

/// A drawing area of the library, addressed in points of `scale` pixels each.
pub(crate) struct Canvas<DB: DrawingBackend> {
    area: DrawingArea<DB, Shift>,
    scale: f64,
    stroke: Stroke,
}

impl<DB: DrawingBackend> Canvas<DB> {
    pub(crate) fn new(area: DrawingArea<DB, Shift>, scale: f64, stroke: Stroke) -> Self {
        Self { area, scale, stroke }
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
        let runs = script::runs(text);
        if let [Run { size: 1.0, .. }] = runs[..] {
            return self.run(at, text, setting);
        }
        let (em, share) = (setting.size * text::EM, setting.along.share());
        let mut right = share * text_width(text, setting.size);
        for Run { text, size, below } in runs {
            // Readers of SVG drop blanks at the beginning of a text.
            let word = text.trim_start();
            right += text::width(text, em * size) - text::width(word, em * size);
            // Each piece has its own place of the kind that `across` asks for; the baselines have to fit.
            let down = em * (setting.across.below() * (1.0 - size) + below);
            let place =
                if setting.upwards { (at.0 + down, at.1 - right) } else { (at.0 + right, at.1 + down) };
            self.run(place, word, Setting { size: setting.size * size, along: Along::Start, ..setting })?;
            right += text::width(word, em * size);
        }
        Ok(())
    }

    /// A text in one size.
    fn run(&self, at: Point, text: &str, setting: Setting) -> Result<(), IoError> {
        match self.stroke {
            Stroke::Native => self.written(at, text, setting),
            Stroke::Filled => self.rasterised(at, text, setting),
        }
    }

    /// A text as the library writes it.
    fn written(&self, at: Point, text: &str, setting: Setting) -> Result<(), IoError> {
        let turn = if setting.upwards { FontTransform::Rotate270 } else { FontTransform::None };
        let font = (font::FAMILY, setting.size * self.scale).into_font().transform(turn);
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
        self.area.draw_text(text, &style, self.pixel(at)).map_err(IoError::drawing)
    }

    /// A text pixel by pixel.
    fn rasterised(&self, at: Point, text: &str, setting: Setting) -> Result<(), IoError> {
        let em = setting.size * text::EM * self.scale;
        let (along, across) = (setting.along.share(), setting.across.below());
        let (x, y) = self.pixel(at);
        let colour = opaque(setting.colour);
        let mut drawn = Ok(());
        text::rasterise(text, em, (along * text::width(text, em), across * em), |right, down, share| {
            let pixel = if setting.upwards { (x + down, y - right - 1) } else { (x + right, y + down) };
            if share > 0.0 && drawn.is_ok() {
                drawn = self.area.draw_pixel(pixel, &colour.mix(f64::from(share.min(1.0))));
            }
        })?;
        drawn.map_err(IoError::drawing)
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
    script::runs(text).iter().map(|run| text::width(run.text, size * run.size * text::EM)).sum()
}

fn opaque(colour: Colour) -> RGBAColor {
    RGBAColor(colour.red, colour.green, colour.blue, 1.0)
}
