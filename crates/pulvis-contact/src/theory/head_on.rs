//! What theory says of a head-on collision, for contacts with a closed form that is not Luding's.

use super::hertz::{HertzPair, tsuji_restitution};
use super::jkr::JkrPair;
use super::walton_braun::WaltonBraunPair;
use super::walton_johnson::WaltonJohnsonPair;
use crate::{ContactModel, NonContact, Normal, Pair, Viscosity};

/// The closed form of a head-on collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadOn {
    /// Coefficient of restitution; zero where the bodies stick \[-\].
    pub restitution: f64,
    /// Largest overlap, where a closed form knows it \[m\].
    pub overlap_max: Option<f64>,
    /// Time from touch to opening, where a closed form knows it \[s\].
    pub contact_duration: Option<f64>,
}

/// The closed form of a collision with the velocity `v` [m/s]: of elastic spheres without dashpot or with that of Tsuji,
/// of adhesive elastic spheres, and of the plastic contacts after Walton without dashpot. `None` for other contacts.
#[must_use]
pub fn head_on(contact: &ContactModel, pair: &Pair, velocity: f64) -> Option<HeadOn> {
    if !matches!(contact.laws.noncontact, NonContact::None(_)) {
        return None;
    }
    let (reduced_mass, radius) = (pair.reduced_mass(), 0.5 * pair.harmonic_radius());
    let of = |restitution, overlap_max| HeadOn { restitution, overlap_max, contact_duration: None };
    match (&contact.normal, &contact.laws.viscosity) {
        (Normal::Hertz(_), Viscosity::Tsuji(dashpot)) => Some(of(tsuji_restitution(dashpot.alpha), None)),
        (Normal::Hertz(law), Viscosity::None(_)) => {
            let spheres = HertzPair::new(law.effective_modulus, radius, reduced_mass).ok()?;
            let contact_duration = Some(spheres.contact_duration(velocity));
            Some(HeadOn { contact_duration, ..of(1.0, Some(spheres.overlap_max(velocity))) })
        }
        (Normal::Jkr(law), Viscosity::None(_)) => {
            let spheres = JkrPair::new(law.effective_modulus(), law.work_of_adhesion(), radius).ok()?;
            Some(of(spheres.restitution(velocity, reduced_mass), None))
        }
        (Normal::WaltonBraun(law), Viscosity::None(_)) => {
            let plastic = WaltonBraunPair::constant(law.k1, law.k2, reduced_mass).ok()?;
            Some(of(plastic.restitution(velocity), Some(plastic.overlap_max(velocity))))
        }
        (Normal::WaltonBraunVariable(law), Viscosity::None(_)) => {
            let plastic = WaltonBraunPair::variable(law.k1, law.slope, reduced_mass).ok()?;
            Some(of(plastic.restitution(velocity), Some(plastic.overlap_max(velocity))))
        }
        (Normal::WaltonJohnson(law), Viscosity::None(_)) => {
            let stiffnesses = [law.k1, law.k2, law.k_tail];
            let plastic = WaltonJohnsonPair::new(stiffnesses, law.f_0, law.kappa, reduced_mass).ok()?;
            Some(of(plastic.restitution(velocity), Some(plastic.overlap_max(velocity))))
        }
        _ => None,
    }
}
