//! What presses particles and what drives them, as far as it is known before the run.

use pulvis_boundary::{Domain, WallShape};
use pulvis_core::Particle;
use pulvis_core::walls::Wall;
use pulvis_input::scenario::{CellMotion, Scenario, Stage};
use pulvis_math::{Vector3, max_or_nan};

use super::super::feasible::highest_pressure;
use super::super::setup::StagePlan;
use super::{Cause, Gas};

/// Solid fractions that gases have.
const GAS: f64 = 0.5;

/// The particles as a whole, at the start.
pub(super) struct Sample {
    /// Mean diameter [m].
    pub(super) diameter: f64,
    /// Density of the particles [kg/m³].
    pub(super) density: f64,
    /// Mass of all [kg].
    mass: f64,
    /// What they take up: the box, the periodic cell, or as far as they reach [m].
    extent: Vector3,
    /// Whether walls or periods close that on all sides.
    closed: bool,
    /// Volume of the particles [m³].
    volume: f64,
    /// Mean square of a component of the velocities about their mean [m²/s²].
    temperature: f64,
}

impl Sample {
    pub(super) fn of(scenario: &Scenario, particles: &[Particle], domain: &Domain) -> Self {
        let count = particles.len() as f64;
        let sum = |of: &dyn Fn(&Particle) -> f64| particles.iter().map(of).sum::<f64>();
        let ball = |radius: f64| 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
        let (mass, volume) = (sum(&|particle| particle.mass), sum(&|particle| ball(particle.radius)));
        let mean =
            particles.iter().fold(Vector3::zero(), |sum, particle| sum + particle.velocity) * (1.0 / count);
        let temperature = sum(&|particle| (particle.velocity - mean).norm_squared()) / (3.0 * count);
        let (extent, closed) = extent(scenario, particles, domain);
        let diameter = 2.0 * sum(&|particle| particle.radius) / count;
        Self { diameter, density: mass / volume, mass, extent, closed, volume, temperature }
    }

    /// The particles as a gas, if they fly in a closed volume.
    pub(super) fn gas(&self) -> Option<Gas> {
        let solid_fraction = self.volume / (self.extent.x * self.extent.y * self.extent.z);
        let flies = self.closed && self.temperature > 0.0 && solid_fraction < GAS;
        flies.then_some(Gas { temperature: self.temperature, solid_fraction })
    }
}

/// Lengths along x, y and z, and whether they are those of walls or periods.
fn extent(scenario: &Scenario, particles: &[Particle], domain: &Domain) -> (Vector3, bool) {
    let mut lengths = [0.0; 3];
    for (axis, length) in lengths.iter_mut().enumerate() {
        let ends = particles.iter().map(|particle| {
            let [at, radius] = [particle.position[axis], particle.radius];
            [at - radius, at + radius]
        });
        let reach = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [start, end]| {
            [low.min(start), high.max(end)]
        });
        *length = match (domain.period(axis), scenario.enclosure) {
            (Some(period), _) => period,
            (None, Some(enclosure)) => enclosure.size()[axis],
            (None, None) => reach[1] - reach[0],
        };
    }
    let closed = scenario.enclosure.is_some() || domain.periodic == [true; 3];
    (Vector3::from(lengths), closed)
}

/// What acts on the particles in a stage.
pub(super) struct StageLoad<'a> {
    pub(super) sample: &'a Sample,
    /// The walls as the stage moves them.
    pub(super) walls: &'a [Wall],
    pub(super) cell: &'a CellMotion,
    pub(super) stage: &'a Stage,
    pub(super) plan: &'a StagePlan,
}

impl StageLoad<'_> {
    /// The largest pressure [Pa].
    pub(super) fn pressure(&self) -> Option<Cause> {
        let of_cell = Cause { value: self.cell.largest_target(), from: "of the cell".to_owned() };
        let of_walls = self.present_walls().filter_map(|wall| {
            let value = highest_pressure(&wall.motion, &self.stage.until)?;
            Some(Cause { value, from: format!("of the wall {}", wall.name) })
        });
        largest(of_walls.chain([of_cell]).chain(self.weight()))
    }

    /// The weight of all particles on the ground that they take up, which is what lies under a bed.
    fn weight(&self) -> Option<Cause> {
        let gravity = self.plan.background.gravity;
        let along = dominant_axis(gravity);
        let extent = self.sample.extent;
        let ground = extent[(along + 1) % 3] * extent[(along + 2) % 3];
        // Without a floor nothing is pressed.
        self.present_walls().next().map(|_| Cause {
            value: gravity.norm() * self.sample.mass / ground,
            from: "under the weight of all particles".to_owned(),
        })
    }

    /// The largest rate of strain [1/s].
    pub(super) fn rate(&self) -> Option<Cause> {
        let prescribed = self.cell.prescribed().to_array();
        let of_cell = Cause {
            value: prescribed.iter().fold(0.0, |most, rate| max_or_nan(most, rate.abs())),
            from: "of the cell".to_owned(),
        };
        let of_walls = self.present_walls().filter_map(|wall| {
            let WallShape::Plane(plane) = &wall.shape else { return None };
            let across = self.sample.extent[dominant_axis(plane.normal)];
            let value = wall.motion.law().highest_speed() / across;
            Some(Cause { value, from: format!("of the wall {}", wall.name) })
        });
        largest(of_walls.chain([of_cell]))
    }

    fn present_walls(&self) -> impl Iterator<Item = &Wall> {
        self.walls.iter().filter(|wall| wall.present)
    }
}

/// The largest of those that are positive.
fn largest(causes: impl Iterator<Item = Cause>) -> Option<Cause> {
    let positive = causes.filter(|cause| cause.value > 0.0 && cause.value.is_finite());
    positive.reduce(|most, next| if next.value > most.value { next } else { most })
}

fn dominant_axis(direction: Vector3) -> usize {
    let along = |axis: usize| direction[axis].abs();
    (1..3).fold(0, |most, axis| if along(axis) > along(most) { axis } else { most })
}
