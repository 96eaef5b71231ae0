//! Collisions under an angle, with spin, over a range of angles, and the course of one of them.

use super::collide::{MOST_STEPS, computed};
use super::{column, document, words};
use pulvis_input::collision::{CollisionCase, CollisionScenario, Incidence};
use pulvis_lab::collision::{
    Collision, ObliqueOutcome, ObliqueSample, Observation, Outcome, Regime, Sample, Sampling, collide,
    sampling_interval, typical_speed,
};
use serde_json::{Value, json};
use std::time::Instant;

/// Of the angles, a quick answer has every so-manieth.
const QUICK: usize = 6;

/// A course is drawn for so many sampling intervals, sixteen shortest contact times.
const MOST_SAMPLES: u32 = 1000;

/// All collisions of a scenario, and of each contact the course of the one under the `angle` [rad]. A `quick` answer, which follows a
/// moving slider, leaves most of them out.
pub(super) fn answer(text: &str, angle: Option<f64>, quick: bool) -> super::Outcome {
    let began = Instant::now();
    let scenario = CollisionScenario::from_document(&document(text)?).map_err(words)?;
    if scenario.cases.iter().any(|case| case.incidence.is_none()) {
        return Err("this file has head-on collisions; expected an angle".to_owned());
    }
    let contact = |number: usize| {
        let cases: Vec<_> = scenario.cases.iter().filter(|case| case.contact_number == number).collect();
        let first = *cases.first()?;
        let step = if quick { QUICK } else { 1 };
        let cases: Vec<_> = cases.into_iter().step_by(step).collect();
        let mut value = curves(&cases, began);
        value["label"] = json!(scenario.labels.get(number));
        value["typical_speed"] = json!(typical_speed(first.bodies, &first.contact, &first.surroundings));
        if let Some((angle, incidence)) = angle.zip(first.incidence) {
            let incidence = Some(Incidence { angle, ..incidence });
            value["course"] = course(&CollisionCase { value: angle, incidence, ..first.clone() });
        }
        Some(value)
    };
    let contacts: Value = (0..scenario.labels.len()).filter_map(contact).collect();
    Ok(json!({ "contacts": contacts, "seconds": began.elapsed().as_secs_f64() }))
}

/// Outcomes over the angle.
fn curves(cases: &[&CollisionCase], began: Instant) -> Value {
    let observation = Observation { most_steps: Some(MOST_STEPS), ..Observation::default() };
    let (mut done, mut failure) = (Vec::new(), None);
    for (case, outcome) in cases.iter().zip(computed(cases, &observation, began)) {
        match outcome {
            Ok(outcome) => done.push(((*case).clone(), outcome)),
            Err(why) => failure = Some(why),
        }
    }
    let angle =
        |(case, _): &(CollisionCase, Outcome)| case.incidence.map_or(f64::NAN, |incidence| incidence.angle);
    let of = |value: &dyn Fn(&ObliqueOutcome) -> f64| {
        column(&done, |(_, outcome)| separated(outcome).map_or(f64::NAN, |oblique| value(&oblique)))
    };
    let contact_velocity = |moment: usize| {
        column(&done, |(case, outcome)| {
            separated(outcome)
                .map_or(f64::NAN, |oblique| oblique.contact_velocities[moment] / case.normal_velocity())
        })
    };
    json!({
        "angle": column(&done, angle),
        "restitution": column(&done, |(_, outcome)| outcome.restitution),
        "tangential": of(&|oblique| oblique.restitution_tangential.unwrap_or(f64::NAN)),
        "contact": of(&|oblique| oblique.restitution_contact.unwrap_or(f64::NAN)),
        "impulse_ratio": of(&|oblique| oblique.impulse_ratio),
        "rebound_angle": of(&|oblique| oblique.rebound_angle),
        "before": contact_velocity(0),
        "after": contact_velocity(1),
        "sticks": done.iter().map(|(_, outcome)| outcome.regime == Regime::Stick).collect::<Vec<bool>>(),
        "failure": failure,
    })
}

/// The tangential motion of bodies that separate.
fn separated(outcome: &Outcome) -> Option<ObliqueOutcome> {
    outcome.oblique.filter(|_| outcome.regime == Regime::Rebound)
}

/// The course of one collision.
fn course(case: &CollisionCase) -> Value {
    let interval = sampling_interval(case);
    let times = (0..MOST_SAMPLES).map(|number| f64::from(number) * interval).collect();
    let observation =
        Observation { sampling: Sampling::At(times), most_steps: Some(MOST_STEPS), ..Observation::default() };
    match collide(case, &observation) {
        Ok(collision) => drawn(&collision),
        Err(error) => json!({ "failure": error.to_string() }),
    }
}

fn drawn(collision: &Collision) -> Value {
    let outcome = &collision.outcome;
    let of = |value: fn(&Sample) -> f64| column(&collision.course, value);
    let across = |value: fn(&ObliqueSample) -> f64| {
        column(&collision.course, |sample| sample.oblique.as_ref().map_or(f64::NAN, value))
    };
    let oblique = separated(outcome);
    json!({
        "regime": outcome.regime.name(),
        "restitution": outcome.restitution,
        "tangential": oblique.and_then(|oblique| oblique.restitution_tangential),
        "contact": oblique.and_then(|oblique| oblique.restitution_contact),
        "rebound_angle": oblique.map(|oblique| oblique.rebound_angle),
        "impulse_ratio": oblique.map(|oblique| oblique.impulse_ratio),
        "spins": oblique.map(|oblique| oblique.angular_velocities.map(|spin| spin.z)),
        "overlap_max": outcome.overlap_max,
        "contact_duration": outcome.contact_duration,
        "energy_dissipated": outcome.energy_dissipated,
        "time": of(|sample| sample.time),
        "overlap": of(|sample| sample.overlap),
        "force": of(|sample| sample.force),
        "tangential_force": across(|sample| sample.force),
        "contact_velocity": across(|sample| sample.contact_velocity),
    })
}
