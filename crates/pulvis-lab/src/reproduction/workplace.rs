//! Where figures are computed, and by how many threads at once.

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Condvar, Mutex, PoisonError};

/// What all figures share while they are computed.
pub struct Workplace<'w> {
    /// The folder for everything; runs write below it.
    pub folder: &'w Path,
    /// Ends everything when it is set.
    pub stop: &'w AtomicBool,
    /// Whether runs that are there, have ended and had the same scenario are taken instead of new ones.
    pub reuse: bool,
    /// Version of the program, for the records of the runs.
    pub version: &'w str,
    /// Told of each run that has ended.
    pub tell: &'w (dyn Fn(&RunDone) + Sync),
    /// Who may compute at the same time.
    pub seats: Seats,
}

/// A run of a figure that has ended.
#[derive(Clone, Debug)]
pub struct RunDone {
    /// The figure.
    pub figure: String,
    /// The data.
    pub data: String,
    /// The variant; empty where there is only one.
    pub variant: String,
    /// Time that it took [s].
    pub duration: f64,
    /// Whether it was there already.
    pub is_reused: bool,
}

/// As many as there are processors: figures and runs of figures take one while they compute.
#[derive(Debug)]
pub struct Seats {
    free: Mutex<usize>,
    changed: Condvar,
}

impl Seats {
    /// So many seats, at least one.
    pub fn new(count: usize) -> Self {
        Self { free: Mutex::new(count.max(1)), changed: Condvar::new() }
    }

    /// Waits for a free seat and takes it.
    pub(super) fn take(&self) -> Seat<'_> {
        let mut free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        while *free == 0 {
            free = self.changed.wait(free).unwrap_or_else(PoisonError::into_inner);
        }
        *free -= 1;
        Seat { of: self }
    }
}

/// A seat that is taken; free again when dropped.
pub(super) struct Seat<'s> {
    of: &'s Seats,
}

impl Drop for Seat<'_> {
    fn drop(&mut self) {
        *self.of.free.lock().unwrap_or_else(PoisonError::into_inner) += 1;
        self.of.changed.notify_one();
    }
}
