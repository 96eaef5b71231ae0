//! What can be read of a simulation between its steps.

use pulvis_boundary::Domain;
use pulvis_math::{Packed4, Vector3};

use super::Simulation;
use crate::particles::Particles;
use crate::phases::Phases;
use crate::walls::Wall;

impl Simulation {
    /// The area over which a wall's force is spread [m²], where it is known.
    pub fn wall_area(&self, index: usize) -> Option<f64> {
        self.walls[index].area.of(&self.walls)
    }

    /// The particles.
    pub fn particles(&self) -> &Particles {
        &self.particles
    }

    /// The walls in their present state.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// Force of the particles on a wall [N].
    pub fn wall_force(&self, index: usize) -> Vector3 {
        self.wall_states[index].load.force
    }

    /// Torque of the particles on a wall about the axis of its shape [N m], zero for shapes without an axis.
    pub fn wall_torque(&self, index: usize) -> f64 {
        self.wall_states[index].load.torque
    }

    /// Angular velocity of a wall about the axis of its shape [rad/s].
    pub fn wall_angular_velocity(&self, index: usize) -> f64 {
        self.wall_states[index].angular_velocity
    }

    /// Velocity of a wall [m/s].
    pub fn wall_velocity(&self, index: usize) -> Vector3 {
        self.wall_states[index].velocity
    }

    /// Space and its periods.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// The temperature now [K], if there is one.
    pub fn temperature(&self) -> Option<f64> {
        self.temperature.as_ref().map(|program| program.at(self.time))
    }

    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Time step [s].
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Time spent in the parts of a step since [`watch_phases`](Self::watch_phases) was called; `None` if it was not.
    pub fn phases(&self) -> Option<Phases> {
        let mut sum = self.phases?;
        for (chunk, outcome) in self.contacts.chunks().iter().zip(&self.outcomes) {
            sum += chunk.phases;
            sum.integration += outcome.seconds;
        }
        Some(sum)
    }

    /// Number of rebuilds of the neighbour list.
    pub fn rebuilds(&self) -> u64 {
        self.rebuilds
    }

    /// Memory of particles, neighbour list and contact memory [byte].
    pub fn memory_size(&self) -> usize {
        // The skin has one more packed vector per particle, and the list its former row.
        let columns = self.particles.columns().len() * size_of::<f64>();
        let row = Particles::BYTES + size_of::<Packed4>() + size_of::<u32>() + columns;
        let rows = self.particles.len() * row;
        rows + size_of_val(&self.particles.forces_and_torques[..])
            + self.contacts.memory_size()
            + self.memory.memory_size()
            + self.broken_bonds.memory_size()
    }

    /// Number of pairs in the neighbour list.
    pub fn candidates(&self) -> usize {
        self.contacts.candidates()
    }

    /// Number of threads that do the work.
    pub fn threads(&self) -> usize {
        self.pool.threads()
    }
}
