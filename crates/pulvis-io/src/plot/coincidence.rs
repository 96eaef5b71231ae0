//! Curves that lie on one another: the later ones are dashed, so that those below show in the gaps.

use super::chart::SeriesStyle;
use super::draw::{DASH, Panel};
use super::geometry::{Point, dashes};
use std::collections::HashSet;

/// Distance of the points that stand for a curve \[pt\].
const STEP: f64 = 1.0;

/// Curves nearer than about this cannot be told apart \[pt\].
const NEAR: f64 = 1.5;

/// A curve counts as hidden when more than this share of it lies below a later one.
const HIDDEN: f64 = 0.5;

/// Length in which a dash and its gap repeat \[pt\].
const PERIOD: f64 = 20.0;

/// Dash and gap \[pt\] of each series; `None` for a solid line.
pub(super) fn patterns(panel: &Panel<'_>) -> Vec<Option<(f64, f64)>> {
    let curves: Vec<Vec<Point>> =
        (0..panel.chart.series.len()).map(|number| samples(panel, number)).collect();
    let pattern = |number: usize| match panel.chart.series[number].style {
        SeriesStyle::Dashed => Some(DASH),
        SeriesStyle::Points => None,
        SeriesStyle::Line => {
            let cells: HashSet<(i64, i64)> = curves[number].iter().map(|&point| cell(point)).collect();
            let hidden = curves[..number].iter().filter(|earlier| hides(&cells, earlier)).count();
            let dash = PERIOD / (hidden + 1) as f64;
            (hidden > 0).then_some((dash, PERIOD - dash))
        }
    };
    (0..curves.len()).map(pattern).collect()
}

fn samples(panel: &Panel<'_>, number: usize) -> Vec<Point> {
    if panel.chart.series[number].style == SeriesStyle::Points {
        return Vec::new();
    }
    panel.pieces(number).iter().flat_map(|piece| dashes(piece, STEP, STEP)).flatten().collect()
}

fn cell((x, y): Point) -> (i64, i64) {
    ((x / NEAR).round() as i64, (y / NEAR).round() as i64)
}

/// Whether a curve through `cells` hides most of an earlier one.
fn hides(cells: &HashSet<(i64, i64)>, earlier: &[Point]) -> bool {
    let near = |&&point: &&Point| {
        let (x, y) = cell(point);
        (-1..=1).any(|dx| (-1..=1).any(|dy| cells.contains(&(x + dx, y + dy))))
    };
    let covered = earlier.iter().filter(near).count();
    covered as f64 > HIDDEN * earlier.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::geometry::Rectangle;
    use crate::plot::{Chart, Series};

    #[test]
    fn a_curve_on_another_is_dashed_and_one_that_crosses_is_not() {
        let line = |slope: f64| [(0.0, 0.0), (1.0, slope)];
        let chart = Chart::new("")
            .series(Series::line("first", line(1.0)))
            .series(Series::line("same", line(1.0)))
            .series(Series::line("crosses", line(-1.0)))
            .series(Series::line("same again", line(1.0)));
        let outer = Rectangle { left: 0.0, top: 0.0, right: 600.0, bottom: 400.0 };
        let patterns = patterns(&Panel::new(&chart, outer, 50.0, 0.0));
        assert_eq!(patterns[0], None);
        assert_eq!(patterns[1], Some((0.5 * PERIOD, 0.5 * PERIOD)));
        assert_eq!(patterns[2], None);
        assert!(patterns[3].is_some_and(|(dash, _)| dash < 0.4 * PERIOD), "two lie below: {patterns:?}");
    }
}
