//! What is refused, and what is reported.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_contact::NonContact;
use pulvis_contact::noncontact::Reversible;
use pulvis_core::walls::{PressureRamp, Servo, Wall, WallMotion};
use pulvis_core::{Domain, Interactions, Particle, Setup, SetupError, Simulation, StepError};
use pulvis_math::Vector3;

fn one() -> Setup {
    let particle = sphere(vector(RADIUS, RADIUS, RADIUS), Vector3::zero(), RADIUS);
    Setup { time_step: 1e-6, ..setup(vec![particle], elastic()) }
}

fn refused(setup: Setup) -> SetupError {
    Simulation::new(setup).unwrap_err()
}

#[test]
fn materials_without_a_contact_model_are_named() {
    let mut strange = one();
    let second = sphere(vector(5.0 * RADIUS, RADIUS, RADIUS), Vector3::zero(), RADIUS);
    strange.particles.push(second);
    strange.particles[0].material = 3;
    strange.particles[1].material = 3;
    assert_eq!(refused(strange), SetupError::NoModel { one: 3, other: 3 });
    let mut at_wall = one();
    at_wall.walls = vec![Wall { material: 2, ..floor() }];
    assert_eq!(refused(at_wall), SetupError::NoModel { one: 0, other: 2 });
}

#[test]
fn a_single_particle_of_its_material_needs_no_model_for_a_contact_with_its_like() {
    let mut interactions = Interactions::new(2);
    interactions.set(0, 1, elastic());
    let (resting, floor) = (one().particles[0], Wall { material: 1, ..floor() });
    let falling = |position| Particle { position, velocity: vector(0.0, 0.0, -0.1), ..resting };
    let alone = Setup { interactions: interactions.clone(), walls: vec![floor.clone()], ..one() };
    let mut simulation =
        Simulation::new(Setup { particles: vec![falling(vector(0.0, 0.0, 1.1 * RADIUS))], ..alone }).unwrap();
    let bounces = (0..200_000).any(|_| {
        advance(&mut simulation, 1);
        simulation.particles().velocities()[0].z > 0.05
    });
    assert!(bounces, "{:?}", simulation.particles().velocities()[0]);
    // What stages change may not take the model of the wall away.
    let error = simulation.set_interactions(Interactions::new(2)).unwrap_err();
    assert_eq!(error, SetupError::NoModel { one: 0, other: 1 });
}

#[test]
fn new_models_that_leave_a_pair_without_one_are_refused_and_the_old_ones_stay() {
    let second = sphere(vector(5.0 * RADIUS, RADIUS, RADIUS), Vector3::zero(), RADIUS);
    let particles = vec![one().particles[0], second];
    let mut simulation = Simulation::new(Setup { particles, ..one() }).unwrap();
    let error = simulation.set_interactions(Interactions::new(1)).unwrap_err();
    assert_eq!(error, SetupError::NoModel { one: 0, other: 0 });
    advance(&mut simulation, 3);
}

#[test]
fn a_period_of_less_than_two_search_radii_is_refused() {
    let domain = |edge: f64| Domain::periodic(Vector3::zero(), vector(edge, 1.0, 1.0), [true, false, false]);
    // Diameter and skin: 2.2 radii.
    let least = 4.4 * RADIUS;
    let error = refused(Setup { domain: domain(0.99 * least), ..one() });
    assert!(matches!(error, SetupError::ShortPeriod { axis: 0, .. }), "{error}");
    let mut fits = Simulation::new(Setup { domain: domain(1.01 * least), ..one() }).unwrap();
    let thicker = fits.set_skin(0.5 * RADIUS).unwrap_err();
    assert!(matches!(thicker, SetupError::ShortPeriod { axis: 0, .. }), "{thicker}");
    let mut reaching = elastic();
    reaching.laws.noncontact = NonContact::Reversible(Reversible { f_a: 1e-3, kc_a: 5.0 });
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, reaching);
    assert!(matches!(fits.set_interactions(interactions), Err(SetupError::ShortPeriod { .. })));
    advance(&mut fits, 3);
}

#[test]
fn a_time_step_that_is_not_positive_and_finite_is_refused() {
    for time_step in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(Setup { time_step, ..one() }), SetupError::TimeStep(_)), "{time_step}");
        let mut simulation = Simulation::new(one()).unwrap();
        assert!(matches!(simulation.set_time_step(time_step), Err(SetupError::TimeStep(_))));
        assert_eq!(simulation.time_step(), 1e-6);
    }
}

#[test]
fn a_wall_across_a_periodic_direction_is_refused() {
    let domain = Domain::periodic(Vector3::zero(), vector(1.0, 1.0, 1.0), [true, false, true]);
    let error = refused(Setup { domain, walls: vec![floor()], ..one() });
    assert_eq!(error, SetupError::WallAcrossPeriod { wall: 0, axis: 2 });
}

#[test]
fn a_wall_that_follows_a_pressure_needs_an_area() {
    let pressure = PressureRamp { from: 0.0, to: 1.0, duration: 1.0 };
    let motion = WallMotion::Servo(Servo { pressure, mass: 1.0, damping: 0.0 });
    let error = refused(Setup { walls: vec![floor(), Wall { motion, ..floor() }], ..one() });
    assert_eq!(error, SetupError::NoArea { wall: 1 });
}

#[test]
fn a_particle_whose_position_is_no_number_is_reported_lost() {
    let mut setup = one();
    setup.particles.push(sphere(vector(5.0 * RADIUS, 0.0, 0.0), Vector3::zero(), RADIUS));
    setup.particles.push(sphere(vector(9.0 * RADIUS, 0.0, 0.0), vector(0.0, f64::NAN, 0.0), RADIUS));
    let mut simulation = Simulation::new(setup).unwrap();
    assert_eq!(simulation.step(), Err(StepError::Lost { id: 2, step: 1, time: 0.0 }));
}

#[test]
fn two_particles_in_the_same_place_are_reported_lost() {
    let mut setup = one();
    setup.particles.push(setup.particles[0]);
    let mut simulation = Simulation::new(setup).unwrap();
    assert!(matches!(simulation.step(), Err(StepError::Lost { step: 1, .. })));
}

#[test]
fn a_system_without_particles_runs() {
    let mut empty = Simulation::new(Setup { particles: Vec::new(), walls: vec![floor()], ..one() }).unwrap();
    advance(&mut empty, 10);
    assert_eq!(empty.ledger().relative_error(), 0.0);
    assert_eq!(empty.candidates(), 0);
}
