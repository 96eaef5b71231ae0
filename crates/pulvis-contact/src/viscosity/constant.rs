//! The constant dashpot.

use pulvis_math::{Dimension, Real};

use super::ViscousLaw;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::NormalResponse;
use crate::pair::Pair;

/// Dashpot with a constant coefficient, f = γ_0 dδ/dt while δ > 0, on every branch.
///
/// The force jumps by γ_0 v where the bodies touch and where they part. As every dashpot it acts, in such a step, for the part
/// of the step in which they are in contact: the time integration keeps its second order.
///
/// # Source
/// A. Singh, V. Magnanimo, S. Luding, arXiv:1503.03720 ("S1"), eq. (2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    /// Coefficient γ_0 [kg/s].
    pub gamma_0: f64,
}

impl Law for Constant {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Viscosity,
        name: "constant",
        summary: "dashpot with a constant coefficient",
        equations: "f = γ₀ dδ/dt                   for δ > 0",
        source: "Singh, Magnanimo & Luding, arXiv:1503.03720, eq. 2",
        parameters: &[Parameter::number(
            "gamma_0",
            "γ₀",
            Dimension::DASHPOT,
            Range::NonNegative,
            "dashpot coefficient",
        )],
        particle_quantities: &[],
        memory: &[],
        closed_form: "restitution exp(−π h/ω) of an elastic contact in pulvis_contact::theory (S1 eq. 4)",
        example: "law = \"constant\"\ngamma_0 = \"5e-3 kg/s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { gamma_0: values.number("gamma_0")? })
    }
}

impl ViscousLaw for Constant {
    #[inline(always)]
    fn coefficient<R: Real>(&self, _pair: &Pair<R>, _overlap: R, _normal: &NormalResponse<R>) -> R {
        R::splat(self.gamma_0)
    }

    fn largest_coefficient(&self, _pair: &Pair<f64>, _max_stiffness: f64) -> f64 {
        self.gamma_0
    }
}
