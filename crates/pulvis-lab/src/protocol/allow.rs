//! Refusals that an author may lift, and what stops a run all the same.

use pulvis_core::Limits;
use pulvis_input::Problem;
use pulvis_input::scenario::{Refusal, Scenario};

use super::error::PrepareError;

/// Refuses what the author has not allowed, at the first of the `paths` that stands in the file.
pub(super) fn refuse_unless_allowed(
    scenario: &Scenario,
    refusal: Refusal,
    paths: &[&str],
    problem: Problem,
    help: &str,
) -> Result<(), PrepareError> {
    if scenario.allows(refusal) {
        return Ok(());
    }
    let help = format!("{help}; who knows better lets it pass with `--allow {}`", refusal.name());
    Err(scenario.mistake(paths, problem, help).into())
}

/// What stops the simulation of a scenario. What was allowed before the run does not stop it later.
pub(super) fn limits(scenario: &Scenario) -> Limits {
    let pulvis_input::scenario::Limits { energy_error, overlap, speed } = scenario.limits;
    let mut limits = Limits { energy_error, overlap, speed, ..Limits::default() };
    for refusal in &scenario.allow {
        match refusal {
            Refusal::TimeStep => limits.steps_per_contact = Limits::NONE.steps_per_contact,
            Refusal::Speed => limits.displacement = Limits::NONE.displacement,
            Refusal::CrossingWalls => limits.walls_may_cross = Limits::NONE.walls_may_cross,
            Refusal::Overdamped | Refusal::Overlap | Refusal::Pressure | Refusal::Memory | Refusal::Disk => {}
        }
    }
    limits
}

/// What is let pass, as warnings.
pub(super) fn allowed(scenario: &Scenario) -> impl Iterator<Item = String> {
    let text = |refusal: &Refusal| format!("allowed by `{}`: {}", refusal.name(), refusal.meaning());
    scenario.allow.iter().map(text)
}
