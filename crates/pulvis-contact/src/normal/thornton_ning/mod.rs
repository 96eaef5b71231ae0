//! The law of Thornton and Ning for adhesive, elastic-perfectly plastic spheres.

use std::f64::consts::PI;

use pulvis_math::{Dimension, Real, elementary};

use super::dmt::WORK_OF_ADHESION_OR_NONE;
use super::hertz::{EFFECTIVE_MODULUS, effective_radius, expected_overlap};
use super::{NormalLaw, NormalResponse};
use crate::catalogue::{Choice, InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

mod adhesive;
mod dry;

use adhesive::Adhesive;
use dry::Dry;

/// Elastic spheres with adhesion whose contact pressure is limited to p_y: the pressure of Johnson, Kendall and Roberts,
/// cut off at p_y, gives the force while the contact yields; unloading follows their curve with a greater radius R_p.
///
/// ```text
/// F   = π a² [(2/3) p1 σ³ − 2 p2 σ + p_y (1 − σ²)]           p1 = 2 E* a/(π R), p2 = √(2 Γ E*/(π a))
/// σ   = [p_y + √(p_y² + 4 p1 p2)]/(2 p1)                     (`closed`; the published increments: σ = a_y/a)
/// R_p = 4 E* a_max³/(3 [F_max + √(8 π Γ E* a_max³)]),        δ_p = a_max² (1/R − 1/R_p)
/// ```
///
/// A contact that has yielded breaks at δ_sep = δ_p − 3 a_sep²(R_p)/R_p and sets in again at δ_p. Its past is kept
/// until it is apart with δ <= 0. Below 1.26 (E*² Γ/(π² R))^(1/3), where adhesion alone makes the contact yield at
/// touch, the limiting pressure counts as that. Γ = 0 gives the law without adhesion.
///
/// What snap-in and snap-off lose is booked as adhesive, what yielding loses as plastic: the work of the curve less what
/// unloading gives back, for steps of any size.
///
/// # Source
/// C. Thornton, Z. Ning, Powder Technol. 99, 154 (1998). The closed form, its energies and the rule for setting in again
/// are derived here; the published increments differ by up to 1.5 % in the slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThorntonNing {
    mode: Mode,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    Dry(Dry),
    Adhesive(Adhesive),
}

/// The memory of the law. With adhesion, radii are kept as √(a/a_sep); without, as a/a_y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ThorntonNingMemory<R> {
    /// Cube root of the effective radius while anything is remembered; zero without adhesion [m^(1/3)].
    pub cube_root_radius: R,
    /// The radius at which the contact yielded; zero while it has not [1].
    pub yield_radius: R,
    /// The largest radius of a contact that has yielded; zero while it has not [1].
    pub largest_radius: R,
    /// One while adhesion holds the bodies [1].
    pub attached: R,
}

impl<R: Real> Memory<R> for ThorntonNingMemory<R> {
    const COLUMNS: usize = 4;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        let (cube_root_radius, yield_radius) = (column(0), column(1));
        Self { cube_root_radius, yield_radius, largest_radius: column(2), attached: column(3) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.cube_root_radius);
        column(1, self.yield_radius);
        column(2, self.largest_radius);
        column(3, self.attached);
    }
}

impl Law for ThorntonNing {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "thornton-ning",
        summary: "adhesive elastic-perfectly plastic spheres",
        equations: "\
elastic    F, δ of jkr until the pressure in the middle reaches p_y,  p_y = 2 E* a_y/(π R) − √(2 Γ E*/(π a_y))
yielding   F = π a² [(2/3) p1 σ³ − 2 p2 σ + p_y (1 − σ²)],  σ = [p_y + √(p_y² + 4 p1 p2)]/(2 p1)
           p1 = 2 E* a/(π R),  p2 = √(2 Γ E*/(π a));  published: σ = a_y/a in dF;  Γ = 0: F_y + π p_y (a² − a_y²)
unloading  F, δ − δ_p of jkr with R_p = 4 E* a_max³/(3 [F_max + √(8 π Γ E* a_max³)]),  δ_p = a_max² (1/R − 1/R_p)
p_y counts as at least 1.26 (E*² Γ/(π² R))^(1/3)",
        source: "Thornton & Ning, Powder Technol. 99, 154 (1998); closed form and energies derived for this program",
        parameters: &[
            EFFECTIVE_MODULUS,
            Parameter::number(
                "yield_pressure",
                "p_y",
                Dimension::PRESSURE,
                Range::Positive,
                "limiting contact pressure, 1.6 to 3 times the yield stress",
            ),
            WORK_OF_ADHESION_OR_NONE,
            Parameter::choice(
                "variant",
                "",
                &[
                    Choice { name: "closed", meaning: "the pressure cut off at p_y, integrated exactly" },
                    Choice { name: "published", meaning: "the published increments, in which the cut stays at a_y" },
                ],
                "closed",
                "the force while the contact yields; the same without adhesion",
            ),
        ],
        particle_quantities: &[],
        memory: &["cube_root_radius [m^(1/3)]", "yield_radius [1]", "largest_radius [1]", "attached [1]"],
        closed_form: "yield velocity and restitution without adhesion in pulvis_contact::theory::thornton_ning; pull-off and restitution of published collisions (tests of the law)",
        example: "law = \"thornton-ning\"\neffective_modulus = \"1e9 Pa\"\nyield_pressure = \"3e7 Pa\"\nwork_of_adhesion = \"0.05 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let (modulus, pressure) = (values.number("effective_modulus")?, values.number("yield_pressure")?);
        let adhesion = values.number("work_of_adhesion")?;
        Ok(Self::new(modulus, pressure, adhesion, values.choice("variant")? == "published"))
    }
}

impl ThorntonNing {
    /// Effective modulus E* and limiting pressure p_y [Pa], work of adhesion Γ of both surfaces together [J/m²], and whether
    /// the force of yielding is that of the published increments.
    pub fn new(effective_modulus: f64, yield_pressure: f64, work_of_adhesion: f64, published: bool) -> Self {
        let dry = Dry { modulus: effective_modulus, pressure: yield_pressure };
        if work_of_adhesion > 0.0 {
            return Self { mode: Mode::Adhesive(Adhesive::new(dry, work_of_adhesion, published)) };
        }
        Self { mode: Mode::Dry(dry) }
    }

    fn dry(&self) -> &Dry {
        match &self.mode {
            Mode::Dry(dry) => dry,
            Mode::Adhesive(adhesive) => &adhesive.dry,
        }
    }
}

impl NormalLaw for ThorntonNing {
    type Memory<R: Real> = ThorntonNingMemory<R>;

    const PATH_ONLY: bool = false;

    #[inline(always)]
    fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut ThorntonNingMemory<R>,
    ) -> NormalResponse<R> {
        match &self.mode {
            Mode::Dry(dry) => dry.respond(motion, memory),
            Mode::Adhesive(adhesive) => adhesive.respond(motion, memory),
        }
    }

    fn interaction_range(&self, pair: &Pair<f64>) -> f64 {
        match &self.mode {
            Mode::Dry(_) => 0.0,
            Mode::Adhesive(adhesive) => 3.0 * adhesive.unit(elementary::cbrt(effective_radius(pair))),
        }
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &ThorntonNingMemory<f64>) -> (u8, &'static str) {
        match &self.mode {
            Mode::Dry(dry) => dry.branch(pair, overlap, memory),
            Mode::Adhesive(adhesive) => adhesive.branch(pair, overlap, memory),
        }
    }

    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        2.0 * self.dry().modulus * self.expected_contact_radius(pair, expected)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;

    /// That at the overlap to which the spheres are pressed: yielding bodies deeper than elastic ones.
    fn expected_contact_radius(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        let (dry, radius) = (self.dry(), effective_radius(pair));
        // Of a force π R p_y δ.
        let slope = PI * radius * dry.pressure;
        let overlap = expected_overlap(dry.modulus, pair, expected)
            .max(expected.speed * (pair.reduced_mass() / slope).sqrt())
            .max(expected.force / slope);
        match &self.mode {
            Mode::Dry(_) => (radius * overlap).sqrt(),
            Mode::Adhesive(adhesive) => adhesive.contact_radius(radius, overlap),
        }
    }
}
