//! What a program sets between steps: where particles are, how they move, and what pushes them.

use pulvis_math::{Packed4, Vector3};

use super::{SetupError, Simulation};

/// Settings by a program. Values are in the order of the ids. The change of the stored energy, and the work of applied forces,
/// are booked as `switched`.
impl Simulation {
    /// Moves particles [m]. The neighbour list is made anew; contacts that go on keep their memory, without a path in between.
    ///
    /// # Errors
    /// There is not one finite vector for each particle. Nothing has changed then.
    pub fn set_positions(&mut self, positions: &[Vector3]) -> Result<(), SetupError> {
        self.check_vectors("position", positions)?;
        self.switch(|simulation| {
            let rows = simulation.particles.rows_by_id();
            for (row, position) in rows.into_iter().zip(positions) {
                simulation.particles.position[row].vector = *position;
            }
            simulation.renew_candidates();
        });
        Ok(())
    }

    /// Sets velocities [m/s]. Particles whose motion is [prescribed](Self::set_group_motion) keep that of their path.
    ///
    /// # Errors
    /// As of [`set_positions`](Self::set_positions).
    pub fn set_velocities(&mut self, velocities: &[Vector3]) -> Result<(), SetupError> {
        self.check_vectors("velocity", velocities)?;
        self.switch(|simulation| {
            let rows = simulation.particles.rows_by_id();
            for (row, velocity) in rows.into_iter().zip(velocities) {
                if !simulation.particles.is_prescribed(row) {
                    simulation.particles.velocity[row].vector = *velocity;
                }
            }
        });
        Ok(())
    }

    /// Sets angular velocities [rad/s], but for those of particles whose motion is prescribed.
    ///
    /// # Errors
    /// As of [`set_positions`](Self::set_positions).
    pub fn set_angular_velocities(&mut self, angular_velocities: &[Vector3]) -> Result<(), SetupError> {
        self.check_vectors("angular_velocity", angular_velocities)?;
        self.switch(|simulation| {
            let rows = simulation.particles.rows_by_id();
            for (row, angular_velocity) in rows.into_iter().zip(angular_velocities) {
                if !simulation.particles.is_prescribed(row) {
                    simulation.particles.angular_velocity[row].vector = *angular_velocity;
                }
            }
        });
        Ok(())
    }

    /// Applies forces to the particles [N], in all steps from now on; none where empty. Contacts are not computed again: a
    /// program may apply other forces in every step. Each particle keeps its force, wherever its row comes to stand; inserted
    /// particles have none until others are applied. A [state](Self::export_state) holds them.
    ///
    /// # Errors
    /// As of [`set_positions`](Self::set_positions); or several ranks share the simulation.
    pub fn set_applied_forces(&mut self, forces: &[Vector3]) -> Result<(), SetupError> {
        if !forces.is_empty() {
            self.check_vectors("applied_force", forces)?;
            if self.ranks.is_some() {
                let problem = "ranks that share a simulation do not tell each other their work".to_owned();
                return Err(SetupError::Column { name: "applied_force".to_owned(), problem });
            }
        }
        let before = self.ledger().closing_error();
        let mut applied = std::mem::take(&mut self.particles.applied);
        for (row, old) in applied.iter().enumerate() {
            self.push(row, -old.vector);
        }
        applied.clear();
        if !forces.is_empty() {
            applied.resize(self.particles.len(), Packed4::default());
            let rows = self.particles.rows_by_id();
            for (row, force) in rows.into_iter().zip(forces) {
                applied[row] = Packed4::new(*force, 0.0);
                self.push(row, *force);
            }
        }
        self.particles.applied = applied;
        self.running.switched += self.ledger().closing_error() - before;
        Ok(())
    }

    /// Whether a program applies forces.
    pub fn has_applied_forces(&self) -> bool {
        !self.particles.applied.is_empty()
    }

    /// Adds to the force that the next step begins with.
    fn push(&mut self, row: usize, force: Vector3) {
        self.particles.forces_and_torques[row].force.vector += force;
    }

    /// Books what applied forces have done since the last time.
    pub(super) fn book_applied_work(&mut self) {
        if self.has_applied_forces() {
            let work: f64 = self.outcomes.iter().map(|outcome| outcome.kicked.applied_work).sum();
            self.running.switched += work;
        }
    }

    fn check_vectors(&self, name: &str, vectors: &[Vector3]) -> Result<(), SetupError> {
        let refuse = |problem: String| Err(SetupError::Column { name: name.to_owned(), problem });
        if vectors.len() != self.particles.len() {
            return refuse(format!(
                "{} vectors for {} particles; give one for each that is there now, in the order of the ids",
                vectors.len(),
                self.particles.len()
            ));
        }
        match vectors.iter().find(|vector| !vector.norm_squared().is_finite()) {
            Some(vector) => refuse(format!("a vector is {:?}, expected finite numbers", vector.to_array())),
            None => Ok(()),
        }
    }
}
