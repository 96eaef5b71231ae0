//! In what regime a stage will be, in words.

use std::fmt::Write;

use pulvis_lab::protocol::{Cause, ContactRegime, StageRegime};

/// p* up to which a packing is as good as rigid, and beyond which pair contacts no longer hold.
const RIGID: f64 = 1e-3;
const SOFTEST: f64 = 5e-2;

/// I from which flows are those of a gas.
const GAS_LIKE: f64 = 0.3;

/// t_c f_E below which collisions are those of pairs.
const PAIRS: f64 = 1e-2;

/// Appends the lines of `pulvis check`.
// Writing to a String cannot fail.
pub fn describe_regimes(text: &mut String, regimes: &[StageRegime]) {
    for (number, regime) in regimes.iter().enumerate() {
        let heading = if number == 0 { "regime" } else { "" };
        let _ = writeln!(text, "{heading:<17} {}", of_stage(regime));
        for contact in &regime.contacts {
            let _ = writeln!(text, "{:<17} {}", "", of_contact(contact));
        }
    }
}

fn of_stage(regime: &StageRegime) -> String {
    let cause = |cause: &Option<Cause>, unit: &str| {
        cause.as_ref().map(|Cause { value, from }| format!("{value:.3e} {unit} {from}"))
    };
    let inertial = regime.inertial_number.map(|number| {
        let verdict = match number {
            _ if number <= regime.quasi_static_below() => "quasi-static",
            _ if number <= GAS_LIKE => "dense flow, its inertia counts",
            _ => "fast, as a gas",
        };
        format!("I = {number:.1e} ({verdict})")
    });
    let parts = [cause(&regime.pressure, "Pa"), cause(&regime.rate, "1/s"), inertial];
    let said: Vec<String> = parts.into_iter().flatten().collect();
    if said.is_empty() {
        return format!("{}: a gas", regime.stage);
    }
    format!("{}: {}", regime.stage, said.join(", "))
}

fn of_contact(contact: &ContactRegime) -> String {
    let softness = contact.softness.map(|softness| match softness {
        _ if softness == f64::INFINITY => {
            "the mean force is beyond what a pair contact carries (too soft)".to_owned()
        }
        _ if softness <= RIGID => format!("p* = {softness:.1e} (rigid)"),
        _ if softness <= SOFTEST => format!("p* = {softness:.1e} (soft)"),
        _ => format!("p* = {softness:.1e} (too soft for pair contacts)"),
    });
    let bond = contact.bond_number.map(|number| {
        let verdict = match number {
            _ if number == 0.0 => "no cohesion",
            _ if number < 1.0 => "cohesion hardly matters",
            _ => "cohesive",
        };
        format!("Bo = {} ({verdict})", short(number))
    });
    let depth = contact.plastic_depth.map(|depth| {
        let verdict = if depth < 1.0 { "below the plastic limit" } else { "at the plastic limit" };
        format!("X = {} ({verdict})", short(depth))
    });
    let share = contact.contact_time_share.map(|share| {
        let verdict = if share < PAIRS { "collisions of pairs" } else { "not only pairs collide" };
        format!("t_c f_E = {share:.1e} ({verdict})")
    });
    let said: Vec<String> = [softness, bond, depth, share].into_iter().flatten().collect();
    format!("{} {}", contact.between, said.join(", "))
}

/// A number of order one, or the order of another.
fn short(number: f64) -> String {
    if number == 0.0 || (0.01..1000.0).contains(&number) {
        format!("{number:.2}")
    } else {
        format!("{number:.1e}")
    }
}
