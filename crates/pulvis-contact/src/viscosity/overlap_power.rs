//! The dashpot that grows with a power of the overlap.

use pulvis_math::{Dimension, Real};

use super::ViscousLaw;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::NormalResponse;
use crate::pair::Pair;

/// Dashpot proportional to a power of the overlap: f = γ_0 (δ/δ_p)^q dδ/dt.
///
/// δ_p is the normal law's plastic limit overlap, for elastic laws the harmonic mean radius a12.
/// The force does not jump at first touch.
///
/// # Source
/// A. Singh, V. Magnanimo, S. Luding, arXiv:1503.03720 ("S1"), footnote 8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverlapPower {
    /// Coefficient γ_0 at δ = δ_p [kg/s].
    pub gamma_0: f64,
    /// Exponent q, at least 1/2 [1].
    pub exponent: f64,
}

impl Law for OverlapPower {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Viscosity,
        name: "overlap-power",
        summary: "dashpot proportional to a power of the overlap, without a jump at touch",
        equations: "f = γ₀ (δ/δ_p)^q dδ/dt          for δ > 0; δ_p of elastic laws: a12",
        source: "Singh, Magnanimo & Luding, arXiv:1503.03720, footnote 8",
        parameters: &[
            Parameter::number(
                "gamma_0",
                "γ₀",
                Dimension::DASHPOT,
                Range::NonNegative,
                "dashpot coefficient at the plastic limit overlap δ_p",
            ),
            Parameter::number(
                "exponent",
                "q",
                Dimension::NONE,
                Range::AtLeast(0.5),
                "exponent of the overlap",
            )
            .or(0.5),
        ],
        particle_quantities: &[],
        memory: &[],
        closed_form: "1 − e² = 2 γ₀ (δ_max/δ_p)^q B((q+1)/2, 3/2)/(m_r ω) of a linear spring, first order in γ₀",
        example: "law = \"overlap-power\"\ngamma_0 = \"5e-3 kg/s\"\nexponent = 1.0",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { gamma_0: values.number("gamma_0")?, exponent: values.number("exponent")? })
    }
}

impl ViscousLaw for OverlapPower {
    #[inline(always)]
    fn coefficient<R: Real>(&self, _pair: &Pair<R>, overlap: R, normal: &NormalResponse<R>) -> R {
        let relative = overlap * normal.inverse_overlap_scale;
        // The usual exponents without the slow general power.
        let power = if self.exponent == 0.5 {
            relative.sqrt()
        } else if self.exponent == 1.0 {
            relative
        } else {
            relative.powf(self.exponent)
        };
        R::splat(self.gamma_0) * power
    }

    fn largest_coefficient(&self, _pair: &Pair<f64>, _max_stiffness: f64) -> f64 {
        self.gamma_0
    }

    const NEEDS_HARDENING: bool = true;
}
