//! The law of Derjaguin, Muller and Toporov for adhesive elastic spheres.

use std::f64::consts::PI;

use pulvis_math::Dimension;

use super::attracted_spheres::{AttractedSpheres, attracted_spheres};
use super::hertz::EFFECTIVE_MODULUS;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};

/// Elastic spheres with a constant pull-off force: F = (4/3) E* √R δ^(3/2) − 2 π Γ R for δ > 0, a = √(R δ).
///
/// For hard, small, weakly adhesive spheres (Tabor number (R Γ²/(E*² z0³))^(1/3) below about 0.1); softer ones follow
/// [`Jkr`](super::Jkr). The law is conservative: without a tail, a dashpot or plastic flow bodies never stick. With
/// the attraction `hamaker` its own pull-off force must be left out there.
///
/// The force jumps at touch; a step in which it sets in or ends applies it for the part of the step in which it acted.
///
/// # Source
/// B. V. Derjaguin, V. M. Muller, Y. P. Toporov, J. Colloid Interface Sci. 53, 314 (1975).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dmt {
    spheres: AttractedSpheres,
}

const fn adhesion(range: Range) -> Parameter {
    let meaning = "work of adhesion of both surfaces together, 2 γ_s for equal materials (1 J/m² = 1 N/m)";
    Parameter::number("work_of_adhesion", "Γ", Dimension::STIFFNESS, range, meaning)
}

/// Work of adhesion Γ of both surfaces together.
pub(super) const WORK_OF_ADHESION: Parameter = adhesion(Range::Positive);

/// The same of a law that also does without.
pub(super) const WORK_OF_ADHESION_OR_NONE: Parameter = adhesion(Range::NonNegative).or(0.0);

impl Law for Dmt {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "dmt",
        summary: "elastic spheres with a constant pull-off force",
        equations: "\
F   = (4/3) E* √R δ^(3/2) − 2 π Γ R    for δ > 0,  R = a_i a_j/(a_i + a_j)
a   = √(R δ)                           contact radius;  friction refers to F + 2 π Γ R
U   = (8/15) E* √R δ^(5/2) − 2 π Γ R δ",
        source: "Derjaguin, Muller & Toporov, J. Colloid Interface Sci. 53, 314 (1975)",
        parameters: &[EFFECTIVE_MODULUS, WORK_OF_ADHESION],
        particle_quantities: &[],
        memory: &[],
        closed_form: "force and pull-off of published examples; a collision without loss (tests of the law)",
        example: "law = \"dmt\"\neffective_modulus = \"1e9 Pa\"\nwork_of_adhesion = \"0.1 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self::new(values.number("effective_modulus")?, values.number("work_of_adhesion")?))
    }
}

impl Dmt {
    /// Effective modulus E* [Pa] and work of adhesion Γ of both surfaces together [J/m²].
    pub fn new(effective_modulus: f64, work_of_adhesion: f64) -> Self {
        let attraction = 2.0 * PI * work_of_adhesion;
        Self { spheres: AttractedSpheres { modulus: effective_modulus, attraction, growth: 0.0 } }
    }
}

attracted_spheres!(Dmt);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::NormalMotion;
    use crate::normal::NormalLaw;
    use crate::pair::Pair;

    #[test]
    fn the_force_and_the_pull_off_are_those_of_two_published_examples() {
        // E* [Pa], R [m], Γ [J/m²], δ [m], F(δ) and pull-off [N].
        let cases = [
            (1e9, 1e-6, 0.1, 5e-9, -1.5691400992692698e-07, -6.283185307179586e-07),
            (7e10, 1e-7, 0.02, 1e-10, 1.6948220880545705e-08, -1.2566370614359173e-08),
        ];
        for (modulus, radius, adhesion, overlap, force, pull_off) in cases {
            let (law, pair) = (Dmt::new(modulus, adhesion), Pair::wall(1e-6, radius));
            let at = |overlap: f64| law.respond(&NormalMotion::at_rest(&pair, overlap), &mut ());
            // Differences of numbers of the size of the pull-off force.
            assert!((at(overlap).force - force).abs() < 1e-14 * -pull_off, "{}", at(overlap).force);
            assert!((at(1e-30).force / pull_off - 1.0).abs() < 1e-14, "{}", at(1e-30).force);
            assert_eq!(at(0.0).force, 0.0);
        }
    }
}
