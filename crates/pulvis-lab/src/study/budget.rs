//! How the threads of a study are shared by its runs.

use std::sync::{Mutex, PoisonError};

/// Threads that are free, and runs that wait for some.
#[derive(Debug)]
pub(super) struct Budget {
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    free: usize,
    waiting: usize,
}

impl Budget {
    /// So many threads for so many runs.
    pub(super) fn new(threads: usize, runs: usize) -> Self {
        Self { state: Mutex::new(State { free: threads.max(1), waiting: runs }) }
    }

    /// Threads for a run that begins and has work for `most`: one while more runs wait than threads are free, else its share.
    pub(super) fn take(&self, most: usize) -> usize {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let share = state.free / state.waiting.max(1);
        let taken = share.min(most).max(1);
        state.waiting = state.waiting.saturating_sub(1);
        state.free = state.free.saturating_sub(taken);
        taken
    }

    /// The threads of a run that has ended.
    pub(super) fn give_back(&self, threads: usize) {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).free += threads;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_have_one_thread_each_while_there_are_more_of_them_and_share_what_is_left_over() {
        let shares = |threads, runs| {
            let budget = Budget::new(threads, runs);
            (0..runs.min(threads)).map(|_| budget.take(100)).collect::<Vec<_>>()
        };
        assert_eq!(shares(2, 5), [1, 1]);
        assert_eq!(shares(8, 3), [2, 3, 3]);
        assert_eq!(shares(4, 1), [4]);
        // The last run of many takes what the others have given back, as far as it has work.
        let budget = Budget::new(4, 5);
        let first: Vec<usize> = (0..4).map(|_| budget.take(100)).collect();
        first.into_iter().take(3).for_each(|threads| budget.give_back(threads));
        assert_eq!(budget.take(2), 2);
    }
}
