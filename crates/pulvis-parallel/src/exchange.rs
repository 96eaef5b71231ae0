//! How ranks tell each other something. A rank is a process, or a thread that works like one: it shares no memory with
//! the others.

use std::fmt::Debug;
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// Numbers for another rank. Indices and flags are numbers, too: a double holds every integer up to 2⁵³.
pub type Message = Vec<f64>;

/// How long a rank waits in the middle of a step for another one before it takes it for lost. No part of a step takes that
/// long, and nobody wants to find out the next morning.
pub const PATIENCE: Duration = Duration::from_secs(50);

/// What a rank waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waiting {
    /// The work of others in a step: it ends after [`PATIENCE`].
    ForWork,
    /// Files that another rank writes, which may take long. A rank that has ended is missed all the same, by those who
    /// run the ranks if nobody else does.
    ForFiles,
}

/// What went wrong between two ranks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExchangeError {
    /// What happened, with the rank that is missing.
    pub reason: String,
}

/// The other ranks, as one of them sees them. All ranks call the same functions in the same order.
pub trait Exchange: Debug + Send + Sync {
    /// The number of this rank, counted from zero.
    fn rank(&self) -> usize;

    /// How many ranks there are.
    fn ranks(&self) -> usize;

    /// Sends a message to each rank named in `outgoing`, and fills `incoming` with one from each rank in `from`, in that
    /// order.
    ///
    /// # Errors
    /// A rank is lost.
    fn swap(
        &self,
        outgoing: &[(usize, Message)],
        from: &[usize],
        incoming: &mut Vec<Message>,
        waiting: Waiting,
    ) -> Result<(), ExchangeError>;

    /// Fills `all` with the message of every rank, this one's `own` among them, in the order of the ranks.
    ///
    /// # Errors
    /// A rank is lost.
    fn gather(&self, own: &[f64], all: &mut Vec<Message>, waiting: Waiting) -> Result<(), ExchangeError> {
        let others: Vec<usize> = (0..self.ranks()).filter(|&rank| rank != self.rank()).collect();
        let outgoing: Vec<(usize, Message)> = others.iter().map(|&rank| (rank, own.to_vec())).collect();
        self.swap(&outgoing, &others, all, waiting)?;
        all.insert(self.rank(), own.to_vec());
        Ok(())
    }
}

/// A rank that is a thread: messages go through channels. For tests of everything that ranks do, where no MPI is at hand.
#[derive(Debug)]
pub struct ThreadRank {
    rank: usize,
    /// To each rank; nothing is ever sent to itself.
    to: Vec<Sender<Message>>,
    /// From each rank.
    from: Vec<Mutex<Receiver<Message>>>,
    patience: Duration,
}

impl ThreadRank {
    /// As many ranks as asked for. Each is to be handed to a thread of its own; one that is dropped is lost to the others.
    pub fn team(ranks: usize) -> Vec<Self> {
        Self::patient_team(ranks, PATIENCE)
    }

    /// The same, with another time after which a rank is taken for lost.
    pub fn patient_team(ranks: usize, patience: Duration) -> Vec<Self> {
        let mut to: Vec<Vec<Sender<Message>>> = (0..ranks).map(|_| Vec::new()).collect();
        let mut from: Vec<Vec<Mutex<Receiver<Message>>>> = (0..ranks).map(|_| Vec::new()).collect();
        for senders in &mut to {
            for receivers in &mut from {
                let (sender, receiver) = channel();
                senders.push(sender);
                receivers.push(Mutex::new(receiver));
            }
        }
        let both = to.into_iter().zip(from).enumerate();
        both.map(|(rank, (to, from))| Self { rank, to, from, patience }).collect()
    }
}

impl Exchange for ThreadRank {
    fn rank(&self) -> usize {
        self.rank
    }

    fn ranks(&self) -> usize {
        self.to.len()
    }

    fn swap(
        &self,
        outgoing: &[(usize, Message)],
        from: &[usize],
        incoming: &mut Vec<Message>,
        waiting: Waiting,
    ) -> Result<(), ExchangeError> {
        for (rank, message) in outgoing {
            let sent = self.to[*rank].send(message.clone());
            sent.map_err(|_| lost(*rank, "it has ended"))?;
        }
        incoming.clear();
        for &rank in from {
            let receiver = self.from[rank].lock().map_err(|_| lost(rank, "its channel is broken"))?;
            let received = match waiting {
                Waiting::ForWork => receiver.recv_timeout(self.patience),
                Waiting::ForFiles => receiver.recv().map_err(|_| RecvTimeoutError::Disconnected),
            };
            let received = received.map_err(|error| match error {
                RecvTimeoutError::Timeout => lost(rank, "it does not answer"),
                RecvTimeoutError::Disconnected => lost(rank, "it has ended"),
            })?;
            incoming.push(received);
        }
        Ok(())
    }
}

fn lost(rank: usize, how: &str) -> ExchangeError {
    ExchangeError { reason: format!("rank {rank} is lost: {how}") }
}

#[cfg(all(test, not(loom)))]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    /// What `work` answers on each of so many ranks.
    fn on_ranks<T: Send>(ranks: usize, work: impl Fn(ThreadRank) -> T + Sync) -> Vec<T> {
        std::thread::scope(|scope| {
            let team = ThreadRank::patient_team(ranks, Duration::from_millis(200));
            let started: Vec<_> = team.into_iter().map(|rank| scope.spawn(|| work(rank))).collect();
            started.into_iter().map(|thread| thread.join().unwrap()).collect()
        })
    }

    #[test]
    fn messages_arrive_where_they_are_sent_to_and_in_their_order() {
        let received = on_ranks(3, |rank| {
            let own = rank.rank() as f64;
            let (next, before) = ((rank.rank() + 1) % 3, (rank.rank() + 2) % 3);
            let mut incoming = Vec::new();
            for round in 0..3 {
                rank.swap(&[(next, vec![own, f64::from(round)])], &[before], &mut incoming, Waiting::ForWork)
                    .unwrap();
                assert_eq!(incoming, [vec![before as f64, f64::from(round)]]);
            }
            rank.gather(&[own], &mut incoming, Waiting::ForFiles).unwrap();
            incoming
        });
        assert!(received.iter().all(|all| *all == [[0.0], [1.0], [2.0]]), "{received:?}");
    }

    #[test]
    fn a_rank_that_ends_or_is_silent_is_missed_and_nobody_waits_for_ever() {
        for silent in [false, true] {
            let answers = on_ranks(2, |rank| {
                if rank.rank() == 1 {
                    std::thread::sleep(Duration::from_millis(if silent { 600 } else { 0 }));
                    return None;
                }
                Some(rank.gather(&[1.0], &mut Vec::new(), Waiting::ForWork).unwrap_err().reason)
            });
            let how =
                if silent { "rank 1 is lost: it does not answer" } else { "rank 1 is lost: it has ended" };
            assert_eq!(answers, [Some(how.to_owned()), None]);
        }
    }
}
