//! The step in which a bond breaks.
//!
//! The bond acted up to the instant θ of its last step, with forces that grew from F_0 to F_b. The bodies get the impulse
//! θ (F_0 + F_b) dt/2 by ½ [θ (F_0 + F_b) − F_0] at the end of the step, which the two half kicks apply (see
//! [`events`](crate::events)); this is (θ − ½) F where the force hardly changes within a step. What is lost is what the
//! springs stored at θ. Work, impulse and loss hold for steps of any length.

use pulvis_math::Real;

use super::step::{BondStep, Stretch};
use super::{Bond, BondStiffness};

/// Halvings by which the instant of breaking is found: to 1e-12 of the step.
const HALVINGS: usize = 40;

/// What a bond does in the step in which it breaks.
pub(super) struct Breaking<R: Real> {
    /// The springs whose forces the bodies feel at the end of the step.
    pub(super) applied: Stretch<R>,
    /// The part of the forces of its dashpots that they feel, θ − ½ [1].
    pub(super) weight: R,
    /// What the springs stored when it broke [J].
    pub(super) stored: R,
}

impl Bond {
    /// Finds where in a step of `time_step` [s] a bond broke that holds no more at its end. Bonds that `form` in it had no
    /// force before.
    #[inline(always)]
    pub(super) fn breaking<R: Real>(
        &self,
        step: &BondStep<R>,
        stiffness: &BondStiffness<R>,
        harmonic_radius: R,
        time_step: f64,
        forms: R::Mask,
    ) -> Breaking<R> {
        let (zero, one, half) = (R::zero(), R::one(), R::splat(0.5));
        // The part of the step that was left.
        let (mut left, mut before) = (zero, one);
        for _ in 0..HALVINGS {
            let middle = half * (left + before);
            let exceeds = self.criterion.exceeded(&step.before_end(middle).loads(stiffness, harmonic_radius));
            left = R::select(exceeds, middle, left);
            before = R::select(exceeds, before, middle);
        }
        let event = step.before_end(left);
        // Without a step, no time has passed in which the bond acted.
        let moves = if time_step > 0.0 { one } else { zero };
        let acted = moves * (one - left);
        let no_start = R::select(forms, zero, moves);
        let start = step.before_end(one).scaled(no_start);
        Breaking {
            applied: start.plus(&event).scaled(half * acted).plus(&start.scaled(-half)),
            weight: acted - half * moves,
            stored: event.energy(stiffness),
        }
    }
}
