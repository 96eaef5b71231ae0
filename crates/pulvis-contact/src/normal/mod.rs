//! Forces along the line of centres while two bodies overlap. One file a law; the list is at the
//! end of this file.

use pulvis_math::Real;

use crate::catalogue::{InvalidParameter, Law, LawEntry, Values, law_list};
use crate::pair::Pair;

mod linear;
mod luding;

pub use linear::Linear;
pub use luding::{Interpolation, Luding, LudingMemory};

/// What a contact remembers between time steps, as plain columns of numbers.
pub trait Memory<R: Real>: Copy + Default + std::fmt::Debug {
    /// Number of columns.
    const COLUMNS: usize;
    /// The memory read from its columns.
    fn load(column: impl FnMut(usize) -> R) -> Self;
    /// The memory written into its columns.
    fn store(&self, column: impl FnMut(usize, R));
}

/// The memory of a law that has none.
impl<R: Real> Memory<R> for () {
    const COLUMNS: usize = 0;
    #[inline(always)]
    fn load(_column: impl FnMut(usize) -> R) -> Self {}
    #[inline(always)]
    fn store(&self, _column: impl FnMut(usize, R)) {}
}

/// What a normal law answers to an overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NormalResponse<R = f64> {
    /// Rate-independent force f_hys, repulsion positive [N].
    pub force: R,
    /// What friction learns of the normal force: the distance f_hys + k_c δ from the law's tensile
    /// limit, never negative [N].
    pub friction_reference: R,
    /// How far the contact has hardened, (k2 − k1)/(kp − k1), from 0 (virgin) to 1; laws that do not
    /// harden: 1.
    pub hardening: R,
    /// One over the overlap that the law takes as its scale (Luding: δ_p; elastic laws: a12) [1/m].
    pub inverse_overlap_scale: R,
    /// Energy that the contact gives back along its elastic branch [J].
    pub stored_energy: R,
    /// Energy lost to plastic deformation since the last call [J].
    pub dissipated_plastic: R,
    /// Energy lost on the adhesive limit branch since the last call [J].
    pub dissipated_adhesive: R,
}

/// A rate-independent force along the line of centres.
///
/// The force may depend on the overlap and on what the memory keeps of the overlap's past, in such a
/// way that only the turning points matter and not the size of the steps between them.
pub trait NormalLaw: Law {
    /// What a contact remembers.
    type Memory<R: Real>: Memory<R>;

    /// The response at `overlap` δ >= 0 [m]; updates the memory. An open contact is called with
    /// overlap zero: the force is then zero, and the memory that of a contact that never was.
    fn respond<R: Real>(&self, pair: &Pair<R>, overlap: R, memory: &mut Self::Memory<R>)
    -> NormalResponse<R>;

    /// Coefficient of the law's own dashpot [kg/s]; most laws leave viscosity to the viscous law.
    #[inline(always)]
    fn dashpot<R: Real>(&self, _pair: &Pair<R>) -> R {
        R::zero()
    }

    /// The name of the branch on which the point (overlap [m], memory) lies, and its number, which
    /// differs between branches: where it changes, the force may have a kink. The memory may be the
    /// one before or the one after the response at that overlap.
    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &Self::Memory<f64>) -> (u8, &'static str);

    /// The steepest slope |df/dδ| of any branch [N/m].
    fn max_stiffness(&self, pair: &Pair<f64>) -> f64;
}

/// Something to be done with a law whose type is only known at run time.
pub trait NormalLawVisitor {
    /// What comes of it.
    type Output;
    /// Does it.
    fn visit<N: NormalLaw>(self, law: N) -> Self::Output;
}

macro_rules! normal_laws {
    ($($law:ident),* $(,)?) => {
        law_list! {
            /// Any normal law of the catalogue.
            Normal: $($law),*
        }

        impl Normal {
            /// Hands the law, with its own type, to the visitor.
            pub fn accept<V: NormalLawVisitor>(&self, visitor: V) -> V::Output {
                match self { $(Self::$law(law) => visitor.visit(*law),)* }
            }
        }

        $(impl From<$law> for Normal {
            fn from(law: $law) -> Self {
                Self::$law(law)
            }
        })*
    };
}

// The list of normal laws: a new one is its file and its name here.
normal_laws![Linear, Luding];
