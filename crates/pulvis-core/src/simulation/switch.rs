//! Changes between steps: laws, walls, time step, threads.

use pulvis_math::{InstructionSet, Vector3};

use super::checks::{check_background, check_cell_motion, check_wall_motion};
use super::{SetupError, Simulation};
use crate::contacts::Interactions;
use crate::phases::Phases;
use crate::thread_pool::ThreadPool;
use crate::walls::WallMotion;
use pulvis_boundary::{Background, TemperatureProgram};

/// Switching between stages. Every switch keeps the balance of the ledger: the change of the stored energy is booked as
/// `switched`.
impl Simulation {
    /// Sets other contact models; contacts keep the columns of memory that both the old and the new law have.
    pub fn set_interactions(&mut self, interactions: Interactions) -> Result<(), SetupError> {
        let before = std::mem::replace(&mut self.interactions, interactions);
        self.fit_interactions();
        if let Err(error) = self.check_models().and_then(|()| self.check_periods()) {
            self.interactions = before;
            return Err(error);
        }
        self.switch(|simulation| simulation.renew_candidates());
        Ok(())
    }

    /// Sets the number of threads that do the work; the results are the same for any number.
    ///
    /// # Errors
    /// The system cannot start that many threads.
    pub fn set_threads(&mut self, threads: usize) -> Result<(), SetupError> {
        self.pool = ThreadPool::of(threads).map_err(|_| SetupError::Threads(threads))?;
        Ok(())
    }

    /// Sets the instructions that the loops use, by default the widest that the processor has; the
    /// results are the same for all.
    pub fn set_instructions(&mut self, instructions: InstructionSet) {
        self.instructions = instructions;
    }

    /// Calls all normal laws through pointers, also those that have loops of their own. For measurements; the results are the
    /// same.
    pub fn set_law_pointers(&mut self, pointers: bool) {
        self.pointers = pointers;
    }

    /// Measures the time of the parts of each step from now on: see [`phases`](Self::phases).
    pub fn watch_phases(&mut self) {
        self.phases = Some(Phases::default());
    }

    /// Disables the energy ledger for the rest of the simulation, which makes contacts faster. The accounts of contacts and
    /// all sums with them are NaN from now on; kinetic energy and the potential of gravity remain.
    pub fn disable_ledger(&mut self) {
        self.accounting = false;
    }

    /// Bonds all pairs of bodies whose bond forms at the start of a stage, whose surfaces are not farther apart than its
    /// distance, and which never were bonded before; walls among them. A bond has no force where it forms. Answers with how
    /// many have formed.
    pub fn form_bonds(&mut self) -> u64 {
        let mut formed = 0;
        self.switch(|simulation| {
            let walls = simulation.walls_at_rest();
            let (particles, images) = (&simulation.particles, simulation.domain.images());
            formed = simulation.contacts.form_bonds(particles, images, &walls);
        });
        formed
    }

    /// Sets another gravity and drag.
    ///
    /// # Errors
    /// A number is not finite, a drag is negative, or there is to be gravity in a cell that deforms.
    pub fn set_background(&mut self, background: Background) -> Result<(), SetupError> {
        check_background(&background)?;
        if self.cell.motion.moves() && background.gravity != Vector3::zero() {
            let problem = "there is to be gravity, but a cell without a bottom has no height".to_owned();
            return Err(SetupError::Cell { problem });
        }
        self.switch(|simulation| {
            simulation.background = background;
            simulation.running.gravity_wrapped = 0.0;
        });
        Ok(())
    }

    /// Sets the temperature over time, which laws that ask for it read from the next step on. Time is that of the
    /// simulation.
    pub fn set_temperature(&mut self, program: Option<TemperatureProgram>) {
        self.temperature = program;
    }

    /// Sets another time step [s].
    pub fn set_time_step(&mut self, time_step: f64) -> Result<(), SetupError> {
        if !(time_step > 0.0 && time_step.is_finite()) {
            return Err(SetupError::TimeStep(time_step));
        }
        check_cell_motion(&self.cell.motion, &self.domain, time_step)?;
        self.switch(|simulation| simulation.time_step = time_step);
        Ok(())
    }

    /// Sets another motion of a wall.
    ///
    /// # Errors
    /// A wall of this shape cannot have this motion, or no wall can.
    pub fn set_wall_motion(&mut self, index: usize, motion: WallMotion) -> Result<(), SetupError> {
        check_wall_motion(index, motion)?;
        self.check_motion(index, &motion)?;
        // Dashpots see the wall's new velocity at once.
        self.switch(|simulation| {
            simulation.walls[index].motion = motion;
            simulation.wall_states[index].start(&motion);
            simulation.wall_starts[index] = simulation.time;
        });
        Ok(())
    }

    /// Removes a wall, or puts it back where it was and starts its motion again. A removed wall does not move.
    pub fn set_wall_present(&mut self, index: usize, present: bool) {
        self.switch(|simulation| {
            if present && !simulation.walls[index].present {
                simulation.wall_starts[index] = simulation.time;
                simulation.wall_states[index].start(&simulation.walls[index].motion);
            } else if !present {
                simulation.wall_states[index].stop();
            }
            simulation.walls[index].present = present;
            simulation.renew_candidates();
        });
    }

    /// Sets one skin for all particles [m]; by default each particle has a skin that depends on its speed. With a thicker skin
    /// the neighbour list is rebuilt less often but contains more pairs that do not touch. The skin must be larger than the
    /// displacement of any particle in a step.
    pub fn set_skin(&mut self, thickness: f64) -> Result<(), SetupError> {
        // What is no number counts as no skin.
        let before = self.skin.clone();
        self.skin.set(0.5 * thickness.max(0.0));
        if let Err(error) = self.check_periods() {
            self.skin = before;
            return Err(error);
        }
        self.chooses_skin = false;
        self.switch(|simulation| simulation.renew_candidates());
        Ok(())
    }

    pub(super) fn switch(&mut self, change: impl FnOnce(&mut Self)) {
        let before = self.ledger().closing_error();
        change(self);
        self.evaluate_at_rest();
        let after = self.ledger().closing_error();
        self.running.switched += after - before;
    }
}
