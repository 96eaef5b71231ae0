//! `docs/scenario.md` describes every key of a scenario, and its example is one; so is that of `docs/study.md` a study.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_input::study::Study;
use pulvis_input::{Document, Scenario};
use std::collections::BTreeSet;
use std::path::Path;

fn manual() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scenario.md");
    std::fs::read_to_string(path).unwrap()
}

fn good_files() -> Vec<Scenario> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/good");
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let scenarios = paths.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    scenarios.map(|path| Scenario::load(path).unwrap()).collect()
}

#[test]
fn the_example_of_the_manual_is_a_scenario() {
    let manual = manual();
    let (_, rest) = manual.split_once("```toml\n").unwrap();
    let (example, _) = rest.split_once("```").unwrap();
    if let Err(errors) = Scenario::from_str("docs/scenario.md", example) {
        panic!("{errors}");
    }
}

#[test]
fn the_example_of_the_manual_of_studies_is_a_study() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let manual = std::fs::read_to_string(root.join("docs/study.md")).unwrap();
    let (_, rest) = manual.split_once("```toml\n").unwrap();
    let (example, _) = rest.split_once("```").unwrap();
    let document = Document::from_str("docs/study.md", example).unwrap();
    let file = root.join("experiments/study-friction/study.toml");
    let study = Study::from_document(&document, &file, &|path| Document::load(path))
        .unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((study.points.len(), study.seeds.len(), study.measures.len()), (5, 4, 2));
}

/// Resolved scenarios write every key out. Names of the user and parameters of laws are left aside:
/// the latter are described by the catalogue.
#[test]
fn the_manual_describes_every_key() {
    let manual = manual();
    let mut keys = BTreeSet::new();
    for scenario in good_files() {
        let mut described = true;
        for line in scenario.to_resolved_toml("0").lines() {
            if let Some(table) = line.strip_prefix('[') {
                described =
                    !["contacts.", "stages.set", "stages.programs", "box.materials", "particles.columns"]
                        .iter()
                        .any(|own| table.starts_with(own));
            } else if let Some((key, value)) = line.split_once(" = ").filter(|_| described) {
                keys.insert(key.to_owned());
                let inner = value.strip_prefix("{ ").into_iter().flat_map(|inner| inner.split(", "));
                keys.extend(inner.filter_map(|pair| pair.split_once(" = ")).map(|(key, _)| key.to_owned()));
            }
        }
    }
    assert!(keys.len() >= 60, "only {} keys were found: {keys:?}", keys.len());
    let describes = |key: &str| {
        ["`", "{ ", ", "].iter().any(|before| {
            let at = |end: &str| manual.contains(&format!("{before}{key}{end}"));
            at("`") || at(" = ")
        })
    };
    let missing: Vec<&String> = keys.iter().filter(|key| !describes(key)).collect();
    assert!(missing.is_empty(), "docs/scenario.md does not describe {missing:?}");
}
