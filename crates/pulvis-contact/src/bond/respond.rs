//! What a bond answers to a motion.

use pulvis_math::{Mask, Real, Vector3};

use super::memory::{BROKEN, BondMemory, INTACT};
use super::step::{BondStep, Stretch, arms};
use super::{Bond, BondStiffness, Form};
use crate::energy::ContactEnergies;
use crate::kinematics::{ContactInputs, ContactKinematics};
use crate::memory::{self, Columns};
use crate::response::ContactResponse;

/// How far apart the contact's own laws see bodies whose bond takes their place, over the sum of the radii.
const OUT_OF_RANGE: f64 = 1e6;

/// Forces, torques and energies of a bond, and the overlap that the laws of the contact see beside it.
#[derive(Clone, Copy, Debug)]
pub struct BondResponse<R: Real> {
    /// Force on i along the normal, repulsion positive [N].
    pub normal_force: R,
    /// The part of it that is there only because the bond formed or broke within the step [N].
    pub event_force: R,
    /// Force on i [N].
    pub force: Vector3<R>,
    /// Torque on i [N m].
    pub torque_i: Vector3<R>,
    /// Torque on j; on a wall about the point nearest to i [N m].
    pub torque_j: Vector3<R>,
    /// Stored in the springs [J].
    pub stored_energy: R,
    /// What bonds stored that have broken since the last call [J].
    pub dissipated: R,
    /// Power of the dashpots [W].
    pub viscous_power: R,
    /// The overlap that the contact's own laws see [m].
    contact_overlap: R,
    /// By how much they see the bodies shortened: half of it each [m].
    worn: R,
}

// Not derived: what is derived is not inlined by force.
impl<R: Real> Default for BondResponse<R> {
    #[inline(always)]
    fn default() -> Self {
        let (zero, none) = (R::zero(), Vector3::zero());
        Self {
            normal_force: zero,
            event_force: zero,
            force: none,
            torque_i: none,
            torque_j: none,
            stored_energy: zero,
            dissipated: zero,
            viscous_power: zero,
            contact_overlap: zero,
            worn: zero,
        }
    }
}

impl<R: Real> BondResponse<R> {
    /// The motion as the contact's own laws see it beside the bond.
    #[inline(always)]
    pub fn beside(&self, motion: &ContactKinematics<R>) -> ContactKinematics<R> {
        let half = R::splat(0.5) * self.worn;
        ContactKinematics {
            overlap: self.contact_overlap,
            radius_i: motion.radius_i - half,
            radius_j: motion.radius_j - half,
            ..*motion
        }
    }

    /// Adds the bond to the answer of the contact's own laws.
    #[inline(always)]
    pub fn add_to(&self, response: &mut ContactResponse<R>) {
        response.normal_force += self.normal_force;
        response.event_force += self.event_force;
        response.force += self.force;
        response.torque_i += self.torque_i;
        response.torque_j += self.torque_j;
        let energies: &mut ContactEnergies<R> = &mut response.energies;
        energies.elastic_bond += self.stored_energy;
        energies.dissipated_fracture += self.dissipated;
        energies.viscous_power += self.viscous_power;
    }
}

impl Bond {
    /// The answer to a motion; updates the memory, which begins at the column `start`.
    ///
    /// A bond that exceeds its strength breaks within the step; what the bodies feel of it then stands in `breaking.rs`.
    #[inline(always)]
    pub fn respond<R: Real, C: Columns<R> + ?Sized>(
        &self,
        inputs: ContactInputs<'_, R>,
        start: usize,
        columns: &mut C,
    ) -> BondResponse<R> {
        let motion = inputs.motion;
        let zero = R::zero();
        let mut memory: BondMemory<R> = memory::load(columns, start);
        let forms = self.form_by_touch(inputs, &mut memory);
        let intact = memory.state.gt(zero);
        let mut response = BondResponse { contact_overlap: motion.overlap, ..BondResponse::default() };
        if self.hides_contact() {
            (response.contact_overlap, response.worn) = overlap_beside(motion, intact, &mut memory);
        }
        if intact.any() {
            self.respond_intact(inputs, intact, forms, &mut memory, &mut response);
        }
        memory::store(&memory, columns, start);
        response
    }

    /// Bonds bodies that touch for the first time; answers with where it did. The bond has no force at touch. Of bodies that
    /// overlap already, in a first look, it has none at their overlap.
    #[inline(always)]
    fn form_by_touch<R: Real>(&self, inputs: ContactInputs<'_, R>, memory: &mut BondMemory<R>) -> R::Mask {
        let zero = R::zero();
        if self.formation.form != Form::FirstTouch {
            return zero.gt(zero);
        }
        let motion = inputs.motion;
        let fresh = memory.state.le(zero) & memory.state.ge(zero);
        let forms = fresh & motion.overlap.gt(zero);
        if forms.any() {
            let growth = motion.velocity_mid.dot(motion.normal) * R::splat(-inputs.time_step);
            let overlapped = motion.overlap.gt(growth);
            memory.overlap = R::select(forms, motion.overlap.keep_where(overlapped), memory.overlap);
            memory.state = R::select(forms, R::splat(INTACT), memory.state);
        }
        forms
    }

    #[inline(always)]
    fn respond_intact<R: Real>(
        &self,
        inputs: ContactInputs<'_, R>,
        intact: R::Mask,
        forms: R::Mask,
        memory: &mut BondMemory<R>,
        response: &mut BondResponse<R>,
    ) {
        let zero = R::zero();
        let motion = inputs.motion;
        let harmonic = inputs.pair.harmonic_radius();
        let stiffness = self.stiffness_between(motion, memory);
        let step = BondStep::new(inputs, memory, forms, self.springs.at_mid_length());
        let end = step.before_end(zero);
        let breaks = intact & self.criterion.exceeded(&end.loads(&stiffness, harmonic));
        let (mut stretch, mut weight) = (end, step.dashpots);
        if breaks.any() {
            let breaking = self.breaking(&step, &stiffness, harmonic, inputs.time_step, forms);
            response.dissipated = breaking.stored.keep_where(breaks);
            weight = R::select(breaks, breaking.weight, weight);
            stretch = Stretch::select(breaks, breaking.applied, end);
        }
        response.stored_energy = end.energy(&stiffness).keep_where(intact & !breaks);
        self.answer(inputs, &stiffness, &stretch, (intact, weight), response);
        response.event_force = R::select(breaks, response.normal_force, response.event_force);
        let springs = intact & !breaks;
        memory.shear = end.shear.keep_where(springs);
        memory.bending = end.bending.keep_where(springs);
        memory.twist = end.twist.keep_where(springs);
        memory.state = R::select(breaks, R::splat(BROKEN), memory.state);
        // A little more than the overlap: whether the contact sets in within the next step is then no matter of round-off.
        let worn = R::splat(1.0 + 1e-12) * motion.overlap;
        let begin = if self.hides_contact() { worn.max(zero) } else { zero };
        memory.overlap = R::select(breaks, begin, memory.overlap);
    }

    /// The stiffnesses of bonds between these bodies, of the length that they had when the bonds formed.
    #[inline(always)]
    fn stiffness_between<R: Real>(
        &self,
        motion: &ContactKinematics<R>,
        memory: &BondMemory<R>,
    ) -> BondStiffness<R> {
        let (radius_i, radius_j) = (motion.radius_i, motion.radius_j);
        // A wall has no radius, and is larger than any body.
        let smaller = R::select(radius_j.gt(R::zero()), radius_i.min(radius_j), radius_i);
        self.springs.stiffness(radius_i + radius_j - memory.overlap, smaller)
    }

    /// Forces and torques where the bond is `intact`, those of dashpots times `weight`.
    #[inline(always)]
    fn answer<R: Real>(
        &self,
        inputs: ContactInputs<'_, R>,
        stiffness: &BondStiffness<R>,
        stretch: &Stretch<R>,
        (intact, weight): (R::Mask, R),
        response: &mut BondResponse<R>,
    ) {
        let motion = inputs.motion;
        let normal = motion.normal;
        let [arm_i, arm_j] = arms(motion, motion.overlap, self.springs.at_mid_length());
        let mut along = stiffness.normal * stretch.pressed;
        let mut shear = stretch.shear * -stiffness.shear;
        let mut bending = stretch.bending * -stiffness.bending;
        let mut torsion = -(stiffness.torsion * stretch.twist);
        if self.springs.has_dashpot() {
            let [dashpot, of_shear, of_bending, of_torsion] = self.springs.dashpots(stiffness);
            let closing = -motion.velocity.dot(normal);
            let (turn_i, turn_j) = (motion.angular_velocity_i, motion.angular_velocity_j);
            let slip = motion.velocity.tangential_to(normal) + normal.cross(turn_i * arm_i + turn_j * arm_j);
            let turning = turn_i - turn_j;
            let (twists, bends) = (turning.dot(normal), turning.tangential_to(normal));
            let viscous = dashpot * closing;
            along += weight * viscous;
            response.event_force = ((weight - R::one()) * viscous).keep_where(intact);
            shear -= slip * (weight * of_shear);
            bending -= bends * (weight * of_bending);
            torsion -= weight * of_torsion * twists;
            let power = dashpot * closing * closing
                + of_shear * slip.norm_squared()
                + of_bending * bends.norm_squared()
                + of_torsion * twists * twists;
            response.viscous_power = (weight * power).keep_where(intact);
        }
        response.normal_force = along.keep_where(intact);
        let lever = shear.cross(normal);
        let moment = bending + normal * torsion;
        response.force = (normal * response.normal_force + shear).keep_where(intact);
        response.torque_i = (lever * arm_i + moment).keep_where(intact);
        response.torque_j = (lever * arm_j - moment).keep_where(intact);
    }
}

/// The overlap that the contact's own laws see where the bond takes their place, and by how much they see the bodies
/// shortened [m]. While the bond holds, the bodies are far apart to them. After breaking they begin without overlap where
/// the bond left the bodies, until these come apart.
#[inline(always)]
fn overlap_beside<R: Real>(
    motion: &ContactKinematics<R>,
    intact: R::Mask,
    memory: &mut BondMemory<R>,
) -> (R, R) {
    let worn = memory.overlap.keep_where(!intact & motion.overlap.gt(R::zero()));
    memory.overlap = R::select(intact, memory.overlap, worn);
    let away = (motion.radius_i + motion.radius_j) * R::splat(-OUT_OF_RANGE);
    (R::select(intact, away, motion.overlap - worn), worn)
}
