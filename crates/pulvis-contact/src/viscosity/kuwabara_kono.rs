//! The dashpot of visco-elastic spheres.

use pulvis_math::{Dimension, Real};

use super::ViscousLaw;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::NormalResponse;
use crate::pair::Pair;

/// Dashpot γ = A k with the elastic stiffness k of the normal law, for `hertz` γ = (3/2) A k_H √δ with
/// k_H = (4/3) E* √R: the quasi-static dissipation of spheres whose material has the dissipative time A.
///
/// With `hertz`, 1 − e grows with v^(1/5): e = 1 − C1 x + (3/5) C1² x² − …, C1 = 1.1534488581,
/// x = (3 A/2) (k_H/m_r)^(2/5) v^(1/5).
///
/// # Source
/// G. Kuwabara, K. Kono, Jpn. J. Appl. Phys. 26, 1230 (1987); N. V. Brilliantov, F. Spahn, J.-M. Hertzsch, T. Pöschel,
/// Phys. Rev. E 53, 5382 (1996).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KuwabaraKono {
    /// Dissipative time A [s].
    pub dissipative_time: f64,
}

impl Law for KuwabaraKono {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Viscosity,
        name: "kuwabara-kono",
        summary: "dashpot of visco-elastic spheres, proportional to the elastic stiffness",
        equations: "\
f = γ dδ/dt,  γ = A k                k: elastic stiffness, 2 E* a
1 − e ≈ C1 x − (3/5) C1² x²          with `hertz`: C1 = 1.15345, x = (3 A/2) (k_H/m_r)^(2/5) v^(1/5)",
        source: "Kuwabara & Kono, Jpn. J. Appl. Phys. 26, 1230 (1987); Brilliantov, Spahn, Hertzsch & Pöschel, Phys. Rev. E 53, 5382 (1996)",
        parameters: &[Parameter::number(
            "dissipative_time",
            "A",
            Dimension::TIME,
            Range::NonNegative,
            "dissipative time of the material",
        )],
        particle_quantities: &[],
        memory: &[],
        closed_form: "series of the restitution of a Hertz collision in pulvis_contact::theory::hertz",
        example: "law = \"kuwabara-kono\"\ndissipative_time = \"1e-7 s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { dissipative_time: values.number("dissipative_time")? })
    }
}

impl ViscousLaw for KuwabaraKono {
    #[inline(always)]
    fn coefficient<R: Real>(&self, _pair: &Pair<R>, _overlap: R, normal: &NormalResponse<R>) -> R {
        R::splat(self.dissipative_time) * normal.stiffness
    }

    fn largest_coefficient(&self, _pair: &Pair<f64>, max_stiffness: f64) -> f64 {
        self.dissipative_time * max_stiffness
    }

    const NEEDS_STIFFNESS: bool = true;
}
