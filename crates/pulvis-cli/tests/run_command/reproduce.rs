//! Figures: files, report, exit codes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const FIGURES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../experiments/figures");

/// An empty folder of this test.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn reproduce(from: &Path, output: &Path, names: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pulvis"));
    command.arg("reproduce").args(names).arg("--from").arg(from).arg("--output").arg(output);
    command.output().unwrap()
}

fn error(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn a_figure_becomes_pictures_a_table_and_a_report_that_needs_no_other_file() {
    let output = folder("reproduce_one");
    let first = reproduce(Path::new(FIGURES), &output, &["s1-08", "s1-01"]);
    assert_eq!(first.status.code(), Some(0), "{}", error(&first));
    for file in ["s1-08.png", "s1-08.svg", "s1-08.csv", "s1-01.csv", "report.md"] {
        assert!(output.join(file).exists(), "{file}");
    }
    let html = fs::read_to_string(output.join("report.html")).unwrap();
    // The pictures stand in the page, and nothing is fetched from elsewhere.
    assert_eq!(html.matches("<svg").count(), 2);
    assert!(!html.contains("src=") && !html.contains("@import") && !html.contains("url("));
    assert!(html.contains("prefers-color-scheme: dark") && html.contains("@media print"));
    // The maximum of the sticking overlap is √(1/3) δ_p, S1 (39); the fine theory line passes near it.
    let table = fs::read_to_string(output.join("s1-08.csv")).unwrap();
    let theory = table.lines().filter(|line| line.contains(",theory,"));
    let largest = theory.filter_map(|line| line.rsplit(',').next()?.parse::<f64>().ok()).fold(0.0, f64::max);
    assert!((largest - (1.0_f64 / 3.0).sqrt()).abs() < 2e-3, "{largest}");

    let again = reproduce(Path::new(FIGURES), &output, &["s1-08"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(error(&again).contains("report.html exists"), "{}", error(&again));
}

/// A copy of the figure s1-08, with changes to its file.
fn copied(to: &Path, name: &str, change: impl Fn(String) -> String) {
    let figure = to.join(name);
    fs::create_dir_all(&figure).unwrap();
    for entry in fs::read_dir(Path::new(FIGURES).join("s1-08")).unwrap() {
        let file = entry.unwrap().path();
        fs::copy(&file, figure.join(file.file_name().unwrap())).unwrap();
    }
    fs::copy(Path::new(FIGURES).join("notes.toml"), to.join("notes.toml")).unwrap();
    let file = figure.join("figure.toml");
    fs::write(&file, change(fs::read_to_string(&file).unwrap())).unwrap();
}

#[test]
fn a_missed_threshold_and_a_figure_that_fails_end_with_code_1_and_do_not_stop_the_others() {
    let from = folder("reproduce_missed");
    copied(&from, "good", |text| text);
    copied(&from, "missed", |text| text.replace("most = 2e-3", "most = 1e-12"));
    // A quantity that collisions which stick do not have: the check would compare nothing.
    copied(&from, "fails", |text| {
        text.replace(
            "quantity = \"overlap_end\"\nper = \"delta_p\"\nagainst",
            "quantity = \"contact_duration\"\nagainst",
        )
    });
    let output = from.join("out");
    let run = reproduce(&from, &output, &[]);
    assert_eq!(run.status.code(), Some(1), "{}", error(&run));
    let said = error(&run);
    assert!(said.contains("missed: overlap of the first stop, engine against theory"), "{said}");
    assert!(said.contains("finds nothing to compare"), "{said}");
    let report = fs::read_to_string(output.join("report.md")).unwrap();
    for verdict in ["| passed |", "| missed |", "| failed |"] {
        assert!(report.contains(verdict), "{verdict}: {report}");
    }
    assert!(output.join("good.png").exists() && output.join("missed.png").exists());
}

#[test]
fn a_wrong_file_is_told_before_anything_is_computed() {
    let from = folder("reproduce_wrong");
    copied(&from, "wrong", |text| text.replace("show = \"theory\"", "show = \"theorie\""));
    let output = from.join("out");
    let run = reproduce(&from, &output, &[]);
    assert_eq!(run.status.code(), Some(2));
    let said = error(&run);
    assert!(said.contains("figure.toml:") && said.contains("did you mean `theory`?"), "{said}");
    assert!(!output.exists());
}

/// A sphere between two plates, two springs of 1 kN/m one behind the other; the plate then goes in and comes back, and in
/// another run it goes away.
fn sphere_between_plates(to: &Path) {
    fs::create_dir_all(to.join("springs")).unwrap();
    let file = |name: &str, text: &str| fs::write(to.join("springs").join(name), text).unwrap();
    file(
        "rest.toml",
        r#"
[materials.grain]
density = "2500 kg/m^3"
[materials.plate]
[contacts.grain-plate.normal]
law = "linear"
k = "1 kN/m"
[background]
drag = "0.1 kg/s"
[[particles]]
material = "grain"
radius = { distribution = "fixed", value = "1 mm" }
arrangement = { kind = "list", positions = [["0.995 mm", "0 mm", "0 mm"]] }
[box]
lower = ["0 mm", "-1 mm", "-1 mm"]
upper = ["1.99 mm", "1 mm", "1 mm"]
material = "plate"
open = ["y-low", "y-high", "z-low", "z-high"]
[[stages]]
name = "rest"
until = { time = "1 ms" }
[output]
plots = false
"#,
    );
    let output = "[output]\ntimeseries = { interval = \"0.1 ms\" }\nplots = false\nclusters = true\n\
                  dimensionless = { length = \"1 mm\", stiffness = \"1 kN/m\" }\n";
    let cycles = "start_from = { run = \"rest-run\" }\n[[stages]]\nname = \"cycles\"\nwalls.x-high = { control = \"cosine\", \
                  displacement = [\"-5 um\", \"0 mm\", \"0 mm\"], period = \"40 ms\", cycles = 2 }\n";
    file("cycles.toml", &format!("{cycles}{output}"));
    let away = "start_from = { run = \"rest-run\" }\n[[stages]]\nname = \"away\"\nuntil = { time = \"5 ms\" }\n\
                walls.x-high = { control = \"velocity\", velocity = [\"10 mm/s\", \"0 m/s\", \"0 m/s\"] }\n";
    file("away.toml", &format!("{away}{output}"));
    file("figure.toml", include_str!("springs.toml"));
}

#[test]
fn runs_that_start_from_one_another_show_the_features_that_springs_have() {
    let from = folder("reproduce_runs");
    sphere_between_plates(&from);
    let output = from.join("out");
    let first = reproduce(&from, &output, &[]);
    assert_eq!(first.status.code(), Some(0), "{}", error(&first));
    assert!(error(&first).contains("8 of 9 features seen"), "{}", error(&first));
    let report = fs::read_to_string(output.join("report.md")).unwrap();
    assert!(
        report.contains("| soft | hard | mean | spread | standard error |")
            && report.contains("not seen: springs do not"),
        "{report}"
    );
    assert!(output.join("runs/springs/hard/cycles/timeseries.csv").exists());

    // The closed form y = x of the second panel, from its start to the last row.
    let points: Vec<[f64; 2]> = fs::read_to_string(output.join("springs.csv"))
        .unwrap()
        .lines()
        .filter(|line| line.contains(",y = x,"))
        .map(|line| {
            let numbers: Vec<f64> = line.rsplit(',').take(2).map(|cell| cell.parse().unwrap()).collect();
            [numbers[1], numbers[0]]
        })
        .collect();
    assert!(points.len() > 100 && (points[points.len() - 1][0] - 6e-3).abs() < 1e-5, "{}", points.len());
    assert!(points[0][0] == 1e-3 && points.iter().all(|[x, y]| (y / x - 1.0).abs() < 1e-12));

    // What is there already is taken if it is asked for, and gives the same.
    let table = fs::read(output.join("springs.csv")).unwrap();
    let mut again = Command::new(env!("CARGO_BIN_EXE_pulvis"));
    again.args(["reproduce", "--force", "--reuse"]).arg("--from").arg(&from).arg("--output").arg(&output);
    let again = again.output().unwrap();
    assert_eq!(error(&again).matches("was there").count(), 5, "{}", error(&again));
    assert_eq!(fs::read(output.join("springs.csv")).unwrap(), table);

    // A feature that is not as it has to be fails the figure.
    let file = from.join("springs/figure.toml");
    let wrong = fs::read_to_string(&file).unwrap().replace("least = 0.999\n", "least = 1.001\n");
    fs::write(&file, wrong).unwrap();
    let missed = reproduce(&from, &from.join("missed"), &[]);
    assert_eq!(missed.status.code(), Some(1));
    assert!(error(&missed).contains("missed: F2 R²"), "{}", error(&missed));

    // A column that no run has is told before anything is run.
    let wrong = fs::read_to_string(&file).unwrap().replace("y = \"spans_x\"", "y = \"spans\"");
    fs::write(&file, wrong).unwrap();
    let unknown = reproduce(&from, &from.join("unknown"), &[]);
    assert_eq!(unknown.status.code(), Some(1));
    assert!(error(&unknown).contains("has no column `spans`"), "{}", error(&unknown));
    assert!(!from.join("unknown/runs").exists());
}
