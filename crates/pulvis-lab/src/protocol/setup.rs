//! From a scenario to a simulation that is ready to run.

use pulvis_core::walls::{Cosine, Extent, FaceArea, PressureRamp, Servo, Velocity, Wall, WallMotion};
use pulvis_core::{
    Background, ContactPartner, Domain, Interactions, MaterialIndex, Particle, Setup, ShortestContact, Simulation,
    shortest_contact,
};
use pulvis_input::scenario::{
    Contact, Scenario, Side, TimeStep, Wall as WallPlan, WallControl,
};

use super::error::PrepareError;
use super::particles::generate;

/// A simulation before its first step, and what its stages will need.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The simulation, at rest at time zero.
    pub simulation: Simulation,
    /// What each stage switches to.
    pub stages: Vec<StagePlan>,
    /// The particles as they start, by id.
    pub particles: Vec<Particle>,
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
    /// The shortest contact that the stage can have; `None` where nothing can meet.
    pub shortest: Option<ShortestContact>,
    /// Walls that are there.
    pub walls_present: Vec<bool>,
    /// What the stage changes of walls: place and control.
    pub wall_changes: Vec<(usize, WallControl)>,
}

/// Builds the simulation of a scenario and checks what only its particles can tell.
pub fn prepare(scenario: &Scenario) -> Result<Prepared, PrepareError> {
    let file = &scenario.source.name;
    let domain = domain(scenario);
    let particles = generate(scenario, &domain)?;
    let walls: Vec<Wall> =
        scenario.walls.iter().map(|plan| wall(scenario, plan)).collect();
    check_start(scenario, &particles, &walls)?;
    let stages = stages(scenario, &particles, &walls)?;
    let first = &stages[0];
    let setup = Setup {
        particles: particles.clone(),
        interactions: first.interactions.clone(),
        walls,
        domain,
        background: first.background,
        time_step: first.time_step,
    };
    let simulation =
        Simulation::new(setup).map_err(|source| PrepareError::Setup { file: file.clone(), source })?;
    check_overlaps(scenario, &simulation)?;
    Ok(Prepared { simulation, stages, particles })
}

fn domain(scenario: &Scenario) -> Domain {
    match &scenario.domain {
        None => Domain::unbounded(),
        Some(plan) => Domain::periodic(plan.extent.lower, plan.extent.upper, plan.periodic),
    }
}

fn stages(
    scenario: &Scenario,
    particles: &[Particle],
    walls: &[Wall],
) -> Result<Vec<StagePlan>, PrepareError> {
    let mut walls = walls.to_vec();
    let mut plans = Vec::with_capacity(scenario.stages.len());
    for (number, stage) in scenario.stages.iter().enumerate() {
        let wall_changes: Vec<(usize, WallControl)> = stage.controls.clone();
        for (place, control) in &wall_changes {
            walls[*place].present &= !matches!(control, WallControl::Removed);
        }
        let interactions = interactions(scenario, &stage.contacts);
        let shortest = shortest_contact(particles, &interactions, &walls);
        let time_step = time_step(scenario, stage.time, shortest, number)?;
        plans.push(StagePlan {
            interactions,
            background: Background {
                gravity: stage.gravity,
                drag: stage.background.drag,
                rotational_drag: stage.background.rotational_drag,
            },
            time_step,
            shortest,
            walls_present: walls.iter().map(|wall| wall.present).collect(),
            wall_changes,
        });
    }
    Ok(plans)
}

fn interactions(scenario: &Scenario, contacts: &[Contact]) -> Interactions {
    let mut interactions = Interactions::new(scenario.materials.len());
    for contact in contacts {
        let [one, other] = contact.materials;
        interactions.set(one as MaterialIndex, other as MaterialIndex, contact.model);
    }
    interactions
}

/// The step of a stage: a fraction of the shortest contact, or a given one that is short enough.
fn time_step(
    scenario: &Scenario,
    plan: TimeStep,
    shortest: Option<ShortestContact>,
    stage: usize,
) -> Result<f64, PrepareError> {
    let contact = shortest.map_or(f64::INFINITY, |shortest| shortest.duration);
    match plan {
        TimeStep::Auto { steps_per_contact_time } => Ok(contact / steps_per_contact_time),
        TimeStep::Fixed(step) if step * TimeStep::LEAST_STEPS <= contact => Ok(step),
        TimeStep::Fixed(step) => Err(PrepareError::TimeStepTooLong {
            file: scenario.source.name.clone(),
            key: format!("time.step in stage `{}`", scenario.stages[stage].name),
            step,
            contact,
            between: shortest.map_or_else(String::new, |shortest| between(scenario, &shortest)),
            least: TimeStep::LEAST_STEPS,
            longest: contact / TimeStep::LEAST_STEPS,
        }),
    }
}

/// Which materials a contact is between, in words.
pub fn between(scenario: &Scenario, contact: &ShortestContact) -> String {
    let name = |index: MaterialIndex| scenario.materials[usize::from(index)].name.as_str();
    let wall = if contact.at_wall { " wall" } else { "" };
    format!("{}-{}{wall}", name(contact.material), name(contact.partner))
}

fn wall(scenario: &Scenario, plan: &WallPlan) -> Wall {
    let mut wall =
        Wall::fixed(&plan.name, plan.material as MaterialIndex, plan.point, plan.normal);
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

/// How far the sample reaches along an axis: a period, the distance of two box walls, or the box as
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
        scenario.walls.iter().position(|wall| {
            wall.face.is_some_and(|face| face.axis.index() == axis && face.side == side)
        })
    })
}

/// The motion that a control means.
pub(super) fn motion(control: &WallControl) -> WallMotion {
    match control {
        WallControl::Fixed | WallControl::Removed => WallMotion::Fixed,
        WallControl::Velocity(velocity) => WallMotion::Velocity(Velocity { velocity: *velocity }),
        WallControl::Cosine(motion) => WallMotion::Cosine(Cosine {
            displacement: motion.displacement,
            period: motion.period,
            cycles: motion.cycles,
        }),
        WallControl::Servo(servo) => WallMotion::Servo(Servo {
            pressure: PressureRamp { from: servo.from, to: servo.pressure, duration: servo.ramp },
            mass: servo.mass,
            damping: servo.damping,
        }),
    }
}

/// Refuses particles whose centres lie behind a wall.
fn check_start(scenario: &Scenario, particles: &[Particle], walls: &[Wall]) -> Result<(), PrepareError> {
    for (id, particle) in particles.iter().enumerate() {
        for wall in walls {
            let depth = wall.offset() - particle.position.dot(wall.normal);
            if depth >= 0.0 {
                let [x, y, z] = particle.position.to_array();
                let (file, wall) = (scenario.source.name.clone(), wall.name.clone());
                return Err(PrepareError::Outside { file, id: id as u32, x, y, z, depth, wall });
            }
        }
    }
    Ok(())
}

/// Refuses overlaps of more than a tenth of a radius at the start: the elastic energy in them would
/// blow the sample up.
fn check_overlaps(scenario: &Scenario, simulation: &Simulation) -> Result<(), PrepareError> {
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    let mut deepest: Option<PrepareError> = None;
    let mut depth = 0.0;
    simulation.for_each_contact(&mut |contact| {
        let radius = particles.radii()[rows[contact.first as usize]];
        let relative = contact.overlap / radius;
        if relative > 0.1 && relative > depth {
            depth = relative;
            let partner = match contact.second {
                ContactPartner::Particle(id) => format!("particle {id}"),
                ContactPartner::Wall(place) => format!("wall `{}`", simulation.walls()[place].name),
            };
            let (file, id, overlap) = (scenario.source.name.clone(), contact.first, contact.overlap);
            deepest = Some(PrepareError::Overlap { file, id, partner, overlap, radius });
        }
    });
    deepest.map_or(Ok(()), Err)
}
