//! `cargo xtask scenarios`: every scenario of the tests, as a user meets it at the command line.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;
use crate::process::{capture, pulvis, root};

/// Good ones are accepted with exit code 0, bad ones refused with exit code 2 and every message that
/// the file says it must cause.
pub fn run() -> Outcome {
    let pulvis = pulvis()?;
    let tests = root().join("crates/pulvis-input/tests");
    let (good, mut bad) = (files(&tests.join("good"))?, files(&tests.join("bad"))?);
    bad.extend(files(&tests.join("collision/bad"))?);
    bad.extend(files(&tests.join("bad_studies"))?);
    let mut wrong = Vec::new();
    for path in &good {
        let (code, text) = show(&pulvis, path)?;
        if code != Some(0) {
            wrong.push(format!("{}: exit code {code:?}, expected 0\n{text}", path.display()));
        }
    }
    for path in &bad {
        let (code, text) = show(&pulvis, path)?;
        if code != Some(2) {
            wrong.push(format!("{}: exit code {code:?}, expected 2\n{text}", path.display()));
        }
        // Files that a scenario names are shown with their whole path, which differs by machine.
        let folder = path.parent().unwrap_or(path);
        let text = text.replace(&format!("{}/", folder.display()), "");
        for message in messages(path)?.iter().filter(|message| !text.contains(message.as_str())) {
            wrong.push(format!("{}: does not say `{message}`\n{text}", path.display()));
        }
    }
    println!("{} good and {} bad scenarios shown to pulvis", good.len(), bad.len());
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n")) }
}

/// Exit code, and what is printed.
fn show(pulvis: &Path, path: &Path) -> Outcome<(Option<i32>, String)> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let is_in = |folder: &str| path.components().any(|part| part.as_os_str() == folder);
    let in_collisions = is_in("collision");
    let command = match &*name {
        _ if is_in("bad_studies") => "study",
        name if in_collisions || name.starts_with("collision_") => "collide",
        name if name.starts_with("probe_") => "probe",
        _ => "check",
    };
    let output = capture(Command::new(pulvis).arg(command).arg(path))?;
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    Ok((output.status.code(), text))
}

fn files(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

/// The messages that stand behind `#^` in a bad scenario, without their place.
fn messages(path: &Path) -> Outcome<Vec<String>> {
    let text = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let text = String::from_utf8_lossy(&text);
    Ok(text.lines().filter_map(|line| line.strip_prefix("#^")).map(|line| line.trim().to_owned()).collect())
}
