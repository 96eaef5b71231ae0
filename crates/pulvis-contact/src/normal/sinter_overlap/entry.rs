//! The description of the law.

use pulvis_math::Dimension;

use super::SinterOverlap;
use crate::catalogue::{Choice, InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::sintering::{K1, KC, KP, PHI_F, Stiffnesses};

impl Law for SinterOverlap {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "sinter-overlap",
        summary: "elastic contact about a plastic overlap that grows with time, and a sintering force",
        equations: "\
f   = f_e − σ_s a12                 f_e = k2 (δ − δ_p),  k2 = k1 (1 + s δ_p),  s = (kp/k1 − 1)/(φ_f a12)
δ_p ≥ δ − 1/s                       plastic loading, f_e = k1 δ, up to δ_p = φ_f a12
f_e = −kc δ                         where that is larger; δ_p then shrinks
dδ_p/dt = 2 r f_e/σ_s               growth = \"constant\";  r f_e/(0.375 σ_s (δ/a12)²) for \"parhami-mcmeeking\"",
        source: "Parhami & McMeeking, Mech. Mater. 27, 111 (1998), in the form of public code; energies derived for this program",
        parameters: &[
            K1,
            KP,
            KC,
            PHI_F,
            Parameter::number(
                "sinter_tension",
                "σ_s",
                Dimension::STIFFNESS,
                Range::Positive,
                "sintering force over a12, of the size of the surface tension (0.01 to 1 N/m)",
            ),
            Parameter::number("rate", "r", Dimension::RATE, Range::NonNegative, "rate of sintering"),
            Parameter::choice(
                "growth",
                "",
                &[
                    Choice { name: "constant", meaning: "2 r f_e/σ_s at any neck" },
                    Choice {
                        name: "parhami-mcmeeking",
                        meaning: "r f_e/(0.375 σ_s (δ/a12)²): necks grow with the cube root of time",
                    },
                ],
                "constant",
                "how fast the plastic overlap grows",
            ),
        ],
        particle_quantities: &[],
        memory: &["plastic_overlap [m]"],
        closed_form: "necks after 1 s and 8 s under the sintering force (pulvis verify)",
        example: "law = \"sinter-overlap\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"20 N/m\"\nphi_f = 0.2\nsinter_tension = \"0.1 N/m\"\nrate = \"1e-3 1/s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let Stiffnesses { k1, kp, kc, phi_f } = Stiffnesses::from_values(values, true)?;
        Ok(Self {
            k1,
            kp,
            kc,
            phi_f,
            sinter_tension: values.number("sinter_tension")?,
            rate: values.number("rate")?,
            parhami: values.choice("growth")? == "parhami-mcmeeking",
        })
    }
}
