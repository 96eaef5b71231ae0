//! Bonds in the engine: how they form and break, and what bodies of bonded spheres do.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::{RADIUS, advance, gravity, setup, sphere, start, vector};
use pulvis_contact::bond::{self, Bond};
use pulvis_contact::catalogue::Values;
use pulvis_contact::theory::bond::Beam;
use pulvis_contact::{ContactModel, Linear};
use pulvis_core::walls::Wall;
use pulvis_core::{
    Background, BondCount, Domain, InstructionSet, Interactions, Particle, Setup, Simulation, State,
};
use pulvis_math::{Vector3, elementary};

fn values(numbers: &[(&str, f64)]) -> Values {
    numbers.iter().fold(Values::new(), |values, (name, number)| values.with(name, *number))
}

fn build(values: &Values) -> Bond {
    bond::build("elastic-brittle", values).unwrap().unwrap().unwrap()
}

/// A contact of 1000 N/m with a bond.
fn bonded(values: &Values) -> ContactModel {
    let mut model = common::elastic();
    model.laws.bond = Some(build(values));
    model
}

/// A bond of all modes with a tensile strength [N].
fn brittle(strength: f64) -> Values {
    values(&[
        ("normal_stiffness", 1e3),
        ("shear_stiffness", 5e2),
        ("bending_stiffness", 5e-5),
        ("torsion_stiffness", 3e-5),
        ("tensile_strength", strength),
        ("shear_strength", strength),
        ("bending_strength", strength * RADIUS),
        ("distance", 1e-8),
    ])
}

/// The middle of a cube of spheres, close above a wall at z = 0 however it is turned.
fn middle(edge: usize) -> Vector3 {
    vector(0.0, 0.0, (1.75 * (edge - 1) as f64 + 1.2) * RADIUS)
}

/// A cube of touching spheres of `RADIUS` that flies at a wall, slightly turned and spinning.
fn clump(edge: usize, speed: f64) -> Vec<Particle> {
    let (axis, sine, cosine) = (vector(0.6, 0.48, 0.64), 0.5_f64.sin(), 0.5_f64.cos());
    let turn = |v: Vector3| v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine));
    let place = |index: usize| 2.0 * RADIUS * (index as f64 - 0.5 * (edge - 1) as f64);
    let middle = middle(edge);
    let mut particles = Vec::new();
    for number in 0..edge * edge * edge {
        let [x, y, z] = [number % edge, number / edge % edge, number / edge / edge].map(place);
        particles.push(sphere(middle + turn(vector(x, y, z)), vector(0.0, 0.0, -speed), RADIUS));
    }
    particles
}

fn thrown(edge: usize, model: ContactModel, steps_per_contact: f64) -> Simulation {
    let mut simulation =
        start(Setup { walls: vec![common::floor()], ..setup(clump(edge, 0.5), model) }, steps_per_contact);
    let pairs = 3 * edge * edge * (edge - 1);
    assert_eq!(simulation.form_bonds(), pairs as u64);
    assert_eq!(simulation.form_bonds(), 0, "they are bonded already");
    simulation
}

#[test]
fn a_clump_breaks_at_a_wall_and_the_ledger_closes() {
    // The impact lasts some contacts of the clump.
    let run = |steps: f64| {
        let mut simulation = thrown(4, bonded(&brittle(3e-3)), steps);
        let mut worst = 0.0_f64;
        for _ in 0..100 {
            advance(&mut simulation, steps as usize);
            worst = worst.max(simulation.ledger().relative_error().abs());
        }
        (simulation.bonds(), simulation.ledger(), worst)
    };
    let (bonds, ledger, error) = run(50.0);
    assert_eq!(bonds.intact + bonds.broken, 144);
    assert!(bonds.broken > 10 && bonds.intact > 10, "{bonds:?}");
    assert!(ledger.dissipated_fracture > 0.02 * ledger.initial, "{ledger:?}");
    assert!(ledger.elastic_bond > 0.0, "{ledger:?}");
    assert!(error < 2e-3, "{error}");
    // Which bonds break may differ; the error of the books is of second order, apart from that.
    let (_, _, finer) = run(200.0);
    assert!(finer < error / 6.0, "{error} {finer}");
}

#[test]
fn bonds_break_with_the_same_bits_for_any_threads_and_instructions() {
    let run = |threads: usize, instructions: InstructionSet| -> (State, BondCount) {
        let mut simulation = thrown(6, bonded(&brittle(3e-3)), 50.0);
        simulation.set_threads(threads).unwrap();
        simulation.set_instructions(instructions);
        advance(&mut simulation, 3000);
        (simulation.export_state(), simulation.bonds())
    };
    let (expected, bonds) = run(1, InstructionSet::available()[0]);
    assert!(bonds.broken > 10, "{bonds:?}");
    for instructions in InstructionSet::available() {
        for threads in [1, 3] {
            let (state, count) = run(threads, instructions);
            assert!(state == expected && count == bonds, "{threads} threads, {instructions}");
        }
    }
}

#[test]
fn an_exported_clump_goes_on_with_the_same_bits() {
    let model = bonded(&brittle(3e-3));
    let mut simulation = thrown(4, model, 50.0);
    advance(&mut simulation, 3000);
    assert!(simulation.bonds().broken > 0);
    let state = simulation.export_state();
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, model);
    let mut again = Simulation::import_state(interactions, vec![common::floor()], &state).unwrap();
    assert_eq!(again.bonds(), simulation.bonds());
    advance(&mut simulation, 1000);
    advance(&mut again, 1000);
    assert_eq!((again.export_state(), again.bonds()), (simulation.export_state(), simulation.bonds()));
}

#[test]
fn a_bond_that_broke_is_not_formed_again_when_bodies_meet_after_a_long_way() {
    for form in ["first-touch", "stage-start"] {
        let values = values(&[("normal_stiffness", 1e3), ("tensile_strength", 1e-3)]);
        let mut model = common::elastic();
        model.laws.bond = Some(build(&values.with_choice("form", form)));
        // Two spheres that touch, and part faster than their bond can bear: they meet again beyond the periodic boundary.
        let edge = 10.0 * RADIUS;
        let domain = Domain::periodic(Vector3::zero(), vector(edge, edge, edge), [true; 3]);
        let at =
            |x: f64, speed: f64| sphere(vector(x, 0.5 * edge, 0.5 * edge), vector(speed, 0.0, 0.0), RADIUS);
        let middle = 0.5 * edge;
        let pair = vec![at(middle - 0.9999 * RADIUS, -0.1), at(middle + 0.9999 * RADIUS, 0.1)];
        let mut simulation = start(Setup { domain, ..setup(pair, model) }, 50.0);
        let formed = simulation.form_bonds();
        assert_eq!(formed, u64::from(form == "stage-start"));
        let counts = |simulation: &Simulation| (simulation.bonds().intact, simulation.bonds().broken);
        assert_eq!(counts(&simulation), (1, 0), "{form}");
        advance(&mut simulation, 500);
        assert_eq!(counts(&simulation), (0, 1), "{form}");
        let rebuilds = simulation.rebuilds();
        // Until they have met and parted again, with the speed that they have left; restitution is 1.
        let mut met = false;
        for _ in 0..400 {
            advance(&mut simulation, 100);
            met |= simulation.particles().velocities()[simulation.particles().rows_by_id()[0]].x > 0.0;
            assert_eq!(counts(&simulation), (0, 1), "{form}");
            assert_eq!(simulation.form_bonds(), 0, "{form}");
        }
        assert!(met && simulation.rebuilds() > rebuilds + 2, "{form}: {met}");
        // A state keeps it, too.
        let state = simulation.export_state();
        let mut interactions = Interactions::new(1);
        interactions.set(0, 0, model);
        let again = Simulation::import_state(interactions, Vec::new(), &state).unwrap();
        assert_eq!(counts(&again), (0, 1), "{form}");
    }
}

#[test]
fn a_free_clump_keeps_its_momenta() {
    let model = bonded(&brittle(1e3));
    let mut particles = clump(3, 0.2);
    for (number, particle) in particles.iter_mut().enumerate() {
        let way = particle.position - middle(3);
        particle.velocity += vector(30.0, -20.0, 50.0).cross(way);
        particle.angular_velocity = vector(number as f64, 10.0, -5.0);
    }
    let mut simulation = start(setup(particles, model), 50.0);
    assert_eq!(simulation.form_bonds(), 54);
    let momenta = |simulation: &Simulation| {
        let particles = simulation.particles();
        let (mut linear, mut angular) = (Vector3::zero(), Vector3::zero());
        for row in 0..particles.len() {
            let mass = particles.masses()[row];
            let inertia = 0.4 * mass * RADIUS * RADIUS;
            linear += particles.velocities()[row] * mass;
            angular += particles.positions()[row].cross(particles.velocities()[row]) * mass;
            angular += particles.angular_velocities()[row] * inertia;
        }
        [linear, angular]
    };
    let before = momenta(&simulation);
    let error = common::advance_watching(&mut simulation, 5000, 10);
    for (now, before) in momenta(&simulation).into_iter().zip(before) {
        // Round-off of 5000 steps.
        assert!((now - before).norm() < 1e-11 * before.norm(), "{now:?} {before:?}");
    }
    assert_eq!(simulation.bonds().broken, 0);
    assert!(error < 1e-3, "{error}");
}

/// A row of spheres that touch, bonded to each other and to a wall at x = 0 by beams.
struct Row {
    simulation: Simulation,
    beam: Beam,
    /// Mass of a sphere [kg].
    mass: f64,
}

const CANTILEVER: Beam =
    Beam { length: 0.0, radius: 0.5e-3, young_modulus: 1e9, poisson_ratio: 0.25, shear_deforms: true };

impl Row {
    /// `speeds` are those across the row and about z, by the distance from the wall [m].
    fn new(count: usize, beam: Beam, background: Background, speeds: impl Fn(f64) -> [f64; 2]) -> Self {
        let theory = if beam.shear_deforms { "timoshenko" } else { "euler-bernoulli" };
        let values = values(&[
            ("young_modulus", beam.young_modulus),
            ("poisson_ratio", beam.poisson_ratio),
            ("bond_radius", beam.radius),
            ("tensile_strength", 10.0),
            ("distance", 1e-9),
        ])
        .with_choice("beam_theory", theory);
        let mut model = ContactModel::frictionless(Linear::new(f64::MIN_POSITIVE, 0.0));
        model.laws.bond = Some(build(&values));
        let radius = 1e-3;
        let at = |number: usize| (2 * number + 1) as f64 * radius;
        let particle = |number: usize| {
            let [speed, turning] = speeds(at(number));
            let mut particle = sphere(vector(at(number), 0.0, 0.0), vector(0.0, speed, 0.0), radius);
            particle.angular_velocity = vector(0.0, 0.0, turning);
            particle
        };
        let particles: Vec<Particle> = (0..count).map(particle).collect();
        let mass = particles[0].mass;
        let walls = vec![Wall::fixed("clamp", 0, Vector3::zero(), vector(1.0, 0.0, 0.0))];
        let mut simulation = start(Setup { walls, background, ..setup(particles, model) }, 20.0);
        assert_eq!(simulation.form_bonds(), count as u64);
        Self { simulation, beam: Beam { length: at(count - 1), ..beam }, mass }
    }

    /// Position of the last sphere across the row [m].
    fn tip(&self) -> f64 {
        let particles = self.simulation.particles();
        let last = particles.rows_by_id().len() - 1;
        particles.positions()[particles.rows_by_id()[last]].y
    }
}

#[test]
fn a_cantilever_of_bonded_spheres_bends_as_a_beam_under_its_weight() {
    let count = 10;
    for shear_deforms in [true, false] {
        let strength = 1e-3;
        // Drag that damps the slowest motion critically, about.
        let drag = 0.02;
        let background = Background { gravity: vector(0.0, -strength, 0.0), drag, ..gravity(0.0) };
        let beam = Beam { shear_deforms, ..CANTILEVER };
        let mut row = Row::new(count, beam, background, |_| [0.0; 2]);
        while row.simulation.time() < 0.06 {
            row.simulation.advance(1000).unwrap();
        }
        // Each weight at the distance x bends the beam up to there, and shears it: closed form of text books.
        let beam = row.beam;
        let (stiffness, weight) = (beam.young_modulus * beam.second_moment(), row.mass * strength);
        let shear = beam.shear_coefficient() * beam.shear_modulus() * beam.area();
        let deflection = |number: usize| {
            let x = (2 * number + 1) as f64 * 1e-3;
            let bending = weight * x * x * (3.0 * beam.length - x) / (6.0 * stiffness);
            bending + if shear_deforms { weight * x / shear } else { 0.0 }
        };
        let expected: f64 = (0..count).map(deflection).sum();
        let found = -row.tip();
        // What is left of the motion; the beam is straight to 1e-6 of its length.
        assert!((found / expected - 1.0).abs() < 1e-5, "{shear_deforms}: {found}, {expected}");
    }
}

#[test]
fn a_cantilever_of_bonded_spheres_has_the_frequency_of_a_beam() {
    // The mode of Euler and Bernoulli on the length 2 N a, of which each sphere is one piece: the error of lumping the
    // mass falls with the square of the number of pieces.
    let error = |count: usize| {
        let length = 2.0 * count as f64 * 1e-3;
        let beam = Beam { length, shear_deforms: false, ..CANTILEVER };
        let root = 1.875_104_068_711_961_2;
        let ratio = (elementary::cosh(root) + elementary::cos(root))
            / (elementary::sinh(root) + elementary::sin(root));
        let shape = |x: f64| {
            let z = root * x / length;
            let [hyperbolic, circular] = [elementary::cosh(z), elementary::cos(z)];
            let [hyperbolic_sine, sine] = [elementary::sinh(z), elementary::sin(z)];
            let across = hyperbolic - circular - ratio * (hyperbolic_sine - sine);
            let slope = (hyperbolic_sine + sine - ratio * (hyperbolic - circular)) * root / length;
            [across, slope].map(|part| 1e-6 * part)
        };
        let mut row = Row::new(count, beam, Background::default(), shape);
        let expected = beam.cantilever_frequency(row.mass / 2e-3);
        let (mut crossings, mut before) = (Vec::new(), row.tip());
        while crossings.len() < 4 {
            let time = row.simulation.time();
            row.simulation.step().unwrap();
            let now = row.tip();
            if before > 0.0 && now <= 0.0 {
                crossings.push(time + row.simulation.time_step() * before / (before - now));
            }
            before = now;
            assert!(time < 0.1, "no oscillation");
        }
        let period = (crossings[3] - crossings[0]) / 3.0;
        std::f64::consts::TAU / period / expected - 1.0
    };
    let (coarse, fine) = (error(5), error(10));
    assert!(fine.abs() < 1e-2 && fine.abs() < coarse.abs() / 3.0, "{coarse} {fine}");
}
