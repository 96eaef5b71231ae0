//! Scenarios of probes.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_contact::Normal;
use pulvis_contact::catalogue::Role;
use pulvis_input::Document;
use pulvis_input::probe::ProbeScenario;

fn read(text: &str) -> ProbeScenario {
    let document = Document::from_str("probe.toml", text).unwrap();
    ProbeScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The example of the issue, with laws to compare.
const EXAMPLE: &str = r#"
[probe]
bodies = "pair"
radius = ["1 um", "2 um"]
density = ["2000 kg/m^3", "2000 kg/m^3"]
overlap = ["-5 nm", "20 nm", "5 nm", "15 nm", "-10 nm"]
shear = ["0 m", "0 m", "2 nm", "-2 nm", "0 m"]
points = 200
speed = "0 m/s"
[contact]
label = "stiff"
[contact.normal]
law = "hertz"
effective_modulus = "1 GPa"
[contact.sliding]
law = "spring-slider"
kt = "10 N/m"
mu = 0.3
[contact.conventions]
lever_arm = "radius"
[[compare]]
normal = { law = "linear", k = "10 N/m" }
[[compare]]
sliding = { law = "none" }
normal = { law = "jkr", effective_modulus = "1 GPa", work_of_adhesion = "0.1 N/m" }
"#;

#[test]
fn what_a_compared_contact_leaves_out_is_that_of_the_contact() {
    let scenario = read(EXAMPLE);
    let labels: Vec<&str> = scenario.contacts.iter().map(|contact| contact.label.as_str()).collect();
    assert_eq!(labels, ["stiff", "linear", "jkr + none"]);
    let [stiff, linear, jkr] = scenario.contacts.as_slice() else { panic!("three contacts") };
    let (stiff, linear, jkr) = (&stiff.contact, &linear.contact, &jkr.contact);
    assert!(matches!(linear.model.normal, Normal::Linear(_)));
    assert_eq!(linear.model.laws, stiff.model.laws);
    assert!(stiff.model.laws.sliding.is_some() && jkr.model.laws.sliding.is_none());
    assert_eq!(jkr.model.laws.conventions, stiff.model.laws.conventions);
    assert_eq!(jkr.laws.iter().map(|law| law.role).collect::<Vec<_>>(), Role::ALL);
}

#[test]
fn the_path_has_its_turning_points_and_an_infinitely_slow_one_has_no_times() {
    let path = read(EXAMPLE).path;
    assert_eq!(path.legs(), 4);
    assert_eq!(path.poses[2], [5e-9, 2e-9, 0.0, 0.0]);
    assert_eq!(path.prescribed, [true, true, false, false]);
    assert_eq!((path.durations, path.points), (None, 200));
    let path = read(&EXAMPLE.replace("speed = \"0 m/s\"", "speed = \"5 nm/s\"")).path;
    let durations = path.durations.unwrap();
    for (got, expected) in durations.iter().zip([5.0, 3.0, 2.0, 5.0]) {
        // A difference of two numbers with a rounding each.
        assert!((got / expected - 1.0_f64).abs() < 1e-14, "{got}");
    }
}

#[test]
fn the_example_of_the_book_is_a_probe() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/book/src/probe.md");
    let book = std::fs::read_to_string(path).unwrap();
    let (_, rest) = book.split_once("```toml\n").unwrap();
    let (example, _) = rest.split_once("```").unwrap();
    assert_eq!(read(example).contacts.len(), 2);
}
