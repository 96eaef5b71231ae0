//! What stopped a run, as a file in its folder: the state in the middle of the step that failed is in no checkpoint.

use std::path::Path;

use pulvis_core::{ParticleId, Simulation, StepError};

use super::view;
use super::views::contacts;

/// The file.
pub(in crate::protocol) const ALARM: &str = "alarm.txt";

/// Its first line.
const HEADING: &str = "Pulvis alarm";

/// What stopped a run.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::protocol) struct AlarmReport {
    /// In which step.
    pub(super) step: u64,
    /// The particles concerned.
    pub(super) particles: Vec<ParticleId>,
    /// For people.
    pub(super) text: String,
}

impl AlarmReport {
    /// The report of an alarm; `message` says what happened, and why.
    pub(in crate::protocol) fn new(simulation: &Simulation, error: &StepError, message: &str) -> Self {
        let mut particles = error.alarm.particles();
        if particles.is_empty() {
            let deepest = simulation.first_deep_contact().map(|deep| deep.first);
            particles.extend(deepest.or_else(|| contacts(simulation).first().map(|contact| contact.first)));
        }
        Self { step: error.step, ..Self::of_sound_state(simulation, &particles, message) }
    }

    /// The report of what has stopped a run between two steps, whose state is sound: an inlet without room.
    pub(in crate::protocol) fn of_sound_state(
        simulation: &Simulation,
        particles: &[ParticleId],
        message: &str,
    ) -> Self {
        let text = format!("{message}\n\nAs it was then:\n\n{}", view(simulation, particles));
        Self { step: simulation.steps(), particles: particles.to_vec(), text }
    }

    /// The text of the file.
    pub(in crate::protocol) fn to_text(&self) -> String {
        let particles: Vec<String> = self.particles.iter().map(ToString::to_string).collect();
        format!("{HEADING}\nstep = {}\nparticles = {}\n\n{}", self.step, particles.join(" "), self.text)
    }

    /// Reads the file; `None` where there is none, or something else.
    pub(super) fn read(path: &Path) -> Option<Self> {
        Self::from_text(&std::fs::read_to_string(path).ok()?)
    }

    fn from_text(text: &str) -> Option<Self> {
        let (header, text) = text.strip_prefix(HEADING)?.split_once("\n\n")?;
        let value = |key: &str| {
            let mut lines = header.lines().filter_map(|line| line.split_once(" = "));
            lines.find(|(name, _)| *name == key).map(|(_, value)| value)
        };
        let particles = value("particles").unwrap_or("").split_whitespace();
        let particles = particles.map(|id| id.parse().ok()).collect::<Option<_>>()?;
        Some(Self { step: value("step")?.parse().ok()?, particles, text: text.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn a_report_reads_back_and_what_is_none_is_not_read() {
        for particles in [vec![], vec![1734, 98]] {
            let report = AlarmReport { step: 12, particles, text: "too deep\n\nsecond part\n".to_owned() };
            assert_eq!(AlarmReport::from_text(&report.to_text()), Some(report));
        }
        for text in ["", "Pulvis alarm", "Pulvis alarm\nstep = x\n\n", "notes\nstep = 1\n\nmine"] {
            assert_eq!(AlarmReport::from_text(text), None, "{text}");
        }
    }
}
