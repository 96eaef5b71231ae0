//! How a contact's springs against sliding, rolling and torsion follow the two bodies.
//!
//! The constants are the levels of resistance for which [`ContactLaws::respond`] is compiled; each
//! holds the one before.
//!
//! [`ContactLaws::respond`]: crate::ContactLaws::respond

use pulvis_math::{Mask, Real, Vector3};

use crate::conventions::{Conventions, LeverArm, RollingLever};
use crate::energy::ContactEnergies;
use crate::friction::{FrictionResponse, SpringMotion, SpringRotation, SpringSlider, rescaled, twisted};
use crate::model::{ContactKinematics, ContactResponse};
use crate::pair::Pair;

/// No resistance at all.
pub const NONE: u8 = 0;
/// Resistance against sliding, if the contact has it.
pub const SLIDING: u8 = 1;
/// Resistance against sliding, rolling and torsion, whatever of them the contact has.
pub const ALL: u8 = 2;

/// One step of a contact as its springs see it. Luding 2008, section 2.3-2.4.
///
/// Displacements are taken with the normal and the lever arms of mid-step. With those of the end of
/// the step the springs would take in and give back work that no force does, to first order in the
/// step.
pub(crate) struct Resistance<'a, R: Real> {
    conventions: &'a Conventions,
    pair: &'a Pair<R>,
    motion: &'a ContactKinematics<R>,
    touching: R::Mask,
    friction_reference: R,
    overlap: R,
    overlap_mid: R,
    normal_mid: Vector3<R>,
    sideways_mid: Vector3<R>,
    /// How long the contact was closed in this step [s], zero for an open one; and for how long it was not.
    elapsed: R,
    missed: R,
    /// Whether it was for a part of the step.
    began: R::Mask,
}

impl<'a, R: Real> Resistance<'a, R> {
    /// The step of `time_step` [s] that led to `motion`; friction refers to the normal force
    /// `friction_reference` [N].
    #[inline(always)]
    pub(crate) fn new(
        conventions: &'a Conventions,
        pair: &'a Pair<R>,
        motion: &'a ContactKinematics<R>,
        friction_reference: R,
        time_step: f64,
    ) -> Self {
        let touching = motion.overlap.gt(R::zero());
        let overlap = motion.overlap.keep_where(touching);
        let dt = R::splat(time_step);
        let opening = motion.velocity_mid.dot(motion.normal);
        let sideways = motion.velocity_mid - motion.normal * opening;
        // A contact that began within the step has moved for a part of the step only. Few do.
        let approach = opening * R::splat(-time_step);
        let began = touching & overlap.lt(approach);
        let mut elapsed = dt;
        if began.any() {
            elapsed = R::select(began, dt * (overlap / approach), dt);
        }
        let elapsed = elapsed.keep_where(touching);
        let half = R::splat(0.5) * elapsed;
        let half_turn = half * motion.inverse_distance;
        Self {
            conventions,
            pair,
            motion,
            touching,
            friction_reference: friction_reference.keep_where(touching),
            overlap,
            overlap_mid: overlap + half * opening,
            normal_mid: motion.normal - sideways * half_turn,
            sideways_mid: sideways * (R::one() + half_turn * opening),
            elapsed,
            missed: dt - elapsed,
            began,
        }
    }

    /// Adds the force and the torques of the sliding spring.
    #[inline(always)]
    pub(crate) fn slide(
        &self,
        slider: &SpringSlider,
        spring: &mut Vector3<R>,
        response: &mut ContactResponse<R>,
    ) {
        let (motion, normal) = (self.motion, self.motion.normal);
        let (arm_i, arm_j) = self.arms(self.overlap);
        let (mid_i, mid_j) = self.arms(self.overlap_mid);
        // The velocity at the time of the positions is for the dashpot alone.
        let mut velocity = Vector3::zero();
        if slider.dashpot != 0.0 {
            let angular_velocities = motion.angular_velocity_i * arm_i + motion.angular_velocity_j * arm_j;
            velocity = motion.velocity.tangential_to(normal) + normal.cross(angular_velocities);
        }
        let surface_mid = motion.angular_velocity_i_mid * mid_i + motion.angular_velocity_j_mid * mid_j;
        let velocity_mid = self.sideways_mid + self.normal_mid.cross(surface_mid);
        let answer = self.stretch(slider, velocity, velocity_mid, spring);
        let moment = answer.force.cross(normal);
        response.force += answer.force;
        // Sliding comes first: there are no other torques yet.
        response.torque_i = moment * arm_i;
        response.torque_j = moment * arm_j;
        let energies = &mut response.energies;
        energies.elastic_sliding = answer.stored_energy;
        energies.dissipated_sliding = answer.dissipated_slip;
        energies.viscous_power += answer.viscous_power;
    }

    /// Adds the torques of the rolling spring.
    #[inline(always)]
    pub(crate) fn roll(
        &self,
        slider: &SpringSlider,
        (lever, lever_mid): (R, R),
        spring: &mut Vector3<R>,
        response: &mut ContactResponse<R>,
    ) {
        let (motion, normal) = (self.motion, self.motion.normal);
        let mut velocity = Vector3::zero();
        if slider.dashpot != 0.0 {
            velocity = normal.cross(motion.angular_velocity_i - motion.angular_velocity_j) * -lever;
        }
        let angular_velocity_mid = motion.angular_velocity_i_mid - motion.angular_velocity_j_mid;
        let velocity_mid = self.normal_mid.cross(angular_velocity_mid) * -lever_mid;
        let answer = self.stretch(slider, velocity, velocity_mid, spring);
        let energies = &mut response.energies;
        energies.elastic_rolling = answer.stored_energy;
        energies.dissipated_rolling = answer.dissipated_slip;
        turn(normal.cross(answer.force) * lever, answer.viscous_power, response);
    }

    /// Adds the torques of the torsion spring.
    #[inline(always)]
    pub(crate) fn twist(
        &self,
        slider: &SpringSlider,
        (lever, lever_mid): (R, R),
        spring: &mut R,
        response: &mut ContactResponse<R>,
    ) {
        let (motion, normal) = (self.motion, self.motion.normal);
        let mut velocity = R::zero();
        if slider.dashpot != 0.0 {
            velocity = normal.dot(motion.angular_velocity_i - motion.angular_velocity_j) * lever;
        }
        let angular_velocity_mid = motion.angular_velocity_i_mid - motion.angular_velocity_j_mid;
        let velocity_mid = self.normal_mid.dot(angular_velocity_mid) * lever_mid;
        let before = *spring;
        let (mut answer, slips) = slider.respond_along(
            &SpringMotion {
                velocity: velocity.keep_where(self.touching),
                displacement: velocity_mid * self.elapsed,
                friction_reference: self.friction_reference,
            },
            spring,
        );
        if self.works_while_open(slips) {
            let half = R::splat(0.5 * slider.stiffness);
            answer.dissipated_slip += half * (before + *spring) * (velocity_mid * self.missed);
        }
        let energies: &mut ContactEnergies<R> = &mut response.energies;
        energies.elastic_torsion = answer.stored_energy;
        energies.dissipated_torsion = answer.dissipated_slip;
        turn(normal * (lever * answer.force), answer.viscous_power, response);
    }

    /// Carries a spring of the tangent plane along and advances it. What the spring loses on the
    /// way by convention (`project`, `rate`) is booked as slip; rescaled springs lose nothing.
    ///
    /// So is the work of the spring's force in the part of the step in which the contact was open: in
    /// both half kicks the force works all the time. It is of second order without a dashpot. But a
    /// sliding contact's dashpot is held back by its spring (see [`SpringSlider`]), and what the one is
    /// said to lose at touch and at parting, the other must be said to give.
    #[inline(always)]
    fn stretch(
        &self,
        slider: &SpringSlider,
        velocity: Vector3<R>,
        velocity_mid: Vector3<R>,
        spring: &mut Vector3<R>,
    ) -> FrictionResponse<Vector3<R>, R> {
        let (motion, normal) = (self.motion, self.motion.normal);
        let rotation = self.conventions.spring_rotation;
        let before = *spring;
        let mut step = velocity_mid * self.elapsed;
        let carried = match rotation {
            SpringRotation::Rescale => rescaled(before, normal),
            SpringRotation::Project => before.tangential_to(normal),
            SpringRotation::Twist => {
                let half = R::splat(0.5);
                let turned = self.sideways_mid * (motion.inverse_distance * self.elapsed);
                let twist = half
                    * (motion.angular_velocity_i_mid + motion.angular_velocity_j_mid).dot(normal)
                    * self.elapsed;
                // The displacement was made, on average, half a twist ago.
                step += normal.cross(step) * (half * twist);
                twisted(before, normal, turned, twist)
            }
            SpringRotation::Rate => {
                let along = before.dot(motion.velocity_mid) * (motion.inverse_distance * self.elapsed);
                before - normal * along
            }
        };
        *spring = carried;
        let (mut answer, slips) = slider.respond(
            &SpringMotion {
                velocity: velocity.keep_where(self.touching),
                displacement: step.tangential_to(normal),
                friction_reference: self.friction_reference,
            },
            spring,
        );
        let half = R::splat(0.5 * slider.stiffness);
        if self.works_while_open(slips) {
            answer.dissipated_slip += half * (carried + *spring).dot(velocity_mid * self.missed);
        }
        if matches!(rotation, SpringRotation::Project | SpringRotation::Rate) {
            answer.dissipated_slip += half * (before.norm_squared() - carried.norm_squared());
        }
        answer
    }

    /// Whether any spring may have worked in a part of the step in which its contact was open: where it began in this
    /// step, or has opened, with a spring that then `slips` to nothing.
    #[inline(always)]
    fn works_while_open(&self, slips: R::Mask) -> bool {
        (self.began | slips).any()
    }

    /// The distances of the contact point from the two centres [m]. That from a wall means nothing, but is
    /// not positive.
    #[inline(always)]
    fn arms(&self, overlap: R) -> (R, R) {
        let (radius_i, radius_j) = (self.motion.radius_i, self.motion.radius_j);
        match self.conventions.lever_arm {
            LeverArm::Corrected => {
                let half = R::splat(0.5) * overlap;
                (radius_i - half, radius_j - half)
            }
            LeverArm::Radius => (radius_i, radius_j),
        }
    }

    /// The length L of the rolling and torsion velocities [m], at the time of the positions and at
    /// mid-step.
    #[inline(always)]
    pub(crate) fn levers(&self) -> (R, R) {
        match self.conventions.rolling_lever {
            RollingLever::Harmonic => {
                let lever = self.pair.harmonic_radius();
                (lever, lever)
            }
            RollingLever::Reduced => (self.reduced_arm(self.overlap), self.reduced_arm(self.overlap_mid)),
        }
    }

    /// The product of the two arms over their sum, at a wall the one arm [m].
    #[inline(always)]
    fn reduced_arm(&self, overlap: R) -> R {
        let (arm_i, arm_j) = self.arms(overlap);
        let at_wall = arm_j.le(R::zero());
        R::select(at_wall, arm_i, arm_i * arm_j / (arm_i + arm_j))
    }
}

/// Adds a torque on i, its opposite on j, and the power of the dashpot.
#[inline(always)]
fn turn<R: Real>(torque: Vector3<R>, viscous_power: R, response: &mut ContactResponse<R>) {
    response.torque_i += torque;
    response.torque_j -= torque;
    response.energies.viscous_power += viscous_power;
}
