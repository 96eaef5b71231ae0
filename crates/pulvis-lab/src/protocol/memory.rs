//! The memory that a run needs, told before anything is allocated.

use std::f64::consts::PI;

use pulvis_core::{MaterialIndex, Particle, Simulation};
use pulvis_input::Problem;
use pulvis_input::scenario::{Arrangement, ParticleGroup, Refusal, Scenario};
use pulvis_math::{Vector3, elementary};

use super::allow::refuse_unless_allowed;
use super::error::PrepareError;
use super::packed::{Density, packing};
use super::resources::{available_memory, size_in_words};
use super::setup::interactions;

/// Memory that a run needs, by trials with few particles, and what there is.
#[derive(Clone, Copy, Debug)]
pub struct MemoryForecast {
    /// Number of particles.
    pub particles: usize,
    /// Before the first step, with no contacts yet, and with the states for checkpoints [byte].
    pub start: u64,
    /// In a dense packing, twelve neighbours each [byte].
    pub packed: u64,
    /// Memory that is available [byte]; `None` where the system does not say.
    pub available: Option<u64>,
}

/// Fewer particles need no look: they take some hundred megabytes.
const FEW: usize = 200_000;

/// Particles that stand for all in a trial.
const SAMPLE: usize = 1000;

/// Bytes of a particle in a state that is held for a checkpoint: columns of the particle and of its list, and three contacts
/// with what they remember.
const STATE: u64 = 300;

/// Memory of the states that a run holds for checkpoints: the last one, and one on its way to the disk [byte].
pub(super) fn held_states(scenario: &Scenario, particles: usize) -> u64 {
    if scenario.output.checkpoints.is_some() { 2 * STATE * particles as u64 } else { 0 }
}

/// Estimates the memory that a scenario needs without making its particles; `None` where no trial can be
/// made, because the engine refuses the contacts.
pub fn memory_forecast(scenario: &Scenario) -> Option<MemoryForecast> {
    let particles = scenario.particle_count();
    let sample = sample(scenario);
    let mut models = Vec::new();
    for stage in &scenario.stages {
        let interactions = interactions(scenario, &stage.contacts);
        if !models.contains(&interactions) {
            models.push(interactions);
        }
    }
    // All sites of a lattice are made, also those that no particle takes.
    let sites = most_sites(scenario) as f64 * size_of::<Vector3>() as f64;
    let of_all = |density: Density| {
        let trials = models.iter().filter_map(|model| packing(&sample, particles, model, density, 1.0));
        let of_one = trials.map(|trial| trial.memory_size() as f64 / trial.particles().len() as f64);
        // The particles as they are made, once for the record and once for the engine.
        let most = of_one.max_by(f64::total_cmp)? + 2.0 * size_of::<Particle>() as f64;
        Some((most * particles as f64 + sites) as u64 + held_states(scenario, particles))
    };
    let (start, packed) = (of_all(Density::Loose)?, of_all(Density::Dense)?);
    Some(MemoryForecast { particles, start, packed, available: available_memory() })
}

/// Sites of the largest lattice.
fn most_sites(scenario: &Scenario) -> usize {
    let sites = scenario.particles.iter().map(|group| match &group.arrangement {
        Arrangement::Lattice(lattice) => lattice.site_count(),
        _ => 0,
    });
    sites.max().unwrap_or(0)
}

/// Refuses particles that cannot be numbered, or that need more memory than there is before the first step.
pub(super) fn refuse_too_many(scenario: &Scenario) -> Result<(), PrepareError> {
    let count = scenario.particle_count();
    if count.max(most_sites(scenario)) <= FEW {
        return Ok(());
    }
    let most = Simulation::MOST_PARTICLES;
    if count > most {
        let found = format!("there are {count} particles");
        return refused(scenario, None, found, format!("{most} or fewer, which the engine can number"));
    }
    match memory_forecast(scenario) {
        Some(MemoryForecast { start, available: Some(available), .. }) if start > available => {
            let found = format!(
                "{count} particles need about {} of memory before the first step, and {} of memory are available",
                size_in_words(start),
                size_in_words(available)
            );
            refused(scenario, Some(Refusal::Memory), found, "particles that fit into the memory")
        }
        _ => Ok(()),
    }
}

/// Points at the number of the largest group.
fn refused(
    scenario: &Scenario,
    refusal: Option<Refusal>,
    found: String,
    expected: impl Into<String>,
) -> Result<(), PrepareError> {
    let groups = scenario.particles.iter().enumerate();
    let place = groups.max_by_key(|(_, group)| group.count).map_or(0, |(place, _)| place);
    let paths = [
        format!("particles[{place}].count"),
        format!("particles[{place}].arrangement.counts"),
        format!("particles[{place}]"),
    ];
    let paths = paths.each_ref().map(String::as_str);
    let help = "take fewer particles, or a machine with more memory";
    let problem = Problem::rule(found, expected);
    match refusal {
        Some(refusal) => refuse_unless_allowed(scenario, refusal, &paths, problem, help),
        None => Err(scenario.mistake(&paths, problem, help).into()),
    }
}

/// Particles of all groups in proportion to their numbers, of the middle radius of each.
fn sample(scenario: &Scenario) -> Vec<Particle> {
    let total = scenario.particle_count().max(1);
    let groups = scenario.particles.iter();
    groups
        .flat_map(|group| {
            let share = (group.count * SAMPLE).div_ceil(total).min(group.count);
            std::iter::repeat_n(typical(scenario, group), share)
        })
        .collect()
}

fn typical(scenario: &Scenario, group: &ParticleGroup) -> Particle {
    let radius = match (&group.radius, &group.arrangement) {
        (Some(distribution), _) => {
            let (smallest, largest) = distribution.limits();
            0.5 * (smallest + largest)
        }
        (None, Arrangement::File { grains, .. } | Arrangement::List(grains)) => {
            let radii = || grains.iter().filter_map(|grain| grain.radius);
            radii().sum::<f64>() / radii().count().max(1) as f64
        }
        // Every other group has a distribution.
        (None, _) => f64::NAN,
    };
    let density = scenario.materials[group.material].density.unwrap_or(f64::NAN);
    Particle {
        material: group.material as MaterialIndex,
        radius,
        mass: 4.0 / 3.0 * PI * elementary::powi(radius, 3) * density,
        position: Vector3::zero(),
        velocity: Vector3::zero(),
        angular_velocity: Vector3::zero(),
    }
}
