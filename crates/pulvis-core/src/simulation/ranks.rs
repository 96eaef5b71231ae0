//! A simulation that several ranks advance together; see [`ranks`](crate::ranks).

use std::ops::Range;
use std::sync::Arc;

use pulvis_contact::MemoryLayout;
use pulvis_math::{Vector3, min_or_nan};
use pulvis_parallel::exchange::{Exchange, ExchangeError, Message};

use super::Simulation;
use super::errors::{Alarm, StepError};
use crate::contacts::{BrokenBond, Known};
use crate::integrator::Columns;
use crate::neighbours::{CellGrid, Moved};
use crate::particles::{ForceTorque, Particles};
use crate::ranks::Ranks;
use crate::ranks::halo::HaloPlan;
use crate::ranks::message::{Numbers, tell_vector};

type Agreed<T = ()> = Result<T, ExchangeError>;

/// What is told of every row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Told {
    /// What a new list and the contacts after it need in the middle of a step.
    Kinematics,
    /// What the end of a step leaves.
    State,
}

impl Simulation {
    /// Lets several ranks advance this simulation together. Each of them holds the same simulation and calls the same
    /// functions in the same order; within [`advance`](Self::advance) each does its part of the work. The results are those
    /// of one rank, bit for bit. Between two advances every rank holds the whole state.
    pub fn set_exchange(&mut self, exchange: Arc<dyn Exchange>) {
        self.ranks = (exchange.ranks() > 1).then(|| Box::new(Ranks::new(exchange)));
    }

    /// Rows of other ranks that this one reads in every step; for measurements.
    pub fn halo_rows(&self) -> usize {
        self.ranks.as_ref().map_or(0, |ranks| ranks.halo.rows_read())
    }

    /// Whether this rank holds its own part only.
    pub(super) fn is_shared(&self) -> bool {
        self.ranks.as_ref().is_some_and(|ranks| ranks.shares)
    }

    /// An exchange that failed stops the simulation on this rank.
    pub(super) fn agreed<T>(&self, result: Agreed<T>) -> Result<T, StepError> {
        result.map_err(|error| self.alarm(Alarm::RankLost { reason: error.reason }))
    }

    /// Begins an advance: each rank keeps its own part.
    pub(super) fn share_out(&mut self) -> Result<(), StepError> {
        let Some(ranks) = self.ranks.as_mut().filter(|ranks| !ranks.shares) else { return Ok(()) };
        ranks.share_out(self.contacts.chunks().len());
        (ranks.shares, ranks.left) = (true, None);
        let own = ranks.chunks_of(ranks.rank());
        self.contacts.keep_only(own);
        let linked = self.link_ranks();
        self.agreed(linked)
    }

    /// After [`advance_apart`](Self::advance_apart): every rank gets to know the [ledger](Self::ledger). To be called on all
    /// ranks.
    ///
    /// # Errors
    /// A rank is lost.
    pub fn tell_energies(&mut self) -> Result<(), StepError> {
        if !self.is_shared() {
            return Ok(());
        }
        let summed = self.sum_rows_of_all();
        self.agreed(summed).map(drop)
    }

    /// After [`advance_apart`](Self::advance_apart): every rank gets to know how all particles are. To be called on all ranks.
    ///
    /// # Errors
    /// A rank is lost.
    pub fn tell_particles(&mut self) -> Result<(), StepError> {
        let gathered = self.gather_rows_at_end();
        self.agreed(gathered)
    }

    /// After [`advance_apart`](Self::advance_apart): every rank gets to know the whole state. To be called on all ranks.
    ///
    /// # Errors
    /// A rank is lost.
    pub fn tell_everything(&mut self) -> Result<(), StepError> {
        let gathered = self.gather_state();
        self.agreed(gathered)
    }

    /// Whether this rank knows the whole state.
    pub fn knows_everything(&self) -> bool {
        !self.is_shared()
    }

    /// Whether anything is so on any rank.
    pub(super) fn on_any_rank(&mut self, is_here: bool) -> Agreed<bool> {
        match &mut self.ranks {
            Some(ranks) if ranks.shares => {
                let answers = ranks.gather(&[f64::from(u8::from(is_here))])?;
                Ok(answers.iter().any(|answer| answer.first() != Some(&0.0)))
            }
            _ => Ok(is_here),
        }
    }

    /// After this rank has listed its chunks: tells the others of their halos, and links all.
    fn link_ranks(&mut self) -> Agreed {
        let Some(ranks) = &mut self.ranks else { return Ok(()) };
        let (own, others) = (ranks.rank(), ranks.others().collect::<Vec<_>>());
        let mut outgoing = Vec::new();
        for &rank in &others {
            let mut message = vec![self.contacts.candidates_here() as f64];
            if rank > own {
                self.contacts.tell_halos(&self.contacts.rows_of(ranks.chunks_of(rank)), &mut message);
            }
            outgoing.push((rank, message));
        }
        let mut elsewhere = 0;
        for message in ranks.swap(&outgoing, &others)? {
            let mut numbers = Numbers::of(message);
            elsewhere += numbers.next_index()?;
            self.contacts.hear_halos(numbers)?;
        }
        self.contacts.set_candidates_elsewhere(elsewhere);
        let slots = self.contacts.link();
        let chunks_of: Vec<Range<usize>> = (0..ranks.count()).map(|rank| ranks.chunks_of(rank)).collect();
        ranks.halo = HaloPlan::new(self.contacts.halo_parts(&chunks_of, own));
        self.particles.forces_and_torques.resize(slots, ForceTorque::default());
        Ok(())
    }

    /// Makes a new list among ranks: all rows are known to all, who put them into the same order and list their own.
    pub(super) fn list_among_ranks(&mut self, grid: &CellGrid, order: &[u32]) -> Agreed {
        self.move_memory(order)?;
        let Some(ranks) = &self.ranks else { return Ok(()) };
        let own = ranks.chunks_of(ranks.rank());
        self.list_own(own, grid, order);
        self.link_ranks()
    }

    /// Sets new borders, and sends what contacts remember to the ranks that will own them.
    fn move_memory(&mut self, order: &[u32]) -> Agreed {
        let Some(ranks) = &mut self.ranks else { return Ok(()) };
        ranks.balance()?;
        let mut rows_now = vec![0_u32; order.len()];
        for (now, &before) in order.iter().enumerate() {
            rows_now[before as usize] = now as u32;
        }
        let contacts = &self.contacts;
        let owner = |row: u32, partner: u32| {
            let now = rows_now[row as usize];
            // A wall is no row.
            let first = rows_now.get(partner as usize).map_or(now, |&other| other.min(now));
            ranks.rank_of(contacts.chunk_of(first))
        };
        let layouts: Vec<MemoryLayout> =
            self.interactions.models().map(|model| model.memory_layout()).collect();
        let own = ranks.rank();
        let mut messages = vec![Message::new(); ranks.count()];
        self.memory.tell(&layouts, own, owner, &mut messages);
        let others: Vec<usize> = ranks.others().collect();
        let outgoing: Vec<(usize, Message)> =
            others.iter().map(|&rank| (rank, std::mem::take(&mut messages[rank]))).collect();
        for message in ranks.swap(&outgoing, &others)? {
            self.memory.hear(&layouts, message)?;
        }
        Ok(())
    }

    /// Tells all ranks the bonds that have broken here since the last list.
    pub(super) fn tell_broken_bonds(&mut self) -> Agreed {
        let Some(ranks) = self.ranks.as_mut().filter(|ranks| ranks.shares) else { return Ok(()) };
        if !self.interactions.models().any(|model| model.laws.bond.is_some()) {
            return Ok(());
        }
        let mut message = Message::new();
        for BrokenBond { with_wall, first, second } in self.contacts.broken(&self.particles.id) {
            message.extend([f64::from(u8::from(with_wall)), f64::from(first), f64::from(second)]);
        }
        for message in ranks.gather(&message)? {
            let pairs = message.as_chunks::<3>().0.iter().map(|&[with_wall, first, second]| BrokenBond {
                with_wall: with_wall != 0.0,
                first: first as u32,
                second: second as u32,
            });
            self.broken_bonds.take_in(pairs);
        }
        Ok(())
    }

    /// Tells ranks whose contacts read rows of this one how these are in the middle of a step, and hears of others what it
    /// reads.
    pub(super) fn swap_rows(&mut self) -> Agreed {
        let turning = self.step_of_rows(self.time_step).predicts_angular_velocities;
        let Some(ranks) = self.ranks.as_mut().filter(|ranks| ranks.shares) else { return Ok(()) };
        let columns = Columns::of(&mut self.particles);
        ranks.swap_rows(columns.moving(), turning, &mut self.outcomes)
    }

    /// Lower bound of the remaining skin of any particle of any rank [m].
    pub(super) fn left_of_skins(&mut self) -> Agreed<f64> {
        let own = &self.outcomes[self.contacts.own()];
        let left = own.iter().map(|outcome| outcome.moved.left).fold(f64::INFINITY, min_or_nan);
        let Some(ranks) = self.ranks.as_mut().filter(|ranks| ranks.shares) else { return Ok(left) };
        if let Some(left) = ranks.left {
            return Ok(left);
        }
        let mut message = vec![left];
        ranks.reduce(&mut message, |lower, upper, both| {
            let (mut lower, mut upper) = (Numbers::of(lower), Numbers::of(upper));
            both.push(min_or_nan(lower.next()?, upper.next()?));
            Ok(())
        })?;
        let left = Numbers::of(&message).next()?;
        ranks.left = Some(left);
        Ok(left)
    }

    /// Tells how far the rows of this rank have moved.
    fn tell_movement(&mut self) -> Agreed {
        let Some(ranks) = self.ranks.as_mut().filter(|ranks| ranks.shares) else { return Ok(()) };
        let own = ranks.rank();
        let mut message = Message::new();
        ranks.chunks_of(own).for_each(|number| tell_moved(&self.outcomes[number].moved, &mut message));
        let chunks_of: Vec<Range<usize>> = (0..ranks.count()).map(|rank| ranks.chunks_of(rank)).collect();
        for (rank, message) in ranks.gather(&message)?.iter().enumerate().filter(|(rank, _)| *rank != own) {
            let mut numbers = Numbers::of(message);
            for number in chunks_of[rank].clone() {
                self.outcomes[number].moved = hear_moved(&mut numbers)?;
            }
        }
        Ok(())
    }

    /// The rows of this rank have moved in a way that others do not know of.
    pub(super) fn forget_movement(&mut self) {
        if let Some(ranks) = &mut self.ranks {
            ranks.left = None;
        }
    }

    /// Tells all ranks where all rows are in the middle of a step, for a new list.
    pub(super) fn gather_kinematics(&mut self) -> Agreed {
        self.gather_rows(|particles, row| vectors_of(particles, row, Told::Kinematics))
    }

    /// Tells all ranks how all rows are at the end of a step.
    pub(super) fn gather_rows_at_end(&mut self) -> Agreed {
        self.gather_rows(|particles, row| vectors_of(particles, row, Told::State))
    }

    /// Tells all ranks where all rows are.
    pub(super) fn gather_positions(&mut self) -> Agreed {
        self.gather_rows(|particles, row| [&mut particles.position[row].vector])
    }

    fn gather_rows<const N: usize>(
        &mut self,
        vectors_of: impl for<'a> Fn(&'a mut Particles, usize) -> [&'a mut Vector3; N],
    ) -> Agreed {
        let Some(ranks) = self.ranks.as_mut().filter(|ranks| ranks.shares) else { return Ok(()) };
        let own = ranks.rank();
        let rows = self.contacts.rows_of(ranks.chunks_of(own));
        let mut message = Vec::with_capacity(3 * N * rows.len());
        for row in rows {
            for vector in vectors_of(&mut self.particles, row) {
                tell_vector(*vector, &mut message);
            }
        }
        let rows_of: Vec<Range<usize>> =
            (0..ranks.count()).map(|rank| self.contacts.rows_of(ranks.chunks_of(rank))).collect();
        for (rank, message) in ranks.gather(&message)?.iter().enumerate().filter(|(rank, _)| *rank != own) {
            let mut numbers = Numbers::of(message);
            for row in rows_of[rank].clone() {
                for vector in vectors_of(&mut self.particles, row) {
                    *vector = numbers.next_vector()?;
                }
            }
        }
        Ok(())
    }

    /// Tells all ranks everything: the state is whole on each.
    pub(super) fn gather_state(&mut self) -> Agreed {
        if !self.is_shared() {
            return Ok(());
        }
        self.tell_movement()?;
        self.gather_rows_at_end()?;
        let Some(ranks) = self.ranks.as_mut().filter(|ranks| ranks.shares) else { return Ok(()) };
        let own = ranks.rank();
        let mut message = Message::new();
        ranks.chunks_of(own).for_each(|number| self.contacts.tell_chunk(number, &mut message));
        let known = Known {
            interactions: &self.interactions,
            columns: &self.particles.columns,
            walls: self.walls.len(),
        };
        let chunks_of: Vec<Range<usize>> = (0..ranks.count()).map(|rank| ranks.chunks_of(rank)).collect();
        for (rank, message) in ranks.gather(&message)?.iter().enumerate().filter(|(rank, _)| *rank != own) {
            let mut numbers = Numbers::of(message);
            for number in chunks_of[rank].clone() {
                self.contacts.hear_chunk(number, &mut numbers, known)?;
            }
        }
        ranks.shares = false;
        let slots = self.contacts.take_all();
        self.particles.forces_and_torques.resize(slots, ForceTorque::default());
        self.sum_charges_of_all();
        Ok(())
    }
}

/// The vectors of a row that are told.
fn vectors_of(particles: &mut Particles, row: usize, told: Told) -> [&mut Vector3; 5] {
    let Particles {
        position,
        velocity,
        angular_velocity,
        velocity_predicted,
        angular_velocity_predicted,
        forces_and_torques,
        ..
    } = particles;
    let [fourth, fifth] = match told {
        Told::Kinematics => {
            [&mut velocity_predicted[row].vector, &mut angular_velocity_predicted[row].vector]
        }
        Told::State => {
            let ForceTorque { force, torque } = &mut forces_and_torques[row];
            [&mut force.vector, &mut torque.vector]
        }
    };
    [&mut position[row].vector, &mut velocity[row].vector, &mut angular_velocity[row].vector, fourth, fifth]
}

fn tell_moved(moved: &Moved, message: &mut Message) {
    let Moved { longest, second, left } = *moved;
    message.extend([longest, second, left]);
}

fn hear_moved(numbers: &mut Numbers<'_>) -> Agreed<Moved> {
    Ok(Moved { longest: numbers.next()?, second: numbers.next()?, left: numbers.next()? })
}
