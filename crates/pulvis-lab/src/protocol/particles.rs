//! The particles that a scenario asks for.

use std::f64::consts::PI;

use pulvis_core::{Domain, MaterialIndex, NamedColumn, Particle};
use pulvis_input::Problem;
use pulvis_input::scenario::{Arrangement, ParticleColumn, ParticleGroup, Scenario};
use pulvis_math::{Vector3, elementary};
use pulvis_packing::{Random, dense_positions, random_positions, random_stream};

use super::error::PrepareError;

/// All particles, group by group; their ids are their places in this list.
pub(super) fn generate(scenario: &Scenario, domain: &Domain) -> Result<Vec<Particle>, PrepareError> {
    let mut random = random_stream(scenario.seed);
    let mut particles: Vec<Particle> = Vec::with_capacity(scenario.particle_count());
    for (place, group) in scenario.particles.iter().enumerate() {
        let radii = radii(scenario, group, place, &mut random)?;
        let centres = centres(scenario, group, place, &radii, domain, &particles, &mut random)?;
        let density = |number| scenario.materials[group.material_of(number)].density.unwrap_or(f64::NAN);
        let mass =
            |(number, radius): (usize, &f64)| 4.0 / 3.0 * PI * elementary::powi(*radius, 3) * density(number);
        let masses: Vec<f64> = radii.iter().enumerate().map(mass).collect();
        let gas = group.velocity.random.draw(&masses, &mut random);
        for (number, (radius, position)) in radii.into_iter().zip(centres).enumerate() {
            particles.push(Particle {
                material: group.material_of(number) as MaterialIndex,
                radius,
                mass: masses[number],
                position,
                velocity: mean_velocity(group, number) + gas[number],
                angular_velocity: angular_velocity(group, number),
            });
        }
    }
    Ok(particles)
}

/// The further quantities of all particles, in the order of their ids.
pub(super) fn columns(scenario: &Scenario) -> Vec<NamedColumn> {
    let column = |(index, column): (usize, &ParticleColumn)| NamedColumn {
        name: column.name.clone(),
        unit: column.dimension.unit(),
        values: scenario
            .particles
            .iter()
            .flat_map(|group| match group.arrangement.column(&column.name) {
                Some(given) => given.values.clone(),
                None => vec![group.columns[index].value; group.count],
            })
            .collect(),
    };
    scenario.columns().iter().enumerate().map(column).collect()
}

fn radii(
    scenario: &Scenario,
    group: &ParticleGroup,
    place: usize,
    random: &mut Random,
) -> Result<Vec<f64>, PrepareError> {
    let Some(distribution) = &group.radius else {
        return Ok(group.arrangement.grains().iter().filter_map(|grain| grain.radius).collect());
    };
    distribution.draw(group.count, random).map_err(|invalid| {
        let path = format!("particles[{place}].radius.{}", invalid.parameter);
        let help = "widen the limits, or take another distribution";
        scenario.mistake(&[&path], Problem::rule(invalid.found, invalid.expected), help).into()
    })
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
        Arrangement::Lattice(lattice) => {
            let mut sites = lattice.positions(random);
            sites.truncate(group.count);
            Ok(sites)
        }
        Arrangement::Random(region) => {
            let present: Vec<_> =
                present.iter().map(|particle| (particle.position, particle.radius)).collect();
            random_positions(radii, region, domain, &present, random).map_err(|no_room| {
                let problem = Problem::rule(no_room.to_string(), "room for all particles");
                let path = format!("particles[{place}].arrangement");
                scenario.mistake(&[&path], problem, "enlarge the region or take fewer particles").into()
            })
        }
        Arrangement::Dense(region) => {
            let present: Vec<_> =
                present.iter().map(|particle| (particle.position, particle.radius)).collect();
            dense_positions(radii, region, domain, &present, random).map_err(|jammed| {
                let problem = Problem::rule(jammed.to_string(), "fewer particles or a larger block");
                let path = format!("particles[{place}].arrangement");
                scenario.mistake(&[&path], problem, "above some 0.6 press the sample in a stage").into()
            })
        }
        Arrangement::Aggregate { centre, growth } => {
            let positions = growth.aggregate(radii, random).into_iter();
            Ok(positions.map(|position| *centre + position).collect())
        }
        Arrangement::File { grains, .. } | Arrangement::List(grains) => {
            Ok(grains.iter().map(|grain| grain.position).collect())
        }
    }
}

/// The velocity of a particle before anything random is added.
fn mean_velocity(group: &ParticleGroup, number: usize) -> Vector3 {
    let given = group.arrangement.grains().get(number).and_then(|grain| grain.velocity);
    given.unwrap_or(Vector3::zero()) + group.velocity.mean
}

/// The angular velocity of a particle.
fn angular_velocity(group: &ParticleGroup, number: usize) -> Vector3 {
    let given = group.arrangement.grains().get(number).and_then(|grain| grain.angular_velocity);
    given.unwrap_or(Vector3::zero()) + group.velocity.angular_velocity
}
