//! What the contact loop reads of a wall, and the forces that it returns.

use std::ops::{AddAssign, Neg};

use pulvis_contact::ContactKinematics;
use pulvis_math::{Real, Vector3};

use super::{Shape, Surface, Wall, WallShape};

/// A wall at the time of the positions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallNow {
    shape: WallShape,
    /// Reference point [m].
    point: Vector3,
    /// Velocity of the reference point at mid-step [m/s].
    velocity_mid: Vector3,
    /// The same at the time of the positions [m/s].
    velocity: Vector3,
    /// Of a shape with an axis.
    turn: Option<Turn>,
}

/// How a wall turns about its axis.
#[derive(Clone, Copy, Debug)]
struct Turn {
    axis: Vector3,
    /// At mid-step and at the time of the positions [rad/s].
    angular_velocity: Vector3,
}

impl WallNow {
    /// A wall whose reference point has these velocities at mid-step and at the time of the positions [m/s],
    /// and which rotates about its axis, if it has one, with `angular_velocity` [rad/s].
    pub(crate) fn new(wall: &Wall, velocity_mid: Vector3, velocity: Vector3, angular_velocity: f64) -> Self {
        let turn = wall.shape.axis().map(|axis| Turn { axis, angular_velocity: axis * angular_velocity });
        Self { shape: wall.shape, point: wall.point, velocity_mid, velocity, turn }
    }

    /// The surface as seen from `centre` [m].
    #[inline(always)]
    pub(crate) fn surface<R: Real>(&self, centre: Vector3<R>) -> Surface<R> {
        self.shape.surface(self.point, centre)
    }

    /// Turns the velocities that `motion` holds, those of a sphere at `centre` [m], into those against the wall.
    /// The second body is the point of the surface nearest to the centre, moving as the wall does. Answers with that
    /// point, from the wall's reference point [m], for shapes with an axis.
    #[inline(always)]
    pub(crate) fn move_against<R: Real>(
        &self,
        surface: &Surface<R>,
        centre: Vector3<R>,
        motion: &mut ContactKinematics<R>,
    ) -> Vector3<R> {
        motion.velocity -= Vector3::splat(self.velocity);
        motion.velocity_mid -= Vector3::splat(self.velocity_mid);
        motion.normal_rate = self.shape.normal_rate(surface, motion.velocity_mid);
        let Some(turn) = &self.turn else { return Vector3::zero() };
        let arm = centre - surface.normal * surface.distance - Vector3::splat(self.point);
        let velocity = Vector3::<R>::splat(turn.angular_velocity).cross(arm);
        motion.velocity -= velocity;
        motion.velocity_mid -= velocity;
        arm
    }

    /// Angular velocity of the wall [rad/s], `None` for shapes without an axis.
    #[inline(always)]
    pub(crate) fn angular_velocity(&self) -> Option<Vector3> {
        self.turn.map(|turn| turn.angular_velocity)
    }

    /// The opposite of the torque on the wall, its part along the axis, about the reference point [N m]: from the
    /// `force` on the sphere [N], which acts at the `arm` that [`move_against`](Self::move_against) gave [m], and
    /// the `torque` on the second body about that point [N m]. Zero for shapes without an axis.
    #[inline(always)]
    pub(crate) fn torque_on_particles<R: Real>(
        &self,
        arm: Vector3<R>,
        force: Vector3<R>,
        torque: Vector3<R>,
    ) -> R {
        match &self.turn {
            Some(turn) => (arm.cross(force) - torque).dot(Vector3::splat(turn.axis)),
            None => R::zero(),
        }
    }
}

/// The force of some contacts, and their torque about the axis of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WallForce {
    /// Force [N].
    pub(crate) force: Vector3,
    /// Part along the axis of the torque about the reference point [N m]; zero for walls without an axis.
    pub(crate) torque: f64,
}

impl Default for WallForce {
    fn default() -> Self {
        Self { force: Vector3::zero(), torque: 0.0 }
    }
}

impl AddAssign for WallForce {
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}

impl Neg for WallForce {
    type Output = Self;
    fn neg(self) -> Self {
        Self { force: -self.force, torque: -self.torque }
    }
}
