//! What can be changed while a simulation runs.

use pulvis_math::InstructionSet;

use super::{SetupError, Simulation};
use crate::contacts::Interactions;
use crate::phases::Phases;
use crate::thread_pool::ThreadPool;
use crate::walls::WallMotion;
use pulvis_boundary::Background;

/// Switching between stages. Every switch keeps the ledger: what the system holds more or less
/// afterwards is booked as switched.
impl Simulation {
    /// Sets other contact models; contacts keep what both the old and the new law remember.
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

    /// Has all normal laws called through pointers, also those that have loops of their own: for measurements. The
    /// results are the same.
    pub fn set_law_pointers(&mut self, pointers: bool) {
        self.pointers = pointers;
    }

    /// From now on takes the times of the parts of a step: see [`phases`](Self::phases).
    pub fn watch_phases(&mut self) {
        self.phases = Some(Phases::default());
    }

    /// Gives the energy ledger up, for good: contacts are faster without it. The accounts of contacts and
    /// what follows from them are no numbers from now on; kinetic energy and the potential of gravity
    /// stay.
    pub fn disable_ledger(&mut self) {
        self.accounting = false;
    }

    /// Sets another gravity and drag.
    pub fn set_background(&mut self, background: Background) {
        self.switch(|simulation| {
            simulation.background = background;
            simulation.running.gravity_wrapped = 0.0;
        });
    }

    /// Sets another time step [s].
    pub fn set_time_step(&mut self, time_step: f64) -> Result<(), SetupError> {
        if !(time_step > 0.0 && time_step.is_finite()) {
            return Err(SetupError::TimeStep(time_step));
        }
        self.switch(|simulation| simulation.time_step = time_step);
        Ok(())
    }

    /// Lets a wall move in another way from now on.
    ///
    /// # Errors
    /// A wall of this shape cannot move so.
    pub fn set_wall_motion(&mut self, index: usize, motion: WallMotion) -> Result<(), SetupError> {
        self.check_motion(index, &motion)?;
        // Dashpots see the wall's new velocity at once.
        self.switch(|simulation| {
            simulation.walls[index].motion = motion;
            simulation.wall_states[index].start(&motion);
            simulation.wall_starts[index] = simulation.time;
        });
        Ok(())
    }

    /// Takes a wall away, or puts it back where it stood, its motion beginning anew. A wall that is
    /// away does not move.
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

    /// Sets how far beyond their reach candidates are listed [m], the same for all; by default this
    /// depends on how fast both particles are. Thicker lists are renewed less often but hold more
    /// candidates that do not touch. A skin must be thicker than what any particle moves in a step.
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

    fn switch(&mut self, change: impl FnOnce(&mut Self)) {
        let before = self.ledger().closing_error();
        change(self);
        self.evaluate_at_rest();
        let after = self.ledger().closing_error();
        self.running.switched += after - before;
    }
}
