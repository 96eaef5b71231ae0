//! The description of the law.

use pulvis_math::{Dimension, elementary};

use super::{Adhesion, Eepa};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::functions::Power;

impl Law for Eepa {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "eepa",
        summary: "Edinburgh elasto-plastic adhesive contact",
        equations: "\
f = −f_0 + k1 δ^n                loading
f = −f_0 + k2 (δ^n − δ_p^n)      un-/re-loading,  k2 = k1/(1 − λ_p),  δ_p = λ_p^(1/n) δ_max
f = −f_0 − k_adh δ^x             where that is larger; δ_p then shrinks with δ
k_adh = f_min/δ_min^x            f_min = (3/2) π Δγ √(2 δ_p R) ≤ ½ k2 δ_p^n,  δ_min^n = δ_p^n − f_min/k2
k1 δ^n = k1 δ (δ/ℓ)^(n−1),  k_adh δ^x = k_adh δ (δ/ℓ)^(x−1)",
        source: "Thakur, Morrissey, Sun, Chen & Ooi, Granular Matter 16, 383 (2014); the exponent x of the adhesive limit after Morrissey (2013), not confirmed against the original",
        parameters: &[
            Parameter::number(
                "k1",
                "k₁",
                Dimension::STIFFNESS,
                Range::Positive,
                "loading stiffness: (4/3) E* √R with n = 1.5, 2 E* R with n = 1",
            ),
            Parameter::number(
                "lambda_p",
                "λ_p",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "plasticity 1 − k1/k2, below 1",
            ),
            Parameter::number("exponent", "n", Dimension::NONE, Range::AtLeast(1.0), "exponent of loading, at most 3")
                .or(1.5),
            Parameter::number(
                "adhesion_exponent",
                "x",
                Dimension::NONE,
                Range::AtLeast(1.0),
                "exponent of the adhesive limit, at most 20; without it that of loading",
            )
            .optional(),
            Parameter::number("f_0", "f_0", Dimension::FORCE, Range::NonNegative, "constant pull of bodies that touch")
                .or(0.0),
            Parameter::number(
                "surface_energy",
                "Δγ",
                Dimension::STIFFNESS,
                Range::NonNegative,
                "adhesive surface energy (1 J/m^2 = 1 N/m); sets k_adh",
            )
            .optional(),
            Parameter::number(
                "k_adh",
                "k_adh",
                Dimension::STIFFNESS,
                Range::NonNegative,
                "constant stiffness of the adhesive limit, in place of a surface energy",
            )
            .optional(),
            Parameter::number(
                "reference_overlap",
                "ℓ",
                Dimension::LENGTH,
                Range::Positive,
                "overlap at which k1 and k_adh are the stiffnesses; with 1 m their numbers are N/m^n and N/m^x",
            )
            .or(1.0),
        ],
        particle_quantities: &[],
        memory: &["plastic_overlap [m]", "adhesion_stiffness [N/m^x]"],
        closed_form: "restitution without adhesion in pulvis_contact::theory::eepa; whole cycles (law_eepa)",
        example: "law = \"eepa\"\nk1 = \"1e6 N/m\"\nlambda_p = 0.5\nsurface_energy = \"1 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let adhesion = match (values.optional_number("surface_energy"), values.optional_number("k_adh")) {
            (Some(_), Some(_)) => {
                return Err(InvalidParameter::Inconsistent {
                    name: "k_adh",
                    found: "given beside `surface_energy`".to_owned(),
                    expected: "only one of `surface_energy`, `k_adh`".to_owned(),
                    reason: "each of them sets the adhesive limit",
                });
            }
            (Some(energy), None) => Adhesion::SurfaceEnergy(energy),
            (None, Some(stiffness)) => Adhesion::Stiffness(stiffness),
            (None, None) => return Err(InvalidParameter::Missing { name: "surface_energy" }),
        };
        let exponent = at_most(3.0, "exponent", values.number("exponent")?)?;
        let of_adhesion = values.optional_number("adhesion_exponent").unwrap_or(exponent);
        let adhesion_exponent = at_most(20.0, "adhesion_exponent", of_adhesion)?;
        let lambda_p = values.number("lambda_p")?;
        if lambda_p >= 1.0 {
            return Err(InvalidParameter::Inconsistent {
                name: "lambda_p",
                found: lambda_p.to_string(),
                expected: "less than 1".to_owned(),
                reason: "k2 = k1/(1 - lambda_p) must be finite",
            });
        }
        let reference = values.number("reference_overlap")?;
        let k1 = values.number("k1")? * elementary::powf(reference, 1.0 - exponent);
        let power = Power::new(exponent);
        Ok(Self {
            k1,
            k2: k1 / (1.0 - lambda_p),
            lambda_p,
            plastic_share: power.inverse(lambda_p),
            power,
            slope_power: Power::new(exponent - 1.0),
            adhesion_power: Power::new(adhesion_exponent),
            f_0: values.number("f_0")?,
            adhesion: match adhesion {
                Adhesion::Stiffness(stiffness) => {
                    Adhesion::Stiffness(stiffness * elementary::powf(reference, 1.0 - adhesion_exponent))
                }
                energy @ Adhesion::SurfaceEnergy(_) => energy,
            },
        })
    }
}

fn at_most(most: f64, name: &'static str, exponent: f64) -> Result<f64, InvalidParameter> {
    if exponent <= most {
        return Ok(exponent);
    }
    Err(InvalidParameter::Inconsistent {
        name,
        found: exponent.to_string(),
        expected: format!("at most {most}"),
        reason: "powers of small overlaps would leave the range of numbers",
    })
}
