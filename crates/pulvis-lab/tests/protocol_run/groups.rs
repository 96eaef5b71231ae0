//! Groups of particles and steady columns in stages, resumed and branched.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use pulvis_lab::protocol::{Ending, Progress, RunError, load_scenario, prepare, resume};
use tempfile::tempdir;

use super::protocol_scenarios::{Series, options, run, run_with, scenario};

/// Grains fall on a layer of the same grains that is held; then a ball is pushed into them.
const BED: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[domain]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["4 mm", "4 mm", "8 mm"]
periodic = ["x", "y"]
[materials.grain]
density = "2500 kg/m^3"
[materials.ball]
density = "2500 kg/m^3"
[contacts.grain-grain]
normal = { law = "linear", k = "500 N/m" }
viscosity = { law = "restitution", restitution = 0.3, stiffness = "500 N/m" }
sliding = { law = "spring-slider", kt = "140 N/m", mu = 0.5 }
[contacts.grain-ball]
normal = { law = "linear", k = "500 N/m" }
viscosity = { law = "restitution", restitution = 0.3, stiffness = "500 N/m" }
[[particles]]
material = "grain"
radius = { distribution = "fixed", value = "0.5 mm" }
arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [4, 4, 1], spacing = "1 mm" }
[[particles]]
material = "grain"
count = 32
radius = { distribution = "uniform", minimum = "0.4 mm", maximum = "0.5 mm" }
arrangement = { kind = "random", lower = ["0 mm", "0 mm", "1 mm"], upper = ["4 mm", "4 mm", "4 mm"] }
[[particles]]
material = "ball"
radius = { distribution = "fixed", value = "0.8 mm" }
arrangement = { kind = "list", positions = [["2 mm", "2 mm", "7 mm"]] }
[groups.floor]
region = { kind = "layer", axis = "z", lower = "-0.5 mm", upper = "0.55 mm" }
[groups.ball]
material = "ball"
[[stages]]
name = "rest"
until = { time = "0.3 s" }
groups.floor = { control = "fixed" }
groups.ball = { control = "fixed" }
[[stages]]
name = "push"
groups.ball = { control = "cosine", displacement = ["0 mm", "0 mm", "-4.5 mm"], period = "40 ms", cycles = 0.5 }
[[stages]]
name = "free"
until = { time = "4 ms" }
groups.floor = { control = "velocity", velocity = ["0.1 m/s", "0 m/s", "0 m/s"] }
[output]
timeseries = { interval = "1 ms" }
plots = false
"#;

/// 4/3 π ρ Σ a³ g of grains of these radii [N].
fn weight(series: &Series) -> f64 {
    // All grains but the ball, from the change of the potential: m g of everything is the load of the floor at rest.
    *series.of_stage("force_z_floor", 1).last().unwrap()
}

#[test]
fn a_held_floor_carries_the_bed_and_a_ball_that_is_pushed_in_does_the_work_of_its_column() {
    let folder = tempdir().unwrap();
    let plan = scenario(BED);
    let particles = prepare(&plan).unwrap().particles;
    let loose: f64 = particles[16..48].iter().map(|particle| particle.mass).sum();
    let summary = run(&plan, folder.path());
    let endings: Vec<Ending> = summary.stages.iter().map(|stage| stage.ending).collect();
    assert_eq!(endings, [Ending::Time, Ending::Cycles, Ending::Time]);
    assert!(summary.energy_error_max < 2e-3, "{}", summary.energy_error_max);
    let series = Series::read(folder.path());
    assert_eq!((series.column("members_floor")[1], series.column("members_ball")[1]), (16.0, 1.0));
    // At rest to 1e-3 of the elastic energy's motion, the floor carries what is loose.
    assert!((weight(&series) / (-9.81 * loose) - 1.0).abs() < 1e-2, "{} {loose}", weight(&series));
    let [works, floor, ball] = ["work_walls", "work_floor", "work_ball"].map(|name| series.of_stage(name, 2));
    let (work, ball) = (*works.last().unwrap(), *ball.last().unwrap());
    // The ball does it all; its own weight is lifted down.
    let own = -particles[48].mass * 9.81 * 4.5e-3;
    assert_eq!((work, *floor.last().unwrap()), (ball, 0.0));
    assert!(ball - own > 1e-8, "{ball} {own}");
    assert!(series.of_stage("force_z_ball", 2).iter().any(|&force| force > 0.0));
    // What moves with 0.1 m/s drags the others along.
    assert!(*series.of_stage("work_floor", 3).last().unwrap() > 0.0);
}

/// Runs a scenario and stops it at one look after the other; all files are those of a run that was not stopped.
fn goes_on_anywhere(text: &str) {
    let [whole, stopped] = [(); 2].map(|()| tempdir().unwrap());
    let plan = scenario(text);
    run(&plan, whole.path());
    let stop = AtomicBool::new(true);
    let mut watch = |progress: &Progress| {
        let ended = progress.ending.is_some_and(|ending| ending != Ending::Interrupted);
        stop.fetch_or(ended, Ordering::Relaxed);
    };
    let mut summary = run_with(&plan, &options(stopped.path()), &stop, &mut watch).unwrap();
    let mut resumed = 0_u64;
    while summary.interrupted() {
        resumed += 1;
        stop.store(!resumed.is_multiple_of(4), Ordering::Relaxed);
        summary = resume(stopped.path(), &options(stopped.path()), &stop, &mut watch).unwrap();
    }
    assert!(resumed > 3, "{resumed}");
    let read = |folder: &Path| fs::read_to_string(folder.join("timeseries.csv")).unwrap();
    assert_eq!(read(stopped.path()), read(whole.path()));
    let shared = tempdir().unwrap();
    super::protocol_scenarios::on_ranks(&plan, shared.path(), 2);
    assert_eq!(read(shared.path()), read(whole.path()), "on two ranks");
}

#[test]
fn a_run_with_groups_goes_on_with_the_same_bits() {
    goes_on_anywhere(&BED.replace("time = \"0.3 s\"", "time = \"20 ms\""));
}

#[test]
fn a_branch_goes_on_with_the_groups_of_its_run() {
    let place = tempdir().unwrap();
    run(&scenario(&BED.replace("time = \"0.3 s\"", "time = \"10 ms\"")), &place.path().join("before"));
    let file = place.path().join("branch.toml");
    let text = "start_from = \"before\"\n[[stages]]\nname = \"on\"\nuntil = { time = \"2 ms\" }\ngroups.ball = { control = \"free\" }\n[output]\nplots = false\n";
    fs::write(&file, text).unwrap();
    let prepared = prepare(&load_scenario(&file, &[]).unwrap()).unwrap();
    let motions: Vec<&str> = prepared.simulation.groups().iter().map(|group| group.motion().name()).collect();
    // The cosine has come to its end.
    assert_eq!(motions, ["velocity", "fixed"]);
    let after = place.path().join("after");
    run(&load_scenario(&file, &[]).unwrap(), &after);
    let series = Series::read(&after);
    let [start, end] = [0, 1].map(|row| series.column("work_floor")[row]);
    assert!(end > start && start > 0.0, "{start} {end}");
}

fn refused(text: &str) -> String {
    prepare(&scenario(text)).unwrap_err().to_string()
}

#[test]
fn groups_of_nobody_and_groups_that_are_too_fast_are_refused() {
    let nobody = refused(&BED.replace("upper = \"0.55 mm\"", "upper = \"-0.1 mm\""));
    assert!(
        nobody.contains("groups.floor: no particle belongs to it at the start of the first stage; expected one particle at least"),
        "{nobody}"
    );
    let fast = refused(&BED.replace("[\"0.1 m/s\",", "[\"1e4 m/s\","));
    assert!(
        fast.contains("stages[2].groups.floor.velocity: the group floor moves at 1.0000e4 m/s"),
        "{fast}"
    );
    // Known only when the stage begins.
    let late = "\n[groups.late]\nregion = { kind = \"layer\", axis = \"z\", lower = \"90 mm\", upper = \"91 mm\" }\n";
    let text = BED
        .replace("time = \"0.3 s\"", "time = \"1 ms\"")
        .replace("[groups.ball]", &format!("{late}[groups.ball]"))
        .replace(
            "groups.ball = { control = \"cosine\"",
            "groups.late = { control = \"fixed\" }\ngroups.ball = { control = \"cosine\"",
        );
    let folder = tempdir().unwrap();
    let failed = run_with(&scenario(&text), &options(folder.path()), &AtomicBool::new(false), &mut |_| {})
        .unwrap_err();
    assert!(
        matches!(&failed, RunError::EmptyGroup { stage, group } if stage == "push" && group == "late"),
        "{failed}"
    );
}

/// A grain in a medium: v(t) = (m g/γ) (1 − e^(−t γ/m)).
const FALLING: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[materials.grain]
density = "2500 kg/m^3"
[contacts.grain-grain.normal]
law = "linear"
k = "100 N/m"
[background]
drag = "1e-4 kg/s"
[[particles]]
material = "grain"
radius = { distribution = "fixed", value = "0.5 mm" }
arrangement = { kind = "list", positions = [["0 mm", "0 mm", "0 mm"], ["9 mm", "0 mm", "0 mm"]] }
[time]
steps_per_contact_time = 20
[[stages]]
name = "fall"
until = { steady = { column = "kinetic", block = "20 ms", blocks = 4, tolerance = 1e-3 }, time = "2 s" }
[output]
timeseries = { interval = "2 ms" }
plots = false
"#;

#[test]
fn a_falling_grain_is_steady_when_it_has_its_terminal_speed() {
    let folder = tempdir().unwrap();
    let summary = run(&scenario(FALLING), folder.path());
    assert_eq!(summary.stages[0].ending, Ending::Steady);
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 2500.0 * (0.5e-3 * 0.5e-3 * 0.5e-3);
    let relaxation = mass / 1e-4;
    let speed = 9.81 * relaxation;
    let terminal = mass * speed * speed;
    let kinetic = *Series::read(folder.path()).column("kinetic").last().unwrap();
    // 1 − K/K∞ = 2 e^(−t/τ) in the end. Four blocks of 20 ms before, it was e^(80 ms/τ) times that: with τ = 13 ms, all of the
    // drift over the window, of which the line sees less than all. It is below 1e-3, and what is left is 1/400 of it.
    assert!((kinetic / terminal - 1.0).abs() < 1e-5, "{kinetic} {terminal}");
    // 2 e^(−t/τ) = 1e-3 some 7.6 τ after the start, a window and a block later it must be steady.
    let expected = 7.6 * relaxation;
    assert!(summary.stages[0].time > expected && summary.stages[0].time < expected + 0.12, "{summary:?}");
}

#[test]
fn what_a_steady_rule_has_seen_is_kept_when_a_run_is_resumed() {
    goes_on_anywhere(&FALLING.replace("block = \"20 ms\"", "block = \"8 ms\""));
}

#[test]
fn steady_rules_that_look_at_nothing_or_at_few_steps_are_refused() {
    let unknown = refused(&FALLING.replace("column = \"kinetic\"", "column = \"kinetik\""));
    assert!(
        unknown.contains("stages[0].until.steady.column: found \"kinetik\"; expected ")
            && unknown.contains("did you mean `kinetic`?"),
        "{unknown}"
    );
    let short = refused(&FALLING.replace("block = \"20 ms\"", "block = \"20 us\""));
    assert!(
        short.contains("stages[0].until.steady.block: 0.00002 s are ") && short.contains("500 steps or more"),
        "{short}"
    );
}
