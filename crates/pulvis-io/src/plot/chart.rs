//! What a chart shows; how it looks is [`super::draw`]'s business.

use super::Figure;
use crate::IoError;
use std::path::Path;

/// How the points of a [`Series`] are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeriesStyle {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashed,
    /// Unconnected symbols.
    Points,
    /// Unconnected open symbols, which show what lies below them.
    Rings,
    /// Unconnected crosses, small enough to lie inside a ring.
    Crosses,
}

impl SeriesStyle {
    /// Whether points are symbols, and no line joins them.
    pub(super) fn is_unconnected(self) -> bool {
        matches!(self, Self::Points | Self::Rings | Self::Crosses)
    }
}

/// One curve or cloud of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    pub(super) label: String,
    pub(super) style: SeriesStyle,
    pub(super) points: Vec<(f64, f64)>,
    pub(super) colour: Option<usize>,
    pub(super) thick: bool,
    /// Where arrow heads come from and where their tips are.
    pub(super) arrows: Vec<[(f64, f64); 2]>,
    /// Half the length of the error bar of each point.
    pub(super) errors: Vec<f64>,
}

impl Series {
    /// A solid line through `points` (x, y); an empty label keeps it out of the legend.
    pub fn line(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(label, SeriesStyle::Line, points)
    }

    /// A dashed line through `points` (x, y).
    pub fn dashed(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(label, SeriesStyle::Dashed, points)
    }

    /// Symbols at `points` (x, y).
    pub fn points(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(label, SeriesStyle::Points, points)
    }

    /// A series in any style.
    pub fn new(
        label: impl Into<String>,
        style: SeriesStyle,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let (label, points) = (label.into(), points.into_iter().collect());
        Self { label, style, points, colour: None, thick: false, arrows: Vec::new(), errors: Vec::new() }
    }

    /// Takes colour `number` of the palette instead of the next one, so that theory and simulation of one case match.
    #[must_use]
    pub fn colour(mut self, number: usize) -> Self {
        self.colour = Some(number);
        self
    }

    /// Draws a line twice as wide as others.
    #[must_use]
    pub fn thick(mut self) -> Self {
        self.thick = true;
        self
    }

    /// Adds arrow heads, which show the direction of a curve: each points from the first of two points to the second, where
    /// its tip is.
    #[must_use]
    pub fn arrows(mut self, arrows: impl IntoIterator<Item = [(f64, f64); 2]>) -> Self {
        self.arrows.extend(arrows);
        self
    }

    /// Adds error bars: from each point, in their order, a line by so much up and down. What is not finite or zero has none.
    #[must_use]
    pub fn errors(mut self, errors: impl IntoIterator<Item = f64>) -> Self {
        self.errors.extend(errors);
        self
    }

    /// Lower and upper end of each error bar, with its abscissa.
    pub(super) fn error_bars(&self) -> impl Iterator<Item = (f64, [f64; 2])> {
        let bars = self.points.iter().zip(&self.errors);
        let bars = bars.filter(|((_, y), half)| half.is_finite() && **half > 0.0 && y.is_finite());
        bars.map(|((x, y), half)| (*x, [y - half, y + half]))
    }
}

/// One axis: what it shows and over which range.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Quantity and unit: "force \[N\]".
    pub label: String,
    /// Whether equal ratios have equal lengths.
    pub logarithmic: bool,
    /// Ends of the axis; `None` fits the data. Ends that are not usable (equal, not finite, not positive on a logarithmic
    /// axis) are treated as `None`.
    pub range: Option<[f64; 2]>,
}

/// One pair of axes with its curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    pub(super) title: String,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) series: Vec<Series>,
    pub(super) markers: Vec<(f64, String)>,
    /// Start and name of each section.
    pub(super) sections: Vec<(f64, String)>,
    pub(super) zero_line: bool,
    pub(super) robust_y: bool,
}

impl Chart {
    /// A chart without curves; an empty title takes no room.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Labels the horizontal axis; write the unit: "time \[s\]".
    #[must_use]
    pub fn x_label(mut self, label: impl Into<String>) -> Self {
        self.x.label = label.into();
        self
    }

    /// Labels the vertical axis; write the unit: "force \[N\]".
    #[must_use]
    pub fn y_label(mut self, label: impl Into<String>) -> Self {
        self.y.label = label.into();
        self
    }

    /// Makes the horizontal axis logarithmic.
    #[must_use]
    pub fn log_x(mut self) -> Self {
        self.x.logarithmic = true;
        self
    }

    /// Makes the vertical axis logarithmic.
    #[must_use]
    pub fn log_y(mut self) -> Self {
        self.y.logarithmic = true;
        self
    }

    /// Fixes the horizontal range; what lies outside is cut off.
    #[must_use]
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.x.range = Some([low, high]);
        self
    }

    /// Fixes the vertical range; what lies outside is cut off.
    #[must_use]
    pub fn y_range(mut self, low: f64, high: f64) -> Self {
        self.y.range = Some([low, high]);
        self
    }

    /// Adds a curve; later curves lie above earlier ones.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds a vertical line at `x`, the limit of a regime for example; the automatic range includes it.
    #[must_use]
    pub fn marker(mut self, x: f64, label: impl Into<String>) -> Self {
        self.markers.push((x, label.into()));
        self
    }

    /// Adds a horizontal line at zero, which the automatic range then includes.
    #[must_use]
    pub fn zero_line(mut self) -> Self {
        self.zero_line = true;
        self
    }

    /// Adds a section that begins at `x`, a stage of a run for example: a thin line where it begins, its name above the
    /// frame where it fits. Give them in order.
    #[must_use]
    pub fn section(mut self, x: f64, name: impl Into<String>) -> Self {
        self.sections.push((x, name.into()));
        self
    }

    /// Lets the vertical range follow the bulk of the values where a few would stretch it to many times that; what lies
    /// beyond is marked at the edge and told in a note. Has no effect on a fixed range.
    #[must_use]
    pub fn robust_y(mut self) -> Self {
        self.robust_y = true;
        self
    }

    /// Writes the chart as a figure of its own; the ending of `path` names the format.
    ///
    /// # Errors
    /// An ending other than `png` and `svg`, or a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), IoError> {
        Figure::new().panel(self.clone()).write(path)
    }

    /// Palette number of each series.
    pub(super) fn colours(&self) -> Vec<usize> {
        let mut next = 0;
        let number = |series: &Series| {
            series.colour.unwrap_or_else(|| {
                next += 1;
                next - 1
            })
        };
        self.series.iter().map(number).collect()
    }
}
