//! Resistance against sliding, rolling and torsion. One file a law; the list is at the end of this
//! file.

use pulvis_math::Real;

use crate::catalogue::{InvalidParameter, LawEntry, Role, Values};
use crate::conventions::SlipDashpot;
use crate::memory::Memory;

mod constant_torque;
mod elastic_plastic;
mod force_memory;
mod marshall;
pub mod mindlin;
mod none;
mod parameters;
mod rotation;
mod spring_slider;
mod tangent;
mod thornton_yin;
pub mod walton;

pub use constant_torque::ConstantTorque;
pub use elastic_plastic::ElasticPlastic;
pub use marshall::Marshall;
pub use mindlin::{Mindlin, Rescale};
pub use rotation::SpringRotation;
pub(crate) use rotation::{rescaled, twisted};
pub use spring_slider::SpringSlider;
pub use tangent::{Along, Tangent};
pub use thornton_yin::ThorntonYin;
pub use walton::Walton;

/// What a friction law answers to a relative motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionResponse<T, R = f64> {
    /// Force against the motion [N].
    pub force: T,
    /// Elastic energy of the spring [J].
    pub stored_energy: R,
    /// Energy lost by slipping since the last call [J].
    pub dissipated_slip: R,
    /// Power lost in the dashpot [W].
    pub viscous_power: R,
}

/// The motion that a spring of a contact follows during one time step.
#[derive(Clone, Copy, Debug)]
pub struct SpringMotion<T, R: Real> {
    /// Relative velocity at the time of the force [m/s].
    pub velocity: T,
    /// Relative displacement since the last call, in the present tangent plane [m].
    pub displacement: T,
    /// For how long the contact has been closed since the last call [s].
    pub elapsed: R,
    /// Whether it is closed.
    pub in_contact: R::Mask,
    /// Normal force that the Coulomb limit refers to [N]; zero for an open contact.
    pub friction_reference: R,
    /// Radius of the contact area, zero where the normal law knows none [m].
    pub contact_radius: R,
    /// Force that pulls the bodies apart, zero where the normal law knows none [N].
    pub pull_off_force: R,
    /// Elastic stiffness of the normal force [N/m].
    pub normal_stiffness: R,
    /// Length L that turns angular velocities into those of rolling and torsion [m].
    pub lever: R,
    /// What the dashpot sees in slip.
    pub slip_dashpot: SlipDashpot,
}

impl<T: Tangent<R>, R: Real> SpringMotion<T, R> {
    /// The displacement over the time that it took, zero where none has passed [m/s].
    #[inline(always)]
    fn mean_velocity(&self) -> T {
        let moves = self.elapsed.gt(R::zero());
        let rate = R::one() / R::select(moves, self.elapsed, R::one());
        self.displacement.scaled(rate.keep_where(moves))
    }
}

/// A law against one of the three relative motions. Its memory is a vector of the tangent plane, or a number along the
/// line of centres, which turns with the contact, and some numbers beside it.
pub trait FrictionLaw: Copy {
    /// What it remembers beside the vector.
    type Scalars<R: Real>: Memory<R>;

    /// Advances the memory and answers with the force, and with whether the contact slips, or gives up a
    /// force because it has opened. An open contact (`in_contact` false, reference zero) is left without force and
    /// without memory.
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        vector: &mut T,
        scalars: &mut Self::Scalars<R>,
    ) -> (FrictionResponse<T, R>, R::Mask);

    /// The elastic force [N] that a vector of its memory stands for, along it.
    fn elastic_force<R: Real, T: Tangent<R>>(&self, vector: T) -> T;

    /// Energy [J] that is gone when the square of the vector's length has fallen from `before` to `after`.
    fn lost_by_shortening<R: Real>(&self, before: R, after: R) -> R;

    /// Dashpot coefficient, at the most [kg/s].
    fn dashpot(&self) -> f64;

    /// The greatest stiffness [N/m] of contacts up to this scale.
    fn max_stiffness(&self, scale: &ContactScale) -> f64;

    /// The one role that the law can play; all of them where `None`.
    const ONLY: Option<Role> = None;

    /// Whether the law asks for the radius of the contact area, or for the force that pulls the bodies apart.
    const NEEDS_CONTACT_RADIUS: bool = false;

    /// Whether the law asks for the stiffness of the normal force.
    fn needs_normal_stiffness(&self) -> bool {
        false
    }
}

/// How large and how stiff contacts become under the loading that is expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactScale {
    /// Radius of the contact area, zero where the normal law knows none [m].
    pub contact_radius: f64,
    /// Stiffness of the normal force [N/m].
    pub normal_stiffness: f64,
    /// Harmonic mean of the radii [m].
    pub harmonic_radius: f64,
}

/// The friction law whose code loops for common contacts hold, and no other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommonFriction {
    /// [`SpringSlider`].
    SpringSlider,
    /// [`Mindlin`].
    Mindlin,
}

/// Something to be done with a friction law whose type is only known at run time.
pub trait FrictionVisitor {
    /// The role that the law plays there, if it matters: code is made only for the laws that can play it.
    const ROLE: Option<Role> = None;
    /// What comes of it.
    type Output;
    /// Does it.
    fn visit<F: FrictionLaw>(self, law: &F) -> Self::Output;
}

/// Whether a law that plays `only` one role can play another.
const fn can_play(only: Option<Role>, role: Option<Role>) -> bool {
    match (only, role) {
        (Some(only), Some(role)) => only as u8 == role as u8,
        _ => true,
    }
}

macro_rules! friction_laws {
    (none: $none:ident; common: $common_module:ident::$common:ident; others: $($module:ident::$law:ident),* $(,)?) => {
        /// Any friction law of the catalogue.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Friction {
            #[doc = concat!("See [`", stringify!($common), "`].")] $common($common),
            $(#[doc = concat!("See [`", stringify!($law), "`].")] $law($law),)*
        }

        impl From<$common> for Friction {
            fn from(law: $common) -> Self {
                Self::$common(law)
            }
        }
        $(impl From<$law> for Friction {
            fn from(law: $law) -> Self {
                Self::$law(law)
            }
        })*

        impl Friction {
            /// Hands the law, with its own type, to the visitor.
            #[inline(always)]
            pub fn accept<V: FrictionVisitor>(&self, visitor: V) -> V::Output {
                match self {
                    Self::$common(law) => visitor.visit(law),
                    $(Self::$law(law) => visitor.visit(law),)*
                }
            }

            /// Hands the law to the visitor if it can play the visitor's [`ROLE`](FrictionVisitor::ROLE).
            #[inline(always)]
            pub(crate) fn accept_in_role<V: FrictionVisitor>(&self, visitor: V) -> Option<V::Output> {
                match self {
                    Self::$common(law) => Some(visitor.visit(law)),
                    $(Self::$law(law) if const { can_play(<$law as FrictionLaw>::ONLY, V::ROLE) } => {
                        Some(visitor.visit(law))
                    })*
                    _ => None,
                }
            }

            /// Hands the law to the visitor if it is the one that common contacts have.
            #[inline(always)]
            pub(crate) fn accept_common<V: FrictionVisitor>(
                &self,
                common: CommonFriction,
                visitor: V,
            ) -> Option<V::Output> {
                match (common, self) {
                    (CommonFriction::SpringSlider, Self::SpringSlider(law)) => Some(visitor.visit(law)),
                    (CommonFriction::Mindlin, Self::Mindlin(law)) => Some(visitor.visit(law)),
                    _ => None,
                }
            }

            /// Whether the law is the one that common contacts have.
            pub const fn is(&self, common: CommonFriction) -> bool {
                matches!(
                    (common, self),
                    (CommonFriction::SpringSlider, Self::SpringSlider(_)) | (CommonFriction::Mindlin, Self::Mindlin(_))
                )
            }

            /// The law's description in a role that it can play.
            pub fn entry(&self, role: Role) -> Option<&'static LawEntry> {
                match self {
                    Self::$common(_) => $common_module::entry(role),
                    $(Self::$law(_) => $module::entry(role),)*
                }
            }
        }

        /// The descriptions of all laws that can play `role`.
        pub fn entries(role: Role) -> Vec<&'static LawEntry> {
            [$none::entry(role), $common_module::entry(role), $($module::entry(role)),*].into_iter().flatten().collect()
        }

        /// The law called `name` in `role` with the given parameter values; the outer `None` where
        /// there is no such law, the inner one where the law is to have no friction.
        pub fn build(
            role: Role,
            name: &str,
            values: &Values,
        ) -> Option<Result<Option<Friction>, InvalidParameter>> {
            if let Some(entry) = $none::entry(role).filter(|entry| entry.name == name) {
                return Some(entry.complete(values).map(|_| None));
            }
            if let Some(entry) = $common_module::entry(role).filter(|entry| entry.name == name) {
                let law = entry.complete(values).and_then(|values| $common_module::build(role, &values));
                return Some(law.map(|law| Some(law.into())));
            }
            $(if let Some(entry) = $module::entry(role).filter(|entry| entry.name == name) {
                let law = entry.complete(values).and_then(|values| $module::build(role, &values));
                return Some(law.map(|law| Some(law.into())));
            })*
            None
        }
    };
}

// The list of friction laws: a new one is its file and its name here, among the others. The loops for common contacts
// hold the code of one `CommonFriction` only.
friction_laws![
    none: none;
    common: spring_slider::SpringSlider;
    others: constant_torque::ConstantTorque,
    elastic_plastic::ElasticPlastic,
    marshall::Marshall,
    mindlin::Mindlin,
    thornton_yin::ThorntonYin,
    walton::Walton,
];

struct Dashpot;
impl FrictionVisitor for Dashpot {
    type Output = f64;
    fn visit<F: FrictionLaw>(self, law: &F) -> f64 {
        law.dashpot()
    }
}

struct MaxStiffness<'a>(&'a ContactScale);
impl FrictionVisitor for MaxStiffness<'_> {
    type Output = f64;
    fn visit<F: FrictionLaw>(self, law: &F) -> f64 {
        law.max_stiffness(self.0)
    }
}

struct NeedsContactRadius;
impl FrictionVisitor for NeedsContactRadius {
    type Output = bool;
    fn visit<F: FrictionLaw>(self, _law: &F) -> bool {
        F::NEEDS_CONTACT_RADIUS
    }
}

struct NeedsNormalStiffness;
impl FrictionVisitor for NeedsNormalStiffness {
    type Output = bool;
    fn visit<F: FrictionLaw>(self, law: &F) -> bool {
        law.needs_normal_stiffness()
    }
}

impl Friction {
    /// Dashpot coefficient [kg/s].
    pub fn dashpot(&self) -> f64 {
        self.accept(Dashpot)
    }

    /// The greatest stiffness [N/m] of contacts up to this scale.
    pub fn max_stiffness(&self, scale: &ContactScale) -> f64 {
        self.accept(MaxStiffness(scale))
    }

    /// Whether the law asks for the radius of the contact area, or for the force that pulls the bodies apart.
    pub fn needs_contact_radius(&self) -> bool {
        self.accept(NeedsContactRadius)
    }

    /// Whether the law asks for the stiffness of the normal force.
    pub fn needs_normal_stiffness(&self) -> bool {
        self.accept(NeedsNormalStiffness)
    }
}
