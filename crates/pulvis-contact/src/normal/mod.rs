//! Forces along the line of centres. One file a law; the list is at the end of this file.

use std::borrow::Borrow;

use pulvis_math::Real;

use crate::catalogue::{InvalidParameter, Law, LawEntry, Values, law_list};
use crate::expected::ExpectedLoading;
use crate::friction::CommonFriction;
use crate::kinematics::NormalMotion;
use crate::memory::{self, Columns, Memory};
use crate::pair::Pair;

mod adhesive_curve;
mod any;
mod attracted_spheres;
mod core_shell;
mod dahneke;
mod dmt;
mod eepa;
mod hertz;
mod jkr;
mod kempton;
mod lee_radok;
mod linear;
mod luding;
mod molerus;
mod pasha;
mod rathbone;
mod response;
mod sinter_luding;
mod sinter_overlap;
mod sintering;
mod tabulated;
mod thornton_ning;
mod tomas;
mod viscoelastic_jkr;
mod walton_braun;
mod walton_braun_variable;
mod walton_johnson;

pub use core_shell::CoreShell;
pub use dahneke::Dahneke;
pub use dmt::Dmt;
pub use eepa::{Eepa, EepaMemory};
pub(crate) use hertz::EFFECTIVE_MODULUS;
pub use hertz::Hertz;
pub use jkr::Jkr;
pub use kempton::Kempton;
pub use lee_radok::{LeeRadok, LeeRadokMemory};
pub use linear::Linear;
pub use luding::{Interpolation, Luding, LudingMemory};
pub use molerus::{Molerus, MolerusMemory};
pub use pasha::{Pasha, PashaMemory};
pub use rathbone::{Rathbone, RathboneMemory};
pub use response::NormalResponse;
pub use sinter_luding::{SinterLuding, SinterLudingMemory};
pub use sinter_overlap::SinterOverlap;
pub use tabulated::Tabulated;
pub use thornton_ning::{ThorntonNing, ThorntonNingMemory};
pub use tomas::{Tomas, TomasMemory};
pub use viscoelastic_jkr::{ViscoelasticJkr, ViscoelasticJkrMemory};
pub use walton_braun::WaltonBraun;
pub use walton_braun_variable::WaltonBraunVariable;
pub use walton_johnson::{WaltonJohnson, WaltonJohnsonMemory};

/// A force along the line of centres.
///
/// The force may depend on the overlap, on the closing rate and the time step, and on what the memory keeps of the
/// contact's past.
pub trait NormalLaw: Law + Listed {
    /// What a contact remembers.
    type Memory<R: Real>: Memory<R>;

    /// Whether `respond` answers to an overlap in the same way however often and however far apart it is asked on a
    /// monotone path (rate-independent laws).
    const PATH_ONLY: bool = true;

    /// Whether the force may jump where the [branch](Self::branch) changes.
    const JUMPS: bool = !Self::PATH_ONLY;

    /// The answer to a motion; updates the memory. It is asked as long as the bodies are within the law's
    /// [range](Self::interaction_range), and once more when they have left it: then the force must be zero, and the
    /// memory what the law wants to know when they meet again, zero for a contact that never was.
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut Self::Memory<R>) -> NormalResponse<R>;

    /// How far beyond touching the law acts [m]: on approach, or on separation. It must not fall when radii grow.
    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        0.0
    }

    /// Coefficient of the law's own dashpot, at the most under the `expected` loading [kg/s]; most laws leave viscosity to
    /// the viscous law.
    fn dashpot(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        0.0
    }

    /// Whether the law has a dashpot of its own.
    const HAS_DASHPOT: bool = false;

    /// Whether no closed path gains energy from the law. A published form that creates energy says no: its losses may be
    /// negative, and it may apply a force of the rate beside its dashpot.
    fn is_passive(&self) -> bool {
        true
    }

    /// The name of the branch on which the point (overlap [m], memory) lies, and its number, which
    /// differs between branches: where it changes, the force may have a kink or a jump. Zero is the number of a contact
    /// that does not act. The memory may be the one before or the one after the response at that overlap.
    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &Self::Memory<f64>) -> (u8, &'static str);

    /// The stiffness [N/m] that the time step must resolve: the steepest slope |df/dδ| of any branch, or where there is
    /// none, the slope under the `expected` loading.
    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64;

    /// Whether [`max_stiffness`](Self::max_stiffness) bounds the slope of every branch. Where it does not, the engine
    /// watches the stiffness of the contacts that there are.
    const STIFFNESS_IS_BOUNDED: bool = true;

    /// Whether the force depends on the rate or on time beside what [`dashpot`](Self::dashpot) says: then a path without
    /// times says too little.
    const DEPENDS_ON_TIME: bool = false;

    /// The largest rate [1/s] at which the contact changes at rest, of those that a time step must resolve; zero where steps
    /// of any length do it right.
    fn relaxation_rate(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        0.0
    }

    /// Whether the law reads the temperature, which must then be given.
    const NEEDS_TEMPERATURE: bool = false;

    /// The law against sliding that common contacts of this law have.
    const COMMON_SLIDING: CommonFriction = CommonFriction::SpringSlider;

    /// Radius of the contact area under the `expected` loading [m]; zero for laws that know none.
    fn expected_contact_radius(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        0.0
    }

    /// The energy [J] that figures of the papers call the potential of a branch, where it is not the energy that
    /// unloading gives back (S1 Fig. 15).
    fn branch_potential(
        &self,
        _branch: u8,
        _motion: &NormalMotion<f64>,
        _memory: &Self::Memory<f64>,
    ) -> Option<f64> {
        None
    }

    /// The largest overlap that the contact remembers [m], if the law keeps one.
    fn remembered_overlap(&self, _memory: &Self::Memory<f64>) -> Option<f64> {
        None
    }
}

/// A law that stands in the list of normal laws.
pub trait Listed: Sized {
    /// The law, where `normal` is this one.
    fn of(normal: &Normal) -> Option<&Self>;
}

/// Where the answer of the normal law comes from.
pub trait NormalSource<R: Real> {
    /// Number of columns of its memory, where it is known at compile time.
    const COLUMNS: Option<usize>;
    /// The law against sliding, if the contact is a [common](crate::ContactModel::is_common) one.
    const COMMON: Option<CommonFriction>;
    /// Whether the contact may be one with a curved wall.
    const CURVED: bool;
    /// Whether the law may have a dashpot of its own.
    const DASHPOT: bool;
    /// The answer, or where it stands. What stands in memory is better read where it is used than copied into registers
    /// that a loop does not have.
    type Answer<'a>: Borrow<NormalResponse<R>>
    where
        Self: 'a;
    /// The answer; updates the memory.
    fn respond<C: Columns<R> + ?Sized>(&self, motion: &NormalMotion<R>, columns: &mut C) -> Self::Answer<'_>;
}

/// A law whose type is known at compile time, in a loop for common contacts.
#[derive(Clone, Copy, Debug)]
pub struct Inlined<N>(pub N);

impl<R: Real, N: NormalLaw> NormalSource<R> for Inlined<N> {
    const COLUMNS: Option<usize> = Some(<N::Memory<f64> as Memory<f64>>::COLUMNS);
    const COMMON: Option<CommonFriction> = Some(N::COMMON_SLIDING);
    const CURVED: bool = false;
    const DASHPOT: bool = N::HAS_DASHPOT;
    type Answer<'a>
        = NormalResponse<R>
    where
        Self: 'a;

    #[inline(always)]
    fn respond<C: Columns<R> + ?Sized>(
        &self,
        motion: &NormalMotion<R>,
        columns: &mut C,
    ) -> NormalResponse<R> {
        answer(&self.0, motion, columns)
    }
}

/// An answer that has been computed already, memory included, of a contact that may be `CURVED`.
#[derive(Clone, Copy, Debug)]
pub struct Computed<'a, R: Real, const CURVED: bool>(pub &'a NormalResponse<R>);

impl<R: Real, const CURVED: bool> NormalSource<R> for Computed<'_, R, CURVED> {
    const COLUMNS: Option<usize> = None;
    const COMMON: Option<CommonFriction> = None;
    const CURVED: bool = CURVED;
    const DASHPOT: bool = true;
    type Answer<'b>
        = &'b NormalResponse<R>
    where
        Self: 'b;

    #[inline(always)]
    fn respond<C: Columns<R> + ?Sized>(
        &self,
        _motion: &NormalMotion<R>,
        _columns: &mut C,
    ) -> &NormalResponse<R> {
        self.0
    }
}

/// The answer of a law that keeps its memory in the first of the `columns`.
#[inline(always)]
pub fn answer<R: Real, N: NormalLaw>(
    law: &N,
    motion: &NormalMotion<R>,
    columns: &mut (impl Columns<R> + ?Sized),
) -> NormalResponse<R> {
    let mut before: N::Memory<R> = memory::load(columns, 0);
    let answer = law.respond(motion, &mut before);
    memory::store(&before, columns, 0);
    answer
}

/// Something to be done with a law whose type is only known at run time.
pub trait NormalLawVisitor {
    /// What comes of it.
    type Output;
    /// Does it.
    fn visit<N: NormalLaw>(self, law: &N) -> Self::Output;
}

/// Something to be done with the law of a common contact.
pub trait CommonLawVisitor {
    /// What comes of it.
    type Output;
    /// Does it.
    fn visit<N: NormalLaw>(self, law: N) -> Self::Output;
}

macro_rules! normal_laws {
    (common: $($common:ident),*; others: $($other:ident),*) => {
        law_list! {
            /// Any normal law of the catalogue.
            Normal: $($common,)* $($other),*
        }

        impl Normal {
            /// Hands the law, with its own type, to the visitor.
            #[inline(always)]
            pub fn accept<V: NormalLawVisitor>(&self, visitor: V) -> V::Output {
                match self {
                    $(Self::$common(law) => visitor.visit(law),)*
                    $(Self::$other(law) => visitor.visit(law),)*
                }
            }

            /// Hands the law to the visitor if it is one of those that loops for common contacts are compiled for.
            pub fn accept_common<V: CommonLawVisitor>(&self, visitor: V) -> Option<V::Output> {
                match self {
                    $(Self::$common(law) => Some(visitor.visit(*law)),)*
                    _ => None,
                }
            }

            /// Whether loops for common contacts are compiled for the law.
            pub const fn is_common(&self) -> bool {
                matches!(self, $(Self::$common(_))|*)
            }
        }

        normal_laws!(@listed $($common,)* $($other),*);

        $(impl From<$common> for Normal {
            fn from(law: $common) -> Self {
                Self::$common(law)
            }
        })*
        $(impl From<$other> for Normal {
            fn from(law: $other) -> Self {
                Self::$other(law)
            }
        })*
    };
    (@listed $($law:ident),*) => {
        $(impl Listed for $law {
            #[inline(always)]
            fn of(normal: &Normal) -> Option<&Self> {
                match normal {
                    Normal::$law(law) => Some(law),
                    _ => None,
                }
            }
        })*
    };
}

// The list of normal laws: a new one is its file and its name here, among the others. Loops are compiled once more for
// each common law, for every level of resistance and instruction set; all others share one loop and are called through
// pointers (decision 17).
normal_laws![
    common: Hertz, Linear, Luding;
    others:
        CoreShell, Dahneke, Dmt, Eepa, Jkr, Kempton, LeeRadok, Molerus, Pasha, Rathbone, SinterLuding, SinterOverlap, Tabulated, ThorntonNing, Tomas, ViscoelasticJkr, WaltonBraun, WaltonBraunVariable, WaltonJohnson
];
