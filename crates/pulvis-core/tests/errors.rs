//! What is refused, and what is reported.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_contact::NonContact;
use pulvis_contact::noncontact::Reversible;
use pulvis_core::walls::{Cosine, Extent, FaceArea, PressureRamp, Servo, Velocity, Wall, WallMotion};
use pulvis_core::{
    Alarm, Background, Domain, Interactions, Particle, Setup, SetupError, Simulation, StepError,
};
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
fn a_background_and_a_wall_motion_that_cannot_be_are_refused_and_nothing_changes() {
    let mut simulation = Simulation::new(Setup { walls: vec![floor()], ..one() }).unwrap();
    let error = simulation.set_background(Background { drag: -1.0, ..Background::default() }).unwrap_err();
    assert!(matches!(error, SetupError::Background { found: -1.0, .. }), "{error}");
    let lost = Velocity { velocity: vector(f64::NAN, 0.0, 0.0) };
    let error = simulation.set_wall_motion(0, WallMotion::Velocity(lost)).unwrap_err();
    assert!(matches!(error, SetupError::Wall { index: 0, found, .. } if found.is_nan()), "{error}");
    assert_eq!(simulation.walls()[0].motion, WallMotion::Fixed);
    advance(&mut simulation, 10);
    assert!(simulation.particles().positions()[0].z.is_finite());
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
fn a_particle_whose_position_is_not_a_number_is_reported_lost() {
    let mut setup = one();
    setup.particles.push(sphere(vector(5.0 * RADIUS, 0.0, 0.0), Vector3::zero(), RADIUS));
    setup.particles.push(sphere(vector(9.0 * RADIUS, 0.0, 0.0), vector(0.0, 1.0, 0.0), RADIUS));
    // More drag than a step can follow; what does not move feels none of it.
    setup.background.drag = 1e308;
    let mut simulation = Simulation::new(setup).unwrap();
    let StepError { alarm, .. } = simulation.advance(10).unwrap_err();
    assert!(matches!(alarm, Alarm::ParticleLost { id: 2, .. }), "{alarm}");
}

#[test]
fn two_particles_in_the_same_place_are_reported_lost() {
    let mut setup = one();
    setup.particles.push(setup.particles[0]);
    let mut simulation = Simulation::new(setup).unwrap();
    let StepError { step, alarm, .. } = simulation.step().unwrap_err();
    assert!(step == 1 && matches!(alarm, Alarm::ParticleLost { quantity: "position", .. }), "{alarm}");
}

#[test]
fn a_system_without_particles_runs() {
    let mut empty = Simulation::new(Setup { particles: Vec::new(), walls: vec![floor()], ..one() }).unwrap();
    advance(&mut empty, 10);
    assert_eq!(empty.ledger().relative_error(), 0.0);
    assert_eq!(empty.candidates(), 0);
}

/// The quantity that is refused when the only particle is changed.
fn refused_particle(change: impl FnOnce(&mut Particle)) -> &'static str {
    let mut setup = one();
    change(&mut setup.particles[0]);
    match refused(setup) {
        SetupError::Particle { index: 0, quantity, .. } => quantity,
        other => panic!("{other}"),
    }
}

#[test]
fn particles_with_numbers_that_cannot_be_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        assert_eq!(refused_particle(|particle| particle.radius = bad), "radius [m]");
        assert_eq!(refused_particle(|particle| particle.mass = bad), "mass [kg]");
    }
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(refused_particle(|particle| particle.position.z = bad), "position [m]");
        assert_eq!(refused_particle(|particle| particle.velocity.y = bad), "velocity [m/s]");
        let spinning = |particle: &mut Particle| particle.angular_velocity.x = bad;
        assert_eq!(refused_particle(spinning), "angular velocity [rad/s]");
    }
    let mut setup = one();
    setup.particles[0].radius = -1.0;
    let message = refused(setup).to_string();
    assert_eq!(message, "particle 0: radius [m] is -1, expected a finite number greater than zero");
}

#[test]
fn particles_that_cannot_be_are_not_inserted_either() {
    let mut simulation = Simulation::new(one()).unwrap();
    let mut particle = one().particles[0];
    particle.mass = f64::NAN;
    let error = simulation.insert(&[one().particles[0], particle]).unwrap_err();
    assert!(matches!(error, SetupError::Particle { index: 1, quantity: "mass [kg]", .. }), "{error}");
    assert_eq!(simulation.particles().len(), 1);
    advance(&mut simulation, 3);
}

/// The quantity that is refused when a floor is changed.
fn refused_wall(change: impl FnOnce(&mut Wall)) -> &'static str {
    let mut wall = floor();
    change(&mut wall);
    match refused(Setup { walls: vec![floor(), wall], ..one() }) {
        SetupError::Wall { index: 1, quantity, .. } => quantity,
        other => panic!("{other}"),
    }
}

#[test]
fn walls_with_numbers_that_cannot_be_are_refused() {
    assert_eq!(refused_wall(|wall| wall.point.x = f64::INFINITY), "point [m]");
    assert_eq!(refused_wall(|wall| wall.area = FaceArea::Given(-1.0)), "area [m²]");
    let face = FaceArea::Product([Extent::Given(1.0), Extent::Given(f64::NAN)]);
    assert_eq!(refused_wall(|wall| wall.area = face), "extent of the face [m]");
    let servo = |pressure, mass, damping| WallMotion::Servo(Servo { pressure, mass, damping });
    let pressure = PressureRamp { from: 0.0, to: 1.0, duration: 1.0 };
    for (motion, quantity) in [
        (servo(pressure, 0.0, 0.0), "mass"),
        (servo(pressure, 1.0, -1.0), "damping"),
        (servo(PressureRamp { to: f64::NAN, ..pressure }, 1.0, 0.0), "pressure"),
        (servo(PressureRamp { duration: -1.0, ..pressure }, 1.0, 0.0), "ramp"),
        (WallMotion::Velocity(Velocity { velocity: vector(f64::NAN, 0.0, 0.0) }), "velocity"),
        (WallMotion::Cosine(Cosine { displacement: Vector3::zero(), period: 0.0, cycles: 1.0 }), "period"),
    ] {
        assert_eq!(refused_wall(|wall| wall.motion = motion), quantity);
    }
}

#[test]
fn a_face_that_ranges_up_to_a_wall_that_is_not_there_is_refused() {
    let area = FaceArea::Product([Extent::Given(1.0), Extent::Between(0, 2)]);
    let error = refused(Setup { walls: vec![floor(), Wall { area, ..floor() }], ..one() });
    assert_eq!(error, SetupError::NoSuchWall { index: 1, other: 2, walls: 2 });
}

#[test]
fn gravity_and_drag_that_cannot_be_are_refused() {
    let gravity = Background { gravity: vector(0.0, f64::NAN, 0.0), ..Background::default() };
    let drag = Background { drag: -1.0, ..Background::default() };
    let rotational_drag = Background { rotational_drag: f64::INFINITY, ..Background::default() };
    for (background, named) in
        [(gravity, "gravity [m/s²]"), (drag, "drag [kg/s]"), (rotational_drag, "rotational drag [kg/s]")]
    {
        let error = refused(Setup { background, ..one() });
        assert!(matches!(error, SetupError::Background { quantity, .. } if quantity == named), "{error}");
    }
}
