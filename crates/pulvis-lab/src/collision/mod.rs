//! Collisions of two spheres, or of a sphere and a plane, head on or oblique.
//!
//! The relative motion m_r d²δ/dt² = −f is integrated for any contact model of the catalogue, in one of
//! two ways: *exact* stops at every change of branch and is good to about 1e-12; *engine* takes steps of
//! one length as the engine does, so that the error of a time step can be seen. [`closed_form`] says
//! what theory expects, where it has a formula. Oblique collisions, and those with spin, are the engine's.

mod closed_form;
mod dynamics;
mod engine;
mod error;
mod exact;
mod extrapolation;
mod limits;
mod oblique;
mod outcome;
mod picture;
mod problem;
mod sticking;
mod table;

pub use closed_form::{ClosedForm, closed_form};
pub use error::CollisionError;
pub use limits::{VelocityLimit, velocity_limits};
pub use oblique::{ObliqueOutcome, ObliqueSample};
pub use outcome::{Collision, Observation, Outcome, Regime, Sample, Sampling};
pub(crate) use picture::{case_label, drawn_course, fine_cases, sticking_limits};
pub use picture::{figure, sampling_interval};
pub use sticking::{sticking_ranges, typical_speed};
pub use table::{
    COLUMNS, OBLIQUE_COLUMNS, OBLIQUE_TRAJECTORY_COLUMNS, TRAJECTORY_COLUMNS, result_table, trajectory_table,
};

use problem::Problem;
use pulvis_input::collision::{CollisionCase, CollisionScenario, Method};

/// Computes one collision.
///
/// # Errors
/// The motion does not end, or leaves the range of numbers; an oblique collision is asked for by the exact method.
pub fn collide(case: &CollisionCase, observation: &Observation) -> Result<Collision, CollisionError> {
    let problem = Problem::new(case);
    match case.method {
        Method::Exact if case.incidence.is_some() => Err(CollisionError::ObliqueExact),
        Method::Exact => exact::collide(&problem, observation),
        Method::Engine { steps_per_contact } => engine::collide(&problem, steps_per_contact, observation),
    }
}

/// One collision of a sweep, with what theory says of it.
#[derive(Clone, Debug)]
pub struct SweepPoint {
    /// The collision that was asked for.
    pub case: CollisionCase,
    /// Its end.
    pub collision: Collision,
    /// The closed form, where there is one.
    pub theory: Option<ClosedForm>,
}

/// Computes all collisions of a scenario, and with `record` their courses in steps of
/// [`sampling_interval`].
///
/// # Errors
/// The first collision that cannot be computed.
pub fn sweep(scenario: &CollisionScenario, record: bool) -> Result<Vec<SweepPoint>, CollisionError> {
    let time_after_sticking = scenario.time_after_sticking;
    let point = |case: &CollisionCase| {
        let sampling = if record { Sampling::Every(sampling_interval(case)) } else { Sampling::None };
        // What a pair does after it has stuck is told by its course only.
        let time_after_sticking = if record { time_after_sticking } else { 0.0 };
        let observation = Observation { sampling, time_after_sticking, ..Observation::default() };
        let collision = collide(case, &observation)?;
        Ok(SweepPoint { case: case.clone(), collision, theory: closed_form(case) })
    };
    scenario.cases.iter().map(point).collect()
}
