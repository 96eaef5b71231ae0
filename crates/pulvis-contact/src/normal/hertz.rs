//! The elastic law of Hertz.

use pulvis_math::{Dimension, Real, elementary};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values, mixing};
use crate::expected::ExpectedLoading;
use crate::friction::CommonFriction;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Elastic spheres: F = (4/3) E* √R δ^(3/2) with the contact radius a = √(R δ) and the potential U = (2/5) F δ.
///
/// R = a_i a_j/(a_i + a_j) is the effective radius, half the harmonic mean a12. Valid for δ ≪ R. The slope
/// dF/dδ = 2 E* a grows without bound, so the time step follows from the loading that is expected.
///
/// # Source
/// H. Hertz, J. reine angew. Math. 92, 156 (1882); K. L. Johnson, *Contact Mechanics* (1985), eqs. (4.22)-(4.23).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hertz {
    /// Effective modulus E* [Pa].
    pub effective_modulus: f64,
}

pub(crate) const EFFECTIVE_MODULUS: Parameter = Parameter::number(
    "effective_modulus",
    "E*",
    Dimension::PRESSURE,
    Range::Positive,
    "effective modulus, 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j",
)
.from_materials(&mixing::EFFECTIVE_MODULUS);

impl Law for Hertz {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "hertz",
        summary: "elastic spheres",
        equations: "\
F   = (4/3) E* √R δ^(3/2)        for δ > 0,  R = a_i a_j/(a_i + a_j)
a   = √(R δ),  U = (2/5) F δ     contact radius and potential",
        source: "Hertz, J. reine angew. Math. 92, 156 (1882); Johnson, Contact Mechanics (1985), eqs. 4.22-4.23",
        parameters: &[EFFECTIVE_MODULUS],
        particle_quantities: &[],
        memory: &[],
        closed_form: "largest overlap, force and duration of a collision in pulvis_contact::theory::hertz",
        example: "law = \"hertz\"\neffective_modulus = \"1e8 Pa\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { effective_modulus: values.number("effective_modulus")? })
    }
}

/// The effective radius R, half the harmonic mean [m].
pub(super) fn effective_radius(pair: &Pair) -> f64 {
    0.5 * pair.harmonic_radius()
}

/// The overlap of elastic spheres of effective modulus `modulus` [Pa] under the expected loading [m]: the largest one
/// that the speed, the force and the overlap give.
pub(super) fn expected_overlap(modulus: f64, pair: &Pair, expected: &ExpectedLoading) -> f64 {
    let radius = effective_radius(pair);
    let stiffness = 4.0 / 3.0 * modulus * radius.sqrt();
    let energy = expected.speed * expected.speed * pair.reduced_mass();
    let of_speed = elementary::powf(1.25 * energy / stiffness, 0.4);
    let of_force = elementary::powf(expected.force / stiffness, 2.0 / 3.0);
    of_speed.max(of_force).max(expected.overlap * radius)
}

impl NormalLaw for Hertz {
    type Memory<R: Real> = ();

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, _memory: &mut ()) -> NormalResponse<R> {
        let depth = motion.depth;
        // √(R δ), R = a12/2.
        let inverse_radius = R::splat(2.0) * motion.pair.inverse_harmonic_radius();
        let contact_radius = (depth / inverse_radius).sqrt();
        let stiffness = R::splat(2.0 * self.effective_modulus) * contact_radius;
        let force = R::splat(2.0 / 3.0) * stiffness * depth;
        let stored_energy = R::splat(0.4) * force * depth;
        NormalResponse { contact_radius, ..NormalResponse::elastic(motion, force, stored_energy, stiffness) }
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, _memory: &()) -> (u8, &'static str) {
        if overlap <= 0.0 { (0, "open") } else { (1, "elastic") }
    }

    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        2.0 * self.effective_modulus * self.expected_contact_radius(pair, expected)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;

    const COMMON_SLIDING: CommonFriction = CommonFriction::Mindlin;

    fn expected_contact_radius(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        (effective_radius(pair) * expected_overlap(self.effective_modulus, pair, expected)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_is_that_of_two_published_examples() {
        // E* [Pa], R [m], δ [m], F [N]: largest overlap and force of two collisions.
        let cases = [
            (1e8, 5e-4, 1.223_935_453_0e-5, 0.127_661_960_95),
            (2e11, 5e-3, 1.636_227_916_0e-5, 1_248.013_925_761_9),
        ];
        for (effective_modulus, radius, overlap, force) in cases {
            let pair = Pair::wall(1e-6, radius);
            let law = Hertz { effective_modulus };
            let answer = law.respond(&NormalMotion::at_rest(&pair, overlap), &mut ());
            // The overlaps are given to eleven digits.
            assert!((answer.force / force - 1.0).abs() < 1e-9, "{} {force}", answer.force);
            assert!((answer.contact_radius / (radius * overlap).sqrt() - 1.0).abs() < 1e-15);
        }
    }
}
