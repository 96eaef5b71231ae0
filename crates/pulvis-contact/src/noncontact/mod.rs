//! Attraction that also acts at a distance. One file a law; the list is at the end of this file.

use pulvis_math::Real;

use crate::catalogue::{InvalidParameter, Law, LawEntry, Values, law_list};

mod jump_in;
mod none;
mod reversible;

pub use jump_in::JumpIn;
pub use none::None;
pub use reversible::Reversible;

/// What a non-contact law answers to an overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NonContactResponse<R = f64> {
    /// Force, repulsion positive [N].
    pub force: R,
    /// Potential energy, zero out of reach [J].
    pub potential: R,
    /// Energy lost since the last call because the attraction sets in suddenly [J].
    pub dissipated: R,
}

/// An attraction that is added to the normal law, in contact and at a distance.
pub trait NonContactLaw: Law {
    /// The response at `overlap` δ [m], negative at a distance. `touched` is 1 where the pair has
    /// been in contact since it last was out of reach, otherwise 0; the law updates it.
    fn respond<R: Real>(&self, overlap: R, touched: &mut R) -> NonContactResponse<R>;

    /// The largest distance −δ at which the law acts [m].
    fn interaction_range(&self) -> f64;

    /// The steepest slope |df/dδ| [N/m], zero for a force that only jumps.
    fn max_stiffness(&self) -> f64;

    /// Whether the force depends on `touched`, so that a contact must remember it.
    fn remembers_touch(&self) -> bool;

    /// The name and the number of the branch at `overlap` [m].
    fn branch(&self, overlap: f64, touched: f64) -> (u8, &'static str);
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

macro_rules! noncontact_laws {
    ($($law:ident),* $(,)?) => {
        law_list! {
            /// Any non-contact law of the catalogue.
            NonContact: $($law),*
        }

        impl NonContact {
            /// See [`NonContactLaw::respond`].
            #[inline(always)]
            pub fn respond<R: Real>(&self, overlap: R, touched: &mut R) -> NonContactResponse<R> {
                match self { $(Self::$law(law) => law.respond(overlap, touched),)* }
            }

            /// See [`NonContactLaw::reach`].
            pub fn interaction_range(&self) -> f64 {
                match self { $(Self::$law(law) => law.interaction_range(),)* }
            }

            /// See [`NonContactLaw::max_stiffness`].
            pub fn max_stiffness(&self) -> f64 {
                match self { $(Self::$law(law) => law.max_stiffness(),)* }
            }

            /// See [`NonContactLaw::remembers_touch`].
            pub fn remembers_touch(&self) -> bool {
                match self { $(Self::$law(law) => law.remembers_touch(),)* }
            }

            /// See [`NonContactLaw::branch`].
            pub fn branch(&self, overlap: f64, touched: f64) -> (u8, &'static str) {
                match self { $(Self::$law(law) => law.branch(overlap, touched),)* }
            }
        }
    };
}

// The list of non-contact laws: a new one is its file and its name here.
noncontact_laws![None, Reversible, JumpIn];
