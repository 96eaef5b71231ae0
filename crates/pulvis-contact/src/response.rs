//! What a contact answers to a motion.

use pulvis_math::{Real, Vector3};

use crate::energy::ContactEnergies;

/// Forces, torques and energies of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactResponse<R> {
    /// Total force along the normal, repulsion positive [N].
    pub normal_force: R,
    /// The part of it that only weights a force that set in, or ended, within the step (see [`events`](crate::events))
    /// [N].
    pub event_force: R,
    /// Elastic stiffness of the normal force [N/m].
    pub stiffness: R,
    /// Force on i; the force on j is its opposite [N].
    pub force: Vector3<R>,
    /// Torque on i [N m].
    pub torque_i: Vector3<R>,
    /// Torque on j; on a wall about the point nearest to i [N m].
    pub torque_j: Vector3<R>,
    /// Energies.
    pub energies: ContactEnergies<R>,
}

// Not derived: what is derived is not inlined by force.
impl<R: Real> Default for ContactResponse<R> {
    #[inline(always)]
    fn default() -> Self {
        Self {
            normal_force: R::zero(),
            event_force: R::zero(),
            stiffness: R::zero(),
            force: Vector3::zero(),
            torque_i: Vector3::zero(),
            torque_j: Vector3::zero(),
            energies: ContactEnergies::default(),
        }
    }
}
