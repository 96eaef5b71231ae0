//! The pictures of a study: each measure over the first variable.

use super::folder::StudyFolder;
use super::results::{PointResult, StudyResults};
use pulvis_input::study::{Study, StudyMeasure, StudyVariable};
use pulvis_io::IoError;
use pulvis_io::plot::{Chart, Figure, Series, SeriesStyle};

/// Writes the picture of every measure as PNG, with `dpi` pixels to the inch, and as SVG.
pub(super) fn write_all(
    study: &Study,
    results: &StudyResults,
    output: &StudyFolder,
    dpi: u32,
) -> Result<(), IoError> {
    for (number, measure) in study.measures.iter().enumerate() {
        let figure = figure(study, results, number);
        figure.clone().dpi(dpi).write(&output.file(&format!("{}.png", measure.key)))?;
        figure.write(&output.file(&format!("{}.svg", measure.key)))?;
    }
    Ok(())
}

/// The picture of one measure.
pub(super) fn figure(study: &Study, results: &StudyResults, number: usize) -> Figure {
    let Some(measure) = study.measures.get(number) else { return Figure::new() };
    let mut chart = Chart::new("").y_label(with_unit(&measure.what, measure.unit.as_deref()));
    chart = match study.variables.first() {
        Some(variable) => over_variable(chart, study, results, (number, measure), variable),
        None => over_seeds(chart, results, (number, measure)),
    };
    Figure::new().panel(chart)
}

fn with_unit(words: &str, unit: Option<&str>) -> String {
    unit.filter(|unit| *unit != "1").map_or(words.to_owned(), |unit| format!("{words} [{unit}]"))
}

/// Where a value of a variable is drawn: at its number, or where it has none at 1, 2, 3.
fn place(variable: &StudyVariable, value: usize) -> f64 {
    let number = variable.values.get(value).and_then(|value| *value.numbers.first()?);
    number.filter(|_| has_numbers(variable)).unwrap_or((value + 1) as f64)
}

fn has_numbers(variable: &StudyVariable) -> bool {
    !variable.is_named && variable.keys.first().is_some_and(|key| key.unit.is_some())
}

fn label(variable: &StudyVariable) -> String {
    if has_numbers(variable) {
        let unit = variable.keys.first().and_then(|key| key.unit.as_deref());
        return with_unit(&variable.label, unit);
    }
    let names = variable.values.iter().zip(1..).map(|(value, number)| format!("{number}: {}", value.name));
    format!("{} ({})", variable.label, names.collect::<Vec<_>>().join(", "))
}

fn over_variable(
    mut chart: Chart,
    study: &Study,
    results: &StudyResults,
    (number, measure): (usize, &StudyMeasure),
    variable: &StudyVariable,
) -> Chart {
    chart = chart.x_label(label(variable));
    if variable.logarithmic && has_numbers(variable) {
        chart = chart.log_x();
    }
    let mut has_legend = false;
    for (curve, others) in curves(study).into_iter().enumerate() {
        let mut own: Vec<(f64, usize, &PointResult)> = Vec::new();
        for (index, (point, of_measures)) in study.points.iter().zip(&results.points).enumerate() {
            if let (Some((first, rest)), Some(result)) = (point.choice.split_first(), of_measures.get(number))
                && rest == others
            {
                own.push((place(variable, *first), index, result));
            }
        }
        own.sort_by(|one, other| one.0.total_cmp(&other.0));
        let drawn = own.iter().filter(|(.., result)| result.mean.is_finite());
        let (points, errors): (Vec<_>, Vec<_>) =
            drawn.map(|(x, _, result)| ((*x, result.mean), result.standard_error.unwrap_or(0.0))).unzip();
        let name = name(study, measure, &others);
        if let Some(expected) = &measure.expected {
            let values = own.iter().filter_map(|(x, index, _)| Some((*x, *expected.values.get(*index)?)));
            // One value for all curves is one line.
            let same = curve > 0 && expected.values.array_windows().all(|[one, other]| one == other);
            let words = if has_legend { "" } else { "expected" };
            if !same {
                chart = chart.series(Series::dashed(words, values).colour(curve));
                has_legend = true;
            }
        }
        let style = SeriesStyle::Points;
        chart = chart.series(Series::new(name, style, points).colour(curve).errors(errors));
    }
    chart
}

/// The choices of all variables but the first one, each once, in the order of the points.
fn curves(study: &Study) -> Vec<Vec<usize>> {
    let mut curves: Vec<Vec<usize>> = Vec::new();
    for point in &study.points {
        if let Some((_, others)) = point.choice.split_first()
            && !curves.iter().any(|known| known == others)
        {
            curves.push(others.to_vec());
        }
    }
    curves
}

/// What a curve is called: the values of the other variables. One that is alone needs no name.
fn name(study: &Study, measure: &StudyMeasure, others: &[usize]) -> String {
    let value = |(variable, choice): (&StudyVariable, &usize)| {
        let value = variable.values.get(*choice)?;
        Some(format!("{} = {}", variable.label, value.name))
    };
    let all: Vec<String> = study.variables.iter().skip(1).zip(others).filter_map(value).collect();
    if all.is_empty() && measure.expected.is_some() {
        "mean over the runs".to_owned()
    } else {
        all.join(", ")
    }
}

/// Without variables: each run, and their mean.
fn over_seeds(chart: Chart, results: &StudyResults, (number, measure): (usize, &StudyMeasure)) -> Chart {
    let place = |seed: u64| seed as f64;
    let points: Vec<(f64, f64)> =
        results.runs.iter().filter_map(|run| Some((place(run.seed), *run.values.get(number)?))).collect();
    let ends = [f64::min, f64::max].map(|of| points.iter().map(|(x, _)| *x).reduce(of));
    let mut chart = chart.x_label("seed");
    let level = |value: f64| ends.into_iter().flatten().map(move |x| (x, value)).collect::<Vec<_>>();
    if let Some(result) = results.points.first().and_then(|of_measures| of_measures.get(number)) {
        if result.mean.is_finite() && result.runs > 1 {
            chart = chart.series(Series::line("mean", level(result.mean)).colour(0));
        }
        if let Some(expected) = measure.expected.as_ref().and_then(|expected| expected.values.first()) {
            chart = chart.series(Series::dashed("expected", level(*expected)).colour(1));
        }
    }
    chart.series(Series::points("runs", points).colour(0))
}
