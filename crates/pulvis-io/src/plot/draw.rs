//! One panel: where its parts lie and how they are drawn.

use super::axis::{Scale, Tick, power_of_ten};
use super::canvas::{Across, Along, Canvas, Setting, text_width};
use super::chart::{Chart, SeriesStyle};
use super::geometry::{Point, Rectangle, dashes, visible_pieces};
use super::{legend, placing};
use crate::{Colour, IoError};
use plotters::prelude::DrawingBackend;

/// Heights of the fonts \[pt\].
pub(super) const TICK_FONT: f64 = 11.0;
const LABEL_FONT: f64 = 12.5;
const TITLE_FONT: f64 = 14.0;

/// Widths of the lines \[pt\].
pub(super) const CURVE: f64 = 1.7;
const FRAME: f64 = 0.9;
const GRID: f64 = 0.6;

/// Lengths of ticks, which point inwards \[pt\].
const TICK: f64 = 5.0;
const MINOR_TICK: f64 = 2.5;

/// Dash and gap of dashed curves \[pt\].
pub(super) const DASH: (f64, f64) = (6.0, 3.5);

const INK: Colour = Colour::grey(0x22);
const GRID_INK: Colour = Colour::grey(0xE4);
const MARKER_INK: Colour = Colour::grey(0x66);

/// Axis coordinates beyond this many panel widths are drawn as if there, which keeps the arithmetic finite.
const FAR: f64 = 1.0e6;

/// A chart with its place in the picture.
pub(super) struct Panel<'a> {
    pub(super) chart: &'a Chart,
    /// The rectangle between the axes.
    pub(super) frame: Rectangle,
    /// Room at the right of the frame for a legend \[pt\].
    pub(super) room_right: f64,
    x: Scale,
    y: Scale,
}

/// Room that the labels of the vertical axis of a panel need \[pt\].
pub(super) fn left_margin(chart: &Chart, height: f64) -> f64 {
    let (ticks, _) = vertical_scale(chart).ticks(vertical_room(height - 60.0));
    let widest = ticks.iter().map(|tick| text_width(&tick.label, TICK_FONT)).fold(0.0, f64::max);
    let label = if chart.y.label.is_empty() { 0.0 } else { LABEL_FONT + 8.0 };
    10.0 + label + widest + 6.0
}

fn vertical_room(height: f64) -> f64 {
    (height / 32.0).clamp(2.0, 9.0)
}

fn horizontal_room(width: f64) -> f64 {
    (width / 75.0).clamp(2.0, 10.0)
}

fn vertical_scale(chart: &Chart) -> Scale {
    let zero = chart.zero_line.then_some(0.0);
    let values = chart.series.iter().flat_map(|series| &series.points);
    // A value whose abscissa cannot be shown must not stretch the axis.
    let shown = values.filter(|(x, _)| x.is_finite() && (!chart.x.logarithmic || *x > 0.0)).map(|&(_, y)| y);
    Scale::new(&chart.y, shown.chain(zero))
}

impl<'a> Panel<'a> {
    /// Divides `outer` into margins and frame.
    pub(super) fn new(chart: &'a Chart, outer: Rectangle, left: f64, room_right: f64) -> Self {
        let abscissas = chart.series.iter().flat_map(|series| &series.points).map(|&(x, _)| x);
        let x = Scale::new(&chart.x, abscissas.chain(chart.markers.iter().map(|&(x, _)| x)));
        let title = if chart.title.is_empty() { 14.0 } else { 14.0 + TITLE_FONT + 6.0 };
        let label = if chart.x.label.is_empty() { 0.0 } else { LABEL_FONT + 6.0 };
        let frame = Rectangle {
            left: outer.left + left,
            top: outer.top + title,
            right: outer.right - 20.0 - room_right,
            bottom: outer.bottom - label - TICK_FONT - 14.0,
        };
        Self { chart, frame, room_right, x, y: vertical_scale(chart) }
    }

    /// Draws everything, from the back to the front.
    pub(super) fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let (across, x_exponent) = self.x.ticks(horizontal_room(self.frame.width()));
        let (upwards, y_exponent) = self.y.ticks(vertical_room(self.frame.height()));
        self.draw_grid(canvas, &across, &upwards)?;
        self.draw_zero_line(canvas)?;
        self.draw_markers(canvas)?;
        for (number, colour) in self.chart.colours().into_iter().enumerate() {
            self.draw_series(canvas, number, Colour::palette(colour), colour)?;
        }
        legend::draw(canvas, self)?;
        self.draw_ticks(canvas, &across, &upwards)?;
        self.draw_labels(canvas, x_exponent, y_exponent)
    }

    /// Place of a data point in the picture, perhaps outside the frame; `None` for a gap.
    fn place(&self, (x, y): (f64, f64)) -> Option<Point> {
        let (x, y) = (self.x.place(x)?.clamp(-FAR, FAR), self.y.place(y)?.clamp(-FAR, FAR));
        Some((self.frame.left + x * self.frame.width(), self.frame.bottom - y * self.frame.height()))
    }

    /// The polylines of a series inside the frame.
    pub(super) fn pieces(&self, number: usize) -> Vec<Vec<Point>> {
        let points = self.chart.series[number].points.iter().map(|&point| self.place(point));
        visible_pieces(points, self.frame)
    }

    /// The points of a series inside the frame.
    pub(super) fn symbols(&self, number: usize) -> impl Iterator<Item = Point> {
        let points = self.chart.series[number].points.iter();
        points.filter_map(|&point| self.place(point)).filter(|&point| self.frame.contains(point))
    }

    /// Abscissa, place of the label, and label of each marker inside the frame.
    pub(super) fn marker_labels(&self, places: &[Point]) -> impl Iterator<Item = (f64, Rectangle, &str)> {
        self.chart.markers.iter().filter_map(move |(value, label)| {
            let place = self.x.place(*value).filter(|place| (0.0..=1.0).contains(place))?;
            let x = self.frame.left + place * self.frame.width();
            Some((x, placing::marker_label(self.frame, x, label, places), label.as_str()))
        })
    }

    fn draw_grid<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        across: &[Tick],
        upwards: &[Tick],
    ) -> Result<(), IoError> {
        let frame = self.frame;
        for tick in across.iter().filter(|tick| !tick.label.is_empty()) {
            let x = frame.left + tick.place * frame.width();
            canvas.line(&[(x, frame.top), (x, frame.bottom)], GRID_INK, GRID)?;
        }
        for tick in upwards.iter().filter(|tick| !tick.label.is_empty()) {
            let y = frame.bottom - tick.place * frame.height();
            canvas.line(&[(frame.left, y), (frame.right, y)], GRID_INK, GRID)?;
        }
        Ok(())
    }

    fn draw_zero_line<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let place = self.y.place(0.0).filter(|place| self.chart.zero_line && (0.0..=1.0).contains(place));
        place.map_or(Ok(()), |place| {
            let y = self.frame.bottom - place * self.frame.height();
            canvas.line(&[(self.frame.left, y), (self.frame.right, y)], MARKER_INK, FRAME)
        })
    }

    fn draw_markers<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let (along, across) = (Along::End, Across::Top);
        let setting = Setting { size: TICK_FONT, colour: MARKER_INK, along, across, upwards: true };
        for (x, place, label) in self.marker_labels(&placing::occupied(self)) {
            for dash in dashes(&[(x, self.frame.bottom), (x, self.frame.top)], 3.0, 3.0) {
                canvas.line(&dash, MARKER_INK, 1.1)?;
            }
            // The end of a text that runs upwards is its upper end.
            canvas.text((place.left, place.top), label, setting)?;
        }
        Ok(())
    }

    fn draw_series<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        number: usize,
        colour: Colour,
        shape: usize,
    ) -> Result<(), IoError> {
        match self.chart.series[number].style {
            SeriesStyle::Line => {
                self.pieces(number).iter().try_for_each(|piece| canvas.line(piece, colour, CURVE))
            }
            SeriesStyle::Dashed => {
                let pieces = self.pieces(number).into_iter().flat_map(|piece| dashes(&piece, DASH.0, DASH.1));
                pieces.into_iter().try_for_each(|dash| canvas.line(&dash, colour, CURVE))
            }
            SeriesStyle::Points => {
                self.symbols(number).try_for_each(|at| draw_symbol(canvas, at, colour, shape))
            }
        }
    }

    fn draw_ticks<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        across: &[Tick],
        upwards: &[Tick],
    ) -> Result<(), IoError> {
        let Rectangle { left, top, right, bottom } = self.frame;
        let setting = |along, across| Setting { size: TICK_FONT, colour: INK, along, across, upwards: false };
        let length = |tick: &Tick| if tick.label.is_empty() { MINOR_TICK } else { TICK };
        for tick in across {
            let x = left + tick.place * self.frame.width();
            canvas.line(&[(x, bottom), (x, bottom - length(tick))], INK, FRAME)?;
            canvas.line(&[(x, top), (x, top + length(tick))], INK, FRAME)?;
            canvas.text((x, bottom + 5.0), &tick.label, setting(Along::Middle, Across::Top))?;
        }
        for tick in upwards {
            let y = bottom - tick.place * self.frame.height();
            canvas.line(&[(left, y), (left + length(tick), y)], INK, FRAME)?;
            canvas.line(&[(right, y), (right - length(tick), y)], INK, FRAME)?;
            canvas.text((left - 6.0, y), &tick.label, setting(Along::End, Across::Middle))?;
        }
        // Half a line beyond each corner, so that the corners are full.
        let over = 0.5 * FRAME;
        canvas.line(&[(left - over, bottom), (right + over, bottom)], INK, FRAME)?;
        canvas.line(&[(left - over, top), (right + over, top)], INK, FRAME)?;
        canvas.line(&[(left, top), (left, bottom)], INK, FRAME)?;
        canvas.line(&[(right, top), (right, bottom)], INK, FRAME)
    }

    fn draw_labels<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        x_exponent: i32,
        y_exponent: i32,
    ) -> Result<(), IoError> {
        let Rectangle { left, top, right, bottom } = self.frame;
        let (middle, height) = (0.5 * (left + right), 0.5 * (top + bottom));
        let setting = |size, along, across, upwards| Setting { size, colour: INK, along, across, upwards };
        let factor = |exponent: i32| format!("×{}", power_of_ten(exponent));
        let below = bottom + TICK_FONT + 10.0;
        canvas.text(
            (middle, below),
            &self.chart.x.label,
            setting(LABEL_FONT, Along::Middle, Across::Top, false),
        )?;
        canvas.text(
            (8.0, height),
            &self.chart.y.label,
            setting(LABEL_FONT, Along::Middle, Across::Top, true),
        )?;
        let title = setting(TITLE_FONT, Along::Middle, Across::Bottom, false);
        canvas.text((middle, top - 5.0), &self.chart.title, title)?;
        if x_exponent != 0 {
            let place = setting(TICK_FONT, Along::End, Across::Top, false);
            canvas.text((right, below), &factor(x_exponent), place)?;
        }
        if y_exponent != 0 {
            let place = setting(TICK_FONT, Along::Start, Across::Bottom, false);
            canvas.text((left, top - 3.0), &factor(y_exponent), place)?;
        }
        Ok(())
    }
}

/// A symbol whose shape tells series apart where colour does not.
pub(super) fn draw_symbol<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    (x, y): Point,
    colour: Colour,
    shape: usize,
) -> Result<(), IoError> {
    let corners: &[Point] = match shape % 4 {
        0 => {
            // A white rim keeps symbols apart from one another and from the curve below.
            canvas.disc((x, y), 4.0, Colour::WHITE)?;
            return canvas.disc((x, y), 3.2, colour);
        }
        1 => &[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)],
        2 => &[(0.0, -1.4), (1.3, 0.9), (-1.3, 0.9)],
        _ => &[(0.0, -1.4), (1.4, 0.0), (0.0, 1.4), (-1.4, 0.0)],
    };
    let place = |size: f64| corners.iter().map(|(dx, dy)| (x + size * dx, y + size * dy)).collect::<Vec<_>>();
    canvas.fill(&place(3.8), Colour::WHITE, 1.0)?;
    canvas.fill(&place(2.9), colour, 1.0)
}
