//! No attraction at a distance.

use pulvis_math::Real;

use super::{NonContactLaw, NonContactResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Role, Values};

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
        memory: &[],
        closed_form: "the force is zero (unit test)",
        example: "law = \"none\"",
    };

    fn from_values(_values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self)
    }
}

impl NonContactLaw for None {
    #[inline(always)]
    fn respond<R: Real>(&self, _overlap: R, _touched: &mut R) -> NonContactResponse<R> {
        NonContactResponse::default()
    }

    fn interaction_range(&self) -> f64 {
        0.0
    }

    fn max_stiffness(&self) -> f64 {
        0.0
    }

    fn remembers_touch(&self) -> bool {
        false
    }

    fn branch(&self, _overlap: f64, _touched: f64) -> (u8, &'static str) {
        (0, "none")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_law_there_is_no_force_at_any_distance() {
        for overlap in [-1.0, 0.0, 1.0] {
            assert_eq!(None.respond(overlap, &mut 0.0), NonContactResponse::default());
        }
    }
}
