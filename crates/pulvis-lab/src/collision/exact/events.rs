//! Where a step has to end: touch and opening, turning points, changes of branch.

use super::Flight;
use crate::collision::dynamics::{Branches, Phase};
use crate::collision::extrapolation::Trial;
use crate::collision::outcome::Sampling;

/// What ended a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Event {
    /// Nothing happened.
    None,
    /// The law has changed its branch.
    Branch,
    /// The motion has turned.
    Turn,
    /// The bodies have touched, or come apart.
    Border,
}

impl Flight<'_> {
    /// What happened within a step that was tried.
    pub(super) fn event(&self, trial: &Trial<3>, direction: f64, branches: &[Branches; 2]) -> Event {
        let [overlap, velocity, _] = trial.end;
        let left = match self.phase {
            Phase::Contact => overlap <= 0.0,
            Phase::Apart => overlap >= 0.0,
        };
        if left {
            Event::Border
        } else if velocity * direction <= 0.0 {
            Event::Turn
        } else if !branches.contains(&self.dynamics.branches(self.phase, overlap, &self.memory)) {
            Event::Branch
        } else {
            Event::None
        }
    }

    /// Halves the step until the event is met to round-off, and stops just behind it.
    pub(super) fn advance_to_event(&mut self, length: f64, direction: f64, branches: &[Branches; 2]) {
        let (mut before, mut behind) = (0.0, length);
        loop {
            let middle = 0.5 * (before + behind);
            if middle <= before || middle >= behind || behind - before < 1e-17 * self.longest_step {
                break;
            }
            if self.event(&self.attempt(middle), direction, branches) == Event::None {
                before = middle;
            } else {
                behind = middle;
            }
        }
        let trial = self.attempt(behind);
        let event = self.event(&trial, direction, branches);
        let mut end = trial.end;
        match event {
            // Exactly: the laws and the next step shall not see round-off of the wrong sign.
            Event::Border => end[0] = 0.0,
            Event::Turn => end[1] = 0.0,
            Event::Branch | Event::None => {}
        }
        self.accept(behind, &end);
        if event == Event::Border {
            if self.phase == Phase::Contact && matches!(self.observation.sampling, Sampling::Every(_)) {
                self.record();
            }
            self.cross_border();
        }
    }
}
