//! What a law of the catalogue answers whose type is only known at run time.

use pulvis_math::Real;

use super::{Normal, NormalLaw, NormalLawVisitor, NormalResponse, NormalSource, answer};
use crate::expected::ExpectedLoading;
use crate::friction::CommonFriction;
use crate::kinematics::NormalMotion;
use crate::memory::{self, Columns};
use crate::pair::Pair;

macro_rules! forwarded {
    ($(#[$doc:meta])* $name:ident($($argument:ident: $type:ty),*) -> $output:ty) => {
        impl Normal {
            $(#[$doc])*
            pub fn $name(&self, $($argument: &$type),*) -> $output {
                struct Visitor<'a>($(&'a $type),*);
                impl NormalLawVisitor for Visitor<'_> {
                    type Output = $output;
                    fn visit<N: NormalLaw>(self, law: &N) -> $output {
                        let Self($($argument),*) = self;
                        law.$name($($argument),*)
                    }
                }
                self.accept(Visitor($($argument),*))
            }
        }
    };
}

forwarded!(
    /// See [`NormalLaw::interaction_range`].
    interaction_range(pair: Pair) -> f64
);
forwarded!(
    /// See [`NormalLaw::dashpot`].
    dashpot(pair: Pair, expected: ExpectedLoading) -> f64
);
forwarded!(
    /// See [`NormalLaw::max_stiffness`].
    max_stiffness(pair: Pair, expected: ExpectedLoading) -> f64
);
forwarded!(
    /// See [`NormalLaw::relaxation_rate`].
    relaxation_rate(pair: Pair, expected: ExpectedLoading) -> f64
);
forwarded!(
    /// See [`NormalLaw::expected_contact_radius`].
    expected_contact_radius(pair: Pair, expected: ExpectedLoading) -> f64
);

impl Normal {
    /// See [`NormalLaw::STIFFNESS_IS_BOUNDED`].
    pub fn stiffness_is_bounded(&self) -> bool {
        struct Bounded;
        impl NormalLawVisitor for Bounded {
            type Output = bool;
            fn visit<N: NormalLaw>(self, _law: &N) -> bool {
                N::STIFFNESS_IS_BOUNDED
            }
        }
        self.accept(Bounded)
    }

    /// See [`NormalLaw::is_passive`].
    pub fn is_passive(&self) -> bool {
        struct IsPassive;
        impl NormalLawVisitor for IsPassive {
            type Output = bool;
            fn visit<N: NormalLaw>(self, law: &N) -> bool {
                law.is_passive()
            }
        }
        self.accept(IsPassive)
    }

    /// See [`NormalLaw::DEPENDS_ON_TIME`].
    pub fn depends_on_time(&self) -> bool {
        struct Timed;
        impl NormalLawVisitor for Timed {
            type Output = bool;
            fn visit<N: NormalLaw>(self, _law: &N) -> bool {
                N::DEPENDS_ON_TIME
            }
        }
        self.accept(Timed)
    }

    /// See [`NormalLaw::NEEDS_TEMPERATURE`].
    pub fn needs_temperature(&self) -> bool {
        struct Heated;
        impl NormalLawVisitor for Heated {
            type Output = bool;
            fn visit<N: NormalLaw>(self, _law: &N) -> bool {
                N::NEEDS_TEMPERATURE
            }
        }
        self.accept(Heated)
    }

    /// See [`NormalLaw::COMMON_SLIDING`].
    pub fn common_sliding(&self) -> CommonFriction {
        struct Sliding;
        impl NormalLawVisitor for Sliding {
            type Output = CommonFriction;
            fn visit<N: NormalLaw>(self, _law: &N) -> CommonFriction {
                N::COMMON_SLIDING
            }
        }
        self.accept(Sliding)
    }

    /// See [`NormalLaw::branch`]; the law's memory stands in the first of the `columns`.
    pub fn branch(&self, pair: &Pair, overlap: f64, columns: &[f64]) -> (u8, &'static str) {
        self.accept(Look { columns, of: (pair, overlap) })
    }

    /// See [`NormalLaw::branch_potential`].
    pub fn branch_potential(&self, branch: u8, motion: &NormalMotion<f64>, columns: &[f64]) -> Option<f64> {
        self.accept(Look { columns, of: (branch, motion) })
    }

    /// See [`NormalLaw::remembered_overlap`].
    pub fn remembered_overlap(&self, columns: &[f64]) -> Option<f64> {
        self.accept(Look { columns, of: () })
    }
}

/// A look at a law with a memory in columns.
struct Look<'a, T> {
    columns: &'a [f64],
    of: T,
}

impl NormalLawVisitor for Look<'_, (&Pair, f64)> {
    type Output = (u8, &'static str);
    fn visit<N: NormalLaw>(self, law: &N) -> Self::Output {
        law.branch(self.of.0, self.of.1, &memory::load(self.columns, 0))
    }
}

impl NormalLawVisitor for Look<'_, (u8, &NormalMotion<f64>)> {
    type Output = Option<f64>;
    fn visit<N: NormalLaw>(self, law: &N) -> Self::Output {
        law.branch_potential(self.of.0, self.of.1, &memory::load(self.columns, 0))
    }
}

impl NormalLawVisitor for Look<'_, ()> {
    type Output = Option<f64>;
    fn visit<N: NormalLaw>(self, law: &N) -> Self::Output {
        law.remembered_overlap(&memory::load(self.columns, 0))
    }
}

impl<R: Real> NormalSource<R> for Normal {
    const COLUMNS: Option<usize> = None;
    const COMMON: Option<CommonFriction> = None;
    const CURVED: bool = true;
    const DASHPOT: bool = true;
    type Answer<'a> = NormalResponse<R>;

    fn respond<C: Columns<R> + ?Sized>(
        &self,
        motion: &NormalMotion<R>,
        columns: &mut C,
    ) -> NormalResponse<R> {
        struct Answer<'a, R: Real, C: ?Sized>(&'a NormalMotion<R>, &'a mut C);
        impl<R: Real, C: Columns<R> + ?Sized> NormalLawVisitor for Answer<'_, R, C> {
            type Output = NormalResponse<R>;
            #[inline(always)]
            fn visit<N: NormalLaw>(self, law: &N) -> NormalResponse<R> {
                answer(law, self.0, self.1)
            }
        }
        self.accept(Answer(motion, columns))
    }
}
