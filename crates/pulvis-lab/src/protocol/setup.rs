//! From a scenario to a simulation that is ready to run.

use pulvis_core::walls::{Extent, FaceArea, Wall};
use pulvis_core::{
    Background, CellMotion, ContactPartner, Domain, Interactions, MaterialIndex, MotionKind, Particle, Setup,
    ShortestMotion, Simulation, shortest_motion, shortest_motion_of_charges,
};
use pulvis_input::scenario::{Contact, Refusal, Scenario, Side, TimeStep, Wall as WallPlan, WallControl};

use pulvis_input::Problem;

use super::allow::{limits, refuse_unless_allowed};
use super::cell::check_cell;
use super::checkpoint::Ancestor;
use super::damping::refuse_overdamped;
use super::error::PrepareError;
use super::feasible::check_feasible;
use super::groups::check_groups;
use super::memory::refuse_too_many;
use super::openings::{OpeningsRecord, charges_of, check_openings, sample_of_inlets};
use super::particles::{columns, generate};
use super::programs::program_plans;
use super::refusal::refuse_setup;
use super::start::branch;
use super::steady::check_steady;

/// A simulation before its first step, and what its stages will need.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The simulation, at rest at time zero.
    pub simulation: Simulation,
    /// What each stage switches to.
    pub stages: Vec<StagePlan>,
    /// The particles as they start, by id.
    pub particles: Vec<Particle>,
    /// The same, and spheres that stand for those that inlets bring.
    pub(super) sample: Vec<Particle>,
    /// What was before.
    pub(super) origin: Origin,
}

/// Where a simulation comes from.
#[derive(Clone, Debug)]
pub(super) struct Origin {
    /// The runs before, the oldest first.
    pub(super) ancestors: Vec<Ancestor>,
    /// The contact models that the simulation has now.
    pub(super) interactions: Interactions,
    /// Whether the stage before the first one has ended.
    pub(super) stage_ended: bool,
    /// What inlets and outlets have seen.
    pub(super) openings: Option<OpeningsRecord>,
}

/// What holds during a stage.
#[derive(Clone, Debug)]
pub struct StagePlan {
    /// Contact models.
    pub interactions: Interactions,
    /// Gravity and drag.
    pub background: Background,
    /// Time step [s].
    pub time_step: f64,
    /// The shortest motion that the stage can have; `None` where nothing can meet and nothing is slowed down.
    pub shortest: Option<ShortestMotion>,
    /// Walls that are there.
    pub walls_present: Vec<bool>,
    /// What the stage changes of walls: place and control.
    pub wall_changes: Vec<(usize, WallControl)>,
    /// What holds after each update of its programs, that of the start first; nothing where there are none.
    pub programs: Vec<(Interactions, Background)>,
}

/// Builds the simulation of a scenario and checks what only its particles can tell.
pub fn prepare(scenario: &Scenario) -> Result<Prepared, PrepareError> {
    if let Some(start) = &scenario.start_from {
        return branch(scenario, start);
    }
    // Before anything is allocated for them.
    refuse_too_many(scenario)?;
    check_materials(scenario)?;
    let domain = scenario.domain.unwrap_or(Domain::unbounded());
    let particles = generate(scenario, &domain)?;
    let walls = drawn_walls(scenario);
    check_start(scenario, &particles, &walls)?;
    check_openings(scenario, &walls)?;
    let sample = [&particles[..], &sample_of_inlets(scenario)].concat();
    let columns = columns(scenario);
    let stages = stages(scenario, (&sample, &charges_of(scenario, &columns)), &walls)?;
    let first = &stages[0];
    let setup = Setup {
        particles: particles.clone(),
        interactions: first.interactions.clone(),
        walls: walls.clone(),
        domain,
        background: first.background,
        time_step: first.time_step,
    };
    let refused = |error| refuse_setup(scenario, &error);
    let mut simulation = Simulation::with_columns(setup, columns).map_err(refused)?;
    simulation.set_temperature(scenario.temperature.clone());
    simulation.set_limits(limits(scenario));
    check_overlaps(scenario, &simulation)?;
    refuse_overdamped(scenario, &sample)?;
    check_feasible(scenario, &sample, &walls, &stages)?;
    check_cell(scenario, &particles, &stages, &CellMotion::default())?;
    check_groups(scenario, &simulation)?;
    check_steady(scenario, &stages)?;
    let origin = Origin {
        ancestors: Vec::new(),
        interactions: first.interactions.clone(),
        stage_ended: true,
        openings: None,
    };
    Ok(Prepared { simulation, stages, particles, sample, origin })
}

/// Refuses more materials than the engine can number; every index fits from here on.
fn check_materials(scenario: &Scenario) -> Result<(), PrepareError> {
    let (found, most) = (scenario.materials.len(), usize::from(MaterialIndex::MAX) + 1);
    if found <= most {
        return Ok(());
    }
    let problem = Problem::rule(format!("{found} materials"), format!("at most {most}"));
    Err(scenario.mistake(&["materials"], problem, "remove materials that nothing is made of").into())
}

pub(super) fn stages(
    scenario: &Scenario,
    (particles, charges): (&[Particle], &[f64]),
    walls: &[Wall],
) -> Result<Vec<StagePlan>, PrepareError> {
    let mut walls = walls.to_vec();
    let of_charges = scenario
        .electrostatics
        .and_then(|electrostatics| shortest_motion_of_charges(particles, charges, &electrostatics));
    let grows = !scenario.inlets.is_empty();
    let mut plans = Vec::with_capacity(scenario.stages.len());
    for (number, stage) in scenario.stages.iter().enumerate() {
        let wall_changes: Vec<(usize, WallControl)> = stage.controls.clone();
        for (place, control) in &wall_changes {
            walls[*place].present &= !matches!(control, WallControl::Removed);
            walls[*place].motion = control.motion().unwrap_or_default();
        }
        let interactions = interactions(scenario, &stage.contacts);
        let programs = program_plans(scenario, stage);
        // Faces count as they were drawn: where walls move apart, the bound on contacts has room for more.
        let start = std::iter::once((&interactions, &stage.background));
        let states = start.chain(programs.iter().skip(1).map(|(models, background)| (models, background)));
        let shortest = states
            .filter_map(|(models, background)| shortest_motion(particles, models, &walls, background, grows))
            .chain(of_charges)
            .min_by(|one, other| one.duration.total_cmp(&other.duration));
        let time_step = time_step(scenario, stage.time, shortest, number)?;
        plans.push(StagePlan {
            interactions,
            background: stage.background,
            time_step,
            shortest,
            walls_present: walls.iter().map(|wall| wall.present).collect(),
            wall_changes,
            programs,
        });
    }
    Ok(plans)
}

pub(super) fn interactions(scenario: &Scenario, contacts: &[Contact]) -> Interactions {
    let mut interactions = Interactions::new(scenario.materials.len());
    interactions.set_electrostatics(scenario.electrostatics);
    for contact in contacts {
        let [one, other] = contact.materials;
        interactions.set(one as MaterialIndex, other as MaterialIndex, contact.model);
    }
    interactions
}

/// The step of a stage: a fraction of the shortest motion, or a given one that is short enough.
fn time_step(
    scenario: &Scenario,
    plan: TimeStep,
    shortest: Option<ShortestMotion>,
    stage: usize,
) -> Result<f64, PrepareError> {
    let duration = shortest.map_or(f64::INFINITY, |shortest| shortest.duration);
    let (step, problem, help) = match plan {
        // The engine refuses a step that is zero or infinite.
        TimeStep::Auto { steps_per_contact_time } => return Ok(duration / steps_per_contact_time),
        TimeStep::Fixed(step) if step * TimeStep::LEAST_STEPS <= duration => return Ok(step),
        TimeStep::Fixed(step) => {
            let least = TimeStep::LEAST_STEPS;
            let (kind, whose) = shortest.map_or(("contact", String::new()), |shortest| match shortest.kind {
                MotionKind::Contact(_) => ("contact", describe_motion(scenario, &shortest)),
                _ => ("motion", describe_motion(scenario, &shortest)),
            });
            let found = format!(
                "{step:e} s is longer than 1/{least} of the shortest {kind} ({duration:.4e} s, {whose})"
            );
            let help = match shortest.map(|shortest| shortest.kind) {
                Some(MotionKind::WallOnContacts { .. }) => "take \"auto\", or a heavier wall",
                Some(MotionKind::WallDamping { .. }) => "take \"auto\", or less damping, or a heavier wall",
                Some(MotionKind::Drag | MotionKind::RotationalDrag) => "take \"auto\", or less drag",
                Some(MotionKind::Charges) => "take \"auto\", or smaller charges",
                _ => "take \"auto\", or soften the contact",
            };
            (step, Problem::rule(found, format!("at most {:.4e} s", duration / least)), help)
        }
    };
    // A stage without a step of its own goes on with the one before.
    let own = (0..=stage).rev().map(|stage| format!("stages[{stage}].time.step"));
    let paths: Vec<String> = own.chain(["time.step".to_owned()]).collect();
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    refuse_unless_allowed(scenario, Refusal::TimeStep, &paths, problem, help)?;
    Ok(step)
}

/// Whose motion it is, in words: the materials of a contact, a wall, or the drag.
pub fn describe_motion(scenario: &Scenario, shortest: &ShortestMotion) -> String {
    let name = |index: MaterialIndex| scenario.materials[usize::from(index)].name.as_str();
    let wall_name = |index: usize| scenario.walls.get(index).map_or("", |wall| wall.name.as_str());
    match shortest.kind {
        MotionKind::Contact(contact) => {
            let wall = if contact.at_wall { " wall" } else { "" };
            format!("{}-{}{wall}", name(contact.material), name(contact.partner))
        }
        MotionKind::WallOnContacts { wall, contacts } => {
            format!("the mass of the servo wall {} on up to {contacts:.0} contacts", wall_name(wall))
        }
        MotionKind::WallDamping { wall } => format!("the damping of the servo wall {}", wall_name(wall)),
        MotionKind::Drag => "the drag of the background on the lightest particle".to_owned(),
        MotionKind::RotationalDrag => {
            "the rotational drag of the background on the lightest particle".to_owned()
        }
        MotionKind::Charges => "two charges that touch".to_owned(),
        _ => "another motion".to_owned(),
    }
}

/// All walls as the scenario draws them, at rest.
pub(super) fn drawn_walls(scenario: &Scenario) -> Vec<Wall> {
    scenario.walls.iter().map(|plan| wall(scenario, plan)).collect()
}

fn wall(scenario: &Scenario, plan: &WallPlan) -> Wall {
    let mut wall = Wall::of_shape(&plan.name, plan.material as MaterialIndex, plan.point, plan.shape.clone());
    wall.area = match (plan.area, plan.face) {
        (Some(area), _) => FaceArea::Given(area),
        (None, Some(face)) => {
            let axis = face.axis.index();
            let extents = [(axis + 1) % 3, (axis + 2) % 3].map(|across| extent(scenario, across));
            match extents {
                [Some(one), Some(other)] => FaceArea::Product([one, other]),
                _ => FaceArea::Unknown,
            }
        }
        (None, None) => FaceArea::Unknown,
    };
    wall
}

/// How far the sample ranges along an axis: a period, the distance of two box walls, or the box as
/// it was drawn where a face is open.
pub(super) fn extent(scenario: &Scenario, axis: usize) -> Option<Extent> {
    if let Some(domain) = &scenario.domain
        && domain.periodic[axis]
    {
        return Some(Extent::Given(domain.extent.size()[axis]));
    }
    let [low, high] = box_walls(scenario, axis);
    if let (Some(low), Some(high)) = (low, high) {
        return Some(Extent::Between(low, high));
    }
    scenario.enclosure.map(|enclosure| Extent::Given(enclosure.size()[axis]))
}

/// The places of the two box walls of an axis: low, high.
pub(super) fn box_walls(scenario: &Scenario, axis: usize) -> [Option<usize>; 2] {
    [Side::Low, Side::High].map(|side| {
        scenario
            .walls
            .iter()
            .position(|wall| wall.face.is_some_and(|face| face.axis.index() == axis && face.side == side))
    })
}

/// Refuses particles whose centres lie behind a wall.
fn check_start(scenario: &Scenario, particles: &[Particle], walls: &[Wall]) -> Result<(), PrepareError> {
    for (id, particle) in particles.iter().enumerate() {
        for (wall, plan) in walls.iter().zip(&scenario.walls) {
            let depth = -wall.distance(particle.position);
            if depth >= 0.0 {
                let [x, y, z] = particle.position.to_array();
                let name = &wall.name;
                let found = format!(
                    "particle {id} at ({x:.4e}, {y:.4e}, {z:.4e}) m is {depth:.3e} m behind wall `{name}`"
                );
                let problem = Problem::rule(found, plan.where_particles_are());
                let path = format!("{}.arrangement", group_path(scenario, id));
                return Err(scenario.mistake(&[&path], problem, "move the arrangement or the wall").into());
            }
        }
    }
    Ok(())
}

/// The path of the group that a particle belongs to.
pub(super) fn group_path(scenario: &Scenario, id: usize) -> String {
    let mut first = 0;
    for (place, group) in scenario.particles.iter().enumerate() {
        first += group.count;
        if id < first {
            return format!("particles[{place}]");
        }
    }
    "particles".to_owned()
}

/// Refuses overlaps of more than a tenth of the smaller radius at the start: the elastic energy in them would
/// blow the sample up.
fn check_overlaps(scenario: &Scenario, simulation: &Simulation) -> Result<(), PrepareError> {
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    let radius = |id: u32| particles.radii()[rows[id as usize]];
    let mut deepest: Option<(f64, usize, String)> = None;
    simulation.for_each_contact(&mut |contact| {
        let smaller = match contact.second {
            ContactPartner::Particle(other) => radius(contact.first).min(radius(other)),
            ContactPartner::Wall(_) => radius(contact.first),
        };
        let relative = contact.overlap / smaller;
        if relative > 0.1 && deepest.as_ref().is_none_or(|(depth, ..)| relative > *depth) {
            let partner = match contact.second {
                ContactPartner::Particle(id) => format!("particle {id}"),
                ContactPartner::Wall(place) => format!("wall `{}`", simulation.walls()[place].name),
            };
            deepest = Some((relative, contact.first as usize, partner));
        }
    });
    let Some((relative, id, partner)) = deepest else { return Ok(()) };
    let found = format!(
        "particle {id} overlaps {partner} by {:.0} % of the smaller radius at the start",
        100.0 * relative
    );
    let problem = Problem::rule(found, "at most 10 %");
    let path = format!("{}.arrangement", group_path(scenario, id));
    let help = "enlarge the spacing or the region";
    refuse_unless_allowed(scenario, Refusal::Overlap, &[&path], problem, help)
}
