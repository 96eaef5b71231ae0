//! The JSON schemas know the keys that the readers ask for, table by table, and say of each what it means.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_input::collision::CollisionScenario;
use pulvis_input::probe::ProbeScenario;
use pulvis_input::schema::{FileKind, schema};
use pulvis_input::study::Study;
use pulvis_input::{Document, InputErrors, Scenario};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A key that nobody knows.
const UNKNOWN: &str = "zzz_unknown";

/// The text with an unknown key in one of its tables, once for each of them.
fn with_unknown_key(text: &str) -> Vec<String> {
    let mut all = vec![format!("{UNKNOWN} = 1\n{text}")];
    let insert = |at: usize, what: &str| format!("{}{what}{}", &text[..at], &text[at..]);
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        if line.trim_start().starts_with('[') && line.trim_end().ends_with(']') && !line.contains('=') {
            all.push(insert(start + line.len(), &format!("{UNKNOWN} = 1\n")));
        } else if !line.trim_start().starts_with('#') {
            let inline = line.match_indices("{ ").map(|(at, _)| start + at + 1);
            all.extend(inline.map(|at| insert(at, &format!(" {UNKNOWN} = 1,"))));
        }
        start += line.len();
    }
    all
}

/// The table with the unknown key, and the keys that the reader knows there.
fn known_keys(errors: &InputErrors) -> Option<(String, BTreeSet<String>)> {
    let error = errors.errors().iter().find(|error| error.key.ends_with(UNKNOWN))?;
    let known = error.help.as_ref()?.split_once("known keys here: ")?.1;
    let keys = known.split(", ").filter(|key| *key != UNKNOWN).map(str::to_owned);
    Some((error.key.trim_end_matches(UNKNOWN).trim_end_matches('.').to_owned(), keys.collect()))
}

/// The schemas of all variants of what stands at a path.
fn at<'s>(schema: &'s Value, path: &str) -> Vec<&'s Value> {
    let mut candidates = variants(schema);
    for step in path.replace('[', ".[").split('.').filter(|step| !step.is_empty()) {
        let step = step.trim_matches('"');
        let next = |one: &&'s Value| -> Option<&'s Value> {
            if step.starts_with('[') {
                return one.get("items");
            }
            let other = || one.get("additionalProperties").filter(|value| value.is_object());
            one.get("properties").and_then(|keys| keys.get(step)).or_else(other)
        };
        candidates = candidates.iter().filter_map(next).flat_map(variants).collect();
    }
    candidates
}

/// The keys of a table; of one in which a key decides, those of each case.
fn key_sets(table: &Value) -> Vec<BTreeSet<String>> {
    if let Some(cases) = table.get("allOf").and_then(Value::as_array) {
        let names = cases.iter().filter_map(|case| case.pointer("/then/propertyNames/enum")?.as_array());
        return names
            .map(|names| names.iter().filter_map(|name| Some(name.as_str()?.to_owned())).collect())
            .collect();
    }
    let keys = table.get("properties").and_then(Value::as_object);
    keys.map(|keys| keys.keys().cloned().collect()).into_iter().collect()
}

fn variants(schema: &Value) -> Vec<&Value> {
    match schema.get("anyOf").and_then(Value::as_array) {
        Some(all) => all.iter().flat_map(variants).collect(),
        None => vec![schema],
    }
}

/// The path without numbers and names of the user.
fn normalised(path: &str) -> String {
    let own = ["materials", "contacts", "walls"];
    let mut before = "";
    let steps = path.split('.').map(|step| {
        let step = step.split('[').next().unwrap_or_default();
        let shown = if own.contains(&before) { "NAME" } else { step };
        before = step;
        shown
    });
    steps.collect::<Vec<_>>().join(".")
}

/// Holds every table of the files against the schema; answers with the tables that were compared.
fn compare(
    kind: FileKind,
    files: &[PathBuf],
    read: &dyn Fn(&Path, &str) -> Result<(), InputErrors>,
) -> BTreeMap<String, usize> {
    let schema = schema(kind);
    let mut compared = BTreeMap::new();
    for file in files {
        let text = std::fs::read_to_string(file).unwrap();
        for changed in with_unknown_key(&text) {
            let Err(errors) = read(file, &changed) else { continue };
            let Some((path, known)) = known_keys(&errors) else { continue };
            let found: Vec<BTreeSet<String>> = at(&schema, &path).into_iter().flat_map(key_sets).collect();
            // Quantities of bodies are asked for by laws that read them: an editor cannot know which.
            let of_bodies = ["charge", "shell_thickness"].map(str::to_owned);
            let with_bodies: BTreeSet<String> = known.iter().cloned().chain(of_bodies).collect();
            assert!(
                found.contains(&known) || found.contains(&with_bodies),
                "{}: [{path}] knows {known:?}, and its schema {found:?}",
                file.display()
            );
            *compared.entry(normalised(&path)).or_insert(0) += 1;
        }
    }
    compared
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn files_below(folder: &str, is_wanted: &dyn Fn(&Path) -> bool) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "toml") && is_wanted(&path) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

fn begins(path: &Path, table: &str) -> bool {
    std::fs::read_to_string(path).unwrap().lines().any(|line| line.trim() == table)
}

#[test]
fn the_schema_of_scenarios_has_the_keys_of_the_reader_in_every_table() {
    let mut files = files_below("crates/pulvis-input/tests/good", &|_| true);
    files.extend(files_below("crates/pulvis-cli/templates", &|path| begins(path, "[[stages]]")));
    let read = |file: &Path, text: &str| {
        Scenario::from_document(&Document::from_str(&file.display().to_string(), text)?, Some(file)).map(drop)
    };
    let compared = compare(FileKind::Scenario, &files, &read);
    assert!(compared.len() >= 35, "{compared:?}");
    let bonds = compared.keys().any(|path| path.ends_with("bond"));
    assert!(compared.contains_key("output.files.region") && bonds, "{compared:?}");
}

#[test]
fn the_schemas_of_collisions_probes_and_studies_have_the_keys_of_their_readers() {
    let laws = |table: &'static str| files_below("docs/book/src/laws", &move |path| begins(path, table));
    let collide = |file: &Path, text: &str| {
        CollisionScenario::from_document(&Document::from_str(&file.display().to_string(), text)?).map(drop)
    };
    let mut collisions = laws("[collision]");
    collisions.extend(files_below("crates/pulvis-cli/templates", &|path| begins(path, "[collision]")));
    assert!(compare(FileKind::Collision, &collisions, &collide).len() >= 4);
    let probe = |file: &Path, text: &str| {
        ProbeScenario::from_document(&Document::from_str(&file.display().to_string(), text)?).map(drop)
    };
    let probed = compare(FileKind::Probe, &laws("[probe]"), &probe);
    // The root, the path, the contact, and a table of each role.
    assert!(probed.len() >= 8, "{probed:?}");
    let study = |file: &Path, text: &str| {
        let document = Document::from_str(&file.display().to_string(), text)?;
        Study::from_document(&document, file, &|path| Document::load(path)).map(drop)
    };
    let studies = files_below("experiments", &|path| begins(path, "[study]"));
    let compared = compare(FileKind::Study, &studies, &study);
    assert!(compared.len() >= 4, "{compared:?}");
}

/// Keys whose names say all: components, faces.
fn speaks_for_itself(key: &str) -> bool {
    ["xx", "yy", "zz", "xy", "xz", "yz", "isotropic"].contains(&key)
        || key.ends_with("-low")
        || key.ends_with("-high")
}

fn without_words(schema: &Value, path: &str, silent: &mut Vec<String>) {
    if let Some(keys) = schema.get("properties").and_then(Value::as_object) {
        for (key, value) in keys {
            let words = value.get("description").and_then(Value::as_str).unwrap_or_default();
            if words.trim().is_empty() && !speaks_for_itself(key) {
                silent.push(format!("{path}.{key}"));
            }
            without_words(value, &format!("{path}.{key}"), silent);
        }
    }
    for part in ["items", "additionalProperties"] {
        schema.get(part).into_iter().for_each(|inner| without_words(inner, &format!("{path}.*"), silent));
    }
    for variant in schema.get("anyOf").and_then(Value::as_array).into_iter().flatten() {
        without_words(variant, path, silent);
    }
}

#[test]
fn every_key_of_every_schema_has_a_hover_text() {
    for (name, kind) in FileKind::ALL {
        let mut silent = Vec::new();
        without_words(&schema(kind), name, &mut silent);
        assert!(silent.is_empty(), "without a text: {silent:?}");
    }
    let scenario = schema(FileKind::Scenario);
    let words = at(&scenario, "materials.grain.density")[0]["description"].as_str().unwrap();
    assert!(words.starts_with("mass density; required if") && words.contains("[kg/m^3]"), "{words}");
}
