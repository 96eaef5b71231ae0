//! In what regime a stage will be: the dimensionless numbers of bulk experiments, before the first step.
//!
//! With the mean diameter d, the density of the particles ρ and the pressure p, f = π d² p/(φ Z) is the mean force of
//! contacts (Rumpf 1958; an identity for equal spheres at rest). φ Z = 3.6 is taken, a dense packing of six neighbours.
//!
//! # Source
//! p* = p d/k and I = γ̇ d √(ρ/p): GDR MiDi, Eur. Phys. J. E 14, 341 (2004). Bo = f_t/(p d²): H. Shi et al., Granular
//! Matter 22:14 (2020). t_c f_E: S. Luding and S. McNamara, Granular Matter 1, 113 (1998), with the collision rate of Enskog
//! and the g0 of Carnahan and Starling.

mod loading;
mod surroundings;

use std::f64::consts::PI;

use pulvis_contact::Partner;
use pulvis_input::collision::{Bodies, Sphere, luding_pair};
use pulvis_input::scenario::Scenario;
use pulvis_math::elementary;

use super::check::surroundings as contact_surroundings;
use super::feasible::start_stage;
use super::setup::Prepared;
use super::typical::TypicalBodies;
use loading::Loading;
use surroundings::{Sample, StageLoad};

/// Solid fraction times coordination number of a dense packing: 0.6 and 6.
const PHI_Z: f64 = 3.6;

/// Fewer particles are no bulk.
const BULK: usize = 30;

/// What presses the particles, or drives them.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// How much: a pressure [Pa] or a rate of strain [1/s].
    pub value: f64,
    /// What it comes from, in words.
    pub from: String,
}

/// In what regime a stage will be.
#[derive(Clone, Debug, PartialEq)]
pub struct StageRegime {
    /// Name of the stage.
    pub stage: String,
    /// The largest pressure on the particles [Pa].
    pub pressure: Option<Cause>,
    /// The largest rate at which they are strained [1/s].
    pub rate: Option<Cause>,
    /// Inertial number I of that rate under that pressure [1].
    pub inertial_number: Option<f64>,
    /// Whether grains can slide or roll on each other only against a force: packings without friction are quasi-static at
    /// a tenth of the rate.
    pub frictional: bool,
    /// The contacts between particles, one for each pair of materials.
    pub contacts: Vec<ContactRegime>,
}

/// In what regime contacts between particles of mean size will be.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactRegime {
    /// The materials.
    pub between: String,
    /// Softness p* = p d/k, k the stiffness between no force and the mean force; infinite where that force is beyond
    /// what a pair contact carries [1].
    pub softness: Option<f64>,
    /// Bond number Bo = f_t/(p d²), f_t the force that parts a contact which has carried the mean force [1].
    pub bond_number: Option<f64>,
    /// Place on the law, X = δ/δ_p at the mean force; Luding law only [1].
    pub plastic_depth: Option<f64>,
    /// Contact time over the time between collisions, t_c f_E; of a gas only [1].
    pub contact_time_share: Option<f64>,
}

impl StageRegime {
    /// I below which a stage is quasi-static.
    ///
    /// # Source
    /// GDR MiDi 2004 with friction; P.-E. Peyneau and J.-N. Roux, Phys. Rev. E 78, 011307 (2008) without.
    pub fn quasi_static_below(&self) -> f64 {
        if self.frictional { 1e-3 } else { 1e-4 }
    }
}

/// The regimes of all stages in which something presses or drives the particles, or in which they are a gas.
/// Particles are those of the start: what inlets will bring, and what programs will change, is left out.
pub(super) fn regimes(scenario: &Scenario, prepared: &Prepared) -> Vec<StageRegime> {
    let Prepared { simulation, stages: plans, particles, .. } = prepared;
    if particles.len() < BULK {
        return Vec::new();
    }
    let sample = Sample::of(scenario, particles, simulation.domain());
    // A run before may have moved, driven or removed walls, and deformed the cell.
    let mut walls = simulation.walls().to_vec();
    let mut cell = *simulation.cell_motion();
    let mut found = Vec::new();
    for (number, (stage, plan)) in scenario.stages.iter().zip(plans).enumerate() {
        start_stage(walls.iter_mut(), stage);
        cell = stage.cell.unwrap_or(cell);
        let load = StageLoad { sample: &sample, walls: &walls, cell: &cell, stage, plan };
        let (pressure, rate) = (load.pressure(), load.rate());
        let gas = if number == 0 && pressure.is_none() { sample.gas() } else { None };
        let contacts: Vec<ContactRegime> = stage
            .contacts
            .iter()
            .filter_map(|contact| {
                let bodies = TypicalBodies::of(scenario, particles, contact.materials)?;
                let Partner::Sphere { mass, radius } = bodies.partner else { return None };
                let around = contact_surroundings(scenario, contact, false).ok()?;
                let spheres =
                    [Sphere { mass: bodies.body.0, radius: bodies.body.1 }, Sphere { mass, radius }];
                let bodies = Bodies::Pair(spheres);
                // A path without times says nothing of a normal law that depends on them; dashpots see no motion on it.
                if contact.model.normal.depends_on_time() {
                    return None;
                }
                let loading = Loading { contact: &contact.model, bodies, surroundings: &around };
                let between = contact.materials.map(|material| scenario.materials[material].name.as_str());
                let regime = of_contact(&loading, pressure.as_ref().map(|cause| cause.value), gas);
                Some(ContactRegime { between: between.join("-"), ..regime })
            })
            .filter(ContactRegime::says_something)
            .collect();
        let inertial_number = pressure
            .as_ref()
            .zip(rate.as_ref())
            .map(|(pressure, rate)| rate.value * sample.diameter * (sample.density / pressure.value).sqrt());
        if inertial_number.is_some() || !contacts.is_empty() {
            let frictional = stage.contacts.iter().any(|contact| contact.model.laws.has_friction());
            let stage = stage.name.clone();
            found.push(StageRegime { stage, pressure, rate, inertial_number, frictional, contacts });
        }
    }
    found
}

impl ContactRegime {
    fn says_something(&self) -> bool {
        self.softness.is_some() || self.contact_time_share.is_some()
    }
}

fn of_contact(loading: &Loading<'_>, pressure: Option<f64>, gas: Option<Gas>) -> ContactRegime {
    let pair = loading.bodies.pair();
    let [one, other] = loading.bodies.radii();
    let diameter = one + other;
    let mut regime = ContactRegime {
        between: String::new(),
        softness: None,
        bond_number: None,
        plastic_depth: None,
        contact_time_share: gas.and_then(|gas| {
            let speed = gas.collision_speed();
            let overlap = loading.to_energy(0.5 * pair.reduced_mass() * speed * speed)?;
            // That of a linear spring, and within 7 % of a Hertzian one.
            Some(PI * overlap / speed * gas.collision_rate(diameter))
        }),
    };
    let Some(pressure) = pressure else { return regime };
    let force = PI * diameter * diameter * pressure / PHI_Z;
    let Some(loaded) = loading.to_force(force) else {
        return ContactRegime { softness: Some(f64::INFINITY), ..regime };
    };
    regime.softness = Some(pressure * diameter * loaded.compression / force);
    regime.bond_number = Some(loaded.pull_off / (pressure * diameter * diameter));
    regime.plastic_depth = luding_pair(loading.contact, &pair)
        .filter(|theory| theory.eta() > 0.0)
        .map(|theory| loaded.overlap / theory.dp());
    regime
}

/// Particles that fly and collide.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Gas {
    /// Mean square of a component of the velocities about their mean [m²/s²].
    temperature: f64,
    /// Solid fraction [1].
    solid_fraction: f64,
}

impl Gas {
    /// Mean normal speed of spheres of one size that collide, √(π T) [m/s].
    fn collision_speed(&self) -> f64 {
        (PI * self.temperature).sqrt()
    }

    /// Collisions of a particle of this diameter [m] in a second, 24 φ g0 √(T/π)/d.
    fn collision_rate(&self, diameter: f64) -> f64 {
        let phi = self.solid_fraction;
        let crowding = (1.0 - 0.5 * phi) / elementary::powi(1.0 - phi, 3);
        24.0 * phi * crowding * (self.temperature / PI).sqrt() / diameter
    }
}

#[cfg(test)]
mod tests;
