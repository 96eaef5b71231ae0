//! What a run does and leaves behind: endings of stages, files, threads, interruption.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stderr)]

#[path = "protocol_run/files.rs"]
mod files;
#[path = "protocol_run/groups.rs"]
mod groups;
#[path = "protocol_run/import.rs"]
mod import;
mod protocol_scenarios;
#[path = "protocol_run/ranks.rs"]
mod ranks;
#[path = "protocol_run/resume.rs"]
mod resume;
#[path = "protocol_run/session.rs"]
mod session;

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use protocol_scenarios::{Series, options, run, run_with, small_tablet, tablet};
use pulvis_input::scenario::Scenario;
use pulvis_lab::protocol::{Ending, PrepareError, RunError, RunOptions};
use pulvis_math::{max_or_nan, min_or_nan};

/// The small tablet with coarse steps, for what does not depend on them.
fn coarse() -> Scenario {
    tablet(&[("steps_per_contact_time = 50", "steps_per_contact_time = 20")])
}

/// The same with observers of the whole and of a part.
fn observed() -> Scenario {
    let observers = r#"
[[observers]]
name = "all"
histogram = true
[[observers]]
name = "inner"
region = { kind = "sphere", centre = ["20 um", "20 um", "20 um"], radius = "15 um" }
quantities = ["stress", "coordination", "walls"]
discard = "0.02 us"
blocks = 4
histogram = true
[output]"#;
    tablet(&[("steps_per_contact_time = 50", "steps_per_contact_time = 20"), ("\n[output]", observers)])
}

/// The small tablet whose first stage ends by a rule and is the last.
fn pressed_until(rule: &str, control: &str) -> Scenario {
    let text = include_str!("protocol_scenarios/tablet.toml");
    let [start, _] = split(text, "[[stages]]");
    let [_, output] = split(text, "[output]");
    let output = output.replace(", reference_stage = \"release\"", "");
    let stage = format!("[[stages]]\nname = \"press\"\nuntil = {rule}\n{control}\n");
    protocol_scenarios::scenario(&format!("{start}{stage}[output]{output}"))
}

fn split<'a>(text: &'a str, at: &str) -> [&'a str; 2] {
    text.split_once(at).unwrap().into()
}

#[test]
fn more_materials_than_the_engine_can_number_are_refused() {
    let mut scenario = small_tablet();
    scenario.materials.resize(65_538, scenario.materials[0].clone());
    let error = pulvis_lab::protocol::prepare(&scenario).unwrap_err().to_string();
    assert!(error.contains("65538 materials") && error.contains("at most 65536"), "{error}");
}

#[test]
fn each_stage_ends_for_the_reason_that_its_rules_name() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&coarse(), folder.path());
    let endings: Vec<_> = summary.stages.iter().map(|stage| (stage.name.as_str(), stage.ending)).collect();
    assert_eq!(endings, [("press", Ending::Time), ("release", Ending::AtRest), ("pull", Ending::Cycles)]);
    let [press, release, pull] = &summary.stages[..] else { panic!("three stages") };
    // A stage ends with the step that is nearest to its end.
    assert!((press.time - 0.15e-6).abs() < 2e-11, "{}", press.time);
    assert!((pull.time - release.time - 0.1e-6).abs() < 2e-11);
    let series = Series::read(folder.path());
    let [kinetic, elastic] = ["kinetic", "elastic"].map(|name| series.of_stage(name, 2));
    assert!(kinetic.last().unwrap() / elastic.last().unwrap() <= 1e-2);
    assert_eq!(summary.steps, pull.steps);
}

#[test]
fn the_servo_reaches_its_pressure_and_the_cosine_brings_the_plate_back() {
    let folder = tempfile::tempdir().unwrap();
    run(&coarse(), folder.path());
    let series = Series::read(folder.path());
    for axis in ["x", "y", "z"] {
        let stress = *series.of_stage(&format!("wall_stress_{axis}"), 1).last().unwrap();
        assert!((stress / 1e10 - 1.0).abs() < 0.05, "{stress:e} along {axis}");
    }
    let displacement = series.of_stage("D_x", 3);
    let farthest = displacement.iter().copied().fold(0.0, max_or_nan);
    // The row nearest to the turning point is half an interval of 1 ns away at most, of a period of 100 ns.
    assert!((farthest - 0.1).abs() < 1e-4, "{farthest}");
    assert!(displacement.last().unwrap().abs() < 1e-6);
    let force = series.of_stage("F_x", 3);
    assert!(force.iter().copied().fold(0.0, min_or_nan) < -1e-3, "the sample is pulled");
}

#[test]
fn removed_walls_have_no_force_and_no_stress_any_more() {
    let folder = tempfile::tempdir().unwrap();
    run(&coarse(), folder.path());
    let series = Series::read(folder.path());
    for name in ["y-low", "y-high", "z-low", "z-high"] {
        assert!(series.of_stage(&format!("force_{name}"), 3).iter().all(|&force| force == 0.0), "{name}");
        assert!(series.of_stage(&format!("force_{name}"), 2).iter().any(|&force| force > 0.0), "{name}");
    }
    assert!(series.of_stage("wall_stress_y", 3).iter().all(|stress| stress.is_nan()));
}

#[test]
fn a_stage_ends_at_the_strain_that_is_asked_for() {
    let scenario = pressed_until(
        "{ strain = { axis = \"z\", value = -0.02 } }",
        "walls.z-high = { control = \"velocity\", velocity = [\"0 m/s\", \"0 m/s\", \"-20 m/s\"] }",
    );
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario, folder.path());
    assert_eq!(summary.stages[0].ending, Ending::Strain);
    let strain = *Series::read(folder.path()).column("strain_z").last().unwrap();
    // One step of 2e-11 s at 20 m/s is a strain of 1e-5.
    assert!((-0.0201..=-0.02).contains(&strain), "{strain}");
}

#[test]
fn a_stage_ends_when_the_stress_crosses_its_value_from_the_stated_side() {
    let scenario = pressed_until(
        "{ stress = { axis = \"z\", value = \"1e9 Pa\", crosses = \"upwards\" }, time = \"1 us\" }",
        "walls.z-high = { control = \"velocity\", velocity = [\"0 m/s\", \"0 m/s\", \"-20 m/s\"] }",
    );
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario, folder.path());
    assert_eq!(summary.stages[0].ending, Ending::Stress);
    let stress = Series::read(folder.path()).column("wall_stress_z");
    assert!(*stress.last().unwrap() >= 1e9, "{:e}", stress.last().unwrap());
    assert!(stress[0] < 1e9);
}

#[test]
fn the_record_of_a_run_is_a_scenario_that_gives_the_same_run() {
    let [first, second] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let scenario = coarse();
    run(&scenario, first.path());
    let again = Scenario::load(first.path().join("run.toml")).unwrap();
    let plain = |scenario: &Scenario| Scenario { source: small_tablet().source, ..scenario.clone() };
    assert_eq!(plain(&again), plain(&scenario));
    run(&again, second.path());
    assert_eq!(bytes(first.path()), bytes(second.path()));
}

#[test]
fn observers_agree_with_the_other_columns_their_averages_and_their_distributions() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&observed(), folder.path());
    let series = Series::read(folder.path());
    let column = |name: &str| series.column(name);
    for (one, other) in [("coordination_all", "coordination"), ("solid_fraction_all", "solid_fraction")] {
        assert!(column(one).iter().zip(column(other)).all(|(one, other)| *one == other), "{one}");
    }
    // The forces on the walls of the pressing stage: those of the engine, whose dashpots see predicted velocities.
    let inner = series.of_stage("wall_force_x_x-high_inner", 1);
    let wall = series.of_stage("force_x-high", 1);
    assert!(inner.iter().zip(&wall).all(|(part, whole)| *part >= 0.0 && *part <= whole.abs() * 1.1 + 1e-9));
    let average = |observer: &str, stage: &str, quantity: &str| {
        let of = |average: &&pulvis_lab::protocol::Average| {
            average.observer == observer && average.stage == stage && average.quantity == quantity
        };
        summary.averages.iter().find(of).unwrap().clone()
    };
    let pressure = average("inner", "release", "pressure");
    let rows: Vec<(f64, f64)> =
        series.of_stage("time", 2).into_iter().zip(series.of_stage("pressure_inner", 2)).collect();
    let (start, mut seen) = (rows[0].0, rows.clone());
    seen.retain(|(time, _)| *time >= start + 2e-8);
    seen.dedup();
    let seen = &seen[seen.len() % 4..];
    let mean = seen.iter().map(|(_, value)| value).sum::<f64>() / seen.len() as f64;
    assert_eq!((pressure.rows, pressure.blocks, pressure.unit), (seen.len(), 4, "Pa"));
    assert!(mean > 1e7 && (pressure.mean / mean - 1.0).abs() < 1e-12, "{} {mean}", pressure.mean);
    assert!(pressure.standard_error.is_some_and(|error| error > 0.0 && error < mean));
    let text = fs::read_to_string(folder.path().join("averages.json")).unwrap();
    assert!(text.contains("\"corrected_coordination\"") && text.contains("\"inner\""), "{text}");
    for stage in 1..=3 {
        let file = folder.path().join(format!("forces_all.stage-{stage}.csv"));
        let table = fs::read_to_string(file).unwrap();
        let bins: Vec<Vec<f64>> = table
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
            .collect();
        let sum = |place: usize| bins.iter().map(|bin| bin[place]).sum::<f64>();
        let contacts = *series.of_stage("contacts_all", stage).last().unwrap();
        assert!(bins.len() > 10 && contacts > 50.0 && sum(2) == contacts, "{contacts} {}", sum(2));
        assert!((sum(3) * 0.1 - 1.0).abs() < 1e-12, "densities integrate to one");
        assert!(bins.iter().all(|bin| (bin[1] - bin[0] - 0.1).abs() < 1e-9));
    }
}

#[test]
fn two_threads_give_the_same_bits_as_one() {
    let [one, two] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let scenario = coarse();
    run(&scenario, one.path());
    let threads = RunOptions { threads: Some(2), ..options(two.path()) };
    run_with(&scenario, &threads, &AtomicBool::new(false), &mut |_| {}).unwrap();
    assert_eq!(bytes(one.path()), bytes(two.path()));
}

fn bytes(folder: &Path) -> Vec<u8> {
    fs::read(folder.join("timeseries.csv")).unwrap()
}

#[test]
fn an_interrupted_run_leaves_complete_files() {
    let folder = tempfile::tempdir().unwrap();
    let stop = AtomicBool::new(false);
    let mut told = Vec::new();
    let summary = run_with(&coarse(), &options(folder.path()), &stop, &mut |progress| {
        told.extend(progress.ending);
        // At the end of the first stage: the second one is stopped on its way.
        stop.store(progress.ending.is_some(), Ordering::Relaxed);
    });
    let summary = summary.unwrap();
    assert!(summary.interrupted());
    assert_eq!(told, [Ending::Time, Ending::Interrupted]);
    assert_eq!(summary.stages.len(), 2);
    let series = Series::read(folder.path());
    assert_eq!(*series.column("step").last().unwrap(), summary.steps as f64);
    let index = fs::read_to_string(folder.path().join("series.pvd")).unwrap();
    assert!(index.trim_end().ends_with("</VTKFile>"), "{index}");
    // At the start, at the end of the first stage and where it was stopped.
    let frames: Vec<&str> = index.split("file=\"").skip(1).map(|rest| split(rest, "\"")[0]).collect();
    assert_eq!(frames.len(), 3, "{index}");
    assert!(frames.iter().all(|frame| folder.path().join(frame).exists()));
    Scenario::load(folder.path().join("run.toml")).unwrap();
}

#[test]
fn a_folder_in_use_is_refused_and_force_writes_over_the_run_alone() {
    let folder = tempfile::tempdir().unwrap();
    let at_once = AtomicBool::new(true);
    let scenario = coarse();
    let start = |force| {
        let options = RunOptions { force, ..options(folder.path()) };
        run_with(&scenario, &options, &at_once, &mut |_| {})
    };
    start(false).unwrap();
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    fs::write(folder.path().join("particles_0009.vtp"), "of another run").unwrap();
    let before = bytes(folder.path());
    let refused = start(false).unwrap_err();
    assert!(refused.is_bad_input());
    assert!(matches!(refused, RunError::Prepare(PrepareError::RunInFolder { .. })), "{refused}");
    assert_eq!(bytes(folder.path()), before, "nothing was touched");
    let in_the_way = start(true).unwrap_err();
    assert!(
        in_the_way.is_bad_input() && in_the_way.to_string().contains("particles_0009.vtp"),
        "{in_the_way}"
    );
    assert_eq!(bytes(folder.path()), before, "nothing was touched");
    fs::remove_file(folder.path().join("particles_0009.vtp")).unwrap();
    start(true).unwrap();
    assert_eq!(fs::read_to_string(folder.path().join("notes.txt")).unwrap(), "mine");
}

#[test]
fn what_only_the_particles_can_tell_is_refused_before_anything_is_written() {
    for (changes, words) in [
        ([("spacing = \"10.8 um\"", "spacing = \"8 um\"")], "of the smaller radius at the start"),
        (
            [("time = { steps_per_contact_time = 50 }", "time = { step = \"1e-9 s\" }")],
            "longer than 1/10 of the shortest motion",
        ),
    ] {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("run");
        let refused = run_with(&tablet(&changes), &options(&folder), &AtomicBool::new(false), &mut |_| {});
        let refused = refused.unwrap_err();
        assert!(refused.is_bad_input() && refused.to_string().contains(words), "{refused}");
        assert!(!folder.exists());
    }
}
