//! Velocities at which head-on collisions of a contact change, from closed forms.

use super::closed_form::closed_form;
use super::problem::Problem;
use pulvis_contact::Normal;
use pulvis_contact::theory::{JkrPair, LudingPair, NonContact};
use pulvis_input::collision::{CollisionCase, luding_pair};

/// A velocity at which collisions change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityLimit {
    /// Its symbol, with `_` and `^` before what stands lower or higher.
    pub symbol: &'static str,
    /// What changes there, and which equation says so.
    pub meaning: &'static str,
    /// Relative speed outside the range of all forces [m/s].
    pub velocity: f64,
}

/// The limits between the regimes of a contact, in the order of the papers: of the Luding and the linear law without dashpot the ends
/// of sticking and the velocity that reaches the plastic limit, S1 (19), (34), (37); of `jkr` the end of sticking. None where no closed
/// form covers the collision. The speed and the integration of the `case` have no part in it.
pub fn velocity_limits(case: &CollisionCase) -> Vec<VelocityLimit> {
    // With a dashpot the limits of the papers do not hold.
    if closed_form(case).is_none_or(|_| Problem::new(case).is_damped()) {
        return Vec::new();
    }
    let pair = case.bodies.pair();
    if let Some(luding) = luding_pair(&case.contact, &pair) {
        return of_luding(&luding);
    }
    let Normal::Jkr(law) = &case.contact.normal else { return Vec::new() };
    let radius = 0.5 * pair.harmonic_radius();
    let spheres = JkrPair::new(law.effective_modulus(), law.work_of_adhesion(), radius).ok();
    let limit = |spheres: JkrPair| VelocityLimit {
        symbol: "v_s",
        meaning: "below it the spheres stick: what pull-off takes is all they have, √(2 W/m_r)",
        velocity: spheres.sticking_velocity(pair.reduced_mass()),
    };
    spheres.map(limit).into_iter().collect()
}

fn of_luding(pair: &LudingPair) -> Vec<VelocityLimit> {
    let critical = pair.critical_velocities();
    let limits = [
        ("v_c^(a)", "below it f_a holds the bodies: end of sticking at low velocities", critical.low_end),
        (
            "v_c^(b)",
            "from it on the attraction kc of the flattened contact holds the bodies, S1 (34)",
            critical.high_onset,
        ),
        (
            "v_c^(c)",
            "above it the bodies have more than a contact at its plastic limit dissipates, S1 (37)",
            critical.high_end,
        ),
        ("v_p", "from it on the contact reaches its plastic limit, S1 (19)", plastic(pair)),
    ];
    let limit = |(symbol, meaning, velocity): (_, _, Option<f64>)| {
        let velocity = velocity.filter(|velocity| *velocity > 0.0 && velocity.is_finite())?;
        Some(VelocityLimit { symbol, meaning, velocity })
    };
    limits.into_iter().filter_map(limit).collect()
}

/// The speed outside all ranges with which a pair touches at v_p; `None` where every contact reaches the limit, or none does [m/s].
fn plastic(pair: &LudingPair) -> Option<f64> {
    let touch = pair.v_p().filter(|_| pair.dp().is_finite())?;
    let gained = if pair.parameters().noncontact == NonContact::Reversible { pair.v_fa() } else { 0.0 };
    (touch >= gained).then(|| ((touch - gained) * (touch + gained)).sqrt())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic)]
    use super::*;
    use crate::collision::{Observation, Regime, collide};
    use pulvis_input::Document;
    use pulvis_input::collision::CollisionScenario;

    fn case(contact: &str) -> CollisionCase {
        let text = format!(
            "[collision]\nbodies = \"pair\"\nradius = \"1.1 mm\"\ndensity = \"2000 kg/m^3\"\nvelocity = \"0.1 m/s\"\n{contact}"
        );
        CollisionScenario::from_document(&Document::from_str("limits.toml", &text).unwrap())
            .unwrap()
            .cases
            .remove(0)
    }

    fn at(case: &CollisionCase, velocity: f64) -> crate::collision::Outcome {
        let case = CollisionCase { value: velocity, velocity, ..case.clone() };
        collide(&case, &Observation::default()).unwrap().outcome
    }

    const PLASTIC: &str = "[contact.normal]\nlaw = \"luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"100 N/m\"\nphi_f = 0.1\n";

    /// Exact collisions on both sides of each limit, 1 part in 1000 away: the method is good to 1e-12.
    #[test]
    fn collisions_change_at_the_limits_of_the_papers() {
        for (attraction, count) in [
            ("", 3),
            ("[contact.noncontact]\nlaw = \"jump-in\"\nf_a = \"1e-4 N\"\nkc_a = \"100 N/m\"\n", 4),
            ("[contact.noncontact]\nlaw = \"reversible\"\nf_a = \"1e-4 N\"\nkc_a = \"100 N/m\"\n", 4),
        ] {
            let case = case(&format!("{PLASTIC}{attraction}"));
            let limits = velocity_limits(&case);
            assert_eq!(limits.len(), count, "{limits:?}");
            for VelocityLimit { symbol, velocity, .. } in limits {
                let [below, above] = [0.999, 1.001].map(|factor| at(&case, factor * velocity));
                if symbol == "v_p" {
                    let dp = luding_pair(&case.contact, &case.bodies.pair()).unwrap().dp();
                    assert!(below.overlap_max < dp && above.overlap_max > dp, "{below:?} {above:?}");
                } else {
                    assert_ne!(below.regime, above.regime, "{symbol} = {velocity} m/s");
                }
            }
        }
    }

    #[test]
    fn adhesive_elastic_spheres_stick_below_their_limit() {
        let case = case(
            "[contact.normal]\nlaw = \"jkr\"\neffective_modulus = \"1e8 Pa\"\nwork_of_adhesion = \"0.1 N/m\"\n",
        );
        let limits = velocity_limits(&case);
        let [VelocityLimit { symbol: "v_s", velocity, .. }] = limits.as_slice() else { panic!("{limits:?}") };
        assert_eq!(at(&case, 0.999 * velocity).regime, Regime::Stick);
        assert_eq!(at(&case, 1.001 * velocity).regime, Regime::Rebound);
    }

    #[test]
    fn with_a_dashpot_there_are_none() {
        let damped = format!("{PLASTIC}[contact.viscosity]\nlaw = \"constant\"\ngamma_0 = \"1e-3 kg/s\"\n");
        assert!(velocity_limits(&case(&damped)).is_empty());
        assert!(
            velocity_limits(&case("[contact.normal]\nlaw = \"hertz\"\neffective_modulus = \"1e8 Pa\"\n"))
                .is_empty()
        );
    }
}
