//! An inlet under way.

use pulvis_boundary::{Domain, Region};
use pulvis_core::walls::Wall;
use pulvis_core::{MaterialIndex, NamedColumn, Particle, Simulation};
use pulvis_input::scenario::{Amount, Inlet as InletScenario, Scenario};
use pulvis_math::Vector3;
use pulvis_packing::{Inlet, InletPlan, OccupiedSpace, Room};

use super::{Clock, InletError, Passage};

/// How many intervals a particle waits for room where nothing is said.
const DELAYS: f64 = 20.0;

/// An inlet under way.
#[derive(Clone, Debug)]
pub(super) struct Feed {
    pub(super) plan: InletScenario,
    pub(super) inlet: Inlet,
    /// Time between two instants at which particles come in [s].
    pub(super) interval: f64,
    /// How long a particle may wait for room [s].
    max_delay: f64,
    pub(super) clock: Clock,
    pub(super) passage: Passage,
}

/// What an inlet of a scenario brings in.
pub(super) fn plan_of(scenario: &Scenario, index: usize) -> InletPlan {
    let inlet = &scenario.inlets[index];
    InletPlan {
        region: inlet.region,
        rate: inlet.rate,
        total: inlet.total,
        radius: inlet.radius.clone(),
        density: scenario.materials[inlet.material].density.unwrap_or(f64::NAN),
        velocity: inlet.velocity,
        standard_deviation: inlet.standard_deviation,
        seed: inlet.seed.unwrap_or(scenario.seed),
        // Stream 0 is that of the initial packing.
        stream: index as u64 + 1,
    }
}

impl Feed {
    /// `None` for a plan that has been refused before.
    pub(super) fn new(scenario: &Scenario, index: usize) -> Option<Self> {
        let plan = scenario.inlets[index].clone();
        let domain = scenario.domain.unwrap_or(Domain::unbounded());
        let inlet = Inlet::new(plan_of(scenario, index), &domain).ok()?;
        let interval = plan.interval.unwrap_or_else(|| interval_of(scenario, index));
        Some(Self {
            inlet,
            interval,
            max_delay: plan.max_delay.unwrap_or(DELAYS * interval),
            clock: Clock::SHUT,
            passage: Passage::new(&plan.size_classes),
            plan,
        })
    }

    pub(super) fn enter_stage(&mut self, stage: &str, time: f64) {
        self.clock.set(self.plan.schedule.takes_in(stage), &self.plan.schedule, time);
        self.passage.mark();
    }

    pub(super) fn steps_left(&self, simulation: &Simulation) -> u64 {
        if self.inlet.is_exhausted() {
            return u64::MAX;
        }
        self.clock.steps_left(&self.plan.schedule, self.interval, simulation)
    }

    /// Brings in what is due, if it is time.
    pub(super) fn act(&mut self, simulation: &mut Simulation) -> Result<(), InletError> {
        if self.inlet.is_exhausted() || !self.clock.now(&self.plan.schedule, self.interval, simulation) {
            return Ok(());
        }
        let open = self.clock.open_time(&self.plan.schedule, simulation.time());
        if !self.inlet.is_due(open) {
            return Ok(());
        }
        let domain = *simulation.domain();
        if domain.is_tilted() {
            return Err(InletError::Tilted { name: self.plan.name.clone() });
        }
        let (_, largest) = self.plan.radius.limits();
        let mut room = Free::around(simulation, &self.plan.region, largest);
        let spheres = self.inlet.supply(open, &domain, &mut room);
        let particles: Vec<Particle> = spheres
            .into_iter()
            .map(|sphere| Particle {
                material: self.plan.material as MaterialIndex,
                radius: sphere.radius,
                mass: sphere.mass,
                position: sphere.position,
                velocity: sphere.velocity,
                angular_velocity: self.plan.angular_velocity,
            })
            .collect();
        let columns = self.columns(simulation, particles.len());
        let inserted = simulation.insert_with(&particles, &columns);
        inserted.map_err(|source| InletError::Refused { name: self.plan.name.clone(), source })?;
        particles.iter().for_each(|particle| self.passage.add(particle));
        self.check_delay(open, simulation.time())
    }

    /// The further quantities of particles that come in, as those that are there have them.
    fn columns(&self, simulation: &Simulation, count: usize) -> Vec<NamedColumn> {
        let columns = simulation.particles().columns().iter();
        let value = |name: &str| {
            let own = self.plan.columns.iter().find(|own| own.name == name);
            own.map_or(f64::NAN, |own| own.value)
        };
        columns
            .map(|column| NamedColumn {
                name: column.name.clone(),
                unit: column.unit.clone(),
                values: vec![value(&column.name); count],
            })
            .collect()
    }

    /// Refuses to go on where a particle has waited too long.
    fn check_delay(&self, open: f64, time: f64) -> Result<(), InletError> {
        let waiting = self.inlet.delay(open);
        if waiting == 0.0 {
            return Ok(());
        }
        // After the end of its time a particle still waits.
        let delay = waiting + (time - self.plan.schedule.stop).max(0.0);
        if delay <= self.max_delay {
            return Ok(());
        }
        let state = self.inlet.state();
        let due = match self.plan.rate {
            Amount::Number(rate) => format!("{:.0} particles", (rate * open).floor()),
            Amount::Mass(rate) => format!("{:.4e} kg", rate * open),
        };
        Err(InletError::Late {
            name: self.plan.name.clone(),
            radius: state.next_radius.unwrap_or(f64::NAN),
            delay,
            max_delay: self.max_delay,
            number: state.number,
            mass: state.mass,
            due,
        })
    }
}

/// The time in which the largest particle leaves its place at the mean velocity, or by falling, or the time from one particle to
/// the next, whichever is longer [s]: then there is new room, and a neighbour list is rebuilt no oftener than that.
fn interval_of(scenario: &Scenario, index: usize) -> f64 {
    let plan = plan_of(scenario, index);
    let (smallest, largest) = plan.radius.limits();
    let middle = 0.5 * (smallest + largest);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * middle * middle * middle;
    let between = match plan.rate {
        Amount::Number(rate) => 1.0 / rate,
        Amount::Mass(rate) => volume * plan.density / rate,
    };
    let stages = scenario.stages.iter().filter(|stage| scenario.inlets[index].schedule.takes_in(&stage.name));
    let gravity = stages.map(|stage| stage.background.gravity.norm()).fold(0.0, f64::max);
    let speed = plan.velocity.norm() + plan.standard_deviation;
    // d = v t + g t²/2, written so that neither may be zero.
    let leaving = 4.0 * largest / (speed + (speed * speed + 4.0 * gravity * largest).sqrt());
    if leaving.is_finite() { leaving.max(between) } else { between }
}

/// Where particles and walls leave room.
pub(super) struct Free<'a> {
    occupied: OccupiedSpace,
    walls: Vec<&'a Wall>,
}

impl<'a> Free<'a> {
    /// The room in and about a region for spheres up to a radius [m].
    fn around(simulation: &'a Simulation, region: &Region, largest: f64) -> Self {
        let (particles, domain) = (simulation.particles(), simulation.domain());
        let [lower, upper] = region.bounds();
        let near = |position: Vector3, radius: f64| {
            let reach = radius + largest;
            (0..3).all(|axis| {
                let at = position[axis];
                domain.period(axis).is_some() || (at + reach >= lower[axis] && at - reach <= upper[axis])
            })
        };
        let spheres = particles.positions().iter().zip(particles.radii().iter().copied());
        let near: Vec<(Vector3, f64)> =
            spheres.filter(|(position, radius)| near(*position, *radius)).collect();
        let widest = near.iter().map(|(_, radius)| *radius).fold(largest, f64::max);
        let mut occupied = OccupiedSpace::new(2.0 * widest, *domain);
        near.into_iter().for_each(|(position, radius)| occupied.add(position, radius));
        Self { occupied, walls: simulation.walls().iter().filter(|wall| wall.present).collect() }
    }
}

impl Room for Free<'_> {
    fn is_free(&self, centre: Vector3, radius: f64) -> bool {
        self.walls.iter().all(|wall| wall.distance(centre) >= radius) && self.occupied.is_free(centre, radius)
    }

    fn take(&mut self, centre: Vector3, radius: f64) {
        self.occupied.add(centre, radius);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn the_interval_is_the_time_in_which_a_particle_has_left_its_place() {
        let text = include_str!("../../../../pulvis-input/tests/good/inlets.toml");
        let mut scenario = Scenario::from_str("inlets.toml", text).unwrap();
        let index = scenario.inlets.iter().position(|inlet| inlet.name == "jet").unwrap();
        let (_, radius) = scenario.inlets[index].radius.limits();
        scenario.inlets[index].rate = Amount::Number(1e9);
        let plan = &mut scenario.inlets[index];
        (plan.velocity, plan.standard_deviation) = (Vector3::new(0.0, 2.0, 0.0), 0.0);
        let set_gravity = |scenario: &mut Scenario, g: f64| {
            for stage in &mut scenario.stages {
                stage.background.gravity = Vector3::new(0.0, 0.0, -g);
            }
        };
        set_gravity(&mut scenario, 0.0);
        assert!((interval_of(&scenario, index) / (2.0 * radius / 2.0) - 1.0).abs() < 1e-12);
        set_gravity(&mut scenario, 9.81);
        let time = interval_of(&scenario, index);
        assert!(((2.0 * time + 0.5 * 9.81 * time * time) / (2.0 * radius) - 1.0).abs() < 1e-12);
        scenario.inlets[index].velocity = Vector3::zero();
        assert!((interval_of(&scenario, index) / (4.0 * radius / 9.81).sqrt() - 1.0).abs() < 1e-12);
        set_gravity(&mut scenario, 0.0);
        assert_eq!(interval_of(&scenario, index), 1e-9);
    }
}
