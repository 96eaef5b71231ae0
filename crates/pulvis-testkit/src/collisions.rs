//! Head-on collisions with a wall, integrated, for closed forms of restitution and duration.

use pulvis_contact::{ContactModel, Pair};
use pulvis_math::Vector3;

use crate::bodies::{Couple, Sphere};

/// A head-on collision with a wall, which sees the mass itself as the reduced mass and the radius as the effective one.
#[derive(Clone, Copy, Debug)]
pub struct Collision {
    /// Velocity after it, over that before it.
    pub restitution: f64,
    /// From the first touch to the last [s].
    pub duration: f64,
    /// Largest force [N].
    pub force_max: f64,
    /// What is missing of the kinetic energy in the books, over all of it.
    pub missing: f64,
}

/// Integrates a collision with a wall in steps of `dt` [s], of a sphere with mass [kg] and radius [m]. It begins with the
/// first touch, or a bit more than a whole step before where the bodies are apart at its `end`, an overlap [m]; bodies that
/// attract each other before they touch begin beyond the range.
pub fn collide(model: &ContactModel, (mass, radius): (f64, f64), speed: f64, dt: f64, end: f64) -> Collision {
    let mut sphere = Sphere::at_rest(mass, radius, Vector3::new(0.0, 0.0, radius));
    sphere.velocity.z = -speed;
    // A bit more than a whole step before touch where the law jumps there.
    if end < 0.0 {
        sphere.position.z += 1.37 * speed * dt;
    }
    let attraction = &model.laws.noncontact;
    if attraction.acts_on_approach() {
        sphere.position.z += attraction.interaction_range(&Pair::wall(mass, radius));
    }
    let mut couple = Couple::new(model, sphere, None);
    let kinetic = 0.5 * mass * speed * speed;
    let (mut before, mut force_max) = ((0.0, -speed), 0.0_f64);
    let steps = couple.step_until(dt, 10_000_000, |couple| {
        force_max = force_max.max(couple.normal_force);
        let done = couple.overlap <= end && couple.i.velocity.z > 0.0;
        if !done {
            before = (couple.overlap, couple.i.velocity.z);
        }
        done
    });
    // Linear in the last step, from the overlap before it to the one after it; apart, the bodies fly freely.
    let part = (before.0 - end) / (before.0 - couple.overlap);
    let mut velocity = before.1 + part * (couple.i.velocity.z - before.1);
    if end < 0.0 {
        // The half kick after the jump belongs to it.
        couple.step(dt);
        velocity = couple.i.velocity.z;
    }
    let missing = (couple.kinetic_energy() + couple.stored + couple.lost) / kinetic - 1.0;
    let duration = dt * (steps as f64 - 1.0 + part);
    Collision { restitution: velocity / speed, duration, force_max, missing: missing.abs() }
}
