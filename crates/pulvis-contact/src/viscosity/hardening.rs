//! The dashpot that grows with hardening.

use pulvis_math::{Dimension, Real};

use super::ViscousLaw;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::NormalResponse;
use crate::pair::Pair;

/// Dashpot proportional to k2 − k1: f = γ_0 (k2 − k1)/(kp − k1) dδ/dt.
///
/// A virgin contact has no dashpot, so that the force does not jump at first touch. Laws that do not
/// harden (`linear`, `luding` with constant k2) have the full γ_0; `luding` with kp = k1 has none, the
/// limit of a plastic range that is never filled.
///
/// # Source
/// A. Singh, V. Magnanimo, S. Luding, *Sticking of adhesive particles in elasto-plastic
/// collisions*, footnote 2; arXiv:1503.03720 ("S1"), footnote 8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hardening {
    /// Coefficient γ_0 of a fully plastic contact [kg/s].
    pub gamma_0: f64,
}

impl Law for Hardening {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Viscosity,
        name: "hardening",
        summary: "dashpot proportional to k2 − k1, without a jump at touch",
        equations: "f = γ₀ (k2 − k1)/(kp − k1) dδ/dt   for δ > 0",
        source: "Singh, Magnanimo & Luding, arXiv:1503.03720, footnote 8",
        parameters: &[Parameter::number(
            "gamma_0",
            "γ₀",
            Dimension::DASHPOT,
            Range::NonNegative,
            "dashpot coefficient of a fully plastic contact (k2 = kp)",
        )],
        particle_quantities: &[],
        memory: &[],
        closed_form: "equals the constant dashpot where k2 = kp: restitution exp(−π h/ω) of the linear law (S1 eq. 4)",
        example: "law = \"hardening\"\ngamma_0 = \"5e-3 kg/s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { gamma_0: values.number("gamma_0")? })
    }
}

impl ViscousLaw for Hardening {
    #[inline(always)]
    fn coefficient<R: Real>(&self, _pair: &Pair<R>, _overlap: R, normal: &NormalResponse<R>) -> R {
        R::splat(self.gamma_0) * normal.hardening
    }

    fn largest_coefficient(&self, _pair: &Pair<f64>, _max_stiffness: f64) -> f64 {
        self.gamma_0
    }

    const NEEDS_HARDENING: bool = true;
}
