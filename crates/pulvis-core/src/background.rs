//! Forces that act on every particle by itself.

use pulvis_math::Vector3;

use crate::particles::Particles;

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

impl Background {
    /// Adds the forces; answers with the power that the drag takes [W].
    pub(crate) fn act(&self, particles: &mut Particles) -> f64 {
        if self.gravity != Vector3::zero() {
            for (force, &mass) in particles.force.iter_mut().zip(&particles.mass) {
                *force += self.gravity * mass;
            }
        }
        if self.drag == 0.0 && self.rotational_drag == 0.0 {
            return 0.0;
        }
        let mut power = 0.0;
        for row in 0..particles.len() {
            let velocity = particles.velocity_predicted[row];
            let spin = particles.spin_predicted[row];
            let turning = self.rotational_drag * particles.radius[row] * particles.radius[row];
            particles.force[row] -= velocity * self.drag;
            particles.torque[row] -= spin * turning;
            power += self.drag * velocity.norm_squared() + turning * spin.norm_squared();
        }
        power
    }

    /// Potential energy in the gravity field [J].
    pub(crate) fn potential(&self, particles: &Particles) -> f64 {
        if self.gravity == Vector3::zero() {
            return 0.0;
        }
        let parts = particles.mass.iter().zip(&particles.position);
        parts.map(|(&mass, position)| -mass * self.gravity.dot(*position)).sum()
    }
}
