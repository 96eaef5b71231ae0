//! The wall-clock time of a run, from trials: steps of the sample as it starts and of a packing of the same
//! particles, as stages that begin dilute end dense.

use std::hint::black_box;
use std::time::Instant;

use pulvis_boundary::{CellMotion, UpperTriangular, WallMotion};
use pulvis_core::{Particle, Simulation};
use pulvis_input::scenario::{Scenario, WallControl};
use pulvis_math::{Vector3, elementary};

use super::cell;
use super::measure::Measure;
use super::openings::Openings;
use super::packed::{Density, packing};
use super::run::sensible_threads;
use super::setup::{Prepared, StagePlan};
use super::stage::length;

/// Solid fraction at which a sample that is compacted becomes a packing [1].
const PACKED: f64 = 0.6;

/// Wall-clock times of a stage [s].
#[derive(Clone, Copy, Debug)]
pub(super) struct StageCosts {
    /// A step, on the average over the stage.
    pub step: f64,
    /// A row of the time series.
    pub row: f64,
}

/// The times of steps and rows in each stage, measured in trials of a fraction of a second each. The simulation is
/// used up: it makes some steps.
pub(super) fn stage_costs(
    scenario: &Scenario,
    prepared: &mut Prepared,
    durations: &[Option<f64>],
) -> Vec<StageCosts> {
    let compactions = compactions(scenario, prepared);
    let threads = sensible_threads(prepared.particles.len());
    let simulation = &mut prepared.simulation;
    // The system may refuse threads; the trial then takes one.
    let _ = simulation.set_threads(threads);
    let measure = Measure::new(scenario, simulation);
    // The loops over contacts add up what a row needs of them: packed or not, a row costs the same.
    let openings = Openings::new(scenario, None);
    let row = seconds_of(|| measure.row(scenario, simulation, &openings, 1, [None; 3]));
    let is_packed = 2.0 * simulation.contact_totals().pairs > 3.0 * prepared.particles.len() as f64;
    let start_step = seconds_of_step(&mut prepared.simulation);
    let mut packed_steps: Vec<(&StagePlan, f64)> = Vec::new();
    let mut compacted = is_packed;
    let mut all = Vec::with_capacity(prepared.stages.len());
    for (number, plan) in prepared.stages.iter().enumerate() {
        let known = packed_steps.iter().find(|(known, _)| known.interactions == plan.interactions);
        let packed_step = known.map(|(_, step)| *step).unwrap_or_else(|| {
            let trial = packed_step(&prepared.particles, plan, threads);
            packed_steps.push((plan, trial.max(start_step)));
            trial.max(start_step)
        });
        let share = match (compacted, compactions[number]) {
            (true, _) => 0.0,
            (false, None) => 1.0,
            // While the sample is compacted a step costs half of each, on the average.
            (false, Some(time)) => {
                let share = durations[number].map_or(1.0, |duration| (time / duration).min(1.0));
                compacted = share < 1.0;
                0.5 * share
            }
        };
        all.push(StageCosts { step: share * start_step + (1.0 - share) * packed_step, row });
    }
    all
}

/// What a step costs in a packing of the particles [s]; zero where there is none.
fn packed_step(particles: &[Particle], plan: &StagePlan, threads: usize) -> f64 {
    let count = particles.len();
    let trial = packing(particles, count, &plan.interactions, Density::Settled, plan.time_step);
    let Some(mut trial) = trial else { return 0.0 };
    let _ = trial.set_threads(threads);
    let scale = count as f64 / trial.particles().len() as f64;
    scale * seconds_of_step(&mut trial)
}

/// Wall-clock time of a step [s]: the lower decile of many short batches, so that moments in which the
/// machine did something else do not count.
fn seconds_of_step(simulation: &mut Simulation) -> f64 {
    let began = Instant::now();
    let batch = |steps: u64, simulation: &mut Simulation| {
        let began = Instant::now();
        simulation.advance(steps).ok().map(|()| began.elapsed().as_secs_f64() / steps as f64)
    };
    // The first steps touch memory and start threads.
    let Some(first) = batch(1, simulation).and_then(|_| batch(1, simulation)) else { return 0.0 };
    // Shorter than the slices of time that systems give to processes.
    let steps = ((0.001 / first.max(1e-9)) as u64).clamp(1, 1000);
    let mut times = vec![first];
    while began.elapsed().as_secs_f64() < 0.2 || times.len() < 4 {
        let Some(time) = batch(steps, simulation) else { break };
        times.push(time);
    }
    times.remove(0);
    lower_decile(times).unwrap_or(first)
}

/// Wall-clock time of something short [s].
fn seconds_of<T>(mut work: impl FnMut() -> T) -> f64 {
    let times = (0..8).map(|_| {
        let began = Instant::now();
        black_box(work());
        began.elapsed().as_secs_f64()
    });
    lower_decile(times.collect()).unwrap_or(0.0)
}

fn lower_decile(mut times: Vec<f64>) -> Option<f64> {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 10).copied()
}

/// For each stage, the time [s] in which gravity or a wall makes a packing of the sample; `None` where neither
/// acts.
fn compactions(scenario: &Scenario, prepared: &Prepared) -> Vec<Option<f64>> {
    let sample = Bed::of(scenario, prepared);
    let mut controls = vec![WallControl::Motion(WallMotion::Fixed); scenario.walls.len()];
    let motions = cell::motions(scenario, prepared.simulation.cell_motion());
    let stages = prepared.stages.iter().zip(&motions);
    stages
        .map(|(plan, motion)| {
            for (wall, control) in &plan.wall_changes {
                controls[*wall] = *control;
            }
            let walls = (0..controls.len()).filter_map(|wall| sample.pressed_in(wall, &controls[wall]));
            let falling = sample.falls_in(plan.background.gravity, plan.background.drag);
            walls.chain(falling).chain(sample.shrinks_in(motion)).min_by(f64::total_cmp)
        })
        .collect()
}

/// The sample as it starts.
struct Bed<'a> {
    simulation: &'a Simulation,
    /// Extent of the sample along each axis [m].
    size: [f64; 3],
    /// Part of each extent that a packing leaves empty [1].
    empty: f64,
    mean_mass: f64,
}

impl<'a> Bed<'a> {
    fn of(scenario: &Scenario, prepared: &'a Prepared) -> Self {
        let particles = &prepared.particles;
        let drawn = [0, 1, 2].map(|axis| {
            let along = || particles.iter().map(|particle| (particle.position[axis], particle.radius));
            let high = along().map(|(at, radius)| at + radius).fold(f64::NEG_INFINITY, f64::max);
            let low = along().map(|(at, radius)| at - radius).fold(f64::INFINITY, f64::min);
            high - low
        });
        let size = [0, 1, 2].map(|axis| {
            length(scenario, &prepared.simulation, axis).unwrap_or(drawn[axis]).max(f64::MIN_POSITIVE)
        });
        let solid = prepared.simulation.particles().total_volume() / size.iter().product::<f64>();
        let mass: f64 = particles.iter().map(|particle| particle.mass).sum();
        Self {
            simulation: &prepared.simulation,
            size,
            empty: (1.0 - solid / PACKED).clamp(0.0, 1.0),
            mean_mass: mass / particles.len().max(1) as f64,
        }
    }

    /// The way that the sample is shortened along a direction until it is a packing [m].
    fn way(&self, direction: Vector3) -> f64 {
        let along = direction.to_array().map(f64::abs);
        self.empty * (0..3).map(|axis| along[axis] * self.size[axis]).sum::<f64>() / direction.norm()
    }

    /// Time of falling over the empty part of the sample [s].
    fn falls_in(&self, gravity: Vector3, drag: f64) -> Option<f64> {
        let strength = gravity.norm();
        if strength == 0.0 {
            return None;
        }
        let way = self.way(gravity);
        let steady = drag * way / (self.mean_mass * strength);
        Some((2.0 * way / strength).sqrt().max(steady))
    }

    /// Time in which a cell that deforms at given rates makes a packing of the sample [s].
    fn shrinks_in(&self, motion: &CellMotion) -> Option<f64> {
        let UpperTriangular { xx, yy, zz, .. } = motion.prescribed();
        (xx + yy + zz < 0.0).then(|| elementary::ln(1.0 - self.empty) / (xx + yy + zz))
    }

    /// Time in which a wall crosses the empty part of the sample [s].
    fn pressed_in(&self, wall: usize, control: &WallControl) -> Option<f64> {
        let way = self.way(self.simulation.walls()[wall].plane_normal()?);
        let WallControl::Motion(motion) = control else { return None };
        match motion {
            WallMotion::Servo(servo) => {
                let force = servo.pressure.to.abs() * self.simulation.wall_area(wall)?;
                let free = (2.0 * way * servo.mass / force).sqrt();
                Some(free.max(way * servo.damping / force).max(servo.pressure.duration))
            }
            WallMotion::Cosine(cosine) => Some(0.5 * cosine.period),
            other => other.law().constant_velocity().map(|velocity| way / velocity.norm()),
        }
        .filter(|time| time.is_finite())
    }
}
