//! Values that have no position on their axes: not-a-number, infinities, and what a robust range leaves out. Each is
//! counted in a note above the panel; those that lie beyond an end of the vertical axis are also marked there.

use super::axis::{LARGEST, Scale};
use super::bounds;
use super::chart::Chart;
use super::unit::{amount, quote};

/// Why a point is not drawn at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Reason {
    /// The value is not-a-number.
    NoValue,
    /// The value is infinite, or so large that no axis can hold it.
    Infinite { upwards: bool },
    /// The value is finite, but beyond the range of the axis.
    Beyond { upwards: bool },
    /// The axis is logarithmic and the value is not positive.
    NotPositive,
    /// The abscissa has no position.
    NoAbscissa,
}

impl Reason {
    /// Which end of the vertical axis marks the point: `true` for the upper one.
    pub(super) fn end(self) -> Option<bool> {
        match self {
            Self::Infinite { upwards } | Self::Beyond { upwards } => Some(upwards),
            _ => None,
        }
    }
}

/// Why a point is not drawn at its position, if so.
pub(super) fn reason(chart: &Chart, scales: [&Scale; 2], (x, y): (f64, f64)) -> Option<Reason> {
    let [across, upwards] = scales;
    if across.place(x).is_none() {
        return Some(Reason::NoAbscissa);
    }
    match upwards.place(y) {
        None if y.is_nan() => Some(Reason::NoValue),
        None if y.abs() > LARGEST => Some(Reason::Infinite { upwards: y > 0.0 }),
        None => Some(Reason::NotPositive),
        Some(place) if bounds::leaves_out(chart) && !(0.0..=1.0).contains(&place) => {
            Some(Reason::Beyond { upwards: place > 1.0 })
        }
        Some(_) => None,
    }
}

/// The points of one series that have one reason.
struct Tally {
    reason: Reason,
    count: usize,
    /// Indices of the first and the last such point.
    ends: [usize; 2],
    /// The value farthest from zero.
    extreme: f64,
}

/// Notes, one a line, on everything that a chart cannot show at its position.
pub(super) fn notes(chart: &Chart, scales: [&Scale; 2]) -> Vec<String> {
    // Curves that share a note share a line.
    let mut notes: Vec<(String, Vec<&str>)> = Vec::new();
    for series in &chart.series {
        for tally in tallies(chart, scales, &series.points) {
            let text = tally.text(chart, &series.points);
            match notes.iter_mut().find(|(known, _)| *known == text) {
                Some((_, labels)) => labels.push(&series.label),
                None => notes.push((text, vec![&series.label])),
            }
        }
    }
    notes.into_iter().map(|(text, labels)| with_labels(&text, &labels)).collect()
}

fn with_labels(text: &str, labels: &[&str]) -> String {
    let named = labels.iter().all(|label| !label.is_empty());
    match labels.len() {
        1 if !named => text.to_owned(),
        1..=3 if named => format!("{}: {text}", labels.join(", ")),
        count => format!("{count} curves: {text}"),
    }
}

fn tallies(chart: &Chart, scales: [&Scale; 2], points: &[(f64, f64)]) -> Vec<Tally> {
    let mut tallies: Vec<Tally> = Vec::new();
    for (index, &point) in points.iter().enumerate() {
        let Some(reason) = reason(chart, scales, point) else { continue };
        match tallies.iter_mut().find(|tally| tally.reason == reason) {
            Some(tally) => {
                tally.count += 1;
                tally.ends[1] = index;
                if point.1.abs() > tally.extreme.abs() {
                    tally.extreme = point.1;
                }
            }
            None => tallies.push(Tally { reason, count: 1, ends: [index; 2], extreme: point.1 }),
        }
    }
    tallies.sort_by_key(|tally| tally.reason);
    tallies
}

impl Tally {
    fn text(&self, chart: &Chart, points: &[(f64, f64)]) -> String {
        let position = self.position(chart, points);
        let extreme = amount(&chart.y.label, self.extreme);
        match self.reason {
            Reason::NoValue => format!("no value (NaN) {position}"),
            Reason::Infinite { upwards: true } => format!("+∞ {position}"),
            Reason::Infinite { upwards: false } => format!("\u{2212}∞ {position}"),
            Reason::Beyond { upwards } => {
                let direction = if upwards { "above" } else { "below" };
                format!("{direction} the axis {position}; extreme {extreme}")
            }
            Reason::NotPositive => format!("not positive {position}"),
            Reason::NoAbscissa => format!("{} of {} points have no position", self.count, points.len()),
        }
    }

    /// Which points these are.
    fn position(&self, chart: &Chart, points: &[(f64, f64)]) -> String {
        let [first, last] = self.ends;
        let at = |index: usize| quote(&chart.x.label, points[index].0);
        let one_run = last - first + 1 == self.count;
        if self.count == points.len() {
            "everywhere".to_owned()
        } else if self.count == 1 {
            format!("at {}", at(first))
        } else if one_run && last + 1 == points.len() {
            format!("from {} on", at(first))
        } else if one_run && first == 0 {
            format!("up to {}", at(last))
        } else if one_run {
            format!("from {} to {}", at(first), amount(&chart.x.label, points[last].0))
        } else {
            format!("at {} of {} points, the first at {}", self.count, points.len(), at(first))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Series;
    use crate::plot::bounds::vertical_scale;

    fn notes_of(chart: &Chart) -> Vec<String> {
        let abscissas = chart.series.iter().flat_map(|series| &series.points).map(|&(x, _)| x);
        notes(chart, [&Scale::new(&chart.x, abscissas), &vertical_scale(chart)])
    }

    fn over_time(of: impl Fn(u32) -> f64) -> Vec<(f64, f64)> {
        (0..1000).map(|n| (1.0e-6 * f64::from(n), of(n))).collect()
    }

    #[test]
    fn a_gap_and_an_infinity_are_told_with_curve_and_time() {
        let ended = || over_time(|n| if n < 400 { 1.0 } else { f64::NAN });
        let chart = Chart::new("")
            .x_label("time [s]")
            .series(Series::line("kinetic", ended()))
            .series(Series::line("elastic", ended()))
            .series(Series::line("adhesive", over_time(|n| if n < 7 { 1.0 } else { f64::INFINITY })))
            .series(Series::line("gap", over_time(|n| if n % 2 == 1 { f64::NAN } else { 1.0 })))
            .series(Series::line("whole", over_time(f64::from)));
        let expected = [
            "kinetic, elastic: no value (NaN) from time = 400 µs on",
            "adhesive: +∞ from time = 7 µs on",
            "gap: no value (NaN) at 500 of 1000 points, the first at time = 1 µs",
        ];
        assert_eq!(notes_of(&chart), expected);
    }

    #[test]
    fn what_a_robust_range_leaves_out_is_told_with_its_extreme() {
        let spike = over_time(|n| if n == 300 { -700.0 } else { 40.0 * (0.02 * f64::from(n)).sin() });
        let chart = Chart::new("").x_label("time [s]").y_label("stress [Pa]").robust_y();
        let chart = chart.series(Series::line("z", spike));
        assert_eq!(notes_of(&chart), ["z: below the axis at time = 300 µs; extreme \u{2212}700 Pa"]);
    }

    #[test]
    fn a_chart_of_finite_values_has_no_notes() {
        assert!(notes_of(&Chart::new("").series(Series::line("", over_time(f64::from)))).is_empty());
    }
}
