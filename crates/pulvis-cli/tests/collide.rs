//! `pulvis collide` and `pulvis laws` from outside: outputs, files and exit codes.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

const EXPERIMENT: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../experiments/restitution/experiment.toml");

fn pulvis(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pulvis")).args(arguments).output().unwrap()
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn error(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// An empty folder of this test.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn csv_and_json_have_the_promised_columns() {
    let csv = pulvis(&["collide", EXPERIMENT, "--format", "csv"]);
    assert_eq!(csv.status.code(), Some(0), "{}", error(&csv));
    let text = out(&csv);
    let promised = "velocity,chi,zeta,restitution,restitution_theory,overlap_max,overlap_end,regime,contact_duration,energy_dissipated";
    assert!(text.starts_with(promised), "{}", text.lines().next().unwrap());
    assert_eq!(text.lines().count(), 64);
    let json = out(&pulvis(&["collide", EXPERIMENT, "--format", "json"]));
    assert!(json.contains("\"regime\"") && json.contains("stick"), "{json}");
}

#[test]
fn trajectories_and_pictures_are_written_and_never_written_over_without_force() {
    let folder = folder("trajectories");
    let courses = folder.join("courses");
    let picture = folder.join("e.svg");
    let arguments = [
        "collide",
        EXPERIMENT,
        "--trajectory",
        courses.to_str().unwrap(),
        "--plot",
        picture.to_str().unwrap(),
    ];
    let first = pulvis(&arguments);
    assert_eq!(first.status.code(), Some(0), "{}", error(&first));
    assert_eq!(fs::read_dir(&courses).unwrap().count(), 63);
    let course = fs::read_to_string(courses.join("trajectory_001.csv")).unwrap();
    let promised =
        "time,overlap,velocity,force,delta_max,kinetic,potential_available,potential_plastic,dissipated";
    assert!(course.starts_with(promised));
    assert!(course.lines().count() > 50);
    assert!(fs::read_to_string(&picture).unwrap().contains("<svg"));

    let second = pulvis(&arguments);
    assert_eq!(second.status.code(), Some(2));
    assert!(error(&second).contains("trajectory_001.csv exists"), "{}", error(&second));
    let forced = pulvis(&[&arguments[..], &["--force"]].concat());
    assert_eq!(forced.status.code(), Some(0), "{}", error(&forced));
}

#[test]
fn laws_are_compared_in_one_table_and_one_picture() {
    let folder = folder("compared");
    let (file, picture) = (folder.join("compared.toml"), folder.join("compared.svg"));
    let scenario = "[collision]\nbodies = \"wall\"\nradius = \"1 mm\"\ndensity = \"2000 kg/m^3\"\nangle = \"30 deg\"\n\
        [collision.sweep]\nvariable = \"normal_velocity\"\nvalues = [0.1, 0.2, 0.4]\n\
        [contact.normal]\nlaw = \"linear\"\nk = \"1e4 N/m\"\n\
        [contact.sliding]\nlaw = \"spring-slider\"\nkt = \"2e3 N/m\"\nmu = 0.3\n\
        [[compare]]\nlabel = \"smooth\"\nsliding = { law = \"none\" }\n";
    fs::write(&file, scenario).unwrap();
    let arguments =
        ["collide", file.to_str().unwrap(), "--format", "csv", "--plot", picture.to_str().unwrap()];
    let output = pulvis(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    let text = out(&output);
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|column| *column == name).unwrap();
    assert_eq!(column("contact"), rows[0].len() - 1);
    let labels: Vec<&str> = rows[1..].iter().map(|row| *row.last().unwrap()).collect();
    assert_eq!(labels[..3], ["linear + spring-slider"; 3]);
    assert_eq!(labels[3..], ["smooth"; 3]);
    let ratio = |row: &Vec<&str>| row[column("impulse_ratio")].parse::<f64>().unwrap();
    assert!(
        rows[1..4].iter().all(|row| ratio(row) > 0.05)
            && rows[4..].iter().all(|row| ratio(row).abs() < 1e-12)
    );
    let drawn = fs::read_to_string(&picture).unwrap();
    for words in ["smooth", "linear + spring-slider", "Tangential over normal impulse", "Force over overlap"]
    {
        assert!(drawn.contains(words), "{words}");
    }
}

#[test]
fn values_are_replaced_from_the_command_line() {
    let column = |arguments: &[&str]| -> Vec<String> {
        let text = out(&pulvis(&[&["collide", EXPERIMENT, "--format", "csv"], arguments].concat()));
        text.lines().skip(1).map(|line| line.split(',').nth(7).unwrap().to_owned()).collect()
    };
    assert!(column(&[]).contains(&"stick".to_owned()));
    // Below β* = 1/(η − 1) = 1/3 no pair sticks, S1 (40).
    assert!(!column(&["--set", "contact.normal.kc=\"30 N/m\""]).contains(&"stick".to_owned()));
}

#[test]
fn bad_input_ends_with_exit_code_2_and_says_where() {
    for (arguments, words) in [
        (vec!["collide", "no_such_file.toml"], "there is no such file"),
        (vec!["collide", EXPERIMENT, "--set", "contact.normal.kc=-1 N/m"], "contact.normal.kc"),
        (vec!["collide", EXPERIMENT, "--set", "contact.normal.phif=0.1"], "did you mean `phi_f`?"),
        (vec!["collide", EXPERIMENT, "--set", "nonsense"], "expected KEY=VALUE"),
        (
            vec![
                "collide",
                EXPERIMENT,
                "--set",
                "contact.normal.kc=1 N/m",
                "--set",
                "contact.normal.kc=2 N/m",
            ],
            "contact.normal.kc: the key is set twice from outside the file; expected each key once",
        ),
        (vec!["collide", EXPERIMENT, "--plot", "e.pdf"], "choose one of: png, svg"),
        (vec!["collide", EXPERIMENT, "--format", "xml"], "xml"),
        (vec!["collide"], "FILE"),
        (vec!["laws", "ludign"], "did you mean `luding`?"),
        (vec!["laws", "jkr", "--plot", "e.pdf"], "choose one of: png, svg"),
        (vec!["laws", "jkr", "--role", "rolling", "--plot", "e.png"], "it plays: normal"),
        (vec!["laws", "conventions", "--plot", "e.png"], "no forces that could be drawn"),
        (vec!["smash"], "smash"),
    ] {
        let output = pulvis(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(error(&output).contains(words), "{arguments:?}: {}", error(&output));
        assert_eq!(out(&output), "", "{arguments:?}");
    }
}

#[test]
fn every_law_is_listed_and_described_in_full() {
    let list = out(&pulvis(&["laws"]));
    for law in ["luding", "linear", "jump-in", "reversible", "overlap-power", "spring-slider"] {
        assert!(list.contains(law), "{law}");
        let text = out(&pulvis(&["laws", law]));
        for heading in ["Equations", "Parameters", "Memory", "Verified against", "Source", "Example"] {
            assert!(text.contains(heading), "{law}: {heading}");
        }
    }
    let luding = out(&pulvis(&["laws", "luding"]));
    assert!(luding.contains("φ_f") && luding.contains("N/m") && luding.contains("arXiv:1503.03720"));
}

#[test]
fn the_picture_of_a_law_comes_with_the_scenario_that_draws_the_same() {
    let folder = folder("portrait");
    let path = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let (one, other, scenario) = (path("one.svg"), path("other.svg"), path("jkr.toml"));
    let output = pulvis(&["laws", "jkr", "--plot", &one, "--scenario", &scenario]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    assert_eq!(pulvis(&["probe", &scenario, "--plot", &other]).status.code(), Some(0));
    assert_eq!(fs::read(&one).unwrap(), fs::read(&other).unwrap());
    let again = pulvis(&["laws", "jkr", "--plot", &one]);
    assert_eq!(again.status.code(), Some(2));
    assert!(error(&again).contains("--force"), "{}", error(&again));
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    use std::process::Stdio;
    let mut child = Command::new(env!("CARGO_BIN_EXE_pulvis"))
        .args(["laws"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(error(&output), "");
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn a_second_variable_has_a_column_in_one_table_and_a_picture_of_all_curves() {
    let folder = folder("family");
    let scenario = folder.join("family.toml");
    let text = fs::read_to_string(EXPERIMENT).unwrap();
    let family = "[collision.family]\nvariable = \"contact.normal.kc\"\nvalues = [\"10 N/m\", \"100 N/m\"]\n\n[contact.normal]";
    fs::write(&scenario, text.replace("[contact.normal]", family)).unwrap();
    let picture = folder.join("family.png");
    let arguments = [
        "collide",
        scenario.to_str().unwrap(),
        "--format",
        "csv",
        "--plot",
        picture.to_str().unwrap(),
        "--dpi",
        "72",
    ];
    let run = pulvis(&arguments);
    assert_eq!(run.status.code(), Some(0), "{}", error(&run));
    let table = out(&run);
    assert!(table.lines().next().unwrap().ends_with(",contact.normal.kc"), "{table}");
    assert_eq!(table.lines().count(), 1 + 2 * 63);
    assert!(table.lines().last().unwrap().ends_with(",100"), "{table}");
    assert!(picture.exists());
    let refused = pulvis(&["collide", scenario.to_str().unwrap(), "--plot", "e.png", "--dpi", "5000"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(error(&refused).contains("36..=600"), "{}", error(&refused));
}
