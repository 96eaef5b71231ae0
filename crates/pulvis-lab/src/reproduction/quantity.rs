//! Quantities by their names; no number where there is none.

use crate::collision::{ClosedForm, Outcome, Regime, Sample};
use crate::probe::ProbeSample;
use pulvis_contact::theory::asymptotes;
use pulvis_input::collision::CollisionCase;
use pulvis_input::figure::{Approximation, limited_pair};

/// A quantity that the collision has before it begins.
pub(super) fn of_case(name: &str, case: &CollisionCase) -> Option<f64> {
    let pair = limited_pair(case);
    let touch = pair.map(|pair| (pair, pair.touch_velocity(case.velocity)));
    match name {
        "velocity" => Some(case.velocity),
        "chi" => touch.map(|(pair, touch)| pair.chi(touch)),
        "eta" => pair.map(|pair| pair.eta()),
        "beta" => pair.map(|pair| pair.beta()),
        "alpha" => touch.map(|(pair, touch)| pair.alpha(touch)),
        "radius" => Some(case.bodies.radii()[0]),
        "zeta" => touch.and_then(|(pair, touch)| pair.zeta(touch)),
        _ => None,
    }
}

/// A quantity of a computed collision.
pub(super) fn of_outcome(name: &str, case: &CollisionCase, outcome: &Outcome) -> Option<f64> {
    let sticks = outcome.regime == Regime::Stick;
    match name {
        "restitution" => Some(outcome.restitution),
        "returned_energy" => Some(outcome.restitution * outcome.restitution),
        "overlap_max" => Some(outcome.overlap_max),
        "overlap_end" => sticks.then_some(outcome.overlap_end),
        "contact_duration" => outcome.contact_duration,
        other => of_case(other, case),
    }
}

/// A quantity that the closed form tells.
pub(super) fn of_theory(name: &str, case: &CollisionCase, theory: &ClosedForm) -> Option<f64> {
    let sticks = theory.regime == Regime::Stick;
    match name {
        "restitution" => Some(theory.restitution),
        "returned_energy" => Some(theory.restitution * theory.restitution),
        "overlap_max" => theory.overlap_max,
        "overlap_end" => theory.overlap_end.filter(|_| sticks),
        "contact_duration" => theory.contact_duration,
        other => of_case(other, case),
    }
}

/// A limit of the restitution at the collision.
pub(super) fn of_approximation(
    name: &str,
    case: &CollisionCase,
    approximation: Approximation,
) -> Option<f64> {
    if name != "restitution" && name != "returned_energy" {
        return of_case(name, case);
    }
    let pair = limited_pair(case)?;
    let (eta, beta, chi) = (pair.eta(), pair.beta(), pair.chi(pair.touch_velocity(case.velocity)));
    let restitution = match approximation {
        Approximation::Slow => asymptotes::low_velocity(eta, chi),
        Approximation::Plastic => asymptotes::power_law(eta, chi),
        Approximation::WeakAdhesion => asymptotes::weakly_cohesive(eta, beta, chi)?,
        Approximation::SquareRoot => asymptotes::power_law_square_root(eta, chi),
    };
    let restitution = Some(restitution).filter(|restitution| (0.0..=1.0).contains(restitution))?;
    Some(if name == "restitution" { restitution } else { restitution * restitution })
}

/// A quantity of an instant of a collision.
pub(super) fn of_sample(name: &str, sample: &Sample) -> f64 {
    match name {
        "time" => sample.time,
        "overlap" => sample.overlap,
        "force" => sample.force,
        "delta_max" => sample.delta_max,
        "kinetic" => sample.kinetic,
        "potential_available" => sample.potential_available,
        "potential_plastic" => sample.potential_plastic,
        "dissipated" => sample.dissipated,
        _ => f64::NAN,
    }
}

/// A quantity of an instant of a probe.
pub(super) fn of_probe(name: &str, sample: &ProbeSample) -> f64 {
    match name {
        "overlap" => sample.overlap,
        "force" => sample.force,
        "leg" => sample.leg,
        "stored_energy" => sample.stored_energy,
        "dissipated" => sample.dissipated,
        "shear" => sample.shear,
        "shear_force" => sample.shear_force,
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulvis_input::figure::{OF_COURSES, OF_PATHS};

    #[test]
    fn every_quantity_that_an_axis_can_show_is_known() {
        let sample = Sample::default();
        assert!(OF_COURSES.iter().all(|quantity| of_sample(quantity.name, &sample).is_finite()));
        let sample = ProbeSample {
            time: None,
            leg: 0.0,
            overlap: 0.0,
            force: 0.0,
            contact_radius: 0.0,
            stored_energy: 0.0,
            dissipated: 0.0,
            branch: "",
            shear: 0.0,
            shear_force: 0.0,
            roll: 0.0,
            roll_torque: 0.0,
            twist: 0.0,
            twist_torque: 0.0,
            work: 0.0,
        };
        assert!(OF_PATHS.iter().all(|quantity| of_probe(quantity.name, &sample).is_finite()));
    }
}
