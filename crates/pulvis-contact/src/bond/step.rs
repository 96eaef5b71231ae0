//! One step of a bond: how its springs stretch while they turn with the pair.

use pulvis_math::{Mask, Real, Vector3};

use super::BondStiffness;
use super::loads::BondLoads;
use super::memory::BondMemory;
use super::transport::Transport;
use crate::kinematics::{ContactInputs, ContactKinematics};

/// The springs of a bond before a step, turned to its end, and what the step adds to them.
///
/// Displacements are taken with the normal and the lever arms of mid-step, as those of friction are.
#[derive(Clone, Copy, Debug)]
pub(super) struct BondStep<R: Real> {
    before: BondMemory<R>,
    shear: Vector3<R>,
    bending: Vector3<R>,
    twist: R,
    /// Overlap now, and its growth in the step [m].
    overlap: R,
    growth: R,
    /// How dashpots of bonds that formed as the bodies met in this step act at its end: as forces that set in within it,
    /// see [`events`](crate::events); one of all others.
    pub(super) dashpots: R,
}

/// The springs of a bond at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<R: Real> {
    /// How much larger the overlap is than without normal force [m].
    pub(super) pressed: R,
    /// [m]
    pub(super) shear: Vector3<R>,
    /// [rad]
    pub(super) bending: Vector3<R>,
    /// [rad]
    pub(super) twist: R,
}

/// The distances of the bond's springs from the two centres [m]; of a wall from the nearest point of its surface, into
/// the particle.
#[inline(always)]
pub(super) fn arms<R: Real>(motion: &ContactKinematics<R>, overlap: R, at_mid_length: bool) -> [R; 2] {
    let half = R::splat(0.5);
    if at_mid_length {
        let arm = half * (motion.radius_i + motion.radius_j - overlap);
        return [arm; 2];
    }
    [motion.radius_i - half * overlap, motion.radius_j - half * overlap]
}

impl<R: Real> BondStep<R> {
    /// The step that led to `inputs`; bonds that `form` in it have been stretched for a part of it only.
    #[inline(always)]
    pub(super) fn new(
        inputs: ContactInputs<'_, R>,
        before: &BondMemory<R>,
        forms: R::Mask,
        at_mid_length: bool,
    ) -> Self {
        let ContactInputs { motion, time_step, .. } = inputs;
        let (normal, half) = (motion.normal, R::splat(0.5));
        let dt = R::splat(time_step);
        let opening = motion.velocity_mid.dot(normal);
        let growth = opening * R::splat(-time_step);
        let (mut elapsed, mut dashpots) = (dt, R::one());
        if forms.any() {
            let met = forms & growth.gt(motion.overlap);
            let part = motion.overlap / growth;
            elapsed = R::select(forms, R::zero(), elapsed);
            elapsed = R::select(met, dt * part, elapsed);
            dashpots = R::select(met, part + half, dashpots);
        }
        let half_time = half * elapsed;
        let half_turn = half_time * motion.inverse_distance;
        let sideways = motion.velocity_mid - normal * opening;
        let mut old_normal = normal - motion.velocity_mid * (dt * motion.inverse_distance);
        let mut normal_mid = normal - sideways * half_turn;
        let mut sideways_mid = sideways * (R::one() + half_turn * opening);
        // Only walls are curved.
        if let Some(rate) = motion.normal_rate {
            old_normal = normal - rate * dt;
            normal_mid = normal - rate * half_time;
            sideways_mid = sideways + rate * (half_time * opening);
        }
        let [arm_i, arm_j] = arms(motion, motion.overlap + half_time * opening, at_mid_length);
        let (turn_i, turn_j) = (motion.angular_velocity_i_mid, motion.angular_velocity_j_mid);
        let turning = turn_i - turn_j;
        let slip = sideways_mid + normal_mid.cross(turn_i * arm_i + turn_j * arm_j);
        let common = half * dt * (turn_i + turn_j).dot(normal);
        let transport = Transport::new(old_normal, normal, common);
        // What was done on the way has turned, on average, by half of it.
        let (sheared, bent) = (slip * elapsed, turning.tangential_to(normal_mid) * elapsed);
        let (sheared, bent) =
            (turned_by(sheared, normal, half * common), turned_by(bent, normal, half * common));
        let turned = BondMemory {
            shear: transport.of(before.shear),
            bending: transport.of(before.bending),
            ..*before
        };
        Self {
            before: turned,
            shear: sheared,
            bending: bent,
            twist: normal_mid.dot(turning) * elapsed,
            overlap: motion.overlap,
            growth,
            dashpots,
        }
    }

    /// The springs when a `part` of the step was left.
    #[inline(always)]
    pub(super) fn before_end(&self, part: R) -> Stretch<R> {
        let done = R::one() - part;
        Stretch {
            pressed: self.overlap - self.growth * part - self.before.overlap,
            shear: self.before.shear + self.shear * done,
            bending: self.before.bending + self.bending * done,
            twist: self.before.twist + self.twist * done,
        }
    }
}

/// A vector turned about the normal by a small angle, without its part along the normal.
#[inline(always)]
fn turned_by<R: Real>(vector: Vector3<R>, normal: Vector3<R>, angle: R) -> Vector3<R> {
    (vector + normal.cross(vector) * angle).tangential_to(normal)
}

impl<R: Real> Stretch<R> {
    /// What loads the bond.
    #[inline(always)]
    pub(super) fn loads(&self, stiffness: &BondStiffness<R>, harmonic_radius: R) -> BondLoads<R> {
        BondLoads {
            normal: stiffness.normal * self.pressed,
            shear: stiffness.shear * self.shear.norm(),
            bending: stiffness.bending * self.bending.norm(),
            torsion: (stiffness.torsion * self.twist).abs(),
            section_radius: stiffness.section_radius,
            harmonic_radius,
        }
    }

    /// What the springs store [J].
    #[inline(always)]
    pub(super) fn energy(&self, stiffness: &BondStiffness<R>) -> R {
        let sum = stiffness.normal * self.pressed * self.pressed
            + stiffness.shear * self.shear.norm_squared()
            + stiffness.bending * self.bending.norm_squared()
            + stiffness.torsion * self.twist * self.twist;
        R::splat(0.5) * sum
    }

    /// All of them times a number.
    #[inline(always)]
    pub(super) fn scaled(&self, factor: R) -> Self {
        Self {
            pressed: self.pressed * factor,
            shear: self.shear * factor,
            bending: self.bending * factor,
            twist: self.twist * factor,
        }
    }

    /// The sum.
    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self {
            pressed: self.pressed + other.pressed,
            shear: self.shear + other.shear,
            bending: self.bending + other.bending,
            twist: self.twist + other.twist,
        }
    }

    /// Those of `then` where `mask` holds, of `otherwise` elsewhere.
    #[inline(always)]
    pub(super) fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        Self {
            pressed: R::select(mask, then.pressed, otherwise.pressed),
            shear: Vector3::select(mask, then.shear, otherwise.shear),
            bending: Vector3::select(mask, then.bending, otherwise.bending),
            twist: R::select(mask, then.twist, otherwise.twist),
        }
    }
}
