//! Every file in `tests/bad` ends with the messages that it must cause.
//!
//! A line `#^ 3:10: contact.normal.kp: ...` is the first line of one message without `error: <file>:`;
//! several mistakes are several such lines, in the order of the file, missing keys after the unknown ones of
//! their table. Changing a message shows up in review. Files `collision_*` are scenarios of pair
//! collisions, files `probe_*` of probes, all others of runs. Each folder of `tests/bad_figures` is a figure whose
//! `figure.toml` ends in the same way, and each file of `tests/bad_studies` is a study that does.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_input::collision::CollisionScenario;
use pulvis_input::figure::FigureScenario;
use pulvis_input::probe::ProbeScenario;
use pulvis_input::study::Study;
use pulvis_input::{Document, InputErrors, Problem, Scenario};
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad")
}

fn files() -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    paths
}

fn load(path: &Path) -> Result<(), InputErrors> {
    let name = path.file_name().unwrap().to_string_lossy();
    if name.starts_with("collision_") {
        CollisionScenario::load(path, &[]).map(|_| ())
    } else if name.starts_with("probe_") {
        ProbeScenario::load(path, &[]).map(|_| ())
    } else {
        Scenario::load(path).map(|_| ())
    }
}

#[test]
fn every_bad_file_is_refused_with_exactly_its_messages() {
    let mut wrong = String::new();
    let paths = files();
    assert!(paths.len() > 35, "the folder of bad files was not found");
    for path in paths {
        let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
        let expected: Vec<&str> =
            text.lines().filter_map(|line| line.strip_prefix("#^")).map(str::trim).collect();
        let got: Vec<String> = match load(&path) {
            Ok(()) => vec!["accepted".to_owned()],
            // Files that a scenario names are shown with their whole path, which differs by machine.
            Err(errors) => {
                let folder = format!("{}/", folder().display());
                errors.errors().iter().map(|error| error.headline().replace(&folder, "")).collect()
            }
        };
        if expected != got {
            let expected = expected.join("\n  ");
            let got = got.join("\n  ");
            wrong.push_str(&format!("\n{}\n expected\n  {expected}\n got\n  {got}\n", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn every_bad_figure_is_refused_with_exactly_its_messages() {
    let mut wrong = String::new();
    let all = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_figures");
    let mut folders: Vec<PathBuf> = fs::read_dir(&all).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.retain(|folder| folder.is_dir());
    folders.sort();
    assert!(folders.len() >= 6, "the folder of bad figures was not found");
    for folder in folders {
        let text = fs::read_to_string(folder.join("figure.toml")).unwrap();
        let expected: Vec<&str> =
            text.lines().filter_map(|line| line.strip_prefix("#^")).map(str::trim).collect();
        let got: Vec<String> = match FigureScenario::load(&folder) {
            Ok(_) => vec!["accepted".to_owned()],
            Err(errors) => errors.errors().iter().map(|error| error.headline()).collect(),
        };
        if expected != got {
            let (expected, got) = (expected.join("\n  "), got.join("\n  "));
            wrong.push_str(&format!("\n{}\n expected\n  {expected}\n got\n  {got}\n", folder.display()));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn every_bad_study_is_refused_with_exactly_its_messages() {
    let mut wrong = String::new();
    let all = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_studies");
    let mut files: Vec<PathBuf> = fs::read_dir(&all).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.is_file());
    files.sort();
    assert!(files.len() >= 10, "the folder of bad studies was not found");
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let expected: Vec<&str> =
            text.lines().filter_map(|line| line.strip_prefix("#^")).map(str::trim).collect();
        let got: Vec<String> = match Study::load(&file, &|path| Document::load(path)) {
            Ok(_) => vec!["accepted".to_owned()],
            Err(errors) => {
                let folder = format!("{}/", all.display());
                errors.errors().iter().map(|error| error.headline().replace(&folder, "")).collect()
            }
        };
        if expected != got {
            let (expected, got) = (expected.join("\n  "), got.join("\n  "));
            wrong.push_str(&format!("\n{}\n expected\n  {expected}\n got\n  {got}\n", file.display()));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn a_missing_scenario_is_named_with_its_neighbour() {
    let errors = Scenario::load(folder().join("no_stage.toml")).unwrap_err();
    assert!(matches!(errors.errors()[0].problem, Problem::NoSuchFile), "{errors}");
    let help = errors.errors()[0].help.clone().unwrap();
    assert!(help.ends_with("no_stages.toml`?"), "{help}");
}

#[test]
fn a_folder_is_no_scenario() {
    let errors = Scenario::load(folder()).unwrap_err();
    assert!(matches!(errors.errors()[0].problem, Problem::Folder), "{errors}");
}

#[test]
fn a_contradiction_that_a_stage_causes_names_the_stage() {
    let errors = Scenario::load(folder().join("set_contradiction.toml")).unwrap_err();
    let help = errors.errors()[0].help.as_deref();
    assert_eq!(help, Some("this is what [stages.set] of stage \"relax\" leads to"));
}
