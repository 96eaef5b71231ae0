//! The likely cause of an alarm, in words.

use std::f64::consts::PI;

use pulvis_core::{Alarm, ContactPartner, DeepContact, ParticleId, Simulation};
use pulvis_io::table::significant;

use super::views::{contacts, fastest, name};

/// Digits of numbers.
const DIGITS: usize = 4;

/// Steps in a contact time below which the time step is to blame [1].
const LEAST_STEPS: f64 = 10.0;

/// Overlap over the radius that a speed leads to by itself, from which on the speed is to blame [1].
const BY_SPEED: f64 = 0.1;

/// What has led to an alarm, as far as the state tells. `since` is the step from which on deep contacts were looked for.
pub(in crate::protocol) fn likely_cause(simulation: &Simulation, alarm: &Alarm, since: u64) -> String {
    if alarm.is_lost_rank() {
        return "another process was killed, or its machine or the network went down".to_owned();
    }
    if let Some(deep) = simulation.first_deep_contact() {
        return of_deep_contact(simulation, deep, since);
    }
    let mut evidence = Vec::new();
    let deepest = contacts(simulation).into_iter().next();
    if deepest.as_ref().is_none_or(|contact| contact.relative <= 0.3) {
        evidence.push("no contact beyond 30 % overlap has been found".to_owned());
    }
    if let Some(contact) = deepest {
        let steps = simulation.contact_time(contact.first, contact.second);
        let steps = steps.map_or(String::new(), |time| {
            format!(", with {:.0} steps in its contact time", time / simulation.time_step())
        });
        let (pair, percent) = (pair(simulation, contact.first, contact.second), 100.0 * contact.relative);
        evidence.push(format!("the deepest contact is {pair}, {percent:.1} % of the smaller radius{steps}"));
    }
    let is_of_wall =
        matches!(alarm, Alarm::WallLost { .. } | Alarm::WallTooFast { .. } | Alarm::WallsCrossed { .. });
    if let Some((id, speed)) = fastest(simulation).filter(|_| !is_of_wall) {
        let smallest = simulation.particles().radii().iter().copied().fold(f64::INFINITY, f64::min);
        let way = speed * simulation.time_step() / smallest;
        evidence.push(format!(
            "the fastest particle is {id}: {} m/s, {way:.3} of the smallest radius in a time step",
            significant(speed, DIGITS)
        ));
    }
    evidence.join("; ")
}

fn of_deep_contact(simulation: &Simulation, deep: &DeepContact, since: u64) -> String {
    let pair = pair(simulation, deep.first, deep.second);
    let since = if since > 0 { format!(" (looked for since step {since})") } else { String::new() };
    let steps = deep.contact_time / deep.time_step;
    let DeepContact { overlap, closing_speed, step, time, .. } = deep;
    // A spring is compressed by v/ω; the steepest one gives the least overlap.
    let by_speed = closing_speed * deep.contact_time / (PI * deep.radius);
    let judgement = if steps < LEAST_STEPS {
        "the time step is too long for this contact".to_owned()
    } else if by_speed > BY_SPEED {
        format!(
            "they were too fast for a contact that soft: the speed alone leads to {:.0} % more at least",
            100.0 * by_speed
        )
    } else {
        "the contact is too soft for what presses it, or for the speed at which they met".to_owned()
    };
    format!(
        "the first contact beyond 30 % overlap was {pair} at t = {time:.6e} s (step {step}){since}, {:.0} % of the smaller radius deep, closing at {} m/s; its time step was 1/{steps:.0} of its contact time: {judgement}",
        100.0 * overlap,
        significant(*closing_speed, DIGITS)
    )
}

/// `1734-98`, or `1734 at wall floor`.
fn pair(simulation: &Simulation, first: ParticleId, second: ContactPartner) -> String {
    match second {
        ContactPartner::Particle(other) => format!("{first}-{other}"),
        ContactPartner::Wall(_) => format!("{first} at {}", name(simulation, second)),
    }
}
