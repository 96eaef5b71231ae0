//! The common spring-dashpot-slider of sliding, rolling and torsion.

use pulvis_math::{Dimension, Mask, Real};

use super::{ContactScale, FrictionLaw, FrictionResponse, SpringMotion, Tangent};
use crate::catalogue::{InvalidParameter, LawEntry, Parameter, Range, Role, Values};
use crate::conventions::SlipDashpot;

/// Spring and dashpot with a Coulomb-type limit, for any of the three relative motions.
///
/// ```text
/// f_0 = −k ξ − γ v                    trial force, ξ advanced before the force is taken
/// f   = f_0                           if |f_0| <= μ_s (f_hys + kc δ)
/// f   = μ (f_hys + kc δ) f_0/|f_0|    otherwise, and the spring follows: −f = k ξ + γ dξ/dt
/// ```
///
/// # Source
/// S. Luding, Granular Matter 10, 235 (2008), section 2.3-2.4, eqs. (11)-(20). The order "advance,
/// then take the force" is not the paper's wording: a spring that lags by a time step feeds energy
/// into the contact like a dashpot of coefficient −k dt.
///
/// With μ_s > μ the spring sticks again as soon as it has slipped, so that slow sliding is stick-slip
/// between both limits; no flag remembers that the contact slides.
///
/// While a contact slides, the slider stands in series with spring and dashpot, so that the dashpot sees the rate of
/// the spring only: ξ_1 = (γ ξ_0 − f dt)/(γ + k dt). Eq. (20) of the paper as printed, ξ = −(f + γ v)/k, lets it see
/// the whole sliding speed: where γ v exceeds the limit, the spring is stretched against the motion without bound, and
/// energy comes from nothing. That rule is kept as the convention `slip_dashpot = "printed"`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringSlider {
    /// Spring stiffness k_t, k_r or k_o [N/m].
    pub stiffness: f64,
    /// Dashpot coefficient γ_t, γ_r or γ_o [kg/s].
    pub dashpot: f64,
    /// Dynamic coefficient of friction μ [1].
    pub dynamic_coefficient: f64,
    /// Static coefficient of friction μ_s, at least μ [1].
    pub static_coefficient: f64,
}

const EQUATIONS: &str = "\
f₀  = −k ξ − γ v                  trial force of the spring ξ and the dashpot
f   = f₀                         if |f₀| ≤ μ_s (f_hys + k_c δ)
f   = μ (f_hys + k_c δ) f₀/|f₀|   otherwise; the spring follows, −f = k ξ + γ dξ/dt";
const SOURCE: &str = "Luding, Granular Matter 10, 235 (2008), eqs. 11-20";

macro_rules! described {
    ($role:ident, $summary:literal, [$k:literal, $ks:literal], [$g:literal, $gs:literal], [$m:literal, $ms:literal], [$s:literal, $ss:literal], $motion:literal, $memory:expr, $check:literal, $example:literal) => {
        LawEntry {
            role: Role::$role,
            name: "spring-slider",
            summary: $summary,
            equations: EQUATIONS,
            source: SOURCE,
            parameters: &[
                Parameter::number(
                    $k,
                    $ks,
                    Dimension::STIFFNESS,
                    Range::Positive,
                    concat!("stiffness of the ", $motion, " spring"),
                ),
                Parameter::number(
                    $g,
                    $gs,
                    Dimension::DASHPOT,
                    Range::NonNegative,
                    concat!("coefficient of the ", $motion, " dashpot"),
                )
                .or(0.0),
                Parameter::number(
                    $m,
                    $ms,
                    Dimension::NONE,
                    Range::NonNegative,
                    concat!("dynamic coefficient of ", $motion, " friction"),
                ),
                Parameter::number(
                    $s,
                    $ss,
                    Dimension::NONE,
                    Range::NonNegative,
                    concat!(
                        "static coefficient of ",
                        $motion,
                        " friction, at least the dynamic one, which it equals where not given"
                    ),
                )
                .optional(),
            ],
            particle_quantities: &[],
            memory: $memory,
            closed_form: $check,
            example: $example,
        }
    };
}

static SLIDING: LawEntry = described!(
    Sliding,
    "tangential spring and dashpot with a Coulomb limit",
    ["kt", "k_t"],
    ["gamma_t", "γ_t"],
    ["mu", "μ"],
    ["mu_static", "μ_s"],
    "sliding",
    &["sliding_x [m]", "sliding_y [m]", "sliding_z [m]"],
    "frequency of a sticking contact, gross sliding impact, sliding to rolling on a plane (contact-point kinematics)",
    "law = \"spring-slider\"\nkt = \"20 N/m\"\nmu = 0.5"
);
static ROLLING: LawEntry = described!(
    Rolling,
    "rolling spring and dashpot with a Coulomb-type limit",
    ["kr", "k_r"],
    ["gamma_r", "γ_r"],
    ["mu_r", "μ_r"],
    ["mu_r_static", "μ_rs"],
    "rolling",
    &["rolling_x [m]", "rolling_y [m]", "rolling_z [m]"],
    "frequency of the rolling oscillation, L √(k_r (1/I_i + 1/I_j))",
    "law = \"spring-slider\"\nkr = \"10 N/m\"\nmu_r = 0.1"
);
static TORSION: LawEntry = described!(
    Torsion,
    "torsion spring and dashpot with a Coulomb-type limit",
    ["ko", "k_o"],
    ["gamma_o", "γ_o"],
    ["mu_o", "μ_o"],
    ["mu_o_static", "μ_os"],
    "torsion",
    &["torsion [m]"],
    "frequency of the torsion oscillation, L √(k_o (1/I_i + 1/I_j))",
    "law = \"spring-slider\"\nko = \"10 N/m\"\nmu_o = 0.1"
);

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    match role {
        Role::Sliding => Some(&SLIDING),
        Role::Rolling => Some(&ROLLING),
        Role::Torsion => Some(&TORSION),
        _ => None,
    }
}

pub(super) fn build(role: Role, values: &Values) -> Result<SpringSlider, InvalidParameter> {
    let [stiffness, dashpot, dynamic, fixed] = match role {
        Role::Rolling => ["kr", "gamma_r", "mu_r", "mu_r_static"],
        Role::Torsion => ["ko", "gamma_o", "mu_o", "mu_o_static"],
        _ => ["kt", "gamma_t", "mu", "mu_static"],
    };
    let dynamic_coefficient = values.number(dynamic)?;
    let static_coefficient = values.optional_number(fixed).unwrap_or(dynamic_coefficient);
    if static_coefficient < dynamic_coefficient {
        return Err(InvalidParameter::Inconsistent {
            name: fixed,
            found: static_coefficient.to_string(),
            expected: format!("at least {dynamic} = {dynamic_coefficient}"),
            reason: "static friction is never weaker than dynamic friction",
        });
    }
    Ok(SpringSlider {
        stiffness: values.number(stiffness)?,
        dashpot: values.number(dashpot)?,
        dynamic_coefficient,
        static_coefficient,
    })
}

impl FrictionLaw for SpringSlider {
    type Scalars<R: Real> = ();

    #[inline(always)]
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        spring: &mut T,
        _scalars: &mut (),
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let before = *spring;
        let trial = before + motion.displacement;
        let mut trial_force = trial.scaled(R::splat(-self.stiffness));
        let damping = motion.velocity.scaled(R::splat(self.dashpot));
        // Most sliders have no dashpot.
        let mut viscous_power = R::zero();
        if self.dashpot != 0.0 {
            trial_force = trial_force - damping;
            viscous_power = motion.velocity.dot(damping);
        }
        let static_limit = R::splat(self.static_coefficient) * motion.friction_reference;
        let half = R::splat(0.5 * self.stiffness);
        // Squares are compared: the root and the quotient are for contacts that slide.
        let size_squared = trial_force.norm_squared();
        let slips = size_squared.gt(static_limit * static_limit);
        let (mut force, mut after, mut dissipated_slip) = (trial_force, trial, R::zero());
        if slips.any() {
            let limit = R::splat(self.dynamic_coefficient) * motion.friction_reference;
            let slip = if self.dashpot != 0.0 && motion.slip_dashpot == SlipDashpot::Series {
                self.slip_in_series(motion, before, limit)
            } else {
                let limited = trial_force.scaled(limit / size_squared.sqrt());
                // The spring has the length that gives the limited force; otherwise it would keep the
                // length of the trial and pull backwards when the motion reverses.
                let spring_force = if self.dashpot != 0.0 { limited + damping } else { limited };
                let after = spring_force.scaled(R::splat(-1.0 / self.stiffness));
                let lost = half * (before + after).dot(trial - after);
                Slip { force: limited, spring: after, lost, viscous_power }
            };
            force = T::select(slips, slip.force, trial_force);
            after = T::select(slips, slip.spring, trial);
            dissipated_slip = slip.lost.keep_where(slips);
            viscous_power = R::select(slips, slip.viscous_power, viscous_power);
        }
        *spring = after;
        let stored_energy = half * after.norm_squared();
        (FrictionResponse { force, stored_energy, dissipated_slip, viscous_power }, slips)
    }

    #[inline(always)]
    fn elastic_force<R: Real, T: Tangent<R>>(&self, spring: T) -> T {
        spring.scaled(R::splat(self.stiffness))
    }

    #[inline(always)]
    fn lost_by_shortening<R: Real>(&self, before: R, after: R) -> R {
        R::splat(0.5 * self.stiffness) * (before - after)
    }

    fn dashpot(&self) -> f64 {
        self.dashpot
    }

    fn max_stiffness(&self, _scale: &ContactScale) -> f64 {
        self.stiffness
    }
}

/// What becomes of a contact that slips.
struct Slip<T, R> {
    force: T,
    spring: T,
    lost: R,
    viscous_power: R,
}

impl SpringSlider {
    /// Slip with the slider in series with spring and dashpot: the two carry the Coulomb force together, so that the
    /// spring changes at the rate that the dashpot lets it, and the rest of the motion is slip.
    ///
    /// With the mean velocity v of the step in the trial, the slip v dt − Δξ is antiparallel to the force for every dashpot,
    /// speed and time step: slip only loses. The loss is booked with the mean of the spring's force over the step, as
    /// the two half kicks do that work. The dashpot's force at the start of the step is not remembered: its part of the
    /// books runs ahead by half a step of what it loses by slip, and is right again when the contact sticks or opens.
    #[inline(always)]
    fn slip_in_series<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        before: T,
        limit: R,
    ) -> Slip<T, R> {
        let (stiffness, dashpot) = (R::splat(self.stiffness), R::splat(self.dashpot));
        let trial =
            (before + motion.displacement).scaled(-stiffness) - motion.mean_velocity().scaled(dashpot);
        let size = trial.norm_squared().sqrt();
        let bounded = limit.min(size);
        let force = trial.scaled((bounded / size).keep_where(size.gt(R::zero())));
        let relaxing = before.scaled(dashpot) - force.scaled(motion.elapsed);
        let relaxed = relaxing.scaled(R::one() / (dashpot + stiffness * motion.elapsed));
        let spring = T::select(motion.in_contact, relaxed, T::zero());
        // γ times the rate of the spring.
        let damping = T::select(motion.in_contact, T::zero() - force - spring.scaled(stiffness), T::zero());
        let path = motion.displacement - (spring - before);
        let spring_force = (before + spring).scaled(R::splat(0.5 * self.stiffness));
        let viscous_power = damping.norm_squared() * R::splat(1.0 / self.dashpot);
        // The dashpot's part with the velocity at the end of the step: over the slip it adds up to the trapezoidal rule.
        let path_now = motion.velocity.scaled(motion.elapsed) - (spring - before);
        Slip { force, spring, lost: spring_force.dot(path) + damping.dot(path_now), viscous_power }
    }
}

#[cfg(test)]
mod tests;
