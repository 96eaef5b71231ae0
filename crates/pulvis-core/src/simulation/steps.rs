//! Steps in time.

use pulvis_parallel::exchange::ExchangeError;

use super::{Simulation, StepError};
use crate::contacts::{Advance, KinematicColumns, Sweep};
use crate::integrator::{Columns, HalfKicks, Step};
use crate::neighbours::Moved;
use crate::phases::Stopwatch;
use crate::shared::Shared;

/// Steps between two looks at the energy: about a contact. A look costs a tenth of a step, and the fused kicks of one
/// step.
const ENERGY_SURVEY: u64 = 64;

impl Simulation {
    /// One time step.
    ///
    /// # Errors
    /// See [`advance`](Self::advance).
    pub fn step(&mut self) -> Result<(), StepError> {
        self.advance(1)
    }

    /// Takes time steps: kick and drift, walls, neighbours, forces, kick, ledger. The result is that of as many single
    /// [steps](Self::step), but faster: the second kick of a step and the first kick of the next are made together, while the
    /// particles are in the cache.
    ///
    /// # Errors
    /// The state is no longer one that the system can have, or one of the [limits](Self::set_limits) is exceeded. The
    /// simulation then stands in the middle of a step: look at it, but do not go on with it.
    pub fn advance(&mut self, steps: u64) -> Result<(), StepError> {
        if steps == 0 {
            return Ok(());
        }
        self.advance_apart(steps)?;
        self.tell_everything()
    }

    /// The same where ranks share the work; afterwards each of them knows its own part, and of all others only what all
    /// forces come to: ledger accounts of contacts, forces on walls, totals, the stress of a cell that moves. For whoever
    /// looks no further, which costs nothing. Nothing may be changed before [`tell_everything`](Self::tell_everything), and
    /// particles are to be looked at after [`tell_particles`](Self::tell_particles). One rank knows all anyway.
    ///
    /// # Errors
    /// See [`advance`](Self::advance); all ranks then know everything, unless one is lost.
    pub fn advance_apart(&mut self, steps: u64) -> Result<(), StepError> {
        self.share_out()?;
        let taken = self.take_steps(steps);
        match &taken {
            Err(error) if !error.alarm.is_lost_rank() => self.tell_everything().and(taken),
            _ => taken,
        }
    }

    fn take_steps(&mut self, steps: u64) -> Result<(), StepError> {
        if steps == 0 {
            return Ok(());
        }
        let (deforms, leads) = (self.cell_moves()?, self.leads_groups());
        self.begin_step(leads);
        for left in (0..steps).rev() {
            if deforms {
                self.deform_cell()?;
            }
            self.move_walls();
            self.step += 1;
            self.renew_if_outdated()?;
            let surveys_energy = self.step.is_multiple_of(ENERGY_SURVEY);
            // How a cell deforms next may depend on all forces, and its work on the velocities at their time; so does that of
            // particles that are led.
            let pauses = surveys_energy || deforms || leads;
            let swept = self.forces_and_kick(false, left > 0 && !pauses);
            self.agreed(swept)?;
            self.finish_walls();
            if deforms || leads {
                let gathered = self.gather_rows_at_end();
                self.agreed(gathered)?;
            }
            if leads {
                self.finish_groups();
            }
            if deforms {
                self.finish_cell();
            }
            self.time += self.time_step;
            self.check_stiffness()?;
            self.running.take_in(self.pass.energies, self.pass.background_power, self.time_step);
            if surveys_energy {
                self.survey_energy()?;
            }
            if pauses && left > 0 {
                self.begin_step(leads);
            }
        }
        Ok(())
    }

    /// Draws up the ledger: its scale grows with the energy that is in motion now, and its error must stay small, as must
    /// speeds and overlaps.
    fn survey_energy(&mut self) -> Result<(), StepError> {
        let summed = self.sum_rows_of_all();
        let rows = self.agreed(summed)?;
        let ledger = self.ledger_of(rows);
        self.running.scale = ledger.scale;
        self.check_energy(&ledger)?;
        // Not `>`: NaN is to be looked at.
        let is_slow = rows.fastest <= self.limits.speed;
        if !is_slow {
            let gathered = self.gather_rows_at_end();
            self.agreed(gathered)?;
            self.check_speeds()?;
        }
        self.survey_overlaps()
    }

    /// First half kick and drift. Particles that are led drift with the velocity of their path.
    fn begin_step(&mut self, leads: bool) {
        if leads {
            self.lead_groups();
        }
        self.kick_and_drift();
        if leads {
            self.predict_groups();
        }
    }

    /// First half kick and drift.
    fn kick_and_drift(&mut self) {
        self.forget_movement();
        let mut work = Stopwatch::start(self.is_shared());
        let own = self.contacts.own();
        let chunks = &self.contacts.chunks()[own.clone()];
        let (instructions, step) = (self.instructions, self.step_of_rows(self.time_step));
        let columns = Columns::of(&mut self.particles);
        let (background, timed) = (&self.background, self.phases.is_some());
        self.pool.for_each(&mut self.outcomes[own], |number, outcome| {
            let mut clock = Stopwatch::start(timed);
            let rows = chunks[number].rows.clone();
            // SAFETY: chunks have different rows.
            outcome.kicked = unsafe {
                let forces_and_torques = columns.forces_and_torques.range_mut(rows.clone());
                instructions.run(HalfKicks::<false, true>::new(
                    columns,
                    rows,
                    forces_and_torques,
                    background,
                    step,
                ))
            };
            outcome.drift_on(step.time_step);
            clock.lap(&mut outcome.seconds);
        });
        if let Some(ranks) = &mut self.ranks {
            work.lap(&mut ranks.seconds);
        }
        self.book_applied_work();
    }

    pub(super) fn step_of_rows(&self, time_step: f64) -> Step {
        let turning = self.interactions.models().any(|model| model.laws.has_resistance_dashpot());
        Step { time_step, predicts_angular_velocities: turning || self.background.has_drag() }
    }

    /// Rebuilds the neighbour list if a body has left its skin. Otherwise tells the contacts by how much gaps can have closed.
    /// Displacements are measured every few steps, and again before a rebuild; in between they are bounded by the maximum
    /// speed.
    fn renew_if_outdated(&mut self) -> Result<(), StepError> {
        let walls = self.skin.moved_walls(&self.walls);
        let surveyed = self.skin.count_step();
        if surveyed {
            self.survey();
        }
        let closing = self.closing_of_cell();
        let left = self.left_of_skins();
        let mut holds = self.skin.holds(self.agreed(left)? - closing, walls);
        if !surveyed && !holds {
            self.survey();
            let left = self.left_of_skins();
            holds = self.skin.holds(self.agreed(left)? - closing, walls);
        }
        if holds {
            let swapped = self.swap_rows();
            self.agreed(swapped)?;
            let outcomes = &self.outcomes;
            self.contacts.close_gaps(|chunk| outcomes[chunk].moved.farther(closing), walls);
            return Ok(());
        }
        let gathered = self.gather_kinematics();
        self.agreed(gathered)?;
        self.check_movement()?;
        if let Some(carried) = self.carried() {
            self.skin.carry(&carried);
            self.fit_skin_to_cell()?;
        }
        self.skin.adapt(&self.particles.position, &self.pool);
        if self.is_shared() {
            let renewed = self.renew_among_ranks();
            self.agreed(renewed)?;
        } else {
            self.renew_candidates();
        }
        self.check_overlaps()
    }

    /// Measures the displacements of all particles since the last rebuild.
    fn survey(&mut self) {
        self.forget_movement();
        let own = self.contacts.own();
        let chunks = &self.contacts.chunks()[own.clone()];
        let (skin, positions) = (&self.skin, &self.particles.position);
        let (instructions, carried) = (self.instructions, self.carried());
        self.pool.for_each(&mut self.outcomes[own], |number, outcome| {
            let rows = chunks[number].rows.clone();
            outcome.moved = match &carried {
                None => skin.moved(rows, positions, instructions),
                Some(carried) => skin.moved_beside(carried, rows, positions),
            };
        });
    }

    fn move_walls(&mut self) {
        self.measure_faces();
        for index in 0..self.walls.len() {
            if self.walls[index].present {
                let since = self.time - self.wall_starts[index];
                self.wall_states[index].advance(&mut self.walls[index], since, self.time_step);
            }
        }
    }

    fn finish_walls(&mut self) {
        self.measure_faces();
        for index in 0..self.walls.len() {
            if self.walls[index].present {
                let since = self.time - self.wall_starts[index];
                let load = -self.on_particles[index];
                self.wall_states[index].finish(&self.walls[index], load, since, self.time_step);
            }
        }
    }

    /// Takes the areas of all faces before any wall moves: a wall between others that move would otherwise be
    /// pushed by the pressure on a face that is half that of before the step and half that of after it.
    fn measure_faces(&mut self) {
        for index in 0..self.walls.len() {
            self.wall_states[index].area = self.wall_area(index);
        }
    }

    /// Forces and torques of all contacts and of the background, and the second half kick; with `onwards` also the first half
    /// kick and the drift of the next step. With `at_rest`, no time has passed since the last forces.
    ///
    /// What all contacts come to is stored in `pass`, the force of each wall on the particles in `on_particles`.
    ///
    /// # Errors
    /// A rank is lost.
    fn forces_and_kick(&mut self, at_rest: bool, onwards: bool) -> Result<(), ExchangeError> {
        self.sum_charges()?;
        self.walls_now.clear();
        for (wall, state) in self.walls.iter().zip(&self.wall_states) {
            let motion = if at_rest { state.now_at_rest(wall) } else { state.now(wall) };
            self.walls_now.push(motion);
        }
        let time_step = if at_rest { 0.0 } else { self.time_step };
        // Time goes on when all forces are there.
        let temperature = self.temperature_at(self.time + 0.5 * time_step);
        let advance = Advance {
            time_step,
            temperature,
            timed: self.phases.is_some(),
            images: self.domain.images(),
            flow: self.flow(time_step),
            ledger: self.accounting,
            stored: !onwards,
            instructions: self.instructions,
            pointers: self.pointers,
        };
        let step = self.step_of_rows(time_step);
        let quantities = std::mem::take(&mut self.particles.columns);
        let columns = Columns::of(&mut self.particles);
        let (instructions, background) = (self.instructions, &self.background);
        let outcomes = Shared::new(&mut self.outcomes);
        let sweep = Sweep {
            forces_and_torques: columns.forces_and_torques,
            moving: KinematicColumns { quantities: &quantities, ..columns.moving() },
            walls: &self.walls_now,
            advance: &advance,
            keep: !onwards,
        };
        let mut work = Stopwatch::start(self.ranks.as_ref().is_some_and(|ranks| ranks.shares));
        let mut ranks = self.ranks.as_deref_mut().filter(|ranks| ranks.shares);
        let first_slot = self.contacts.row_count();
        let swap = || match &mut ranks {
            Some(ranks) => {
                work.lap(&mut ranks.seconds);
                ranks.swap_sums(sweep.forces_and_torques, first_slot)
            }
            None => Ok(()),
        };
        let swept = self.contacts.sweep(&sweep, &self.pool, swap, |number, rows, forces_and_torques| {
            // SAFETY: each chunk is finished once, and no thread reads its rows any more.
            unsafe {
                let outcome = outcomes.get_mut(number);
                let mut clock = Stopwatch::start(advance.timed);
                if onwards {
                    let kicks =
                        HalfKicks::<true, true>::new(columns, rows, forces_and_torques, background, step);
                    outcome.kicked = instructions.run(kicks);
                    outcome.drift_on(time_step);
                } else {
                    let kicks =
                        HalfKicks::<true, false>::new(columns, rows, forces_and_torques, background, step);
                    outcome.kicked = instructions.run(kicks);
                }
                clock.lap(&mut outcome.seconds);
            }
        });
        self.particles.columns = quantities;
        swept?;
        self.sum_up(!onwards)?;
        self.book_applied_work();
        Ok(())
    }

    /// Forces of the present state without a step. The memory of contacts changes only as the laws change it at a step of zero
    /// duration.
    pub(super) fn evaluate_at_rest(&mut self) {
        debug_assert!(self.knows_everything(), "forces at rest are those of all contacts");
        let particles = &mut self.particles;
        for (predicted, now) in particles.velocity_predicted.iter_mut().zip(&particles.velocity) {
            predicted.vector = now.vector;
        }
        for (predicted, now) in
            particles.angular_velocity_predicted.iter_mut().zip(&particles.angular_velocity)
        {
            predicted.vector = now.vector;
        }
        // No block is skipped: after a switch, any pair may act at once.
        self.contacts.close_gaps(|_| Moved::ANYWHERE, f64::INFINITY);
        // Every rank computes all of it.
        if self.forces_and_kick(true, false).is_err() {
            return;
        }
        self.running.take_in(self.pass.energies, self.pass.background_power, 0.0);
        for (state, &force) in self.wall_states.iter_mut().zip(&self.on_particles) {
            state.load = -force;
        }
        if self.cell.motion.moves() {
            self.take_stress();
        }
    }
}
