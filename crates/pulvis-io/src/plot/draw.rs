//! One panel: where its parts lie and how they are drawn.

use super::axis::Scale;
use super::bounds::vertical_scale;
use super::canvas::{Across, Along, Canvas, Setting, text_width};
use super::chart::{Chart, SeriesStyle};
use super::geometry::{Point, Rectangle, dashes, visible_pieces};
use super::{coincidence, labels, legend, placing, unlocated};
use crate::{Colour, IoError};
use plotters::prelude::DrawingBackend;

/// Heights of the fonts \[pt\].
pub(super) const TICK_FONT: f64 = 11.0;
pub(super) const NOTE_FONT: f64 = 10.5;
pub(super) const LABEL_FONT: f64 = 12.5;
pub(super) const TITLE_FONT: f64 = 14.0;

/// Widths of the lines \[pt\].
pub(super) const CURVE: f64 = 1.7;
pub(super) const THICK: f64 = 3.2;
pub(super) const FRAME: f64 = 0.9;

/// Half the width of a cross, and the width of its lines \[pt\].
const CROSS: f64 = 2.4;
const THIN: f64 = 1.0;

/// Half the width of the ends of error bars \[pt\].
const CAP: f64 = 3.0;

/// Radius of a point of a curve that has gaps on both sides \[pt\].
const LONE: f64 = 2.0;

/// Half the width, the height and the distance of the arrows that stand for values beyond an axis \[pt\].
const ARROW: (f64, f64) = (4.0, 7.0);
const ARROW_DISTANCE: f64 = 10.0;

/// Half the width and the height of the heads of arrows along a curve \[pt\].
const HEAD: (f64, f64) = (4.5, 11.0);

/// Rows of arrows, one a series.
const ARROW_ROWS: u32 = 5;

/// Dash and gap of dashed curves \[pt\].
pub(super) const DASH: (f64, f64) = (6.0, 3.5);

pub(super) const INK: Colour = Colour::grey(0x22);
pub(super) const MARKER_INK: Colour = Colour::grey(0x66);

/// Axis coordinates beyond this many panel widths are drawn as if there, which keeps the arithmetic finite.
const FAR: f64 = 1.0e6;

/// A chart with its place in the picture.
pub(super) struct Panel<'a> {
    pub(super) chart: &'a Chart,
    /// The rectangle between the axes.
    pub(super) frame: Rectangle,
    /// Left end of the panel's place \[pt\].
    pub(super) left: f64,
    /// Room at the right of the frame for a legend \[pt\].
    pub(super) room_right: f64,
    pub(super) x: Scale,
    pub(super) y: Scale,
    /// What the panel cannot show.
    pub(super) notes: Vec<String>,
}

/// An arrow at the edge, for a value beyond the axis.
pub(super) struct Mark {
    /// Number of the series.
    pub(super) series: usize,
    tip: Point,
    upwards: bool,
}

impl Mark {
    /// The tip and the two ends of the base.
    pub(super) fn corners(&self) -> [Point; 3] {
        let (x, y) = self.tip;
        let base = if self.upwards { y + ARROW.1 } else { y - ARROW.1 };
        [(x, y), (x + ARROW.0, base), (x - ARROW.0, base)]
    }
}

/// Room that the labels of the vertical axis of a panel need \[pt\].
pub(super) fn left_margin(chart: &Chart, height: f64) -> f64 {
    let (ticks, _) = vertical_scale(chart).ticks(labels::vertical_room(height - 60.0));
    let widest = ticks.iter().map(|tick| text_width(&tick.label, TICK_FONT)).fold(0.0, f64::max);
    let label = if chart.y.label.is_empty() { 0.0 } else { LABEL_FONT + 8.0 };
    10.0 + label + widest + 6.0
}

impl<'a> Panel<'a> {
    /// Divides `outer` into margins and frame.
    pub(super) fn new(chart: &'a Chart, outer: Rectangle, left: f64, room_right: f64) -> Self {
        let abscissas = chart.series.iter().flat_map(|series| &series.points).map(|&(x, _)| x);
        let x = Scale::new(&chart.x, abscissas.chain(chart.markers.iter().map(|&(x, _)| x)));
        let y = vertical_scale(chart);
        let notes = unlocated::notes(chart, [&x, &y]);
        let label = if chart.x.label.is_empty() { 0.0 } else { LABEL_FONT + 6.0 };
        let frame = Rectangle {
            left: outer.left + left,
            top: outer.top + labels::height_above(&chart.title, chart.sections.len(), notes.len()),
            right: outer.right - 20.0 - room_right,
            bottom: outer.bottom - label - TICK_FONT - 14.0,
        };
        Self { chart, frame, left: outer.left, room_right, x, y, notes }
    }

    /// Draws everything, from the back to the front.
    pub(super) fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let ticks = self.ticks();
        let strokes = coincidence::strokes(self);
        self.draw_grid(canvas, &ticks)?;
        self.draw_sections(canvas)?;
        self.draw_zero_line(canvas)?;
        self.draw_markers(canvas)?;
        for (number, shape) in self.chart.colours().into_iter().enumerate() {
            self.draw_series(canvas, number, shape, &strokes[number])?;
        }
        self.draw_marks(canvas)?;
        legend::draw(canvas, self)?;
        self.draw_emptiness(canvas)?;
        self.draw_ticks(canvas, &ticks)?;
        self.draw_labels(canvas, &ticks)?;
        self.draw_notes(canvas)
    }

    /// How many points of all series can be shown at their positions, and how many there are.
    pub(super) fn located(&self) -> [usize; 2] {
        let points = || self.chart.series.iter().flat_map(|series| &series.points);
        [points().filter(|&&point| self.place(point).is_some()).count(), points().count()]
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

    /// The points inside the frame that no line shows, since there are gaps on both sides.
    fn lone_points(&self, number: usize) -> impl Iterator<Item = Point> {
        let points = &self.chart.series[number].points;
        let at = |index: usize| points.get(index).and_then(|&point| self.place(point));
        let alone =
            move |index: &usize| index.checked_sub(1).and_then(at).is_none() && at(index + 1).is_none();
        (0..points.len()).filter(alone).filter_map(at).filter(|&point| self.frame.contains(point))
    }

    /// Abscissa, place of the label, and label of each marker inside the frame.
    pub(super) fn marker_labels(&self, places: &[Point]) -> impl Iterator<Item = (f64, Rectangle, &str)> {
        self.chart.markers.iter().filter_map(move |(value, label)| {
            let place = self.x.place(*value).filter(|place| (0.0..=1.0).contains(place))?;
            let x = self.frame.left + place * self.frame.width();
            Some((x, placing::marker_label(self.frame, x, label, places), label.as_str()))
        })
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

    /// Arrows for all values beyond an end of the vertical axis, those of one series in one row.
    pub(super) fn marks(&self) -> Vec<Mark> {
        let mut marks = Vec::new();
        let mut rows = [0_u32; 2];
        for (series, upwards) in
            (0..self.chart.series.len()).flat_map(|series| [(series, true), (series, false)])
        {
            let points = self.chart.series[series].points.iter();
            let beyond = points.filter(|&&point| {
                let reason = unlocated::reason(self.chart, [&self.x, &self.y], point);
                reason.and_then(unlocated::Reason::end) == Some(upwards)
            });
            let places = beyond.filter_map(|&(x, _)| self.x.place(x)).filter(|x| (0.0..=1.0).contains(x));
            let offset = 2.0 + (ARROW.1 + 2.0) * f64::from(rows[usize::from(upwards)]);
            let y = if upwards { self.frame.top + offset } else { self.frame.bottom - offset };
            let mut last = f64::NEG_INFINITY;
            let before = marks.len();
            for x in places.map(|place| self.frame.left + place * self.frame.width()) {
                if (x - last).abs() >= ARROW_DISTANCE {
                    marks.push(Mark { series, tip: (x, y), upwards });
                    last = x;
                }
            }
            if marks.len() > before {
                rows[usize::from(upwards)] = (rows[usize::from(upwards)] + 1) % ARROW_ROWS;
            }
        }
        marks
    }

    fn draw_marks<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let colours = self.chart.colours();
        self.marks()
            .iter()
            .try_for_each(|mark| canvas.fill(&mark.corners(), Colour::palette(colours[mark.series]), 1.0))
    }

    fn draw_series<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        number: usize,
        shape: usize,
        strokes: &[coincidence::Stroke],
    ) -> Result<(), IoError> {
        let colour = Colour::palette(shape);
        let style = self.chart.series[number].style;
        self.error_bars(number).try_for_each(|bar| canvas.line(&bar, colour, THIN))?;
        if style.is_unconnected() {
            return self.symbols(number).try_for_each(|at| draw_symbol(canvas, at, colour, (style, shape)));
        }
        let width = if self.chart.series[number].thick { THICK } else { CURVE };
        strokes.iter().try_for_each(|(line, pattern)| draw_line(canvas, line, (colour, width), *pattern))?;
        self.arrow_heads(number).try_for_each(|corners| canvas.fill(&corners, colour, 1.0))?;
        self.lone_points(number).try_for_each(|at| canvas.disc(at, LONE, colour))
    }

    /// The lines of the error bars of a series inside the frame: bars, and their ends. A bar whose lower end has no place on a
    /// logarithmic axis goes down to the frame.
    fn error_bars(&self, number: usize) -> impl Iterator<Item = [Point; 2]> {
        let within = |y: f64| y.clamp(self.frame.top, self.frame.bottom);
        self.chart.series[number].error_bars().flat_map(move |(x, [low, high])| {
            let high =
                self.place((x, high)).filter(|(x, _)| (self.frame.left..=self.frame.right).contains(x));
            let Some((x, top)) = high else { return Vec::new() };
            let low = self.y.place(low).map(|y| self.frame.bottom - y.clamp(-FAR, FAR) * self.frame.height());
            let bottom = low.unwrap_or(self.frame.bottom);
            let cap = |y: f64| (within(y) == y).then_some([(x - CAP, y), (x + CAP, y)]);
            [Some([(x, within(bottom)), (x, within(top))]), low.and_then(cap), cap(top)]
                .into_iter()
                .flatten()
                .collect()
        })
    }

    /// Tip and base of each arrow head of a series whose tip is inside the frame.
    fn arrow_heads(&self, number: usize) -> impl Iterator<Item = [Point; 3]> {
        let (half, height) = HEAD;
        self.chart.series[number].arrows.iter().filter_map(move |[from, to]| {
            let (from, tip) = (self.place(*from)?, self.place(*to)?);
            let (dx, dy) = (tip.0 - from.0, tip.1 - from.1);
            let length = dx.hypot(dy);
            let (dx, dy) = (dx / length, dy / length);
            let base = (tip.0 - height * dx, tip.1 - height * dy);
            let corner = |side: f64| (base.0 - side * half * dy, base.1 + side * half * dx);
            (length > 0.0 && self.frame.contains(tip)).then(|| [tip, corner(1.0), corner(-1.0)])
        })
    }
}

/// A curve, solid or in dashes.
pub(super) fn draw_line<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    line: &[Point],
    (colour, width): (Colour, f64),
    pattern: Option<(f64, f64)>,
) -> Result<(), IoError> {
    match pattern {
        None => canvas.line(line, colour, width),
        Some((dash, gap)) => {
            dashes(line, dash, gap).iter().try_for_each(|dash| canvas.line(dash, colour, width))
        }
    }
}

/// A symbol whose shape tells series apart where colour does not.
pub(super) fn draw_symbol<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    (x, y): Point,
    colour: Colour,
    (style, shape): (SeriesStyle, usize),
) -> Result<(), IoError> {
    if style == SeriesStyle::Crosses {
        let arm = |dx: f64| [(x - dx, y - CROSS), (x + dx, y + CROSS)];
        canvas.line(&arm(CROSS), colour, THIN)?;
        return canvas.line(&arm(-CROSS), colour, THIN);
    }
    let open = style == SeriesStyle::Rings;
    let corners: &[Point] = match shape % 4 {
        0 => {
            // A white rim keeps symbols apart from one another and from the curve below.
            canvas.disc((x, y), 4.0, Colour::WHITE)?;
            canvas.disc((x, y), 3.2, colour)?;
            return if open { canvas.disc((x, y), 2.1, Colour::WHITE) } else { Ok(()) };
        }
        1 => &[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)],
        2 => &[(0.0, -1.4), (1.3, 0.9), (-1.3, 0.9)],
        _ => &[(0.0, -1.4), (1.4, 0.0), (0.0, 1.4), (-1.4, 0.0)],
    };
    let place = |size: f64| corners.iter().map(|(dx, dy)| (x + size * dx, y + size * dy)).collect::<Vec<_>>();
    canvas.fill(&place(3.8), Colour::WHITE, 1.0)?;
    canvas.fill(&place(2.9), colour, 1.0)?;
    if open { canvas.fill(&place(1.8), Colour::WHITE, 1.0) } else { Ok(()) }
}
