//! Adhesive visco-elastic spheres: the law of Johnson, Kendall and Roberts with the dissipation of the material.

use pulvis_math::{Dimension, Real};

use super::dmt::WORK_OF_ADHESION;
use super::hertz::EFFECTIVE_MODULUS;
use super::jkr::Jkr;
use super::{NormalLaw, NormalResponse};
use crate::catalogue::{Choice, InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

/// The force of [`Jkr`] and a viscous one, F = F_JKR + A (dF_JKR/dδ) dδ/dt, with the dissipative time A of the material.
///
/// dF/dδ = 2 E* a (y³ − 3)/(y³ − 1), y = √(a/a_sep), is negative between the pull-off force and the break of the neck.
/// There the viscous force as published pushes bodies apart that part: it creates energy. The `passive` form, the
/// default, leaves it out there. The `published` form acts as the impulse A dF_JKR of each step, in which the slope that
/// grows without bound before the break costs nothing; its restitution still converges slowly with the time step. Its
/// work, negative where it creates energy, is booked as adhesive.
///
/// Slow bodies stick, fast ones lose much: the restitution has a maximum in between.
///
/// # Source
/// N. V. Brilliantov, N. Albers, F. Spahn, T. Pöschel, Phys. Rev. E 76, 051302 (2007). The passive form is of this program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViscoelasticJkr {
    elastic: Jkr,
    /// Dissipative time A [s].
    dissipative_time: f64,
    /// Whether the viscous force is that of the publication also where it creates energy.
    published: bool,
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ViscoelasticJkrMemory<R> {
    /// That of [`Jkr`]: cube root of the effective radius while the bodies are attached [m^(1/3)].
    pub cube_root_radius: R,
    /// Elastic force of the last step, for the published form [N].
    pub force: R,
    /// Viscous force of the last step, for the published form [N].
    pub viscous_force: R,
}

impl<R: Real> Memory<R> for ViscoelasticJkrMemory<R> {
    const COLUMNS: usize = 3;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { cube_root_radius: column(0), force: column(1), viscous_force: column(2) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.cube_root_radius);
        column(1, self.force);
        column(2, self.viscous_force);
    }
}

impl Law for ViscoelasticJkr {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "viscoelastic-jkr",
        summary: "adhesive visco-elastic spheres",
        equations: "\
F   = F_JKR + A (dF_JKR/dδ) dδ/dt          dF_JKR/dδ = 2 E* a (y³ − 3)/(y³ − 1),  y = √(a/a_sep)
passive: the viscous force acts for y³ > 3 only, up to the pull-off force
published: everywhere; between pull-off and separation it creates energy",
        source: "Brilliantov, Albers, Spahn & Pöschel, Phys. Rev. E 76, 051302 (2007); the attribution of the form could not be confirmed against the original, the passive form is of this program",
        parameters: &[
            EFFECTIVE_MODULUS,
            WORK_OF_ADHESION,
            Parameter::number(
                "dissipative_time",
                "A",
                Dimension::TIME,
                Range::NonNegative,
                "dissipative time of the material",
            ),
            Parameter::choice(
                "variant",
                "",
                &[
                    Choice {
                        name: "passive",
                        meaning: "no viscous force where the elastic one has passed its pull-off",
                    },
                    Choice {
                        name: "published",
                        meaning: "viscous force everywhere; creates energy before separation",
                    },
                ],
                "passive",
                "where the viscous force acts",
            ),
        ],
        particle_quantities: &[],
        memory: &["cube_root_radius [m^(1/3)]", "previous_force [N]", "viscous_force [N]"],
        closed_form: "restitution from an integrated equation of motion (tests of the law); without A that of `jkr`",
        example: "law = \"viscoelastic-jkr\"\neffective_modulus = \"1e9 Pa\"\nwork_of_adhesion = \"0.05 N/m\"\ndissipative_time = \"5e-10 s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self {
            elastic: Jkr::new(values.number("effective_modulus")?, values.number("work_of_adhesion")?),
            dissipative_time: values.number("dissipative_time")?,
            published: values.choice("variant")? == "published",
        })
    }
}

impl ViscoelasticJkr {
    /// The viscous impulse over the step, A dF/dt, and its work, by the trapezoidal rule as the time integration does it.
    #[inline(always)]
    fn add_impulse<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        stays: R::Mask,
        memory: &mut ViscoelasticJkrMemory<R>,
        answer: &mut NormalResponse<R>,
    ) {
        let rate = R::splat(self.dissipative_time / motion.time_step);
        let viscous = (rate * (answer.force - memory.force)).keep_where(stays);
        answer.applied_force += viscous;
        answer.dissipated_adhesive += R::splat(0.5) * (viscous + memory.viscous_force) * motion.growth;
        memory.viscous_force = viscous;
    }
}

impl NormalLaw for ViscoelasticJkr {
    type Memory<R: Real> = ViscoelasticJkrMemory<R>;

    const PATH_ONLY: bool = false;

    #[inline(always)]
    fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut ViscoelasticJkrMemory<R>,
    ) -> NormalResponse<R> {
        let (zero, one) = (R::zero(), R::one());
        let mut root = [memory.cube_root_radius];
        let was_attached = root[0].gt(zero);
        let (mut answer, cube) = self.elastic.on_curve(motion, &mut root);
        memory.cube_root_radius = root[0];
        // y³ > 3 far from the pole at y³ = 1; where nothing acts the stiffness is zero.
        let rising = (cube - R::splat(3.0)).max(zero) / (cube - one).max(one);
        let viscous = R::splat(self.dissipative_time) * answer.stiffness;
        if !self.published {
            answer.dashpot = viscous * rising;
            return answer;
        }
        if motion.time_step > 0.0 {
            self.add_impulse(motion, answer.in_contact & was_attached, memory, &mut answer);
        } else {
            // A look without a step knows rates only.
            let slope = (cube - R::splat(3.0)) / (cube - one).max(R::splat(f64::EPSILON));
            answer.dashpot = viscous * slope;
        }
        memory.force = answer.force;
        answer
    }

    fn interaction_range(&self, pair: &Pair<f64>) -> f64 {
        self.elastic.interaction_range(pair)
    }

    const HAS_DASHPOT: bool = true;

    fn dashpot(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        self.dissipative_time * self.max_stiffness(pair, expected)
    }

    fn is_passive(&self) -> bool {
        !self.published
    }

    fn branch(
        &self,
        pair: &Pair<f64>,
        overlap: f64,
        memory: &ViscoelasticJkrMemory<f64>,
    ) -> (u8, &'static str) {
        self.elastic.branch(pair, overlap, &[memory.cube_root_radius])
    }

    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        self.elastic.max_stiffness(pair, expected)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;

    fn expected_contact_radius(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        self.elastic.expected_contact_radius(pair, expected)
    }
}
