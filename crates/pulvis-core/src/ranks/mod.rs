//! Ranks: how several processes share the work of a simulation.
//!
//! Chunks are the unit of work of threads, and the order of every sum depends on chunks only; so they are the unit of ranks,
//! too. Each rank computes a range of chunks, and a step has the same bits for any number of ranks times any number of
//! threads. In a step the ranks exchange, with those whose rows touch theirs, the rows that loops read ([`halo`]) and
//! what their contacts add to rows of others; and all find out together what all chunks come to ([`reduce`]). When the list
//! is made anew, all rows are told to all, and the memory of a contact goes to the rank that it now belongs to.
//!
//! Between the calls of [`advance`](crate::Simulation::advance) every rank holds the whole state. Whatever looks at it or
//! changes it then does the same on every rank, without a word between them.

pub(crate) mod halo;
pub(crate) mod message;
mod reduce;

use std::ops::Range;
use std::sync::Arc;

use pulvis_parallel::exchange::{Exchange, ExchangeError, Message, Waiting};

use self::halo::HaloPlan;

/// What a rank knows of the others.
#[derive(Clone, Debug)]
pub(crate) struct Ranks {
    exchange: Arc<dyn Exchange>,
    /// The first chunk of each rank, and the end.
    borders: Vec<usize>,
    pub(crate) halo: HaloPlan,
    /// Whether each rank holds its own part only, as it does within an advance.
    pub(crate) shares: bool,
    /// The least that is left of any skin [m], where all ranks know it.
    pub(crate) left: Option<f64>,
    /// Time that this rank has worked since the borders were set, without waiting for others [s].
    pub(crate) seconds: f64,
    /// The messages that came last, for their memory.
    incoming: Vec<Message>,
}

impl Ranks {
    pub(crate) fn new(exchange: Arc<dyn Exchange>) -> Self {
        Self {
            exchange,
            borders: Vec::new(),
            halo: HaloPlan::default(),
            shares: false,
            left: None,
            seconds: 0.0,
            incoming: Vec::new(),
        }
    }

    pub(crate) fn rank(&self) -> usize {
        self.exchange.rank()
    }

    pub(crate) fn count(&self) -> usize {
        self.exchange.ranks()
    }

    /// All ranks but this one.
    pub(crate) fn others(&self) -> impl Iterator<Item = usize> + use<> {
        let own = self.rank();
        (0..self.count()).filter(move |&rank| rank != own)
    }

    /// The chunks of a rank.
    pub(crate) fn chunks_of(&self, rank: usize) -> Range<usize> {
        self.borders[rank]..self.borders[rank + 1]
    }

    /// The rank that a chunk belongs to.
    pub(crate) fn rank_of(&self, chunk: usize) -> usize {
        self.borders[1..].partition_point(|&end| end <= chunk)
    }

    /// Sets borders where there are none for so many chunks: the same number for every rank.
    pub(crate) fn share_out(&mut self, chunks: usize) {
        if self.borders.last() != Some(&chunks) {
            let ranks = self.count();
            self.borders = (0..=ranks).map(|rank| chunks * rank / ranks).collect();
        }
    }

    /// Moves the borders so that all ranks work as long as each other, if their chunks take the time that they took since the
    /// last list; half of the way, because times scatter. No bit depends on borders.
    ///
    /// # Errors
    /// A rank is lost.
    pub(crate) fn balance(&mut self) -> Result<(), ExchangeError> {
        let seconds: Vec<f64> = self.gather(&[self.seconds])?.iter().map(|one| one[0]).collect();
        self.seconds = 0.0;
        self.borders = balanced(&self.borders, &seconds);
        Ok(())
    }

    /// The message of every rank in their order.
    ///
    /// # Errors
    /// A rank is lost.
    pub(crate) fn gather(&mut self, own: &[f64]) -> Result<&[Message], ExchangeError> {
        self.exchange.gather(own, &mut self.incoming, Waiting::ForWork)?;
        Ok(&self.incoming)
    }

    /// One message to each of some ranks, and one from each of others, in that order.
    ///
    /// # Errors
    /// A rank is lost.
    pub(crate) fn swap(
        &mut self,
        outgoing: &[(usize, Message)],
        from: &[usize],
    ) -> Result<&[Message], ExchangeError> {
        self.exchange.swap(outgoing, from, &mut self.incoming, Waiting::ForWork)?;
        Ok(&self.incoming)
    }
}

/// Borders between which the work is the same, if the chunks between two of the present borders share the `seconds`
/// there; half of the way to them.
fn balanced(borders: &[usize], seconds: &[f64]) -> Vec<usize> {
    let total: f64 = seconds.iter().sum();
    let measured = total > 0.0 && total.is_finite();
    if !measured {
        return borders.to_vec();
    }
    let ranks = seconds.len();
    let mut moved = borders.to_vec();
    let (mut rank, mut before) = (0, 0.0);
    for (border, slot) in moved.iter_mut().enumerate().take(ranks).skip(1) {
        let target = total * border as f64 / ranks as f64;
        while rank + 1 < ranks && before + seconds[rank] < target {
            before += seconds[rank];
            rank += 1;
        }
        let chunks = (borders[rank + 1] - borders[rank]) as f64;
        let share = if seconds[rank] > 0.0 { (target - before) / seconds[rank] } else { 0.0 };
        let ideal = borders[rank] as f64 + chunks * share.clamp(0.0, 1.0);
        *slot = (0.5 * (ideal + borders[border] as f64)).round() as usize;
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_move_half_the_way_to_where_all_work_as_long() {
        // The first rank takes three times as long: of its 40 chunks, the third part is to go.
        assert_eq!(balanced(&[0, 40, 80], &[3.0, 1.0]), [0, 33, 80]);
        let mut borders = vec![0, 40, 80];
        for _ in 0..20 {
            // Chunks below 20 cost nine times as much as the others.
            let cost = |range: Range<usize>| range.map(|chunk| if chunk < 20 { 9.0 } else { 1.0 }).sum();
            let seconds = [cost(borders[0]..borders[1]), cost(borders[1]..borders[2])];
            borders = balanced(&borders, &seconds);
        }
        assert!((13..=15).contains(&borders[1]), "{borders:?}: half of 240 is at 13.3");
    }

    #[test]
    fn borders_stay_in_order_and_stay_where_nothing_was_measured() {
        assert_eq!(balanced(&[0, 3, 6], &[0.0, 0.0]), [0, 3, 6]);
        assert_eq!(balanced(&[0, 3, 6], &[f64::NAN, 1.0]), [0, 3, 6]);
        for seconds in [[0.0, 0.0, 9.0, 0.0], [5.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1e-9]] {
            let mut borders = vec![0, 2, 2, 4, 7];
            for _ in 0..5 {
                borders = balanced(&borders, &seconds);
                assert!(borders.is_sorted() && borders[0] == 0 && borders[4] == 7, "{borders:?}");
            }
        }
    }
}
