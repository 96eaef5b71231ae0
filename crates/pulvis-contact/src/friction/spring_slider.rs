//! The common spring-dashpot-slider of sliding, rolling and torsion.

use pulvis_math::{Dimension, Mask, Real, Vector3};

use super::{FrictionResponse, SpringMotion};
use crate::catalogue::{InvalidParameter, LawEntry, Parameter, Range, Role, Values};

/// Spring and dashpot with a Coulomb-type limit, for any of the three relative motions.
///
/// ```text
/// f_0 = −k ξ − γ v                    trial force, ξ advanced before the force is taken
/// f   = f_0                           if |f_0| <= μ_s (f_hys + kc δ)
/// f   = μ (f_hys + kc δ) f_0/|f_0|    otherwise, and the spring follows: ξ = −(f + γ v)/k
/// ```
///
/// # Source
/// S. Luding, Granular Matter 10, 235 (2008), section 2.3-2.4, eqs. (11)-(20). The order "advance,
/// then take the force" is not the paper's wording: a spring that lags by a time step feeds energy
/// into the contact like a dashpot of coefficient −k dt.
///
/// With μ_s > μ the spring sticks again as soon as it has slipped, so that slow sliding is stick-slip
/// between both limits; no flag remembers that the contact slides. While it slides, the force is the
/// Coulomb force alone: what the dashpot is said to lose (γ v²) is then part of it, and the loss by
/// slip is the rest, which is negative where γ v exceeds the limit.
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
f   = μ (f_hys + k_c δ) f₀/|f₀|   otherwise; the spring follows, ξ = −(f + γ v)/k";
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

pub(super) fn build(role: Role, values: &Values) -> Result<Option<SpringSlider>, InvalidParameter> {
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
    Ok(Some(SpringSlider {
        stiffness: values.number(stiffness)?,
        dashpot: values.number(dashpot)?,
        dynamic_coefficient,
        static_coefficient,
    }))
}

impl SpringSlider {
    /// Advances a spring in the tangent plane (sliding, rolling) and answers with the force, and with whether the
    /// spring slips.
    #[inline(always)]
    pub fn respond<R: Real>(
        &self,
        motion: &SpringMotion<Vector3<R>, R>,
        spring: &mut Vector3<R>,
    ) -> (FrictionResponse<Vector3<R>, R>, R::Mask) {
        let before = *spring;
        let trial = before + motion.displacement;
        let mut trial_force = trial * R::splat(-self.stiffness);
        let damping = motion.velocity * R::splat(self.dashpot);
        // Most sliders have no dashpot.
        if self.dashpot != 0.0 {
            trial_force -= damping;
        }
        let static_limit = R::splat(self.static_coefficient) * motion.friction_reference;
        let half = R::splat(0.5 * self.stiffness);
        // Squares are compared: the root and the quotient are for contacts that slide.
        let size_squared = trial_force.norm_squared();
        let slips = size_squared.gt(static_limit * static_limit);
        let (mut force, mut after, mut dissipated_slip) = (trial_force, trial, R::zero());
        if slips.any() {
            let limit = R::splat(self.dynamic_coefficient) * motion.friction_reference;
            let factor = R::select(slips, limit / size_squared.sqrt(), R::one());
            force = trial_force * factor;
            // The spring has the length that gives the limited force; otherwise it would keep the
            // length of the trial and pull backwards when the motion reverses.
            let spring_force = if self.dashpot != 0.0 { force + damping } else { force };
            after = Vector3::select(slips, spring_force * R::splat(-1.0 / self.stiffness), trial);
            let lost = half * (before + after).dot(trial - after);
            dissipated_slip = lost.keep_where(slips);
        }
        *spring = after;
        let viscous_power = if self.dashpot != 0.0 { motion.velocity.dot(damping) } else { R::zero() };
        let stored_energy = half * after.norm_squared();
        (FrictionResponse { force, stored_energy, dissipated_slip, viscous_power }, slips)
    }

    /// The same for a spring along the line of centres (torsion).
    #[inline(always)]
    pub fn respond_along<R: Real>(
        &self,
        motion: &SpringMotion<R, R>,
        spring: &mut R,
    ) -> (FrictionResponse<R, R>, R::Mask) {
        let before = *spring;
        let trial = before + motion.displacement;
        let mut trial_force = trial * R::splat(-self.stiffness);
        let damping = motion.velocity * R::splat(self.dashpot);
        if self.dashpot != 0.0 {
            trial_force -= damping;
        }
        let static_limit = R::splat(self.static_coefficient) * motion.friction_reference;
        let half = R::splat(0.5 * self.stiffness);
        let slips = trial_force.abs().gt(static_limit);
        let (mut force, mut after, mut dissipated_slip) = (trial_force, trial, R::zero());
        if slips.any() {
            let limit = R::splat(self.dynamic_coefficient) * motion.friction_reference;
            let signed_limit = R::select(trial_force.lt(R::zero()), -limit, limit);
            force = R::select(slips, signed_limit, trial_force);
            let spring_force = if self.dashpot != 0.0 { force + damping } else { force };
            after = R::select(slips, spring_force * R::splat(-1.0 / self.stiffness), trial);
            let lost = half * (before + after) * (trial - after);
            dissipated_slip = lost.keep_where(slips);
        }
        *spring = after;
        let viscous_power = if self.dashpot != 0.0 { motion.velocity * damping } else { R::zero() };
        let stored_energy = half * after * after;
        (FrictionResponse { force, stored_energy, dissipated_slip, viscous_power }, slips)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulvis_math::elementary;

    const LAW: SpringSlider =
        SpringSlider { stiffness: 100.0, dashpot: 0.0, dynamic_coefficient: 0.5, static_coefficient: 0.8 };

    fn pull(displacement: f64, reference: f64, spring: &mut Vector3) -> FrictionResponse<Vector3> {
        let motion = SpringMotion {
            velocity: Vector3::zero(),
            displacement: Vector3::new(displacement, 0.0, 0.0),
            friction_reference: reference,
        };
        LAW.respond(&motion, spring).0
    }

    #[test]
    fn a_contact_sticks_up_to_the_static_limit_and_slides_at_the_dynamic_one() {
        let mut spring = Vector3::zero();
        assert_eq!(pull(7.9e-3, 1.0, &mut spring).force.x, -0.79);
        let sliding = pull(0.2e-3, 1.0, &mut spring);
        assert!((sliding.force.x + 0.5).abs() < 1e-15);
        assert!((spring.x - 5e-3).abs() < 1e-18);
    }

    #[test]
    fn without_a_limit_a_contact_sticks_whatever_pulls() {
        for coefficient in [1e200, f64::INFINITY] {
            let law =
                SpringSlider { dynamic_coefficient: coefficient, static_coefficient: coefficient, ..LAW };
            let motion = SpringMotion {
                velocity: Vector3::zero(),
                displacement: Vector3::new(3.0, 4.0, 0.0),
                friction_reference: 1e-3,
            };
            let mut spring = Vector3::zero();
            assert_eq!(law.respond(&motion, &mut spring).0.force, Vector3::new(-300.0, -400.0, 0.0));
            assert_eq!(spring, motion.displacement);
        }
    }

    #[test]
    fn slip_loses_what_the_spring_does_not_keep() {
        let mut spring = Vector3::zero();
        let (mut work, mut lost, mut force) = (0.0, 0.0, 0.0);
        let step = 1e-6;
        let mut stored = 0.0;
        for _ in 0..20_010 {
            let answer = pull(step, 1.0, &mut spring);
            work += 0.5 * (force - answer.force.x) * step;
            force = -answer.force.x;
            lost += answer.dissipated_slip;
            stored = answer.stored_energy;
        }
        assert!((work - lost - stored).abs() < 1e-12 * work);
        // Slip sets in at 8 mm of stretch, drops the force from 0.8 N to 0.5 N and leaves 5 mm; the
        // spring sticks again and slips every 3 mm: at 8, 11, 14, 17 and 20 mm, each time losing the
        // slipped 3 mm at the mean force.
        let expected = 5.0 * 0.5 * (0.8 + 0.5) * 3e-3;
        // Each slip starts up to one step of 1e-6 m late.
        assert!((lost - expected).abs() < 1e-3 * expected, "{lost} {expected}");
    }

    #[test]
    fn an_opening_contact_loses_its_spring() {
        let mut spring = Vector3::zero();
        let stored = pull(1e-3, 1.0, &mut spring).stored_energy;
        let opened = pull(0.0, 0.0, &mut spring);
        assert_eq!(opened.force, Vector3::zero());
        assert_eq!(spring, Vector3::zero());
        assert!((opened.dissipated_slip - stored).abs() < 1e-20);
    }

    #[test]
    fn the_torsion_spring_is_the_sliding_spring_in_one_dimension() {
        let (mut along, mut plane) = (0.0, Vector3::zero());
        for step in 0..200 {
            let displacement = 1e-3 * elementary::sin(0.1 * f64::from(step));
            let motion = SpringMotion { velocity: 0.0, displacement, friction_reference: 0.3 };
            let (one, _) = LAW.respond_along(&motion, &mut along);
            let three = pull(displacement, 0.3, &mut plane);
            assert!((one.force - three.force.x).abs() < 1e-15);
            assert!((one.dissipated_slip - three.dissipated_slip).abs() < 1e-18);
        }
    }
}
