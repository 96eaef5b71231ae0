//! Walls: forces at rest, work, reflection, drag.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;
#[path = "walls/groups.rs"]
mod groups;

use common::*;
use pulvis_contact::{ContactModel, Linear};
use pulvis_core::walls::{Cosine, Extent, FaceArea, PressureRamp, Servo, Velocity, Wall, WallMotion};
use pulvis_core::{Background, Domain, Setup};
use pulvis_math::Vector3;

fn viscous_spring() -> ContactModel {
    ContactModel::frictionless(Linear::from_restitution(1000.0, 0.3))
}

fn moving(velocity: Vector3, wall: Wall) -> Wall {
    Wall { motion: WallMotion::Velocity(Velocity { velocity }), ..wall }
}

#[test]
fn a_sphere_that_has_come_to_rest_presses_the_floor_with_its_weight() {
    let falling = sphere(vector(0.0, 0.0, 1.5 * RADIUS), Vector3::zero(), RADIUS);
    let weight = falling.mass * 9.81;
    let setup =
        Setup { walls: vec![floor()], background: gravity(9.81), ..setup(vec![falling], viscous_spring()) };
    let mut simulation = start(setup, 50.0);
    advance(&mut simulation, 20_000);
    let overlap = RADIUS - states(&simulation)[0].position.z;
    // After 400 contact times, most of them at rest, the bouncing has died out.
    assert!((overlap / (weight / 1000.0) - 1.0).abs() < 1e-6, "{overlap}");
    assert!((simulation.wall_force(0).z / -weight - 1.0).abs() < 1e-6);
    // The first touch errs by up to (π/50)²/8 of the energy, the dashpot by some times that.
    assert!(simulation.ledger().relative_error().abs() < 2e-3);
}

fn servo(pressure: f64, area: FaceArea, wall: Wall) -> Wall {
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass * 20.0;
    let pressure = PressureRamp { from: 0.0, to: pressure, duration: 2e-3 };
    // About the critical damping of the wall on a spring of some hundred N/m.
    let damping = 0.15;
    Wall { motion: WallMotion::Servo(Servo { pressure, mass, damping }), area, ..wall }
}

#[test]
fn a_servo_wall_presses_a_sphere_with_its_pressure_times_its_area() {
    let (pressure, area) = (2e3, 4e-6);
    let lid = Wall::fixed("lid", 0, vector(0.0, 0.0, 2.2 * RADIUS), vector(0.0, 0.0, -1.0));
    let walls = vec![floor(), servo(pressure, FaceArea::Given(area), lid)];
    let resting = sphere(vector(0.0, 0.0, RADIUS), Vector3::zero(), RADIUS);
    let mut simulation = start(Setup { walls, ..setup(vec![resting], viscous_spring()) }, 50.0);
    let worst = advance_watching(&mut simulation, 60_000, 100);
    let load = pressure * area;
    assert!((simulation.wall_force(1).z / load - 1.0).abs() < 1e-6, "{:?}", simulation.wall_force(1));
    assert!((simulation.wall_force(0).z / -load - 1.0).abs() < 1e-6, "{:?}", simulation.wall_force(0));
    assert!(simulation.wall_velocity(1).norm() < 1e-9);
    let gap = simulation.walls()[1].point.z;
    assert!((gap - (2.0 * RADIUS - 2.0 * load / 1000.0)).abs() < 1e-6 * load / 1000.0);
    let ledger = simulation.ledger();
    // Two springs of k hold F²/2k each; the lid gave that and what the dashpots took.
    assert!((ledger.elastic_normal / (load * load / 1000.0) - 1.0).abs() < 1e-5);
    assert!(ledger.work_servo > ledger.elastic_normal && ledger.work_walls == 0.0, "{ledger:?}");
    assert!(worst < 1e-3, "{worst}");
}

#[test]
fn a_packing_between_servo_walls_carries_their_pressure() {
    let edge = 10.0 * RADIUS;
    let domain = Domain::periodic(Vector3::zero(), vector(1.0, edge, edge), [false, true, true]);
    let face = FaceArea::Product([Extent::Given(edge), Extent::Given(edge)]);
    let pressure = 500.0;
    let walls = [0, 1].map(|side| servo(pressure, face, cube_of_walls(edge)[side].clone()));
    let background = Background { drag: 2e-4, rotational_drag: 2e-4, ..Background::default() };
    let powder = implosion(50, edge, 6, viscous_luding());
    let mut simulation = start(Setup { walls: walls.into(), domain, background, ..powder }, 40.0);
    let worst = advance_watching(&mut simulation, 60_000, 200);
    let load = pressure * edge * edge;
    for (wall, outwards) in [(0, -1.0), (1, 1.0)] {
        let force = simulation.wall_force(wall);
        assert!((force.x / (outwards * load) - 1.0).abs() < 1e-3, "wall {wall}: {force:?} for {load}");
    }
    assert_eq!(simulation.wall_area(0), Some(edge * edge));
    assert!(simulation.ledger().work_servo > 0.0);
    assert!(worst < 1e-3, "{worst}");
}

#[test]
fn a_moving_wall_reflects_a_sphere_with_twice_its_own_speed_more_and_does_that_work() {
    let (wall_speed, speed) = (0.15, 0.1);
    for steps_per_contact in [50.0, 200.0] {
        let coming = sphere(vector(0.0, 0.0, 1.2 * RADIUS), vector(0.0, 0.0, -speed), RADIUS);
        let mass = coming.mass;
        let walls = vec![moving(vector(0.0, 0.0, wall_speed), floor())];
        let setup = Setup { walls, ..setup(vec![coming], elastic()) };
        // 0.2 radii to go at 0.25 m/s, and the contact.
        let steps = ((0.2 * RADIUS / 0.25 / contact_time(&setup) + 2.0) * steps_per_contact) as usize;
        let mut simulation = start(setup, steps_per_contact);
        advance(&mut simulation, steps);
        let reflected = states(&simulation)[0].velocity.z;
        // Touch and parting lie within a step: (π dt/t_c)²/8 of the energy at most.
        let tolerance = 1.3 / (steps_per_contact * steps_per_contact);
        let expected = 2.0 * wall_speed + speed;
        assert!((reflected / expected - 1.0).abs() < tolerance, "{reflected}");
        let ledger = simulation.ledger();
        let gained = 0.5 * mass * (reflected * reflected - speed * speed);
        assert!((ledger.work_walls / gained - 1.0).abs() < 4.0 * tolerance, "{} {gained}", ledger.work_walls);
        assert_eq!(ledger.work_servo, 0.0);
    }
}

#[test]
fn a_dashpot_sees_the_speed_of_the_wall_from_the_first_step_on() {
    // The wall recedes as fast as the sphere: in contact, and nothing acts but the spring.
    let going = sphere(vector(0.0, 0.0, RADIUS), vector(0.0, 0.0, -0.1), RADIUS);
    let walls = vec![moving(vector(0.0, 0.0, -0.1), floor())];
    let setup = Setup { walls, ..setup(vec![going], viscous_spring()) };
    let mut simulation = start(setup, 50.0);
    simulation.step().unwrap();
    assert!(simulation.ledger().dissipated_viscous.abs() < 1e-12 * simulation.ledger().scale);
}

#[test]
fn a_cosine_wall_compresses_a_spring_and_comes_back_having_done_no_work() {
    // A sphere between two walls, one of which moves by a twentieth of its radius and back, slowly.
    let lid = Wall::fixed("lid", 0, vector(0.0, 0.0, 2.0 * RADIUS), vector(0.0, 0.0, -1.0));
    let held = setup(vec![sphere(vector(0.0, 0.0, RADIUS), Vector3::zero(), RADIUS)], elastic());
    let period = 400.0 * contact_time(&held);
    let displacement = vector(0.0, 0.0, -0.05 * RADIUS);
    let motion = WallMotion::Cosine(Cosine { displacement, period, cycles: 1.0 });
    let setup = Setup { walls: vec![floor(), Wall { motion, ..lid }], ..held };
    // The contact at a wall is longer than that of the pair, but the shortest one is the pair's.
    let steps_per_contact = 50.0;
    let mut simulation = start(setup, steps_per_contact);
    let half_way = (200.0 * steps_per_contact) as usize;
    advance(&mut simulation, half_way);
    let compressed = simulation.walls()[1].point.z;
    assert!((compressed / (1.95 * RADIUS) - 1.0).abs() < 1e-9, "{compressed}");
    // Two springs in a row: each takes half.
    let expected = 1000.0 * 0.025 * RADIUS;
    // The start of the motion leaves the sphere oscillating with about (2 t_c/P) of the amplitude.
    assert!((simulation.wall_force(1).z / expected - 1.0).abs() < 1e-2, "{:?}", simulation.wall_force(1));
    let work = simulation.ledger().work_walls;
    assert!((work / (1000.0 * (0.025 * RADIUS).powi(2)) - 1.0).abs() < 1e-2, "{work}");
    let worst = advance_watching(&mut simulation, half_way + 100, 10);
    assert!((simulation.walls()[1].point.z / (2.0 * RADIUS) - 1.0).abs() < 1e-12);
    assert!(simulation.ledger().work_walls.abs() < 1e-3 * work, "{}", simulation.ledger().work_walls);
    assert!(worst < 1e-5, "{worst}");
}

/// A sphere on a floor that moves sideways from the first instant: it slides, then rolls.
#[test]
fn a_floor_that_moves_sideways_drags_a_sphere_until_it_rolls() {
    let (wall_speed, friction, strength) = (0.05, 0.3, 9.81);
    let mut model = ContactModel::frictionless(Linear::new(1000.0, 0.0));
    model.laws.sliding = Some(slider(200.0, 0.0, friction));
    let mut resting = sphere(Vector3::zero(), Vector3::zero(), RADIUS);
    let overlap = resting.mass * strength / 1000.0;
    resting.position.z = RADIUS - overlap;
    let walls = vec![moving(vector(wall_speed, 0.0, 0.0), floor())];
    let setup = Setup { walls, background: gravity(strength), ..setup(vec![resting], model) };
    let mut simulation = start(setup, 50.0);
    // Contact-point speed V falls by 7/2 μ g t: rolling from t = 2 V/(7 μ g) on, at 2 V/7.
    let rolling_from = 2.0 * wall_speed / (7.0 * friction * strength);
    let half_way = (0.5 * rolling_from / simulation.time_step()) as usize;
    let mut worst = advance_watching(&mut simulation, half_way, 20);
    let (time, state) = (simulation.time(), states(&simulation)[0]);
    // The spring takes 2 μ m g/(7 k_t V) = 5e-5 of the sliding time to reach the limit.
    assert!((state.velocity.x / (friction * strength * time) - 1.0).abs() < 1e-2, "{state:?}");
    worst = worst.max(advance_watching(&mut simulation, 2 * half_way, 20));
    let (state, ledger) = (states(&simulation)[0], simulation.ledger());
    // The lever is a − δ/2, and what is left of the sliding spring lets the sphere swing a little.
    assert!((state.velocity.x / (2.0 * wall_speed / 7.0) - 1.0).abs() < 1e-2, "{state:?}");
    // A negative angular velocity about y, by 5/2 of the velocity over the radius.
    assert!((-state.angular_velocity.y * RADIUS / (2.5 * state.velocity.x) - 1.0).abs() < 1e-2, "{state:?}");
    // The wall's force μ m g did work over the path of the wall: half of it became heat.
    let work = friction * resting.mass * strength * wall_speed * rolling_from;
    assert!((ledger.work_walls / work - 1.0).abs() < 1e-2, "{} {work}", ledger.work_walls);
    assert!((ledger.dissipated_sliding / (0.5 * work) - 1.0).abs() < 1e-2, "{ledger:?}");
    assert!(worst < 1e-5, "{worst}");
}

#[test]
fn falling_through_a_periodic_boundary_is_falling_on() {
    let edge = 8.0 * RADIUS;
    let domain = Domain::periodic(Vector3::zero(), vector(edge, edge, edge), [true; 3]);
    let falling = Setup { domain, background: gravity(500.0), ..implosion(20, edge, 1, luding()) };
    let mut simulation = start(falling, 50.0);
    let before = simulation.ledger();
    let worst = advance_watching(&mut simulation, 6_000, 10);
    let (ledger, time) = (simulation.ledger(), simulation.time());
    let fallen = 0.5 * 500.0 * time * time;
    assert!(fallen > 3.0 * edge, "{fallen}");
    // The centre of mass falls as a free body, from the momentum that it had.
    let particles = simulation.particles();
    let speed = particles.momentum().z / particles.total_mass() + 500.0 * time;
    let lost = particles.total_mass() * 500.0 * (fallen - speed * time);
    assert!(
        ((before.gravity - ledger.gravity) / lost - 1.0).abs() < 1e-9,
        "{} {lost}",
        before.gravity - ledger.gravity
    );
    assert!(worst < 1e-4, "{worst}");
}
