//! When a run looks at what it does: rows, frames, progress.

use std::time::Instant;

use pulvis_core::Simulation;
use pulvis_input::scenario::Interval;

use super::stage::whole_steps;

/// When something regular happens next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Due {
    interval: Interval,
    count: u64,
}

impl Due {
    /// Of an interrupted run in which it has been time so often.
    pub(super) fn resume(interval: Interval, count: u64) -> Self {
        Self { interval, count }
    }

    /// Of a run that starts from another one, at the same multiples of the interval.
    pub(super) fn from_now(interval: Interval, simulation: &Simulation) -> Self {
        let count = match interval {
            _ if simulation.steps() == 0 => 0,
            Interval::Steps(steps) => simulation.steps() / steps,
            Interval::Time(time) => ((simulation.time() + 0.5 * simulation.time_step()) / time) as u64,
        };
        Self { interval, count }
    }

    /// How often it has been time.
    pub(super) fn count(&self) -> u64 {
        let Self { interval: _, count } = self;
        *count
    }

    /// Steps before which it is certainly not time.
    pub(super) fn steps_left(&self, simulation: &Simulation) -> u64 {
        match self.interval {
            Interval::Steps(steps) => ((self.count + 1) * steps).saturating_sub(simulation.steps()),
            Interval::Time(time) => whole_steps((self.count + 1) as f64 * time, simulation),
        }
    }

    /// Whether it is time; counts one up if so.
    pub(super) fn now(&mut self, simulation: &Simulation) -> bool {
        let due = self.is_now(simulation);
        self.count += u64::from(due);
        due
    }

    /// Whether it is time.
    pub(super) fn is_now(&self, simulation: &Simulation) -> bool {
        match self.interval {
            Interval::Steps(steps) => simulation.steps() >= (self.count + 1) * steps,
            Interval::Time(time) => {
                // Half a step of tolerance: sums of time steps are not exact.
                simulation.time() + 0.5 * simulation.time_step() >= (self.count + 1) as f64 * time
            }
        }
    }
}

/// Steps between looks at the clock and at a user who wants to stop.
pub(super) const PACE: u64 = 16;

/// Speed, and when to tell about it next.
pub(super) struct Pace {
    pub(super) began: Instant,
    told: Instant,
    told_steps: u64,
}

impl Pace {
    pub(super) fn new(steps: u64) -> Self {
        Self { began: Instant::now(), told: Instant::now(), told_steps: steps }
    }

    /// After so many seconds, looked at every so many steps.
    pub(super) fn is_due(&self, steps: u64, patience: f64) -> bool {
        steps.is_multiple_of(PACE) && self.told.elapsed().as_secs_f64() > patience
    }

    /// Steps per second since it was last told.
    pub(super) fn rate(&mut self, steps: u64) -> f64 {
        let seconds = self.told.elapsed().as_secs_f64();
        let rate = (steps - self.told_steps) as f64 / seconds.max(1e-9);
        self.told = Instant::now();
        self.told_steps = steps;
        rate
    }
}
