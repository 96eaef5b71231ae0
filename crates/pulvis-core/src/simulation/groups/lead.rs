//! A step of the groups that are led along a path.
//!
//! The same scheme as of walls: over a step the particle has the velocity that brings it to its next place on the path, which
//! springs see; at its end the velocity of the path, which dashpots see. Its work is force times way, by the trapezoidal rule:
//! what changes within a step is the force, not the way.

use pulvis_boundary::GroupMotion;

use super::Group;
use crate::simulation::Simulation;

impl Simulation {
    /// Whether any group is led, so that it needs forces and velocities at every step.
    pub(in crate::simulation) fn leads_groups(&self) -> bool {
        self.groups.iter().any(Group::is_led)
    }

    /// Before the drift of a step: the velocity that leads along the path during it, and half of the work.
    pub(in crate::simulation) fn lead_groups(&mut self) {
        let (time, time_step, particles) = (self.time, self.time_step, &mut self.particles);
        for group in self.groups.iter_mut().filter(|group| group.is_led()) {
            let since = time - group.start;
            let travelled = group.motion.displacement(group.travelled, since, time_step);
            let way = travelled - group.travelled;
            group.travelled = travelled;
            for &row in &group.rows {
                let row = row as usize;
                let way = match &group.motion {
                    GroupMotion::Rotation(rotation) => {
                        rotation.way(particles.position[row].vector, time_step)
                    }
                    _ => way,
                };
                particles.velocity[row].vector = way * (1.0 / time_step);
            }
        }
        self.add_half_of_work();
    }

    /// After the drift: the velocities of the path at the end of the step, for dashpots.
    pub(in crate::simulation) fn predict_groups(&mut self) {
        let (end, particles) = (self.time + self.time_step, &mut self.particles);
        for group in self.groups.iter().filter(|group| group.is_led()) {
            for &row in &group.rows {
                let row = row as usize;
                let velocity = group.motion.velocity(particles.position[row].vector, end - group.start);
                particles.velocity_predicted[row].vector = velocity;
                particles.angular_velocity_predicted[row].vector = group.motion.angular_velocity();
            }
        }
    }

    /// At the end of a step: the other half of the work, and the velocities of the path.
    pub(in crate::simulation) fn finish_groups(&mut self) {
        self.add_half_of_work();
        let (end, particles) = (self.time + self.time_step, &mut self.particles);
        for group in self.groups.iter().filter(|group| group.is_led()) {
            for &row in &group.rows {
                let row = row as usize;
                let position = particles.position[row].vector;
                particles.velocity[row].vector = group.motion.velocity(position, end - group.start);
            }
        }
    }

    /// Half of the work of a step with the forces that there are now: what leads a particle acts against all that acts on it.
    fn add_half_of_work(&mut self) {
        let (half, particles) = (0.5 * self.time_step, &self.particles);
        for group in self.groups.iter_mut().filter(|group| group.is_led()) {
            let turning = group.motion.angular_velocity();
            let power = group.rows.iter().map(|&row| {
                let row = row as usize;
                let load = &particles.forces_and_torques[row];
                load.force.vector.dot(particles.velocity[row].vector) + load.torque.vector.dot(turning)
            });
            group.work -= half * power.sum::<f64>();
        }
    }
}
