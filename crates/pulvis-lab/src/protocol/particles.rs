//! The particles that a scenario asks for.

use std::f64::consts::PI;

use pulvis_core::arrangement::{
    self, Lattice, Random, Region, Sizes, gaussian_vector, random_places, random_stream,
};
use pulvis_core::{Domain, MaterialIndex, Particle};
use pulvis_input::Problem;
use pulvis_input::scenario::{Arrangement, Grain, ParticleGroup, RadiusDistribution, Scenario};
use pulvis_math::{Vector3, elementary};

use super::error::PrepareError;

/// All particles, group by group; their ids are their places in this list.
pub(super) fn generate(scenario: &Scenario, domain: &Domain) -> Result<Vec<Particle>, PrepareError> {
    let mut random = random_stream(scenario.seed);
    let mut particles: Vec<Particle> = Vec::with_capacity(scenario.particle_count());
    for (place, group) in scenario.particles.iter().enumerate() {
        let radii = radii(scenario, group, place, &mut random)?;
        let centres = centres(scenario, group, place, &radii, domain, &particles, &mut random)?;
        let density = scenario.materials[group.material].density.unwrap_or(f64::NAN);
        for (number, (radius, position)) in radii.into_iter().zip(centres).enumerate() {
            particles.push(Particle {
                material: group.material as MaterialIndex,
                radius,
                mass: 4.0 / 3.0 * PI * elementary::powi(radius, 3) * density,
                position,
                velocity: velocity(group, number, &mut random),
                angular_velocity: group.velocity.angular_velocity,
            });
        }
    }
    Ok(particles)
}

fn radii(
    scenario: &Scenario,
    group: &ParticleGroup,
    place: usize,
    random: &mut Random,
) -> Result<Vec<f64>, PrepareError> {
    let Some(distribution) = &group.radius else {
        return Ok(grains(group).iter().filter_map(|grain| grain.radius).collect());
    };
    sizes(distribution).draw(group.count, random).map_err(|invalid| {
        let problem = Problem::rule(invalid.to_string(), "a distribution that radii can be drawn from");
        let path = format!("particles[{place}].radius");
        scenario.mistake(&[&path], problem, "widen `minimum` and `maximum`").into()
    })
}

fn sizes(distribution: &RadiusDistribution) -> Sizes {
    match distribution.clone() {
        RadiusDistribution::Fixed { value } => Sizes::Fixed(value),
        RadiusDistribution::Uniform { minimum, maximum } => Sizes::Uniform { minimum, maximum },
        RadiusDistribution::Normal { mean, standard_deviation, minimum, maximum } => {
            Sizes::Normal { mean, standard_deviation, minimum, maximum }
        }
        RadiusDistribution::LogNormal { median, sigma, minimum, maximum } => {
            Sizes::LogNormal { median, sigma, minimum, maximum }
        }
        RadiusDistribution::List { values, weights } => {
            Sizes::List(values.into_iter().zip(weights).collect())
        }
    }
}

fn centres(
    scenario: &Scenario,
    group: &ParticleGroup,
    place: usize,
    radii: &[f64],
    domain: &Domain,
    present: &[Particle],
    random: &mut Random,
) -> Result<Vec<Vector3>, PrepareError> {
    match &group.arrangement {
        Arrangement::Lattice(plan) => {
            // A site is the middle of its cell.
            let half = 0.5 * plan.spacing;
            let lattice = Lattice {
                lower: plan.lower + Vector3::new(half, half, half),
                counts: plan.counts,
                spacing: plan.spacing,
                jitter: plan.jitter,
            };
            let mut sites = arrangement::lattice(&lattice, random);
            sites.truncate(group.count);
            Ok(sites)
        }
        Arrangement::Random(extent) => {
            let region = Region { lower: extent.lower, upper: extent.upper };
            let present: Vec<_> =
                present.iter().map(|particle| (particle.position, particle.radius)).collect();
            random_places(radii, &region, domain, &present, random).map_err(|no_room| {
                let problem = Problem::rule(no_room.to_string(), "room for all particles");
                let path = format!("particles[{place}].arrangement");
                scenario.mistake(&[&path], problem, "enlarge the region or take fewer particles").into()
            })
        }
        Arrangement::File { grains, .. } => Ok(grains.iter().map(|grain| grain.position).collect()),
        Arrangement::List(positions) => Ok(positions.clone()),
    }
}

/// What the file of the arrangement says, if there is one.
fn grains(group: &ParticleGroup) -> &[Grain] {
    match &group.arrangement {
        Arrangement::File { grains, .. } => grains,
        _ => &[],
    }
}

fn velocity(group: &ParticleGroup, number: usize, random: &mut Random) -> Vector3 {
    let plan = &group.velocity;
    let from_file = grains(group).get(number).and_then(|grain| grain.velocity);
    let mut velocity = from_file.unwrap_or(Vector3::zero()) + plan.mean;
    if plan.standard_deviation > 0.0 {
        velocity += gaussian_vector(random) * plan.standard_deviation;
    }
    velocity
}
