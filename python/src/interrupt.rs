//! Work without the interpreter lock, which Ctrl-C reaches all the same.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::errors;

/// How long Ctrl-C waits at most, but for a single step that takes longer.
pub const PATIENCE: Duration = Duration::from_millis(50);

/// Does something without the interpreter lock. A panic becomes an exception.
pub fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    py.detach(|| catch_unwind(AssertUnwindSafe(work))).map_err(|payload| errors::panicked(&*payload))
}

/// How many units of work are done between two looks at Ctrl-C.
#[derive(Debug)]
pub struct Chunks {
    size: u64,
    began: Instant,
}

impl Chunks {
    /// Starts with one unit, whose cost is not known.
    pub fn new() -> Self {
        Self { size: 1, began: Instant::now() }
    }

    /// The size of the next chunk.
    pub fn next(&mut self, left: u64) -> u64 {
        self.began = Instant::now();
        self.size.min(left)
    }

    /// Adapts the size to what a chunk of `done` units took.
    pub fn took(&mut self, done: u64) {
        let seconds = self.began.elapsed().as_secs_f64().max(1e-9);
        let rate = done as f64 / seconds;
        // Half of the patience: the next units may cost more. A cast beyond the range saturates.
        let fitting = (0.5 * PATIENCE.as_secs_f64() * rate) as u64;
        self.size = fitting.clamp(1, self.size.saturating_mul(8));
    }
}
