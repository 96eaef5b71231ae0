//! Systems that several tests start from.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_boundary::Cuboid;
use pulvis_contact::normal::Interpolation;
use pulvis_contact::viscosity::{Constant, Viscosity};
use pulvis_contact::{ContactModel, Friction, Linear, Luding, SpringSlider};
use pulvis_core::walls::Wall;
use pulvis_core::{Background, Domain, Interactions, Particle, Setup, Simulation, shortest_contact};
use pulvis_math::{Vector3, max_or_nan};
use pulvis_packing::{gaussian_vector, random_positions, random_stream};

pub const RADIUS: f64 = 0.5e-3;

pub fn vector(x: f64, y: f64, z: f64) -> Vector3 {
    Vector3::new(x, y, z)
}

/// A sphere of 2500 kg/m³ without angular velocity.
pub fn sphere(position: Vector3, velocity: Vector3, radius: f64) -> Particle {
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 2500.0 * radius.powi(3);
    Particle { material: 0, radius, mass, position, velocity, angular_velocity: Vector3::zero() }
}

/// An elastic contact of 1000 N/m.
pub fn elastic() -> ContactModel {
    ContactModel::frictionless(Linear::new(1000.0, 0.0))
}

pub fn slider(stiffness: f64, dashpot: f64, coefficient: f64) -> Friction {
    let (dynamic_coefficient, static_coefficient) = (coefficient, coefficient);
    SpringSlider { stiffness, dashpot, dynamic_coefficient, static_coefficient }.into()
}

/// A Luding contact with sliding, rolling and torsion, without dashpots. At 0.2 m/s two spheres of
/// `RADIUS` come about half-way to the plastic limit.
pub fn luding() -> ContactModel {
    let interpolation = Interpolation::Linear;
    let mut model =
        ContactModel::frictionless(Luding { k1: 100.0, kp: 500.0, kc: 100.0, phi_f: 0.05, interpolation });
    model.laws.sliding = Some(slider(100.0, 0.0, 0.5));
    model.laws.rolling = Some(slider(50.0, 0.0, 0.1));
    model.laws.torsion = Some(slider(50.0, 0.0, 0.1));
    model
}

/// The same with all dashpots, at some percent of critical.
pub fn viscous_luding() -> ContactModel {
    let mut model = luding();
    model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: 2e-3 });
    model.laws.sliding = Some(slider(100.0, 4e-4, 0.5));
    model.laws.rolling = Some(slider(50.0, 2e-4, 0.1));
    model.laws.torsion = Some(slider(50.0, 2e-4, 0.1));
    model
}

/// Particles of one model in open space; walls are made of the same. The time step is one second:
/// to be set.
pub fn setup(particles: Vec<Particle>, model: ContactModel) -> Setup {
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, model);
    let (domain, background) = (Domain::unbounded(), Background::default());
    Setup { particles, interactions, walls: Vec::new(), domain, background, time_step: 1.0 }
}

/// The shortest contact of the system [s].
pub fn contact_time(setup: &Setup) -> f64 {
    shortest_contact(&setup.particles, &setup.interactions, &setup.walls).unwrap().duration
}

/// Starts the system with so many steps for its shortest contact.
pub fn start(mut setup: Setup, steps_per_contact: f64) -> Simulation {
    setup.time_step = contact_time(&setup) / steps_per_contact;
    Simulation::new(setup).unwrap()
}

pub fn advance(simulation: &mut Simulation, steps: usize) {
    for _ in 0..steps {
        simulation.step().unwrap();
    }
}

/// Advances and answers with the largest closing error on the way, over the ledger's scale at the end:
/// a system that starts from rest has no scale of its own at first.
pub fn advance_watching(simulation: &mut Simulation, steps: usize, every: usize) -> f64 {
    let mut worst = 0.0_f64;
    for step in 1..=steps {
        simulation.step().unwrap();
        if step % every == 0 || step == steps {
            worst = max_or_nan(worst, simulation.ledger().closing_error().abs());
        }
    }
    let scale = simulation.ledger().scale;
    if scale == 0.0 { worst } else { worst / scale }
}

/// Frictionless undamped spheres at a solid fraction of 0.2 in a periodic cube, 0.1 m/s a component.
pub fn elastic_gas(count: usize) -> Setup {
    let volume = count as f64 * 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3);
    let edge = (volume / 0.2).cbrt();
    let upper = vector(edge, edge, edge);
    let domain = Domain::periodic(Vector3::zero(), upper, [true; 3]);
    let region = Cuboid { lower: Vector3::zero(), upper };
    let mut random = random_stream(11);
    let places = random_positions(&vec![RADIUS; count], &region, &domain, &[], &mut random).unwrap();
    let moving = |place| sphere(place, gaussian_vector(&mut random) * 0.1, RADIUS);
    Setup { domain, ..setup(places.into_iter().map(moving).collect(), elastic()) }
}

/// Spheres of radii 0.7 to 1.3 `RADIUS` at random places in the cube from 0 to `edge`, which fall
/// towards its middle, angular velocity and jitter.
pub fn implosion(count: usize, edge: f64, seed: u64, model: ContactModel) -> Setup {
    let mut random = random_stream(seed);
    let radii: Vec<f64> =
        (0..count).map(|place| RADIUS * (0.7 + 0.6 * place as f64 / (count - 1).max(1) as f64)).collect();
    let region = Cuboid { lower: Vector3::zero(), upper: vector(edge, edge, edge) };
    let places = random_positions(&radii, &region, &Domain::unbounded(), &[], &mut random).unwrap();
    let middle = vector(0.5 * edge, 0.5 * edge, 0.5 * edge);
    let falling = |(place, radius): (Vector3, f64)| {
        let inwards = (middle - place) * (0.6 / edge);
        let mut particle = sphere(place, inwards + gaussian_vector(&mut random) * 0.05, radius);
        particle.angular_velocity = gaussian_vector(&mut random) * 100.0;
        particle
    };
    setup(places.into_iter().zip(radii).map(falling).collect(), model)
}

/// Six fixed walls of material 0 around the cube from 0 to `edge`: below and above x, y, z.
pub fn cube_of_walls(edge: f64) -> Vec<Wall> {
    let axes = [vector(1.0, 0.0, 0.0), vector(0.0, 1.0, 0.0), vector(0.0, 0.0, 1.0)];
    axes.into_iter()
        .flat_map(|axis| {
            [
                Wall::fixed("low", 0, Vector3::zero(), axis),
                Wall::fixed("high", 0, vector(edge, edge, edge), -axis),
            ]
        })
        .collect()
}

/// A floor at z = 0, of material 0.
pub fn floor() -> Wall {
    Wall::fixed("floor", 0, Vector3::zero(), vector(0.0, 0.0, 1.0))
}

pub fn gravity(strength: f64) -> Background {
    Background { gravity: vector(0.0, 0.0, -strength), ..Background::default() }
}

/// How a particle lies and moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    pub position: Vector3,
    pub velocity: Vector3,
    pub angular_velocity: Vector3,
}

/// All particles in the order of their ids.
pub fn states(simulation: &Simulation) -> Vec<State> {
    let particles = simulation.particles();
    let state = |row: usize| State {
        position: particles.positions()[row],
        velocity: particles.velocities()[row],
        angular_velocity: particles.angular_velocities()[row],
    };
    particles.rows_by_id().into_iter().map(state).collect()
}

/// The largest difference of two systems: of positions over the radius, of velocities over 1 m/s and
/// of angular velocities over 1 m/s per radius. Positions are compared up to whole periods.
pub fn difference(domain: &Domain, these: &[State], those: &[State]) -> f64 {
    assert_eq!(these.len(), those.len());
    let nearest = |mut separation: Vector3| {
        for axis in 0..3 {
            if let Some(period) = domain.period(axis) {
                *separation.component_mut(axis) -= (separation[axis] / period).round() * period;
            }
        }
        separation
    };
    let one = |(this, that): (&State, &State)| {
        let position = nearest(this.position - that.position).norm() / RADIUS;
        let velocity = (this.velocity - that.velocity).norm();
        let angular_velocity = (this.angular_velocity - that.angular_velocity).norm() * RADIUS;
        max_or_nan(max_or_nan(position, velocity), angular_velocity)
    };
    these.iter().zip(those).map(one).fold(0.0, max_or_nan)
}

/// Sum of the sizes of all momenta [kg m/s].
pub fn momentum_scale(simulation: &Simulation) -> f64 {
    let particles = simulation.particles();
    particles
        .masses()
        .iter()
        .zip(particles.velocities().iter())
        .map(|(mass, velocity)| mass * velocity.norm())
        .sum()
}

/// The slope of log(error) over log(step) from the first to the last, each step half the one before.
pub fn order(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

/// All particles of a system.
pub type States = Vec<State>;

/// The same as [`difference`] in a cell that may be tilted, and up to a shift of all positions: of the way from the first
/// particle to every other one.
pub fn difference_in(domain: &Domain, these: &[State], those: &[State]) -> f64 {
    assert_eq!(these.len(), those.len());
    let images = domain.images();
    let one = |(this, that): (&State, &State)| {
        let ways = (this.position - these[0].position) - (that.position - those[0].position);
        // Both may be several images apart.
        let turns = domain.edges().inverse().times(ways).to_array().map(f64::round);
        let position = images.nearest(ways - domain.edges().times(Vector3::from(turns))).norm() / RADIUS;
        let velocity = (this.velocity - that.velocity).norm();
        let angular_velocity = (this.angular_velocity - that.angular_velocity).norm() * RADIUS;
        max_or_nan(max_or_nan(position, velocity), angular_velocity)
    };
    these.iter().zip(those).map(one).fold(0.0, max_or_nan)
}

/// Radii from 0.15 to 1.5 `RADIUS`, most of them small, in a box that is periodic along x, where everything flies
/// `along` it [m/s], and closed by walls elsewhere.
pub fn wide_distribution(count: u32, edge: f64, along: f64) -> Setup {
    let upper = vector(edge, edge, edge);
    let rank = |number: u32| f64::from(number) / f64::from(count - 1);
    let radii: Vec<f64> =
        (0..count).map(|number| 1.5 * RADIUS * 10.0_f64.powf(-rank(number).powf(0.25))).collect();
    let domain = Domain::periodic(Vector3::zero(), upper, [true, false, false]);
    let mut random = random_stream(7);
    let block = Cuboid { lower: Vector3::zero(), upper };
    let centres = random_positions(&radii, &block, &domain, &[], &mut random).unwrap();
    let falling = |(centre, radius): (Vector3, f64)| {
        let mut inwards = (upper * 0.5 - centre) * (2.0 / edge);
        inwards.x = along;
        let mut particle = sphere(centre, inwards + gaussian_vector(&mut random) * 0.2, radius);
        particle.angular_velocity = gaussian_vector(&mut random) * 200.0;
        particle
    };
    let particles = centres.into_iter().zip(radii).map(falling).collect();
    let walls = cube_of_walls(edge).split_off(2);
    Setup { domain, walls, ..setup(particles, viscous_luding()) }
}
