//! The law of Dahneke for elastic spheres that van der Waals forces flatten.

use pulvis_math::Dimension;

use super::attracted_spheres::{AttractedSpheres, attracted_spheres};
use super::hertz::EFFECTIVE_MODULUS;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::noncontact::{HAMAKER, Z0};

/// Elastic spheres whose van der Waals attraction grows with the flattened area:
/// F = (4/3) E* √R δ^(3/2) − A_H R/(6 z0²) (1 + c δ/z0) for δ > 0, a = √(R δ).
///
/// c = 2 counts the spherical cap as flat area (a² = 2 R δ), c = 1 the area of Hertz. The force is least at
/// δ = (2 B/(3 k_H))² with B = c A_H R/(6 z0³), k_H = (4/3) E* √R: −(A_H R/(6 z0²) + (4/27) B³/k_H²). With the
/// attraction `hamaker` the force at touch would count twice.
///
/// The law is conservative, and its force jumps at touch as that of [`Dmt`](super::Dmt).
///
/// # Source
/// B. Dahneke, J. Colloid Interface Sci. 40, 1 (1972). The coefficient c could not be confirmed against the original.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dahneke {
    spheres: AttractedSpheres,
}

impl Law for Dahneke {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "dahneke",
        summary: "elastic spheres whose van der Waals attraction grows with the flattened area",
        equations: "\
F   = (4/3) E* √R δ^(3/2) − F_0 (1 + c δ/z0)   for δ > 0,  F_0 = A_H R/(6 z0²)
a   = √(R δ)                                   contact radius;  friction refers to (4/3) E* √R δ^(3/2)
U   = (8/15) E* √R δ^(5/2) − F_0 δ (1 + c δ/(2 z0))",
        source: "Dahneke, J. Colloid Interface Sci. 40, 1 (1972); the coefficient c could not be confirmed against the original",
        parameters: &[
            EFFECTIVE_MODULUS,
            HAMAKER,
            Z0,
            Parameter::number(
                "flattening",
                "c",
                Dimension::NONE,
                Range::NonNegative,
                "flattened area over π R δ: 2 for a spherical cap, 1 for the area of Hertz",
            )
            .or(2.0),
        ],
        particle_quantities: &[],
        memory: &[],
        closed_form: "force of published examples, least force and its overlap (tests of the law)",
        example: "law = \"dahneke\"\neffective_modulus = \"1e9 Pa\"\nhamaker = \"6.5e-20 J\"\nz0 = \"4e-10 m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let (hamaker, z0) = (values.number("hamaker")?, values.number("z0")?);
        let attraction = hamaker / (6.0 * z0 * z0);
        let growth = values.number("flattening")? / z0;
        let modulus = values.number("effective_modulus")?;
        Ok(Self { spheres: AttractedSpheres { modulus, attraction, growth } })
    }
}

attracted_spheres!(Dahneke);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::NormalMotion;
    use crate::normal::NormalLaw;
    use crate::pair::Pair;

    fn law(modulus: f64, hamaker: f64, z0: f64, flattening: f64) -> Dahneke {
        let attraction = hamaker / (6.0 * z0 * z0);
        Dahneke { spheres: AttractedSpheres { modulus, attraction, growth: flattening / z0 } }
    }

    #[test]
    fn the_force_is_that_of_two_published_examples() {
        // E* [Pa], R [m], A_H [J], δ [m], F(δ) and force at touch [N]; z0 = 0.4 nm, c = 2.
        let cases = [
            (1e9, 1e-6, 6.5e-20, 1e-9, -3.6408629786442157e-07, -6.770833333333333e-08),
            (7e10, 5e-7, 1e-19, 2e-10, 8.249999999999999e-08, -5.2083333333333327e-08),
        ];
        for (modulus, radius, hamaker, overlap, force, at_touch) in cases {
            let (law, pair) = (law(modulus, hamaker, 4e-10, 2.0), Pair::wall(1e-6, radius));
            let at = |overlap: f64| law.respond(&NormalMotion::at_rest(&pair, overlap), &mut ()).force;
            // The square of the second example's δ^(3/2) has lost a digit.
            assert!((at(overlap) / force - 1.0).abs() < 1e-14, "{}", at(overlap));
            assert!((at(1e-30) / at_touch - 1.0).abs() < 1e-14, "{}", at(1e-30));
        }
    }

    #[test]
    fn the_force_is_least_where_the_closed_form_says() {
        let (modulus, radius, hamaker, z0) = (1e9, 1e-6, 6.5e-20, 4e-10);
        let (law, pair) = (law(modulus, hamaker, z0, 2.0), Pair::wall(1e-6, radius));
        let at = |overlap: f64| law.respond(&NormalMotion::at_rest(&pair, overlap), &mut ()).force;
        let (mut low, mut high) = (1e-12, 1e-7);
        for _ in 0..200 {
            let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if at(left) < at(right) { high = right } else { low = left }
        }
        let stiffness = 4.0 / 3.0 * modulus * radius.sqrt();
        let b = 2.0 * hamaker * radius / (6.0 * z0 * z0 * z0);
        let least = -(hamaker * radius / (6.0 * z0 * z0) + 4.0 / 27.0 * b * b * b / (stiffness * stiffness));
        assert!((at(low) / least - 1.0).abs() < 1e-12, "{} {least}", at(low));
        // A minimum is found to the square root of round-off.
        let overlap = (2.0 * b / (3.0 * stiffness)) * (2.0 * b / (3.0 * stiffness));
        assert!((low / overlap - 1.0).abs() < 1e-6, "{low} {overlap}");
    }
}
