//! A contact on a prescribed path.

use super::{Outcome, column, document, words};
use pulvis_input::probe::ProbeScenario;
use pulvis_lab::probe::{ProbeCurve, ProbeSample, probe};
use serde_json::{Value, json};

/// More than a curve on a screen needs.
const MOST_POINTS: usize = 100_000;

/// All curves of a scenario.
pub(super) fn answer(text: &str) -> Outcome {
    let scenario = ProbeScenario::from_document(&document(text)?).map_err(words)?;
    let points = scenario.path.legs() * scenario.path.points as usize * scenario.contacts.len();
    if points > MOST_POINTS {
        return Err(format!("the path has {points} points; the laboratory draws at most {MOST_POINTS}"));
    }
    let curves = probe(&scenario).map_err(|error| error.to_string())?;
    Ok(json!({ "curves": curves.iter().map(curve).collect::<Value>() }))
}

fn curve(curve: &ProbeCurve) -> Value {
    let of = |value: fn(&ProbeSample) -> f64| column(&curve.samples, value);
    json!({
        "label": curve.label,
        "leg": of(|sample| sample.leg),
        "overlap": of(|sample| sample.overlap),
        "force": of(|sample| sample.force),
        "shear": of(|sample| sample.shear),
        "shear_force": of(|sample| sample.shear_force),
        "roll": of(|sample| sample.roll),
        "roll_torque": of(|sample| sample.roll_torque),
        "twist": of(|sample| sample.twist),
        "twist_torque": of(|sample| sample.twist_torque),
        "stored_energy": of(|sample| sample.stored_energy),
        "dissipated": of(|sample| sample.dissipated),
        "work": of(|sample| sample.work),
        "branch": curve.samples.iter().map(|sample| sample.branch).collect::<Value>(),
    })
}
