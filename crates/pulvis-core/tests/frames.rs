//! The same physics for every order, place, direction and speed of the observer.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::*;
use pulvis_core::walls::{Cylinder, Plane, WallShape};
use pulvis_core::{Domain, Setup};
use pulvis_math::Vector3;

const EDGE: f64 = 10.0 * RADIUS;
const STEPS: usize = 2_000;

/// Spheres that fall together and to the floor of a box: every contact law at work.
fn powder() -> Setup {
    Setup {
        walls: cube_of_walls(EDGE),
        background: gravity(9.81),
        ..implosion(35, EDGE, 4, viscous_luding())
    }
}

fn run(setup: Setup) -> Vec<State> {
    let mut simulation = start(setup, 50.0);
    advance(&mut simulation, STEPS);
    assert!(simulation.ledger().dissipated_sliding > 0.0);
    states(&simulation)
}

/// Collisions multiply rounding errors; over this run by about 10⁴.
const ROUND_OFF: f64 = 1e-10;

#[test]
fn two_runs_are_the_same_to_the_bit() {
    assert_eq!(run(powder()), run(powder()));
}

#[test]
fn the_order_of_the_particles_does_not_matter() {
    let mut reversed = powder();
    reversed.particles.reverse();
    let mut states = run(reversed);
    states.reverse();
    let difference = difference(&Domain::unbounded(), &run(powder()), &states);
    assert!(difference < ROUND_OFF, "{difference}");
}

/// Applies a map of vectors and one of axial vectors (angular velocities), then a shift, to a system.
fn mapped(
    setup: &Setup,
    polar: impl Fn(Vector3) -> Vector3,
    axial: impl Fn(Vector3) -> Vector3,
    shift: Vector3,
) -> Setup {
    let mut setup = setup.clone();
    for particle in &mut setup.particles {
        particle.position = polar(particle.position) + shift;
        particle.velocity = polar(particle.velocity);
        particle.angular_velocity = axial(particle.angular_velocity);
    }
    for wall in &mut setup.walls {
        wall.point = polar(wall.point) + shift;
        wall.shape = match wall.shape {
            WallShape::Plane(Plane { normal }) => Plane { normal: polar(normal) }.into(),
            WallShape::Cylinder(cylinder) => Cylinder { axis: axial(cylinder.axis), ..cylinder }.into(),
            _ => panic!("the systems of this file have planes and cylinders"),
        };
    }
    setup.background.gravity = polar(setup.background.gravity);
    setup
}

fn mapped_states(
    states: &[State],
    polar: impl Fn(Vector3) -> Vector3,
    axial: impl Fn(Vector3) -> Vector3,
    shift: Vector3,
) -> Vec<State> {
    let map = |state: &State| State {
        position: polar(state.position) + shift,
        velocity: polar(state.velocity),
        angular_velocity: axial(state.angular_velocity),
    };
    states.iter().map(map).collect()
}

#[test]
fn a_mirror_image_moves_as_a_mirror_image() {
    let mirror = |v: Vector3| vector(-v.x, v.y, v.z);
    let axial = |v: Vector3| vector(v.x, -v.y, -v.z);
    let image = run(mapped(&powder(), mirror, axial, Vector3::zero()));
    let expected = mapped_states(&run(powder()), mirror, axial, Vector3::zero());
    let difference = difference(&Domain::unbounded(), &image, &expected);
    assert!(difference < ROUND_OFF, "{difference}");
}

#[test]
fn a_turned_and_shifted_system_moves_turned_and_shifted() {
    // Columns of the rotation by 2.1 rad about (2, 3, 6)/7, by Rodrigues' formula.
    let axis = vector(2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0);
    let (sine, cosine) = 2.1_f64.sin_cos();
    let turn = |v: Vector3| v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine));
    let shift = vector(3.0, -4.0, 1.0) * EDGE;
    let turned = run(mapped(&powder(), turn, turn, shift));
    let expected = mapped_states(&run(powder()), turn, turn, shift);
    let difference = difference(&Domain::unbounded(), &turned, &expected);
    // Places are some ten times larger, and so are their rounding errors.
    assert!(difference < 10.0 * ROUND_OFF, "{difference}");
}

#[test]
fn a_common_velocity_changes_nothing_in_a_periodic_box() {
    let domain = Domain::periodic(Vector3::zero(), vector(EDGE, EDGE, EDGE), [true; 3]);
    let still = Setup { domain, ..implosion(35, EDGE, 4, viscous_luding()) };
    let wind = vector(0.31, -0.17, 0.43);
    let mut moving = still.clone();
    for particle in &mut moving.particles {
        particle.velocity += wind;
    }
    let time = contact_time(&still) / 50.0 * STEPS as f64;
    let (still, moving) = (run(still), run(moving));
    let expected: Vec<_> = still
        .iter()
        .map(|state| State {
            position: state.position + wind * time,
            velocity: state.velocity + wind,
            ..*state
        })
        .collect();
    let difference = difference(&domain, &moving, &expected);
    assert!(difference < 10.0 * ROUND_OFF, "{difference}");
}

#[test]
fn a_sphere_falls_freely_along_a_parabola() {
    let start_velocity = vector(0.3, 0.0, 0.5);
    let falling = vec![sphere(vector(0.0, 0.0, 1.0), start_velocity, RADIUS)];
    let mut falling = start(Setup { background: gravity(9.81), ..setup(falling, elastic()) }, 0.1);
    advance(&mut falling, 1_000);
    let time = falling.time();
    let state = states(&falling)[0];
    // Velocity-Verlet is exact for a constant acceleration: a thousand roundings of 8 m/s and 2 m
    // remain.
    assert!((state.position.z - (1.0 + 0.5 * time - 0.5 * 9.81 * time * time)).abs() < 1e-12);
    assert!((state.position.x - 0.3 * time).abs() < 1e-12);
    assert!((state.velocity.z - (0.5 - 9.81 * time)).abs() < 1e-12);
    let ledger = falling.ledger();
    assert!(ledger.closing_error().abs() < 1e-12 * ledger.scale);
}

#[test]
fn nothing_changes_the_spin_of_a_sphere_without_contact() {
    let mut spinning = sphere(Vector3::zero(), vector(0.1, 0.2, 0.3), RADIUS);
    spinning.angular_velocity = vector(11.0, -7.0, 3.0);
    let mut simulation = start(setup(vec![spinning], viscous_luding()), 1.0);
    advance(&mut simulation, 1_000);
    assert_eq!(states(&simulation)[0].angular_velocity, spinning.angular_velocity);
    assert_eq!(states(&simulation)[0].velocity, spinning.velocity);
}

#[test]
fn a_sphere_at_rest_on_the_floor_stays_at_rest_to_the_bit() {
    // Weight 2⁻¹⁰ N on 1024 N/m: an overlap of 2⁻²⁰ m, all exact in binary.
    let mut model = viscous_luding();
    model.normal = pulvis_contact::Linear::new(1024.0, 1e-3).into();
    let radius = 1.0 / 1024.0;
    let mut resting = sphere(vector(0.25, 0.5, radius - 1.0 / 1_048_576.0), Vector3::zero(), radius);
    resting.mass = 1.0 / 8192.0;
    let setup = Setup { walls: vec![floor()], background: gravity(8.0), ..setup(vec![resting], model) };
    let mut simulation = start(setup, 50.0);
    let (before, held) = (states(&simulation), simulation.ledger().stored());
    advance(&mut simulation, 2_000);
    assert_eq!(states(&simulation), before);
    assert_eq!(simulation.ledger().stored(), held);
    assert_eq!(simulation.wall_force(0), vector(0.0, 0.0, -1.0 / 1024.0));
}
