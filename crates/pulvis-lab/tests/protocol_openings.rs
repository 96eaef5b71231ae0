//! Particles that come in and leave while a run goes on.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod protocol_scenarios;

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use protocol_scenarios::{Series, options, run, run_with, scenario};
use pulvis_input::scenario::Scenario;
use pulvis_lab::protocol::{Ending, RunError, RunPhase, Session, load_scenario, prepare, resume, run_status};

/// A stream that falls through a box without floor, with an outlet below.
const STREAM: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[materials.grain]
density = "2500 kg/m^3"
[contacts.grain-grain]
normal = { law = "linear", k = "2000 N/m" }
viscosity = { law = "constant", gamma_0 = "5e-3 kg/s" }
sliding = { law = "spring-slider", kt = "500 N/m", mu = 0.3 }

[[inlets]]
name = "stream"
material = "grain"
number_rate = "20000 1/s"
region = { kind = "cylinder", start = ["5 mm", "5 mm", "14 mm"], end = ["5 mm", "5 mm", "18 mm"], radius = "3 mm" }
radius = { distribution = "uniform", minimum = "0.35 mm", maximum = "0.45 mm" }
velocity = { mean = ["0 m/s", "0 m/s", "-1 m/s"], standard_deviation = "10 cm/s", spin = ["50 1/s", "0 1/s", "0 1/s"] }
size_classes = ["0.4 mm"]

[[outlets]]
name = "floor"
beyond = { point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, -1] }
size_classes = ["0.4 mm"]

[box]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["10 mm", "10 mm", "20 mm"]
material = "grain"
open = ["z-low"]

[[stages]]
name = "flow"
until = { time = "20 ms" }
[output]
timeseries = { interval = "1 ms" }
plots = false
vtk = false
"#;

fn changed(changes: &[(&str, &str)]) -> String {
    let mut text = STREAM.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "the scenario has no `{old}`");
        text = text.replace(old, new);
    }
    text
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    let files = entries.filter(|path| ![".pulvis-lock", "status.json"].contains(&&*name(path)));
    files.map(|path| (name(&path), fs::read(&path).unwrap())).collect()
}

#[test]
fn what_comes_in_is_what_is_there_and_what_has_left_and_the_ledger_closes() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario(STREAM), folder.path());
    let series = Series::read(folder.path());
    let column = |name: &str| series.column(name);
    let (number_in, number_out) = (column("number_stream"), column("number_floor"));
    let held = column("particles");
    for ((come, left), here) in number_in.iter().zip(&number_out).zip(&held) {
        assert_eq!(*come, left + here);
    }
    // 20000 1/s for 20 ms, up to one interval of 2 x 0.45 mm over (1 m/s + 0.1 m/s).
    let come = *number_in.last().unwrap();
    assert!((380.0..=400.0).contains(&come), "{come}");
    assert!(*number_out.last().unwrap() > 50.0, "{number_out:?}");
    let (mass_in, mass_out) = (*column("mass_stream").last().unwrap(), *column("mass_floor").last().unwrap());
    let classes = |name: &str, opening: &str| -> f64 {
        [1, 2].map(|class| *column(&format!("{name}_{opening}_class_{class}")).last().unwrap()).iter().sum()
    };
    assert_eq!(classes("number", "stream"), come);
    assert!((classes("mass", "floor") / mass_out - 1.0).abs() < 1e-12);
    // The mass of the smallest and of the largest particle bound the mean.
    let mass = |radius: f64| 4.0 / 3.0 * PI * radius * radius * radius * 2500.0;
    let mean = mass_in / come;
    assert!(mean > mass(0.35e-3) && mean < mass(0.45e-3), "{mean}");
    // The flow since the start of the stage.
    let flow = *column("flow_stream").last().unwrap();
    assert!((flow / (mass_in / column("time").last().unwrap()) - 1.0).abs() < 1e-12);
    assert!(column("flow_stream")[0].is_nan());
    let [inflow, outflow, energy] =
        ["inflow", "outflow", "energy_stream"].map(|name| *column(name).last().unwrap());
    // Particles bring kinetic and potential energy: at 14 to 18 mm and 1 m/s, m g h is about a third of m v^2/2.
    assert!(inflow > energy && inflow < 2.0 * energy && outflow > 0.0, "{inflow} {energy} {outflow}");
    let expected = 0.5 * mass_in * (1.0 + 3.0 * 0.01);
    // Squares of 380 velocities, 1 m/s with a deviation of 0.1 m/s: four standard errors are 4 %.
    assert!((energy / expected - 1.0).abs() < 0.05, "{energy} {expected}");
    assert!(summary.energy_error_max < 1e-3, "{}", summary.energy_error_max);
    assert_eq!(summary.particles as f64, *held.last().unwrap());
}

#[test]
fn particles_in_free_flight_carry_out_the_energy_that_they_brought_and_that_of_their_fall() {
    // A narrow and slow rain without contacts: every particle falls from where it came in.
    let text = changed(&[
        ("\"20 ms\"", "\"60 ms\""),
        ("\"20000 1/s\"", "\"300 1/s\""),
        ("standard_deviation = \"10 cm/s\", ", ""),
    ]);
    let folder = tempfile::tempdir().unwrap();
    run(&scenario(&text), folder.path());
    let series = Series::read(folder.path());
    let last = |name: &str| *series.column(name).last().unwrap();
    assert!(last("number_floor") >= 10.0 && last("contacts") == 0.0);
    // v^2 = v0^2 + 2 g h with h between 14 mm and 18 mm, and up to 50 steps beyond the plane.
    let of_one = |name: &str| 2.0 * last(&format!("energy_{name}")) / last(&format!("mass_{name}"));
    // Rotation adds 2/5 (w a)^2, below 2/5 (50 x 0.45e-3)^2 = 2e-4.
    let gained = of_one("floor") - of_one("stream");
    assert!(gained > 2.0 * 9.81 * 14e-3 && gained < 2.0 * 9.81 * 18.2e-3, "{gained}");
}

#[test]
fn any_number_of_threads_and_ranks_and_any_interruption_leave_the_same_files() {
    let text = changed(&[("\"20 ms\"", "\"8 ms\""), ("vtk = false", "checkpoints = { stage_ends = true }")]);
    let scenario = scenario(&text);
    let [whole, threads, stopped] = [(); 3].map(|()| tempfile::tempdir().unwrap());
    run(&scenario, whole.path());
    let expected = files(whole.path());
    let two = pulvis_lab::protocol::RunOptions { threads: Some(3), ..options(threads.path()) };
    run_with(&scenario, &two, &AtomicBool::new(false), &mut |_| {}).unwrap();
    assert!(files(threads.path()) == expected, "three threads have another result");
    let ranks = tempfile::tempdir().unwrap();
    protocol_scenarios::on_ranks(&scenario, ranks.path(), 2);
    assert!(files(ranks.path()) == expected, "two ranks have another result");
    let stop = AtomicBool::new(true);
    let mut watch = |progress: &pulvis_lab::protocol::Progress| {
        let ended = progress.ending.is_some_and(|ending| ending != Ending::Interrupted);
        stop.fetch_or(ended, Ordering::Relaxed);
    };
    let mut summary = run_with(&scenario, &options(stopped.path()), &stop, &mut watch).unwrap();
    let mut resumed: u64 = 0;
    while summary.interrupted() {
        resumed += 1;
        stop.store(!resumed.is_multiple_of(20), Ordering::Relaxed);
        summary = resume(stopped.path(), &options(stopped.path()), &stop, &mut watch).unwrap();
    }
    assert!(resumed >= 20, "{resumed}");
    let found = files(stopped.path());
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    let different: Vec<&String> = found.keys().filter(|name| found[*name] != expected[*name]).collect();
    assert!(different.is_empty(), "{different:?}");
}

#[test]
fn a_session_brings_in_the_same_particles_at_the_same_steps() {
    let scenario = scenario(&changed(&[("\"20 ms\"", "\"8 ms\"")]));
    let folder = tempfile::tempdir().unwrap();
    run(&scenario, folder.path());
    let series = Series::read(folder.path());
    let mut session = Session::new(scenario).unwrap();
    let columns = session.columns().to_vec();
    let steps = series.column("step");
    for (row, step) in steps.iter().enumerate().skip(1) {
        let left = *step as u64 - session.simulation().steps();
        session.advance(left, false).unwrap();
        for (name, value) in columns.iter().zip(session.row()) {
            assert_eq!(value.to_bits(), series.column(name)[row].to_bits(), "{name} in step {step}");
        }
    }
    assert!(session.is_over());
}

#[test]
fn a_stage_ends_when_enough_has_passed_and_openings_shut_with_their_stages() {
    let stages = r#"
[[stages]]
name = "fill"
until = { passed = { name = "stream", number = 100 } }
[[stages]]
name = "wait"
until = { time = "4 ms" }
[[stages]]
name = "flow"
until = { time = "20 ms" }"#;
    let text = changed(&[
        ("\n[[stages]]\nname = \"flow\"\nuntil = { time = \"20 ms\" }", stages),
        (
            "number_rate = \"20000 1/s\"",
            "number_rate = \"20000 1/s\"\nstages = [\"fill\", \"flow\"]\ntotal_number = 150",
        ),
        ("[[outlets]]\n", "[[outlets]]\nstages = [\"flow\"]\n"),
    ]);
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario(&text), folder.path());
    assert_eq!(summary.stages[0].ending, Ending::Passed);
    // 100 particles at 20000 1/s take 5 ms, up to an interval.
    assert!(summary.stages[0].time >= 5e-3 && summary.stages[0].time < 6e-3, "{}", summary.stages[0].time);
    let series = Series::read(folder.path());
    let [come, left] =
        ["number_stream", "number_floor"].map(|name| [1, 2, 3].map(|stage| series.of_stage(name, stage)));
    assert!(*come[0].last().unwrap() >= 100.0 && *come[0].last().unwrap() < 120.0);
    assert!(come[1].iter().all(|number| number == come[0].last().unwrap()), "shut in the second stage");
    assert_eq!(come[2].last(), Some(&150.0));
    assert!(left[1].iter().all(|number| *number == 0.0) && *left[2].last().unwrap() > 0.0);
    assert!(series.of_stage("flow_stream", 2).last() == Some(&0.0));
}

/// What is true when a stage begins ends it with its first step, in a run that looks seldom as in a session that looks often.
#[test]
fn a_stage_that_waits_for_what_has_passed_already_ends_at_once() {
    let second = "until = { time = \"6 ms\" }\n[[stages]]\nname = \"again\"\nuntil = { passed = { name = \"stream\", number = 50 } }";
    let scenario = scenario(&changed(&[("until = { time = \"20 ms\" }", second)]));
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario, folder.path());
    assert_eq!(summary.stages[1].ending, Ending::Passed);
    assert_eq!(summary.stages[1].steps, summary.stages[0].steps + 1);
    let mut session = Session::new(scenario).unwrap();
    while !session.is_over() {
        session.advance(3, false).unwrap();
    }
    assert_eq!(session.simulation().steps(), summary.steps);
}

#[test]
fn a_branch_with_another_rate_owes_nothing_for_the_time_before_it() {
    let place = tempfile::tempdir().unwrap();
    let [whole, branched] = ["whole", "branched"].map(|name| place.path().join(name));
    let text = changed(&[
        ("\"20 ms\"", "\"3 ms\""),
        ("vtk = false", "vtk = false\ncheckpoints = { stage_ends = true }"),
    ]);
    run(&scenario(&text), &whole);
    let inlet = &STREAM[STREAM.find("[[inlets]]").unwrap()..STREAM.find("[[outlets]]").unwrap()];
    let inlet = inlet.replace("20000 1/s", "40000 1/s");
    let branch = format!(
        "start_from = {{ run = \"whole\" }}\n{inlet}\n[[stages]]\nname = \"on\"\nuntil = {{ time = \"3 ms\" }}\n[output]\nplots = false\nvtk = false\n"
    );
    let file = place.path().join("branch.toml");
    fs::write(&file, branch).unwrap();
    run(&load_scenario(&file, &[]).unwrap(), &branched);
    let come = Series::read(&branched).column("number_stream");
    let more = come.last().unwrap() - come[0];
    // 120 in 3 ms, up to an interval of 0.8 ms or so; with a debt of 60 for the time before it would be 180.
    assert!(come[0] > 30.0 && more > 80.0 && more <= 120.0, "{come:?}");
}

#[test]
fn a_branch_goes_on_with_the_inlets_and_counters_of_its_run() {
    let place = tempfile::tempdir().unwrap();
    let [whole, branched] = ["whole", "branched"].map(|name| place.path().join(name));
    let second = "until = { time = \"3 ms\" }\n[[stages]]\nname = \"on\"\nuntil = { time = \"3 ms\" }";
    let text = changed(&[
        ("until = { time = \"20 ms\" }", second),
        ("vtk = false", "vtk = false\ncheckpoints = { stage_ends = true }"),
    ]);
    run(&scenario(&text), &whole);
    let file = place.path().join("branch.toml");
    let branch = "start_from = { run = \"whole\", stage = \"flow\" }\n[[stages]]\nname = \"on\"\nuntil = { time = \"3 ms\" }\n[output]\ntimeseries = { interval = \"1 ms\" }\nplots = false\nvtk = false\n";
    fs::write(&file, branch).unwrap();
    run(&load_scenario(&file, &[]).unwrap(), &branched);
    let [expected, found] = [&whole, &branched].map(|folder| Series::read(folder));
    let steps = expected.column("step");
    let mut compared = 0;
    for name in ["number_stream", "mass_stream", "energy_stream", "number_floor", "kinetic"] {
        for (step, value) in found.column("step").into_iter().zip(found.column(name)) {
            let Some(row) = steps.iter().position(|other| *other == step) else { continue };
            assert_eq!(value.to_bits(), expected.column(name)[row].to_bits(), "{name} in step {step}");
            compared += 1;
        }
    }
    assert!(compared >= 15, "{compared}");
    let come = found.column("number_stream");
    assert!(come[0] > 30.0 && come.last().unwrap() > &(come[0] + 30.0), "{come:?}");
}

#[test]
fn an_inlet_without_room_stops_the_run_and_says_so() {
    // A floor, no outlet: the box fills up to the region.
    let text = changed(&[
        ("open = [\"z-low\"]", ""),
        ("upper = [\"10 mm\", \"10 mm\", \"20 mm\"]", "upper = [\"10 mm\", \"10 mm\", \"18.5 mm\"]"),
        ("start = [\"5 mm\", \"5 mm\", \"14 mm\"]", "start = [\"5 mm\", \"5 mm\", \"3 mm\"]"),
        ("end = [\"5 mm\", \"5 mm\", \"18 mm\"]", "end = [\"5 mm\", \"5 mm\", \"5 mm\"]"),
        ("size_classes = [\"0.4 mm\"]\n\n[[out", "max_delay = \"2 ms\"\n\n[[out"),
        ("\"20000 1/s\"", "\"40000 1/s\""),
        ("\"20 ms\"", "\"60 ms\""),
        ("vtk = false", "vtk = true"),
    ]);
    let folder = tempfile::tempdir().unwrap();
    let stopped = run_with(&scenario(&text), &options(folder.path()), &AtomicBool::new(false), &mut |_| {});
    let error = stopped.unwrap_err();
    assert!(matches!(error, RunError::Inlet { .. }) && !error.is_bad_input(), "{error}");
    let text = error.to_string();
    assert!(
        text.starts_with("stage `flow`: inlet `stream` cannot bring in what it should: a particle of radius"),
        "{text}"
    );
    assert!(
        text.contains("longer than `max_delay` = 2.0000e-3 s")
            && text.contains("or raise `max_delay`\n  the run has stopped; "),
        "{text}"
    );
    // The rows up to there are complete, and the last one and the last frame are of the state that it stopped in.
    let series = Series::read(folder.path());
    let (steps, times) = (series.column("step"), series.column("time"));
    assert!(steps.len() > 2);
    let index = fs::read_to_string(folder.path().join("series.pvd")).unwrap();
    let frames: Vec<f64> = index
        .split("timestep=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
        .collect();
    assert_eq!((frames.len(), frames.last()), (2, times.last()));
    let status = run_status(folder.path()).unwrap();
    assert_eq!((status.state, status.message), (RunPhase::Failed, Some(text)));
    let alarm = fs::read_to_string(folder.path().join("alarm.txt")).unwrap();
    assert!(alarm.contains(&format!("\nstep = {}\n", steps.last().unwrap())), "{alarm}");
}

fn refusal(changes: &[(&str, &str)]) -> String {
    prepare(&scenario(&changed(changes))).unwrap_err().to_string()
}

#[test]
fn inlets_behind_walls_and_rates_that_nothing_can_leave_with_are_refused_before_the_run() {
    let text = refusal(&[(
        "start = [\"5 mm\", \"5 mm\", \"14 mm\"], end = [\"5 mm\", \"5 mm\", \"18 mm\"]",
        "start = [\"5 mm\", \"5 mm\", \"24 mm\"], end = [\"5 mm\", \"5 mm\", \"28 mm\"]",
    )]);
    assert!(
        text.contains("inlets[0].region: of 1000 random sites for the smallest particle none lies in front"),
        "{text}"
    );
    // 0.384 of 6 mm x 4 mm x ... : 1 m/s, 0.1 m/s and a fall of 4 mm.
    let text = refusal(&[("number_rate = \"20000 1/s\"", "mass_rate = \"10 kg/s\"")]);
    assert!(text.contains("inlets[0].mass_rate: 1.0000e1 kg/s cannot come in: at "), "{text}");
    let text = refusal(&[
        ("gravity = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]", ""),
        (
            "velocity = { mean = [\"0 m/s\", \"0 m/s\", \"-1 m/s\"], standard_deviation = \"10 cm/s\", spin = [\"50 1/s\", \"0 1/s\", \"0 1/s\"] }",
            "",
        ),
    ]);
    assert!(
        text.contains("inlets[0].number_rate: particles come in at rest, no gravity takes them away"),
        "{text}"
    );
    // 200 km/s are more than a tenth of a radius in a step.
    let text = refusal(&[("\"-1 m/s\"", "\"-200 km/s\"")]);
    assert!(text.contains("inlets[0].velocity: inlet stream brings particles in at"), "{text}");
}

#[test]
fn seeds_make_other_particles_and_those_of_an_inlet_stay_with_it() {
    let radii = |text: &str| -> Vec<f64> {
        let mut session = Session::new(Scenario::from_str("test.toml", text).unwrap()).unwrap();
        session.advance(5000, false).unwrap();
        let particles = session.simulation().particles();
        particles.rows_by_id().into_iter().map(|row| particles.radii()[row]).collect()
    };
    let first = radii(STREAM);
    assert!(!first.is_empty());
    assert_eq!(first, radii(STREAM));
    assert_ne!(first, radii(&format!("seed = 2\n{STREAM}")));
    let own = changed(&[("name = \"stream\"", "name = \"stream\"\nseed = 1")]);
    assert_eq!(first, radii(&format!("seed = 2\n{own}")));
}
