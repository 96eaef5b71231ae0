//! Parameters that change while a stage runs.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::disallowed_methods)] // expectations, to some digits

mod protocol_scenarios;

use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};

use protocol_scenarios::{Series, options, run, run_with, scenario};
use pulvis_lab::protocol::{Session, load_scenario};

/// A grain of 1 g on a plate, damped, whose spring is stiffened from 100 to 400 N/m within a second; then at rest.
const STIFFENING: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2", "-10 m/s^2"]
[materials.grain]
density = "2500 kg/m^3"
[materials.plate]
[contacts.grain-plate.normal]
law = "linear"
k = "100 N/m"
[background]
drag = "0.2 kg/s"
[[particles]]
material = "grain"
radius = { distribution = "fixed", value = "4.5708 mm" }
arrangement = { kind = "list", positions = [["0 mm", "0 mm", "4.4708 mm"]] }
[walls.plate]
material = "plate"
point = ["0 mm", "0 mm", "0 mm"]
normal = [0, 0, 1]
[[stages]]
name = "rest"
until = { time = "0.1 s" }
[[stages]]
name = "stiffen"
until = { time = "1.1 s" }
program_updates = 400
programs = { "contacts.grain-plate.normal.k" = [["0 s", "100 N/m"], ["1 s", "400 N/m"]] }
[[stages]]
name = "after"
until = { time = "0.1 s" }
[output]
timeseries = { interval = "1 ms" }
"#;

/// A spring that stiffens slowly lifts its weight from m g/k0 to m g/k1. What it gains without being moved is
/// ∫ δ²/2 dk = (m g)²/2 (1/k0 − 1/k1): half of it is spent on the height, half stays.
#[test]
fn a_spring_that_stiffens_under_a_weight_does_the_work_of_its_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario(STIFFENING), folder.path());
    // 50 steps a contact time, second order.
    assert!(summary.energy_error_max < 1e-5, "{summary:?}");
    let series = Series::read(folder.path());
    let weight = 4.0 / 3.0 * std::f64::consts::PI * 4.5708e-3f64.powi(3) * 2500.0 * 10.0;
    // 400 updates that each act at the overlap of the one before: the left sum of the integral, half a per cent more.
    let stiffness = |update: i32| 100.0 + 300.0 / 400.0 * f64::from(update);
    let expected: f64 =
        (0..400).map(|update| 0.5 * (weight / stiffness(update)).powi(2) * 300.0 / 400.0).sum();
    let integral = 0.5 * weight * weight * (1.0 / 100.0 - 1.0 / 400.0);
    assert!(expected > integral && expected < 1.006 * integral);
    let switched = series.column("switched");
    let last = *switched.last().unwrap();
    let work = last - series.of_stage("switched", 1).last().unwrap();
    // The drag lets the grain lag behind.
    assert!((work / expected - 1.0).abs() < 2e-3, "{work:e} J instead of {expected:e}");
    let force = series.column("force_plate");
    assert!((force.last().unwrap() / weight - 1.0).abs() < 1e-6, "{force:?}");
    // The last value holds in the stages that follow.
    let elastic = series.column("elastic");
    let stored = 0.5 * weight * weight / 400.0;
    assert!((elastic.last().unwrap() / stored - 1.0).abs() < 1e-6, "{elastic:?}");
}

#[test]
fn programs_go_the_same_way_step_by_step() {
    let short = STIFFENING
        .replace("\"1.1 s\"", "\"30 ms\"")
        .replace("[\"1 s\",", "[\"20 ms\",")
        .replace("\"0.1 s\"", "\"5 ms\"");
    let scenario = scenario(&short);
    let folder = tempfile::tempdir().unwrap();
    let run = run(&scenario, folder.path());
    let mut session = Session::new(scenario).unwrap();
    while !session.is_over() {
        session.advance(7, false).unwrap();
    }
    assert_eq!(session.simulation().steps(), run.steps);
    let series = Series::read(folder.path());
    let columns = session.columns().to_vec();
    for (name, value) in columns.iter().zip(session.row()) {
        let written = series.column(name);
        assert_eq!(written.last().map(|last| last.to_bits()), Some(value.to_bits()), "{name}");
    }
}

#[test]
fn a_branch_from_the_middle_of_a_program_has_the_values_of_that_instant() {
    let place = tempfile::tempdir().unwrap();
    let text = format!("{STIFFENING}plots = false\nvtk = false\ncheckpoints = {{ interval = \"1 h\" }}\n");
    let stop = AtomicBool::new(false);
    // At the first look into the second stage.
    let mut watch = |progress: &pulvis_lab::protocol::Progress| {
        stop.fetch_or(progress.ending.is_some(), Ordering::Relaxed);
    };
    let stopped = run_with(&scenario(&text), &options(&place.path().join("run")), &stop, &mut watch).unwrap();
    assert!(stopped.interrupted() && stopped.stages.len() == 2);
    let file = place.path().join("branch.toml");
    fs::write(
        &file,
        "start_from = { run = \"run\" }\n[[stages]]\nname = \"on\"\nuntil = { time = \"1 ms\" }\n",
    )
    .unwrap();
    let branch = load_scenario(&file, &[]).unwrap();
    let text = branch.to_resolved_toml("");
    let line = text.lines().find(|line| line.starts_with("normal = ") || line.starts_with("k = ")).unwrap();
    let stiffness: f64 = line.split("k = \"").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    let elapsed = stopped.stages[1].time - stopped.stages[0].time;
    // Straight from 100 to 400 N/m within a second, in 400 updates.
    let expected = 100.0 + 300.0 * elapsed;
    assert!(
        stiffness <= expected + 1e-6 && stiffness > expected - 300.0 / 400.0,
        "{line}, after {elapsed} s"
    );
}

/// Gravity is a vector; one component of it may be led.
#[test]
fn a_component_of_gravity_may_be_led() {
    let free = STIFFENING
        .replace("drag = \"0.2 kg/s\"", "drag = \"0 kg/s\"")
        .replace("\"4.4708 mm\"", "\"1 m\"")
        .replace("\"0.1 s\"", "\"1 ms\"")
        .replace(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\", \"-10 m/s^2\"]",
            "gravity = [\"0 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]",
        )
        .replace(
            "\"contacts.grain-plate.normal.k\" = [[\"0 s\", \"100 N/m\"], [\"1 s\", \"400 N/m\"]]",
            "\"gravity[0]\" = [[\"0 s\", \"0 m/s^2\"], [\"10 ms\", \"2 m/s^2\"]]",
        )
        .replace("\"1.1 s\"", "\"10 ms\"")
        .replace("[output]", "[time]\nsteps_per_contact_time = 500\n[output]");
    let mut session = Session::new(scenario(&free)).unwrap();
    while session.stage() < 2 {
        session.advance(1, false).unwrap();
    }
    // g(t) = 2 m/s² t/10 ms: v = ∫ g dt = 10 mm/s; updates lag by half of one, 1/400, and half a step of 640, 1/640.
    let velocity = session.simulation().particles().velocities()[0].x;
    assert!((velocity / 0.01 - 1.0).abs() < 6e-3, "{velocity}");
}
