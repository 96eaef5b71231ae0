//! Chunks whose forces and torques are complete, but which nobody has finished at once.

use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};

use crate::thread_pool::{Phase, wait};

/// Complete chunks that wait to be finished: the worker of the pool that brought their countdown to its end
/// has other rows in its caches. The worker that computed their contacts finishes them when it has computed
/// all of its own chunks; what is left then is shared out.
#[derive(Debug, Default)]
pub(super) struct DeferredChunks {
    /// One for each worker of the pool: the chunks whose contacts it has computed.
    queues: Vec<Queue>,
    /// Chunks that have been finished at once, or taken.
    finished: AtomicUsize,
    chunks: usize,
}

#[derive(Debug, Default)]
struct Queue {
    /// Numbers of chunks plus one, in the order in which they were left; zero where none stands yet.
    chunks: Vec<AtomicU32>,
    left: AtomicUsize,
    taken: AtomicUsize,
}

impl Clone for DeferredChunks {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl DeferredChunks {
    /// Gets ready for the next sweep over so many chunks.
    pub(super) fn clear(&mut self, workers: usize, chunks: usize) {
        self.queues.resize_with(workers, Queue::default);
        for queue in &mut self.queues {
            queue.chunks.resize_with(chunks, AtomicU32::default);
            for chunk in &mut queue.chunks[..*queue.left.get_mut()] {
                *chunk.get_mut() = 0;
            }
            (*queue.left.get_mut(), *queue.taken.get_mut()) = (0, 0);
        }
        *self.finished.get_mut() = 0;
        self.chunks = chunks;
    }

    /// Leaves a complete chunk to the worker that has computed its contacts.
    pub(super) fn leave(&self, worker: usize, chunk: usize) {
        let queue = &self.queues[worker];
        let index = queue.left.fetch_add(1, Ordering::Relaxed);
        queue.chunks[index].store(chunk as u32 + 1, Ordering::Release);
    }

    /// Counts a chunk that need not be left.
    pub(super) fn count_finished(&self) {
        self.finished.fetch_add(1, Ordering::Relaxed);
    }

    /// Takes a chunk that was left to the `worker`; at its last turn, one that was left to anybody, and
    /// waits for one as long as any may still be left.
    pub(super) fn take(&self, worker: usize, turn: &Phase<'_>) -> Option<usize> {
        if !turn.is_last() {
            return self.queues[worker].take(&self.finished);
        }
        let mut rounds = 0;
        loop {
            let workers = self.queues.len();
            let queues = (0..workers).map(|next| &self.queues[(worker + next) % workers]);
            if let Some(chunk) = queues.filter_map(|queue| queue.take(&self.finished)).next() {
                return Some(chunk);
            }
            if self.finished.load(Ordering::Relaxed) == self.chunks || turn.is_given_up() {
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
            // What was written before the chunk was left is seen by who takes it.
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
