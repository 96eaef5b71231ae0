//! What is told of a collision: its end, and its course.

use super::Flight;
use crate::collision::dynamics::Phase;
use crate::collision::outcome::{Collision, Outcome, Regime, Sample, Sampling};

/// A pair whose kinetic energy and elastic energy about the force-free point are this part of what it
/// had is at rest.
const AT_REST: f64 = 1e-26;

/// What is left of the largest energy within this part is round-off: a pair that would separate with
/// less has used up its energy, which counts as sticking.
const RESOLUTION: f64 = 1e-13;

impl Flight<'_> {
    pub(super) fn at_rest(&self) -> bool {
        let force = self.response.normal_force;
        let least = AT_REST * self.scale[2];
        self.phase == Phase::Contact
            && self.problem.kinetic(self.motion[1]) < least
            && force * force < least * self.problem.stiffness_scale()
    }

    pub(super) fn outcome(&self, regime: Regime, stop_branch: Option<&'static str>) -> Outcome {
        let kinetic = self.problem.kinetic(self.motion[1]);
        let before = self.problem.kinetic(self.problem.velocity);
        let energies = &self.response.energies;
        let dissipated = self.lost + self.motion[2];
        let now = kinetic + energies.stored() + dissipated;
        let rebound = regime == Regime::Rebound;
        Outcome {
            regime,
            stop_branch,
            restitution: if rebound { -self.motion[1] / self.problem.velocity } else { 0.0 },
            overlap_max: self.overlap_max,
            overlap_end: if rebound { 0.0 - self.problem.interaction_range() } else { self.motion[0] },
            contact_duration: self.opening_time.zip(self.touch_time).map(|(end, start)| end - start),
            energy_dissipated: dissipated,
            energy_error: (before - now) / self.largest_energy,
            oblique: None,
        }
    }

    pub(super) fn finish(self) -> Collision {
        let left = self.problem.kinetic(self.motion[1]);
        let outcome = match (self.stop, self.travelled) {
            (Some(stop), _) => stop,
            (None, Some(branches)) if left < RESOLUTION * self.largest_energy => {
                // The phase has changed already where the contact was all there was.
                let phase =
                    if self.problem.interaction_range() > 0.0 { Phase::Apart } else { Phase::Contact };
                Outcome { contact_duration: None, ..self.outcome(Regime::Stick, Some(branches.name(phase))) }
            }
            _ => self.outcome(Regime::Rebound, None),
        };
        Collision { outcome, course: self.course }
    }

    /// Keeps this instant if it is asked for.
    pub(super) fn record(&mut self) {
        match &self.observation.sampling {
            Sampling::None => return,
            // Round-off of the overlap, whose root is a time near a turning point, may pass a corner of
            // the law for a moment; one instant of it is enough.
            Sampling::Every(_)
                if self.time - self.recorded.0 < 1e-4 * self.longest_step
                    && self.phase == self.recorded.1 =>
            {
                return;
            }
            Sampling::Every(_) => {}
            Sampling::At(times) => {
                // The end of a step that was cut to the sample time is that time up to round-off.
                let due = |time: &f64| *time <= self.time + 1e-15 * self.longest_step.max(self.time);
                if !times.get(self.next_sample).is_some_and(due) {
                    return;
                }
                self.next_sample += 1;
            }
        }
        self.recorded = (self.time, self.phase);
        self.course.push(self.sample());
    }

    fn sample(&self) -> Sample {
        let [overlap, velocity, viscous] = self.motion;
        let here = self.dynamics.branches(self.phase, overlap, &self.memory);
        let branches = self.travelled.unwrap_or(here);
        let energies = &self.response.energies;
        Sample {
            time: self.time,
            overlap,
            velocity,
            force: self.response.normal_force,
            delta_max: self.dynamics.remembered_overlap(&self.memory).unwrap_or(self.overlap_max),
            kinetic: self.problem.kinetic(velocity),
            potential_available: energies.elastic_normal + energies.elastic_bond,
            potential_plastic: self.dynamics.branch_potential(
                &branches,
                overlap,
                &self.response,
                &self.memory,
            ),
            potential_attraction: energies.attraction(),
            dissipated: self.lost + viscous,
            oblique: None,
        }
    }
}
