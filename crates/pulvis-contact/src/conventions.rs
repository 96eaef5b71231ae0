//! Choices in which codes with the same laws differ, by name.

use pulvis_math::Real;

use crate::catalogue::{Choice, InvalidParameter, Law, LawEntry, Parameter, Role, Values};
use crate::friction::SpringRotation;

/// The normal force to which the Coulomb limits refer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrictionReference {
    /// f_hys + kc δ, the distance from the tensile limit, without dashpot (Luding 2008).
    #[default]
    AdhesiveLimit,
    /// |f_hys + γ dδ/dt|: with the dashpot, without the attraction, which MercuryDPM adds after
    /// friction and YADE does not have.
    Total,
    /// |f_hys + γ dδ/dt + kc δ − f_a|: also the attraction is subtracted (LIGGGHTS).
    TotalAdhesiveLimit,
}

/// The lever arms of the contact point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LeverArm {
    /// a' = a − δ/2 (Luding 2008).
    #[default]
    Corrected,
    /// a. The arms then add up to more than the distance of the centres: a pair that turns as one
    /// body slides by δ times its angle, and its angular momentum is not conserved.
    Radius,
}

/// The length L that turns angular velocities into the rolling and torsion velocities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RollingLever {
    /// a12 = 2 a_i a_j/(a_i + a_j), of a wall contact 2 a_i.
    #[default]
    Harmonic,
    /// a'_i a'_j/(a'_i + a'_j) with corrected radii, of a wall contact a'_i (Luding 2008, eq. 15).
    Reduced,
}

/// What the dashpot of a spring-slider sees while the contact slides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SlipDashpot {
    /// The rate of the spring: the slider stands in series with spring and dashpot. Passive for every dashpot, speed
    /// and time step.
    #[default]
    Series,
    /// The whole sliding speed, ξ = −(f + γ v)/k (Luding 2008, eq. 20, as printed). Where γ v exceeds the Coulomb
    /// limit, the spring is stretched against the motion and energy comes from nothing.
    Printed,
}

/// All choices of one contact. The default is what Luding 2008 is read to say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Conventions {
    /// The normal force to which the Coulomb limits refer.
    pub friction_reference: FrictionReference,
    /// The lever arms of the contact point.
    pub lever_arm: LeverArm,
    /// The length that turns angular velocities into rolling and torsion velocities.
    pub rolling_lever: RollingLever,
    /// How springs follow the contact when it turns in space.
    pub spring_rotation: SpringRotation,
    /// What the dashpot of a spring-slider sees while the contact slides.
    pub slip_dashpot: SlipDashpot,
}

impl Conventions {
    /// The normal force of the Coulomb limits [N], from the law's own reference f_hys + kc δ, the
    /// hysteretic force, the dashpot's force and the attraction.
    #[inline(always)]
    pub(crate) fn friction_reference<R: Real>(&self, limit: R, elastic: R, viscous: R, attraction: R) -> R {
        match self.friction_reference {
            FrictionReference::AdhesiveLimit => limit,
            FrictionReference::Total => (elastic + viscous).abs(),
            FrictionReference::TotalAdhesiveLimit => (limit + viscous + attraction).abs(),
        }
    }
}

impl Law for Conventions {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Conventions,
        name: "conventions",
        summary: "choices in which codes with the same laws differ",
        equations: "see the choices",
        source: "Luding, Granular Matter 10, 235 (2008), eqs. 11-20; the source texts of LIGGGHTS-PUBLIC 3.8, MercuryDPM and YADE for the alternatives",
        parameters: &[
            Parameter::choice(
                "friction_reference",
                "",
                &[
                    Choice {
                        name: "adhesive-limit",
                        meaning: "f_hys + k_c δ without the dashpot (Luding 2008)",
                    },
                    Choice {
                        name: "total",
                        meaning: "|f_hys + γ dδ/dt|, without attraction (MercuryDPM, YADE)",
                    },
                    Choice {
                        name: "total-adhesive-limit",
                        meaning: "|f_hys + γ dδ/dt + k_c δ − f_a| (LIGGGHTS)",
                    },
                ],
                "adhesive-limit",
                "the normal force that Coulomb limits refer to",
            ),
            Parameter::choice(
                "lever_arm",
                "",
                &[
                    Choice { name: "corrected", meaning: "a' = a − δ/2 (Luding 2008)" },
                    Choice { name: "radius", meaning: "a; does not conserve angular momentum" },
                ],
                "corrected",
                "the lever arms of the contact point",
            ),
            Parameter::choice(
                "rolling_lever",
                "L",
                &[
                    Choice {
                        name: "harmonic",
                        meaning: "L = a12 = 2 a_i a_j/(a_i + a_j), at a wall 2 a_i (MercuryDPM)",
                    },
                    Choice {
                        name: "reduced",
                        meaning: "L = a'_i a'_j/(a'_i + a'_j), at a wall a'_i (Luding 2008, eq. 15)",
                    },
                ],
                "harmonic",
                "the length that turns spins into rolling and torsion velocities; a factor 2 in L is a factor 4 in k_r, γ_r and 2 in μ_r",
            ),
            Parameter::choice(
                "spring_rotation",
                "",
                &[
                    Choice {
                        name: "rescale",
                        meaning: "projected into the tangent plane, length restored (Luding 2008, eq. 17)",
                    },
                    Choice { name: "project", meaning: "projected only (LIGGGHTS)" },
                    Choice {
                        name: "twist",
                        meaning: "turned with the normal, and about it with the mean spin (YADE)",
                    },
                    Choice {
                        name: "rate",
                        meaning: "the normal part that each step brings is removed (MercuryDPM)",
                    },
                ],
                "rescale",
                "how sliding and rolling springs follow the contact when it turns",
            ),
            Parameter::choice(
                "slip_dashpot",
                "",
                &[
                    Choice {
                        name: "series",
                        meaning: "the rate of the spring: slider in series with spring and dashpot, passive",
                    },
                    Choice {
                        name: "printed",
                        meaning: "the sliding speed, ξ = −(f + γ v)/k (Luding 2008, eq. 20); creates energy where γ v exceeds the limit",
                    },
                ],
                "series",
                "what dashpots against sliding, rolling and torsion see while the contact slips",
            ),
        ],
        particle_quantities: &[],
        memory: &[],
        closed_form: "rigid rotation of a stuck pair changes neither spring nor energy (conformance suite)",
        example: "friction_reference = \"adhesive-limit\"\nspring_rotation = \"rescale\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self {
            friction_reference: match values.choice("friction_reference")? {
                "total" => FrictionReference::Total,
                "total-adhesive-limit" => FrictionReference::TotalAdhesiveLimit,
                _ => FrictionReference::AdhesiveLimit,
            },
            lever_arm: match values.choice("lever_arm")? {
                "radius" => LeverArm::Radius,
                _ => LeverArm::Corrected,
            },
            rolling_lever: match values.choice("rolling_lever")? {
                "reduced" => RollingLever::Reduced,
                _ => RollingLever::Harmonic,
            },
            spring_rotation: match values.choice("spring_rotation")? {
                "project" => SpringRotation::Project,
                "twist" => SpringRotation::Twist,
                "rate" => SpringRotation::Rate,
                _ => SpringRotation::Rescale,
            },
            slip_dashpot: match values.choice("slip_dashpot")? {
                "printed" => SlipDashpot::Printed,
                _ => SlipDashpot::Series,
            },
        })
    }
}
