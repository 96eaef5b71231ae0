//! Vertical range of a chart.

use super::axis::{LARGEST, PADDING, Scale};
use super::chart::{Axis, Chart};

/// Share of the values at each end that a robust range may leave out.
const TAIL: f64 = 0.01;

/// A robust range leaves the tails out only where they would stretch the axis more than this many times.
const STRETCH: f64 = 3.0;

/// Free room beyond the bulk of the values, over its span.
const MARGIN: f64 = 0.5;

/// The vertical scale that a chart asks for.
pub(super) fn vertical_scale(chart: &Chart) -> Scale {
    let values = || {
        let ends = chart
            .series
            .iter()
            .flat_map(|series| series.error_bars().flat_map(|(x, ends)| ends.map(|end| (x, end))));
        // A lower end that a logarithmic axis has no place for stretches nothing.
        let points = chart.series.iter().flat_map(|series| series.points.iter().copied()).chain(ends);
        // A value whose abscissa cannot be shown must not stretch the axis.
        points.filter(|(x, _)| x.is_finite() && (!chart.x.logarithmic || *x > 0.0)).map(|(_, y)| y)
    };
    let zero = chart.zero_line.then_some(0.0);
    if chart.robust_y
        && chart.y.range.is_none()
        && let Some(range) = bulk(values(), zero)
    {
        return Scale::new(&Axis { range: Some(range), ..chart.y.clone() }, std::iter::empty());
    }
    Scale::new(&chart.y, values().chain(zero))
}

/// Whether values beyond the vertical scale are left out without being asked for, so that they have to be marked.
pub(super) fn leaves_out(chart: &Chart) -> bool {
    chart.robust_y && chart.y.range.is_none()
}

/// Ends that hold all but the tails of the values, where the tails would stretch the axis much.
fn bulk(values: impl Iterator<Item = f64>, zero: Option<f64>) -> Option<[f64; 2]> {
    let mut values: Vec<f64> = values.filter(|value| value.abs() <= LARGEST).collect();
    values.sort_by(f64::total_cmp);
    let (least, most) = (*values.first()?, *values.last()?);
    let tail = (TAIL * values.len() as f64).ceil() as usize;
    let low = *values.get(tail)?;
    let high = *values.get(values.len().checked_sub(1 + tail)?)?;
    let (low, high) = (zero.map_or(low, |zero| low.min(zero)), zero.map_or(high, |zero| high.max(zero)));
    let span = high - low;
    let stretched = most.max(high) - least.min(low) > STRETCH * span;
    // An end without outliers is free of curves as in any automatic range.
    let ends = [
        (least.min(low) - PADDING * span).max(low - MARGIN * span),
        (most.max(high) + PADDING * span).min(high + MARGIN * span),
    ];
    (span > 0.0 && stretched).then_some(ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_spike_does_not_set_the_range_but_a_plateau_does() {
        let wave = (0..1000).map(|n| 40.0 * (0.02 * f64::from(n)).sin());
        let spike = wave.clone().chain([-700.0]);
        let range = bulk(spike, Some(0.0));
        assert!(range.is_some_and(|[low, high]| (-85.0..=-40.0).contains(&low) && high <= 44.0), "{range:?}");
        let plateau = wave.chain(std::iter::repeat_n(-700.0, 50));
        assert_eq!(bulk(plateau, Some(0.0)), None);
        assert_eq!(bulk([1.0, 2.0, f64::NAN].into_iter(), None), None);
        assert_eq!(bulk(std::iter::empty(), None), None);
    }
}
