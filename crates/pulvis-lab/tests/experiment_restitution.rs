//! The experiment `restitution` gives what its `expected.toml` says.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_input::collision::{CollisionCase, CollisionScenario};
use pulvis_input::{Dimension, Document, Reported, TableReader};
use pulvis_lab::collision::{Observation, Outcome, Regime, collide, sweep};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../experiments/restitution");

struct Expected {
    tolerance: f64,
    plastic_limit: f64,
    sticks: [f64; 2],
    /// chi, restitution, overlap_max, overlap_end
    points: Vec<(f64, f64, f64, Option<f64>)>,
}

fn expected(mut root: TableReader<'_>) -> Result<Expected, Reported> {
    let number = Dimension::NONE;
    let tolerance = root.required("tolerance", number)?;
    let plastic_limit = root.required("plastic_limit", Dimension::LENGTH)?;
    let sticks = [root.required("sticks_from", number)?, root.required("sticks_up_to", number)?];
    let mut points = Vec::new();
    for mut table in root.tables("points")? {
        let mut required = |key| table.required(key, number);
        let (chi, restitution, overlap_max) =
            (required("chi")?, required("restitution")?, required("overlap_max")?);
        points.push((chi, restitution, overlap_max, table.optional("overlap_end", number)?));
        table.finish();
    }
    root.finish();
    Ok(Expected { tolerance, plastic_limit, sticks, points })
}

fn files() -> (CollisionScenario, Expected) {
    let scenario = CollisionScenario::load(format!("{FOLDER}/experiment.toml"), &[]).unwrap();
    let expected = Document::load(format!("{FOLDER}/expected.toml")).unwrap().read(expected).unwrap();
    (scenario, expected)
}

fn at(scenario: &CollisionScenario, chi: f64) -> Outcome {
    let first = &scenario.cases[0];
    let case = CollisionCase { velocity: first.velocity * chi / first.value, ..first.clone() };
    collide(&case, &Observation::default()).unwrap().outcome
}

#[test]
fn every_expected_number_is_met() {
    let (scenario, expected) = files();
    assert_eq!(expected.points.len(), 6);
    for &(chi, restitution, overlap_max, overlap_end) in &expected.points {
        let outcome = at(&scenario, chi);
        let near = |got: f64, value: f64| (got - value).abs() <= expected.tolerance * value.abs();
        assert!(near(outcome.restitution, restitution), "e({chi}) = {}", outcome.restitution);
        let scaled = outcome.overlap_max / expected.plastic_limit;
        assert!(near(scaled, overlap_max), "largest overlap at {chi}: {scaled}");
        assert_eq!(outcome.regime == Regime::Stick, overlap_end.is_some(), "at {chi}");
        if let Some(overlap_end) = overlap_end {
            let scaled = outcome.overlap_end / expected.plastic_limit;
            assert!(near(scaled, overlap_end), "sticking overlap at {chi}: {scaled}");
        }
    }
}

#[test]
fn the_pair_sticks_exactly_between_the_expected_limits() {
    let (scenario, expected) = files();
    // The limits are given with 12 digits.
    let [from, up_to] = expected.sticks;
    for (chi, regime) in [
        (from * (1.0 - 1e-9), Regime::Rebound),
        (from * (1.0 + 1e-9), Regime::Stick),
        (up_to * (1.0 - 1e-9), Regime::Stick),
        (up_to * (1.0 + 1e-9), Regime::Rebound),
    ] {
        assert_eq!(at(&scenario, chi).regime, regime, "at {chi:.12}");
    }
}

#[test]
fn the_whole_sweep_agrees_with_theory() {
    let (scenario, expected) = files();
    let points = sweep(&scenario, false).unwrap();
    assert_eq!(points.len(), 63);
    for point in points {
        let theory = point.theory.unwrap();
        let (got, value) = (point.collision.outcome.restitution, theory.restitution);
        let near = (got - value).abs() <= expected.tolerance * value;
        // At χ = 1/2, where the pair begins to stick, theory too leaves but the root of its round-off.
        let both_are_round_off = got.max(value) < 1e-7;
        assert!(near || both_are_round_off, "{}: {got} for {value}", point.case.value);
    }
}
