//! The reversible linear attraction.

use pulvis_math::{Dimension, Real};

use super::{NonContactLaw, NonContactResponse, branch_by_distance, linear_tail};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::events;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Reversible attraction that grows linearly from δ_a = −f_a/k_c^a to contact and is constant in
/// contact: f = −f_a for δ > 0, −k_c^a δ − f_a for δ_a < δ <= 0, zero beyond. Continuous and
/// conservative; an infinite k_c^a leaves the constant force in contact alone, which jumps at touch: a step in which it
/// does applies it for the part of the step in which it acted.
///
/// # Source
/// A. Singh, V. Magnanimo, S. Luding, arXiv:1503.03720 ("S1"), eq. (14).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reversible {
    /// Adhesion force f_a, the largest attraction [N].
    pub f_a: f64,
    /// Slope k_c^a of the attraction at a distance [N/m].
    pub kc_a: f64,
}

pub(super) const PARAMETERS: &[Parameter] = &[
    Parameter::number(
        "f_a",
        "f_a",
        Dimension::FORCE,
        Range::NonNegative,
        "adhesion force, the attraction at touch",
    ),
    Parameter::number(
        "kc_a",
        "k_c^a",
        Dimension::STIFFNESS,
        Range::Positive,
        "slope of the attraction at a distance; its range is f_a/kc_a, inf means none",
    )
    .or_infinite(),
];

impl Law for Reversible {
    const ENTRY: LawEntry = LawEntry {
        role: Role::NonContact,
        name: "reversible",
        summary: "linear attraction at a distance, the same on approach and on separation",
        equations: "\
f   = −f_a                       for δ > 0
f   = −k_c^a δ − f_a             for δ_a < δ ≤ 0,  δ_a = −f_a/k_c^a
f   = 0                          for δ ≤ δ_a",
        source: "Singh, Magnanimo & Luding, arXiv:1503.03720, eq. 14",
        parameters: PARAMETERS,
        particle_quantities: &[],
        memory: &[],
        closed_form: "pull-in and pull-off efficiencies ε_i, ε_o in pulvis_contact::theory (S1 eqs. 17, 18)",
        example: "law = \"reversible\"\nf_a = \"1e-5 N\"\nkc_a = \"50 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { f_a: values.number("f_a")?, kc_a: values.number("kc_a")? })
    }
}

impl Reversible {
    /// How far beyond touching the attraction acts, f_a/k_c^a [m].
    pub fn range(&self) -> f64 {
        self.f_a / self.kc_a
    }
}

impl NonContactLaw for Reversible {
    type Memory<R: Real> = ();

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, _memory: &mut ()) -> NonContactResponse<R> {
        let (force, potential) = linear_tail(self.f_a, self.kc_a, motion.overlap);
        let jumps = self.range() <= 0.0 && self.f_a > 0.0;
        let at_touch = R::splat(-self.f_a);
        let applied_force = if jumps { events::while_touching(motion, force, at_touch) } else { force };
        NonContactResponse { force, applied_force, potential, dissipated: R::zero() }
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        self.range()
    }

    fn max_stiffness(&self, _pair: &Pair<f64>) -> f64 {
        if self.kc_a.is_finite() { self.kc_a } else { 0.0 }
    }

    fn acts_on_approach(&self) -> bool {
        true
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, _memory: &()) -> (u8, &'static str) {
        branch_by_distance(overlap, self.range(), "attraction")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(overlap: f64) -> NormalMotion<f64> {
        NormalMotion::at_rest(&Pair::wall(1e-6, 1e-3), overlap)
    }

    #[test]
    fn the_repulsion_is_the_slope_of_the_potential_over_the_overlap() {
        let law = Reversible { f_a: 1e-4, kc_a: 50.0 };
        let h = 1e-10;
        for overlap in [-2.5e-6, -1.9e-6, -0.3e-6, 0.4e-6, 3e-6] {
            let answer = |overlap: f64| law.respond(&at(overlap), &mut ());
            let slope = (answer(overlap + h).potential - answer(overlap - h).potential) / (2.0 * h);
            // Central differences of a parabola are exact up to round-off: 1e-16 fa²/kca / h.
            assert!((answer(overlap).force - slope).abs() < 1e-9, "at {overlap}");
        }
    }

    #[test]
    fn the_force_is_continuous_at_touch_and_at_the_end_of_its_reach() {
        let law = Reversible { f_a: 1e-4, kc_a: 50.0 };
        let force = |overlap: f64| law.respond(&at(overlap), &mut ()).force;
        assert_eq!(force(-law.range()), 0.0);
        assert_eq!(force(0.0), -1e-4);
        assert_eq!(force(1e-9), -1e-4);
    }
}
