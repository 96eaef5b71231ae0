//! For how long an inlet has been open, and when it acts next.

use pulvis_core::Simulation;
use pulvis_input::scenario::Schedule;

use super::super::stage::whole_steps;

/// The times of an inlet.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Clock {
    /// How long it had been open before it was opened last [s].
    pub(super) open_before: f64,
    /// When it was opened, if it is open in the present stage [s].
    pub(super) opened: Option<f64>,
    /// How often it has acted since.
    pub(super) looks: u64,
}

impl Clock {
    /// Of an inlet that has never been open.
    pub(super) const SHUT: Self = Self { open_before: 0.0, opened: None, looks: 0 };

    /// Opens or shuts it at a time [s].
    pub(super) fn set(&mut self, is_open: bool, schedule: &Schedule, time: f64) {
        match (self.opened, is_open) {
            (None, true) => (self.opened, self.looks) = (Some(time), 0),
            (Some(_), false) => {
                self.open_before = self.open_time(schedule, time);
                self.opened = None;
            }
            _ => {}
        }
    }

    /// How long it has been open at a time, in all [s].
    pub(super) fn open_time(&self, schedule: &Schedule, time: f64) -> f64 {
        let opened =
            self.opened.map_or(0.0, |opened| (time.min(schedule.stop) - opened.max(schedule.start)).max(0.0));
        self.open_before + opened
    }

    /// When it acts next [s]; `None` while it is shut.
    fn next(&self, schedule: &Schedule, interval: f64) -> Option<f64> {
        self.opened.map(|opened| opened.max(schedule.start) + (self.looks as f64 + 1.0) * interval)
    }

    /// Steps before which it certainly does not act.
    pub(super) fn steps_left(&self, schedule: &Schedule, interval: f64, simulation: &Simulation) -> u64 {
        self.next(schedule, interval).map_or(u64::MAX, |next| whole_steps(next, simulation))
    }

    /// Whether it acts now; counts on if so.
    pub(super) fn now(&mut self, schedule: &Schedule, interval: f64, simulation: &Simulation) -> bool {
        // Half a step of tolerance: sums of time steps are not exact.
        let time = simulation.time() + 0.5 * simulation.time_step();
        let Some(next) = self.next(schedule, interval).filter(|next| time >= *next) else { return false };
        // Intervals that are shorter than a step pass together.
        let missed = ((time - next) / interval) as u64;
        self.looks = self.looks.saturating_add(1).saturating_add(missed);
        true
    }
}
