//! Curves that lie on one another: where a later one hides an earlier one it is dashed, so that the one below shows in the
//! gaps.

use super::chart::SeriesStyle;
use super::draw::{DASH, Panel};
use super::geometry::{Point, dashes};
use std::collections::HashSet;

/// Distance of the points that stand for a curve \[pt\].
const STEP: f64 = 1.0;

/// Curves nearer than about this cannot be told apart \[pt\].
const NEAR: f64 = 1.5;

/// Curves that run together for less than this merely cross \[pt\].
const CROSSING: f64 = 20.0;

/// Length in which a dash and its gap repeat \[pt\].
const PERIOD: f64 = 20.0;

/// A part of a curve, with dash and gap \[pt\]; `None` for a solid line.
pub(super) type Stroke = (Vec<Point>, Option<(f64, f64)>);

/// The strokes of each series.
pub(super) fn strokes(panel: &Panel<'_>) -> Vec<Vec<Stroke>> {
    // Where the curves so far lie.
    let mut drawn: Vec<HashSet<(i64, i64)>> = Vec::new();
    let mut all = Vec::new();
    for (number, series) in panel.chart.series.iter().enumerate() {
        let pieces = if series.style.is_unconnected() { Vec::new() } else { panel.pieces(number) };
        let strokes: Vec<Stroke> = if series.style == SeriesStyle::Dashed {
            pieces.iter().map(|piece| (piece.clone(), Some(DASH))).collect()
        } else {
            pieces.iter().flat_map(|piece| split(piece, &drawn)).collect()
        };
        all.push(strokes);
        let samples = pieces.iter().flat_map(|piece| dashes(piece, STEP, STEP)).flatten();
        drawn.push(samples.map(cell).collect());
    }
    all
}

fn cell((x, y): Point) -> (i64, i64) {
    ((x / NEAR).round() as i64, (y / NEAR).round() as i64)
}

/// How many of the curves so far lie below a point.
fn hidden(drawn: &[HashSet<(i64, i64)>], point: Point) -> usize {
    let (x, y) = cell(point);
    let near = |cells: &&HashSet<(i64, i64)>| {
        (-1..=1).any(|dx| (-1..=1).any(|dy| cells.contains(&(x + dx, y + dy))))
    };
    drawn.iter().filter(near).count()
}

/// Cuts a polyline where it begins or ceases to hide others.
fn split(piece: &[Point], drawn: &[HashSet<(i64, i64)>]) -> Vec<Stroke> {
    if drawn.iter().all(HashSet::is_empty) {
        return vec![(piece.to_vec(), None)];
    }
    let points = refined(piece);
    let counts: Vec<usize> = points.iter().map(|&point| hidden(drawn, point)).collect();
    let mut strokes: Vec<Stroke> = Vec::new();
    let mut start = 0;
    for run in counts.chunk_by(|a, b| (*a > 0) == (*b > 0)) {
        // Each run ends in the first point of the next one, so that they join.
        let end = (start + run.len()).min(points.len() - 1);
        let line = &points[start..=end];
        let most = run.iter().copied().max().unwrap_or(0);
        let dash = PERIOD / (most + 1) as f64;
        let pattern = (most > 0 && length(line) > CROSSING).then_some((dash, PERIOD - dash));
        match strokes.last_mut() {
            Some((last, None)) if pattern.is_none() => last.extend(&line[1..]),
            _ => strokes.push((line.to_vec(), pattern)),
        }
        start += run.len();
    }
    strokes
}

/// The polyline with so many more points that none of its segments is longer than a step.
fn refined(piece: &[Point]) -> Vec<Point> {
    let mut points: Vec<Point> = piece.first().copied().into_iter().collect();
    for pair in piece.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let count = (length(pair) / STEP).ceil().max(1.0) as usize;
        points.extend((1..count).map(|number| {
            let share = number as f64 / count as f64;
            (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
        }));
        points.push(to);
    }
    points
}

fn length(line: &[Point]) -> f64 {
    line.windows(2).map(|pair| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::geometry::Rectangle;
    use crate::plot::{Chart, Series};

    #[test]
    fn a_curve_is_dashed_where_it_hides_another_and_only_there() {
        let line = |slope: f64| [(0.0, 0.0), (1.0, slope)];
        let chart = Chart::new("")
            .series(Series::line("first", line(1.0)))
            .series(Series::line("same", line(1.0)))
            .series(Series::line("crosses", [(0.0, 1.0), (1.0, -1.0)]))
            .series(Series::line("leaves", [(0.0, 0.0), (0.5, 0.5), (1.0, -0.5)]));
        let outer = Rectangle { left: 0.0, top: 0.0, right: 600.0, bottom: 400.0 };
        let strokes = strokes(&Panel::new(&chart, outer, 50.0, 0.0));
        let patterns =
            |number: usize| strokes[number].iter().map(|(_, pattern)| *pattern).collect::<Vec<_>>();
        assert_eq!(patterns(0), [None]);
        assert_eq!(patterns(1), [Some((0.5 * PERIOD, 0.5 * PERIOD))]);
        assert_eq!(patterns(2), [None], "curves that cross hide little");
        let leaves = patterns(3);
        assert!(leaves.len() == 2 && leaves[1].is_none(), "{leaves:?}");
        assert!(leaves[0].is_some_and(|(dash, _)| dash < 0.4 * PERIOD), "two lie below: {leaves:?}");
        let whole: f64 = strokes[3].iter().map(|(line, _)| length(line)).sum();
        let uncut: f64 =
            Panel::new(&chart, outer, 50.0, 0.0).pieces(3).iter().map(|piece| length(piece)).sum();
        assert!((whole - uncut).abs() < 1e-9 * uncut, "nothing is lost in cutting: {whole} of {uncut}");
    }
}
