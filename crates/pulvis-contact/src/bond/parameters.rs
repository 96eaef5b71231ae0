//! The parameters that bonds of every criterion have.

use pulvis_math::Dimension;

use crate::catalogue::{Choice, Parameter, Range};

/// A moment, or a stiffness against rotation: 1 J = 1 N m.
pub(super) const MOMENT: Dimension = Dimension::ENERGY;

/// A list of parameters: those of a criterion, then those that all bonds have.
macro_rules! with_common {
    ($($own:expr,)*) => {
        &[
            $($own,)*
            $crate::bond::parameters::FORM,
            $crate::bond::parameters::DISTANCE,
            $crate::bond::parameters::CONTACT_SPRING,
            $crate::bond::parameters::STIFFNESSES[0],
            $crate::bond::parameters::STIFFNESSES[1],
            $crate::bond::parameters::STIFFNESSES[2],
            $crate::bond::parameters::STIFFNESSES[3],
            $crate::bond::parameters::YOUNG_MODULUS,
            $crate::bond::parameters::POISSON_RATIO,
            $crate::bond::parameters::BEAM_THEORY,
            $crate::bond::parameters::PER_AREA[0],
            $crate::bond::parameters::PER_AREA[1],
            $crate::bond::parameters::SECTION[0],
            $crate::bond::parameters::SECTION[1],
            $crate::bond::parameters::DASHPOTS[0],
            $crate::bond::parameters::DASHPOTS[1],
            $crate::bond::parameters::DASHPOTS[2],
            $crate::bond::parameters::DASHPOTS[3],
            $crate::bond::parameters::DAMPING_TIME,
        ]
    };
}
pub(super) use with_common;

pub(super) const FORM: Parameter = Parameter::choice(
    "form",
    "",
    &[
        Choice {
            name: "stage-start",
            meaning: "at the start of each stage that forms bonds, between bodies within `distance`",
        },
        Choice { name: "first-touch", meaning: "when two bodies touch for the first time" },
    ],
    "stage-start",
    "when bonds form; bodies whose bond has broken are never bonded again",
);

pub(super) const DISTANCE: Parameter = Parameter::number(
    "distance",
    "d",
    Dimension::LENGTH,
    Range::NonNegative,
    "largest distance of the surfaces at which a bond forms at the start of a stage",
)
.or(0.0);

pub(super) const CONTACT_SPRING: Parameter = Parameter::choice(
    "contact_spring",
    "",
    &[
        Choice { name: "on", meaning: "all laws of the contact act beside the bond" },
        Choice {
            name: "off",
            meaning: "only the bond acts; after breaking the contact begins without force at its overlap",
        },
    ],
    "on",
    "what becomes of the contact's own laws while two bodies are bonded",
);

pub(super) const STIFFNESSES: [Parameter; 4] = [
    Parameter::number(
        "normal_stiffness",
        "k_n",
        Dimension::STIFFNESS,
        Range::Positive,
        "stiffness along the line of centres; in its place a beam or stiffnesses per area may be given",
    )
    .optional(),
    Parameter::number(
        "shear_stiffness",
        "k_s",
        Dimension::STIFFNESS,
        Range::NonNegative,
        "stiffness against shear, beside normal_stiffness; without it 0",
    )
    .optional(),
    Parameter::number(
        "bending_stiffness",
        "k_b",
        MOMENT,
        Range::NonNegative,
        "moment over the angle of bending, beside normal_stiffness (1 J = 1 N m); without it 0",
    )
    .optional(),
    Parameter::number(
        "torsion_stiffness",
        "k_o",
        MOMENT,
        Range::NonNegative,
        "moment over the angle of torsion, beside normal_stiffness (1 J = 1 N m); without it 0",
    )
    .optional(),
];

pub(super) const YOUNG_MODULUS: Parameter = Parameter::number(
    "young_modulus",
    "E",
    Dimension::PRESSURE,
    Range::Positive,
    "Young's modulus of a beam from centre to centre",
)
.optional();

pub(super) const POISSON_RATIO: Parameter = Parameter::number(
    "poisson_ratio",
    "ν",
    Dimension::NONE,
    // Strictly above −1; 1/2 is incompressible.
    Range::Within(-1.0, 0.5),
    "Poisson's ratio of the beam",
)
.or(0.3);

pub(super) const BEAM_THEORY: Parameter = Parameter::choice(
    "beam_theory",
    "",
    &[
        Choice {
            name: "timoshenko",
            meaning: "shear deforms the beam, Φ = 12 E I/(κ G A L²), κ = 6 (1 + ν)/(7 + 6 ν)",
        },
        Choice { name: "euler-bernoulli", meaning: "shear does not deform the beam, Φ = 0" },
    ],
    "timoshenko",
    "whether shear deforms the beam",
);

pub(super) const PER_AREA: [Parameter; 2] = [
    Parameter::number(
        "normal_stiffness_per_area",
        "K_n",
        Dimension::STIFFNESS_PER_AREA,
        Range::Positive,
        "normal stiffness over the cross-section: k_n = K_n A, k_b = K_n I",
    )
    .optional(),
    Parameter::number(
        "shear_stiffness_per_area",
        "K_s",
        Dimension::STIFFNESS_PER_AREA,
        Range::NonNegative,
        "shear stiffness over the cross-section: k_s = K_s A, k_o = K_s J; without it 0",
    )
    .optional(),
];

pub(super) const SECTION: [Parameter; 2] = [
    Parameter::number(
        "bond_radius",
        "r",
        Dimension::LENGTH,
        Range::Positive,
        "radius of the cross-section of a beam or of stiffnesses per area",
    )
    .optional(),
    Parameter::number(
        "radius_ratio",
        "λ",
        Dimension::NONE,
        Range::Positive,
        "radius of the cross-section over that of the smaller body, in place of bond_radius",
    )
    .optional(),
];

pub(super) const DASHPOTS: [Parameter; 4] = [
    Parameter::number(
        "normal_dashpot",
        "γ_n",
        Dimension::DASHPOT,
        Range::NonNegative,
        "dashpot along the line of centres",
    )
    .or(0.0),
    Parameter::number(
        "shear_dashpot",
        "γ_s",
        Dimension::DASHPOT,
        Range::NonNegative,
        "dashpot against shear",
    )
    .or(0.0),
    Parameter::number(
        "bending_dashpot",
        "γ_b",
        Dimension::ROTATIONAL_DASHPOT,
        Range::NonNegative,
        "dashpot against bending (1 kg m^2/s = 1 N m s)",
    )
    .or(0.0),
    Parameter::number(
        "torsion_dashpot",
        "γ_o",
        Dimension::ROTATIONAL_DASHPOT,
        Range::NonNegative,
        "dashpot against torsion (1 kg m^2/s = 1 N m s)",
    )
    .or(0.0),
];

pub(super) const DAMPING_TIME: Parameter = Parameter::number(
    "damping_time",
    "τ",
    Dimension::TIME,
    Range::NonNegative,
    "adds a dashpot τ k to every spring of stiffness k",
)
.or(0.0);
