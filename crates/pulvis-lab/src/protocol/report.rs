//! Pictures of a run: energies, ledger, stress and strain, force over displacement, the particles.

use std::path::{Path, PathBuf};

use pulvis_core::Simulation;
use pulvis_input::scenario::Scenario;
use pulvis_io::IoError;
use pulvis_io::picture::{SphereScene, render_spheres};
use pulvis_io::plot::{Chart, Figure, Series as Line};

use super::measure::Measure;

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
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// Draws everything that the run has data for; answers with the files.
pub(super) fn draw(
    scenario: &Scenario,
    simulation: &Simulation,
    series: &Series<'_>,
    folder: &Path,
) -> Result<Vec<PathBuf>, IoError> {
    let mut drawn = Vec::new();
    let mut keep = |name: &str, figure: Figure| -> Result<(), IoError> {
        let path = folder.join(name);
        figure.write(&path)?;
        drawn.push(path);
        Ok(())
    };
    let title = scenario.title.clone().unwrap_or_default();
    keep("energies.png", energies(&title, series))?;
    if let Some(figure) = stresses(&title, series) {
        keep("stress.png", figure)?;
    }
    if let Some(figure) = force_displacement(scenario, &title, series) {
        keep("force_displacement.png", figure)?;
    }
    let path = folder.join("particles.png");
    picture(simulation, &path)?;
    drawn.push(path);
    Ok(drawn)
}

fn energies(title: &str, series: &Series<'_>) -> Figure {
    let mut held = Chart::new(format!("{title}: energy held")).x_label("time [s]").y_label("energy [J]");
    for (label, column) in [("kinetic", "kinetic"), ("elastic", "elastic"), ("adhesive", "adhesive")] {
        held = held.series(Line::line(label, series.over_time(column)));
    }
    let mut lost = Chart::new("energy dissipated and work done").x_label("time [s]").y_label("energy [J]");
    let accounts = [
        ("plastic", "dissipated_plastic"),
        ("adhesive", "dissipated_adhesive"),
        ("viscous", "dissipated_viscous"),
        ("sliding", "dissipated_sliding"),
        ("rolling", "dissipated_rolling"),
        ("torsion", "dissipated_torsion"),
        ("background", "dissipated_background"),
    ];
    for (label, column) in accounts {
        let points = series.over_time(column);
        if points.iter().any(|(_, energy)| *energy != 0.0) {
            lost = lost.series(Line::line(label, points));
        }
    }
    for (label, column) in [("work of walls", "work_walls"), ("work of servo", "work_servo")] {
        let points = series.over_time(column);
        if points.iter().any(|(_, energy)| *energy != 0.0) {
            lost = lost.series(Line::dashed(label, points));
        }
    }
    let error = Chart::new("closing error of the ledger")
        .x_label("time [s]")
        .y_label("relative error [1]")
        .zero_line()
        .series(Line::line("", series.over_time("relative_error")));
    Figure::new().panel(held).panel(lost).panel(error)
}

fn stresses(title: &str, series: &Series<'_>) -> Option<Figure> {
    let mut chart = Chart::new(format!("{title}: stress on walls"))
        .x_label("time [s]")
        .y_label("stress [Pa]")
        .zero_line();
    let mut strain = Chart::new("length of the sample").x_label("time [s]").y_label("length [m]");
    let mut any = false;
    for axis in AXES {
        let points = series.over_time(&format!("wall_stress_{axis}"));
        if points.iter().any(|(_, stress)| stress.is_finite()) {
            any = true;
            chart = chart.series(Line::line(axis, points));
            strain = strain.series(Line::line(axis, series.over_time(&format!("length_{axis}"))));
        }
    }
    any.then(|| Figure::new().panel(chart).panel(strain))
}

/// Force over displacement along the axes that walls move along, one colour a stage, from the
/// reference stage on.
fn force_displacement(scenario: &Scenario, title: &str, series: &Series<'_>) -> Option<Figure> {
    scenario.output.dimensionless?;
    let first =
        scenario.output.dimensionless.and_then(|scales| scales.reference_stage).map_or(1, |stage| stage + 2);
    let mut figure = Figure::new();
    let mut any = false;
    for axis in AXES {
        let (x, y) = (format!("D_{axis}"), format!("F_{axis}"));
        let moved = series.points(&x, &y, |stage| stage >= first);
        let finite = moved.iter().any(|(d, f)| d.is_finite() && f.is_finite());
        let span = moved.iter().map(|(d, _)| *d).fold(0.0, |most: f64, d| most.max(d.abs()));
        if !finite || span < 1e-3 {
            continue;
        }
        any = true;
        let mut chart = Chart::new(format!("{title}: force over displacement along {axis}"))
            .x_label("displacement (L − L₀)/d₀ [1]")
            .y_label("force F/(k_p d₀), compression positive [1]")
            .zero_line();
        for number in first..=scenario.stages.len() {
            let points = series.points(&x, &y, |stage| stage == number);
            let finite: Vec<_> = points.into_iter().filter(|(d, f)| d.is_finite() && f.is_finite()).collect();
            if finite.len() > 1 {
                chart = chart.series(Line::line(scenario.stages[number - 1].name.clone(), finite));
            }
        }
        figure = figure.panel(chart);
    }
    any.then_some(figure)
}

/// The particles as they are at the end, coloured by the number of their contacts.
fn picture(simulation: &Simulation, path: &Path) -> Result<(), IoError> {
    use pulvis_core::ContactPartner;
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    let centres: Vec<[f64; 3]> = rows.iter().map(|&row| particles.positions()[row].to_array()).collect();
    let radii: Vec<f64> = rows.iter().map(|&row| particles.radii()[row]).collect();
    let mut contacts = vec![0.0; rows.len()];
    simulation.for_each_contact(&mut |contact| {
        if contact.overlap > 0.0 {
            contacts[contact.first as usize] += 1.0;
            if let ContactPartner::Particle(id) = contact.second {
                contacts[id as usize] += 1.0;
            }
        }
    });
    let scene = SphereScene {
        bar_label: "contacts of each particle",
        ..SphereScene::new(&centres, &radii, &contacts)
    };
    render_spheres(path, &scene)
}
