//! The description of the law.

use pulvis_math::Dimension;

use super::Rathbone;
use super::curve::Curve;
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::EFFECTIVE_MODULUS;

/// The largest S_y/E*: beyond it the fits are far from the metals that they are made for.
const MOST_STRAIN: f64 = 0.05;

impl Law for Rathbone {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "rathbone",
        summary: "elastic-plastic spheres by fits to finite elements",
        equations: "\
F/P_c = w^(3/2)                                               to w_y,  w = δ/w_c,  w_c = c² R,  P_c = (4/3) E* R² c³
F/P_c = e^(−w^(5/12)/4) w^(3/2) + (4 H/(C S_y)) [1 − e^(−w^(5/9)/25)] w    beyond, where it is less
c     = π C S_y/(2 E*),  C = 1.295 e^(0.736 ν),  H/S_y = 2.84 − 0.92 [1 − cos(π a/R)]
a     = √(R δ (w/1.9)^B),  B = 0.14 e^(23 S_y/E*)
F     = F_m ((δ − δ_r)/(δ_m − δ_r))^n                         unloading from δ_m, w_m > 1
δ_r   = δ_m (1 − w_m^(−0.28)) (1 − w_m^(−0.69)),  n = 1.5 w_m^(−0.0331), more up to about 1.1 w_y",
        source: "Jackson & Green, J. Tribol. 127, 343 (2005); Etsion, Kligerman & Kadin, Int. J. Solids Struct. 42, 3716 (2005); not confirmed against the originals. They stand in for Rathbone, Marigo, Dini & van Wachem, Powder Technol. 282, 2 (2015), whose coefficients were not to be had",
        parameters: &[
            EFFECTIVE_MODULUS,
            Parameter::number(
                "yield_stress",
                "S_y",
                Dimension::PRESSURE,
                Range::Positive,
                "yield stress of the softer body, at most 0.05 E*",
            ),
            Parameter::number(
                "poisson_ratio",
                "ν",
                Dimension::NONE,
                Range::Between(0.0, 0.5),
                "Poisson's ratio of the softer body",
            ),
        ],
        particle_quantities: &[],
        memory: &["overlap_max [m]", "residual [m]", "exponent [1]", "force_max [N]"],
        closed_form: "forces, residual overlaps and exponents of published examples (pulvis verify)",
        example: "law = \"rathbone\"\neffective_modulus = \"2.2e11 Pa\"\nyield_stress = \"1e9 Pa\"\npoisson_ratio = 0.3",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let (modulus, stress) = (values.number("effective_modulus")?, values.number("yield_stress")?);
        let strain = stress / modulus;
        if strain > MOST_STRAIN {
            return Err(InvalidParameter::Inconsistent {
                name: "yield_stress",
                found: format!("{stress} Pa"),
                expected: format!("at most {MOST_STRAIN} E* = {} Pa", MOST_STRAIN * modulus),
                reason: "the fits are those of metals, whose yield stress is a hundredth of their modulus",
            });
        }
        Ok(Self { modulus, curve: Curve::new(strain, values.number("poisson_ratio")?) })
    }
}
