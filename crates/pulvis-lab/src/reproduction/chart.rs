//! The picture of a figure, and the table of all its points.

use super::curves::{Curve, Identity, curves};
use super::results::{Kind, Results};
use super::{ReproductionError, SeenFeature};
use crate::collision::sticking_limits;
use pulvis_input::figure::{FigureAxis, FigurePanel, FigureScenario, FigureSeries};
use pulvis_io::plot::{Chart, Figure, Series, SeriesStyle};
use pulvis_io::table::{Cell, Table};

/// Columns of the table of points.
const COLUMNS: [&str; 6] = ["panel", "x_axis", "y_axis", "curve", "x", "y"];

pub(super) fn draw(
    figure: &FigureScenario,
    results: &Results<'_>,
    features: &[SeenFeature],
) -> Result<(Figure, Table), ReproductionError> {
    let mut picture = Figure::new().columns(figure.columns);
    let mut table = Table::new(COLUMNS);
    for (number, panel) in figure.panels.iter().enumerate() {
        let drawn = panel.series.iter().map(|series| Ok((series, curves(panel, series, results, features)?)));
        let drawn = drawn.collect::<Result<Vec<_>, ReproductionError>>()?;
        let mut known: Vec<Identity> = Vec::new();
        for curve in drawn.iter().flat_map(|(_, curves)| curves) {
            if !known.contains(&curve.identity) {
                known.push(curve.identity);
            }
        }
        let mut painter = Painter { panel, chart: empty(panel), known, table: &mut table, number };
        painter.add_guides()?;
        for (series, curves) in drawn {
            painter.add(series, curves)?;
        }
        picture = picture.panel(painter.finish(results));
    }
    Ok((picture, table))
}

fn empty(panel: &FigurePanel) -> Chart {
    let mut chart = Chart::new(&panel.title).x_label(&panel.x.label).y_label(&panel.y.label).zero_line();
    if panel.x.logarithmic {
        chart = chart.log_x();
    }
    if panel.y.logarithmic {
        chart = chart.log_y();
    }
    if let Some([low, high]) = panel.x.range {
        chart = chart.x_range(low, high);
    }
    if let Some([low, high]) = panel.y.range {
        chart = chart.y_range(low, high);
    }
    chart
}

/// Symbols in one chart that is not crowded.
const MOST_CROSSES: usize = 90;

/// What can be drawn of a curve. It begins and ends where it has values: no energy has no place on a logarithmic axis, and a
/// root of something negative has none at all. Gaps inside stay. Of many crosses some are left out.
fn drawable(panel: &FigurePanel, style: SeriesStyle, points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let on = |axis: &FigureAxis, value: f64| value.is_finite() && (value > 0.0 || !axis.logarithmic);
    let has_place = |&(x, y): &(f64, f64)| on(&panel.x, x) && on(&panel.y, y);
    if !matches!(style, SeriesStyle::Line | SeriesStyle::Dashed) {
        let every = points.len().div_ceil(MOST_CROSSES).max(1);
        return points.into_iter().step_by(every).filter(has_place).collect();
    }
    let first = points.iter().position(has_place).unwrap_or(0);
    let last = points.iter().rposition(has_place).map_or(0, |last| last + 1);
    points.get(first..last).unwrap_or_default().to_vec()
}

/// The way of a curve at one of its points. Waves are shorter than the part of it that is looked at.
fn direction(points: &[(f64, f64)], place: usize) -> Option<[(f64, f64); 2]> {
    let half = points.len() / 40 + 1;
    let last = points.len().checked_sub(1)?;
    let ends = [place.saturating_sub(half), (place + half).min(last)];
    let [from, to] = ends.map(|place| points.get(place).copied());
    Some([from?, to?])
}

struct Painter<'p> {
    panel: &'p FigurePanel,
    chart: Chart,
    /// What has a colour, in the order of the palette.
    known: Vec<Identity>,
    table: &'p mut Table,
    number: usize,
}

impl Painter<'_> {
    /// What belongs together has one colour. Where all does, methods have colours of their own.
    fn colour(&self, identity: Identity, style: SeriesStyle, method: &str) -> usize {
        let place = self.known.iter().position(|known| *known == identity).unwrap_or(0);
        match (self.known.len(), style) {
            (1, SeriesStyle::Crosses) => 1,
            (1, SeriesStyle::Rings) if method == "reference" => 2,
            (1, SeriesStyle::Dashed) => 2,
            _ => place,
        }
    }

    /// Adds the curves of a series. Lines are named by what they belong to, symbols by what they are.
    fn add(&mut self, series: &FigureSeries, curves: Vec<Curve>) -> Result<(), ReproductionError> {
        let alone = curves.len() == 1;
        for (number, curve) in curves.into_iter().enumerate() {
            let Curve { identity, subject, method, style, points, arrows, thick } = curve;
            let colour = self.colour(identity, style, method);
            let subject = subject.unwrap_or_else(|| method.to_owned());
            let name = match &series.label {
                _ if !series.in_legend => String::new(),
                Some(label) if number == 0 => label.clone(),
                Some(_) => String::new(),
                None if style == SeriesStyle::Line => subject.clone(),
                None if number == 0 => method.to_owned(),
                None => String::new(),
            };
            let in_table =
                series.label.clone().filter(|_| alone).unwrap_or_else(|| {
                    if subject == method { subject } else { format!("{method}: {subject}") }
                });
            self.write(&in_table, identity.3, &points)?;
            let arrows: Vec<_> = arrows.iter().filter_map(|place| direction(&points, *place)).collect();
            let mut drawn = Series::new(name, style, drawable(self.panel, style, points));
            drawn = drawn.colour(colour).arrows(arrows);
            if thick {
                drawn = drawn.thick();
            }
            self.chart = std::mem::take(&mut self.chart).series(drawn);
        }
        Ok(())
    }

    fn write(&mut self, curve: &str, y: &str, points: &[(f64, f64)]) -> Result<(), ReproductionError> {
        let keys = [self.panel.x.key(), self.panel.y.key_of(y), curve.to_owned()];
        for (x, y) in points {
            let panel = Cell::from((self.number + 1).to_string());
            let labels = keys.clone().map(Cell::from);
            self.table.push([panel].into_iter().chain(labels).chain([(*x).into(), (*y).into()]))?;
        }
        Ok(())
    }

    /// Adds lines for the eye.
    fn add_guides(&mut self) -> Result<(), ReproductionError> {
        // Grey is the last of the palette.
        const GREY: usize = 6;
        for guide in &self.panel.guides {
            let points = guide.ends.map(|[x, y]| (x, y));
            self.write(&guide.label, self.panel.y.quantity.name, &points)?;
            let line = Series::dashed(&guide.label, points).colour(GREY);
            self.chart = std::mem::take(&mut self.chart).series(line);
        }
        Ok(())
    }

    /// Adds the limits of sticking.
    fn finish(mut self, results: &Results<'_>) -> Chart {
        if !self.panel.limits {
            return self.chart;
        }
        let first = self.panel.series.first().and_then(|series| results.of(series.data));
        if let Some(Kind::Collisions { scenario, exact, .. }) = first.map(|of_data| &of_data.kind) {
            for (value, name) in sticking_limits(scenario, exact) {
                self.chart = std::mem::take(&mut self.chart).marker(value, name);
            }
        }
        self.chart
    }
}
