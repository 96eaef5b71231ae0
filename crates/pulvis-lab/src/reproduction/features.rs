//! Features of runs: numbers out of time series, against their bounds, in every variant.

use super::ReproductionError;
use super::results::{Kind, Results};
use super::series::{FinishedRun, Phased, in_cycles};
use pulvis_input::figure::{Feature, Fit, Measure, Source, Value};
use pulvis_math::elementary;

/// What a feature is in all variants that have its runs.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenFeature {
    /// What was looked for.
    pub feature: Feature,
    /// Number of the variant, and the value in it.
    pub values: Vec<(usize, f64)>,
}

impl SeenFeature {
    /// The mean over all variants; not a number if one of them is none.
    pub fn mean(&self) -> f64 {
        self.values.iter().map(|(_, value)| value).sum::<f64>() / self.values.len() as f64
    }

    /// The standard deviation between variants; not a number where there is one only.
    pub fn deviation(&self) -> f64 {
        let (mean, count) = (self.mean(), self.values.len() as f64);
        let squares: f64 = self.values.iter().map(|(_, value)| (value - mean) * (value - mean)).sum();
        (squares / (count - 1.0)).sqrt()
    }

    /// The standard error of the mean; not a number where there is one variant only.
    pub fn standard_error(&self) -> f64 {
        self.deviation() / (self.values.len() as f64).sqrt()
    }

    /// Whether a value lies between the bounds; what is no number does not.
    pub fn allows(&self, value: f64) -> bool {
        value >= self.feature.least && value <= self.feature.most
    }

    /// Whether the mean over the variants is as it has to be.
    pub fn is_seen(&self) -> bool {
        self.allows(self.mean())
    }

    /// Whether nothing is wrong with the program: it is seen, or known to be missed.
    pub fn passes(&self) -> bool {
        self.is_seen() || self.feature.known_to_miss.is_some()
    }
}

/// Looks for all features of a figure, in all variants.
pub(super) fn look_for(
    features: &[Feature],
    results: &Results<'_>,
) -> Result<Vec<SeenFeature>, ReproductionError> {
    let mut seen: Vec<SeenFeature> = Vec::with_capacity(features.len());
    for feature in features {
        let values = match &feature.source {
            Source::Rows { measure, over } => of_runs(measure, over.as_deref(), results)?,
            Source::Fit(fit) => of_fit(fit, &seen),
        };
        seen.push(SeenFeature { feature: feature.clone(), values });
    }
    Ok(seen)
}

/// A number of a line through the values of features, in each variant that all of them have.
fn of_fit(fit: &Fit, seen: &[SeenFeature]) -> Vec<(usize, f64)> {
    let features: Vec<&SeenFeature> = fit.of.iter().filter_map(|number| seen.get(*number)).collect();
    let Some(first) = features.first() else { return Vec::new() };
    let of_variant = |variant: usize| {
        let point = |one: &&SeenFeature| {
            let (_, value) = one.values.iter().find(|(number, _)| *number == variant)?;
            Some([elementary::powf(one.feature.at?, fit.power), *value])
        };
        let points: Option<Vec<[f64; 2]>> = features.iter().map(point).collect();
        let points = points?;
        let rows: Vec<Phased<'_>> = points.iter().map(|point| Phased::new(point, f64::NAN)).collect();
        let line = line(&rows, 0, 1);
        Some((variant, if fit.is_slope { line.slope } else { line.at_zero }))
    };
    first.values.iter().filter_map(|(variant, _)| of_variant(*variant)).collect()
}

/// A number of each run.
fn of_runs(
    of: &Measure,
    over: Option<&Measure>,
    results: &Results<'_>,
) -> Result<Vec<(usize, f64)>, ReproductionError> {
    let runs = |data: usize| match results.of(data).map(|of_data| &of_data.kind) {
        Some(Kind::Runs(runs)) => runs.as_slice(),
        _ => &[],
    };
    let mut values = Vec::new();
    for run in runs(of.data) {
        let mut value = measure(of, run)?;
        if let Some(over) = over {
            let other = runs(over.data).iter().find(|other| other.variant == run.variant);
            let Some(other) = other else { continue };
            value /= measure(over, other)?;
        }
        values.push((run.variant, value));
    }
    Ok(values)
}

/// Takes a number out of a run; not a number where the rows do not tell it.
pub(crate) fn measure(measure: &Measure, run: &FinishedRun<'_>) -> Result<f64, ReproductionError> {
    let (x, y) = (run.column(&measure.x)?, run.column(&measure.y)?);
    let rows = run.measured(measure)?;
    if measure.value.is_of_cycles() {
        let stage = measure.stage.unwrap_or(0);
        let all = run.rows(Some(stage));
        let [from, to] = measure.cycles.unwrap_or([0.0, run.cycles(stage)]);
        let cycles = Cycles { all: &all, x, y, from: from.ceil() as usize, to: to.floor() as usize };
        return Ok(match measure.value {
            Value::LoopArea => cycles.loop_area(),
            Value::Drift => cycles.drift(),
            _ => cycles.growth(),
        });
    }
    if let Some(formula) = measure.formula {
        let ratios = rows.iter().map(|row| row.at(y) / formula.at(row.at(x)));
        return Ok(ratios.sum::<f64>() / rows.len() as f64);
    }
    Ok(of_rows(measure.value, &rows, x, y))
}

fn of_rows(value: Value, rows: &[Phased<'_>], x: usize, y: usize) -> f64 {
    let ys = || rows.iter().map(|row| row.at(y));
    let nothing = f64::NAN;
    let first = ys().next().unwrap_or(nothing);
    let last = ys().next_back().unwrap_or(nothing);
    let at = |row: Option<&Phased<'_>>| row.map_or(nothing, |row| row.at(x));
    let by_y = |one: &&Phased<'_>, other: &&Phased<'_>| one.at(y).total_cmp(&other.at(y));
    match value {
        Value::First => first,
        Value::Last => last,
        Value::Change => last - first,
        Value::Minimum => ys().reduce(least).unwrap_or(nothing),
        Value::Maximum => ys().reduce(largest).unwrap_or(nothing),
        Value::Mean => ys().sum::<f64>() / rows.len() as f64,
        Value::WhereMinimum => at(rows.iter().min_by(by_y)),
        Value::WhereMaximum => at(rows.iter().max_by(by_y)),
        Value::Zero => zero(rows, x, y),
        Value::Slope => line(rows, x, y).slope,
        Value::AtZero => line(rows, x, y).at_zero,
        Value::Straightness => line(rows, x, y).straightness,
        Value::LoopArea | Value::Drift | Value::Growth | Value::OverFormula => nothing,
    }
}

/// The lesser of two; not a number if one is none.
fn least(one: f64, other: f64) -> f64 {
    if one.is_nan() || one < other { one } else { other }
}

/// The larger of two; not a number if one is none.
fn largest(one: f64, other: f64) -> f64 {
    if one.is_nan() || one > other { one } else { other }
}

/// x where y changes its sign for the first time, by a straight line between rows; where it never does, x where y is nearest
/// to zero.
fn zero(rows: &[Phased<'_>], x: usize, y: usize) -> f64 {
    let crossing = rows.array_windows().find(|[before, after]| before.at(y) * after.at(y) <= 0.0);
    if let Some([before, after]) = crossing {
        let (low, high) = (before.at(y), after.at(y));
        let share = if low == high { 0.0 } else { low / (low - high) };
        return before.at(x) + share * (after.at(x) - before.at(x));
    }
    let nearest = rows.iter().min_by(|one, other| one.at(y).abs().total_cmp(&other.at(y).abs()));
    nearest.map_or(f64::NAN, |row| row.at(x))
}

/// A straight line by least squares.
struct Line {
    slope: f64,
    /// R².
    straightness: f64,
    /// y at x = 0.
    at_zero: f64,
}

fn line(rows: &[Phased<'_>], x: usize, y: usize) -> Line {
    let count = rows.len() as f64;
    let mean = |column: usize| rows.iter().map(|row| row.at(column)).sum::<f64>() / count;
    let (x_mean, y_mean) = (mean(x), mean(y));
    let sum = |of: fn(f64, f64) -> f64| {
        rows.iter().map(|row| of(row.at(x) - x_mean, row.at(y) - y_mean)).sum::<f64>()
    };
    let [xx, xy, yy] = [sum(|x, _| x * x), sum(|x, y| x * y), sum(|_, y| y * y)];
    Line { slope: xy / xx, straightness: xy * xy / (xx * yy), at_zero: y_mean - xy / xx * x_mean }
}

/// Whole cycles of a stage.
struct Cycles<'r> {
    all: &'r [Phased<'r>],
    x: usize,
    y: usize,
    from: usize,
    to: usize,
}

impl Cycles<'_> {
    fn rows(&self, from: f64, to: f64) -> impl Iterator<Item = &Phased<'_>> {
        self.all.iter().filter(move |row| in_cycles(row.phase, from, to))
    }

    fn range(&self, column: usize) -> f64 {
        let values = || self.all.iter().map(|row| row.at(column));
        let ends = values().reduce(largest).zip(values().reduce(least));
        ends.map_or(f64::NAN, |(most, least)| most - least)
    }

    fn loop_area(&self) -> f64 {
        let area = |cycle: usize| {
            let rows: Vec<_> = self.rows(cycle as f64, (cycle + 1) as f64).collect();
            let part = |two: &[&Phased<'_>; 2]| {
                0.5 * (two[0].at(self.y) + two[1].at(self.y)) * (two[1].at(self.x) - two[0].at(self.x))
            };
            rows.array_windows().map(part).sum::<f64>().abs()
        };
        let area = (self.from..self.to).map(area).reduce(largest).unwrap_or(f64::NAN);
        area / (self.range(self.x) * self.range(self.y))
    }

    /// What counts of a cycle's end is a mean over its last tenth, so that waves in the sample do not.
    fn drift(&self) -> f64 {
        const LAST: f64 = 0.1;
        let mean = |cycle: usize| {
            let rows = self.rows(cycle as f64 - LAST, cycle as f64).map(|row| row.at(self.y));
            let rows: Vec<f64> = rows.collect();
            rows.iter().sum::<f64>() / rows.len() as f64
        };
        let means = || (self.from.max(1)..=self.to).map(mean);
        let ends = means().reduce(largest).zip(means().reduce(least));
        ends.map_or(f64::NAN, |(most, least)| (most - least) / self.range(self.y))
    }

    fn growth(&self) -> f64 {
        let peak = |cycle: usize| {
            let values = self.rows(cycle as f64, (cycle + 1) as f64).map(|row| row.at(self.y));
            values.reduce(largest).unwrap_or(f64::NAN)
        };
        let peaks: Vec<f64> = (self.from..self.to).map(peak).collect();
        let ratios = peaks.array_windows().map(|[before, after]| after / before);
        ratios.reduce(largest).unwrap_or(f64::NAN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two cycles of x = (1 − cos 2πt)/2 with 200 rows each, and y as a function of x, of the way back and of the cycle.
    fn cycles(of: fn(f64, bool, usize) -> f64) -> Vec<([f64; 2], f64)> {
        let phase = |row: usize| row as f64 / 200.0;
        let x =
            |row: usize| 0.5 - 0.5 * pulvis_math::elementary::cos(2.0 * std::f64::consts::PI * phase(row));
        (0..=400).map(|row| ([x(row), of(x(row), row % 200 > 100, row / 200)], phase(row))).collect()
    }

    fn phased(rows: &[([f64; 2], f64)]) -> Vec<Phased<'_>> {
        rows.iter().map(|(row, phase)| Phased::new(row, *phase)).collect()
    }

    #[test]
    fn a_straight_way_has_its_slope_its_zero_and_no_loop() {
        let rows = cycles(|x, _, _| 3.0 - 4.0 * x);
        let rows = phased(&rows);
        assert!((of_rows(Value::Slope, &rows, 0, 1) + 4.0).abs() < 1e-12);
        assert!((of_rows(Value::AtZero, &rows, 0, 1) - 3.0).abs() < 1e-12);
        assert!((of_rows(Value::Straightness, &rows, 0, 1) - 1.0).abs() < 1e-12);
        assert!((of_rows(Value::Zero, &rows, 0, 1) - 0.75).abs() < 1e-12);
        assert!((of_rows(Value::WhereMinimum, &rows, 0, 1) - 1.0).abs() < 1e-12);
        let whole = Cycles { all: &rows, x: 0, y: 1, from: 0, to: 2 };
        assert!(whole.loop_area().abs() < 1e-12 && whole.drift().abs() < 1e-12);
        assert!((whole.growth() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_square_root_through_three_features_has_its_value_at_zero_and_its_slope_in_each_variant() {
        // v = 6 + 8 at^(1/2) in the first variant and 5 + 2 at^(1/2) in the second, which one feature lacks in a third.
        let feature = |at: f64, values: Vec<(usize, f64)>| {
            let fit = Fit { of: Vec::new(), power: 1.0, is_slope: false };
            let [key, what, why] = ["A", "a number", "no reason"].map(str::to_owned);
            let (least, most, known_to_miss) = (f64::NEG_INFINITY, f64::INFINITY, None);
            let source = Source::Fit(fit);
            let feature = Feature { key, what, at: Some(at), source, least, most, why, known_to_miss };
            SeenFeature { feature, values }
        };
        let seen = [
            feature(1.0, vec![(0, 14.0), (1, 7.0), (2, 0.0)]),
            feature(4.0, vec![(0, 22.0), (1, 9.0)]),
            feature(9.0, vec![(0, 30.0), (1, 11.0), (2, 0.0)]),
        ];
        for (is_slope, expected) in [(false, [6.0, 5.0]), (true, [8.0, 2.0])] {
            let found = of_fit(&Fit { of: vec![0, 1, 2], power: 0.5, is_slope }, &seen);
            assert_eq!(found.iter().map(|(variant, _)| *variant).collect::<Vec<_>>(), [0, 1]);
            assert!(
                found.iter().zip(expected).all(|((_, value), expected)| (value - expected).abs() < 1e-12)
            );
        }
    }

    #[test]
    fn a_loop_of_a_first_cycle_does_not_count_for_the_second() {
        // The way back lies lower by x (1 − x) in the first cycle only: an area of 1/6, over ranges 1 and 1.
        let rows = cycles(|x, back, cycle| if back && cycle == 0 { x - x * (1.0 - x) } else { x });
        let rows = phased(&rows);
        let area = |from, to| Cycles { all: &rows, x: 0, y: 1, from, to }.loop_area();
        assert!((area(0, 1) - 1.0 / 6.0).abs() < 1e-4, "{}", area(0, 1));
        assert!((area(0, 2) - 1.0 / 6.0).abs() < 1e-4 && area(1, 2).abs() < 1e-12);
    }

    #[test]
    fn what_rows_do_not_tell_is_no_number_and_is_not_seen() {
        for value in
            [Value::First, Value::Maximum, Value::Mean, Value::Slope, Value::Zero, Value::WhereMaximum]
        {
            assert!(of_rows(value, &[], 0, 1).is_nan(), "{value:?}");
        }
        let rows = cycles(|x, back, _| if back { f64::NAN } else { x });
        let rows = phased(&rows);
        assert!(
            of_rows(Value::Maximum, &rows, 0, 1).is_nan() && of_rows(Value::Minimum, &rows, 0, 1).is_nan()
        );
        assert!(Cycles { all: &rows, x: 0, y: 1, from: 0, to: 2 }.loop_area().is_nan());
        assert!(Cycles { all: &rows, x: 0, y: 1, from: 3, to: 3 }.loop_area().is_nan());
    }
}
