//! No attraction at a distance.

use pulvis_math::Real;

use super::{NonContactLaw, NonContactResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Role, Values};
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// No attraction beyond what the normal law has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct None;

impl Law for None {
    const ENTRY: LawEntry = LawEntry {
        role: Role::NonContact,
        name: "none",
        summary: "no attraction at a distance",
        equations: "f = 0",
        source: "none needed",
        parameters: &[],
        particle_quantities: &[],
        memory: &[],
        closed_form: "the force is zero (unit test)",
        example: "law = \"none\"",
    };

    fn from_values(_values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self)
    }
}

impl NonContactLaw for None {
    type Memory<R: Real> = ();

    #[inline(always)]
    fn respond<R: Real>(&self, _motion: &NormalMotion<R>, _memory: &mut ()) -> NonContactResponse<R> {
        NonContactResponse::default()
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        0.0
    }

    fn max_stiffness(&self, _pair: &Pair<f64>) -> f64 {
        0.0
    }

    fn acts_on_approach(&self) -> bool {
        false
    }

    fn branch(&self, _pair: &Pair<f64>, _overlap: f64, _memory: &()) -> (u8, &'static str) {
        (0, "none")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(overlap: f64) -> NormalMotion<f64> {
        NormalMotion::at_rest(&Pair::wall(1e-6, 1e-3), overlap)
    }

    #[test]
    fn without_a_law_there_is_no_force_at_any_distance() {
        for overlap in [-1.0, 0.0, 1.0] {
            assert_eq!(None.respond(&at(overlap), &mut ()), NonContactResponse::default());
        }
    }
}
