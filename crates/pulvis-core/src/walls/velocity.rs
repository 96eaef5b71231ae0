//! A wall that moves with a given velocity.

use pulvis_math::Vector3;

/// Constant velocity; the part along the wall's normal moves the plane, the part within the plane
/// drags on particles that touch it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Velocity {
    /// Velocity [m/s].
    pub velocity: Vector3,
}
