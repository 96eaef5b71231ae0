//! Elastic-plastic rolling resistance, whose stiffness follows that of the normal force.

use pulvis_math::{Dimension, Real};

use super::force_memory::{Linear, SeriesSlider};
use super::{ContactScale, FrictionLaw, FrictionResponse, SpringMotion, Tangent};
use crate::catalogue::{InvalidParameter, LawEntry, Parameter, Range, Role, Values};

/// Spring with a Coulomb-type limit, and beside it a dashpot that acts until the limit is reached.
///
/// ```text
/// dT = k_r ds,   |T| ≤ μ_r N          spring;  k_r = (9/4) k_n μ_r² where it is not given
/// f  = −T − γ_r v_r                   while |T| < μ_r N,  f = −T at the limit
/// ```
///
/// With the stiffness k_n of the normal force k_r changes as the contact is pressed. As in `mindlin`, the memory is the
/// force and the energy that holds it, so that no energy is created.
///
/// # Source
/// J. Ai, J.-F. Chen, J. M. Rotter, J. Y. Ooi, Powder Technol. 206, 269 (2011), model C. Their rotational stiffness
/// (9/4) k_n (μ R)², with μ = 2 μ_r and R = L/2, is L² k_r. They propose that the dashpot stops at the limit as one of
/// two choices. Taken from other codes' documentation; the memory of force and energy is of decision 16.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticPlastic {
    /// Stiffness k_r [N/m] where it is given.
    pub stiffness: Option<f64>,
    /// Dashpot coefficient γ_r [kg/s].
    pub dashpot: f64,
    /// Coefficient of rolling friction μ_r [1].
    pub coefficient: f64,
}

/// k_r/(k_n μ_r²).
const STIFFNESS_SHARE: f64 = 2.25;

static ENTRY: LawEntry = LawEntry {
    role: Role::Rolling,
    name: "elastic-plastic",
    summary: "elastic-plastic rolling spring with a dashpot that acts below the limit (EPSD)",
    equations: "\
dT = k_r ds,  |T| ≤ μ_r N    T: rolling force, s: rolled path, torque L f
k_r = (9/4) k_n μ_r²         where it is not given; k_n: stiffness of the normal force
f  = −T − γ_r v_r            below the limit;  f = −T at it",
    source: "Ai, Chen, Rotter & Ooi, Powder Technol. 206, 269 (2011), model C, whose coefficient is 2 μ_r; the original was not at hand (certainty B)",
    parameters: &[
        Parameter::number("mu_r", "μ_r", Dimension::NONE, Range::Positive, "coefficient of rolling friction"),
        Parameter::number(
            "kr",
            "k_r",
            Dimension::STIFFNESS,
            Range::Positive,
            "stiffness of the rolling spring; (9/4) k_n μ_r² where it is not given",
        )
        .optional(),
        Parameter::number(
            "gamma_r",
            "γ_r",
            Dimension::DASHPOT,
            Range::NonNegative,
            "coefficient of the rolling dashpot",
        )
        .or(0.0),
    ],
    particle_quantities: &[],
    memory: &["rolling_force_x [N]", "rolling_force_y [N]", "rolling_force_z [N]", "rolling_energy [J]"],
    closed_form: "frequency of the rolling oscillation, L √(k_r (1/I_i + 1/I_j)), and closed cycles of pressing and rolling cost work",
    example: "law = \"elastic-plastic\"\nmu_r = 0.1",
};

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    (role == Role::Rolling).then_some(&ENTRY)
}

pub(super) fn build(_role: Role, values: &Values) -> Result<ElasticPlastic, InvalidParameter> {
    Ok(ElasticPlastic {
        stiffness: values.optional_number("kr"),
        dashpot: values.number("gamma_r")?,
        coefficient: values.number("mu_r")?,
    })
}

impl ElasticPlastic {
    /// k_r/k_n [1].
    fn share(&self) -> f64 {
        STIFFNESS_SHARE * self.coefficient * self.coefficient
    }
}

impl FrictionLaw for ElasticPlastic {
    const ONLY: Option<Role> = Some(Role::Rolling);

    /// The energy that holds the rolling force [J].
    type Scalars<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        vector: &mut T,
        scalars: &mut [R; 1],
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let stiffness = match self.stiffness {
            Some(stiffness) => R::splat(stiffness),
            None => R::splat(self.share()) * motion.normal_stiffness,
        };
        let limit = R::splat(self.coefficient) * motion.friction_reference;
        let slider = SeriesSlider {
            spring: Linear(stiffness),
            dashpot: None,
            static_limit: limit,
            limit,
            forgets_energy: false,
        };
        let (mut answer, slips) = slider.respond(motion, vector, &mut scalars[0]);
        if self.dashpot != 0.0 {
            let sticks = motion.in_contact & !slips;
            let damping = T::select(sticks, motion.velocity.scaled(R::splat(self.dashpot)), T::zero());
            answer.force = answer.force - damping;
            answer.viscous_power = damping.dot(motion.velocity);
        }
        (answer, slips)
    }

    #[inline(always)]
    fn elastic_force<R: Real, T: Tangent<R>>(&self, force: T) -> T {
        force
    }

    /// Nothing: the energy is kept beside the force.
    #[inline(always)]
    fn lost_by_shortening<R: Real>(&self, _before: R, _after: R) -> R {
        R::zero()
    }

    fn dashpot(&self) -> f64 {
        self.dashpot
    }

    fn max_stiffness(&self, scale: &ContactScale) -> f64 {
        self.stiffness.unwrap_or(self.share() * scale.normal_stiffness)
    }

    fn needs_normal_stiffness(&self) -> bool {
        self.stiffness.is_none()
    }
}
