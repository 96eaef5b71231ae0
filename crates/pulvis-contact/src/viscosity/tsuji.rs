//! The dashpot of Tsuji, which gives elastic spheres one coefficient of restitution at any speed.

use std::f64::consts::PI;

use pulvis_math::{Dimension, Real, elementary};

use super::ViscousLaw;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::NormalResponse;
use crate::pair::Pair;

/// Dashpot γ = α √(2/3 m_r k) with the elastic stiffness k of the normal law, for `hertz`
/// γ = α √(m_r k_H) δ^(1/4) with k_H = (4/3) E* √R.
///
/// With `hertz` the coefficient of restitution is e = exp(−π α/√(5 − α²)) at any speed, where the contact ends
/// with δ = 0; α is given, or follows from e.
///
/// # Source
/// Y. Tsuji, T. Tanaka, T. Ishida, Powder Technol. 71, 239 (1992); the closed form from D. Antypov, J. A. Elliott,
/// EPL 94, 50004 (2011).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tsuji {
    /// Coefficient α [1].
    pub alpha: f64,
}

impl Tsuji {
    /// The dashpot that gives a coefficient of restitution e, α = −√5 ln e/√(π² + ln² e).
    pub fn from_restitution(restitution: f64) -> Self {
        let log = elementary::ln(restitution);
        Self { alpha: -(5.0_f64.sqrt()) * log / (PI * PI + log * log).sqrt() }
    }
}

impl Law for Tsuji {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Viscosity,
        name: "tsuji",
        summary: "dashpot that gives Hertz contacts one coefficient of restitution",
        equations: "\
f = γ dδ/dt,  γ = α √(2/3 m_r k)     k: elastic stiffness, 2 E* a
e = exp(−π α/√(5 − α²))              with `hertz`, at any speed",
        source: "Tsuji, Tanaka & Ishida, Powder Technol. 71, 239 (1992); Antypov & Elliott, EPL 94, 50004 (2011)",
        parameters: &[
            Parameter::number(
                "alpha",
                "α",
                Dimension::NONE,
                Range::NonNegative,
                "damping coefficient, below √5",
            )
            .optional(),
            Parameter::number(
                "restitution",
                "e",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "coefficient of restitution of a Hertz contact; sets alpha",
            )
            .optional(),
        ],
        particle_quantities: &[],
        memory: &[],
        closed_form: "restitution of a Hertz collision in pulvis_contact::theory::hertz",
        example: "law = \"tsuji\"\nrestitution = 0.8",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        match (values.optional_number("alpha"), values.optional_number("restitution")) {
            (Some(_), Some(_)) => Err(InvalidParameter::Inconsistent {
                name: "restitution",
                found: "given beside `alpha`".to_owned(),
                expected: "only one of `alpha`, `restitution`".to_owned(),
                reason: "each of them sets the dashpot",
            }),
            (Some(alpha), None) => Ok(Self { alpha }),
            (None, Some(restitution)) => Ok(Self::from_restitution(restitution)),
            (None, None) => Err(InvalidParameter::Missing { name: "restitution" }),
        }
    }
}

impl ViscousLaw for Tsuji {
    #[inline(always)]
    fn coefficient<R: Real>(&self, pair: &Pair<R>, _overlap: R, normal: &NormalResponse<R>) -> R {
        let square = R::splat(2.0 / 3.0) * normal.stiffness / pair.inverse_reduced_mass();
        R::splat(self.alpha) * square.sqrt()
    }

    fn largest_coefficient(&self, pair: &Pair<f64>, max_stiffness: f64) -> f64 {
        self.alpha * (2.0 / 3.0 * max_stiffness * pair.reduced_mass()).sqrt()
    }

    const NEEDS_STIFFNESS: bool = true;
}
