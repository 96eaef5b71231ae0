//! What a run will be like, said before it starts.

use pulvis_math::elementary;
use std::time::Instant;

use pulvis_contact::theory::{CriticalVelocities, LudingPair};
use pulvis_contact::{ContactModel, Pair};
use pulvis_core::Particle;
use pulvis_input::collision::luding_pair;
use pulvis_input::scenario::Scenario;

use super::error::PrepareError;
use super::packed::packed_memory;
use super::run::sensible_threads;
use super::setup::{Prepared, between, prepare};

/// Everything that is known of a run before its first step.
#[derive(Clone, Debug)]
pub struct Preflight {
    /// Number of particles.
    pub particles: usize,
    /// Smallest and largest radius [m].
    pub radii: [f64; 2],
    /// Smallest and largest mass [kg].
    pub masses: [f64; 2],
    /// Mass of all particles [kg].
    pub total_mass: f64,
    /// What the contacts of typical particles will do, one for each pair of materials.
    pub contacts: Vec<ContactForecast>,
    /// What the stages will be like.
    pub stages: Vec<StageForecast>,
    /// Memory that the run needs at its start, by the sizes of particles and candidates [byte].
    pub memory: usize,
    /// Memory that it would need if the particles came to a dense packing, twelve neighbours each [byte];
    /// `None` where that cannot be told.
    pub packed_memory: Option<usize>,
    /// Candidate contacts at the start.
    pub candidates: usize,
    /// Wall-clock time of a step, measured over a short trial from the initial state [s].
    pub seconds_per_step: f64,
}

/// A contact between particles of mean size in the first stage.
#[derive(Clone, Debug)]
pub struct ContactForecast {
    /// The materials.
    pub between: String,
    /// Name of the normal law.
    pub law: &'static str,
    /// Duration of the shortest motion [s].
    pub contact_time: f64,
    /// Relative velocity at which the contact becomes fully plastic, v_p [m/s]; Luding law only.
    pub plastic_velocity: Option<f64>,
    /// Velocities between which pairs stick [m/s]; Luding law only.
    pub sticking: Option<CriticalVelocities>,
}

/// What a stage will be like.
#[derive(Clone, Debug)]
pub struct StageForecast {
    /// Name of the stage.
    pub name: String,
    /// Time step [s].
    pub time_step: f64,
    /// The shortest contact [s] and whose it is.
    pub shortest: Option<(f64, String)>,
    /// Number of steps, where the duration is known; an upper limit where other rules may end the
    /// stage before.
    pub steps: Option<u64>,
    /// Whether other rules than time may end it.
    pub open_ended: bool,
}

impl Preflight {
    /// Number of steps of all stages whose duration is known.
    pub fn steps(&self) -> u64 {
        self.stages.iter().filter_map(|stage| stage.steps).sum()
    }
}

/// Checks a scenario with its particles and says what the run will be like. Writes nothing.
pub fn preflight(scenario: &Scenario) -> Result<Preflight, PrepareError> {
    let prepared = prepare(scenario)?;
    let particles = &prepared.particles;
    let range = |value: fn(&Particle) -> f64| {
        let values = particles.iter().map(value);
        values.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], value| [low.min(value), high.max(value)])
    };
    Ok(Preflight {
        particles: particles.len(),
        radii: range(|particle| particle.radius),
        masses: range(|particle| particle.mass),
        total_mass: particles.iter().map(|particle| particle.mass).sum(),
        contacts: forecasts(scenario, particles),
        stages: stages(scenario, &prepared),
        memory: prepared.simulation.memory_size(),
        packed_memory: packed_memory(particles, &prepared.stages),
        candidates: prepared.simulation.candidates(),
        seconds_per_step: time_a_step(&prepared),
    })
}

fn forecasts(scenario: &Scenario, particles: &[Particle]) -> Vec<ContactForecast> {
    let Some(stage) = scenario.stages.first() else { return Vec::new() };
    stage
        .contacts
        .iter()
        .filter_map(|contact| {
            let [one, other] = contact.materials.map(|material| mean_body(particles, material));
            let (body, partner) = match (one, other) {
                (Some(one), other) => (one, other),
                (None, Some(other)) => (other, None),
                (None, None) => return None,
            };
            let names = contact.materials.map(|material| scenario.materials[material].name.as_str());
            Some(forecast(names.join("-"), &contact.model, body, partner))
        })
        .collect()
}

/// Mass [kg] and radius [m] of a particle of the mean radius of a material.
fn mean_body(particles: &[Particle], material: usize) -> Option<(f64, f64)> {
    let of_material = || particles.iter().filter(|particle| usize::from(particle.material) == material);
    let count = of_material().count();
    let first = of_material().next()?;
    let radius = of_material().map(|particle| particle.radius).sum::<f64>() / count as f64;
    Some((first.mass * elementary::powi(radius / first.radius, 3), radius))
}

fn forecast(
    between: String,
    model: &ContactModel,
    body: (f64, f64),
    partner: Option<(f64, f64)>,
) -> ContactForecast {
    let pair = match partner {
        Some(partner) => Pair::spheres(body.0, partner.0, body.1, partner.1),
        None => Pair::wall(body.0, body.1),
    };
    let theory: Option<LudingPair> = luding_pair(model, &pair);
    ContactForecast {
        between,
        law: model.normal.entry().name,
        contact_time: model.shortest_contact_time(body, partner),
        plastic_velocity: theory.as_ref().map(LudingPair::v_p0),
        sticking: theory.as_ref().map(LudingPair::critical_velocities),
    }
}

fn stages(scenario: &Scenario, prepared: &Prepared) -> Vec<StageForecast> {
    let plans = scenario.stages.iter().zip(&prepared.stages);
    plans
        .map(|(stage, plan)| {
            let rules = &stage.until;
            let cycles = plan.wall_changes.iter().filter_map(|(_, control)| control.duration());
            let duration = rules.time.or_else(|| cycles.max_by(f64::total_cmp));
            StageForecast {
                name: stage.name.clone(),
                time_step: plan.time_step,
                shortest: plan.shortest.map(|contact| (contact.duration, between(scenario, &contact))),
                steps: duration.map(|duration| (duration / plan.time_step).ceil() as u64),
                open_ended: rules.are_open_ended(),
            }
        })
        .collect()
}

/// Wall-clock time of a step [s], from a copy of the simulation; a tenth of a second at the most.
fn time_a_step(prepared: &Prepared) -> f64 {
    let mut trial = prepared.simulation.clone();
    // As many threads as the run would take; one if the system cannot start them.
    let _ = trial.set_threads(sensible_threads(trial.particles().len()));
    let began = Instant::now();
    let mut steps = 0_u32;
    while began.elapsed().as_secs_f64() < 0.1 && steps < 10_000 {
        if trial.step().is_err() {
            break;
        }
        steps += 1;
    }
    began.elapsed().as_secs_f64() / f64::from(steps.max(1))
}
