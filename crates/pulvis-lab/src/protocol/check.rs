//! What a run will be like, said before it starts.

use std::path::Path;
use std::time::Instant;

use pulvis_contact::ContactModel;
use pulvis_contact::theory::{CriticalVelocities, LudingPair};
use pulvis_core::Particle;
use pulvis_input::collision::{Bodies, Sphere, luding_pair};
use pulvis_input::scenario::{Contact, Scenario, Stage};
use pulvis_input::{BodyQuantity, NamedLaw, Surroundings};

use super::cell;
use super::damping::damping_ratios;
use super::disk::{DiskForecast, disk_forecast, refuse_full_disk};
use super::error::PrepareError;
use super::folder;
use super::formats::refuse_missing_formats;
use super::measure::Measure;
use super::memory::{held_states, memory_forecast};
use super::regime::{StageRegime, regimes};
use super::setup::{Prepared, describe_motion, prepare};
use super::stage::LEAST_STEPS_TO_REST;
use super::timing::stage_costs;
use super::typical::{Body, TypicalBodies};
use super::warnings::warnings;
use crate::collision::sticking_ranges;

/// Seconds for which the speeds of sticking are sought by collisions; they are left out for further contacts.
const SEARCH: f64 = 2.0;

/// Bytes that a frame writes in a second.
const WRITTEN: f64 = 2e8;

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
    /// In what regime the stages will be: those in which something presses or drives the particles, and a gas at the start.
    pub regimes: Vec<StageRegime>,
    /// Memory that the run needs at its start, by the sizes of particles and candidates, with the states that are held for
    /// checkpoints [byte].
    pub memory: u64,
    /// Memory that it would need if the particles came to a dense packing, twelve neighbours each [byte];
    /// `None` where that cannot be told.
    pub packed_memory: Option<u64>,
    /// Memory that is available [byte]; `None` where the system does not say.
    pub available_memory: Option<u64>,
    /// Candidate contacts at the start.
    pub candidates: usize,
    /// The room that the files take.
    pub disk: DiskForecast,
    /// Wall-clock time for frames [s].
    pub frame_seconds: f64,
    /// What is valid and yet probably not meant.
    pub warnings: Vec<String>,
}

/// A contact between particles of mean size in the first stage.
#[derive(Clone, Debug)]
pub struct ContactForecast {
    /// The materials.
    pub between: String,
    /// The laws, with their parameters.
    pub laws: Vec<NamedLaw>,
    /// Duration of the shortest motion [s].
    pub contact_time: f64,
    /// Relative velocity at which the contact becomes fully plastic without dashpot, v_p [m/s]; Luding law
    /// only.
    pub plastic_velocity: Option<f64>,
    /// Velocities at which pairs that meet head on stick.
    pub sticking: Sticking,
}

/// Velocities at which pairs that meet head on stick.
#[derive(Clone, Debug)]
pub enum Sticking {
    /// By the closed forms, for contacts without dashpot.
    ClosedForm(CriticalVelocities),
    /// Found by collisions, see [`sticking_ranges`] [m/s].
    Computed(Vec<[f64; 2]>),
    /// Particles of the same material differ in this quantity, which a law reads.
    Varied(&'static str),
    /// Not known: the pair is overdamped, the wall is no plane, or there are too many contacts to try.
    Unknown,
}

/// What a stage will be like.
#[derive(Clone, Debug)]
pub struct StageForecast {
    /// Name of the stage.
    pub name: String,
    /// Time step [s].
    pub time_step: f64,
    /// The shortest motion [s] and whose it is.
    pub shortest: Option<(f64, String)>,
    /// Number of steps, where the duration is known; an upper limit where other rules may end the
    /// stage before.
    pub steps: Option<u64>,
    /// Steps that it takes at least.
    pub least_steps: u64,
    /// Whether other rules than time may end it.
    pub open_ended: bool,
    /// Wall-clock time of a step, averaged over the stage [s].
    pub seconds_per_step: f64,
    /// Wall-clock time of the rows of the time series for each step [s].
    pub row_seconds_per_step: f64,
}

impl Preflight {
    /// Number of steps of all stages whose duration is known; an upper limit where other rules may end stages.
    pub fn steps(&self) -> u64 {
        self.stages.iter().filter_map(|stage| stage.steps).sum()
    }

    /// Number of steps that all stages take at least.
    pub fn least_steps(&self) -> u64 {
        self.stages.iter().map(|stage| stage.least_steps).sum()
    }

    /// Wall-clock time [s] for the least and for the largest number of steps of all stages, as far as it is known.
    pub fn seconds(&self) -> [f64; 2] {
        let sum = |steps: fn(&StageForecast) -> u64| -> f64 {
            let of_stage = |stage: &StageForecast| {
                steps(stage) as f64 * (stage.seconds_per_step + stage.row_seconds_per_step)
            };
            self.frame_seconds + self.stages.iter().map(of_stage).sum::<f64>()
        };
        [sum(|stage| stage.least_steps), sum(|stage| stage.steps.unwrap_or(stage.least_steps))]
    }

    /// Whether the rules of some stage may end it at different times.
    pub fn is_open_ended(&self) -> bool {
        self.stages.iter().any(|stage| stage.open_ended || stage.steps.is_none())
    }
}

/// Checks a scenario with its particles and says what the run will be like. Writes nothing.
///
/// # Errors
/// What would keep the run from starting, but for its output folder, which is among the warnings.
pub fn preflight(scenario: &Scenario) -> Result<Preflight, PrepareError> {
    refuse_missing_formats(scenario)?;
    let mut prepared = prepare(scenario)?;
    let memory = memory_forecast(scenario);
    let particles = &prepared.particles;
    let range = |value: fn(&Particle) -> f64| {
        let values = prepared.sample.iter().map(value);
        values.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], value| [low.min(value), high.max(value)])
    };
    let mut forecast = Preflight {
        particles: particles.len(),
        radii: range(|particle| particle.radius),
        masses: range(|particle| particle.mass),
        // A sum of nothing is -0.
        total_mass: 0.0 + particles.iter().map(|particle| particle.mass).sum::<f64>(),
        contacts: forecasts(scenario, &prepared.sample),
        stages: stages(scenario, &prepared),
        regimes: regimes(scenario, &prepared),
        memory: prepared.simulation.memory_size() as u64 + held_states(scenario, particles.len()),
        packed_memory: memory.map(|memory| memory.packed),
        available_memory: memory.and_then(|memory| memory.available),
        candidates: prepared.simulation.candidates(),
        disk: DiskForecast {
            timeseries: 0.0,
            snapshots: 0.0,
            frame: 0.0,
            frames: 0.0,
            files: 0.0,
            checkpoints: 0.0,
            free: None,
        },
        frame_seconds: 0.0,
        warnings: warnings(scenario, &prepared),
    };
    let columns = Measure::new(scenario, &prepared.simulation).columns().len();
    let most = forecast.particles.max(scenario.expected_particles());
    refuse_full_disk(scenario, &scenario.output.folder, most, columns, &forecast.stages)?;
    forecast.disk = disk_forecast(scenario, &scenario.output.folder, most, columns, &forecast.stages);
    forecast.frame_seconds = (forecast.disk.snapshots + forecast.disk.files) / WRITTEN;
    forecast.warn_of_resources(&scenario.output.folder);
    // Last: the trials make steps of the prepared simulation.
    let durations: Vec<Option<f64>> =
        forecast.stages.iter().map(|stage| stage.steps.map(|steps| steps as f64 * stage.time_step)).collect();
    let costs = stage_costs(scenario, &mut prepared, &durations);
    for (stage, costs) in forecast.stages.iter_mut().zip(costs) {
        let steps = stage.steps.unwrap_or(stage.least_steps).max(1) as f64;
        stage.seconds_per_step = costs.step;
        stage.row_seconds_per_step = costs.row * stage.count(scenario.output.timeseries) / steps;
    }
    Ok(forecast)
}

impl Preflight {
    /// What the machine lacks, and a folder that the run would refuse.
    fn warn_of_resources(&mut self, output: &Path) {
        if let (Some(packed), Some(available)) = (self.packed_memory, self.available_memory)
            && packed > available
        {
            let text = "the memory that is available does not hold a dense packing of the particles";
            self.warnings.push(text.to_owned());
        }
        if self.disk.free.is_some_and(|free| self.disk.total() > free as f64) {
            self.warnings.push("the disk has not enough room for the output".to_owned());
        }
        if let Err(error) = folder::look(output, false) {
            self.warnings.push(format!("`pulvis run` will refuse this: {error}"));
        }
    }
}

fn forecasts(scenario: &Scenario, particles: &[Particle]) -> Vec<ContactForecast> {
    let Some(stage) = scenario.stages.first() else { return Vec::new() };
    let began = Instant::now();
    stage
        .contacts
        .iter()
        .filter_map(|contact| {
            let bodies = TypicalBodies::of(scenario, particles, contact.materials)?;
            let names = contact.materials.map(|material| scenario.materials[material].name.as_str());
            let searches = began.elapsed().as_secs_f64() < SEARCH;
            let around = surroundings(scenario, contact, bodies.second().is_none());
            let forecast = forecast(names.join("-"), &contact.model, &bodies, (searches, around));
            Some(ContactForecast { laws: contact.laws.clone(), ..forecast })
        })
        .collect()
}

/// What the laws of a contact read at the start; the name of a quantity of which particles of one material have several
/// values.
pub(super) fn surroundings(
    scenario: &Scenario,
    contact: &Contact,
    at_wall: bool,
) -> Result<Surroundings, &'static str> {
    let mut quantities = Vec::new();
    for quantity in contact.model.particle_quantities() {
        let of_material = |material: usize| -> Result<Option<f64>, &'static str> {
            let columns = scenario.columns_of(material);
            let mut values = columns.filter(|column| column.name == quantity.name).map(|column| column.value);
            let Some(first) = values.next() else { return Ok(None) };
            if values.all(|value| value == first) { Ok(Some(first)) } else { Err(quantity.name) }
        };
        let [one, other] = contact.materials.map(of_material);
        let (one, other) = (one?, other?);
        let first = one.or(other).unwrap_or_default();
        let second = if at_wall { 0.0 } else { one.and(other).unwrap_or_default() };
        let values = [first, second];
        quantities.push(BodyQuantity { name: quantity.name, unit: quantity.unit(), values });
    }
    Ok(Surroundings { temperature: scenario.temperature.clone(), quantities })
}

fn forecast(
    between: String,
    model: &ContactModel,
    bodies: &TypicalBodies,
    (searches, around): (bool, Result<Surroundings, &'static str>),
) -> ContactForecast {
    let theory: Option<LudingPair> = luding_pair(model, &bodies.pair());
    let damping = damping_ratios(model, bodies).first().map_or(0.0, |(_, ratio)| *ratio);
    let sticking = match &theory {
        Some(theory) if damping == 0.0 => Sticking::ClosedForm(theory.critical_velocities()),
        // An overdamped pair creeps for longer than anybody wants to wait; collisions know planes only.
        _ if damping >= 1.0 || !searches || bodies.is_curved() => Sticking::Unknown,
        _ => match around {
            Err(quantity) => Sticking::Varied(quantity),
            Ok(around) => {
                let sphere = |(mass, radius): Body| Sphere { radius, mass };
                let colliding = match bodies.second() {
                    Some(second) => Bodies::Pair([sphere(bodies.body), sphere(second)]),
                    None => Bodies::Wall(sphere(bodies.body)),
                };
                sticking_ranges(colliding, model, &around).map_or(Sticking::Unknown, Sticking::Computed)
            }
        },
    };
    ContactForecast {
        between,
        laws: Vec::new(),
        contact_time: model.shortest_contact_time(bodies.body, bodies.partner),
        plastic_velocity: theory.as_ref().map(LudingPair::v_p0),
        sticking,
    }
}

pub(crate) fn stages(scenario: &Scenario, prepared: &Prepared) -> Vec<StageForecast> {
    let motions = cell::motions(scenario, prepared.simulation.cell_motion());
    let plans = scenario.stages.iter().zip(&prepared.stages).zip(&motions);
    plans
        .map(|((stage, plan), motion)| {
            let rules = &stage.until;
            let walls = plan.wall_changes.iter().filter_map(|(_, control)| control.duration());
            let cycles =
                walls.chain(stage.groups.iter().filter_map(|(_, control)| control.motion.duration()));
            let duration = rules.time.or_else(|| cycles.max_by(f64::total_cmp));
            let strained = cell::time_to_strain(rules, motion);
            let duration = duration.into_iter().chain(strained).min_by(f64::total_cmp);
            StageForecast {
                name: stage.name.clone(),
                time_step: plan.time_step,
                shortest: plan.shortest.map(|motion| (motion.duration, describe_motion(scenario, &motion))),
                steps: duration.map(|duration| (duration / plan.time_step).ceil() as u64),
                least_steps: least_steps(stage, plan.time_step, duration),
                open_ended: rules.are_open_ended(),
                seconds_per_step: f64::NAN,
                row_seconds_per_step: f64::NAN,
            }
        })
        .collect()
}

/// Steps that a stage takes at least, whatever its rules find.
fn least_steps(stage: &Stage, time_step: f64, duration: Option<f64>) -> u64 {
    let rules = &stage.until;
    let most = duration.unwrap_or(f64::INFINITY);
    let least = match (
        rules.kinetic_to_elastic,
        rules.strain.is_some() || rules.stress.is_some() || rules.passed.is_some() || rules.steady.is_some(),
    ) {
        (None, false) => most,
        (Some(_), false) => most.min(rules.minimum_time + LEAST_STEPS_TO_REST as f64 * time_step),
        (_, true) => 0.0,
    };
    if least.is_finite() { (least / time_step).ceil() as u64 } else { 0 }
}
