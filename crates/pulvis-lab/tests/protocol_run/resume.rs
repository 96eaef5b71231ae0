//! Runs that are stopped at any of their looks, and branches of them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use pulvis_input::scenario::CheckpointPlan;
use pulvis_lab::protocol::{Ending, RunSummary, load_scenario, resume};

use super::protocol_scenarios::{Series, options, run, run_with, scenario};
use super::{coarse, observed};

pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    let files = entries.filter(|path| ![".pulvis-lock", "status.json"].contains(&&*name(path)));
    files.map(|path| (name(&path), fs::read(&path).unwrap())).collect()
}

#[test]
fn a_run_that_is_stopped_at_one_look_after_the_other_leaves_the_same_files() {
    let [whole, stopped] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let mut scenario = observed();
    scenario.output.checkpoints = Some(CheckpointPlan { stage_ends: true, ..CheckpointPlan::default() });
    scenario.output.files = super::files::every_format();
    run(&scenario, whole.path());
    let stop = AtomicBool::new(true);
    let mut watch = |progress: &pulvis_lab::protocol::Progress| {
        let ended = progress.ending.is_some_and(|ending| ending != Ending::Interrupted);
        stop.fetch_or(ended, Ordering::Relaxed);
    };
    let mut summary: RunSummary = run_with(&scenario, &options(stopped.path()), &stop, &mut watch).unwrap();
    let mut resumed: u64 = 0;
    while summary.interrupted() {
        assert!(summary.can_be_resumed);
        resumed += 1;
        // Twenty looks in a row, then on to the end of the stage.
        stop.store(!resumed.is_multiple_of(20), Ordering::Relaxed);
        let before = summary.steps;
        summary = resume(stopped.path(), &options(stopped.path()), &stop, &mut watch).unwrap();
        assert!(summary.steps > before && summary.steps_before == before, "{before} {}", summary.steps);
    }
    assert!(resumed > 40, "{resumed}");
    assert_eq!(summary.stages.len(), 3);
    let (found, expected) = (files(stopped.path()), files(whole.path()));
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    let different: Vec<&String> = found.keys().filter(|name| found[*name] != expected[*name]).collect();
    assert!(different.is_empty(), "{different:?}");
}

#[test]
fn a_branch_from_the_middle_of_a_stage_goes_on_with_the_motions_of_its_walls() {
    let place = tempfile::tempdir().unwrap();
    let [whole, stopped, branched] = ["whole", "stopped", "branched"].map(|name| place.path().join(name));
    let scenario = coarse();
    run(&scenario, &whole);
    // At the first look the walls are on their ramps.
    let summary = run_with(&scenario, &options(&stopped), &AtomicBool::new(true), &mut |_| {}).unwrap();
    assert!(summary.interrupted() && summary.steps == 16);
    let file = place.path().join("branch.toml");
    let text = "start_from = \"stopped\"\n[[stages]]\nname = \"on\"\nuntil = { time = \"0.12 us\" }\n[output]\ntimeseries = { interval = \"1 ns\" }\nplots = false\n";
    fs::write(&file, text).unwrap();
    run(&load_scenario(&file, &[]).unwrap(), &branched);
    let [expected, found] = [&whole, &branched].map(|folder| Series::read(folder));
    let steps = expected.column("step");
    let mut compared = 0;
    for name in
        ["kinetic", "elastic", "dissipated", "work_servo", "position_x-high", "force_z-high", "overlap_max"]
    {
        let (expected, found) = (expected.column(name), found.column(name));
        for (step, value) in series_steps(&branched).into_iter().zip(found) {
            // The row at the start stands between two of the other run.
            let Some(row) = steps.iter().position(|other| *other == step) else { continue };
            assert_eq!(value.to_bits(), expected[row].to_bits(), "{name} in step {step}");
            compared += 1;
        }
    }
    assert!(compared > 500, "{compared}");
}

fn series_steps(folder: &Path) -> Vec<f64> {
    Series::read(folder).column("step")
}

#[test]
fn walls_that_the_run_before_has_removed_cannot_be_controlled() {
    let place = tempfile::tempdir().unwrap();
    let before = place.path().join("before");
    run(&coarse(), &before);
    let file = place.path().join("branch.toml");
    let text = "start_from = \"before\"\n[[stages]]\nname = \"on\"\nuntil = { time = \"1 ns\" }\nwalls.y-low = { control = \"fixed\" }\n";
    fs::write(&file, text).unwrap();
    let branch = load_scenario(&file, &[]).unwrap();
    let error = pulvis_lab::protocol::prepare(&branch).unwrap_err().to_string();
    assert!(
        error.contains("5:15: stages[0].walls.y-low: the wall y-low was removed in the run before"),
        "{error}"
    );
    let gone = text.replace("y-low", "x-low");
    fs::write(&file, gone).unwrap();
    assert!(pulvis_lab::protocol::prepare(&load_scenario(&file, &[]).unwrap()).is_ok());
    // What is not a run has no state.
    let nothing = scenario(&format!("start_from = \"none\"\n{}", coarse().to_resolved_toml("test")));
    let error = pulvis_lab::protocol::prepare(&nothing).unwrap_err().to_string();
    assert!(error.contains("start_from: ") && error.contains("none cannot be read"), "{error}");
}
