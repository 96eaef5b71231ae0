//! Pictures of a run: energies, ledger, stress and strain, force over displacement.

use std::path::PathBuf;

use pulvis_core::Simulation;
use pulvis_input::scenario::{Scenario, WallControl};
use pulvis_io::plot::{Chart, Figure, Series as Line};

use crate::rendering::default_picture;

use super::error::RunError;
use super::folder::OutputFolder;
use super::frame::frame_of;
use super::measure::Measure;
use super::run::PictureOptions;
use super::setup::box_walls;

/// The rows of a time series.
pub(super) struct Series<'a> {
    pub(super) measure: &'a Measure,
    pub(super) rows: &'a [Vec<f64>],
}

impl Series<'_> {
    /// Two columns as points; the stages of rows that `keep` refuses are left out.
    fn points(&self, x: &str, y: &str, keep: impl Fn(usize) -> bool) -> Vec<(f64, f64)> {
        let places = self.measure.column(x).zip(self.measure.column(y));
        let Some((x, y)) = places else { return Vec::new() };
        self.rows.iter().filter(|row| keep(row[2] as usize)).map(|row| (row[x], row[y])).collect()
    }

    fn over_time(&self, column: &str) -> Vec<(f64, f64)> {
        self.points("time", column, |_| true)
    }

    /// A chart over time in which the stages are marked.
    fn chart(&self, scenario: &Scenario, title: impl Into<String>) -> Chart {
        let mut chart = Chart::new(title).x_label("time [s]");
        let mut before = None;
        for (time, stage) in self.points("time", "stage", |_| true) {
            let number = stage as usize;
            if before != Some(number)
                && let Some(stage) = number.checked_sub(1).and_then(|index| scenario.stages.get(index))
            {
                chart = chart.section(time, &stage.name);
            }
            before = Some(number);
        }
        chart
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// Axes along which walls move less have no curve of force over displacement [1].
const LEAST_DISPLACEMENT: f64 = 1e-3;

/// Draws everything that the run has data for; answers with the files.
pub(super) fn draw(
    scenario: &Scenario,
    simulation: &Simulation,
    series: &Series<'_>,
    options: PictureOptions,
    output: &mut OutputFolder,
) -> Result<Vec<PathBuf>, RunError> {
    let PictureOptions { dpi, svg } = options;
    let mut drawn = Vec::new();
    let figures = [
        ("energies", Some(energies(scenario, series))),
        ("stress", stresses(scenario, series)),
        ("force_displacement", force_displacement(scenario, series)),
    ];
    for (name, figure) in figures {
        let Some(figure) = figure else { continue };
        let figure = figure.dpi(dpi);
        for ending in ["png", "svg"].into_iter().filter(|ending| svg || *ending == "png") {
            let path = output.file(&format!("{name}.{ending}"))?;
            figure.write(&path)?;
            drawn.push(path);
        }
    }
    let path = output.file("particles.png")?;
    let frame = frame_of(scenario, simulation);
    let picture = default_picture(scenario, &frame, simulation.time(), dpi).map_err(Box::new)?;
    picture.write(&path)?;
    drawn.push(path);
    Ok(drawn)
}

/// A figure with the title of the run, if it has one.
fn figure(scenario: &Scenario) -> Figure {
    scenario.title.as_ref().map_or_else(Figure::new, |title| Figure::new().title(title))
}

/// A curve over time if there is anything to see: NaN is.
fn unless_zero(points: Vec<(f64, f64)>) -> Option<Vec<(f64, f64)>> {
    points.iter().any(|(_, value)| *value != 0.0).then_some(points)
}

fn energies(scenario: &Scenario, series: &Series<'_>) -> Figure {
    let mut stored = series.chart(scenario, "Energy stored").y_label("energy [J]").zero_line();
    for column in ["kinetic", "elastic"] {
        stored = stored.series(Line::line(column, series.over_time(column)));
    }
    for column in ["adhesive", "capillary", "electrostatic"] {
        if let Some(points) = unless_zero(series.over_time(column)) {
            stored = stored.series(Line::line(column, points));
        }
    }
    if let Some(points) = unless_zero(since_start(series.over_time("gravity"))) {
        stored = stored.series(Line::line("gravity, change since the start", points));
    }
    let mut dissipated =
        series.chart(scenario, "Energy dissipated and work done").y_label("energy [J]").zero_line();
    let accounts = [
        ("plastic", "dissipated_plastic"),
        ("adhesive", "dissipated_adhesive"),
        ("capillary", "dissipated_capillary"),
        ("fracture", "dissipated_fracture"),
        ("thermal", "dissipated_thermal"),
        ("viscous", "dissipated_viscous"),
        ("sliding", "dissipated_sliding"),
        ("rolling", "dissipated_rolling"),
        ("torsion", "dissipated_torsion"),
        ("background", "dissipated_background"),
    ];
    for (label, column) in accounts {
        if let Some(points) = unless_zero(series.over_time(column)) {
            dissipated = dissipated.series(Line::line(label, points));
        }
    }
    for (label, column) in
        [("work of walls", "work_walls"), ("work of servo", "work_servo"), ("work of cell", "work_cell")]
    {
        if let Some(points) = unless_zero(series.over_time(column)) {
            dissipated = dissipated.series(Line::dashed(label, points));
        }
    }
    let error = series
        .chart(scenario, "Closing error of the ledger")
        .y_label("relative error [1]")
        .zero_line()
        .series(Line::line("", series.over_time("relative_error")));
    figure(scenario).panel(stored).panel(dissipated).panel(error)
}

/// A potential has no zero of its own; its change has.
fn since_start(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let start = points.first().map_or(0.0, |(_, value)| *value);
    points.into_iter().map(|(time, value)| (time, value - start)).collect()
}

fn stresses(scenario: &Scenario, series: &Series<'_>) -> Option<Figure> {
    // A wall that stops or is taken away gives one value that would flatten all others.
    let mut stress = series.chart(scenario, "Stress on walls").y_label("stress [Pa]").zero_line().robust_y();
    let mut lengths = series.chart(scenario, "Length of the sample").y_label("length [m]");
    let mut any = false;
    for (number, axis) in AXES.into_iter().enumerate() {
        // Walls that the scenario takes away have no stress, which is nothing to remark on.
        let gone = stage_without_walls(scenario, number);
        let points = series.points("time", &format!("wall_stress_{axis}"), |stage| stage < gone);
        if points.iter().any(|(_, stress)| stress.is_finite()) {
            any = true;
            stress = stress.series(Line::line(axis, points));
            lengths = lengths.series(Line::line(axis, series.over_time(&format!("length_{axis}"))));
        }
    }
    any.then(|| figure(scenario).panel(stress).panel(lengths))
}

/// The first stage, from 1, in which no wall of the box is left along an axis.
fn stage_without_walls(scenario: &Scenario, axis: usize) -> usize {
    let mut left: Vec<usize> = box_walls(scenario, axis).into_iter().flatten().collect();
    for (number, stage) in (1..).zip(&scenario.stages) {
        let removed = |wall: usize| {
            stage.controls.iter().any(|(index, control)| *index == wall && *control == WallControl::Removed)
        };
        left.retain(|&wall| !removed(wall));
        if left.is_empty() {
            return number;
        }
    }
    usize::MAX
}

/// Force over displacement along the axes that walls move along, one colour a stage, from the
/// reference stage on.
fn force_displacement(scenario: &Scenario, series: &Series<'_>) -> Option<Figure> {
    let first = scenario.output.dimensionless?.reference_stage.map_or(1, |stage| stage + 2);
    let mut figure = figure(scenario);
    let mut any = false;
    for axis in AXES {
        let (x, y) = (format!("D_{axis}"), format!("F_{axis}"));
        let moved = series.points(&x, &y, |stage| stage >= first);
        let finite = moved.iter().any(|(d, f)| d.is_finite() && f.is_finite());
        if !finite || !moved.iter().any(|(d, _)| d.abs() >= LEAST_DISPLACEMENT) {
            continue;
        }
        any = true;
        let mut chart = Chart::new(format!("Force over displacement along {axis}"))
            .x_label("displacement (L − L₀)/d₀ [1]")
            .y_label("force F/(kₚ d₀), compression positive [1]")
            .zero_line();
        for (number, stage) in (1..).zip(&scenario.stages).skip(first - 1) {
            let points = series.points(&x, &y, |stage| stage == number);
            if points.len() > 1 {
                chart = chart.series(Line::line(&stage.name, points));
            }
        }
        figure = figure.panel(chart);
    }
    any.then_some(figure)
}
