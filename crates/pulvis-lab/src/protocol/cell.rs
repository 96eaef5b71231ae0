//! A cell that deforms: its columns in the time series, and what of it must fail is refused before it runs.

use std::f64::consts::PI;

use pulvis_boundary::CellContent;
use pulvis_core::{CellControl, CellMotion, Particle, Simulation, UpperTriangular};
use pulvis_input::Problem;
use pulvis_input::scenario::{Scenario, Stage, StopRules};
use pulvis_math::elementary::{exp, ln, powi};

use super::error::PrepareError;
use super::setup::StagePlan;

/// Strain in a time step that no cell may have: the engine stops there [1].
const MOST_STRAIN: f64 = 1e-2;

/// Whether the cell deforms in any stage.
pub(super) fn deforms(scenario: &Scenario) -> bool {
    scenario.stages.iter().any(|stage| stage.cell.is_some())
}

/// The names of its columns.
pub(super) fn columns(scenario: &Scenario) -> Vec<String> {
    if !deforms(scenario) {
        return Vec::new();
    }
    let named = |prefix: &str, names: &[&str]| -> Vec<String> {
        names.iter().map(|name| format!("{prefix}_{name}")).collect()
    };
    let shears = &UpperTriangular::NAMES[3..];
    [
        named("cell_strain", &UpperTriangular::NAMES),
        named("tilt", shears),
        named("stress", shears),
        named("kinetic_stress", &UpperTriangular::NAMES),
    ]
    .concat()
}

/// Their values now.
pub(super) fn values(scenario: &Scenario, simulation: &Simulation, volume: f64) -> Vec<f64> {
    if !deforms(scenario) {
        return Vec::new();
    }
    let virial = simulation.contact_totals().virial;
    let mut values = simulation.cell_strain().to_array().to_vec();
    values.extend(simulation.domain().tilts);
    values.extend(UpperTriangular::INDICES[3..].iter().map(|&[row, column]| virial[row][column] / volume));
    values.extend(simulation.kinetic_tensor().map(|sum| sum / volume));
    values
}

/// The time in which rules for strains are reached at the rates of the cell [s], if they are.
pub(super) fn time_to_strain(rules: &StopRules, motion: &CellMotion) -> Option<f64> {
    let rate = |component: usize| match motion.components[component] {
        CellControl::Rate(rate) => Some(rate),
        CellControl::Fixed | CellControl::Stress(_) => None,
    };
    let length = rules.strain.and_then(|rule| Some(ln(1.0 + rule.value) / rate(rule.axis.index())?));
    let shear = rules.shear_strain.and_then(|rule| Some(rule.value / rate(rule.component)?));
    length.into_iter().chain(shear).filter(|time| *time > 0.0).min_by(f64::total_cmp)
}

/// The motion of the cell in every stage.
pub(super) fn motions(scenario: &Scenario, present: &CellMotion) -> Vec<CellMotion> {
    let mut motion = *present;
    let stages = scenario.stages.iter();
    stages
        .map(|stage| {
            motion = stage.cell.unwrap_or(motion);
            motion
        })
        .collect()
}

/// Refuses rates that are too fast for the time step, servos that are too stiff for it, and cells that are pressed until
/// nothing fits into them.
pub(super) fn check_cell(
    scenario: &Scenario,
    particles: &[Particle],
    plans: &[StagePlan],
    present: &CellMotion,
) -> Result<(), PrepareError> {
    let Some(domain) = scenario.domain else { return Ok(()) };
    let mut sizes = domain.extent.size().to_array();
    let mut known = scenario.start_from.is_none();
    let motions = motions(scenario, present);
    for (number, (stage, plan)) in scenario.stages.iter().zip(plans).enumerate() {
        let motion = motions[number];
        let place = Place { scenario, number };
        place.check_rates(&motion, plan.time_step)?;
        place.check_servo(&motion, particles, plan)?;
        for (axis, size) in sizes.iter_mut().enumerate() {
            match (motion.components[axis], motion.deforms(axis), stage.until.time) {
                (_, false, _) => {}
                (CellControl::Rate(rate), _, Some(time)) => {
                    *size *= exp(rate * time);
                    if known && is_only_time(stage) {
                        place.check_size(axis, *size, particles)?;
                    }
                }
                _ => known = false,
            }
            known &= !motion.deforms(axis) || is_only_time(stage);
        }
    }
    Ok(())
}

/// Whether the stage lasts its time for certain.
fn is_only_time(stage: &Stage) -> bool {
    stage.until.time.is_some() && !stage.until.are_open_ended()
}

/// A stage of a scenario.
struct Place<'a> {
    scenario: &'a Scenario,
    number: usize,
}

impl Place<'_> {
    fn refuse(&self, key: &str, problem: Problem, help: &str) -> Result<(), PrepareError> {
        let table = format!("stages[{}].cell", self.number);
        let paths = [format!("{table}.{key}"), table, format!("stages[{}]", self.number)];
        Err(self.scenario.mistake(&[&paths[0], &paths[1], &paths[2]], problem, help).into())
    }

    fn check_rates(&self, motion: &CellMotion, time_step: f64) -> Result<(), PrepareError> {
        let strain = motion.prescribed().bound() * time_step;
        // Not `>`: what is no number is refused as well.
        let fits = strain <= MOST_STRAIN;
        if fits {
            return Ok(());
        }
        let found = format!("the cell is strained by {strain:.3e} in a time step of {time_step:.4e} s");
        let expected = format!("at most {MOST_STRAIN} in a step, {:.4e} 1/s", MOST_STRAIN / time_step);
        let help =
            "lower the rate, or shorten the step, for example by more `steps_per_contact_time` in [time]";
        self.refuse("rate", Problem::rule(found, expected), help)
    }

    /// A servo e = (σ − σ_target)/η on a packing of stiffness K is a decay with the rate K/η, which a step must not go
    /// beyond. K is at most some k/d; of a contact of the shortest duration, k = π² m_r/t².
    fn check_servo(
        &self,
        motion: &CellMotion,
        particles: &[Particle],
        plan: &StagePlan,
    ) -> Result<(), PrepareError> {
        let (Some(shortest), true) = (plan.shortest, motion.targets().next().is_some()) else {
            return Ok(());
        };
        let shortest = shortest.duration;
        let content = content(particles);
        let CellContent { diameter, density } = content;
        let mass = density * PI / 6.0 * powi(diameter, 3);
        let stiffness = PI * PI * 0.5 * mass / (shortest * shortest);
        let modulus = 2.0 * stiffness / diameter;
        let time = motion.viscosity(content) / modulus;
        if time >= plan.time_step || particles.is_empty() {
            return Ok(());
        }
        let most = motion.inertial_number * time / plan.time_step;
        let found = format!(
            "with inertial_number = {} the cell follows its stress within {time:.3e} s, less than a time step ({:.4e} s)",
            motion.inertial_number, plan.time_step
        );
        let expected = format!("at most {most:.2e}");
        let help = "lower `inertial_number`, or shorten the step, for example by more `steps_per_contact_time` in [time]";
        self.refuse("inertial_number", Problem::rule(found, expected), help)
    }

    fn check_size(&self, axis: usize, size: f64, particles: &[Particle]) -> Result<(), PrepareError> {
        let largest = particles.iter().map(|particle| particle.radius).fold(0.0, f64::max);
        if size >= 4.0 * largest {
            return Ok(());
        }
        let name = ["x", "y", "z"][axis];
        let found = format!(
            "at the end of the stage the period along {name} is {size:.4e} m, less than two diameters of the largest particle"
        );
        let expected = format!("at least {:.4e} m", 4.0 * largest);
        let help = "lower the rate, shorten the stage, or take more particles";
        self.refuse("rate", Problem::rule(found, expected), help)
    }
}

/// Mean diameter and density of the particles.
fn content(particles: &[Particle]) -> CellContent {
    let count = particles.len().max(1) as f64;
    let volume = |particle: &Particle| 4.0 / 3.0 * PI * powi(particle.radius, 3);
    CellContent {
        diameter: 2.0 * particles.iter().map(|particle| particle.radius).sum::<f64>() / count,
        density: particles.iter().map(|particle| particle.mass).sum::<f64>()
            / particles.iter().map(volume).sum::<f64>(),
    }
}
