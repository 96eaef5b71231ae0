//! A rolling resistance of constant size.

use pulvis_math::{Dimension, Real};

use super::force_memory::quotient;
use super::{ContactScale, FrictionLaw, FrictionResponse, SpringMotion, Tangent};
use crate::catalogue::{InvalidParameter, LawEntry, Parameter, Range, Role, Values};

/// A torque against rolling that knows the direction of the motion and nothing else.
///
/// ```text
/// f = −μ_r N v_r/|v_r|          torque L f
/// ```
///
/// The direction is that of the displacement since the last step: along any path the trapezoidal rule then gives each
/// piece at least (1 + cos φ)/2 times μ_r N of its length, φ the bend before it, so that rolling only loses. The torque
/// jumps where the motion turns: a body that has come to rest trembles by what the torque does in one step, and a slope
/// does not hold it. For piles at rest take `elastic-plastic` or `spring-slider`.
///
/// # Source
/// J. Ai, J.-F. Chen, J. M. Rotter, J. Y. Ooi, Powder Technol. 206, 269 (2011), model A. Their length is the effective
/// radius, here it is L = a12, twice that: their coefficient is twice μ_r. Taken from other codes' documentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantTorque {
    /// Coefficient of rolling friction μ_r [1].
    pub coefficient: f64,
}

static ENTRY: LawEntry = LawEntry {
    role: Role::Rolling,
    name: "constant-torque",
    summary: "torque of constant size against the direction of rolling",
    equations: "f = −μ_r N v_r/|v_r|    v_r: rolling velocity, torque L f",
    source: "Ai, Chen, Rotter & Ooi, Powder Technol. 206, 269 (2011), model A, whose coefficient is 2 μ_r; the original was not at hand (certainty B)",
    parameters: &[Parameter::number(
        "mu_r",
        "μ_r",
        Dimension::NONE,
        Range::NonNegative,
        "coefficient of rolling friction",
    )],
    particle_quantities: &[],
    memory: &["rolling_force_x [N]", "rolling_force_y [N]", "rolling_force_z [N]"],
    closed_form: "a rolling sphere on a plane slows down by μ_r L g/(a (1 + 2/5)), and any path costs work",
    example: "law = \"constant-torque\"\nmu_r = 0.05",
};

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    (role == Role::Rolling).then_some(&ENTRY)
}

pub(super) fn build(_role: Role, values: &Values) -> Result<ConstantTorque, InvalidParameter> {
    Ok(ConstantTorque { coefficient: values.number("mu_r")? })
}

impl FrictionLaw for ConstantTorque {
    const ONLY: Option<Role> = Some(Role::Rolling);

    type Scalars<R: Real> = ();

    #[inline(always)]
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        vector: &mut T,
        _scalars: &mut (),
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let before = *vector;
        let limit = (R::splat(self.coefficient) * motion.friction_reference).keep_where(motion.in_contact);
        let way = motion.displacement.norm_squared().sqrt();
        let now = motion.displacement.scaled(quotient(limit, way));
        *vector = now;
        let opens = !motion.in_contact & before.norm_squared().gt(R::zero());
        let response = FrictionResponse {
            force: T::zero() - now,
            stored_energy: R::zero(),
            dissipated_slip: (before + now).scaled(R::splat(0.5)).dot(motion.displacement),
            viscous_power: R::zero(),
        };
        (response, opens)
    }

    #[inline(always)]
    fn elastic_force<R: Real, T: Tangent<R>>(&self, force: T) -> T {
        force
    }

    /// Nothing: no energy is stored.
    #[inline(always)]
    fn lost_by_shortening<R: Real>(&self, _before: R, _after: R) -> R {
        R::zero()
    }

    fn dashpot(&self) -> f64 {
        0.0
    }

    fn max_stiffness(&self, _scale: &ContactScale) -> f64 {
        0.0
    }
}
