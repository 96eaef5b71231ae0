//! Dashpots that are stronger than critical.

use std::fmt;

use pulvis_contact::ContactModel;
use pulvis_core::Particle;
use pulvis_input::Problem;
use pulvis_input::scenario::{Contact, Refusal, Scenario};

use super::allow::refuse_unless_allowed;
use super::error::PrepareError;
use super::typical::{Body, TypicalBodies};

/// A dashpot beyond critical.
pub(super) struct Overdamped {
    /// The materials.
    names: String,
    /// The stage in which it is.
    stage: String,
    /// Which of the contact's dashpots.
    what: &'static str,
    /// Its damping ratio [1].
    ratio: f64,
}

impl fmt::Display for Overdamped {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { names, stage, what, ratio } = self;
        let digits = if *ratio < 10.0 { 2 } else { 0 };
        write!(
            out,
            "contact {names} (stage {stage}): the dashpot {what} is {ratio:.digits$} times the critical one; such a contact creeps, and makes the time step shorter than its springs need"
        )
    }
}

/// Refuses dashpots beyond critical: what is meant is mostly a smaller number.
pub(super) fn refuse_overdamped(scenario: &Scenario, particles: &[Particle]) -> Result<(), PrepareError> {
    if scenario.allows(Refusal::Overdamped) {
        return Ok(());
    }
    let Some(found) = overdamped(scenario, particles).into_iter().next() else { return Ok(()) };
    let role = match found.what {
        "of sliding" => "sliding",
        "of rolling" => "rolling",
        "of torsion" => "torsion",
        NORMAL => "viscosity",
        _ => "bond",
    };
    let contact = format!("contacts.{}", found.names);
    let paths = [format!("{contact}.{role}"), format!("{contact}.normal"), contact];
    let problem = Problem::rule(found.to_string(), "at most the critical one");
    let help = "lower the coefficient of the dashpot";
    refuse_unless_allowed(scenario, Refusal::Overdamped, &paths.each_ref().map(String::as_str), problem, help)
}

/// Contacts whose dashpots are beyond critical, each once.
pub(super) fn overdamped(scenario: &Scenario, particles: &[Particle]) -> Vec<Overdamped> {
    let mut seen: Vec<&Contact> = Vec::new();
    let mut found = Vec::new();
    for stage in &scenario.stages {
        for contact in stage.all_contacts() {
            if seen.iter().any(|known| known.materials == contact.materials && known.model == contact.model) {
                continue;
            }
            seen.push(contact);
            let Some(bodies) = TypicalBodies::of(scenario, particles, contact.materials) else { continue };
            let names = contact.materials.map(|material| scenario.materials[material].name.as_str());
            for (what, ratio) in damping_ratios(&contact.model, &bodies) {
                if ratio > 1.0 {
                    found.push(Overdamped { names: names.join("-"), stage: stage.name.clone(), what, ratio });
                }
            }
        }
    }
    found
}

/// The dashpot along the normal.
const NORMAL: &str = "along the normal";

/// The modes of a bond, in the order of its dashpots.
const BOND_MODES: [&str; 4] = [
    "of the bond along it",
    "of the bond across it",
    "of the bond against bending",
    "of the bond against torsion",
];

/// Damping ratios γ/(2 √(k m)) [1] of the contact of two bodies, on the stiffest branch of each law.
pub(super) fn damping_ratios(model: &ContactModel, bodies: &TypicalBodies) -> Vec<(&'static str, f64)> {
    let (body, partner, pair) = (bodies.body, bodies.second(), bodies.pair());
    let laws = &model.laws;
    let stiffness = model.normal.max_stiffness(&pair, &laws.expected);
    let dashpot =
        model.normal.dashpot(&pair, &laws.expected) + laws.viscosity.largest_coefficient(&pair, stiffness);
    let scale = model.scale(&pair);
    let ratio = |dashpot: f64, stiffness: f64, inverse_mass: f64| {
        if dashpot > 0.0 && stiffness > 0.0 { dashpot * (inverse_mass / stiffness).sqrt() / 2.0 } else { 0.0 }
    };
    let normal = ratio(dashpot, stiffness, pair.inverse_reduced_mass());
    // Solid spheres, I = 2/5 m a²: sliding moves mass and inertia, 1/m (1 + 5/2); rolling and torsion turn.
    let inverse_mass = |(mass, _): Body| 1.0 / mass;
    let masses = inverse_mass(body) + partner.map_or(0.0, inverse_mass);
    let lever = pair.harmonic_radius();
    let turn = |(mass, radius): Body| 2.5 * lever * lever / (mass * radius * radius);
    let turning = turn(body) + partner.map_or(0.0, turn);
    let mut ratios = vec![(NORMAL, normal)];
    if let Some(bond) = &laws.bond {
        let radii = [body.1, partner.map_or(0.0, |(_, radius)| radius)];
        let (stiffness, dashpots) = (bond.stiffness_at_touch(radii), bond.dashpots_at_touch(radii));
        let springs = [stiffness.normal, stiffness.shear, stiffness.bending, stiffness.torsion];
        let turning = turning / (lever * lever);
        let inverse_masses = [pair.inverse_reduced_mass(), 3.5 * masses, turning, turning];
        let ratio = |mode: usize| ratio(dashpots[mode], springs[mode], inverse_masses[mode]);
        ratios.extend(BOND_MODES.iter().enumerate().map(|(mode, what)| (*what, ratio(mode))));
    }
    for (what, law, inverse_mass) in [
        ("of sliding", &laws.sliding, 3.5 * masses),
        ("of rolling", &laws.rolling, turning),
        ("of torsion", &laws.torsion, turning),
    ] {
        if let Some(law) = law {
            ratios.push((what, ratio(law.dashpot(), law.max_stiffness(&scale), inverse_mass)));
        }
    }
    ratios
}
