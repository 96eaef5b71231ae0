//! What a normal law answers.

use pulvis_math::Real;

use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// What a normal law answers to a motion.
#[derive(Clone, Copy, Debug)]
pub struct NormalResponse<R: Real = f64> {
    /// Rate-independent force f_hys, repulsion positive [N].
    pub force: R,
    /// The force on the bodies over this step [N]: `force`, but where it sets in or ends within the step weighted by the
    /// part of the step in which it acted, so that a jump costs no order of the time integration.
    pub applied_force: R,
    /// Whether friction and dashpots act.
    pub in_contact: R::Mask,
    /// Whether they did before the step.
    pub was_in_contact: R::Mask,
    /// What friction learns of the normal force: the distance f_hys + k_c δ from the law's tensile
    /// limit, never negative [N].
    pub friction_reference: R,
    /// Radius of the contact area; zero for laws that know none [m].
    pub contact_radius: R,
    /// Force that pulls the bodies apart, of a neck that friction can peel; zero for laws that know none [N].
    pub pull_off_force: R,
    /// Elastic stiffness of the normal force here, never negative [N/m].
    pub stiffness: R,
    /// Coefficient of the law's own dashpot [kg/s].
    pub dashpot: R,
    /// How far the contact has hardened, (k2 − k1)/(kp − k1), from 0 (virgin) to 1; laws that do not
    /// harden: 1.
    pub hardening: R,
    /// One over the overlap that the law takes as its scale (Luding: δ_p; elastic laws: a12) [1/m].
    pub inverse_overlap_scale: R,
    /// Energy that the contact gives back along its elastic branch [J].
    pub stored_energy: R,
    /// Potential of an attraction that belongs to the law, zero for bodies apart [J].
    pub adhesive_potential: R,
    /// Energy lost to plastic deformation since the last call [J].
    pub dissipated_plastic: R,
    /// Energy lost on the adhesive limit branch, and where an attraction sets in or breaks, since the last call [J].
    pub dissipated_adhesive: R,
    /// Energy lost since the last call because parameters changed with time or temperature; negative where the change did
    /// work on the contact [J].
    pub dissipated_thermal: R,
}

impl<R: Real> NormalResponse<R> {
    /// A repulsive `force` [N] with a potential `stored_energy` [J] and a slope `stiffness` [N/m]: what elastic laws
    /// answer. Friction refers to the force itself.
    #[inline(always)]
    pub fn elastic(motion: &NormalMotion<R>, force: R, stored_energy: R, stiffness: R) -> Self {
        Self {
            force,
            applied_force: force,
            in_contact: motion.touching,
            was_in_contact: motion.touched_before(),
            friction_reference: force,
            contact_radius: R::zero(),
            pull_off_force: R::zero(),
            stiffness,
            dashpot: R::zero(),
            hardening: R::one(),
            inverse_overlap_scale: motion.pair.inverse_harmonic_radius(),
            stored_energy,
            adhesive_potential: R::zero(),
            dissipated_plastic: R::zero(),
            dissipated_adhesive: R::zero(),
            dissipated_thermal: R::zero(),
        }
    }

    /// No answer yet.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = R::zero();
        Self::elastic(&NormalMotion::at_rest(&Pair::from_sums(zero, zero), zero), zero, zero, zero)
    }
}
