//! A tangential force and the energy that holds it: the memory of springs whose stiffness changes with the contact.
//!
//! Where the stiffness k changes, neither the displacement nor the force alone may be remembered: both create energy.
//! Remembered are the force T and the energy U that belongs to it, with U at least the energy E(T) that the force gives
//! back when it is let go at the present state of the contact. Shear changes U by its work; a change of the contact
//! changes neither T nor U, except that T and U fall where U can no longer hold T. Nothing of this creates energy, for
//! steps of any size (proof in decision 16).

use pulvis_math::{Mask, Real};

use super::{FrictionResponse, SpringMotion, Tangent};

/// The spring of one step.
pub(super) trait Spring<R: Real> {
    /// Slope dT/ds of the force over this step [N/m].
    fn stiffness(&self) -> R;
    /// Where the force is no straight line over the displacement at a fixed contact; `None` of springs for which it is.
    #[inline(always)]
    fn is_curved(&self) -> Option<R::Mask> {
        None
    }
    /// T²/(2 E(T)) [N/m] from T² [N²]: by how much energy a force is held. Where the stiffness does not depend on the
    /// force, it is the stiffness.
    fn secant(&self, square: R) -> R;
}

/// A spring whose stiffness [N/m] does not depend on its force.
#[derive(Clone, Copy, Debug)]
pub(super) struct Linear<R>(pub(super) R);

impl<R: Real> Spring<R> for Linear<R> {
    #[inline(always)]
    fn stiffness(&self) -> R {
        self.0
    }
    #[inline(always)]
    fn secant(&self, _square: R) -> R {
        self.0
    }
}

/// Spring and dashpot, in series with a slider.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeriesSlider<R, S> {
    /// The spring.
    pub(super) spring: S,
    /// Coefficient of the dashpot [kg/s], where there is one.
    pub(super) dashpot: Option<R>,
    /// Force at which the contact begins to slip [N].
    pub(super) static_limit: R,
    /// Force while it slips, at most the static one [N].
    pub(super) limit: R,
    /// Whether the energy of a force falls to what holds it when the contact grows stiffer.
    pub(super) forgets_energy: bool,
}

/// What becomes of a contact that slips.
struct Slip<T, R> {
    force: T,
    /// The part of the displacement that the spring takes, and the slip.
    taken: T,
    path: T,
    /// One over the secant stiffness of the limit, zero where there is none [m/N].
    flexibility: R,
}

/// `value` over `divisor` where that is positive, otherwise zero.
#[inline(always)]
pub(super) fn quotient<R: Real>(value: R, divisor: R) -> R {
    let positive = divisor.gt(R::zero());
    (value / R::select(positive, divisor, R::one())).keep_where(positive)
}

impl<R: Real, S: Spring<R>> SeriesSlider<R, S> {
    /// Advances the remembered force [N] and its energy [J] and answers with the force on the bodies, and with whether
    /// the contact slips, or gives up a force because it has opened.
    #[inline(always)]
    pub(super) fn respond<T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        remembered: &mut T,
        remembered_energy: &mut R,
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let half = R::splat(0.5);
        let held = *remembered_energy;
        let (carried, energy, mut lost) = self.receded(*remembered, held);
        let stiffness = self.slope(carried, energy, motion.displacement);
        // In the half kick before the area shrank the whole force did its work.
        lost += (*remembered - carried).scaled(half).dot(motion.displacement);
        let mut damping = T::zero();
        let mut force = T::zero() - carried - motion.displacement.scaled(stiffness);
        if let Some(dashpot) = self.dashpot {
            damping = motion.velocity.scaled(dashpot);
            force = force - damping;
        }
        let slips = force.norm_squared().gt(self.static_limit * self.static_limit);
        let (mut taken, mut path) = (motion.displacement, T::zero());
        let mut flexibility = R::zero();
        if slips.any() {
            let slip = self.slip(motion, carried, stiffness);
            force = T::select(slips, slip.force, force);
            taken = T::select(slips, slip.taken, taken);
            path = T::select(slips, slip.path, path);
            flexibility = slip.flexibility;
        }
        let after = carried + taken.scaled(stiffness);
        let stored = energy + (carried + taken.scaled(half * stiffness)).dot(taken);
        lost += (carried + after).scaled(half).dot(path);
        let mut viscous_power = R::zero();
        if let Some(dashpot) = self.dashpot {
            damping = T::select(slips, T::zero() - force - after, damping);
            damping = T::select(motion.in_contact, damping, T::zero());
            // With the velocity at the end of the step: over the slip it adds up to the trapezoidal rule.
            let path_now = motion.velocity.scaled(motion.elapsed) - taken;
            lost += damping.dot(T::select(slips, path_now, T::zero()));
            viscous_power = quotient(damping.norm_squared(), dashpot);
        }
        // Gross sliding forgets what is locked in; an open contact forgets all.
        let mut own = half * after.norm_squared() * flexibility;
        if let Some(curved) = self.spring.is_curved() {
            // Where the chord of the step has given less than the curve holds: nothing comes from nothing.
            own = R::select(curved & stored.gt(R::zero()), own.min(stored), own);
        }
        let kept = R::select(slips, own, stored).keep_where(motion.in_contact);
        lost += stored - kept;
        // An open contact has no area: it gives up its force without slipping.
        let opens = !motion.in_contact & held.gt(R::zero());
        *remembered = T::select(motion.in_contact, after, T::zero());
        *remembered_energy = kept;
        (FrictionResponse { force, stored_energy: kept, dissipated_slip: lost, viscous_power }, slips | opens)
    }

    /// Force [N] and energy [J] that the present contact can hold, and what it loses.
    #[inline(always)]
    fn receded<T: Tangent<R>>(&self, force: T, energy: R) -> (T, R, R) {
        let (mut carried, mut left) = (force, energy);
        let square = force.norm_squared();
        let secant = self.spring.secant(square);
        let held = R::splat(2.0) * secant * energy;
        let recedes = square.gt(held);
        if recedes.any() {
            let share = R::select(recedes, quotient(held, square), R::one());
            carried = force.scaled(share);
            left = energy * share;
        }
        if self.forgets_energy {
            // The energy is that of the force in this contact, also when it has grown stiffer: when it yields again,
            // nothing else holds the force.
            left = quotient(R::splat(0.5) * carried.norm_squared(), secant);
        }
        (carried, left, energy - left)
    }

    /// Slope dT/ds [N/m] over the step `displacement` [m] from a `force` [N] held by an `energy` [J]. A chord of a curved
    /// spring over a long way back may be so flat that it gives more than there is; that of the energy never does.
    #[inline(always)]
    fn slope<T: Tangent<R>>(&self, force: T, energy: R, displacement: T) -> R {
        let mut slope = self.spring.stiffness();
        if let Some(curved) = self.spring.is_curved() {
            let left = energy + (force + displacement.scaled(R::splat(0.5) * slope)).dot(displacement);
            let overdrawn = curved & left.lt(R::zero());
            if overdrawn.any() {
                slope = R::select(overdrawn, self.spring.secant(force.norm_squared()), slope);
            }
        }
        slope
    }

    /// Slip with the slider in series with spring and dashpot, −f = T + k D + γ D/dt, solved for the part D of the
    /// displacement that the spring takes.
    #[inline(always)]
    fn slip<T: Tangent<R>>(&self, motion: &SpringMotion<T, R>, carried: T, stiffness: R) -> Slip<T, R> {
        let mut trial = T::zero() - carried - motion.displacement.scaled(stiffness);
        let mut compliance = quotient(R::one(), stiffness);
        if let Some(dashpot) = self.dashpot {
            trial = trial - motion.mean_velocity().scaled(dashpot);
            compliance = quotient(motion.elapsed, stiffness * motion.elapsed + dashpot);
        }
        let size = trial.norm_squared().sqrt();
        let force = trial.scaled(quotient(self.limit.min(size), size));
        let taken = (T::zero() - force - carried).scaled(compliance);
        let after = carried + taken.scaled(stiffness);
        let flexibility = quotient(R::one(), self.spring.secant(after.norm_squared()));
        Slip { force, taken, path: motion.displacement - taken, flexibility }
    }
}
