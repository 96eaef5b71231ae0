//! Groups of particles: who belongs to them, how stages move them, and what is written of them.

use pulvis_core::{GroupMotion, Particles, Simulation};
use pulvis_input::Problem;
use pulvis_input::scenario::{GroupPlan, Scenario, Stage};

use super::error::{PrepareError, RunError};

/// The ids of the particles to which the criteria of a group apply now.
fn members(plan: &GroupPlan, particles: &Particles, domain: &pulvis_core::Domain) -> Vec<u32> {
    let rows = 0..particles.len();
    let taken = rows.filter(|&row| {
        let material = usize::from(particles.materials()[row]);
        plan.takes_in(particles.ids()[row], material)
            && plan.region.as_ref().is_none_or(|region| region.contains(particles.positions()[row], domain))
    });
    taken.map(|row| particles.ids()[row]).collect()
}

/// Refuses groups that the first stage names and that nobody belongs to.
pub(super) fn check_groups(scenario: &Scenario, simulation: &Simulation) -> Result<(), PrepareError> {
    let Some(first) = scenario.stages.first().filter(|stage| stage.remove.is_none()) else { return Ok(()) };
    for (index, control) in &first.groups {
        let plan = &scenario.groups[*index];
        let is_gathered = control.regather || simulation.group(&plan.name).is_none();
        if is_gathered && members(plan, simulation.particles(), simulation.domain()).is_empty() {
            let problem = Problem::rule(
                "no particle belongs to it at the start of the first stage",
                "one particle at least that all its criteria apply to",
            );
            let path = format!("groups.{}", plan.name);
            let help = "a region holds centres, not surfaces; `pulvis render` shows where particles are";
            return Err(scenario.mistake(&[&path], problem, help).into());
        }
    }
    Ok(())
}

/// Does with groups what a stage says. `arrive`: motions with an end have come to it.
pub(super) fn switch_groups(
    simulation: &mut Simulation,
    scenario: &Scenario,
    stage: &Stage,
    arrive: bool,
) -> Result<(), RunError> {
    let failed = |source| RunError::Switch { stage: stage.name.clone(), source };
    let is_named = |name: &str| stage.groups.iter().any(|(index, _)| scenario.groups[*index].name == name);
    let arrived = simulation.groups().iter().filter(|group| arrive && group.motion().duration().is_some());
    let arrived: Vec<String> =
        arrived.map(|group| group.name().to_owned()).filter(|name| !is_named(name)).collect();
    for name in arrived {
        simulation.set_group_motion(&name, GroupMotion::Fixed).map_err(failed)?;
    }
    // Who becomes free can belong to a group that is held from now on.
    let (held, free): (Vec<_>, Vec<_>) =
        stage.groups.iter().copied().partition(|(_, control)| control.motion.is_prescribed());
    for (index, control) in free.into_iter().chain(held) {
        let plan = &scenario.groups[index];
        if control.regather || simulation.group(&plan.name).is_none() {
            let ids = members(plan, simulation.particles(), simulation.domain());
            if ids.is_empty() {
                return Err(RunError::EmptyGroup { stage: stage.name.clone(), group: plan.name.clone() });
            }
            simulation.set_group(&plan.name, &ids).map_err(failed)?;
        }
        simulation.set_group_motion(&plan.name, control.motion).map_err(failed)?;
    }
    Ok(())
}

/// The columns of a group, before its name.
const COLUMNS: [&str; 8] =
    ["members", "force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z", "work"];

/// The names of all columns of groups.
pub(super) fn columns(scenario: &Scenario) -> impl Iterator<Item = String> + '_ {
    scenario.groups.iter().flat_map(|group| COLUMNS.map(|column| format!("{column}_{}", group.name)))
}

/// Their values: number of particles, force [N] and torque [N m] of everything else on them, work that has led them [J]. NaN
/// before the group has been gathered.
pub(super) fn values(scenario: &Scenario, simulation: &Simulation) -> Vec<f64> {
    let of_group = |plan: &GroupPlan| match simulation.group(&plan.name) {
        None => [f64::NAN; 8],
        Some(group) => {
            let load = simulation.group_load(group);
            let ([fx, fy, fz], [tx, ty, tz]) = (load.force.to_array(), load.torque.to_array());
            [group.ids().len() as f64, fx, fy, fz, tx, ty, tz, group.work()]
        }
    };
    scenario.groups.iter().flat_map(of_group).collect()
}
