//! From one stage to the next.

use std::collections::BTreeSet;

use pulvis_core::walls::WallMotion;
use pulvis_core::{Interactions, Simulation};
use pulvis_input::scenario::{Scenario, Stage, WallControl};

use super::error::RunError;
use super::groups::switch_groups;
use super::setup::StagePlan;

/// Switches a simulation, which has these `interactions`, to what holds during a stage. `walls_arrive`: motions of walls
/// with an end have come to it, but for those of the walls `led` by a program, which stages leave alone that do not control
/// them.
pub(super) fn switch(
    simulation: &mut Simulation,
    interactions: &mut Interactions,
    scenario: &Scenario,
    (plan, stage): (&StagePlan, &Stage),
    (walls_arrive, led): (bool, &BTreeSet<usize>),
) -> Result<(), RunError> {
    if let Some(region) = &stage.remove {
        simulation.remove_within(region);
    }
    let failed = |source| RunError::Switch { stage: stage.name.clone(), source };
    if *interactions != plan.interactions {
        simulation.set_interactions(plan.interactions.clone()).map_err(failed)?;
        *interactions = plan.interactions.clone();
    }
    if *simulation.background() != plan.background {
        simulation.set_background(plan.background).map_err(failed)?;
    }
    if simulation.time_step().to_bits() != plan.time_step.to_bits() {
        simulation.set_time_step(plan.time_step).map_err(failed)?;
    }
    // A wall that was on its way by a function of time has arrived.
    for place in (0..simulation.walls().len()).filter(|_| walls_arrive) {
        let changed = plan.wall_changes.iter().any(|(wall, _)| *wall == place);
        if !changed && !led.contains(&place) && simulation.walls()[place].motion.law().duration().is_some() {
            simulation.set_wall_motion(place, WallMotion::Fixed).map_err(failed)?;
        }
    }
    for (place, control) in &plan.wall_changes {
        simulation.set_wall_motion(*place, control.motion().unwrap_or_default()).map_err(failed)?;
        if matches!(control, WallControl::Removed) {
            simulation.set_wall_present(*place, false);
        }
    }
    // Before the cell deforms, which groups that are held would keep it from.
    switch_groups(simulation, scenario, stage, walls_arrive)?;
    if let Some(motion) = stage.cell {
        simulation.set_cell_motion(motion).map_err(failed)?;
    }
    if stage.form_bonds {
        simulation.form_bonds();
    }
    Ok(())
}
