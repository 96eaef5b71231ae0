//! No dashpot.

use pulvis_math::Real;

use super::ViscousLaw;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Role, Values};
use crate::normal::NormalResponse;
use crate::pair::Pair;

/// No dashpot beyond what the normal law has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct None;

impl Law for None {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Viscosity,
        name: "none",
        summary: "no dashpot",
        equations: "f = 0",
        source: "none needed",
        parameters: &[],
        particle_quantities: &[],
        memory: &[],
        closed_form: "the coefficient is zero",
        example: "law = \"none\"",
    };

    fn from_values(_values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self)
    }
}

impl ViscousLaw for None {
    #[inline(always)]
    fn coefficient<R: Real>(&self, _pair: &Pair<R>, _overlap: R, _normal: &NormalResponse<R>) -> R {
        R::zero()
    }

    fn largest_coefficient(&self, _pair: &Pair<f64>, _max_stiffness: f64) -> f64 {
        0.0
    }
}
