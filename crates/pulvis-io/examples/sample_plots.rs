//! Draws sample figures into a folder, to be looked at: `cargo run -p pulvis-io --example sample_plots -- <folder>`.
#![allow(clippy::print_stderr, clippy::disallowed_methods)]

use pulvis_io::IoError;
use pulvis_io::plot::{Chart, Figure, Series};
use std::path::Path;

fn main() -> std::process::ExitCode {
    let Some(folder) = std::env::args_os().nth(1) else {
        eprintln!("usage: sample_plots <folder>");
        return std::process::ExitCode::from(2);
    };
    match draw(folder.as_ref()) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            std::process::ExitCode::FAILURE
        }
    }
}

fn draw(folder: &Path) -> Result<(), IoError> {
    for ending in ["png", "svg"] {
        restitution().write(&folder.join("restitution").with_extension(ending))?;
        let figure = Figure::new()
            .title("Impact of two spheres")
            .panel(restitution())
            .panel(force())
            .panel(energies());
        figure.write(&folder.join("impact").with_extension(ending))?;
        broken().write(&folder.join("broken").with_extension(ending))?;
        strange().write(&folder.join("strange").with_extension(ending))?;
    }
    Ok(())
}

/// A curve over five decades with symbols on it and two regime limits.
fn restitution() -> Chart {
    let law = |v: f64| (1.0 - (0.02 / v).powf(0.8)).max(0.0).sqrt() * (0.9 - 0.12 * (1.0 + v).ln());
    let velocity = |n: i32| 10_f64.powf(-3.0 + 5.0 * f64::from(n) / 400.0);
    let curve = (0..=400).map(|n| (velocity(n), law(velocity(n))));
    let points =
        (0..=20).map(|n| (velocity(20 * n), law(velocity(20 * n)) * (1.0 + 0.01 * f64::from(n % 3 - 1))));
    Chart::new("Coefficient of restitution")
        .x_label("impact velocity [m/s]")
        .y_label("coefficient of restitution [-]")
        .log_x()
        .marker(0.02, "sticking")
        .marker(20.0, "fully plastic")
        .series(Series::line("closed form", curve.clone()).colour(0))
        .series(
            Series::dashed("without adhesion", curve.map(|(v, _)| (v, 0.9 - 0.12 * (1.0 + v).ln())))
                .colour(1),
        )
        .series(Series::points("simulation", points).colour(0))
}

/// A loop with sharp turns and small numbers.
fn force() -> Chart {
    let loading = (0..=100).map(|n| f64::from(n) * 1.0e-8).map(|d| (d, 1.0e2 * d));
    let unloading =
        (0..=50).map(|n| 1.0e-6 - f64::from(n) * 1.0e-8).map(|d| (d, 1.0e-4 - 5.0e2 * (1.0e-6 - d) * 0.6));
    let back = (0..=50).map(|n| 0.5e-6 - f64::from(n) * 1.0e-8).map(|d| (d, -0.5e2 * d * 2.0));
    Chart::new("Force loop")
        .x_label("overlap [m]")
        .y_label("normal force [N]")
        .zero_line()
        .series(Series::line("slow", loading.chain(unloading).chain(back)))
        .series(Series::line(
            "noise",
            (0..2000).map(|n| {
                let d = 5.0e-10 * f64::from(n);
                (d, 2.0e-5 * (f64::from(n) * 1.7).sin() * (f64::from(n) * 0.013).cos() + 2.0e-5)
            }),
        ))
}

fn energies() -> Chart {
    let time = (0..=300).map(|n| f64::from(n) * 1.0e-6);
    let kinetic = time.clone().map(|t| (t, 0.5 + 0.5 * (t * 2.0e4).cos() * (-t * 4.0e3).exp()));
    let elastic = time.clone().map(|t| (t, (-t * 4.0e3).exp() * (0.5 - 0.5 * (t * 2.0e4).cos())));
    let gaps =
        time.map(|t| (t, if (t * 1.0e5) as i32 % 7 == 3 { f64::NAN } else { 1.0 - (-t * 8.0e3).exp() }));
    let symbols =
        |series: i32| (0..12).map(move |n| (25.0e-6 * f64::from(n), 0.2 + 0.08 * f64::from(series)));
    Chart::new("Energies")
        .x_label("time [s]")
        .y_label("energy [µJ]")
        .series(Series::line("kinetic", kinetic))
        .series(Series::line("elastic", elastic))
        .series(Series::line("dissipated (with gaps)", gaps))
        .series(Series::points("series 3", symbols(0)))
        .series(Series::points("series 5", symbols(1)).colour(5))
        .series(Series::points("series 6", symbols(2)).colour(6))
}

/// A run that explodes, in four views: values that end, infinities, one spike, nothing finite.
fn broken() -> Figure {
    let over_time =
        |of: fn(f64) -> f64| (0..600).map(move |n| (1.0e-6 * f64::from(n), of(f64::from(n) / 600.0)));
    let stages = |chart: Chart| {
        chart.x_label("time [s]").section(0.0, "settle").section(2.0e-4, "press").section(5.0e-4, "hold")
    };
    let energies = stages(Chart::new("Tablet: energies held").y_label("energy [J]"))
        .series(Series::line("kinetic", over_time(|s| if s < 0.6 { 0.02 * s } else { f64::NAN })))
        .series(Series::line("elastic", over_time(|s| if s < 0.6 { 0.02 * s } else { f64::INFINITY })))
        .series(Series::line("adhesive", over_time(|s| if s < 0.7 { 0.02 * s } else { f64::NEG_INFINITY })))
        .series(Series::line("gravity", over_time(|s| 0.01 - 0.01 * s)));
    let stress =
        stages(Chart::new("Stress").y_label("stress [Pa]").robust_y().zero_line()).series(Series::line(
            "z",
            over_time(|s| if (s - 0.4).abs() < 1e-3 { -700.0 } else { 40.0 * (20.0 * s).sin() }),
        ));
    let nothing = |_: f64| f64::NAN;
    Figure::new()
        .title("An exploded run")
        .panel(energies)
        .panel(stress)
        .panel(
            stages(Chart::new("Error").y_label("relative error [1]"))
                .series(Series::line("", over_time(nothing))),
        )
        .panel(Chart::new("No curve at all").x_label("time [s]"))
}

/// What must not panic: nothing, not-a-number, one point, numbers at the ends of f64.
fn strange() -> Figure {
    let extremes =
        [(f64::MIN, 1.0), (f64::NAN, 2.0), (0.0, f64::INFINITY), (1.0, 1.0e299), (5e-324, -1.0e299)];
    Figure::new()
        .panel(Chart::new("no series, α β γ ⟨κ⟩ ≤ ∞ 10⁻³ m²/s"))
        .panel(Chart::new("empty").series(Series::line("empty", [])).log_x().log_y())
        .panel(Chart::new("extremes").series(Series::line("extremes", extremes)).marker(f64::NAN, "never"))
        .panel(
            Chart::new("one point").series(Series::points("one", [(3.0, 7.0e-5)])).x_label("x").y_label("y"),
        )
        .panel(
            Chart::new("two decades").log_y().log_x().series(Series::line("line", [(0.03, 0.2), (2.0, 9.0)])),
        )
}
