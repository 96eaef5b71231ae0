//! The pool and the hand-over in every order of their operations: `cargo xtask loom`.
//!
//! Loom runs each model again and again, with all orders of atomic operations and all values that the memory model lets
//! a load see, up to a number of switches between threads (`LOOM_MAX_PREEMPTIONS`). Its cells report two threads that
//! use them at the same time, its threads a sleep from which nobody wakes them.

use loom::cell::UnsafeCell;
use loom::sync::Arc;
use loom::sync::atomic::{AtomicBool, Ordering};
use loom::thread;

use crate::hand_over::HandOver;
use crate::thread_pool::{Phase, ThreadPool};

/// Numbers that threads write in turn, each for itself: loom finds two that do it at the same time.
struct Cells(Vec<UnsafeCell<u32>>);

impl Cells {
    fn new(count: usize) -> Self {
        Self((0..count).map(|_| UnsafeCell::new(0)).collect())
    }

    fn add(&self, index: usize, amount: u32) {
        // SAFETY: loom stops the model if anyone else uses the cell now.
        self.0[index].with_mut(|number| unsafe { *number += amount });
    }

    fn get(&self, index: usize) -> u32 {
        // SAFETY: loom stops the model if anyone writes the cell now.
        self.0[index].with(|number| unsafe { *number })
    }
}

// SAFETY: loom sees all uses.
unsafe impl Sync for Cells {}
// SAFETY: as above.
unsafe impl Send for Cells {}

#[test]
fn a_region_does_every_number_once_and_ends_when_all_are_done() {
    loom::model(|| {
        let pool = ThreadPool::of(2).unwrap_or_default();
        assert_eq!(pool.threads(), 2);
        let cells = Cells::new(2);
        pool.for_each_number(2, |_, number| cells.add(number, 1));
        // The region is over: nobody else uses the cells.
        assert_eq!([cells.get(0), cells.get(1)], [1, 1]);
    });
}

#[test]
fn a_helper_that_sleeps_or_comes_late_takes_part_in_the_next_region_or_in_none() {
    loom::model(|| {
        let pool = ThreadPool::of(2).unwrap_or_default();
        for round in 1..=2 {
            // The work of each region lives no longer than the region.
            let cells = Cells::new(1);
            let amount = Box::new(round);
            pool.for_each_number(1, |_, number| cells.add(number, *amount));
            assert_eq!(cells.get(0), round);
        }
    });
}

#[test]
fn a_helper_that_sleeps_is_woken_for_the_next_region() {
    loom::model(|| {
        let pool = ThreadPool::of(2).unwrap_or_default();
        let has_come = AtomicBool::new(false);
        pool.for_each_number_in_phases(
            0,
            |_, _| {},
            |worker, _| match worker {
                // Loom stops a model that waits for ever.
                0 => while_not(&has_come),
                _ => has_come.store(true, Ordering::Relaxed),
            },
        );
    });
}

fn while_not(condition: &AtomicBool) {
    while !condition.load(Ordering::Relaxed) {
        thread::yield_now();
    }
}

/// A pass over three chunks by two workers, as the engine does it (`contacts/force_pass.rs`): chunk 0 contributes to 1
/// and 2, chunk 1 to 2.
struct Pass {
    hand_over: HandOver,
    /// Rows of each chunk: read with the contacts of the chunk and of those that contribute to it, written at the end.
    rows: Cells,
    /// The sums of each chunk that does not complete at once.
    sums: Cells,
    /// The contributions 0 to 1, 0 to 2, 1 to 2.
    halos: Cells,
}

/// What a chunk contributes to: the chunk and the slot of the contribution.
const DEPENDENTS: [&[(usize, usize)]; 3] = [&[(1, 0), (2, 1)], &[(2, 2)], &[]];
/// The slots of the contributions to a chunk.
const CONTRIBUTIONS: [&[usize]; 3] = [&[], &[0], &[1, 2]];

impl Pass {
    fn new() -> Self {
        let mut hand_over = HandOver::new(CONTRIBUTIONS.iter().map(|slots| slots.len() as u32));
        hand_over.begin(2);
        Self { hand_over, rows: Cells::new(3), sums: Cells::new(3), halos: Cells::new(3) }
    }

    fn compute(&self, worker: usize, chunk: usize) {
        assert_eq!(
            self.rows.get(chunk),
            0,
            "the contacts of chunk {chunk} are computed with rows that have moved"
        );
        for &(dependent, slot) in DEPENDENTS[chunk] {
            assert_eq!(self.rows.get(dependent), 0, "rows of chunk {dependent} have moved");
            self.halos.add(slot, 1);
        }
        if self.hand_over.completes_at_once(chunk) {
            self.finish(chunk, 1);
        } else {
            self.sums.add(chunk, 1);
            if self.hand_over.count_own(worker, chunk) {
                self.finish_stored(chunk);
            }
        }
        for &(dependent, _) in DEPENDENTS[chunk] {
            if self.hand_over.count_down(worker, dependent) {
                self.finish_stored(dependent);
            }
        }
    }

    fn finish_stored(&self, chunk: usize) {
        self.finish(chunk, self.sums.get(chunk));
    }

    fn finish(&self, chunk: usize, own: u32) {
        let halos: u32 = CONTRIBUTIONS[chunk].iter().map(|&slot| self.halos.get(slot)).sum();
        self.rows.add(chunk, own + halos);
    }

    fn work(&self, worker: usize, chunks: &[usize]) {
        for &chunk in chunks {
            self.compute(worker, chunk);
        }
        for phase in [Phase::first(), Phase::alone()] {
            while let Some(chunk) = self.hand_over.take(worker, &phase) {
                self.finish_stored(chunk);
            }
        }
    }

    fn assert_complete(&self) {
        assert_eq!([0, 1, 2].map(|chunk| self.rows.get(chunk)), [1, 2, 3]);
    }
}

/// Both workers compute their chunks and finish what is complete.
fn model_of_a_pass(chunks_of_workers: [&'static [usize]; 2]) {
    loom::model(move || {
        let pass = Arc::new(Pass::new());
        let helper = {
            let pass = Arc::clone(&pass);
            thread::spawn(move || pass.work(1, chunks_of_workers[1]))
        };
        pass.work(0, chunks_of_workers[0]);
        assert!(helper.join().is_ok());
        pass.assert_complete();
    });
}

#[test]
fn every_chunk_is_finished_once_after_all_contributions_when_the_first_worker_has_the_first_chunk() {
    model_of_a_pass([&[0], &[1, 2]]);
}

#[test]
fn every_chunk_is_finished_once_after_all_contributions_when_chunks_are_computed_backwards() {
    model_of_a_pass([&[2, 0], &[1]]);
}

#[test]
fn every_chunk_is_finished_once_after_all_contributions_when_the_last_chunk_is_first() {
    model_of_a_pass([&[2, 1], &[0]]);
}

#[test]
fn a_pass_on_the_pool_finishes_every_chunk() {
    loom::model(|| {
        let pool = ThreadPool::of(2).unwrap_or_default();
        let pass = Pass::new();
        pool.for_each_number_in_phases(
            3,
            |worker, chunk| pass.compute(worker, chunk),
            |worker, phase| {
                while let Some(chunk) = pass.hand_over.take(worker, phase) {
                    pass.finish_stored(chunk);
                }
            },
        );
        pass.assert_complete();
    });
}
