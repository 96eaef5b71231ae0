//! Forces that act on every particle by itself.

use pulvis_math::Vector3;

/// Gravity and background drag.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background {
    /// Acceleration of gravity [m/s²].
    pub gravity: Vector3,
    /// Drag coefficient γ_b of the force −γ_b v [kg/s]. Breaks Galilean invariance; meant for the
    /// preparation of samples.
    pub drag: f64,
    /// Rotational drag coefficient γ_br of the torque −γ_br a² ω [kg/s].
    ///
    /// # Source
    /// S. Luding, Granular Matter 10, 235 (2008), eqs. (22) and (23).
    pub rotational_drag: f64,
}

/// What the background takes from a particle.
#[derive(Clone, Copy, Debug)]
pub struct Drag {
    /// Against the velocity [N].
    pub force: Vector3,
    /// Against the angular velocity [N m].
    pub torque: Vector3,
    /// Power lost [W].
    pub power: f64,
}

impl Background {
    /// Whether there is any drag.
    #[inline(always)]
    pub fn has_drag(&self) -> bool {
        self.drag != 0.0 || self.rotational_drag != 0.0
    }

    /// The drag on a particle of the given velocity [m/s], angular velocity [rad/s] and radius [m].
    #[inline(always)]
    pub fn drag_on(&self, velocity: Vector3, angular_velocity: Vector3, radius: f64) -> Drag {
        let turning = self.rotational_drag * radius * radius;
        Drag {
            force: velocity * self.drag,
            torque: angular_velocity * turning,
            power: self.drag * velocity.norm_squared() + turning * angular_velocity.norm_squared(),
        }
    }
}
