//! The pair that the closed forms of the papers speak about.

use pulvis_contact::normal::Interpolation;
use pulvis_contact::theory::{self, LudingPair, LudingParameters};
use pulvis_contact::{ContactModel, NonContact, Normal, Pair};

/// The closed forms of a pair, dashpots left out: of the Luding law, and of the linear law as its
/// elastic limit kp = k1, kc = 0. None of bodies that a bond may hold.
pub fn luding_pair(contact: &ContactModel, pair: &Pair) -> Option<LudingPair> {
    if contact.laws.bond.is_some() {
        return None;
    }
    let (mass, radius) = (pair.reduced_mass(), pair.harmonic_radius());
    let parameters = match contact.normal {
        Normal::Luding(law) => LudingParameters::new(law.k1, law.kp, law.kc, law.phi_f, mass, radius)
            .with_interpolation(match law.interpolation {
                Interpolation::Linear => theory::Interpolation::Linear,
                Interpolation::SquareRoot => theory::Interpolation::SquareRoot,
                Interpolation::Constant => theory::Interpolation::Constant,
            }),
        Normal::Linear(law) => {
            let stiffness = law.stiffness(pair);
            LudingParameters::new(stiffness, stiffness, 0.0, 1.0, mass, radius)
        }
        #[allow(unreachable_patterns)] // laws to come
        _ => return None,
    };
    let parameters = match contact.laws.noncontact {
        NonContact::None(_) => parameters,
        NonContact::Reversible(law) => {
            parameters.with_adhesion(theory::NonContact::Reversible, law.f_a, law.kc_a)
        }
        NonContact::JumpIn(law) => parameters.with_adhesion(theory::NonContact::JumpIn, law.f_a, law.kc_a),
        #[allow(unreachable_patterns)] // laws to come
        _ => return None,
    };
    LudingPair::new(parameters).ok()
}
