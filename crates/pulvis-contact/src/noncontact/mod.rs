//! Attraction that also acts at a distance. One file a law; the list is at the end of this file.

use pulvis_math::Real;

use crate::catalogue::{InvalidParameter, Law, LawEntry, Values, law_list};
use crate::energy::AttractionAccount;
use crate::kinematics::NormalMotion;
use crate::memory::{self, Columns, Memory};
use crate::pair::{Pair, Sizes};

mod coulomb;
mod hamaker;
mod jump_in;
mod liquid_bridge;
mod none;
mod reversible;

pub use coulomb::{COULOMB_CONSTANT, Coulomb};
pub use hamaker::Hamaker;
pub(crate) use hamaker::{HAMAKER, Z0};
pub use jump_in::JumpIn;
pub use liquid_bridge::LiquidBridge;
pub use none::None;
pub use reversible::Reversible;

/// What a non-contact law answers to an overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NonContactResponse<R = f64> {
    /// Force, repulsion positive [N].
    pub force: R,
    /// The force on the bodies over this step [N]: `force`, but where it sets in or ends within the step weighted by the
    /// part of the step in which it acted.
    pub applied_force: R,
    /// Potential energy, zero out of reach [J].
    pub potential: R,
    /// Energy lost since the last call because the attraction sets in suddenly [J].
    pub dissipated: R,
}

/// An attraction that is added to the normal law, in contact and at a distance.
pub trait NonContactLaw: Law {
    /// What a contact remembers.
    type Memory<R: Real>: Memory<R>;

    /// The accounts of its potential and of what it dissipates.
    const ACCOUNT: AttractionAccount = AttractionAccount::Adhesive;

    /// The response to a motion; updates the memory. It is asked as long as the bodies are within the law's
    /// [range](Self::interaction_range), and once more when they have left it: then it must be zero.
    fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut Self::Memory<R>,
    ) -> NonContactResponse<R>;

    /// The largest distance −δ at which the law acts [m]. It must not fall when radii grow.
    fn interaction_range(&self, pair: &Pair<f64>) -> f64;

    /// The steepest slope |df/dδ| [N/m], zero for a force that only jumps.
    fn max_stiffness(&self, pair: &Pair<f64>) -> f64;

    /// Whether this law reads the particle quantities that its description names.
    fn reads_quantities(&self) -> bool {
        true
    }

    /// The same law knowing the sizes of a particle quantity by its name, if its stiffness or its range depends on one.
    #[must_use]
    fn bounded_by(self, _sizes: &dyn Fn(&str) -> Sizes) -> Self {
        self
    }

    /// Whether the law acts on bodies that approach each other before they touch.
    fn acts_on_approach(&self) -> bool;

    /// The name and the number of the branch at `overlap` [m]; zero is the number of bodies on which nothing acts.
    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &Self::Memory<f64>) -> (u8, &'static str);
}

/// The straight branch of both laws with a reach: force −fa in contact and −kca (δ − δ_a) from
/// δ = 0 down to δ_a = −fa/kca, with its potential. S1 (13), (14).
#[inline(always)]
fn linear_tail<R: Real>(adhesion_force: f64, slope: f64, overlap: R) -> (R, R) {
    let f_a = R::splat(adhesion_force);
    let depth = overlap.max(R::zero());
    if slope.is_infinite() {
        return ((-f_a).keep_where(overlap.gt(R::zero())), -(f_a * depth));
    }
    // Written so that the pull is f_a to the last bit at touch and zero at δ_a.
    let within_reach = overlap.gt(R::splat(-(adhesion_force / slope)));
    let pull = (f_a + R::splat(slope) * overlap).max(R::zero()).min(f_a).keep_where(within_reach);
    let potential = -(R::splat(0.5) * pull * (pull / R::splat(slope))) - f_a * depth;
    (-pull, potential)
}

/// The branches of a law that acts within a range [m], on approach and on separation alike, and is called `apart` at a
/// distance.
fn branch_by_distance(overlap: f64, range: f64, apart: &'static str) -> (u8, &'static str) {
    if overlap > 0.0 {
        (2, "in contact")
    } else if overlap > -range {
        (1, apart)
    } else {
        (0, "out of reach")
    }
}

macro_rules! noncontact_laws {
    ($($law:ident),* $(,)?) => {
        law_list! {
            /// Any non-contact law of the catalogue.
            NonContact: $($law),*
        }

        impl NonContact {
            /// See [`NonContactLaw::respond`]; the law's memory begins at the column `start`.
            #[inline(always)]
            pub fn respond<R: Real>(
                &self,
                motion: &NormalMotion<R>,
                columns: &mut (impl Columns<R> + ?Sized),
                start: usize,
            ) -> NonContactResponse<R> {
                match self {
                    $(Self::$law(law) => {
                        let mut before = memory::load(columns, start);
                        let answer = law.respond(motion, &mut before);
                        memory::store(&before, columns, start);
                        answer
                    })*
                }
            }

            /// See [`NonContactLaw::ACCOUNT`].
            #[inline(always)]
            pub fn account(&self) -> AttractionAccount {
                match self { $(Self::$law(_) => <$law as NonContactLaw>::ACCOUNT,)* }
            }

            /// See [`NonContactLaw::interaction_range`].
            pub fn interaction_range(&self, pair: &Pair) -> f64 {
                match self { $(Self::$law(law) => law.interaction_range(pair),)* }
            }

            /// See [`NonContactLaw::max_stiffness`].
            pub fn max_stiffness(&self, pair: &Pair) -> f64 {
                match self { $(Self::$law(law) => law.max_stiffness(pair),)* }
            }

            /// See [`NonContactLaw::reads_quantities`].
            pub fn reads_quantities(&self) -> bool {
                match self { $(Self::$law(law) => law.reads_quantities(),)* }
            }

            /// See [`NonContactLaw::bounded_by`].
            #[must_use]
            pub fn bounded_by(&self, sizes: &dyn Fn(&str) -> Sizes) -> Self {
                match self { $(Self::$law(law) => Self::$law(law.bounded_by(sizes)),)* }
            }

            /// See [`NonContactLaw::acts_on_approach`].
            pub fn acts_on_approach(&self) -> bool {
                match self { $(Self::$law(law) => law.acts_on_approach(),)* }
            }

            /// See [`NonContactLaw::branch`]; the law's memory begins at the column `start`.
            pub fn branch(&self, pair: &Pair, overlap: f64, columns: &[f64], start: usize) -> (u8, &'static str) {
                match self { $(Self::$law(law) => law.branch(pair, overlap, &memory::load(columns, start)),)* }
            }
        }
    };
}

// The list of non-contact laws: a new one is its file and its name here.
noncontact_laws![None, Reversible, JumpIn, Hamaker, LiquidBridge, Coulomb];
