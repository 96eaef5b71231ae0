//! What cannot be right stops a simulation, and says what and where.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_contact::{ContactModel, ExpectedLoading, Hertz};
use pulvis_core::walls::{FaceArea, PressureRamp, Servo, Velocity, Wall, WallMotion};
use pulvis_core::{Alarm, ContactPartner, Limits, Particle, Setup, Simulation, StepError};
use pulvis_math::Vector3;

/// Advances until an alarm; there must be one within so many steps.
fn alarm_within(steps: u64, setup: Setup, limits: Limits) -> StepError {
    let mut simulation = start(setup, 50.0);
    simulation.set_limits(limits);
    simulation.advance(steps).expect_err("no alarm")
}

fn falling(speed: f64) -> Particle {
    sphere(vector(0.0, 0.0, 1.5 * RADIUS), vector(0.0, 0.0, -speed), RADIUS)
}

fn speed_of_first(simulation: &Simulation) -> f64 {
    simulation.particles().velocities().iter().next().unwrap().norm()
}

fn one_falling(speed: f64) -> Setup {
    Setup { walls: vec![floor()], ..setup(vec![falling(speed)], elastic()) }
}

/// Two spheres that meet head on, each with this speed.
fn two_meeting(speed: f64) -> Setup {
    let moving =
        |side: f64| sphere(vector(1.2 * side * RADIUS, 0.0, 0.0), vector(-side * speed, 0.0, 0.0), RADIUS);
    setup(vec![moving(-1.0), moving(1.0)], elastic())
}

/// A lid at twice the radius above the floor, moved so.
fn lid(motion: WallMotion) -> Wall {
    let lid = Wall::fixed("lid", 0, vector(0.0, 0.0, 2.2 * RADIUS), vector(0.0, 0.0, -1.0));
    Wall { motion, area: FaceArea::Given(1e-6), ..lid }
}

#[test]
fn a_wall_that_is_too_light_for_the_time_step_stops_the_simulation() {
    // Its own period on the contact is some hundred times shorter than the step.
    let pressure = PressureRamp { from: 1e3, to: 1e3, duration: 0.0 };
    let light = Servo { pressure, mass: 1e-12, damping: 0.0 };
    let mut setup = one_falling(0.0);
    setup.walls.push(lid(WallMotion::Servo(light)));
    let StepError { alarm, .. } = alarm_within(100_000, setup, Limits::default());
    assert!(matches!(alarm, Alarm::WallTooFast { .. } | Alarm::EnergyError { .. }), "{alarm}");
}

#[test]
fn a_wall_whose_damping_is_too_strong_for_the_time_step_stops_the_simulation() {
    let pressure = PressureRamp { from: 1e3, to: 1e3, duration: 0.0 };
    let damped = Servo { pressure, mass: 1e-6, damping: 1e6 };
    let mut setup = one_falling(0.0);
    setup.walls.push(lid(WallMotion::Servo(damped)));
    let StepError { alarm, .. } = alarm_within(10_000, setup, Limits::NONE);
    assert!(matches!(&alarm, Alarm::WallLost { wall, .. } if wall == "lid"), "{alarm}");
}

#[test]
fn a_speed_whose_square_is_infinite_stops_the_simulation_in_its_first_step() {
    let StepError { step, alarm, .. } = alarm_within(10, one_falling(1e200), Limits::NONE);
    assert_eq!((step, alarm), (1, Alarm::ParticleLost { id: 0, quantity: "velocity" }));
}

#[test]
fn an_angular_velocity_that_is_not_a_number_stops_the_simulation_though_nothing_feels_it() {
    let mut setup = two_meeting(0.0);
    setup.particles[1].angular_velocity = vector(0.0, 1.0, 0.0);
    // More drag than a step can follow.
    setup.background.rotational_drag = 1e308;
    let StepError { step, alarm, .. } = alarm_within(200, setup, Limits::NONE);
    assert_eq!((step, alarm), (64, Alarm::ParticleLost { id: 1, quantity: "angular velocity" }));
}

#[test]
fn a_particle_that_goes_through_the_floor_stops_the_simulation() {
    // At 40 m/s the contact would be three radii deep; a step is 0.18 radii.
    let limits = Limits { energy_error: f64::INFINITY, ..Limits::default() };
    let StepError { alarm, .. } = alarm_within(500, one_falling(40.0), limits);
    let Alarm::BehindWall { id: 0, wall, overlap, most } = &alarm else { panic!("{alarm}") };
    assert!(wall == "floor" && *most == 1.0 && (1.0..1.5).contains(overlap), "{alarm}");
}

#[test]
fn two_particles_pressed_into_each_other_stop_the_simulation() {
    let limits = Limits { energy_error: f64::INFINITY, ..Limits::default() };
    let StepError { alarm, .. } = alarm_within(500, two_meeting(20.0), limits);
    let Alarm::Overlap { id: 0, other: 1, overlap, most } = alarm else { panic!("{alarm}") };
    assert!(most == 1.0 && (1.0..1.5).contains(&overlap), "{alarm}");
}

#[test]
fn the_first_deep_contact_is_taken_down_with_its_bodies_its_speed_and_its_contact_time() {
    let limits = Limits { energy_error: f64::INFINITY, overlap: 0.6, ..Limits::default() };
    // A contact of 200 steps: there are some looks between two lists while it is deep.
    let mut simulation = start(two_meeting(8.0), 200.0);
    let contact_time = 200.0 * simulation.time_step();
    simulation.set_limits(limits);
    let StepError { step, alarm, .. } = simulation.advance(500).expect_err("no alarm");
    // The deepest overlap would be 0.9 radii.
    let Alarm::Overlap { id: 0, other: 1, overlap, most } = alarm else { panic!("{alarm}") };
    assert!(most == 0.6 && (0.6..0.9).contains(&overlap), "{overlap}");
    let deep = simulation.first_deep_contact().expect("there is one");
    assert_eq!((deep.first, deep.second, deep.radius), (0, ContactPartner::Particle(1), RADIUS));
    assert!((0.3..=overlap).contains(&deep.overlap) && deep.step <= step, "{deep:?}");
    // They still come closer, slower than at the start.
    assert!((0.0..16.0).contains(&deep.closing_speed), "{deep:?}");
    assert!((deep.contact_time / contact_time - 1.0).abs() < 1e-12, "{deep:?}");
    assert!((deep.contact_time / deep.time_step - 200.0).abs() < 1e-9, "{deep:?}");
    assert_eq!(simulation.contact_time(0, ContactPartner::Particle(1)), Some(deep.contact_time));
    assert_eq!(simulation.contact_time(0, ContactPartner::Particle(7)), None);
}

#[test]
fn shallow_contacts_are_not_taken_down_and_deep_ones_at_walls_are() {
    let run = |speed: f64| {
        let mut simulation = start(one_falling(speed), 50.0);
        simulation.set_limits(Limits { energy_error: f64::INFINITY, ..Limits::default() });
        simulation.advance(300).unwrap();
        simulation.first_deep_contact().copied()
    };
    assert_eq!(run(2.0), None, "a sixth of a radius deep");
    let deep = run(6.0).expect("half a radius deep");
    assert_eq!((deep.first, deep.second), (0, ContactPartner::Wall(0)));
    assert!((0.3..0.6).contains(&deep.overlap), "{deep:?}");
}

#[test]
fn a_particle_faster_than_the_limit_stops_the_simulation() {
    let free_fall = |limit: f64| {
        let mut setup = setup(vec![falling(0.0)], elastic());
        setup.background.gravity = vector(0.0, 0.0, -1e4);
        let mut simulation = start(setup, 50.0);
        simulation.set_limits(Limits { speed: limit, ..Limits::default() });
        simulation.advance(1000).map(|()| speed_of_first(&simulation))
    };
    let fastest = free_fall(f64::INFINITY).unwrap();
    let StepError { step, time, alarm } = free_fall(0.5 * fastest).expect_err("no alarm");
    let Alarm::BeyondSpeed { id: 0, speed, most } = alarm else { panic!("{alarm}") };
    assert_eq!(most, 0.5 * fastest);
    // Within 64 steps of the moment at which it was reached.
    assert!((500..=564).contains(&step) && (speed - 1e4 * time).abs() < 1e-9 * speed, "{step}: {speed}");
}

#[test]
fn contacts_that_stay_within_the_limits_do_not_stop_the_simulation() {
    // Half a radius deep.
    for setup in [one_falling(6.0), two_meeting(4.5)] {
        let mut simulation = start(setup, 50.0);
        simulation.set_limits(Limits::default());
        let mut deepest = 0.0;
        for _ in 0..300 {
            simulation.step().unwrap();
            simulation.for_each_contact(&mut |contact| deepest = contact.overlap.max(deepest));
        }
        assert!((0.3 * RADIUS..0.6 * RADIUS).contains(&deepest), "{deepest}");
    }
}

#[test]
fn a_particle_or_a_wall_that_is_too_fast_for_the_time_step_stops_the_simulation() {
    let StepError { step, alarm, .. } = alarm_within(10, one_falling(1000.0), Limits::default());
    assert!(matches!(alarm, Alarm::ParticleTooFast { id: 0, .. }) && step == 1, "{alarm}");
    let mut setup = one_falling(0.0);
    let velocity = vector(0.0, 0.0, -1000.0);
    setup.walls.push(lid(WallMotion::Velocity(Velocity { velocity })));
    let StepError { step, alarm, .. } = alarm_within(10, setup, Limits::default());
    assert!(matches!(&alarm, Alarm::WallTooFast { wall, .. } if wall == "lid") && step == 1, "{alarm}");
}

#[test]
fn a_piston_that_passes_the_floor_stops_the_simulation() {
    let velocity = vector(0.0, 0.0, -1.0);
    let mut setup = one_falling(0.0);
    // Aside: the walls meet without anything between them.
    let contact = contact_time(&setup);
    setup.particles.clear();
    setup.walls.push(lid(WallMotion::Velocity(Velocity { velocity })));
    let mut simulation = Simulation::new(Setup { time_step: contact / 50.0, ..setup }).unwrap();
    simulation.set_limits(Limits::default());
    let StepError { time, alarm, .. } = simulation.advance(10_000).expect_err("no alarm");
    assert!(
        matches!(&alarm, Alarm::WallsCrossed { wall, opposite, .. } if wall == "floor" && opposite == "lid")
    );
    // 2.2 radii at 1 m/s.
    assert!((time - 2.2 * RADIUS).abs() < 2.0 * simulation.time_step(), "{time}");
}

#[test]
fn a_ledger_that_does_not_close_stops_the_simulation() {
    let limits = Limits { energy_error: 1e-5, ..Limits::NONE };
    let mut gas = start(elastic_gas(100), 10.0);
    gas.set_limits(limits);
    let StepError { step, alarm, .. } = gas.advance(20_000).expect_err("no alarm");
    let Alarm::EnergyError { error, most } = alarm else { panic!("{alarm}") };
    assert!(error > 1e-5 && error.is_finite() && most == 1e-5 && step % 64 == 0, "{step}: {error}");
    assert_eq!(error, gas.ledger().relative_error().abs(), "the ledger is that of the alarm");
}

#[test]
fn a_contact_stiffer_than_its_time_step_resolves_stops_the_simulation_unless_it_was_expected() {
    // k grows as √δ, and so do the steps in a contact fall as δ^(-1/4).
    let hertz = |speed: f64| {
        let mut model = ContactModel::frictionless(Hertz { effective_modulus: 1e8 });
        model.laws.expected = ExpectedLoading { speed, force: 0.0, overlap: 0.0 };
        Setup { walls: vec![floor()], ..setup(vec![falling(0.5)], model) }
    };
    let run = |expected: f64| {
        let mut simulation = start(hertz(expected), 12.0);
        simulation.set_limits(Limits { steps_per_contact: 10.0, ..Limits::NONE });
        simulation.advance(2000)
    };
    run(0.5).unwrap();
    // Half the speed: δ over 2^(4/5), and still 12/2^(1/5) = 10.4 steps.
    run(0.25).unwrap();
    let StepError { alarm, .. } = run(0.1).expect_err("no alarm");
    // At its deepest 12/5^(1/5) = 8.7 steps.
    let Alarm::TooStiff { steps, least } = alarm else { panic!("{alarm}") };
    assert!(least == 10.0 && (8.6..10.0).contains(&steps), "{steps}");
}

#[test]
fn looking_at_the_ledger_changes_nothing_and_so_does_the_number_of_steps_at_a_time() {
    let [mut watched, mut unwatched] =
        [(); 2].map(|()| start(implosion(60, 12.0 * RADIUS, 3, viscous_luding()), 50.0));
    for _ in 0..1000 {
        watched.step().unwrap();
        assert!(watched.ledger().scale > 0.0);
    }
    unwatched.advance(1000).unwrap();
    assert_eq!(watched.ledger(), unwatched.ledger());
}

#[test]
fn a_system_without_contacts_has_no_alarm() {
    let mut alone =
        start(setup(vec![sphere(Vector3::zero(), vector(0.1, 0.0, 0.0), RADIUS)], elastic()), 50.0);
    alone.set_limits(Limits::default());
    alone.advance(1000).unwrap();
    assert_eq!(alone.ledger().relative_error(), 0.0);
}
