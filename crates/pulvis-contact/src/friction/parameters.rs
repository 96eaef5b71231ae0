//! Parameters that several laws against sliding and torsion have.

use pulvis_math::Dimension;

use crate::catalogue::{Parameter, Range, mixing};

pub(super) const EFFECTIVE_SHEAR_MODULUS: Parameter = Parameter::number(
    "effective_shear_modulus",
    "G*",
    Dimension::PRESSURE,
    Range::Positive,
    "effective shear modulus, 1/G* = (2 − ν_i)/G_i + (2 − ν_j)/G_j",
)
.from_materials(&mixing::EFFECTIVE_SHEAR_MODULUS);

pub(super) const MU: Parameter =
    Parameter::number("mu", "μ", Dimension::NONE, Range::NonNegative, "coefficient of sliding friction");

pub(super) const GAMMA_T: Parameter = Parameter::number(
    "gamma_t",
    "γ_t",
    Dimension::DASHPOT,
    Range::NonNegative,
    "coefficient of the tangential dashpot",
)
.or(0.0);
