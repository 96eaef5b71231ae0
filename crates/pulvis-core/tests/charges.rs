//! Charges that act on each other over all distances, against closed forms and a plain sum.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use std::f64::consts::{FRAC_PI_4, PI, SQRT_2, TAU};

use common::*;
use pulvis_boundary::motion::Velocity;
use pulvis_contact::NonContact;
use pulvis_contact::catalogue::Values;
use pulvis_core::{
    Domain, Electrostatics, GroupMotion, InstructionSet, MotionKind, NamedColumn, Particle, Setup,
    Simulation, shortest_motion_of_charges,
};
use pulvis_math::Vector3;

/// 1/(4 π ε_0) [N m²/C²].
const COULOMB_CONSTANT: f64 = 8.987_551_792_3e9;
const CHARGE: f64 = 1e-11;
/// Of the pairs [m].
const DISTANCE: f64 = 20.0 * RADIUS;

fn charges(values: Vec<f64>) -> Vec<NamedColumn> {
    vec![NamedColumn { name: "charge".to_owned(), unit: "C".to_owned(), values }]
}

fn with_electrostatics(mut setup: Setup, relative_permittivity: f64) -> Setup {
    setup.interactions.set_electrostatics(Some(Electrostatics { relative_permittivity }));
    setup
}

/// Particles with charges in a medium, with this time step.
fn charged(particles: Vec<Particle>, values: Vec<f64>, permittivity: f64, time_step: f64) -> Simulation {
    let setup = with_electrostatics(setup(particles, elastic()), permittivity);
    Simulation::with_columns(Setup { time_step, ..setup }, charges(values)).unwrap()
}

fn at(x: f64, y: f64, z: f64) -> Particle {
    sphere(vector(x, y, z), Vector3::zero(), RADIUS)
}

/// Two particles at the ends of [`DISTANCE`] with opposite charges, in the system of their centre of mass; the second with half of
/// this relative velocity.
fn pair(velocity: Vector3, permittivity: f64, time_step: f64) -> Simulation {
    let half = vector(0.5 * DISTANCE, 0.0, 0.0);
    let particles = vec![sphere(half, velocity * 0.5, RADIUS), sphere(-half, velocity * -0.5, RADIUS)];
    charged(particles, vec![CHARGE, -CHARGE], permittivity, time_step)
}

/// K/μ of the pair in a vacuum: relative acceleration times distance squared [m³/s²].
fn strength() -> f64 {
    COULOMB_CONSTANT * CHARGE * CHARGE / (0.5 * at(0.0, 0.0, 0.0).mass)
}

fn between(pair: &Simulation) -> Vector3 {
    let states = states(pair);
    states[0].position - states[1].position
}

#[test]
fn opposite_charges_fall_from_rest_in_the_time_of_kepler() {
    // From rest at d to d/2: t = √(d³ μ/(2 K)) (π/4 + 1/2), in a medium √ε_r times longer.
    let permittivity = 2.5;
    let time = (permittivity * DISTANCE.powi(3) / (2.0 * strength())).sqrt() * (FRAC_PI_4 + 0.5);
    let error = |steps: u32| {
        let mut pair = pair(Vector3::zero(), permittivity, time / f64::from(steps));
        pair.advance(u64::from(steps)).unwrap();
        between(&pair).x / (0.5 * DISTANCE) - 1.0
    };
    let (coarse, fine) = (error(200), error(400));
    assert!(fine.abs() < 1e-5, "{fine}");
    // Velocity-Verlet is of second order.
    assert!((coarse / fine - 4.0).abs() < 0.05, "{coarse} {fine}");
}

#[test]
fn an_orbit_closes_after_its_period() {
    // A circle, and an ellipse from its far end: A = d/(2 − s²) at s times the speed of the circle.
    for share in [1.0_f64, 0.8] {
        let speed = share * (strength() / DISTANCE).sqrt();
        let period = TAU * ((DISTANCE / (2.0 - share * share)).powi(3) / strength()).sqrt();
        let error = |steps: u32| {
            let mut pair = pair(vector(0.0, speed, 0.0), 1.0, period / f64::from(steps));
            pair.advance(u64::from(steps)).unwrap();
            (between(&pair) - vector(DISTANCE, 0.0, 0.0)).norm() / DISTANCE
        };
        let (coarse, fine) = (error(1000), error(2000));
        assert!(fine < 1e-4, "{share}: {fine}");
        assert!((coarse / fine - 4.0).abs() < 0.1, "{share}: {coarse} {fine}");
    }
}

#[test]
fn the_ledger_closes_in_second_order_while_two_charges_fly_by() {
    let speed = 1.5 * (strength() / DISTANCE).sqrt();
    let worst = |steps: u64| {
        let time_step = 2.0 * DISTANCE / speed / steps as f64;
        let velocity = vector(-0.8 * speed, 0.6 * speed, 0.0);
        let mut pair = pair(velocity, 1.0, time_step);
        let start = pair.ledger();
        let mut worst = 0.0_f64;
        let mut deepest = start.electrostatic;
        for _ in 0..steps {
            pair.step().unwrap();
            let ledger = pair.ledger();
            worst = worst.max(ledger.closing_error().abs() / start.kinetic());
            deepest = deepest.min(ledger.electrostatic);
        }
        let kinetic = pair.ledger().kinetic();
        // The potential at the nearest point is a good part of what is in motion, and all of it comes back.
        assert!(deepest < -start.kinetic() && deepest < 2.0 * start.electrostatic, "{deepest:e}");
        assert!(kinetic > start.kinetic() * 0.5, "{kinetic:e}");
        worst
    };
    let (coarse, fine) = (worst(2000), worst(4000));
    assert!(fine < 1e-3, "{fine}");
    assert!((coarse / fine - 4.0).abs() < 0.2, "{coarse} {fine}");
}

#[test]
fn the_energy_of_an_octahedron_and_of_a_line_is_that_by_hand() {
    let unit = COULOMB_CONSTANT * CHARGE * CHARGE / DISTANCE;
    // Six charges on a sphere of the radius d, with a neutral particle in its middle: twelve pairs at √2 d, three at 2 d.
    let corners = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut octahedron: Vec<Particle> =
        corners.iter().map(|[x, y, z]| at(x * DISTANCE, y * DISTANCE, z * DISTANCE)).collect();
    octahedron.extend([at(0.0, 0.0, 0.0), at(0.0, 0.0, -DISTANCE)]);
    let mut values = vec![CHARGE; 7];
    values[5] = 0.0;
    let shell = charged(octahedron, values, 4.0, 1e-6);
    let expected = unit / 4.0 * (12.0 / SQRT_2 + 1.5);
    let energy = shell.ledger().electrostatic;
    assert!((energy / expected - 1.0).abs() < 1e-14, "{energy:e} {expected:e}");
    let neutral = shell.particles().rows_by_id()[5];
    assert_eq!(shell.electrostatic_force(neutral), Some(Vector3::zero()));
    // 1, −2 and 3 charges at 0, d and 3 d: −2/1 + 3/3 − 6/2; the forces 2/1 − 3/9, −2/1 + 6/4 and 3/9 − 6/4.
    let line = [0.0, 1.0, 3.0].map(|x| at(x * DISTANCE, 0.0, 0.0)).to_vec();
    let line = charged(line, vec![CHARGE, -2.0 * CHARGE, 3.0 * CHARGE], 1.0, 1e-6);
    assert!((line.ledger().electrostatic / (-4.0 * unit) - 1.0).abs() < 1e-14);
    for (id, expected) in [2.0 - 1.0 / 3.0, -2.0 + 1.5, 1.0 / 3.0 - 1.5].into_iter().enumerate() {
        let row = line.particles().rows_by_id()[id];
        let force = line.electrostatic_force(row).unwrap();
        assert!((force.x * DISTANCE / unit - expected).abs() < 1e-14, "{id}: {force:?}");
        assert_eq!(line.particles().forces()[row], force, "no other force acts");
    }
}

/// Charged grains that fall together and touch, at random places.
fn cloud(count: usize) -> (Setup, Vec<NamedColumn>) {
    let mut setup = implosion(count, 25.0 * RADIUS, 9, elastic());
    setup.time_step = contact_time(&setup) / 40.0;
    let sign = |index: usize| if index.is_multiple_of(3) { 1.0 } else { -0.6 };
    let values = (0..count).map(|index| if index % 7 == 5 { 0.0 } else { sign(index) * 2e-10 }).collect();
    (with_electrostatics(setup, 1.0), charges(values))
}

#[test]
fn charges_act_as_the_sum_over_all_pairs_says_and_keep_momentum_and_its_moment() {
    let (setup, columns) = cloud(300);
    let (grains, values) = (setup.particles.clone(), columns[0].values.clone());
    let mut cloud = Simulation::with_columns(setup, columns).unwrap();
    let rows = cloud.particles().rows_by_id();
    let (mut energy, mut scale) = (0.0, 0.0);
    for (id, grain) in grains.iter().enumerate() {
        let (mut force, mut size) = (Vector3::zero(), 0.0);
        for (other_id, other) in grains.iter().enumerate().filter(|(other, _)| *other != id) {
            let way = grain.position - other.position;
            let strength = COULOMB_CONSTANT * values[id] * values[other_id];
            force += way * (strength / way.norm().powi(3));
            size += strength.abs() / way.norm_squared();
            energy += 0.5 * strength / way.norm();
            scale += 0.5 * strength.abs() / way.norm();
        }
        let found = cloud.electrostatic_force(rows[id]).unwrap();
        assert!((found - force).norm() <= 1e-14 * size, "{id}: {found:?} {force:?}");
    }
    assert!((cloud.ledger().electrostatic - energy).abs() < 1e-14 * scale);
    let momenta = |cloud: &Simulation| {
        let (states, particles) = (states(cloud), cloud.particles());
        let (mut momentum, mut moment) = (Vector3::zero(), Vector3::zero());
        for (state, row) in states.iter().zip(particles.rows_by_id()) {
            let one = state.velocity * particles.masses()[row];
            momentum += one;
            moment += state.position.cross(one);
        }
        (momentum, moment)
    };
    let before = momenta(&cloud);
    cloud.advance(600).unwrap();
    let after = momenta(&cloud);
    assert!(cloud.ledger().elastic_normal > 0.0, "none touch");
    let scale = momentum_scale(&cloud);
    assert!((after.0 - before.0).norm() < 1e-12 * scale, "{before:?} {after:?}");
    assert!((after.1 - before.1).norm() < 1e-12 * scale * 25.0 * RADIUS, "{before:?} {after:?}");
    assert!(cloud.ledger().relative_error().abs() < 1e-3, "{:?}", cloud.ledger());
}

#[test]
fn charges_have_the_same_bits_however_they_are_computed() {
    let run = |threads: usize, instructions: InstructionSet, parts: &[u64]| {
        let (setup, columns) = cloud(400);
        let mut cloud = Simulation::with_columns(setup, columns).unwrap();
        cloud.set_threads(threads).unwrap();
        cloud.set_instructions(instructions);
        parts.iter().for_each(|steps| cloud.advance(*steps).unwrap());
        (format!("{:?}", cloud.export_state()), cloud.ledger(), cloud.rebuilds())
    };
    let sets = InstructionSet::available();
    let (expected, ledger, rebuilds) = run(1, sets[0], &[600]);
    assert!(rebuilds > 1, "{rebuilds}");
    for &instructions in &sets {
        let (state, other, _) = run(3, instructions, &[1, 470, 129]);
        assert!(state == expected && other == ledger, "{instructions:?}");
    }
}

#[test]
fn changes_of_charges_and_charges_that_come_and_go_are_booked() {
    let (setup, columns) = cloud(40);
    let mut cloud = Simulation::with_columns(setup, columns.clone()).unwrap();
    let before = cloud.ledger();
    let doubled = columns[0].values.iter().map(|charge| 2.0 * charge).collect();
    cloud.set_column(NamedColumn { values: doubled, ..columns[0].clone() }).unwrap();
    let after = cloud.ledger();
    assert!((after.electrostatic / (4.0 * before.electrostatic) - 1.0).abs() < 1e-12, "{after:?}");
    let tolerance = 1e-12 * before.electrostatic.abs();
    assert!(after.closing_error().abs() < tolerance, "{after:?}");
    let far = at(0.0, 0.0, 100.0 * RADIUS);
    let ids = cloud.insert_with(&[far], &charges(vec![1e-9])).unwrap();
    let with_it = cloud.ledger();
    assert!(with_it.inflow != 0.0 && with_it.closing_error().abs() < tolerance, "{with_it:?}");
    cloud.remove(&ids).unwrap();
    let without = cloud.ledger();
    assert!(without.closing_error().abs() < tolerance, "{without:?}");
    assert!((without.electrostatic / after.electrostatic - 1.0).abs() < 1e-12);
    // Without the charges' force, nothing is left of their energy.
    let mut interactions = with_electrostatics(common::setup(vec![far], elastic()), 1.0).interactions;
    interactions.set_electrostatics(None);
    cloud.set_interactions(interactions).unwrap();
    assert_eq!(cloud.ledger().electrostatic, 0.0);
    assert_eq!(cloud.electrostatic_force(0), None);
    assert!(cloud.ledger().closing_error().abs() < tolerance);
}

#[test]
fn work_of_what_leads_a_charge_past_another_is_booked() {
    let speed = 2.0 * (strength() / DISTANCE).sqrt();
    let mut pair = pair(Vector3::zero(), 1.0, DISTANCE / speed / 2000.0);
    pair.set_group("led", &[0]).unwrap();
    let velocity = vector(-0.8 * speed, 0.6 * speed, 0.0);
    pair.set_group_motion("led", GroupMotion::Velocity(Velocity { velocity })).unwrap();
    pair.advance(2000).unwrap();
    let ledger = pair.ledger();
    assert!(ledger.work_walls.abs() > 0.1 * ledger.kinetic() && ledger.kinetic() > 0.0, "{ledger:?}");
    assert!(ledger.closing_error().abs() < 1e-5 * ledger.work_walls.abs(), "{ledger:?}");
}

#[test]
fn the_shortest_motion_is_that_of_the_lightest_strong_pair_in_touch() {
    let [one, other, third] =
        [1.0, 0.5, 0.5].map(|share| sphere(Vector3::zero(), Vector3::zero(), share * RADIUS));
    let values = [3.0 * CHARGE, -2.0 * CHARGE, 0.0];
    let medium = Electrostatics { relative_permittivity: 2.0 };
    let motion = shortest_motion_of_charges(&[one, other, third], &values, &medium).unwrap();
    // ω² = 2 · 3 · 2 q²/(4 π ε_0 ε_r (3/2 a)³ μ), and the duration π/ω.
    let reduced = one.mass * other.mass / (one.mass + other.mass);
    let slope = 12.0 * COULOMB_CONSTANT / 2.0 * CHARGE * CHARGE / (1.5 * RADIUS).powi(3);
    assert_eq!(motion.kind, MotionKind::Charges);
    assert!((motion.duration / (PI * (reduced / slope).sqrt()) - 1.0).abs() < 1e-14, "{motion:?}");
    assert_eq!(shortest_motion_of_charges(&[one, other], &[CHARGE, 0.0], &medium), None);
}

#[test]
fn what_charges_cannot_do_is_refused() {
    let two = || vec![at(0.0, 0.0, 0.0), at(DISTANCE, 0.0, 0.0)];
    let refusal = |setup: Setup, columns: Vec<NamedColumn>| {
        let setup = Setup { time_step: 1e-6, ..setup };
        Simulation::with_columns(setup, columns).unwrap_err().to_string()
    };
    let plain = || with_electrostatics(setup(two(), elastic()), 1.0);
    let both = || charges(vec![CHARGE; 2]);
    assert!(refusal(plain(), Vec::new()).contains("no quantity `charge`"));
    let upper = vector(1.0, 1.0, 1.0);
    let domain = Domain::periodic(Vector3::zero(), upper, [false, false, true]);
    assert!(refusal(Setup { domain, ..plain() }, both()).contains("periodic"));
    assert!(refusal(with_electrostatics(setup(two(), elastic()), 0.0), both()).contains("permittivity is 0"));
    let mut model = elastic();
    let values = Values::new().with("cutoff", DISTANCE);
    model.laws.noncontact = NonContact::build("coulomb", &values).unwrap().unwrap();
    assert!(refusal(with_electrostatics(setup(two(), model), 1.0), both()).contains("act twice"));
    let most = Electrostatics::MOST_CHARGES;
    let many: Vec<Particle> = (0..=most).map(|place| at(3.0 * RADIUS * place as f64, 0.0, 0.0)).collect();
    let text = refusal(with_electrostatics(setup(many, elastic()), 1.0), charges(vec![CHARGE; most + 1]));
    assert!(text.contains("4097 particles have a charge, more than 4096"), "{text}");
}
