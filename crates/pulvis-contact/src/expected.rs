//! What contacts are expected to go through: for laws that grow stiffer without bound.

use pulvis_math::Dimension;

use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};

/// What contacts are expected to go through. A law without a steepest slope, as that of Hertz, takes from it the
/// stiffness that the automatic time step resolves: the largest one of those that the three give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedLoading {
    /// Speed at which bodies meet [m/s].
    pub speed: f64,
    /// Normal force that contacts carry [N].
    pub force: f64,
    /// Overlap over the effective radius R = a_i a_j/(a_i + a_j) [1].
    pub overlap: f64,
}

/// One per cent of the radius: much more is beyond the range of contact laws anyway.
const OVERLAP: f64 = 0.01;

impl Default for ExpectedLoading {
    fn default() -> Self {
        Self { speed: 0.0, force: 0.0, overlap: OVERLAP }
    }
}

impl Law for ExpectedLoading {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Expected,
        name: "expected",
        summary: "what contacts are expected to go through, for the automatic time step",
        equations: "\
δ_v = (5 m_r v²/(4 k_H))^(2/5)   of the speed v,  k_H = (4/3) E* √R
δ_F = (F/k_H)^(2/3)              of the force F
δ_x = x R                        of the relative overlap x;  the largest of the three counts",
        source: "Hertz 1882; energy balance of a collision",
        parameters: &[
            Parameter::number(
                "speed",
                "v",
                Dimension::VELOCITY,
                Range::NonNegative,
                "speed at which bodies meet",
            )
            .or(0.0),
            Parameter::number(
                "force",
                "F",
                Dimension::FORCE,
                Range::NonNegative,
                "normal force of a contact",
            )
            .or(0.0),
            Parameter::number(
                "overlap",
                "x",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "overlap over the effective radius",
            )
            .or(OVERLAP),
        ],
        particle_quantities: &[],
        memory: &[],
        closed_form: "overlap of a Hertz collision in pulvis_contact::theory::hertz",
        example: "speed = \"1 m/s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self {
            speed: values.number("speed")?,
            force: values.number("force")?,
            overlap: values.number("overlap")?,
        })
    }
}
