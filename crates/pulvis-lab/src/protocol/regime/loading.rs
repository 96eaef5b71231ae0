//! A contact under the load that a pressure or a speed puts on it, found by loading it slowly.

use pulvis_contact::ContactModel;
use pulvis_input::Surroundings;
use pulvis_input::collision::Bodies;
use pulvis_input::probe::ProbePath;

use crate::probe::{ProbeSample, follow};

/// Steps of a loading; what is read off is exact to about one part in as many.
const POINTS: u32 = 1000;

/// The deepest overlap that is tried, over the mean radius of the pair [1].
const DEEPEST: f64 = 0.4;

/// The shallowest one: below it differences of overlaps are round-off.
const SHALLOWEST: f64 = 1e-12;

/// A contact that is loaded from the first touch on, infinitely slowly.
pub(super) struct Loading<'a> {
    pub(super) contact: &'a ContactModel,
    pub(super) bodies: Bodies,
    pub(super) surroundings: &'a Surroundings,
}

/// A contact that carries a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Loaded {
    /// Its overlap [m].
    pub(super) overlap: f64,
    /// How much of it came after the overlap at which the contact carries nothing [m].
    pub(super) compression: f64,
    /// The force that it takes to part it again [N].
    pub(super) pull_off: f64,
}

impl Loading<'_> {
    /// The contact when it carries a `force` [N]; `None` where it does so at no overlap that a pair contact may have.
    pub(super) fn to_force(&self, force: f64) -> Option<Loaded> {
        let (samples, at) = self.until(|sample| sample.force >= force)?;
        let overlap = between(&samples[at - 1], &samples[at], force, |sample| sample.force);
        // Attraction pulls a pair together that carries nothing.
        let free = samples[..=at].iter().rposition(|sample| sample.force <= 0.0).map_or(0.0, |before| {
            between(&samples[before], &samples[before + 1], 0.0, |sample| sample.force)
        });
        Some(Loaded { overlap, compression: overlap - free.max(0.0), pull_off: self.pull_off(overlap) })
    }

    /// The overlap at which the contact has taken up an `energy` [J].
    pub(super) fn to_energy(&self, energy: f64) -> Option<f64> {
        let (samples, at) = self.until(|sample| sample.work >= energy)?;
        Some(between(&samples[at - 1], &samples[at], energy, |sample| sample.work))
    }

    /// The first instant of a loading that is `reached`, which has many before it.
    fn until(&self, reached: impl Fn(&ProbeSample) -> bool) -> Option<(Vec<ProbeSample>, usize)> {
        let mut deepest = DEEPEST * self.size();
        let mut found = None;
        while deepest > SHALLOWEST * self.size() {
            let samples = self.follow(&[0.0, deepest]);
            let Some(at) = samples.iter().position(&reached).filter(|at| *at > 0) else { break };
            let coarse = at < POINTS as usize / 10;
            found = Some((samples, at));
            if !coarse {
                break;
            }
            deepest *= 0.1;
        }
        found
    }

    /// The largest tension while the contact is parted, after an overlap [m].
    fn pull_off(&self, overlap: f64) -> f64 {
        let reach = self.contact.interaction_range(&self.bodies.pair(), self.bodies.radii());
        let apart = reach.min(self.size()) + 1e-6 * overlap;
        let parting = self.follow(&[0.0, overlap, -apart]);
        let least = parting.iter().skip(POINTS as usize).map(|sample| sample.force).fold(0.0, f64::min);
        least.abs()
    }

    /// The harmonic mean of the radii [m].
    fn size(&self) -> f64 {
        self.bodies.pair().harmonic_radius()
    }

    fn follow(&self, overlaps: &[f64]) -> Vec<ProbeSample> {
        let poses = overlaps.iter().map(|overlap| [*overlap, 0.0, 0.0, 0.0]).collect();
        let path =
            ProbePath { poses, prescribed: [true, false, false, false], durations: None, points: POINTS };
        follow(self.contact, &self.bodies, &path, self.surroundings)
    }
}

/// The overlap between two instants at which a quantity has a value, by a straight line.
fn between(before: &ProbeSample, after: &ProbeSample, value: f64, of: impl Fn(&ProbeSample) -> f64) -> f64 {
    let (low, high) = (of(before), of(after));
    let share = if high > low { ((value - low) / (high - low)).clamp(0.0, 1.0) } else { 1.0 };
    before.overlap + share * (after.overlap - before.overlap)
}
