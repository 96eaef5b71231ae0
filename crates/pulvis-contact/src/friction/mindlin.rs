//! The tangential law of Mindlin for elastic spheres, with a memory that creates no energy.

use pulvis_math::{Dimension, Mask, Real};

use super::{FrictionLaw, FrictionResponse, SpringMotion, Tangent};
use crate::catalogue::{Choice, InvalidParameter, LawEntry, Parameter, Range, Role, Values, mixing};

/// Tangential stiffness k = 8 G* a that follows the radius a of the contact area, with a Coulomb limit.
///
/// The memory is the tangential force T and the energy U that belongs to it, U ≥ T²/(2 k). At a fixed area shear
/// stores exactly what it is given, dU = T ds; a growing area changes neither T nor U; a shrinking one takes as much of
/// T as U can no longer hold, |T| ≤ 2 k U/|T|, the micro-slip of a receding edge. Nothing of this creates energy, for
/// steps of any size. The usual rules do: to keep the displacement, or the force without rescaling it, gives energy
/// back that nobody put in. To rescale the force with every fall of a (`rescale = "unloading"`) is passive but forgets
/// T by vibrations of the area, so that a shaken pile creeps.
///
/// Valid for δ ≪ R and without the partial slip of Mindlin's full solution.
///
/// # Source
/// R. D. Mindlin, J. Appl. Mech. 16, 259 (1949); K. L. Johnson, *Contact Mechanics* (1985), eq. (7.44). The memory of
/// force and energy is derived, with its proof, in decision 16.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mindlin {
    /// Effective shear modulus G* [Pa].
    pub effective_shear_modulus: f64,
    /// Dashpot coefficient γ_t [kg/s].
    pub dashpot: f64,
    /// Coefficient of friction μ [1].
    pub coefficient: f64,
    /// What becomes of the force when the area shrinks.
    pub rescale: Rescale,
}

/// What becomes of the tangential force when the contact area shrinks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rescale {
    /// It falls as far as the stored energy demands.
    Energy,
    /// It falls with the radius of the area, T a/a_old.
    Unloading,
}

static ENTRY: LawEntry = LawEntry {
    role: Role::Sliding,
    name: "mindlin",
    summary: "tangential stiffness that follows the contact area, with a Coulomb limit",
    equations: "\
dT  = 8 G* a ds                  tangential force T of the displacement s
|T| ≤ 2 k U/|T|,  k = 8 G* a     when the area shrinks; U: stored energy
|f| ≤ μ N                        N: F of `hertz`, F + 2 F_c of `jkr`",
    source: "Mindlin, J. Appl. Mech. 16, 259 (1949); Johnson, Contact Mechanics (1985), eq. 7.44",
    parameters: &[
        Parameter::number(
            "effective_shear_modulus",
            "G*",
            Dimension::PRESSURE,
            Range::Positive,
            "effective shear modulus, 1/G* = (2 − ν_i)/G_i + (2 − ν_j)/G_j",
        )
        .from_materials(&mixing::EFFECTIVE_SHEAR_MODULUS),
        Parameter::number("mu", "μ", Dimension::NONE, Range::NonNegative, "coefficient of sliding friction"),
        Parameter::number(
            "gamma_t",
            "γ_t",
            Dimension::DASHPOT,
            Range::NonNegative,
            "coefficient of the tangential dashpot",
        )
        .or(0.0),
        Parameter::choice(
            "rescale",
            "",
            &[
                Choice {
                    name: "energy",
                    meaning: "T falls as far as its stored energy demands: passive, no ratcheting",
                },
                Choice {
                    name: "unloading",
                    meaning: "T falls with a: passive, but vibrations make it creep",
                },
            ],
            "energy",
            "what becomes of the tangential force T when the contact area shrinks",
        ),
    ],
    memory: &[
        "tangential_force_x [N]",
        "tangential_force_y [N]",
        "tangential_force_z [N]",
        "tangential_energy [J]",
    ],
    closed_form: "frequency of a sticking contact at constant overlap, √(8 G* a (1/m_r + a_i²/I_i + a_j²/I_j)); closed cycles cost work",
    example: "law = \"mindlin\"\neffective_shear_modulus = \"3e7 Pa\"\nmu = 0.5",
};

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    (role == Role::Sliding).then_some(&ENTRY)
}

pub(super) fn build(_role: Role, values: &Values) -> Result<Mindlin, InvalidParameter> {
    Ok(Mindlin {
        effective_shear_modulus: values.number("effective_shear_modulus")?,
        dashpot: values.number("gamma_t")?,
        coefficient: values.number("mu")?,
        rescale: match values.choice("rescale")? {
            "unloading" => Rescale::Unloading,
            _ => Rescale::Energy,
        },
    })
}

/// `value` over `divisor` where that is positive, otherwise zero.
#[inline(always)]
fn quotient<R: Real>(value: R, divisor: R) -> R {
    let positive = divisor.gt(R::zero());
    (value / R::select(positive, divisor, R::one())).keep_where(positive)
}

/// What becomes of a contact that slips.
struct Slip<T, R> {
    force: T,
    /// The part of the displacement that the spring takes, and the slip.
    taken: T,
    path: T,
    /// One over the stiffness, zero where there is none [m/N].
    flexibility: R,
}

impl Mindlin {
    /// Force [N] and energy [J] that an area of the present stiffness can hold, and what it loses.
    #[inline(always)]
    fn receded<R: Real, T: Tangent<R>>(&self, force: T, energy: R, stiffness: R) -> (T, R, R) {
        let (mut carried, mut left) = (force, energy);
        let square = force.norm_squared();
        let held = R::splat(2.0) * stiffness * energy;
        let recedes = square.gt(held);
        if recedes.any() {
            let share = R::select(recedes, quotient(held, square), R::one());
            carried = force.scaled(share);
            left = energy * share;
        }
        if self.rescale == Rescale::Unloading {
            // The energy is that of the force at this area, also when the area has grown: when it shrinks again,
            // nothing else holds the force.
            left = quotient(R::splat(0.5) * carried.norm_squared(), stiffness);
        }
        (carried, left, energy - left)
    }

    /// Slip with the slider in series with spring and dashpot, −f = T + k D + γ D/dt, solved for the part D of the
    /// displacement that the spring takes.
    #[inline(always)]
    fn slip<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        carried: T,
        stiffness: R,
        limit: R,
    ) -> Slip<T, R> {
        let dashpot = R::splat(self.dashpot);
        let mut trial = T::zero() - carried - motion.displacement.scaled(stiffness);
        let flexibility = quotient(R::one(), stiffness);
        let mut compliance = flexibility;
        if self.dashpot != 0.0 {
            trial = trial - motion.mean_velocity().scaled(dashpot);
            compliance = motion.elapsed / (stiffness * motion.elapsed + dashpot);
        }
        let size = trial.norm_squared().sqrt();
        let force = trial.scaled(quotient(limit.min(size), size));
        let taken = (T::zero() - force - carried).scaled(compliance);
        Slip { force, taken, path: motion.displacement - taken, flexibility }
    }
}

impl FrictionLaw for Mindlin {
    /// The energy that the tangential force stores [J].
    type Scalars<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        vector: &mut T,
        scalars: &mut [R; 1],
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let half = R::splat(0.5);
        let stiffness = R::splat(8.0 * self.effective_shear_modulus) * motion.contact_radius;
        let (carried, energy, mut lost) = self.receded(*vector, scalars[0], stiffness);
        // In the half kick before the area shrank the whole force did its work.
        lost += (*vector - carried).scaled(half).dot(motion.displacement);
        let mut damping = motion.velocity.scaled(R::splat(self.dashpot));
        let mut force = T::zero() - carried - motion.displacement.scaled(stiffness);
        if self.dashpot != 0.0 {
            force = force - damping;
        }
        let limit = R::splat(self.coefficient) * motion.friction_reference;
        let slips = force.norm_squared().gt(limit * limit);
        let (mut taken, mut path) = (motion.displacement, T::zero());
        let mut flexibility = R::zero();
        if slips.any() {
            let slip = self.slip(motion, carried, stiffness, limit);
            force = T::select(slips, slip.force, force);
            taken = T::select(slips, slip.taken, taken);
            path = T::select(slips, slip.path, path);
            flexibility = slip.flexibility;
        }
        let after = carried + taken.scaled(stiffness);
        let stored = energy + (carried + taken.scaled(half * stiffness)).dot(taken);
        lost += (carried + after).scaled(half).dot(path);
        let mut viscous_power = R::zero();
        if self.dashpot != 0.0 {
            damping = T::select(slips, T::zero() - force - after, damping);
            damping = T::select(motion.in_contact, damping, T::zero());
            // With the velocity at the end of the step: over the slip it adds up to the trapezoidal rule.
            let path_now = motion.velocity.scaled(motion.elapsed) - taken;
            lost += damping.dot(T::select(slips, path_now, T::zero()));
            viscous_power = damping.norm_squared() * R::splat(1.0 / self.dashpot);
        }
        // Gross sliding forgets what is locked in; an open contact forgets all.
        let own = half * after.norm_squared() * flexibility;
        let kept = R::select(slips, own, stored).keep_where(motion.in_contact);
        lost += stored - kept;
        // An open contact has no area: it gives up its force without slipping.
        let opens = !motion.in_contact & scalars[0].gt(R::zero());
        *vector = T::select(motion.in_contact, after, T::zero());
        scalars[0] = kept;
        (FrictionResponse { force, stored_energy: kept, dissipated_slip: lost, viscous_power }, slips | opens)
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

    fn max_stiffness(&self, contact_radius: f64) -> f64 {
        8.0 * self.effective_shear_modulus * contact_radius
    }

    const NEEDS_CONTACT_RADIUS: bool = true;
}
