//! Forces that set in or end within a step, by jumps.
//!
//! Velocity-Verlet applies a force that sets in within a step for half of the step, wherever in the step it set in:
//! an error of first order. With the weights of this module its two half kicks give the impulse of the part of the step
//! in which the force acted, and the order is the second again. Only the force on the bodies is weighted, and the power of
//! dashpots with it; friction, memory and other energies take the force as it is.
//!
//! # Source
//! Derived for this program; measured for pair collisions in the tests of `jkr`.

use pulvis_math::{Mask, Real};

use crate::kinematics::NormalMotion;
use crate::normal::NormalResponse;

/// A `force` [N] that sets in where the overlap reaches `event` [m], over the step in which it does: (θ + 1/2) F with
/// the part θ of the step in which it acted.
#[inline(always)]
pub fn sets_in<R: Real>(motion: &NormalMotion<R>, event: R, force: R) -> R {
    (part(motion.overlap - event, motion.growth) + R::splat(0.5)) * force
}

/// A force that ends where the overlap reaches `event` [m], with the value `force` [N] there, over the step in which it
/// does: (θ − 1/2) F with the part θ of the step in which it acted.
#[inline(always)]
pub fn ends<R: Real>(motion: &NormalMotion<R>, event: R, force: R) -> R {
    let before = motion.overlap - motion.growth;
    (part(before - event, -motion.growth) - R::splat(0.5)) * force
}

/// A `force` of bodies that overlap, zero for others, over the step: it sets in where they touch, and ends where they part
/// with the value `at_touch` [N]. Where it does not jump there, nothing is to be weighted.
#[inline(always)]
pub fn while_touching<R: Real>(motion: &NormalMotion<R>, force: R, at_touch: R) -> R {
    let zero = R::zero();
    // In a first look nothing has grown: bodies that overlap then met before this step.
    let meets = motion.touching & motion.overlap.le(motion.growth);
    let parts = !motion.touching & motion.overlap.gt(motion.growth);
    let mut applied = force;
    if (meets | parts).any() {
        applied = R::select(meets, sets_in(motion, zero, force), applied);
        applied = R::select(parts, ends(motion, zero, at_touch), applied);
    }
    applied
}

/// The `force` [N] of a dashpot over the step, of bodies in contact, and the closing rate [m/s] that its power is taken with:
/// it sets in where they touch and ends where they part. Contacts that begin or end at another overlap take it as it is.
///
/// The velocity at the end of a step is predicted with the forces of its start. In these steps they are not those of its
/// end: what the half kick of the dashpot differs by is added.
#[inline(always)]
pub fn of_dashpot<R: Real>(motion: &NormalMotion<R>, normal: &NormalResponse<R>, force: R) -> [R; 2] {
    let mut applied = force.keep_where(normal.in_contact);
    let mut closing = motion.closing_rate;
    let (touching, touched) = (motion.touching, motion.touched_before());
    // Seldom: what tells these contacts from those that last is asked before all else.
    if ((touching & !touched) | (touched & !touching)).any() {
        let (acts, acted) = (normal.in_contact, normal.was_in_contact);
        let meets = (acts & !acted) & (touching & !touched);
        let parts = (acted & !acts) & (touched & !touching);
        let zero = R::zero();
        applied = R::select(meets, sets_in(motion, zero, force), applied);
        applied = R::select(parts, ends(motion, zero, force), applied);
        let before = force.keep_where(parts);
        let half_kick = R::splat(0.5 * motion.time_step) * motion.pair.inverse_reduced_mass();
        closing = R::select(meets | parts, closing + half_kick * (before - applied), closing);
    }
    [applied, closing]
}

/// `way` over `growth`, within 0 and 1; one half where nothing moves.
#[inline(always)]
fn part<R: Real>(way: R, growth: R) -> R {
    let moved = growth.abs().gt(R::zero());
    let safe = R::select(moved, growth, R::one());
    R::select(moved, way / safe, R::splat(0.5)).max(R::zero()).min(R::one())
}
