//! How a contact's springs against sliding, rolling and torsion follow the two bodies.

use pulvis_math::{Mask, Real, Vector3};

use crate::catalogue::Role;
use crate::conventions::{Conventions, LeverArm, RollingLever};
use crate::energy::ContactEnergies;
use crate::friction::{
    Along, CommonFriction, Friction, FrictionLaw, FrictionResponse, FrictionVisitor, SpringMotion,
    SpringRotation, Tangent, rescaled, twisted,
};
use crate::kinematics::{ContactInputs, ContactKinematics};
use crate::memory::{self, Columns};
use crate::normal::{NormalResponse, NormalSource};
use crate::pair::Pair;
use crate::response::ContactResponse;

/// One step of a contact as its springs see it. Luding 2008, section 2.3-2.4.
///
/// Displacements are taken with the normal and the lever arms of mid-step. With those of the end of
/// the step the springs would take in and give back work that no force does, to first order in the
/// step.
pub(crate) struct Resistance<'a, R: Real> {
    conventions: &'a Conventions,
    pair: &'a Pair<R>,
    motion: &'a ContactKinematics<R>,
    in_contact: R::Mask,
    contact_radius: R,
    pull_off_force: R,
    normal_stiffness: R,
    friction_reference: R,
    overlap: R,
    overlap_mid: R,
    normal_rate: Option<Vector3<R>>,
    normal_mid: Vector3<R>,
    sideways_mid: Vector3<R>,
    /// How long the contact was closed in this step [s], zero for an open one; and for how long it was not.
    elapsed: R,
    missed: R,
    /// Whether it was for a part of the step.
    began: R::Mask,
}

impl<'a, R: Real> Resistance<'a, R> {
    /// The step that led to `inputs`, in which the normal law gave the answer `normal`; friction refers to the normal
    /// force `friction_reference` [N].
    #[inline(always)]
    pub(crate) fn new<N: NormalSource<R>>(
        conventions: &'a Conventions,
        inputs: ContactInputs<'a, R>,
        normal: &NormalResponse<R>,
        friction_reference: R,
    ) -> Self {
        let ContactInputs { pair, motion, time_step, .. } = inputs;
        let in_contact = normal.in_contact;
        let overlap = motion.overlap.keep_where(in_contact);
        let dt = R::splat(time_step);
        let opening = motion.velocity_mid.dot(motion.normal);
        let sideways = motion.velocity_mid - motion.normal * opening;
        // A contact that began within the step has moved for a part of the step only. Few do. Some laws attach bodies anew
        // that overlap by more than they approached: these have moved for the step at the most.
        let approach = opening * R::splat(-time_step);
        let began = in_contact & !normal.was_in_contact;
        let mut elapsed = dt;
        if began.any() {
            let part = (overlap / approach).min(R::one());
            elapsed = R::select(began & approach.gt(R::zero()), dt * part, dt);
        }
        let elapsed = elapsed.keep_where(in_contact);
        let half = R::splat(0.5) * elapsed;
        let half_turn = half * motion.inverse_distance;
        let mut normal_mid = motion.normal - sideways * half_turn;
        let mut sideways_mid = sideways * (R::one() + half_turn * opening);
        // Only walls are curved.
        let normal_rate = if N::CURVED { motion.normal_rate } else { None };
        if let Some(rate) = normal_rate {
            normal_mid = motion.normal - rate * half;
            sideways_mid = sideways + rate * (half * opening);
        }
        Self {
            conventions,
            pair,
            motion,
            in_contact,
            contact_radius: normal.contact_radius,
            pull_off_force: normal.pull_off_force,
            normal_stiffness: normal.stiffness,
            friction_reference: friction_reference.keep_where(in_contact),
            overlap,
            overlap_mid: overlap + half * opening,
            normal_rate,
            normal_mid,
            sideways_mid,
            elapsed,
            missed: dt - elapsed,
            began,
        }
    }

    /// Adds the force and the torques of the law against sliding, whose memory begins at the column `start`.
    #[inline(always)]
    pub(crate) fn slide<N: NormalSource<R>, C: Columns<R> + ?Sized>(
        &self,
        law: &Friction,
        start: usize,
        columns: &mut C,
        response: &mut ContactResponse<R>,
    ) {
        let (motion, normal) = (self.motion, self.motion.normal);
        let (arm_i, arm_j) = self.arms(self.overlap);
        let (mid_i, mid_j) = self.arms(self.overlap_mid);
        // The velocity at the time of the positions is for the dashpot alone.
        let mut velocity = Vector3::zero();
        if law.dashpot() != 0.0 {
            let surface = motion.angular_velocity_i * arm_i + motion.angular_velocity_j * arm_j;
            velocity = motion.velocity.tangential_to(normal) + normal.cross(surface);
        }
        let surface_mid = motion.angular_velocity_i_mid * mid_i + motion.angular_velocity_j_mid * mid_j;
        let velocity_mid = self.sideways_mid + self.normal_mid.cross(surface_mid);
        let stretch =
            Stretch::<R, C, false> { step: self, velocity, velocity_mid, lever: R::one(), start, columns };
        let Some(answer) = ask(law, N::COMMON, stretch) else { return };
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

    /// Adds the torques of the law against rolling.
    #[inline(always)]
    pub(crate) fn roll<N: NormalSource<R>, C: Columns<R> + ?Sized>(
        &self,
        law: &Friction,
        (lever, lever_mid): (R, R),
        start: usize,
        columns: &mut C,
        response: &mut ContactResponse<R>,
    ) {
        let (motion, normal) = (self.motion, self.motion.normal);
        let mut velocity = Vector3::zero();
        if law.dashpot() != 0.0 {
            velocity = normal.cross(motion.angular_velocity_i - motion.angular_velocity_j) * -lever;
        }
        let rolling_mid = motion.angular_velocity_i_mid - motion.angular_velocity_j_mid;
        let velocity_mid = self.normal_mid.cross(rolling_mid) * -lever_mid;
        let stretch = Stretch::<R, C, true> { step: self, velocity, velocity_mid, lever, start, columns };
        let Some(answer) = ask(law, N::COMMON.and(Some(ROTATION)), stretch) else { return };
        let energies = &mut response.energies;
        energies.elastic_rolling = answer.stored_energy;
        energies.dissipated_rolling = answer.dissipated_slip;
        turn(normal.cross(answer.force) * lever, answer.viscous_power, response);
    }

    /// Adds the torques of the law against torsion.
    #[inline(always)]
    pub(crate) fn twist<N: NormalSource<R>, C: Columns<R> + ?Sized>(
        &self,
        law: &Friction,
        (lever, lever_mid): (R, R),
        start: usize,
        columns: &mut C,
        response: &mut ContactResponse<R>,
    ) {
        let (motion, normal) = (self.motion, self.motion.normal);
        let mut velocity = R::zero();
        if law.dashpot() != 0.0 {
            velocity = normal.dot(motion.angular_velocity_i - motion.angular_velocity_j) * lever;
        }
        let twisting_mid = motion.angular_velocity_i_mid - motion.angular_velocity_j_mid;
        let velocity_mid = self.normal_mid.dot(twisting_mid) * lever_mid;
        let twist = Twist { step: self, velocity, velocity_mid, lever, start, columns };
        let Some(answer) = ask(law, N::COMMON.and(Some(ROTATION)), twist) else { return };
        let energies: &mut ContactEnergies<R> = &mut response.energies;
        energies.elastic_torsion = answer.stored_energy;
        energies.dissipated_torsion = answer.dissipated_slip;
        turn(normal * (lever * answer.force.0), answer.viscous_power, response);
    }

    /// A vector of the tangent plane turned with the contact, and a displacement [m] as seen from there.
    #[inline(always)]
    fn carried(&self, before: Vector3<R>, displacement: Vector3<R>) -> (Vector3<R>, Vector3<R>) {
        let (motion, normal) = (self.motion, self.motion.normal);
        match self.conventions.spring_rotation {
            SpringRotation::Rescale => (rescaled(before, normal), displacement),
            SpringRotation::Project => (before.tangential_to(normal), displacement),
            SpringRotation::Twist => {
                let half = R::splat(0.5);
                let turned = match self.normal_rate {
                    None => self.sideways_mid * (motion.inverse_distance * self.elapsed),
                    Some(rate) => rate * self.elapsed,
                };
                let twist = half
                    * (motion.angular_velocity_i_mid + motion.angular_velocity_j_mid).dot(normal)
                    * self.elapsed;
                // The displacement was made, on average, half a twist ago.
                let seen = displacement + normal.cross(displacement) * (half * twist);
                (twisted(before, normal, turned, twist), seen)
            }
            SpringRotation::Rate => {
                let along = match self.normal_rate {
                    None => before.dot(motion.velocity_mid) * (motion.inverse_distance * self.elapsed),
                    Some(rate) => before.dot(rate) * self.elapsed,
                };
                (before - normal * along, displacement)
            }
        }
    }

    /// The motion that springs follow, with the velocity that dashpots see.
    #[inline(always)]
    fn spring_motion<T: Tangent<R>>(&self, velocity: T, displacement: T, lever: R) -> SpringMotion<T, R> {
        SpringMotion {
            velocity: T::select(self.in_contact, velocity, T::zero()),
            displacement,
            elapsed: self.elapsed,
            in_contact: self.in_contact,
            friction_reference: self.friction_reference,
            contact_radius: self.contact_radius,
            pull_off_force: self.pull_off_force,
            normal_stiffness: self.normal_stiffness,
            lever,
            slip_dashpot: self.conventions.slip_dashpot,
        }
    }

    /// Whether any spring may have worked in a part of the step in which its contact was open: where it began in this
    /// step, or has opened, with a spring that then `slips` to nothing.
    #[inline(always)]
    fn works_while_open(&self, slips: R::Mask) -> bool {
        (self.began | slips).any()
    }

    /// The distances of the contact point from the two centres [m]; of a wall from the nearest point of its
    /// surface, into the particle, so it is not positive.
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

/// The law against rolling and torsion that common contacts have.
const ROTATION: CommonFriction = CommonFriction::SpringSlider;

/// Hands a law to the visitor; in loops for common contacts only the common one.
#[inline(always)]
fn ask<V: FrictionVisitor>(law: &Friction, common: Option<CommonFriction>, visitor: V) -> Option<V::Output> {
    match common {
        Some(common) => law.accept_common(common, visitor),
        None => law.accept_in_role(visitor),
    }
}

/// Adds a torque on i, its opposite on j, and the power of the dashpot.
#[inline(always)]
fn turn<R: Real>(torque: Vector3<R>, viscous_power: R, response: &mut ContactResponse<R>) {
    response.torque_i += torque;
    response.torque_j -= torque;
    response.energies.viscous_power += viscous_power;
}

/// A spring of the tangent plane on its way through a step.
struct Stretch<'a, R: Real, C: ?Sized, const ROLLS: bool> {
    step: &'a Resistance<'a, R>,
    velocity: Vector3<R>,
    velocity_mid: Vector3<R>,
    lever: R,
    start: usize,
    columns: &'a mut C,
}

impl<R: Real, C: Columns<R> + ?Sized, const ROLLS: bool> FrictionVisitor for Stretch<'_, R, C, ROLLS> {
    const ROLE: Option<Role> = Some(if ROLLS { Role::Rolling } else { Role::Sliding });
    type Output = FrictionResponse<Vector3<R>, R>;

    /// Carries the spring along and advances it. What it loses on the way by convention (`project`, `rate`) is booked
    /// as slip; rescaled springs lose nothing.
    ///
    /// So is the work of the spring's force in the part of the step in which the contact was open: in both half kicks
    /// the force works all the time. It is of second order without a dashpot.
    #[inline(always)]
    fn visit<F: FrictionLaw>(self, law: &F) -> Self::Output {
        let Self { step, velocity, velocity_mid, lever, start, columns } = self;
        let before: Vector3<R> = memory::load_vector(columns, start);
        let mut scalars: F::Scalars<R> = memory::load(columns, start + 3);
        let (carried, displacement) = step.carried(before, velocity_mid * step.elapsed);
        let mut spring = carried;
        let normal = step.motion.normal;
        let motion = step.spring_motion(velocity, displacement.tangential_to(normal), lever);
        let (mut answer, slips) = law.respond(&motion, &mut spring, &mut scalars);
        if step.works_while_open(slips) {
            let mean = law.elastic_force((carried + spring) * R::splat(0.5));
            answer.dissipated_slip += mean.dot(velocity_mid * step.missed);
        }
        if matches!(step.conventions.spring_rotation, SpringRotation::Project | SpringRotation::Rate) {
            answer.dissipated_slip += law.lost_by_shortening(before.norm_squared(), carried.norm_squared());
        }
        memory::store_vector(spring, columns, start);
        memory::store(&scalars, columns, start + 3);
        answer
    }
}

/// A spring along the line of centres on its way through a step.
struct Twist<'a, R: Real, C: ?Sized> {
    step: &'a Resistance<'a, R>,
    velocity: R,
    velocity_mid: R,
    lever: R,
    start: usize,
    columns: &'a mut C,
}

impl<R: Real, C: Columns<R> + ?Sized> FrictionVisitor for Twist<'_, R, C> {
    const ROLE: Option<Role> = Some(Role::Torsion);
    type Output = FrictionResponse<Along<R>, R>;

    #[inline(always)]
    fn visit<F: FrictionLaw>(self, law: &F) -> Self::Output {
        let Self { step, velocity, velocity_mid, lever, start, columns } = self;
        let before = Along(columns.get(start));
        let mut scalars: F::Scalars<R> = memory::load(columns, start + 1);
        let displacement = Along(velocity_mid * step.elapsed);
        let motion = step.spring_motion(Along(velocity), displacement, lever);
        let mut spring = before;
        let (mut answer, slips) = law.respond(&motion, &mut spring, &mut scalars);
        if step.works_while_open(slips) {
            let mean = law.elastic_force((before + spring).scaled(R::splat(0.5)));
            answer.dissipated_slip += mean.0 * (velocity_mid * step.missed);
        }
        columns.set(start, spring.0);
        memory::store(&scalars, columns, start + 1);
        answer
    }
}
