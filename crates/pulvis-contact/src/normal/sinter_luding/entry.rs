//! The description of the law.

use pulvis_math::Dimension;

use super::SinterLuding;
use crate::catalogue::{Choice, InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::normal::sintering::{K1, KC, KP, PHI_F, Stiffnesses};

const TEMPERATURE: Dimension = Dimension::TEMPERATURE;

impl Law for SinterLuding {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "sinter-luding",
        summary: "law of Luding with a plastic stiffness that follows the temperature",
        equations: "\
k_T = (k1/2) [1 + tanh((T_m − T)/ΔT)],  dk/dt = ∓(k_T/t_0) (1 − k/k_T)²      − while k > k_T, + while k < k_T
f   = k2 (δ − δ_0)               on the line that the contact keeps
f   ≤ k δ, kp (δ − δ_p) + k δ_p  loading and flow, k2 = max(k2, k + (kp − k) δ/δ_p),  δ_p = kp/(kp − k1) φ_f a12
f   ≥ −kc δ                      tensile limit; published: f, D of luding with k for k1",
        source: "Luding, Manetsberger & Müllers, J. Mech. Phys. Solids 53, 455 (2005), not confirmed against the original: k_T and its rate as recalled; the kept line derived for this program",
        parameters: &[
            K1,
            KP,
            KC,
            PHI_F,
            Parameter::number("t_melt", "T_m", TEMPERATURE, Range::Positive, "temperature of melting"),
            Parameter::number(
                "t_width",
                "ΔT",
                TEMPERATURE,
                Range::Positive,
                "half the width of melting: k_T is 0.88 k1 at T_m − ΔT and 0.12 k1 at T_m + ΔT",
            ),
            Parameter::number("time_scale", "t_0", Dimension::TIME, Range::Positive, "time scale of sintering"),
            Parameter::choice(
                "variant",
                "",
                &[
                    Choice { name: "passive", meaning: "a contact keeps its elastic line; heating dissipates" },
                    Choice { name: "published", meaning: "a contact keeps its largest overlap; creates energy" },
                ],
                "passive",
                "what a loaded contact keeps when k changes",
            ),
        ],
        particle_quantities: &[],
        memory: &[
            "plastic_stiffness [N/m]",
            "elastic_stiffness [N/m]",
            "rest [m]",
            "overlap_max [m]",
            "depth [m]",
        ],
        closed_form: "k after heating and cooling, k_T at two temperatures (pulvis verify)",
        example: "law = \"sinter-luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"20 N/m\"\nphi_f = 0.2\nt_melt = \"500 K\"\nt_width = \"10 K\"\ntime_scale = \"1e-3 s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let Stiffnesses { k1, kp, kc, phi_f } = Stiffnesses::from_values(values, false)?;
        Ok(Self {
            k1,
            kp,
            kc,
            phi_f,
            melting: values.number("t_melt")?,
            width: values.number("t_width")?,
            time_scale: values.number("time_scale")?,
            published: values.choice("variant")? == "published",
        })
    }
}
