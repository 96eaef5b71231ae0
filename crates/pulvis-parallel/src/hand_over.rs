//! Which worker finishes a chunk that several chunks contribute to, and when.
//!
//! A chunk is complete when its own contacts and those of all chunks that contribute to it have been computed. A counter
//! for each chunk says how many of these are missing. The worker that brings it to zero has other rows in its caches, so
//! that it defers the chunk to the worker that computed it, which finishes it after its own chunks.

use crate::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use crate::sync::wait;
use crate::thread_pool::Phase;

/// The chunks of one pass: how many contributions each still waits for, and the complete ones that are not finished yet.
///
/// A worker that has computed the contacts of a chunk asks [`completes_at_once`](Self::completes_at_once) and, where
/// not, stores the chunk's sums and calls [`count_own`](Self::count_own). Then it calls
/// [`count_down`](Self::count_down) for each chunk that it contributes to, and when it has no chunk left
/// [`take`](Self::take). All that was written before is seen by the worker that these functions tell to finish a chunk.
#[derive(Debug, Default)]
pub struct HandOver {
    counters: Vec<DependencyCounter>,
    /// One for each worker: complete chunks whose contacts it has computed.
    queues: Vec<Queue>,
    /// Chunks that have been finished at once, or taken.
    finished: AtomicUsize,
}

/// Chunks whose contacts are still to be computed before a chunk is complete.
#[derive(Debug, Default)]
struct DependencyCounter {
    missing: AtomicU32,
    /// Their number at the start of a pass.
    start: u32,
    /// The worker that has computed the chunk's own contacts.
    worker: AtomicUsize,
}

#[derive(Debug, Default)]
struct Queue {
    /// Numbers of chunks plus one, in the order in which they were deferred; zero where none stands yet.
    chunks: Vec<AtomicU32>,
    deferred: AtomicUsize,
    taken: AtomicUsize,
}

impl Clone for HandOver {
    fn clone(&self) -> Self {
        Self::new(self.counters.iter().map(|counter| counter.start - 1))
    }
}

impl HandOver {
    /// `contributions` is, for each chunk, the number of other chunks that contribute to it.
    pub fn new(contributions: impl Iterator<Item = u32>) -> Self {
        let counter = |others| DependencyCounter { start: others + 1, ..DependencyCounter::default() };
        Self { counters: contributions.map(counter).collect(), ..Self::default() }
    }

    /// Prepares a pass with this many workers. Resets everything, also after a pass that panicked.
    pub fn begin(&mut self, workers: usize) {
        for counter in &self.counters {
            counter.missing.store(counter.start, Ordering::Relaxed);
        }
        self.queues.resize_with(workers, Queue::default);
        for queue in &mut self.queues {
            queue.clear(self.counters.len());
        }
        self.finished.store(0, Ordering::Relaxed);
    }

    /// Whether a chunk whose contacts have just been computed is complete. If so, the caller finishes it, and nobody
    /// else does.
    #[inline]
    pub fn completes_at_once(&self, chunk: usize) -> bool {
        // Only the chunk itself has still to count down, so that nobody else will.
        let complete = self.counters[chunk].missing.load(Ordering::Acquire) == 1;
        if complete {
            self.finished.fetch_add(1, Ordering::Relaxed);
        }
        complete
    }

    /// Counts a chunk that does not complete at once: the `worker` has computed its contacts and stored their sums.
    /// Answers whether the caller finishes the chunk now.
    #[inline]
    pub fn count_own(&self, worker: usize, chunk: usize) -> bool {
        self.counters[chunk].worker.store(worker, Ordering::Relaxed);
        self.count_down(worker, chunk)
    }

    /// Counts one contribution of a `worker` to a chunk. Answers whether the caller finishes the chunk now; if somebody
    /// else is to, the chunk is deferred to that worker.
    #[inline]
    pub fn count_down(&self, worker: usize, chunk: usize) -> bool {
        let counter = &self.counters[chunk];
        // What others wrote before they counted down is seen by the last one.
        if counter.missing.fetch_sub(1, Ordering::AcqRel) != 1 {
            return false;
        }
        let owner = counter.worker.load(Ordering::Relaxed);
        if owner == worker {
            self.finished.fetch_add(1, Ordering::Relaxed);
        } else {
            self.queues[owner].defer(chunk);
        }
        owner == worker
    }

    /// Takes a chunk that was deferred to the `worker`, to finish it; in the last phase, one that was deferred to
    /// anybody, and waits for one as long as any may still come.
    pub fn take(&self, worker: usize, phase: &Phase<'_>) -> Option<usize> {
        if !phase.is_last() {
            return self.queues[worker].take(&self.finished);
        }
        let mut rounds = 0;
        loop {
            let workers = self.queues.len();
            let queues = (0..workers).map(|next| &self.queues[(worker + next) % workers]);
            if let Some(chunk) = queues.filter_map(|queue| queue.take(&self.finished)).next() {
                return Some(chunk);
            }
            if self.finished.load(Ordering::Relaxed) == self.counters.len() || phase.is_given_up() {
                return None;
            }
            wait(&mut rounds);
        }
    }
}

impl Queue {
    /// Empty, with room for all chunks.
    fn clear(&mut self, chunks: usize) {
        self.chunks.resize_with(chunks, AtomicU32::default);
        for chunk in &self.chunks[..self.deferred.load(Ordering::Relaxed).min(chunks)] {
            chunk.store(0, Ordering::Relaxed);
        }
        self.deferred.store(0, Ordering::Relaxed);
        self.taken.store(0, Ordering::Relaxed);
    }

    fn defer(&self, chunk: usize) {
        let index = self.deferred.fetch_add(1, Ordering::Relaxed);
        self.chunks[index].store(chunk as u32 + 1, Ordering::Release);
    }

    fn take(&self, finished: &AtomicUsize) -> Option<usize> {
        loop {
            let taken = self.taken.load(Ordering::Relaxed);
            // What was written before the chunk was deferred is seen by who takes it.
            let chunk = self.chunks.get(taken)?.load(Ordering::Acquire);
            if chunk == 0 {
                return None;
            }
            let next = taken + 1;
            if self.taken.compare_exchange(taken, next, Ordering::Relaxed, Ordering::Relaxed).is_ok() {
                finished.fetch_add(1, Ordering::Relaxed);
                return Some(chunk as usize - 1);
            }
        }
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    #[test]
    fn the_last_contribution_completes_a_chunk_and_its_own_worker_finishes_it() {
        let mut hand_over = HandOver::new([0, 1, 2].into_iter());
        hand_over.begin(2);
        // Worker 1 is first with chunk 2, to which the others contribute.
        assert!(!hand_over.completes_at_once(2) && !hand_over.count_own(1, 2));
        assert!(hand_over.completes_at_once(0));
        assert!(!hand_over.count_down(0, 1) && !hand_over.count_down(0, 2));
        assert!(hand_over.completes_at_once(1), "chunk 0 has been counted");
        assert!(!hand_over.count_down(0, 2), "worker 1 has computed chunk 2 and finishes it");
        let last = Phase::alone();
        assert_eq!([hand_over.take(1, &last), hand_over.take(1, &last)], [Some(2), None]);
    }

    #[test]
    fn nothing_of_a_pass_that_was_given_up_is_left_to_the_next() {
        let mut hand_over = HandOver::new([0, 1].into_iter());
        hand_over.begin(2);
        // Chunk 0 is computed, and a panic ends the pass.
        assert!(hand_over.completes_at_once(0) && !hand_over.count_down(0, 1));
        hand_over.begin(2);
        assert!(!hand_over.completes_at_once(1), "chunk 0 of this pass is missing");
        // Again, now with a chunk that is deferred and not taken.
        assert!(!hand_over.count_own(1, 1) && !hand_over.count_down(0, 1));
        hand_over.begin(2);
        assert!(hand_over.queues.iter().all(|queue| queue.take(&hand_over.finished).is_none()));
    }
}
