//! Every file in `tests/collision/bad` ends with the messages that it must cause.
//!
//! A line `#^ 3:10: contact.normal.kp: ...` is the first line of one message without `error: <file>:`;
//! several mistakes are several such lines, in the order of the file.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_input::collision::{Bodies, CollisionScenario, Method, SweptVariable};
use pulvis_input::{Document, Replacement};
use std::fs;
use std::path::{Path, PathBuf};

fn bad_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/collision/bad");
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_bad_collision_is_refused_with_exactly_its_messages() {
    let mut wrong = String::new();
    let paths = bad_files();
    assert!(paths.len() >= 30, "{} files", paths.len());
    for path in paths {
        let text = fs::read_to_string(&path).unwrap();
        let expected: Vec<_> = text.lines().filter_map(|line| line.strip_prefix("#^ ")).collect();
        let got = match CollisionScenario::load(&path, &[]) {
            Ok(scenario) => vec![format!("accepted: {scenario:?}")],
            Err(errors) => errors.errors().iter().map(|error| error.headline()).collect(),
        };
        if expected != got {
            let (expected, got) = (expected.join("\n  "), got.join("\n  "));
            wrong.push_str(&format!("\n{}\n expected\n  {expected}\n got\n  {got}\n", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

const PAIR: &str = r#"
[collision]
bodies = "pair"
radius = ["1.1 mm", "0.7 mm"]
density = ["2000 kg/m^3", "2500 kg/m^3"]
method = "engine"
[collision.sweep]
variable = "velocity"
from = "1 cm/s"
to = 1
points = 3
spacing = "log"
[contact.normal]
law = "luding"
k1 = "100 N/m"
kp = "500 N/m"
kc = "100 N/m"
phi_f = 0.05
"#;

#[test]
fn units_defaults_and_logarithmic_spacing_are_read() {
    let scenario = CollisionScenario::from_document(&Document::from_str("a.toml", PAIR).unwrap()).unwrap();
    assert_eq!(scenario.variable, SweptVariable::Velocity);
    let velocities: Vec<_> = scenario.cases.iter().map(|case| case.velocity).collect();
    assert_eq!(velocities[0], 0.01);
    assert!((velocities[1] - 0.1).abs() < 1e-16, "the geometric mean, to round-off");
    assert_eq!(velocities[2], 1.0);
    assert_eq!(scenario.cases[0].method, Method::Engine { steps_per_contact: 50.0 });
    let Bodies::Pair([i, j]) = scenario.cases[0].bodies else { panic!("a pair") };
    assert_eq!((i.radius, j.radius), (1.1e-3, 0.7e-3));
    // 4/3 π a³ ρ, by hand.
    assert!((i.mass / 1.115_055_952_514_137_5e-5 - 1.0).abs() < 1e-14);
}

#[test]
fn values_can_be_replaced_from_outside() {
    let document = Document::from_str("a.toml", PAIR).unwrap();
    let replaced = document.with_override("contact.normal.kc", Replacement::parse("0.2 kN/m")).unwrap();
    let scenario = CollisionScenario::from_document(&replaced).unwrap();
    let before = CollisionScenario::from_document(&document).unwrap();
    assert_ne!(scenario.cases[0].contact, before.cases[0].contact);
}

/// Both examples of the book: the first is head on, the second under an angle.
#[test]
fn the_examples_of_the_book_are_collisions() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/book/src/collisions.md");
    let book = fs::read_to_string(path).unwrap();
    let examples: Vec<&str> =
        book.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
    let read = |text: &str| CollisionScenario::from_document(&Document::from_str("book", text).unwrap());
    let scenarios: Vec<_> =
        examples.iter().map(|text| read(text).unwrap_or_else(|errors| panic!("{errors}"))).collect();
    let [head_on, oblique] = scenarios.as_slice() else { panic!("two examples") };
    assert!(head_on.cases.iter().all(|case| case.incidence.is_none()));
    assert_eq!(oblique.labels, ["hertz + mindlin", "rough"]);
    let [smooth, rough] = oblique.cases.as_slice() else { panic!("one collision of each contact") };
    assert_eq!(smooth.incidence, rough.incidence);
    assert_eq!(smooth.incidence.unwrap().spins, [[0.0, 0.0, 100.0], [0.0; 3]]);
    assert_eq!(smooth.method, Method::Engine { steps_per_contact: 2000.0 });
    assert!((smooth.normal_velocity() / 3.9 - 0.75_f64.sqrt()).abs() < 1e-15);
}
