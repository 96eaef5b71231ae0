//! Collisions over a range of velocities, and the course of one of them.

use super::parallel::in_parallel;
use super::{column, document, words};
use pulvis_input::collision::{CollisionCase, CollisionScenario, Method};
use pulvis_lab::collision::{
    Collision, Observation, Outcome, Regime, Sample, Sampling, VelocityLimit, closed_form, collide,
    sampling_interval, typical_speed, velocity_limits,
};
use pulvis_math::elementary;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Points of a closed form between two that are computed.
const BETWEEN: usize = 8;

/// A redraw that takes longer is shown as far as it has come.
const PATIENCE: Duration = Duration::from_millis(1500);

/// Steps after which the integration of one collision is given up: strongly damped pairs creep.
pub(super) const MOST_STEPS: u64 = 200_000;

/// How long a pair that stuck is drawn, in sampling intervals: four shortest contact times.
const AFTER_STICKING: f64 = 240.0;

/// All collisions of a scenario, and the course of one of each contact at the `velocity` \[m/s\]. A `quick` answer leaves the
/// collisions out: course and closed forms follow a moving slider, and the rest is asked for when it rests.
pub(super) fn answer(text: &str, velocity: Option<f64>, quick: bool) -> super::Outcome {
    let began = Instant::now();
    let scenario = CollisionScenario::from_document(&document(text)?).map_err(words)?;
    if scenario.cases.iter().any(|case| case.incidence.is_some()) {
        return Err("this file has an angle or spins; expected head-on collisions".to_owned());
    }
    let contact = |number: usize| {
        let cases: Vec<_> = scenario.cases.iter().filter(|case| case.contact_number == number).collect();
        let first = *cases.first()?;
        let mut value = curves(&cases, began, quick);
        value["label"] = json!(scenario.labels.get(number));
        value["method"] = json!(if first.method == Method::Exact { "exact" } else { "engine" });
        value["limits"] = velocity_limits(first).iter().map(limit).collect();
        value["typical_speed"] = json!(typical_speed(first.bodies, &first.contact, &first.surroundings));
        if let Some(velocity) = velocity {
            value["course"] = course(&CollisionCase { value: velocity, velocity, ..first.clone() });
        }
        Some(value)
    };
    let contacts: Value = (0..scenario.labels.len()).filter_map(contact).collect();
    Ok(json!({ "contacts": contacts, "seconds": began.elapsed().as_secs_f64() }))
}

fn limit(limit: &VelocityLimit) -> Value {
    json!({ "symbol": limit.symbol, "meaning": limit.meaning, "velocity": limit.velocity })
}

/// Outcomes over velocity, and the closed form on a finer grid.
fn curves(cases: &[&CollisionCase], began: Instant, quick: bool) -> Value {
    let observation = Observation { most_steps: Some(MOST_STEPS), ..Observation::default() };
    let (mut done, mut failure) = (Vec::new(), None);
    let wanted = if quick { &[] } else { cases };
    for (case, outcome) in wanted.iter().zip(computed(wanted, &observation, began)) {
        match outcome {
            Ok(outcome) => done.push((case.velocity, outcome)),
            Err(why) => failure = Some(why),
        }
    }
    let velocities: Vec<f64> = cases.iter().map(|case| case.velocity).collect();
    let theory: Vec<(f64, f64)> = finer(&velocities)
        .filter_map(|velocity| {
            let case = CollisionCase { value: velocity, velocity, ..(*cases.first()?).clone() };
            Some((velocity, closed_form(&case)?.restitution))
        })
        .collect();
    json!({
        "velocity": column(&done, |(velocity, _)| *velocity),
        "restitution": column(&done, |(_, outcome)| outcome.restitution),
        "overlap_max": column(&done, |(_, outcome)| outcome.overlap_max),
        "contact_duration": column(&done, |(_, outcome)| outcome.contact_duration.unwrap_or(f64::NAN)),
        "sticks": done.iter().map(|(_, outcome)| outcome.regime == Regime::Stick).collect::<Vec<bool>>(),
        "theory": { "velocity": column(&theory, |point| point.0), "restitution": column(&theory, |point| point.1) },
        "failure": failure,
    })
}

/// The outcome of each collision, or why there is none.
pub(super) fn computed(
    cases: &[&CollisionCase],
    observation: &Observation,
    began: Instant,
) -> Vec<Result<Outcome, String>> {
    let one = |case: &CollisionCase| {
        if began.elapsed() > PATIENCE {
            return Err("some of the collisions would take too long".to_owned());
        }
        collide(case, observation).map(|collision| collision.outcome).map_err(|error| error.to_string())
    };
    let lost = || Err("a collision could not be computed".to_owned());
    in_parallel(cases, |case| one(case)).into_iter().map(|outcome| outcome.unwrap_or_else(lost)).collect()
}

/// The velocities, and more between them in equal ratios.
fn finer(velocities: &[f64]) -> impl Iterator<Item = f64> {
    let between = velocities.iter().zip(velocities.iter().skip(1)).flat_map(|(&low, &high)| {
        (0..BETWEEN).map(move |number| low * elementary::powf(high / low, number as f64 / BETWEEN as f64))
    });
    between.chain(velocities.last().copied())
}

/// The course of one collision.
fn course(case: &CollisionCase) -> Value {
    let interval = sampling_interval(case);
    let observation = Observation {
        sampling: Sampling::Every(interval),
        time_after_sticking: if case.method == Method::Exact { AFTER_STICKING * interval } else { 0.0 },
        most_steps: Some(MOST_STEPS),
        ..Observation::default()
    };
    match collide(case, &observation) {
        Ok(collision) => drawn(case, &collision),
        Err(error) => json!({ "failure": error.to_string() }),
    }
}

fn drawn(case: &CollisionCase, collision: &Collision) -> Value {
    let outcome = &collision.outcome;
    let of = |value: fn(&Sample) -> f64| column(&collision.course, value);
    json!({
        "velocity": case.velocity,
        "regime": outcome.regime.name(),
        "restitution": outcome.restitution,
        "theory": closed_form(case).map(|theory| theory.restitution),
        "overlap_max": outcome.overlap_max,
        "overlap_end": outcome.overlap_end,
        "contact_duration": outcome.contact_duration,
        "energy_dissipated": outcome.energy_dissipated,
        "energy_error": outcome.energy_error,
        "time": of(|sample| sample.time),
        "overlap": of(|sample| sample.overlap),
        "force": of(|sample| sample.force),
        "kinetic": of(|sample| sample.kinetic),
        "available": of(|sample| sample.potential_available),
        "attraction": of(|sample| sample.potential_attraction),
        "dissipated": of(|sample| sample.dissipated),
    })
}
