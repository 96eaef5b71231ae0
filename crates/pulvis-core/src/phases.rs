//! Time spent in the parts of a step.

use std::ops::AddAssign;
use std::time::Instant;

/// Time spent in the parts of a step [s], summed over threads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phases {
    /// Contacts between particles.
    pub pairs: f64,
    /// Contacts with walls.
    pub walls: f64,
    /// Adding up sums, kicks and drift.
    pub integration: f64,
    /// Rebuilds of the neighbour list; wall time of one thread, while others may have helped.
    pub neighbours: f64,
}

impl AddAssign for Phases {
    fn add_assign(&mut self, other: Self) {
        self.pairs += other.pairs;
        self.walls += other.walls;
        self.integration += other.integration;
        self.neighbours += other.neighbours;
    }
}

/// A clock that is read only if times are measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stopwatch(Option<Instant>);

impl Stopwatch {
    pub(crate) fn start(wanted: bool) -> Self {
        Self(wanted.then(Instant::now))
    }

    /// Adds the time since the last call [s].
    pub(crate) fn lap(&mut self, total: &mut f64) {
        if let Some(before) = self.0 {
            let now = Instant::now();
            *total += (now - before).as_secs_f64();
            self.0 = Some(now);
        }
    }
}
