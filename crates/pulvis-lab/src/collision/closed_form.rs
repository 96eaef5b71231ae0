//! What theory says of a collision, where a closed form covers it.

use super::outcome::Regime;
use super::problem::Problem;
use pulvis_contact::Viscosity;
use pulvis_contact::theory::{self, HeadOn, LinearSpringDashpot, head_on};
use pulvis_input::collision::{CollisionCase, luding_pair};

/// The closed form of a collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosedForm {
    /// How it ends.
    pub regime: Regime,
    /// Coefficient of restitution [1].
    pub restitution: f64,
    /// Largest overlap, where it is known [m].
    pub overlap_max: Option<f64>,
    /// Where it ends, as [`super::Outcome::overlap_end`], where that is known [m].
    pub overlap_end: Option<f64>,
    /// Time from touch to opening [s].
    pub contact_duration: Option<f64>,
    /// Energy lost until the end, where it is known [J].
    pub energy_dissipated: Option<f64>,
}

/// The closed form of a collision: of the Luding and the linear law without dashpot and with any
/// attraction, of elastic contacts with a constant dashpot and no attraction, and of those that [`head_on`] knows. Head
/// on only.
pub fn closed_form(case: &CollisionCase) -> Option<ClosedForm> {
    // A bond may hold what would rebound.
    if case.incidence.is_some() || case.contact.laws.bond.is_some() {
        return None;
    }
    let problem = Problem::new(case);
    let Some(pair) = luding_pair(&case.contact, &problem.pair) else { return other(case, &problem) };
    let dashpot = dashpot(&problem)?;
    if dashpot == 0.0 {
        let result = pair.restitution(case.velocity);
        let rebound = result.regime == theory::Regime::Rebound;
        return Some(ClosedForm {
            regime: if rebound { Regime::Rebound } else { Regime::Stick },
            restitution: result.value,
            overlap_max: Some(result.overlap_max),
            overlap_end: Some(result.overlap_end),
            contact_duration: pair.contact_duration(pair.touch_velocity(case.velocity)),
            energy_dissipated: Some(result.energy_dissipated),
        });
    }
    let parameters = pair.parameters();
    let elastic = parameters.kp == parameters.k1 && parameters.kc == 0.0;
    if !elastic || parameters.adhesion_force > 0.0 {
        return None;
    }
    let oscillator = LinearSpringDashpot::new(parameters.k1, dashpot, parameters.reduced_mass).ok()?;
    let restitution = oscillator.restitution();
    let duration = oscillator.contact_duration();
    Some(ClosedForm {
        regime: if restitution > 0.0 { Regime::Rebound } else { Regime::Stick },
        restitution,
        overlap_max: Some(oscillator.overlap_max(case.velocity)),
        overlap_end: Some(0.0),
        contact_duration: duration.is_finite().then_some(duration),
        energy_dissipated: Some(problem.kinetic(case.velocity) * (1.0 - restitution * restitution)),
    })
}

/// The closed form of a contact that is not Luding's.
fn other(case: &CollisionCase, problem: &Problem<'_>) -> Option<ClosedForm> {
    let HeadOn { restitution, overlap_max, contact_duration } =
        head_on(&case.contact, &problem.pair, case.velocity)?;
    let rebounds = restitution > 0.0;
    let lost = problem.kinetic(case.velocity) * (1.0 - restitution * restitution);
    Some(ClosedForm {
        regime: if rebounds { Regime::Rebound } else { Regime::Stick },
        restitution,
        overlap_max,
        overlap_end: None,
        contact_duration,
        // A pair that sticks has not lost everything at its first stop.
        energy_dissipated: rebounds.then_some(lost),
    })
}

/// The coefficient of all dashpots if it is a constant [kg/s].
fn dashpot(problem: &Problem<'_>) -> Option<f64> {
    let own = problem.contact.normal.dashpot(&problem.pair, &problem.contact.laws.expected);
    let viscosity = problem.contact.laws.viscosity;
    // Of constant dashpots the largest coefficient is the one that there is.
    let largest = viscosity.largest_coefficient(&problem.pair, 0.0);
    match viscosity {
        Viscosity::None(_) => Some(own),
        Viscosity::Constant(_) | Viscosity::Restitution(_) => Some(own + largest),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use pulvis_input::Document;
    use pulvis_input::collision::CollisionScenario;

    #[test]
    fn a_contact_that_a_bond_holds_has_no_closed_form() {
        let restitution = |bond: &str| {
            let text = format!(
                "[collision]\nbodies = \"pair\"\nradius = \"1 mm\"\ndensity = \"2000 kg/m^3\"\nvelocity = \"0.01 m/s\"\n[contact.normal]\nlaw = \"hertz\"\neffective_modulus = \"1e8 Pa\"\n{bond}"
            );
            let document = Document::from_str("bond.toml", &text).unwrap();
            let case = CollisionScenario::from_document(&document).unwrap().cases.remove(0);
            closed_form(&case).map(|theory| theory.restitution)
        };
        let bond = "[contact.bond]\nlaw = \"elastic-brittle\"\nform = \"first-touch\"\nnormal_stiffness = \"1e5 N/m\"\nshear_stiffness = \"1e5 N/m\"\nbending_stiffness = \"1e-4 J\"\ntorsion_stiffness = \"5e-5 J\"\ntensile_strength = \"1e9 N\"\nshear_strength = \"1e9 N\"\n";
        assert_eq!((restitution(""), restitution(bond)), (Some(1.0), None));
    }
}
