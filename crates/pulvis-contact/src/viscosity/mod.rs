//! Dashpots along the line of centres, active while the bodies overlap. One file a law; the list
//! is at the end of this file.

use pulvis_math::Real;

use crate::catalogue::{InvalidParameter, Law, LawEntry, Values, law_list};
use crate::normal::NormalResponse;
use crate::pair::Pair;

mod constant;
mod critical;
mod hardening;
mod kuwabara_kono;
mod none;
mod overlap_power;
mod restitution;
mod tsuji;

pub use constant::Constant;
pub use critical::Critical;
pub use hardening::Hardening;
pub use kuwabara_kono::KuwabaraKono;
pub use none::None;
pub use overlap_power::OverlapPower;
pub use restitution::Restitution;
pub use tsuji::Tsuji;

/// A dashpot: force γ dδ/dt while the bodies are in contact.
pub trait ViscousLaw: Law {
    /// The coefficient γ [kg/s] at `overlap` δ > 0 [m], given what the normal law answered there.
    fn coefficient<R: Real>(&self, pair: &Pair<R>, overlap: R, normal: &NormalResponse<R>) -> R;

    /// The largest coefficient [kg/s] that the pair can meet up to the overlap that the normal law takes
    /// as its scale, where its elastic stiffness is at most `max_stiffness` [N/m].
    fn largest_coefficient(&self, pair: &Pair<f64>, max_stiffness: f64) -> f64;

    /// Whether the coefficient follows the elastic stiffness of the normal law.
    const NEEDS_STIFFNESS: bool = false;

    /// Whether the coefficient follows the hardening of the normal law, or its overlap scale.
    const NEEDS_HARDENING: bool = false;
}

macro_rules! viscous_laws {
    ($($law:ident),* $(,)?) => {
        law_list! {
            /// Any viscous law of the catalogue.
            Viscosity: $($law),*
        }

        impl Viscosity {
            /// See [`ViscousLaw::coefficient`].
            #[inline(always)]
            pub fn coefficient<R: Real>(&self, pair: &Pair<R>, overlap: R, normal: &NormalResponse<R>) -> R {
                match self { $(Self::$law(law) => law.coefficient(pair, overlap, normal),)* }
            }

            /// See [`ViscousLaw::largest_coefficient`].
            pub fn largest_coefficient(&self, pair: &Pair<f64>, max_stiffness: f64) -> f64 {
                match self { $(Self::$law(law) => law.largest_coefficient(pair, max_stiffness),)* }
            }

            /// See [`ViscousLaw::NEEDS_STIFFNESS`].
            pub fn needs_stiffness(&self) -> bool {
                match self { $(Self::$law(_) => $law::NEEDS_STIFFNESS,)* }
            }

            /// See [`ViscousLaw::NEEDS_HARDENING`].
            pub fn needs_hardening(&self) -> bool {
                match self { $(Self::$law(_) => $law::NEEDS_HARDENING,)* }
            }
        }
    };
}

// The list of viscous laws: a new one is its file and its name here.
viscous_laws![None, Constant, Critical, Hardening, KuwabaraKono, OverlapPower, Restitution, Tsuji];
