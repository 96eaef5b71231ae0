//! Simulations that start from a checkpoint: of the same run, or of another one.

use pulvis_core::walls::Wall;
use pulvis_core::{Domain, NamedColumn, Particle, Simulation, State};
use pulvis_input::scenario::{Scenario, Stage, StartFrom, WallControl};
use pulvis_input::{Document, InputErrors, Problem, Replacement};
use pulvis_io::vtk::Frame;
use std::path::{Path, PathBuf};

use super::allow::limits;
use super::cell::check_cell;
use super::checkpoint::{
    Ancestor, Checkpoint, FindError, Found, LedWall, RunRecord, find, of_run, read_particles,
    scenario_from_text,
};
use super::damping::refuse_overdamped;
use super::ending::Ending;
use super::error::PrepareError;
use super::feasible::{check_feasible, start_stage};
use super::frame::frame_of;
use super::groups::check_groups;
use super::openings::{charges_of, check_openings, sample_of_inlets};
use super::particles::generate;
use super::programs::{models_after, program_plans};
use super::run::StageResult;
use super::setup::{Origin, Prepared, StagePlan, drawn_walls, interactions, stages};
use super::steady::check_steady;

/// An interrupted run that can go on.
pub(super) struct Resumed {
    pub(super) simulation: Simulation,
    pub(super) plans: Vec<StagePlan>,
    pub(super) ancestors: Vec<Ancestor>,
    pub(super) record: RunRecord,
    pub(super) results: Vec<StageResult>,
}

/// The simulation of a checkpoint of this very scenario.
pub(super) fn resumed(scenario: &Scenario, found: Found) -> Result<Resumed, PrepareError> {
    let Found { path, checkpoint } = found;
    let misfit = |problem: String| PrepareError::Misfit { file: path.clone(), problem };
    let (record, ancestors) = (checkpoint.run.clone(), checkpoint.ancestors.clone());
    let stage = record.stage();
    if record.time_steps.len() != scenario.stages.len() || stage >= scenario.stages.len() {
        return Err(misfit("it has other stages".to_owned()));
    }
    let plans = resumed_plans(scenario, &record.time_steps, walls_after(scenario, &ancestors)?);
    let mut walls = walls_in_stage(scenario, &ancestors, &scenario.stages[..=stage])?;
    put_led(&record.led_walls, &mut walls).map_err(|problem| misfit(problem.to_owned()))?;
    let state: State = checkpoint.into_state().map_err(|problem| misfit(problem.to_owned()))?;
    let results = record.results.iter().zip(&scenario.stages).map(|(result, stage)| {
        let ending = Ending::from_number(result.ending);
        ending.map(|ending| StageResult {
            name: stage.name.clone(),
            ending,
            time: result.time,
            steps: result.steps,
        })
    });
    let results =
        results.collect::<Option<_>>().ok_or_else(|| misfit("it knows another end of a stage".to_owned()))?;
    let models = models_after(scenario, &scenario.stages[stage], record.update as usize);
    let mut simulation =
        Simulation::import_state(models, walls, &state).map_err(|error| misfit(error.to_string()))?;
    simulation.set_limits(limits(scenario));
    Ok(Resumed { simulation, plans, ancestors, record, results })
}

/// What stages switch to, with the time steps that they had before the interruption.
fn resumed_plans(scenario: &Scenario, time_steps: &[f64], mut walls: Vec<Wall>) -> Vec<StagePlan> {
    let plan = |(stage, &time_step): (&Stage, &f64)| {
        start_stage(walls.iter_mut(), stage);
        StagePlan {
            interactions: interactions(scenario, &stage.contacts),
            background: stage.background,
            time_step,
            shortest: None,
            walls_present: walls.iter().map(|wall| wall.present).collect(),
            wall_changes: stage.controls.clone(),
            programs: program_plans(scenario, stage),
        }
    };
    scenario.stages.iter().zip(time_steps).map(plan).collect()
}

/// The walls of a scenario as its ancestors have left them.
fn walls_after(scenario: &Scenario, ancestors: &[Ancestor]) -> Result<Vec<Wall>, PrepareError> {
    let mut walls = drawn_walls(scenario);
    let mut ended = true;
    for Ancestor { scenario, stage, stage_ended, led_walls } in ancestors {
        let ancestor = scenario_from_text("the scenario of an earlier run", scenario)?;
        let begun = &ancestor.stages[..(*stage as usize + 1).min(ancestor.stages.len())];
        enter_stages(&mut walls, begun, ended);
        put_led(led_walls, &mut walls).map_err(|problem| PrepareError::Misfit {
            file: PathBuf::from("the checkpoint of an earlier run"),
            problem: problem.to_owned(),
        })?;
        ended = *stage_ended;
    }
    Ok(walls)
}

/// Walls that a program had in hand are as it has left them.
fn put_led(led: &[LedWall], walls: &mut [Wall]) -> Result<(), &'static str> {
    led.iter().try_for_each(|led| led.put_into(walls))
}

/// The walls of a scenario in the last of these stages of a run.
fn walls_in_stage(
    scenario: &Scenario,
    ancestors: &[Ancestor],
    stages: &[Stage],
) -> Result<Vec<Wall>, PrepareError> {
    let mut walls = walls_after(scenario, ancestors)?;
    enter_stages(&mut walls, stages, ancestors.last().is_none_or(|ancestor| ancestor.stage_ended));
    Ok(walls)
}

/// The state in a checkpoint file as a frame, with its scenario and time [s].
pub(crate) fn frame_of_checkpoint(file: &Path) -> Result<(Scenario, Domain, f64, Frame), PrepareError> {
    let found = find(file)?.ok_or_else(|| FindError::None(file.to_owned()))?;
    let checkpoint = found.checkpoint;
    let (scenario, stage) = parent(&checkpoint)?;
    let mut walls = walls_in_stage(&scenario, &checkpoint.ancestors, &scenario.stages[..=stage])?;
    let models = models_after(&scenario, &scenario.stages[stage], checkpoint.run.update as usize);
    let misfit = |problem: String| PrepareError::Misfit { file: file.to_owned(), problem };
    put_led(&checkpoint.run.led_walls, &mut walls).map_err(|problem| misfit(problem.to_owned()))?;
    let state: State = checkpoint.into_state().map_err(|problem| misfit(problem.to_owned()))?;
    let simulation =
        Simulation::import_state(models, walls, &state).map_err(|error| misfit(error.to_string()))?;
    let frame = frame_of(&scenario, &simulation);
    Ok((scenario, *simulation.domain(), simulation.time(), frame))
}

/// Walls go through the starts of stages. Where the stage before the first one goes on, so do motions that have an end.
fn enter_stages(walls: &mut [Wall], stages: &[Stage], mut ended: bool) {
    for stage in stages {
        let before: Vec<Wall> = walls.to_vec();
        start_stage(walls.iter_mut(), stage);
        let is_controlled = |place: usize| stage.controls.iter().any(|(wall, _)| *wall == place);
        for (place, wall) in
            walls.iter_mut().enumerate().filter(|(place, _)| !ended && !is_controlled(*place))
        {
            wall.motion = before[place].motion;
        }
        ended = true;
    }
}

/// Reads a scenario file, with values replaced as `--set` does it. What a scenario with `start_from` does not say, it has from
/// the run that it starts from, as it holds there in the stage of the checkpoint.
///
/// # Errors
/// All mistakes of the file, or its checkpoint cannot be used.
pub fn load_scenario(path: &Path, set: &[(String, Replacement)]) -> Result<Scenario, PrepareError> {
    read_scenario(Document::load(path)?, Some(path), set)
}

/// As [`load_scenario`], from a parsed file that stands at `path`, or from a text that is in no file: then paths in it are
/// relative to the current folder.
///
/// # Errors
/// As of [`load_scenario`].
pub fn read_scenario(
    document: Document,
    path: Option<&Path>,
    set: &[(String, Replacement)],
) -> Result<Scenario, PrepareError> {
    Ok(Scenario::from_document(&with_start(document, path)?.with_overrides(set)?, path)?)
}

/// Reads a scenario file as [`load_scenario`] does, up to the replacing of values.
///
/// # Errors
/// The file is no TOML, or its checkpoint cannot be used.
pub fn load_document(path: &Path) -> Result<Document, InputErrors> {
    with_start(Document::load(path)?, Some(path))
}

/// Gives a document that starts from a run what it does not say.
fn with_start(mut document: Document, path: Option<&Path>) -> Result<Document, InputErrors> {
    let folder = path.and_then(Path::parent).unwrap_or(Path::new(""));
    if let Some((start, place)) = document.start_from(folder)? {
        let refused = |error| document.error_at(&place, Problem::Refused(Box::new(error)));
        let Found { checkpoint, .. } = of_run(&start).map_err(refused)?;
        let (parent, stage) = parent(&checkpoint)?;
        // Programs of a stage that has not ended stand where they stood.
        let update = checkpoint.run.watch.is_some().then_some(checkpoint.run.update as usize);
        let base = Document::from_str("the run", &parent.as_in_stage(stage, update).to_resolved_toml(""))?;
        document =
            document.with_missing_from(&base, &["title", "start_from", "allow", "stages", "output"], &place);
    }
    Ok(document.with_checkpoint_reader(read_particles))
}

/// Whether two scenarios that differ by their seeds start with the same particles: then their runs are the same.
///
/// # Errors
/// The particles cannot be made.
pub(crate) fn start_alike(one: &Scenario, other: &Scenario) -> Result<bool, PrepareError> {
    // Inlets draw from streams of the seed, unless they have seeds of their own.
    if one.inlets.iter().any(|inlet| inlet.seed.is_none()) {
        return Ok(false);
    }
    if one.start_from.is_some() {
        return Ok(true);
    }
    let [first, second] =
        [one, other].map(|scenario| generate(scenario, &scenario.domain.unwrap_or(Domain::unbounded())));
    Ok(first? == second?)
}

/// The scenario of a checkpoint, and the stage in it.
fn parent(checkpoint: &Checkpoint) -> Result<(Scenario, usize), InputErrors> {
    let scenario = scenario_from_text("the scenario of the checkpoint", &checkpoint.scenario)?;
    let last = scenario.stages.len() - 1;
    Ok((scenario, checkpoint.run.stage().min(last)))
}

/// Builds the simulation of a scenario that starts from a checkpoint.
pub(super) fn branch(scenario: &Scenario, start: &StartFrom) -> Result<Prepared, PrepareError> {
    let refused =
        |problem: Problem, help: &str| PrepareError::from(scenario.mistake(&["start_from"], problem, help));
    let found = of_run(start)
        .map_err(|error| refused(Problem::Refused(Box::new(error)), "name another checkpoint"))?;
    let checkpoint = found.checkpoint;
    let (parent, stage) = parent(&checkpoint)?;
    same_system(scenario, &parent)?;
    let mut ancestors = checkpoint.ancestors.clone();
    let stage_ended = checkpoint.run.watch.is_none();
    let openings = Some(checkpoint.run.openings.clone());
    let mut walls = walls_in_stage(scenario, &ancestors, &parent.stages[..=stage])?;
    let led_walls = checkpoint.run.led_walls.clone();
    put_led(&led_walls, &mut walls).map_err(|problem| {
        refused(Problem::rule(problem, "a checkpoint of this program"), "name another checkpoint")
    })?;
    ancestors.push(Ancestor {
        scenario: checkpoint.scenario.clone(),
        stage: stage as u32,
        stage_ended,
        led_walls,
    });
    let models = models_after(&parent, &parent.stages[stage], checkpoint.run.update as usize);
    let unfit = |problem: String| {
        refused(Problem::rule(problem, "a checkpoint of the same system"), "name another checkpoint")
    };
    let state: State = checkpoint.into_state().map_err(|problem| unfit(problem.to_owned()))?;
    let particles = particles_of(&state);
    check_controls(scenario, &walls)?;
    check_openings(scenario, &walls)?;
    let sample = [&particles[..], &sample_of_inlets(scenario)].concat();
    let charges = charges_of(scenario, &columns_of(&state));
    let stages = stages(scenario, (&sample, &charges), &walls)?;
    let mut simulation =
        Simulation::import_state(models.clone(), walls, &state).map_err(|error| unfit(error.to_string()))?;
    simulation.set_temperature(scenario.temperature.clone());
    simulation.set_limits(limits(scenario));
    refuse_overdamped(scenario, &sample)?;
    check_feasible(scenario, &sample, simulation.walls(), &stages)?;
    check_cell(scenario, &particles, &stages, simulation.cell_motion())?;
    check_groups(scenario, &simulation)?;
    check_steady(scenario, &stages)?;
    let origin = Origin { ancestors, interactions: models, stage_ended, openings };
    Ok(Prepared { simulation, stages, particles, sample, origin })
}

/// Refuses scenarios of other walls, materials or directions that repeat: the state means nothing there.
fn same_system(scenario: &Scenario, parent: &Scenario) -> Result<(), PrepareError> {
    let names = |scenario: &Scenario| {
        scenario.materials.iter().map(|material| material.name.clone()).collect::<Vec<_>>().join(", ")
    };
    let walls = |scenario: &Scenario| {
        let walls = scenario
            .walls
            .iter()
            .map(|wall| format!("{} of {}", wall.name, scenario.materials[wall.material].name));
        walls.collect::<Vec<_>>().join(", ")
    };
    let differs = |path: &str, found: String, expected: String| {
        let problem = Problem::rule(found, expected);
        let help = "leave the table out: what is not said is as in the run that `start_from` names";
        Err(scenario.mistake(&[path, "start_from"], problem, help).into())
    };
    if names(scenario) != names(parent) {
        return differs("materials", names(scenario), format!("those of the run: {}", names(parent)));
    }
    if walls(scenario) != walls(parent) {
        return differs(
            "box",
            format!("the walls {}", walls(scenario)),
            format!("those of the run: {}", walls(parent)),
        );
    }
    let same_shapes =
        scenario.walls.iter().zip(&parent.walls).all(|(wall, other)| {
            (&wall.shape, wall.area, wall.face) == (&other.shape, other.area, other.face)
        });
    if !same_shapes || scenario.enclosure != parent.enclosure {
        let found = "the walls have other shapes, sizes or areas".to_owned();
        return differs("box", found, "those of the run".to_owned());
    }
    if scenario.domain != parent.domain {
        let found = "the domain is another one".to_owned();
        return differs("domain", found, "that of the run".to_owned());
    }
    Ok(())
}

/// Refuses stages that control a wall which the run before has removed.
fn check_controls(scenario: &Scenario, walls: &[Wall]) -> Result<(), PrepareError> {
    for (number, stage) in scenario.stages.iter().enumerate() {
        let gone = |(place, _): &&(usize, WallControl)| !walls[*place].present;
        if let Some((place, _)) = stage.controls.iter().find(gone) {
            let name = &walls[*place].name;
            let found = format!("the wall {name} was removed in the run before");
            let problem = Problem::rule(found, "a wall that is still there");
            let path = format!("stages[{number}].walls.{name}");
            return Err(scenario.mistake(&[&path], problem, "leave it out").into());
        }
    }
    Ok(())
}

/// The particles of a state, by id.
fn particles_of(state: &State) -> Vec<Particle> {
    let columns = &state.particles;
    let mut rows: Vec<usize> = (0..columns.id.len()).collect();
    rows.sort_unstable_by_key(|&row| columns.id[row]);
    let particle = |row: usize| Particle {
        material: columns.material[row],
        radius: columns.radius[row],
        mass: columns.mass[row],
        position: columns.position[row].into(),
        velocity: columns.velocity[row].into(),
        angular_velocity: columns.angular_velocity[row].into(),
    };
    rows.into_iter().map(particle).collect()
}

/// Their further quantities, by id.
fn columns_of(state: &State) -> Vec<NamedColumn> {
    let particles = &state.particles;
    let mut rows: Vec<usize> = (0..particles.id.len()).collect();
    rows.sort_unstable_by_key(|&row| particles.id[row]);
    let by_id = |column: &NamedColumn| NamedColumn {
        values: rows.iter().map(|&row| column.values[row]).collect(),
        ..column.clone()
    };
    particles.columns.iter().map(by_id).collect()
}
