//! One contact on a prescribed path: what an indenter does.
//!
//! Two bodies are led along overlap, shear, roll and twist; forces, torques and energies come out. The contact is asked
//! step by step as the engine asks it, with the same memory. Without a speed the path is followed infinitely slowly:
//! dashpots see no motion.

mod indenter;
mod picture;
mod table;

pub use picture::figure;
pub use table::{COLUMNS, result_table, summary_table};

use indenter::Indenter;
use pulvis_contact::ContactModel;
use pulvis_input::Surroundings;
use pulvis_input::collision::Bodies;
use pulvis_input::probe::{ProbePath, ProbeScenario};
use thiserror::Error;

/// One instant of a probe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbeSample {
    /// Time since the start; `None` on an infinitely slow path [s].
    pub time: Option<f64>,
    /// Number of legs behind, and the part of the present one [1].
    pub leg: f64,
    /// Overlap δ [m].
    pub overlap: f64,
    /// Total force along the normal, repulsion positive [N].
    pub force: f64,
    /// Radius of the contact area; zero for laws that know none [m].
    pub contact_radius: f64,
    /// Energy that all springs of the contact store, with the potential of attractions [J].
    pub stored_energy: f64,
    /// Energy lost so far [J].
    pub dissipated: f64,
    /// The branch of the normal law, or of the attraction where the bodies are apart.
    pub branch: &'static str,
    /// Displacement of i against j along the surface [m].
    pub shear: f64,
    /// Force against the displacement [N].
    pub shear_force: f64,
    /// Rolling of i against j as an arc: a12 times the angle [m].
    pub roll: f64,
    /// Torque against rolling [N m].
    pub roll_torque: f64,
    /// Twisting of i against j as an arc: a12 times the angle [m].
    pub twist: f64,
    /// Torque against twisting [N m].
    pub twist_torque: f64,
    /// Work done on the contact so far, from the forces by the trapezoidal rule: stored and dissipated energy, but
    /// for errors of the second order in the length of the steps [J].
    pub work: f64,
}

/// A contact that was led along its path.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeCurve {
    /// What it is called.
    pub label: String,
    /// Its instants, in the order of the path.
    pub samples: Vec<ProbeSample>,
}

/// A probe that cannot be computed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ProbeError {
    /// The answer of the contact is no number.
    #[error(
        "the force of `{label}` left the range of numbers at an overlap of {overlap:?} m; check the magnitudes of radii and stiffnesses"
    )]
    NotFinite {
        /// What the contact is called.
        label: String,
        /// Overlap there [m].
        overlap: f64,
    },
}

/// Leads all contacts of a scenario along its path.
///
/// # Errors
/// A force or an energy is not a finite number.
pub fn probe(scenario: &ProbeScenario) -> Result<Vec<ProbeCurve>, ProbeError> {
    let curve = |contact: &pulvis_input::LabelledContact| {
        let label = contact.label.clone();
        let samples =
            follow(&contact.contact.model, &scenario.bodies, &scenario.path, &scenario.surroundings);
        let strange = |sample: &&ProbeSample| {
            let numbers = [
                sample.force,
                sample.shear_force,
                sample.roll_torque,
                sample.twist_torque,
                sample.stored_energy,
                sample.dissipated,
            ];
            !numbers.iter().all(|number| number.is_finite())
        };
        match samples.iter().find(strange) {
            Some(sample) => Err(ProbeError::NotFinite { label, overlap: sample.overlap }),
            None => Ok(ProbeCurve { label, samples }),
        }
    };
    scenario.contacts.iter().map(curve).collect()
}

/// Leads one contact along a path.
pub fn follow(
    contact: &ContactModel,
    bodies: &Bodies,
    path: &ProbePath,
    surroundings: &Surroundings,
) -> Vec<ProbeSample> {
    let Some(start) = path.poses.first() else { return Vec::new() };
    let mut indenter = Indenter::new(contact, bodies, surroundings, *start, path.durations.is_some());
    for (leg, (from, to)) in path.poses.iter().zip(path.poses.iter().skip(1)).enumerate() {
        let duration = path.durations.as_ref().and_then(|durations| durations.get(leg).copied());
        indenter.follow_leg(from, to, duration, path.points);
    }
    indenter.samples
}
