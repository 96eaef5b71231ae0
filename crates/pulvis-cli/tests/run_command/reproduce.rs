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
