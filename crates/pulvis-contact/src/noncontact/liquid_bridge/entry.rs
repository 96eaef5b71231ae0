//! The description of the law.

use std::f64::consts::FRAC_PI_2;

use pulvis_math::Dimension;

use super::{LIQUID, LiquidBridge};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};

impl Law for LiquidBridge {
    const ENTRY: LawEntry = LawEntry {
        role: Role::NonContact,
        name: "liquid-bridge",
        summary: "capillary attraction that sets in at touch and ends where the bridge breaks",
        equations: "\
f   = −F_0                                in contact, δ ≥ 0,  F_0 = 2 π R_w σ cos θ
f   = −F_0/(1 + 1.05 x + 2.5 x²)          after a touch, S = −δ < S_c,  x = S √(R_w/V)
S_c = (1 + θ/2) V^(1/3)                   rupture;  R_w = 2 a_i a_j/(a_i + a_j)
V   : `volume`, or φ (V_i + V_j)          of the liquid on both bodies; walls are dry",
        source: "Willett, Adams, Johnson & Seville, Langmuir 16, 9396 (2000), simplified; rupture after Lian, Thornton & Adams, J. Colloid Interface Sci. 161, 138 (1993), not confirmed against the original",
        parameters: &[
            Parameter::number("volume", "V", Dimension::VOLUME, Range::Positive, "volume of every bridge").optional(),
            Parameter::number(
                "liquid_share",
                "φ",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "in place of volume: share of the liquid of each body that a bridge takes (equal spheres: 0.067)",
            )
            .optional(),
            Parameter::number(
                "surface_tension",
                "σ",
                Dimension::STIFFNESS,
                Range::Positive,
                "surface tension of the liquid (water: 0.072 N/m)",
            ),
            Parameter::number(
                "contact_angle",
                "θ",
                Dimension::NONE,
                Range::Between(0.0, FRAC_PI_2),
                "contact angle of the liquid on the bodies [rad]",
            )
            .or(0.0),
        ],
        particle_quantities: &[Parameter::number(
            LIQUID,
            "V_i",
            Dimension::VOLUME,
            Range::NonNegative,
            "liquid on a particle",
        )
        .optional()],
        memory: &["bridge [1]"],
        closed_form: "force, rupture distance and rupture work of published examples (tests of the law)",
        example: "law = \"liquid-bridge\"\nvolume = \"1e-12 m^3\"\nsurface_tension = \"0.072 N/m\"\ncontact_angle = 0.35",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let tension = values.number("surface_tension")?;
        let angle = values.number("contact_angle")?;
        match (values.optional_number("volume"), values.optional_number("liquid_share")) {
            (Some(_), Some(_)) => Err(InvalidParameter::Inconsistent {
                name: "liquid_share",
                found: "given beside `volume`".to_owned(),
                expected: "only one of `volume`, `liquid_share`".to_owned(),
                reason: "each of them says how much liquid a bridge has",
            }),
            (Some(volume), None) => Ok(Self::new(volume, tension, angle)),
            (None, Some(share)) => Ok(Self::shared(share, tension, angle)),
            (None, None) => Err(InvalidParameter::Inconsistent {
                name: "volume",
                found: "not given".to_owned(),
                expected: "one of `volume`, `liquid_share`".to_owned(),
                reason: "a bridge has some liquid",
            }),
        }
    }
}
