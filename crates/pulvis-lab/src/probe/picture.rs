//! Curves as a picture: force over overlap, and what resists shear, roll and twist.

use super::{ProbeCurve, ProbeSample};
use pulvis_io::plot::{Chart, Figure, Series};

/// Draws curves in one picture. A single one shows its branches in their colours, and its energies; of several, symbols
/// mark where a branch begins.
pub fn figure(title: Option<&str>, curves: &[ProbeCurve]) -> Figure {
    let mut figure = Figure::new();
    if let Some(title) = title {
        figure = figure.title(title);
    }
    let charts = [
        force_chart(curves),
        resistance_chart(curves, "Force against shear", ["shear [m]", "force [N]"], |sample| {
            (sample.shear, sample.shear_force)
        }),
        resistance_chart(curves, "Torque against rolling", ["arc rolled [m]", "torque [N m]"], |sample| {
            (sample.roll, sample.roll_torque)
        }),
        resistance_chart(curves, "Torque against twisting", ["arc twisted [m]", "torque [N m]"], |sample| {
            (sample.twist, sample.twist_torque)
        }),
        energy_chart(curves),
    ];
    charts.into_iter().flatten().fold(figure, Figure::panel)
}

fn force_chart(curves: &[ProbeCurve]) -> Option<Chart> {
    let mut chart =
        Chart::new("Force over overlap").x_label("overlap δ [m]").y_label("force f [N]").zero_line();
    let point = |sample: &ProbeSample| (sample.overlap, sample.force);
    if let [curve] = curves {
        let mut names: Vec<&str> = Vec::new();
        for stretch in stretches(&curve.samples) {
            let Some(first) = stretch.last() else { continue };
            let colour = names.iter().position(|name| *name == first.branch);
            let label = if colour.is_some() { "" } else { first.branch };
            let colour = colour.unwrap_or(names.len());
            if !label.is_empty() {
                names.push(label);
            }
            chart = chart.series(Series::line(label, stretch.iter().map(point)).colour(colour));
        }
        return Some(chart);
    }
    for (colour, curve) in curves.iter().enumerate() {
        let line = Series::line(&curve.label, curve.samples.iter().map(point));
        let changes = curve.samples.windows(2).filter_map(|pair| match pair {
            [before, after] if before.branch != after.branch => Some(point(after)),
            _ => None,
        });
        chart = chart.series(line.colour(colour)).series(Series::points("", changes).colour(colour));
    }
    Some(chart)
}

/// The pieces of a curve that lie on one branch, each from the last point of the one before.
fn stretches(samples: &[ProbeSample]) -> Vec<&[ProbeSample]> {
    let mut stretches = Vec::new();
    let mut start = 0;
    for number in 1..=samples.len() {
        let here = samples.get(number).map(|sample| sample.branch);
        if here != samples.get(number - 1).map(|sample| sample.branch) {
            stretches.extend(samples.get(start..number));
            start = number - 1;
        }
    }
    stretches
}

/// What resists a motion, where anything moves in this way.
fn resistance_chart(
    curves: &[ProbeCurve],
    title: &str,
    [x, y]: [&str; 2],
    point: impl Fn(&ProbeSample) -> (f64, f64) + Copy,
) -> Option<Chart> {
    let moves = curves.iter().flat_map(|curve| &curve.samples).any(|sample| point(sample).0 != 0.0);
    let chart = Chart::new(title).x_label(x).y_label(y).zero_line();
    let label = |curve: &ProbeCurve| if curves.len() > 1 { curve.label.clone() } else { String::new() };
    let series = |curve: &ProbeCurve| Series::line(label(curve), curve.samples.iter().map(point));
    moves.then(|| curves.iter().fold(chart, |chart, curve| chart.series(series(curve))))
}

/// Energies along the path of a single curve, over time where there is one.
fn energy_chart(curves: &[ProbeCurve]) -> Option<Chart> {
    let [curve] = curves else { return None };
    let timed = curve.samples.first()?.time.is_some();
    let line = |label: &str, of: fn(&ProbeSample) -> f64| {
        Series::line(
            label,
            curve.samples.iter().map(|sample| (sample.time.unwrap_or(sample.leg), of(sample))),
        )
    };
    let chart = Chart::new("Energies")
        .x_label(if timed { "time t [s]" } else { "legs of the path [1]" })
        .y_label("energy [J]")
        .zero_line()
        .series(line("stored", |sample| sample.stored_energy))
        .series(line("dissipated", |sample| sample.dissipated))
        .series(line("work done", |sample| sample.work));
    Some(chart)
}
