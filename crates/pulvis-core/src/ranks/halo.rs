//! What ranks exchange in every step: the rows that the contacts of others read, and what these add to them.

use std::ops::Range;

use pulvis_math::Vector3;
use pulvis_parallel::exchange::{ExchangeError, Message};

use super::Ranks;
use super::message::{Numbers, tell_vector};
use crate::contacts::{HaloParts, KinematicColumns};
use crate::particles::ForceTorque;
use crate::shared::Shared;
use crate::simulation::Outcome;

/// Rows that are told to another rank, or heard from it.
#[derive(Clone, Debug, Default)]
pub(crate) struct HaloRows {
    pub(crate) rank: usize,
    /// Ascending.
    pub(crate) rows: Vec<u32>,
    /// The chunks that have them: how far their rows have moved is told, too.
    pub(crate) chunks: Vec<u32>,
}

/// Which rows and slots go to which rank. A chunk has contacts with rows of later chunks: the rows that loops read come
/// from higher ranks, and what contacts add to them goes back there.
#[derive(Clone, Debug, Default)]
pub(crate) struct HaloPlan {
    /// Rows of this rank that lower ones read.
    rows_to: Vec<HaloRows>,
    /// Rows of higher ranks that this one reads.
    rows_from: Vec<HaloRows>,
    /// Slots of this rank's halos that lie in the rows of a higher one.
    slots_to: Vec<(usize, Vec<Range<usize>>)>,
    /// Slots of the halos of a lower rank that lie in the rows of this one.
    slots_from: Vec<(usize, Range<usize>)>,
    /// The messages of the last exchange, for their memory.
    outgoing: Vec<(usize, Message)>,
}

impl HaloPlan {
    /// From what the linked list knows of the halos of this rank and of the others.
    pub(crate) fn new(parts: HaloParts) -> Self {
        let HaloParts { rows_to, rows_from, slots_to, slots_from } = parts;
        Self { rows_to, rows_from, slots_to, slots_from, outgoing: Vec::new() }
    }

    /// Rows that this rank reads of others [1].
    pub(crate) fn rows_read(&self) -> usize {
        self.rows_from.iter().map(|part| part.rows.len()).sum()
    }

    /// As many outgoing messages as there are ranks to send to, empty.
    fn begin(outgoing: &mut Vec<(usize, Message)>, to: impl ExactSizeIterator<Item = usize>) {
        outgoing.resize_with(to.len(), Default::default);
        for ((rank, message), to) in outgoing.iter_mut().zip(to) {
            *rank = to;
            message.clear();
        }
    }
}

impl Ranks {
    /// Tells lower ranks the rows that they read, and how far those of their chunks have moved; hears both of higher ranks.
    /// `turning` tells whether predicted angular velocities are read.
    ///
    /// # Errors
    /// A rank is lost.
    pub(crate) fn swap_rows(
        &mut self,
        moving: KinematicColumns<'_>,
        turning: bool,
        outcomes: &mut [Outcome],
    ) -> Result<(), ExchangeError> {
        let KinematicColumns {
            position, velocity_mid, velocity, angular_velocity_mid, angular_velocity, ..
        } = moving;
        let columns = [position, velocity_mid, velocity, angular_velocity_mid, angular_velocity];
        let columns = &columns[..if turning { 5 } else { 4 }];
        let mut outgoing = std::mem::take(&mut self.halo.outgoing);
        HaloPlan::begin(&mut outgoing, self.halo.rows_to.iter().map(|part| part.rank));
        for ((_, message), HaloRows { rows, chunks, .. }) in outgoing.iter_mut().zip(&self.halo.rows_to) {
            message.extend(chunks.iter().map(|&chunk| outcomes[chunk as usize].moved.longest));
            for &row in rows {
                for column in columns {
                    // SAFETY: a row of this simulation; no thread is at work.
                    tell_vector(unsafe { column.get(row as usize) }.vector, message);
                }
            }
        }
        let plan = std::mem::take(&mut self.halo.rows_from);
        let from: Vec<usize> = plan.iter().map(|part| part.rank).collect();
        for (message, HaloRows { rows, chunks, .. }) in self.swap(&outgoing, &from)?.iter().zip(&plan) {
            let mut numbers = Numbers::of(message);
            for &chunk in chunks {
                outcomes[chunk as usize].moved.longest = numbers.next()?;
            }
            for &row in rows {
                for column in columns {
                    // SAFETY: as above.
                    unsafe { column.get_mut(row as usize) }.vector = numbers.next_vector()?;
                }
            }
        }
        (self.halo.rows_from, self.halo.outgoing) = (plan, outgoing);
        Ok(())
    }

    /// Tells higher ranks what contacts of this one add to their rows, and hears that of lower ones. `slots` are those of
    /// all halos.
    ///
    /// # Errors
    /// A rank is lost.
    pub(crate) fn swap_sums(
        &mut self,
        forces_and_torques: Shared<'_, ForceTorque>,
        first_slot: usize,
    ) -> Result<(), ExchangeError> {
        let mut outgoing = std::mem::take(&mut self.halo.outgoing);
        HaloPlan::begin(&mut outgoing, self.halo.slots_to.iter().map(|(rank, _)| *rank));
        for ((_, message), (_, slots)) in outgoing.iter_mut().zip(&self.halo.slots_to) {
            for slot in slots.iter().cloned().flatten() {
                // SAFETY: a slot of this simulation; no thread is at work.
                let sum = unsafe { forces_and_torques.get(first_slot + slot) };
                tell_vector(sum.force.vector, message);
                tell_vector(sum.torque.vector, message);
            }
        }
        let plan = std::mem::take(&mut self.halo.slots_from);
        let from: Vec<usize> = plan.iter().map(|(rank, _)| *rank).collect();
        for (message, (_, slots)) in self.swap(&outgoing, &from)?.iter().zip(&plan) {
            let mut numbers = Numbers::of(message);
            for slot in slots.clone() {
                // SAFETY: as above.
                let sum = unsafe { forces_and_torques.get_mut(first_slot + slot) };
                let both: [Vector3; 2] = [numbers.next_vector()?, numbers.next_vector()?];
                [sum.force.vector, sum.torque.vector] = both;
            }
        }
        (self.halo.slots_from, self.halo.outgoing) = (plan, outgoing);
        Ok(())
    }
}
