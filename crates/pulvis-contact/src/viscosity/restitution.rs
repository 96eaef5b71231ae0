//! The dashpot that is set by a coefficient of restitution.

use std::f64::consts::PI;

use pulvis_math::{Dimension, Real, elementary};

use super::ViscousLaw;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::NormalResponse;
use crate::pair::Pair;

/// Constant dashpot γ = −2 ln e √(k m_r / (π² + ln² e)) that each pair takes from its own reduced
/// mass and one reference stiffness k.
///
/// An elastic contact of stiffness k then has the coefficient of restitution e; a hysteretic one
/// has less. LIGGGHTS sets its dashpot so, with k = k1.
///
/// # Source
/// A. Singh, V. Magnanimo, S. Luding, arXiv:1503.03720 ("S1"), eq. (4), solved for γ_0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Restitution {
    /// γ over √m_r [kg^(1/2)/s].
    coefficient_per_root_mass: f64,
}

impl Law for Restitution {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Viscosity,
        name: "restitution",
        summary: "constant dashpot set by a coefficient of restitution, pair by pair",
        equations: "f = γ dδ/dt,  γ = −2 ln e √(k m_r/(π² + ln² e))   for δ > 0",
        source: "Singh, Magnanimo & Luding, arXiv:1503.03720, eq. 4",
        parameters: &[
            Parameter::number(
                "restitution",
                "e",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "coefficient of restitution of an elastic contact of the reference stiffness",
            ),
            Parameter::number(
                "stiffness",
                "k",
                Dimension::STIFFNESS,
                Range::Positive,
                "reference stiffness (LIGGGHTS: k1)",
            ),
        ],
        particle_quantities: &[],
        memory: &[],
        closed_form: "restitution of the linear law in pulvis_contact::theory (S1 eq. 4)",
        example: "law = \"restitution\"\nrestitution = 0.9\nstiffness = \"100 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let log = elementary::ln(values.number("restitution")?);
        let stiffness = values.number("stiffness")?;
        Ok(Self { coefficient_per_root_mass: -2.0 * log * (stiffness / (PI * PI + log * log)).sqrt() })
    }
}

impl ViscousLaw for Restitution {
    #[inline(always)]
    fn coefficient<R: Real>(&self, pair: &Pair<R>, _overlap: R, _normal: &NormalResponse<R>) -> R {
        R::splat(self.coefficient_per_root_mass) * pair.reduced_mass().sqrt()
    }

    fn largest_coefficient(&self, pair: &Pair<f64>, _max_stiffness: f64) -> f64 {
        self.coefficient_per_root_mass * pair.reduced_mass().sqrt()
    }
}
