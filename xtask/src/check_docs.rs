//! `cargo xtask check-docs`: documents that name what exists, files that can be read in one sitting.

use std::path::Path;

use crate::Outcome;
use crate::process::{root, text};

/// Lines of a source file beyond which it has more than one subject.
const LONGEST: usize = 400;

/// Documents whose paths must exist.
const WITH_PATHS: [&str; 3] = ["ARCHITECTURE.md", "README.md", "CONTRIBUTING.md"];

/// First components of the paths that documents name.
const FOLDERS: [&str; 9] =
    ["benchmarks/", "crates/", "docs/", "experiments/", "python/", "scripts/", "xtask/", ".ci/", ".cargo/"];

/// Checks everything and reports every finding.
pub fn run() -> Outcome {
    let mut wrong = Vec::new();
    for document in WITH_PATHS {
        wrong.extend(missing_paths(document)?);
    }
    wrong.extend(missing_tests()?);
    let files = tracked()?;
    for file in &files {
        let Ok(text) = std::fs::read_to_string(root().join(file)) else { continue };
        wrong.extend(machine_paths(file, &text));
        wrong.extend(broken_links(file, &text));
        let lines = text.lines().count();
        if file.ends_with(".rs") && lines > LONGEST {
            println!("note: {file} has {lines} lines, more than {LONGEST}");
        }
    }
    println!("{} files looked at", files.len());
    if wrong.is_empty() { Ok(()) } else { Err(format!("\n  {}", wrong.join("\n  "))) }
}

/// The files that git knows; without git, those of the documents.
fn tracked() -> Outcome<Vec<String>> {
    let mut git = std::process::Command::new("git");
    git.args(["ls-files"]).current_dir(root());
    match text(&mut git) {
        Ok(list) => Ok(list.lines().map(str::to_owned).collect()),
        Err(_) => {
            println!("skipped: git does not answer here, only {} are looked at", WITH_PATHS.join(", "));
            Ok(WITH_PATHS.map(str::to_owned).into())
        }
    }
}

/// Paths in backquotes that lead nowhere. A `<name>` or `NAME` in a path stands for many.
fn missing_paths(document: &str) -> Outcome<Vec<String>> {
    let text =
        std::fs::read_to_string(root().join(document)).map_err(|error| format!("{document}: {error}"))?;
    let quoted = text.split('`').skip(1).step_by(2);
    let paths = quoted.filter(|word| FOLDERS.iter().any(|folder| word.starts_with(folder)));
    let fixed = paths.filter(|path| !path.contains(['<', '*', ' ', 'N', '\n']));
    let missing = fixed.filter(|path| !root().join(path).exists());
    Ok(missing.map(|path| format!("{document} names `{path}`, which does not exist")).collect())
}

/// The document that names a test for each promise.
const PROMISES: &str = "docs/book/src/promises.md";

/// Tests that the promises name behind the file in which they are, and that are not there.
fn missing_tests() -> Outcome<Vec<String>> {
    let read =
        |file: &str| std::fs::read_to_string(root().join(file)).map_err(|error| format!("{file}: {error}"));
    let (mut missing, mut found) = (Vec::new(), 0);
    for line in read(PROMISES)?.lines().filter(|line| line.starts_with('|')) {
        let mut source = None;
        for word in line.split('`').skip(1).step_by(2) {
            if word.starts_with("crates/") {
                source = Some((word, read(word)?));
            } else if let Some((file, text)) = source.as_ref().filter(|_| is_test_name(word)) {
                found += 1;
                if !text.contains(&format!("fn {word}(")) {
                    missing.push(format!("{PROMISES} names the test `{word}`, which is not in {file}"));
                }
            }
        }
    }
    if found < 20 {
        missing.push(format!("{PROMISES}: only {found} tests were found"));
    }
    Ok(missing)
}

/// Names of tests are sentences.
fn is_test_name(word: &str) -> bool {
    word.matches('_').count() >= 3 && word.bytes().all(|byte| byte == b'_' || byte.is_ascii_alphanumeric())
}

/// Paths that exist on one machine only.
fn machine_paths(file: &str, text: &str) -> Vec<String> {
    // Put together here, so that this file does not find itself.
    let roots = ["home", "root", "work", "Users"].map(|folder| format!("/{folder}/"));
    let starts = |line: &str, at: usize| {
        line[..at].chars().next_back().is_none_or(|before| " \"'`(=:".contains(before))
    };
    let names = |line: &str| {
        roots.iter().any(|path| line.match_indices(path.as_str()).any(|(at, _)| starts(line, at)))
    };
    let hits = text.lines().enumerate().filter(|(_, line)| names(line));
    hits.map(|(number, _)| format!("{file}:{}: a path of a single machine", number + 1)).collect()
}

/// Relative links of Markdown files that lead nowhere.
fn broken_links(file: &str, text: &str) -> Vec<String> {
    if !file.ends_with(".md") {
        return Vec::new();
    }
    let folder = root().join(file).parent().map(Path::to_path_buf).unwrap_or_default();
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let local = targets.map(|target| target.split('#').next().unwrap_or_default());
    let missing =
        local.filter(|target| !target.is_empty() && !target.contains("://") && !folder.join(target).exists());
    missing.map(|target| format!("{file} links to {target}, which does not exist")).collect()
}
