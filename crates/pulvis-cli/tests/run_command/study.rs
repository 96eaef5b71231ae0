//! Studies: runs over seeds and values, their means, what is expected of them, and how they go on.

use crate::place::*;

use std::fs;
use std::path::Path;
use std::process::Output;

/// A sphere that meets a wall, and its study over adhesion and speed.
const DROP: &str = include_str!("../../../../experiments/study-restitution/drop.toml");
const RESTITUTION: &str = include_str!("../../../../experiments/study-restitution/study.toml");

/// The kinetic energy of grains that fly at random.
const GAS: &str = r#"[study]
title = "A gas"
scenario = "s.toml"
seeds = [5, 6, 9]

[[study.over]]
key = "particles[0].velocity.standard_deviation"
label = "v"
values = ["1 m/s", "2 m/s"]

[[measures]]
key = "E0"
what = "kinetic energy at the start"
unit = "J"
value = "first"
y = "kinetic"

[[measures]]
key = "e2"
what = "kinetic energy that is left"
value = "last"
y = "kinetic"
over = { value = "first" }
"#;

fn with_study(name: &str, scenario: &str, study: &str) -> Place {
    // Pictures of each run take longer than these runs.
    let scenario =
        scenario.replace("timeseries = { steps = 10 }\n", "timeseries = { steps = 10 }\nplots = false\n");
    let scenario = scenario.replace("plots = false\nplots = false", "plots = false");
    let place = Place::with(name, &scenario, &[]);
    fs::write(place.0.join("study.toml"), study).unwrap();
    place
}

fn study(place: &Place, further: &[&str]) -> Output {
    place.pulvis(&[&["study", "study.toml", "--quiet"], further].concat())
}

/// The rows of a table of the study, cell by cell, and the indices of its columns.
struct Rows {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Rows {
    fn of(place: &Place, file: &str) -> Self {
        let text = place.read(file);
        // No cell of these tables has a comma or a line of its own.
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let columns = lines.next().unwrap();
        Self { columns, rows: lines.collect() }
    }

    fn column(&self, name: &str) -> Vec<&str> {
        let index = self.columns.iter().position(|column| column == name).unwrap_or_else(|| panic!("{name}"));
        self.rows.iter().map(|row| row[index].as_str()).collect()
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        self.column(name).iter().map(|cell| cell.parse().unwrap()).collect()
    }
}

#[test]
fn the_restitution_of_a_sphere_at_a_wall_is_that_of_the_balance_of_energies() {
    let study_text = RESTITUTION.replace("drop.toml", "s.toml");
    let place = with_study("study_restitution", DROP, &study_text);
    let done = study(&place, &[]);
    assert_eq!((done.status.code(), error(&done).as_str()), (Some(0), ""), "{}", out(&done));
    assert!(
        out(&done).contains("10 of 10 runs complete") && out(&done).contains("10 of 10 means as expected")
    );
    let runs = Rows::of(&place, "study-study/runs.csv");
    let kc = runs.numbers("contacts.grain-plate.normal.kc [N/m]");
    let speed = runs.numbers("particles[0].velocity.mean[2] [m/s]");
    // Loading along k1 to δ, back along k2 = K k1 to the force −f and along −kc to zero. What the three triangles leave is
    // e² = (1 + 2β − βK)/(K + β) with β = kc/k1, where K = 1 + (kp/k1 − 1) δ/δp, δ = v √(m/k1), δp = 2 R φ_f kp/(kp − k1).
    let (radius, density, k1, kp, phi_f) = (1e-3_f64, 2000.0, 100.0_f64, 500.0, 0.05);
    let mass = 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius * density;
    for ((kc, speed), found) in kc.iter().zip(&speed).zip(runs.numbers("e2")) {
        let overlap = speed.abs() * (mass / k1).sqrt();
        let stiffer = 1.0 + (kp / k1 - 1.0) * overlap / (2.0 * radius * phi_f * kp / (kp - k1));
        let beta = kc / k1;
        let expected = (1.0 + 2.0 * beta - beta * stiffer) / (stiffer + beta);
        // Fifty steps in the shortest contact are good to some 1e-4.
        assert!((found - expected).abs() < 5e-4, "kc = {kc}, v = {speed}: {found}, not {expected}");
    }

    // A value that is wrong is missed, with exit code 1, and nothing is computed again.
    fs::write(place.0.join("study.toml"), study_text.replace("[0.51915,", "[0.53,")).unwrap();
    let missed = study(&place, &[]);
    assert_eq!(missed.status.code(), Some(1));
    assert!(out(&missed).contains("10 of 10 runs complete (10 were there)"), "{}", out(&missed));
    assert!(
        out(&missed).contains("missed: e2 at kc=0-N-m_v=-0.1-m-s: 0.51918, expected 0.53 within 0.002"),
        "{}",
        out(&missed)
    );
    assert!(place.read("study-study/report.md").contains("| missed |"));
}

/// Mean, spread and standard error in plain arithmetic.
fn statistics([a, b, c]: [f64; 3]) -> [f64; 3] {
    let mean = (a + b + c) / 3.0;
    let square = |value: f64| (value - mean) * (value - mean);
    let spread = ((square(a) + square(b) + square(c)) / 2.0).sqrt();
    [mean, spread, spread / 3.0_f64.sqrt()]
}

#[test]
fn means_and_standard_errors_are_those_of_the_time_series_by_hand() {
    let place = with_study("study_gas", TINY, GAS);
    let done = study(&place, &["--threads", "1", "--output", "one"]);
    assert_eq!(done.status.code(), Some(0), "{}{}", out(&done), error(&done));
    let energies = |point: &str, seed: u32| {
        let series = place.read(&format!("one/runs/{point}/seed-{seed}/timeseries.csv"));
        let mut lines = series.lines();
        let column = lines.next().unwrap().split(',').position(|name| name == "kinetic").unwrap();
        let values: Vec<f64> =
            lines.map(|line| line.split(',').nth(column).unwrap().parse().unwrap()).collect();
        [values[0], values[values.len() - 1]]
    };
    let means = Rows::of(&place, "one/study.csv");
    let found = ["mean", "spread", "standard_error"].map(|name| means.numbers(name));
    for (number, point) in ["v=1-m-s", "v=2-m-s"].into_iter().enumerate() {
        let of_seeds = [5, 6, 9].map(|seed| energies(point, seed));
        let expected =
            [of_seeds.map(|[first, _]| first), of_seeds.map(|[first, last]| last / first)].map(statistics);
        for (measure, expected) in expected.into_iter().enumerate() {
            for (found, expected) in found.iter().map(|column| column[2 * number + measure]).zip(expected) {
                assert!(
                    (found - expected).abs() <= 1e-13 * expected.abs(),
                    "{point}: {found}, not {expected}"
                );
                assert!(expected > 0.0);
            }
        }
    }
    // Twice the speed of every grain is four times the energy, with the same random numbers.
    let energy = Rows::of(&place, "one/runs.csv").numbers("E0");
    assert!((0..3).all(|seed| (energy[3 + seed] / energy[seed] - 4.0).abs() < 1e-12), "{energy:?}");

    // The same bits with two threads.
    let two = study(&place, &["--threads", "2", "--output", "two"]);
    assert_eq!(two.status.code(), Some(0));
    for file in ["runs.csv", "study.csv", "study.json", "E0.png", "E0.svg", "e2.svg"] {
        let bytes = |folder: &str| fs::read(place.0.join(folder).join(file)).unwrap();
        assert!(bytes("one") == bytes("two"), "{file}");
    }
    let html = place.read("one/report.html");
    assert!(html.matches("<svg").count() == 2 && !html.contains("src="));

    // With one seed more, and a value more, only what is missing is run.
    let more = GAS.replace("[5, 6, 9]", "[5, 6, 9, 2]").replace("\"2 m/s\"", "\"0.5 m/s\", \"2 m/s\"");
    fs::write(place.0.join("study.toml"), more).unwrap();
    let dry = study(&place, &["--dry-run", "--output", "one"]);
    assert_eq!(dry.status.code(), Some(0), "{}", error(&dry));
    assert!(out(&dry).contains("6 of 12 runs to be carried out"), "{}", out(&dry));
    assert_eq!(Rows::of(&place, "one/runs.csv").rows.len(), 6, "a dry run writes nothing");
    let grown = study(&place, &["--output", "one"]);
    assert!(out(&grown).contains("12 of 12 runs complete (6 were there)"), "{}", out(&grown));
    let json = place.read("one/study.json");
    assert_eq!(json.matches("\"standard_error\"").count(), 6, "{json}");
}

#[test]
fn a_run_that_fails_is_recorded_and_stops_no_other() {
    // A pressure that throws the wall through the grains.
    let pressed = "until = { time = \"20 ms\" }\nwalls.z-high = { control = \"servo\", pressure = \"10 Pa\", mass = \"1 g\", damping = \"0 kg/s\" }";
    let scenario = TINY.replace("until = { time = \"1 ms\" }", pressed);
    let text = GAS
        .replace("particles[0].velocity.standard_deviation", "stages[0].walls.z-high.pressure")
        .replace("label = \"v\"\nvalues = [\"1 m/s\", \"2 m/s\"]", "values = [\"1e5 Pa\", \"10 Pa\"]");
    let place = with_study("study_fails", &scenario, &text);
    let done = study(&place, &[]);
    assert_eq!(done.status.code(), Some(1), "{}", error(&done));
    assert!(
        out(&done).contains("3 of 6 runs complete") && out(&done).contains("3 failed: runs.csv says why"),
        "{}",
        out(&done)
    );
    // Failures are told even to those who want quiet.
    assert_eq!(error(&done).matches("failed: stage `mix`").count(), 3, "{}", error(&done));
    let table = place.read("study-study/runs.csv");
    let of = |word: &str| table.lines().filter(|line| line.contains(word)).count();
    assert_eq!((of(",failed,"), of(",complete,"), of("likely cause: ")), (3, 3, 3), "{table}");
    let means = place.read("study-study/study.csv");
    assert!(means.lines().any(|line| line.starts_with("pressure=1e5-Pa,100000,e2,0,3,0,nan,") && line.ends_with(",failed")), "{means}");
    assert!(place.read("study-study/report.md").contains("why it failed"));
    // Tried again, they fail again; the others are there.
    let again = study(&place, &[]);
    assert_eq!(again.status.code(), Some(1));
    assert!(out(&again).contains("3 of 6 runs complete (3 were there)"), "{}", out(&again));
    assert_eq!(place.read("study-study/runs.csv"), table);
}

#[cfg(unix)]
#[test]
fn a_study_that_is_interrupted_goes_on_to_the_same_tables() {
    let scenario = TINY.replace("until = { time = \"1 ms\" }", "until = { time = \"100 ms\" }");
    let place = with_study("study_interrupted", &scenario, GAS);
    let whole = study(&place, &["--output", "whole"]);
    assert_eq!(whole.status.code(), Some(0), "{}", error(&whole));
    let command = place.command(&["study", "study.toml", "--quiet", "--output", "cut", "--threads", "1"]);
    let child = Ended(spawn(command));
    wait_for_rows(&place.0.join("cut/runs/v=1-m-s/seed-5/timeseries.csv"));
    // While it goes on nobody else may write there.
    let second = study(&place, &["--output", "cut"]);
    assert_eq!(second.status.code(), Some(2));
    assert!(error(&second).contains("a run is going on in the output folder cut"), "{}", error(&second));
    let killed =
        std::process::Command::new("kill").arg("-INT").arg(child.0.id().to_string()).status().unwrap();
    assert!(killed.success());
    let mut child = child;
    let code = child.0.wait().unwrap().code();
    assert_eq!(code, Some(130));
    let states = Rows::of(&place, "cut/runs.csv");
    let count = |word: &str| states.column("status").iter().filter(|status| **status == word).count();
    // The signal may come between two runs.
    let [complete, interrupted, waiting] = ["complete", "interrupted", "waiting"].map(count);
    assert!(interrupted <= 1 && waiting >= 1, "{:?}", states.column("status"));
    assert_eq!(complete + interrupted + waiting, 6, "{:?}", states.column("status"));
    let resumed = study(&place, &["--output", "cut"]);
    assert_eq!(resumed.status.code(), Some(0), "{}{}", out(&resumed), error(&resumed));
    for file in ["runs.csv", "study.csv", "study.json", "runs/v=1-m-s/seed-5/timeseries.csv", "E0.png"] {
        let bytes = |folder: &str| fs::read(place.0.join(folder).join(file)).unwrap();
        assert!(bytes("cut") == bytes("whole"), "{file}");
    }
}

#[test]
fn what_can_be_known_is_refused_before_the_first_run() {
    let place = with_study("study_refused", TINY, GAS);
    let refused = |text: &str, message: &str| {
        fs::write(place.0.join("study.toml"), text).unwrap();
        let run = study(&place, &["--output", "none"]);
        assert_eq!(run.status.code(), Some(2), "{message}: {}", out(&run));
        assert!(error(&run).contains(message), "{message}: {}", error(&run));
        assert!(!place.0.join("none").exists());
    };
    refused(
        &GAS.replace("y = \"kinetic\"\nover", "y = \"kinetics\"\nover"),
        "study.toml:22:5: measures[1].y: found \"kinetics\"; expected \"step\", \"time\",",
    );
    // Copies of one run have no standard error.
    let idle = GAS.replace("particles[0].velocity.standard_deviation", "seed");
    refused(&idle, "the seed is no value like others");
    let still = GAS.replace(
        "scenario = \"s.toml\"",
        "scenario = \"s.toml\"\nset = { \"particles[0].velocity.standard_deviation\" = \"0 m/s\" }",
    );
    let still = still
        .replace(
            "particles[0].velocity.standard_deviation\"\nlabel",
            "contacts.grain-grain.normal.kc\"\nlabel",
        )
        .replace("m/s\", \"2 m/s", "N/m\", \"2 N/m");
    refused(&still, "study.toml:5:9: study.seeds: the seeds 5 and 6 give the same run; expected one seed");
    // What only the particles of a point tell.
    let dense = GAS
        .replace("particles[0].velocity.standard_deviation", "particles[0].radius.value")
        .replace("1 m/s\", \"2 m/s", "1 mm\", \"1.3 mm");
    refused(&dense, "note: this is the point v=1.3-mm of the study");
}

#[test]
fn force_begins_the_runs_anew_and_removes_nothing_else() {
    let place = with_study("study_force", TINY, GAS);
    assert_eq!(study(&place, &[]).status.code(), Some(0));
    let note = place.0.join("study-study/runs/v=1-m-s/seed-5/notes.txt");
    fs::write(&note, "mine").unwrap();
    // Another scenario: its runs are not taken for those of this one.
    let scenario = place.read("s.toml").replace("kc = \"100 N/m\"", "kc = \"90 N/m\"");
    fs::write(place.0.join("s.toml"), scenario).unwrap();
    let refused = study(&place, &[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        error(&refused).contains("seed-5 holds a run of another scenario, or by another version"),
        "{}",
        error(&refused)
    );
    let anew = study(&place, &["--force"]);
    assert_eq!(anew.status.code(), Some(0), "{}", error(&anew));
    assert!(out(&anew).contains("6 of 6 runs complete, in"), "{}", out(&anew));
    assert_eq!(fs::read_to_string(&note).unwrap(), "mine");
    assert!(place.read("study-study/runs/v=1-m-s/seed-5/run.toml").contains("kc = \"90.0 N/m\""));
    // A folder that is no study's is not touched, whatever is asked for.
    fs::create_dir(place.0.join("other")).unwrap();
    fs::write(place.0.join("other/data.csv"), "mine").unwrap();
    for further in [&["--output", "other"][..], &["--output", "other", "--force"]] {
        let refused = study(&place, further);
        assert_eq!(refused.status.code(), Some(2));
        assert!(error(&refused).contains("output folder other is not empty"), "{}", error(&refused));
    }
    assert_eq!(fs::read_dir(Path::new(&place.0.join("other"))).unwrap().count(), 1);
}
