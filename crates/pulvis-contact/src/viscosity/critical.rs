//! The dashpot that is a fraction of the critical one.

use pulvis_math::{Dimension, Real};

use super::ViscousLaw;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::NormalResponse;
use crate::pair::Pair;

/// Dashpot γ = 2 ζ √(m_r k) with the elastic stiffness k of the normal law where the contact is: at every overlap and on
/// every branch the same fraction ζ of critical damping.
///
/// A linear spring has the coefficient of restitution e = exp(−π ζ/√(1 − ζ²)); `hertz` that of `tsuji` with α = √6 ζ.
///
/// # Source
/// Text-book damping of an oscillator; the choice of the tangent stiffness as A. Singh, V. Magnanimo, S. Luding,
/// arXiv:1503.03720 ("S1"), footnote 8, discuss it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Critical {
    /// Fraction of critical damping ζ [1].
    pub fraction: f64,
}

impl Law for Critical {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Viscosity,
        name: "critical",
        summary: "dashpot that is a fraction of the critical one at the stiffness of each moment",
        equations: "\
f = γ dδ/dt,  γ = 2 ζ √(m_r k)       k: elastic stiffness
e = exp(−π ζ/√(1 − ζ²))              of a linear spring",
        source: "text-book oscillator; tangent stiffness as in Singh, Magnanimo & Luding, arXiv:1503.03720, footnote 8",
        parameters: &[Parameter::number(
            "fraction",
            "ζ",
            Dimension::NONE,
            Range::NonNegative,
            "fraction of critical damping, below 1 for bodies that rebound",
        )],
        particle_quantities: &[],
        memory: &[],
        closed_form: "restitution of a linear spring in pulvis_contact::theory::linear, of Hertz in theory::hertz",
        example: "law = \"critical\"\nfraction = 0.1",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { fraction: values.number("fraction")? })
    }
}

impl ViscousLaw for Critical {
    #[inline(always)]
    fn coefficient<R: Real>(&self, pair: &Pair<R>, _overlap: R, normal: &NormalResponse<R>) -> R {
        R::splat(2.0 * self.fraction) * (normal.stiffness / pair.inverse_reduced_mass()).sqrt()
    }

    fn largest_coefficient(&self, pair: &Pair<f64>, max_stiffness: f64) -> f64 {
        2.0 * self.fraction * (max_stiffness * pair.reduced_mass()).sqrt()
    }

    const NEEDS_STIFFNESS: bool = true;
}
