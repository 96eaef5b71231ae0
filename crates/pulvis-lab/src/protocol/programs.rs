//! Parameters that change while a stage runs.

use pulvis_core::{Interactions, Simulation};
use pulvis_input::scenario::{Background, Scenario, Stage};

use super::error::RunError;
use super::setup::interactions;

/// What holds after each update of a stage's programs, that of the start first; nothing where there are none.
pub(super) fn program_plans(scenario: &Scenario, stage: &Stage) -> Vec<(Interactions, Background)> {
    let states = stage.programs.iter().flat_map(|programs| &programs.states);
    states.map(|state| (interactions(scenario, &state.contacts), state.background)).collect()
}

/// The contact models of a stage after an update of its programs.
pub(super) fn models_after(scenario: &Scenario, stage: &Stage, update: usize) -> Interactions {
    let programs = stage.programs.as_ref().and_then(|programs| programs.states.get(update));
    interactions(scenario, programs.map_or(&stage.contacts, |state| &state.contacts))
}

/// The time since the start of the stage by which things are due [s]. Half a step of tolerance: sums of time steps are not exact.
pub(super) fn elapsed(simulation: &Simulation, start_time: f64) -> f64 {
    simulation.time() - start_time + 0.5 * simulation.time_step()
}

/// Brings a simulation, which has these `interactions`, to the update that is due. The work of the change is booked as that of
/// any switch.
pub(super) fn update(
    simulation: &mut Simulation,
    interactions: &mut Interactions,
    present: &mut usize,
    (stage, plans): (&Stage, &[(Interactions, Background)]),
    start_time: f64,
) -> Result<(), RunError> {
    let Some(programs) = &stage.programs else { return Ok(()) };
    let due = programs.due(elapsed(simulation, start_time));
    let Some((models, background)) = plans.get(due).filter(|_| due != *present) else { return Ok(()) };
    let failed = |source| RunError::Switch { stage: stage.name.clone(), source };
    if interactions != models {
        simulation.set_interactions(models.clone()).map_err(failed)?;
        interactions.clone_from(models);
    }
    if simulation.background() != background {
        simulation.set_background(*background).map_err(failed)?;
    }
    *present = due;
    Ok(())
}
