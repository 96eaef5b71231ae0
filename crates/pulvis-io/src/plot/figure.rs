//! Charts stacked into one picture, and the file formats.

use super::canvas::{Across, Along, Canvas, Setting};
use super::chart::Chart;
use super::draw::{self, Panel};
use super::geometry::Rectangle;
use super::{legend, raster, vector};
use crate::{Colour, IoError};
use plotters::prelude::DrawingBackend;
use std::path::Path;

/// Every file format of figures. A new one is a file beside this one and a line here.
pub const FORMATS: &[PlotFormat] = &[raster::FORMAT, vector::FORMAT];

/// A file format of figures.
#[derive(Clone, Copy, Debug)]
pub struct PlotFormat {
    /// Ending of its files, without the dot.
    pub extension: &'static str,
    /// What it is good for, in one line.
    pub summary: &'static str,
    /// The writer.
    pub(super) write: fn(&Figure, &Path) -> Result<(), IoError>,
}

/// Charts under one another in one picture, their axes in line, perhaps in more than one column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    title: String,
    panels: Vec<Chart>,
    columns: usize,
    size: Option<(u32, u32)>,
    dpi: Option<u32>,
}

impl Figure {
    /// Smallest and largest side of a figure \[pt\].
    const SIDES: [u32; 2] = [120, 4000];

    /// Width unless told otherwise \[pt\].
    const WIDTH: u32 = 640;

    /// By how much a further column of charts widens it \[pt\].
    const FURTHER_COLUMN: u32 = 280;

    /// A figure without charts.
    pub fn new() -> Self {
        Self::default()
    }

    /// A heading above all charts.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Adds a chart below those there are.
    #[must_use]
    pub fn panel(mut self, chart: Chart) -> Self {
        self.panels.push(chart);
        self
    }

    /// Sets the number of charts beside one another; the first row is filled first.
    #[must_use]
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns;
        self
    }

    /// Fewest and most pixels to the inch.
    pub const RESOLUTIONS: [u32; 2] = [36, 600];

    /// Sets the number of pixels to the inch of a PNG, 144 unless told otherwise; kept within [`Self::RESOLUTIONS`].
    #[must_use]
    pub fn dpi(mut self, dpi: u32) -> Self {
        self.dpi = Some(dpi);
        self
    }

    /// Pixels to the inch.
    pub(super) fn resolution(&self) -> u32 {
        let [least, most] = Self::RESOLUTIONS;
        self.dpi.unwrap_or(raster::DPI).clamp(least, most)
    }

    /// Sets the size of the whole figure \[pt\]; a PNG has two pixels per point unless told otherwise.
    #[must_use]
    pub fn sized(mut self, width: u32, height: u32) -> Self {
        self.size = Some((width, height));
        self
    }

    /// The figure as SVG, to stand in a page.
    ///
    /// # Errors
    /// A size that cannot be drawn.
    pub fn to_svg(&self) -> Result<String, IoError> {
        self.check_size()?;
        vector::text(self)
    }

    fn check_size(&self) -> Result<(), IoError> {
        let (width, height) = self.size();
        let [least, most] = Self::SIDES;
        if [width, height].into_iter().any(|side| !(least..=most).contains(&side)) {
            return Err(IoError::PictureSize { width, height, least, most });
        }
        Ok(())
    }

    /// Writes the figure; the ending of `path` names the format.
    ///
    /// # Errors
    /// An ending that is not in [`FORMATS`], a size that cannot be drawn, or a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), IoError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        let format = FORMATS.iter().find(|format| format.extension.eq_ignore_ascii_case(&ending));
        let format = format.ok_or_else(|| IoError::UnknownFormat {
            what: "plot",
            given: ending.into_owned(),
            known: FORMATS.iter().map(|format| format.extension).collect::<Vec<_>>().join(", "),
        })?;
        self.check_size()?;
        (format.write)(self, path)
    }

    /// Width and height \[pt\].
    pub(super) fn size(&self) -> (u32, u32) {
        let [columns, rows] = self.grid();
        let width = Self::WIDTH + Self::FURTHER_COLUMN * (columns as u32 - 1);
        let height = match rows {
            0 | 1 if columns == 1 => 420,
            0 | 1 => 340,
            // Fifteen panels fill the tallest figure; more share its height.
            many => (270 * many.min(14)) as u32,
        };
        self.size.unwrap_or((width.min(Self::SIDES[1]), height))
    }

    /// Columns and rows.
    fn grid(&self) -> [usize; 2] {
        let columns = self.columns.clamp(1, self.panels.len().max(1));
        [columns, self.panels.len().div_ceil(columns)]
    }

    /// Draws all charts.
    pub(super) fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let (width, height) = self.size();
        let (right, bottom) = (f64::from(width), f64::from(height));
        let page = [(0.0, 0.0), (right, 0.0), (right, bottom), (0.0, bottom)];
        canvas.fill(&page, Colour::WHITE, 1.0)?;
        let mut top = 0.0;
        if !self.title.is_empty() {
            let (along, across) = (Along::Middle, Across::Top);
            let setting = Setting { size: 16.0, colour: Colour::grey(0x10), along, across, upwards: false };
            canvas.text((0.5 * right, 9.0), &self.title, setting)?;
            top = 26.0;
        }
        let [columns, rows] = self.grid();
        let share = (bottom - top) / rows.max(1) as f64;
        let width = right / columns as f64;
        // One left margin for each column, so that axes with the same quantity lie above one another.
        let margin = |number: usize| draw::left_margin(&self.panels[number], share);
        let in_column = |column: usize| (column..self.panels.len()).step_by(columns);
        let margins: Vec<f64> =
            (0..columns).map(|column| in_column(column).map(margin).fold(0.0, f64::max)).collect();
        let panel = |number: usize, room_right: f64| {
            let (column, row) = (number % columns, number / columns);
            let (left, top) = (width * column as f64, top + share * row as f64);
            let outer = Rectangle { left, top, right: left + width, bottom: top + share };
            Panel::new(&self.panels[number], outer, margins[column], room_right)
        };
        let all = 0..self.panels.len();
        let room_right =
            all.clone().map(|number| legend::width_outside(&panel(number, 0.0))).fold(0.0, f64::max);
        all.into_iter().try_for_each(|number| panel(number, room_right).draw(canvas))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::super::raster::Decoded;
    use super::*;
    use crate::plot::Series;

    /// Charts that a careless caller could make.
    fn strange() -> Figure {
        let far =
            [(f64::MIN, 1.0), (f64::NAN, 2.0), (0.0, f64::INFINITY), (1.0, 1.0e299), (5e-324, -1.0e299)];
        let styles = || {
            [Series::line("line", far), Series::dashed("dashed", far), Series::points("points", far)]
                .into_iter()
        };
        let filled =
            |chart: Chart| styles().fold(chart, Chart::series).marker(f64::NAN, "").marker(0.5, "half");
        Figure::new()
            .title("<strange> & \"quoted\" \u{1F600}")
            .panel(Chart::default())
            .panel(Chart::new("empty").series(Series::line("", [])).series(Series::points("none", [])))
            .panel(filled(Chart::new("linear").zero_line()))
            .panel(filled(Chart::new("logarithmic").log_x().log_y().zero_line()))
            .panel(filled(Chart::new("narrow").x_range(0.0, 1.0e-200).y_range(2.0, 1.0)))
            .panel(filled(Chart::new("fixed").x_range(f64::NAN, 1.0).y_range(3.0, 3.0)))
    }

    #[test]
    fn nothing_that_can_be_plotted_panics_in_any_format() {
        let folder = tempfile::tempdir().unwrap();
        for format in FORMATS {
            let path = folder.path().join("strange").with_extension(format.extension);
            strange().write(&path).unwrap();
            strange().sized(120, 120).write(&path).unwrap();
            Figure::new().write(&path).unwrap();
        }
    }

    #[test]
    fn a_png_has_two_pixels_per_point_and_shows_the_curve_in_its_colour() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("chart.png");
        let curve = Series::line("", [(0.0, 0.0), (1.0, 1.0)]);
        Figure::new().panel(Chart::new("").series(curve)).sized(200, 150).write(&path).unwrap();
        let image = Decoded::open(&path).unwrap();
        assert_eq!((image.width, image.height), (400, 300));
        let Colour { red, green, blue } = Colour::palette(0);
        let count = image.pixels.iter().filter(|&&pixel| pixel == [red, green, blue]).count();
        assert!(count > 300, "a diagonal over most of the picture: {count} pixels");
        assert_eq!(image.pixel(0, 0), [255; 3]);
    }

    #[test]
    fn a_png_of_other_resolution_has_as_many_pixels_to_the_inch() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("chart.png");
        // 144 pt are two inches.
        for (dpi, width) in [(72, 144), (300, 600), (600, 1200)] {
            let curve = Series::line("", [(0.0, 0.0), (1.0, 1.0)]);
            let figure = Figure::new().panel(Chart::new("").series(curve)).sized(144, 144).dpi(dpi);
            figure.write(&path).unwrap();
            assert_eq!(Decoded::open(&path).unwrap().width, width);
            let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
            let reader = png::Decoder::new(file).read_info().unwrap();
            let written = f64::from(reader.info().pixel_dims.unwrap().xppu) * 0.0254;
            assert!((written - f64::from(dpi)).abs() < 0.1, "{written}");
        }
    }

    #[test]
    fn an_svg_is_sized_in_points_and_escapes_its_texts() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("chart.SVG");
        Chart::new("a < b & c").write(&path).unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        assert!(text.starts_with("<svg width=\"640\" height=\"420\""), "{}", &text[..80]);
        assert!(text.contains("a &lt; b &amp; c") && text.trim_end().ends_with("</svg>"));
    }

    /// The SVG text of a chart over 0 to 99 µs.
    fn svg(of: impl Fn(u32) -> f64) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("chart.svg");
        let points = (0..100).map(|n| (1.0e-6 * f64::from(n), of(n)));
        Chart::new("").x_label("time [s]").series(Series::line("", points)).write(&path).unwrap();
        std::fs::read_to_string(path).unwrap()
    }

    /// Polylines in the colour of the first curve, and filled polygons in it.
    fn curves_and_arrows(svg: &str) -> (usize, usize) {
        let colour = svg.lines().filter(|line| line.contains("#0072B2"));
        let count = |kind: &str| colour.clone().filter(|line| line.contains(kind)).count();
        (count("<polyline"), count("<polygon"))
    }

    #[test]
    fn a_gap_is_a_gap_with_a_note() {
        let whole = svg(f64::from);
        assert_eq!(curves_and_arrows(&whole), (1, 0));
        assert!(!whole.contains("NaN"));
        let gap = svg(|n| if (40..60).contains(&n) { f64::NAN } else { f64::from(n) });
        assert_eq!(curves_and_arrows(&gap), (2, 0), "a curve on either side");
        assert!(gap.contains("no value (NaN) from time = 40 µs to 59 µs"), "{gap}");
    }

    #[test]
    fn infinities_are_arrows_at_the_edge_with_a_note() {
        let svg = svg(|n| if n == 50 { f64::INFINITY } else { f64::from(n) });
        assert_eq!(curves_and_arrows(&svg), (2, 1));
        assert!(svg.contains("+∞ at time = 50 µs"), "{svg}");
        let exploded = self::svg(|n| if n < 50 { f64::from(n) } else { f64::NEG_INFINITY });
        let (curves, arrows) = curves_and_arrows(&exploded);
        assert!(curves == 1 && arrows > 10, "a row of arrows: {arrows}");
        assert!(exploded.contains("\u{2212}∞ from time = 50 µs on"), "{exploded}");
    }

    #[test]
    fn a_panel_without_a_finite_value_says_so_and_has_no_invented_range() {
        for value in [f64::NAN, f64::INFINITY] {
            let svg = svg(|_| value);
            assert!(svg.contains("no finite value to show"), "{svg}");
            let texts: Vec<&str> = svg.lines().map(str::trim).collect();
            assert!(!texts.contains(&"\u{2212}1.0") && !texts.contains(&"0.5"), "no vertical ticks: {svg}");
        }
    }

    #[test]
    fn a_single_finite_value_is_a_dot_and_is_told_to_be_single() {
        let svg = svg(|n| if n == 0 { 0.0 } else { f64::NAN });
        assert!(svg.contains("only 1 of 100 values are finite"), "{svg}");
        assert!(svg.lines().any(|line| line.contains("<circle") && line.contains("#0072B2")), "{svg}");
    }

    #[test]
    fn error_bars_reach_as_far_as_they_are_told_and_no_range_cuts_them_off() {
        let bars = |errors: [f64; 2]| {
            let series = Series::points("", [(0.0, 1.0), (1.0, 2.0)]).errors(errors);
            Figure::new().panel(Chart::new("").y_range(0.0, 4.0).series(series)).to_svg().unwrap()
        };
        let lines = |svg: &str| {
            svg.lines().filter(|line| line.contains("#0072B2") && line.contains("<polyline")).count()
        };
        // A bar has a line and two ends; one that is zero or no number has none.
        assert_eq!([[0.5, 0.25], [0.5, f64::NAN], [0.0, -1.0]].map(|errors| lines(&bars(errors))), [6, 3, 0]);
        let series = Series::points("", [(0.0, 1.0), (1.0, 2.0)]).errors([100.0, 0.0]);
        let free = Figure::new().panel(Chart::new("").series(series)).to_svg().unwrap();
        let texts: Vec<&str> = free.lines().map(str::trim).collect();
        assert!(texts.contains(&"\u{2212}100") && texts.contains(&"100"), "{free}");
    }

    #[test]
    fn other_endings_and_sizes_are_refused() {
        let error = Chart::new("").write(Path::new("chart.pdf")).unwrap_err();
        assert_eq!(error.to_string(), "no plot format is called `pdf`; choose one of: png, svg");
        assert!(matches!(Chart::new("").write(Path::new("chart")), Err(IoError::UnknownFormat { .. })));
        let error = Figure::new().sized(100_000, 100).write(Path::new("chart.png"));
        assert!(matches!(error, Err(IoError::PictureSize { .. })));
    }
}
