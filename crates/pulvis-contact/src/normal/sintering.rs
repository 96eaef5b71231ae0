//! Parameters that both sintering laws have.

use pulvis_math::Dimension;

use crate::catalogue::{InvalidParameter, Parameter, Range, Values};

pub(super) const K1: Parameter = Parameter::number(
    "k1",
    "k₁",
    Dimension::STIFFNESS,
    Range::Positive,
    "stiffness of plastic (virgin) loading, when cold",
);

pub(super) const KP: Parameter = Parameter::number(
    "kp",
    "k_p",
    Dimension::STIFFNESS,
    Range::Positive,
    "largest elastic stiffness; not below k1",
);

pub(super) const KC: Parameter = Parameter::number(
    "kc",
    "k_c",
    Dimension::STIFFNESS,
    Range::NonNegative,
    "minus the slope of the tensile limit",
);

pub(super) const PHI_F: Parameter = Parameter::number(
    "phi_f",
    "φ_f",
    Dimension::NONE,
    Range::Within(0.0, 1.0),
    "plasticity depth: largest force-free overlap, of cold contacts, over the harmonic mean radius a12",
);

/// The stiffnesses and the plasticity depth of a contact.
pub(super) struct Stiffnesses {
    pub k1: f64,
    pub kp: f64,
    pub kc: f64,
    pub phi_f: f64,
}

impl Stiffnesses {
    /// Refuses a contact that unloads more softly than it was loaded; one that unloads as stiffly where it `must_harden`.
    pub fn from_values(values: &Values, must_harden: bool) -> Result<Self, InvalidParameter> {
        let (k1, kp) = (values.number("k1")?, values.number("kp")?);
        if kp < k1 || (must_harden && kp <= k1) {
            let (sign, reason) = if must_harden {
                (">", "a plastic overlap that does not stiffen the contact has no end")
            } else {
                let reason =
                    "a contact unloads at least as stiffly as it was loaded, otherwise it creates energy";
                (">=", reason)
            };
            return Err(InvalidParameter::Inconsistent {
                name: "kp",
                found: format!("{kp} N/m"),
                expected: format!("kp {sign} k1 = {k1} N/m"),
                reason,
            });
        }
        Ok(Self { k1, kp, kc: values.number("kc")?, phi_f: values.number("phi_f")? })
    }
}
