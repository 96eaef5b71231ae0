//! `pulvis new`: every template is accepted by its command, and nothing is written over.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn pulvis(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pulvis")).current_dir(folder).args(arguments).output().unwrap()
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("new-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Names of the templates and their commands, as the program lists them.
fn listed(folder: &Path) -> Vec<[String; 2]> {
    let output = pulvis(folder, &["new", "--list"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let rows = text(&output.stdout);
    let words = |row: &str| {
        let mut words = row.split_whitespace().map(str::to_owned);
        [words.next().unwrap(), words.next().unwrap()]
    };
    rows.lines().skip(1).map(words).collect()
}

#[test]
fn every_template_is_accepted_by_its_command() {
    let folder = folder("all");
    let templates = listed(&folder);
    assert_eq!(
        templates.len(),
        fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("templates")).unwrap().count()
    );
    for [name, command] in templates {
        let file = format!("my-{name}.toml");
        let written = pulvis(&folder, &["new", &format!("my-{name}"), "--from", &name]);
        assert_eq!(written.status.code(), Some(0), "{name}: {}", text(&written.stderr));
        assert!(text(&written.stdout).contains(&file), "{}", text(&written.stdout));
        assert!(!fs::read_to_string(folder.join(&file)).unwrap().contains("NAME"), "{name}");
        // `check` reads scenarios of runs alone; the others end within a second.
        let command = if command == "run" { "check" } else { &command };
        let tried = pulvis(&folder, &[command, &file]);
        assert_eq!(tried.status.code(), Some(0), "{name}: {}", text(&tried.stderr));
        assert!(!text(&tried.stdout).contains("warning"), "{name}: {}", text(&tried.stdout));
    }
}

#[test]
fn a_file_that_exists_is_kept() {
    let folder = folder("kept");
    fs::write(folder.join("mine.toml"), "mine").unwrap();
    for name in ["mine", "mine.toml"] {
        let output = pulvis(&folder, &["new", name]);
        assert_eq!(output.status.code(), Some(2));
        let expected = "error: mine.toml: exists already and is kept; choose another name\n";
        assert_eq!(text(&output.stderr), expected);
    }
    assert_eq!(fs::read_to_string(folder.join("mine.toml")).unwrap(), "mine");
    // A folder that is not there, and a template that is none.
    let nowhere = pulvis(&folder, &["new", "no/such"]);
    assert_eq!(nowhere.status.code(), Some(2));
    assert!(
        text(&nowhere.stderr).starts_with("error: no/such.toml: cannot be written: "),
        "{}",
        text(&nowhere.stderr)
    );
    let unknown = pulvis(&folder, &["new", "x", "--from", "castle"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("invalid value 'castle'"), "{}", text(&unknown.stderr));
    assert!(!folder.join("x.toml").exists());
}
