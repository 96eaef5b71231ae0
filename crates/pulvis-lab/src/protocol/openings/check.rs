//! Inlets that cannot bring in what they should, refused before the run.

use std::f64::consts::PI;

use pulvis_boundary::Domain;
use pulvis_core::walls::Wall;
use pulvis_core::{MaterialIndex, NamedColumn, Particle};
use pulvis_input::Problem;
use pulvis_input::scenario::{Amount, Scenario, Stage};
use pulvis_math::Vector3;
use pulvis_packing::{InletPlan, random_point, random_stream};

use super::super::error::PrepareError;
use super::feed::plan_of;

/// Solid fraction at which random sequential addition of equal spheres finds no more room [1].
///
/// # Source
/// G. Zhang, S. Torquato, Phys. Rev. E 88, 053312 (2013): 0.3841307 in three dimensions.
const SATURATION: f64 = 0.384;

/// Sites that are tried for room in front of all walls.
const SITES: usize = 1000;

/// Spheres that stand for those that inlets will bring: the smallest and the largest of each.
pub(in crate::protocol) fn sample_of_inlets(scenario: &Scenario) -> Vec<Particle> {
    let spheres = scenario.inlets.iter().flat_map(|inlet| {
        let (smallest, largest) = inlet.radius.limits();
        let density = scenario.materials[inlet.material].density.unwrap_or(f64::NAN);
        let [lower, upper] = inlet.region.bounds();
        [smallest, largest].map(|radius| Particle {
            material: inlet.material as MaterialIndex,
            radius,
            mass: volume(radius) * density,
            position: (lower + upper) * 0.5,
            velocity: inlet.velocity,
            angular_velocity: inlet.angular_velocity,
        })
    });
    spheres.collect()
}

/// The charges [C] of the particles that have these `columns`, and of the [sample](sample_of_inlets) of all inlets; none where
/// particles have no charge.
pub(in crate::protocol) fn charges_of(scenario: &Scenario, columns: &[NamedColumn]) -> Vec<f64> {
    let of_particles = columns.iter().find(|column| column.name == "charge");
    let of_inlets = scenario.inlets.iter().flat_map(|inlet| {
        let charge = inlet.columns.iter().find(|column| column.name == "charge");
        [charge.map_or(0.0, |charge| charge.value); 2]
    });
    of_particles.into_iter().flat_map(|column| column.values.iter().copied()).chain(of_inlets).collect()
}

fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius * radius * radius
}

/// Refuses inlets behind walls, and rates that no particles can leave the region fast enough for.
pub(in crate::protocol) fn check_openings(scenario: &Scenario, walls: &[Wall]) -> Result<(), PrepareError> {
    for (index, inlet) in scenario.inlets.iter().enumerate() {
        let path = format!("inlets[{index}]");
        let plan = plan_of(scenario, index);
        if let Some(problem) = behind_walls(scenario, &plan, walls) {
            let paths = [format!("{path}.region"), path];
            let help = "move the region, or the wall";
            return Err(scenario.mistake(&paths.each_ref().map(String::as_str), problem, help).into());
        }
        let open = scenario.stages.iter().filter(|stage| inlet.schedule.takes_in(&stage.name));
        if let Some(problem) = open.into_iter().find_map(|stage| too_much(&plan, stage)) {
            let paths = [format!("{path}.mass_rate"), format!("{path}.number_rate"), path];
            let help =
                "lower the rate, enlarge the region across the velocity, or let particles come in faster";
            return Err(scenario.mistake(&paths.each_ref().map(String::as_str), problem, help).into());
        }
    }
    Ok(())
}

/// What is wrong with a region in which no sphere lies in front of all walls. Walls that will move are left aside.
fn behind_walls(scenario: &Scenario, plan: &InletPlan, walls: &[Wall]) -> Option<Problem> {
    let moves = |place: usize| {
        scenario.stages.iter().flat_map(|stage| &stage.controls).any(|(wall, _)| *wall == place)
    };
    let walls: Vec<&Wall> = walls
        .iter()
        .enumerate()
        .filter(|(place, wall)| wall.present && !moves(*place))
        .map(|(_, wall)| wall)
        .collect();
    let (radius, _) = plan.radius.limits();
    let inset = plan.region.inset(radius, &scenario.domain.unwrap_or(Domain::unbounded()))?;
    // Apart from the numbers of the run, which it must not change.
    let mut random = random_stream(0);
    let is_free = |site: Vector3| walls.iter().all(|wall| wall.distance(site) >= radius);
    if (0..SITES).any(|_| is_free(random_point(&inset, &mut random))) {
        return None;
    }
    let found = format!("of {SITES} random sites for the smallest particle none lies in front of all walls");
    Some(Problem::rule(found, "a region with room between the walls"))
}

/// What is wrong with a rate that is too high: particles leave the region slower than they should come in even if they fill it
/// as densely as random places can, and leave it through all of its cross-section.
fn too_much(plan: &InletPlan, stage: &Stage) -> Option<Problem> {
    let (smallest, _) = plan.radius.limits();
    let solid = |amount: Amount| match amount {
        Amount::Number(number) => number * volume(smallest),
        Amount::Mass(mass) => mass / plan.density,
    };
    let [lower, upper] = plan.region.bounds();
    let size = upper - lower;
    let held = SATURATION * plan.region.volume([f64::INFINITY; 3]);
    if plan.total.is_some_and(|total| solid(total) <= held) {
        return None;
    }
    let gravity = stage.background.gravity;
    let directions = [plan.velocity, gravity].map(|vector| vector.unit().unwrap_or(Vector3::zero()));
    let across = |direction: Vector3| {
        let area = |axis: usize| direction[axis].abs() * size[(axis + 1) % 3] * size[(axis + 2) % 3];
        area(0) + area(1) + area(2)
    };
    let all = across(Vector3::new(1.0, 1.0, 1.0));
    // Particles with random velocities leave on all sides.
    let area = if plan.standard_deviation > 0.0 {
        2.0 * all
    } else {
        directions.map(across).into_iter().fold(0.0, f64::max)
    };
    let fall =
        gravity.to_array().iter().zip(size.to_array()).map(|(along, size)| along.abs() * size).sum::<f64>();
    let speed = plan.velocity.norm() + 3.0 * plan.standard_deviation + (2.0 * fall).sqrt();
    let most = SATURATION * area * speed;
    let asked = solid(plan.rate);
    if asked <= most {
        return None;
    }
    if speed == 0.0 {
        let found = "particles come in at rest, no gravity takes them away, and they do not all find room";
        return Some(Problem::rule(found, "a velocity, gravity, or a total that fits into the region"));
    }
    let [asked, most] = [asked, most].map(|volume| volume * plan.density);
    let (asked, most) = match plan.rate {
        Amount::Mass(_) => (format!("{asked:.4e} kg/s"), format!("{most:.4e} kg/s")),
        Amount::Number(rate) => (format!("{rate:.4e} 1/s"), format!("{:.4e} 1/s", rate * most / asked)),
    };
    let found =
        format!("{asked} cannot come in: at {speed:.4e} m/s or less they do not leave the region so fast");
    Some(Problem::rule(
        found,
        format!(
            "at most {most} in stage {}, {:.0} % of its cross-section full",
            stage.name,
            100.0 * SATURATION
        ),
    ))
}
