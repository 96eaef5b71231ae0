//! The description of Tomas' law.

use pulvis_math::Dimension;

use super::{Flow, Tomas};
use crate::catalogue::{Choice, InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::hertz::EFFECTIVE_MODULUS;

const VARIANTS: &[Choice] = &[
    Choice { name: "continuous", meaning: "the line of flow with p_vdw (h - h_f)" },
    Choice { name: "published", meaning: "the line of flow with p_vdw h, which jumps at h_f" },
];

const fn pressure(name: &'static str, symbol: &'static str, meaning: &'static str) -> Parameter {
    Parameter::number(name, symbol, Dimension::PRESSURE, Range::Positive, meaning)
}

impl Law for Tomas {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "tomas",
        summary: "stiff particles with soft contacts: elastic, flowing, adhesive",
        equations: "\
F = (2/3) E_T √(r h³) − F_H0              elastic, h ≤ h_f = r (π p_f/E_T)²;  E_T = 2 E*,  F_H0 = C_H r/(6 a_0²)
F = π r (κ_A p_f − p_vdw) h − F_H0        flow;  κ_A = 1 − (h_f/h)^(1/3)/3;  `continuous`: p_vdw (h − h_f)
F = F_A + (2/3) E_T √(r (h − h_A)³) λ     un-/re-loading;  F_A = −π r p_vdw h_A − F_H0
F = −F_H0 q² − π r p_vdw h_A q³           apart, q = a_0/(a_0 + h_A − h);  h_A = 0 on approach
λ = (1 − (1 − x_m)^(3/2))/x_m^(3/2)       x_m: largest (h − h_A)/(h_U − h_A) since full unloading;  1 after flow",
        source: "Tomas, KONA 18, 157 (2000); Part. Sci. Technol. 19, 95 (2001); Granular Matter 6, 75 (2004); the equations could not be confirmed against the originals; partial reversals, cutoff and the limit of F_H0 of very small contacts are choices of this program",
        parameters: &[
            EFFECTIVE_MODULUS,
            pressure("yield_pressure", "p_f", "pressure at which the contact flows, 1e8 to 1e9 Pa"),
            pressure(
                "vdw_pressure",
                "p_vdw",
                "van der Waals pressure in the flattened contact, below 2/3 of the yield pressure",
            ),
            Parameter::number(
                "hamaker",
                "C_H",
                Dimension::ENERGY,
                Range::Positive,
                "Hamaker constant, 1e-20 to 4e-19 J",
            ),
            Parameter::number("a0", "a_0", Dimension::LENGTH, Range::Positive, "distance of surfaces in contact")
                .or(3.36e-10),
            Parameter::number(
                "cutoff",
                "s_c",
                Dimension::LENGTH,
                // Beyond, van der Waals forces are retarded, and nothing is left of them.
                Range::Within(0.0, 1e-6),
                "gap beyond which nothing acts, at least 10 a_0",
            )
            .or(1e-8),
            Parameter::choice("variant", "", VARIANTS, "continuous", "the line of flow"),
        ],
        particle_quantities: &[],
        memory: &["yield_overlap [m]", "pull_off_overlap [m]", "reloaded [m]"],
        closed_form: "points of all branches (law_tomas)",
        example: "law = \"tomas\"\neffective_modulus = \"5e9 Pa\"\nyield_pressure = \"4e8 Pa\"\nvdw_pressure = \"6e7 Pa\"\nhamaker = \"1e-19 J\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let modulus = 2.0 * values.number("effective_modulus")?;
        let (yields, vdw) = (values.number("yield_pressure")?, values.number("vdw_pressure")?);
        if vdw >= 2.0 / 3.0 * yields {
            return Err(InvalidParameter::Inconsistent {
                name: "vdw_pressure",
                found: format!("{vdw} Pa"),
                expected: format!("less than 2/3 yield_pressure = {} Pa", 2.0 / 3.0 * yields),
                reason: "otherwise the contact flows without a load",
            });
        }
        let distance = values.number("a0")?;
        let cutoff = values.number("cutoff")?;
        if cutoff < 10.0 * distance {
            return Err(InvalidParameter::Inconsistent {
                name: "cutoff",
                found: format!("{cutoff} m"),
                expected: format!("at least 10 a0 = {} m", 10.0 * distance),
                reason: "the attraction is not small there yet",
            });
        }
        let jumps = values.choice("variant")? == "published";
        Ok(Self {
            modulus,
            vdw_pressure: vdw,
            adhesion: values.number("hamaker")? / (6.0 * distance * distance),
            distance,
            cutoff,
            flow: Flow::new(modulus, [yields, vdw], [distance, cutoff], jumps),
        })
    }
}
