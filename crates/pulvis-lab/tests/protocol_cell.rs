//! Runs whose periodic cell deforms: stop rules, columns, refusals before the start, checkpoints.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod protocol_scenarios;

use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};

use protocol_scenarios::{Series, options, run, run_with, scenario};
use pulvis_input::scenario::Scenario;
use pulvis_lab::protocol::{self, Ending};

const STAGES: &str = r#"
[[stages]]
name = "compress"
until = { strain = { axis = "y", value = -0.17 } }
[stages.cell]
rate = { xx = "-30 1/s", yy = "-30 1/s", zz = "-30 1/s" }
[[stages]]
name = "settle"
until = { kinetic_to_elastic = 2e-2, pressure_tolerance = 0.02, time = "200 ms" }
[stages.cell]
stress = { isotropic = "300 Pa" }
inertial_number = 0.02
[[stages]]
name = "shear"
until = { shear_strain = { component = "xy", value = 0.6 } }
[stages.cell]
rate = { xy = "15 1/s" }
stress = { yy = "300 Pa" }
inertial_number = 0.02
"#;

fn cell(stages: &str) -> Scenario {
    scenario(&format!(
        r#"
seed = 3
[materials.grain]
density = "2000 kg/m^3"
[contacts.grain-grain]
normal = {{ law = "linear", k = "500 N/m" }}
viscosity = {{ law = "constant", gamma_0 = "5e-3 kg/s" }}
sliding = {{ law = "spring-slider", kt = "200 N/m", mu = 0.4 }}
[domain]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["9 mm", "9 mm", "9 mm"]
periodic = ["x", "y", "z"]
[[particles]]
material = "grain"
count = 120
radius = {{ distribution = "uniform", minimum = "0.7 mm", maximum = "0.9 mm" }}
arrangement = {{ kind = "random", lower = ["0 mm", "0 mm", "0 mm"], upper = ["9 mm", "9 mm", "9 mm"] }}
[time]
steps_per_contact_time = 25
{stages}
[output]
timeseries = {{ steps = 50 }}
plots = false
vtk = true
"#
    ))
}

#[test]
fn a_cell_is_compressed_settles_under_its_stress_and_is_sheared_to_its_strain() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&cell(STAGES), folder.path());
    let endings: Vec<_> = summary.stages.iter().map(|stage| stage.ending).collect();
    assert_eq!(endings, [Ending::Strain, Ending::AtRest, Ending::Strain]);
    assert!(summary.energy_error_max < 1e-3, "{:e}", summary.energy_error_max);
    let series = Series::read(folder.path());
    let last = |name: &str, stage: usize| *series.of_stage(name, stage).last().unwrap();
    // The rows are 50 steps apart, the stage ends with the step that reaches the strain.
    assert!((last("strain_y", 1) + 0.17).abs() < 1e-4 && (last("length_x", 1) / 9e-3 - 0.83).abs() < 1e-4);
    let pressure =
        ["x", "y", "z"].map(|axis| last(&format!("stress_{axis}{axis}"), 2)).iter().sum::<f64>() / 3.0;
    assert!((pressure / 300.0 - 1.0).abs() < 0.02, "{pressure}");
    assert!((last("cell_strain_xy", 3) - 0.6).abs() < 1e-4);
    // Momentum flows against the gradient: σ_xy < 0 where compression is positive.
    let shear = series.of_stage("stress_xy", 3);
    let mean = shear[shear.len() / 2..].iter().sum::<f64>() / (shear.len() / 2) as f64;
    assert!(mean < -0.1 * 300.0 && mean > -300.0, "{mean}");
    assert!(last("tilt_xy", 3).abs() <= 0.5 * last("length_x", 3) * (1.0 + 1e-12));
    assert!(last("work_cell", 3) > last("work_cell", 2));
    assert!(last("kinetic_stress_yy", 3) > 0.0 && last("kinetic_stress_yy", 3) < 10.0);
    let frames = fs::read_dir(folder.path())
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().file_name().to_str().unwrap().starts_with("walls"));
    assert!(frames.count() > 0, "the edges of the cell are written");
}

#[test]
fn a_run_that_is_stopped_in_the_middle_of_a_shear_goes_on_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, stopped) = (folder.path().join("whole"), folder.path().join("stopped"));
    let plan = cell(STAGES);
    run(&plan, &whole);
    let stop = AtomicBool::new(false);
    let summary = run_with(&plan, &options(&stopped), &stop, &mut |progress| {
        // Told some times a second, and at the ends of stages.
        if progress.number == 2 && progress.ending.is_some() {
            stop.store(true, Ordering::Relaxed);
        }
    })
    .unwrap();
    assert!(summary.interrupted() && summary.can_be_resumed, "{:?}", summary.stages);
    let mut threads = options(&stopped);
    threads.threads = Some(2);
    protocol::resume(&stopped, &threads, &AtomicBool::new(false), &mut |_| {}).unwrap();
    let series = |folder: &std::path::Path| fs::read_to_string(folder.join("timeseries.csv")).unwrap();
    assert!(series(&whole) == series(&stopped), "the time series differ");
}

/// What is said of stages that cannot be run.
fn refused(stages: &str) -> String {
    protocol::prepare(&cell(stages)).unwrap_err().to_string()
}

#[test]
fn what_no_cell_can_do_is_refused_before_the_run() {
    let stage =
        |cell: &str| format!("[[stages]]\nname = \"one\"\nuntil = {{ time = \"40 ms\" }}\ncell = {cell}\n");
    let fast = refused(&stage("{ rate = { xy = \"2e4 1/s\" } }"));
    assert!(fast.contains("stages[0].cell.rate") && fast.contains("at most 0.01 in a step"), "{fast}");
    let stiff = refused(&stage("{ stress = { isotropic = \"1 Pa\" }, inertial_number = 5.0 }"));
    assert!(
        stiff.contains("stages[0].cell.inertial_number") && stiff.contains("less than a time step"),
        "{stiff}"
    );
    let narrow = refused(&stage("{ rate = { zz = \"-40 1/s\", xx = \"40 1/s\" } }"));
    assert!(narrow.contains("the period along z") && narrow.contains("two diameters"), "{narrow}");
}
