//! Pieces whose loads are complete, but which nobody has finished at once.

use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};

use crate::team::{Turn, wait};

/// Complete pieces that wait to be finished: the member of the team that brought their countdown to its end
/// has other rows in its caches. The member that computed their contacts finishes them when it has computed
/// all of its own pieces; what is left then is shared out.
#[derive(Debug, Default)]
pub(super) struct Leftovers {
    /// One for each member of the team: the pieces whose contacts it has computed.
    queues: Vec<Queue>,
    /// Pieces that have been finished at once, or taken.
    finished: AtomicUsize,
    pieces: usize,
}

#[derive(Debug, Default)]
struct Queue {
    /// Numbers of pieces plus one, in the order in which they were left; zero where none stands yet.
    pieces: Vec<AtomicU32>,
    left: AtomicUsize,
    taken: AtomicUsize,
}

impl Clone for Leftovers {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Leftovers {
    /// Gets ready for the next sweep over so many pieces.
    pub(super) fn clear(&mut self, members: usize, pieces: usize) {
        self.queues.resize_with(members, Queue::default);
        for queue in &mut self.queues {
            queue.pieces.resize_with(pieces, AtomicU32::default);
            for piece in &mut queue.pieces[..*queue.left.get_mut()] {
                *piece.get_mut() = 0;
            }
            (*queue.left.get_mut(), *queue.taken.get_mut()) = (0, 0);
        }
        *self.finished.get_mut() = 0;
        self.pieces = pieces;
    }

    /// Leaves a complete piece to the member that has computed its contacts.
    pub(super) fn leave(&self, member: usize, piece: usize) {
        let queue = &self.queues[member];
        let place = queue.left.fetch_add(1, Ordering::Relaxed);
        queue.pieces[place].store(piece as u32 + 1, Ordering::Release);
    }

    /// Counts a piece that need not be left.
    pub(super) fn count_finished(&self) {
        self.finished.fetch_add(1, Ordering::Relaxed);
    }

    /// Takes a piece that was left to the `member`; at its last turn, one that was left to anybody, and
    /// waits for one as long as any may still be left.
    pub(super) fn take(&self, member: usize, turn: &Turn<'_>) -> Option<usize> {
        if !turn.is_last() {
            return self.queues[member].take(&self.finished);
        }
        let mut rounds = 0;
        loop {
            let members = self.queues.len();
            let queues = (0..members).map(|next| &self.queues[(member + next) % members]);
            if let Some(piece) = queues.filter_map(|queue| queue.take(&self.finished)).next() {
                return Some(piece);
            }
            if self.finished.load(Ordering::Relaxed) == self.pieces || turn.is_given_up() {
                return None;
            }
            wait(&mut rounds);
        }
    }
}

impl Queue {
    fn take(&self, finished: &AtomicUsize) -> Option<usize> {
        loop {
            let taken = self.taken.load(Ordering::Relaxed);
            // What was written before the piece was left is seen by who takes it.
            let piece = self.pieces.get(taken)?.load(Ordering::Acquire);
            if piece == 0 {
                return None;
            }
            let next = taken + 1;
            if self.taken.compare_exchange(taken, next, Ordering::Relaxed, Ordering::Relaxed).is_ok() {
                finished.fetch_add(1, Ordering::Relaxed);
                return Some(piece as usize - 1);
            }
        }
    }
}
