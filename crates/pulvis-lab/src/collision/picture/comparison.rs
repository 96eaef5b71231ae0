//! Several contacts in one picture, and what oblique collisions do across the line of centres.

use super::{axis_label, axis_value, case_label, drawn_course, theory_line};
use crate::collision::SweepPoint;
use crate::collision::error::CollisionError;
use crate::collision::oblique::ObliqueOutcome;
use crate::collision::outcome::Regime;
use pulvis_input::collision::CollisionScenario;
use pulvis_io::plot::{Chart, Figure, Series};

/// Draws the restitution of all contacts in one chart, and a force loop of each in another: that of the middle of the
/// sweep.
///
/// # Errors
/// A collision that cannot be computed; some are computed again to record their course.
pub(super) fn figure(scenario: &CollisionScenario, points: &[SweepPoint]) -> Result<Figure, CollisionError> {
    let mut figure = Figure::new();
    if let Some(title) = &scenario.title {
        figure = figure.title(title);
    }
    let each = Vec::from_iter(contacts(scenario, points));
    if each.iter().any(|(_, points)| points.len() > 1) {
        figure = figure.panel(restitution_chart(scenario, points));
        figure = tangential_charts(scenario, points).into_iter().fold(figure, Figure::panel);
    }
    let middle = each.iter().filter_map(|(name, points)| Some((*name, *points.get(points.len() / 2)?)));
    let middle = Vec::from_iter(middle);
    let title = match middle.first() {
        Some((_, point)) => format!("Force over overlap, {}", case_label(scenario, &point.case)),
        None => "Force over overlap".to_owned(),
    };
    let mut loops = Chart::new(title).x_label("overlap δ [m]").y_label("force f [N]").zero_line();
    for (name, point) in middle {
        let course = drawn_course(scenario, &point.case)?.course;
        loops = loops.series(Series::line(name, course.iter().map(|sample| (sample.overlap, sample.force))));
    }
    Ok(figure.panel(loops))
}

/// The points of each contact, with its name.
fn contacts<'s>(
    scenario: &'s CollisionScenario,
    points: &'s [SweepPoint],
) -> impl Iterator<Item = (&'s str, Vec<&'s SweepPoint>)> {
    let of = move |number: usize| points.iter().filter(move |point| point.case.contact_number == number);
    scenario.labels.iter().enumerate().map(move |(number, label)| (label.as_str(), of(number).collect()))
}

/// The restitution of all contacts, with its closed form where there is one for each of them.
fn restitution_chart(scenario: &CollisionScenario, points: &[SweepPoint]) -> Chart {
    let lines: Vec<_> = (0..scenario.labels.len()).map(|number| theory_line(scenario, number)).collect();
    let known = |line: &Vec<(f64, f64)>| line.iter().any(|(_, restitution)| restitution.is_finite());
    let title = "Coefficient of restitution";
    if !lines.iter().all(known) {
        let restitution = |point: &SweepPoint| Some(point.collision.outcome.restitution);
        return chart(scenario, points, title, "restitution e [1]", restitution);
    }
    let mut chart = empty_chart(scenario, title, "restitution e [1]");
    for (colour, (name, points)) in contacts(scenario, points).enumerate() {
        let theory = lines.get(colour).cloned().unwrap_or_default();
        let computed =
            points.iter().map(|point| (axis_value(scenario, point), point.collision.outcome.restitution));
        chart = chart.series(Series::line(name, theory).colour(colour));
        chart = chart.series(Series::points("", computed).colour(colour));
    }
    chart
}

fn empty_chart(scenario: &CollisionScenario, title: &str, quantity: &str) -> Chart {
    let chart = Chart::new(title).x_label(axis_label(&scenario.variable)).y_label(quantity).zero_line();
    if scenario.logarithmic { chart.log_x() } else { chart }
}

/// A quantity over the swept variable, a curve a contact.
fn chart(
    scenario: &CollisionScenario,
    points: &[SweepPoint],
    title: &str,
    quantity: &str,
    of: impl Fn(&SweepPoint) -> Option<f64>,
) -> Chart {
    let mut chart = empty_chart(scenario, title, quantity);
    let several = scenario.labels.len() > 1;
    for (colour, (name, points)) in contacts(scenario, points).enumerate() {
        let place = |point: &&SweepPoint| Some((axis_value(scenario, point), of(point)?));
        let curve = Vec::from_iter(points.iter().filter_map(place));
        let name = if several { name } else { "" };
        chart = chart.series(Series::line(name, curve.clone()).colour(colour));
        chart = chart.series(Series::points("", curve).colour(colour));
    }
    chart
}

/// A number of an oblique collision.
type Quantity = fn(ObliqueOutcome) -> Option<f64>;

/// What oblique collisions do to the motion across the line of centres.
pub(super) fn tangential_charts(scenario: &CollisionScenario, points: &[SweepPoint]) -> Vec<Chart> {
    let outcome = |point: &SweepPoint| {
        let outcome = point.collision.outcome;
        outcome.oblique.filter(|_| outcome.regime == Regime::Rebound)
    };
    let known = |of: Quantity| points.iter().any(|point| outcome(point).and_then(of).is_some());
    let mut charts = Vec::new();
    let quantities: [(&str, &str, Quantity); 3] = [
        ("Tangential velocity after over before", "restitution e_{t} [1]", |outcome| {
            outcome.restitution_tangential
        }),
        ("Velocity of the contact point reversed", "restitution β [1]", |outcome| {
            outcome.restitution_contact
        }),
        ("Tangential over normal impulse", "ratio [1]", |outcome| Some(outcome.impulse_ratio)),
    ];
    for (title, quantity, of) in quantities {
        if known(of) {
            charts.push(chart(scenario, points, title, quantity, |point| outcome(point).and_then(of)));
        }
    }
    charts
}
