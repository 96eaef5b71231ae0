//! Between stages laws, walls and steps are switched: the ledger stays closed, contacts remember.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::*;
use pulvis_contact::normal::Interpolation;
use pulvis_contact::{ContactModel, Linear, Luding};
use pulvis_core::walls::{Cosine, PressureRamp, Servo, Velocity, Wall, WallMotion};
use pulvis_core::{Background, Interactions, Setup, SetupError, Simulation};
use pulvis_math::Vector3;

const EDGE: f64 = 10.0 * RADIUS;

/// A box of powder in the middle of its collapse: many contacts, all springs loaded.
fn powder(model: ContactModel) -> Simulation {
    let mut powder = implosion(40, EDGE, 9, model);
    powder.walls = cube_of_walls(EDGE);
    powder.walls.iter_mut().for_each(|wall| wall.material = 1);
    powder.interactions.set(0, 1, model);
    let mut simulation = start(Setup { background: gravity(9.81), ..powder }, 50.0);
    advance(&mut simulation, 1_500);
    assert!(simulation.ledger().elastic_sliding > 0.0 && simulation.ledger().dissipated_plastic > 0.0);
    simulation
}

fn interactions(particles: ContactModel, walls: ContactModel) -> Interactions {
    let mut interactions = Interactions::new(2);
    interactions.set(0, 0, particles);
    interactions.set(0, 1, walls);
    interactions
}

fn with_adhesion(kc: f64) -> ContactModel {
    let interpolation = Interpolation::Linear;
    let normal = Luding { k1: 100.0, kp: 500.0, kc, phi_f: 0.05, interpolation };
    ContactModel { normal: normal.into(), ..viscous_luding() }
}

/// Switches, and checks that the closing error is what it was before and goes on as small.
fn check_switch(name: &str, switch: impl FnOnce(&mut Simulation)) -> Simulation {
    let mut simulation = powder(viscous_luding());
    let before = simulation.ledger();
    switch(&mut simulation);
    let after = simulation.ledger();
    let jump = (after.closing_error() - before.closing_error()).abs();
    assert!(jump < 1e-13 * after.scale, "{name}: {jump} of {}", after.scale);
    assert_eq!(after.initial, before.initial);
    let worst = advance_watching(&mut simulation, 1_500, 10);
    assert!(worst < 1e-3, "{name}: {worst}");
    simulation
}

#[test]
fn every_switch_leaves_the_closing_error_as_it_was() {
    check_switch("sticky walls", |simulation| {
        simulation.set_interactions(interactions(viscous_luding(), with_adhesion(900.0))).unwrap();
    });
    check_switch("another law", |simulation| {
        let elastic = ContactModel { normal: Linear::new(500.0, 1e-3).into(), ..viscous_luding() };
        simulation.set_interactions(interactions(elastic, elastic)).unwrap();
    });
    check_switch("no friction", |simulation| {
        let bare = ContactModel::frictionless(with_adhesion(100.0).normal);
        simulation.set_interactions(interactions(bare, bare)).unwrap();
    });
    check_switch("a shorter step", |simulation| {
        simulation.set_time_step(0.3 * simulation.time_step()).unwrap();
    });
    check_switch("gravity sideways, and drag", |simulation| {
        let gravity = vector(3.0, 9.0, 0.0);
        simulation.set_background(Background { gravity, drag: 1e-5, rotational_drag: 1e-5 }).unwrap();
    });
    check_switch("a wall gone", |simulation| simulation.set_wall_present(4, false));
    check_switch("a wall that starts to move", |simulation| {
        let velocity = vector(0.01, 0.0, 0.05);
        simulation.set_wall_motion(4, WallMotion::Velocity(Velocity { velocity })).unwrap();
    });
    check_switch("a skin", |simulation| simulation.set_skin(0.05 * RADIUS).unwrap());
}

#[test]
fn a_wall_that_goes_takes_the_energy_of_its_contacts_with_it() {
    let mut pressed =
        setup(vec![sphere(vector(0.0, 0.0, 0.95 * RADIUS), Vector3::zero(), RADIUS)], elastic());
    pressed.walls = vec![floor()];
    let mut simulation = start(pressed, 50.0);
    let held = simulation.ledger().elastic_normal;
    assert!((held / (0.5 * 1000.0 * (0.05 * RADIUS).powi(2)) - 1.0).abs() < 1e-9);
    simulation.set_wall_present(0, false);
    let ledger = simulation.ledger();
    assert_eq!(ledger.elastic_normal, 0.0);
    assert!((ledger.switched + held).abs() < 1e-2 * held, "{ledger:?}");
    assert_eq!(ledger.closing_error(), 0.0);
    assert_eq!(simulation.wall_force(0), Vector3::zero());
    simulation.set_wall_present(0, true);
    assert_eq!(simulation.ledger().elastic_normal, held);
    assert!(simulation.ledger().switched.abs() < 1e-15 * held);
}

#[test]
fn a_switch_that_changes_nothing_changes_nothing() {
    // Without dashpots: those see the predicted velocity in a step, and the velocity itself after a
    // switch. What remains is the order of sums.
    let [mut plain, mut switched] = [0, 1].map(|_| powder(luding()));
    switched.set_interactions(interactions(luding(), luding())).unwrap();
    switched.set_time_step(switched.time_step()).unwrap();
    switched.set_wall_motion(0, WallMotion::Fixed).unwrap();
    switched.set_wall_present(1, true);
    assert!(switched.ledger().switched.abs() < 1e-14 * switched.ledger().scale);
    advance(&mut plain, 1_000);
    advance(&mut switched, 1_000);
    let difference = difference(plain.domain(), &states(&plain), &states(&switched));
    assert!(difference < 1e-10, "{difference}");
}

#[test]
fn contacts_keep_their_flattening_through_a_change_of_adhesion() {
    // Pressed to 0.05 radii and let go: without memory it would be a virgin contact.
    let deepest = |simulation: &Simulation| {
        let mut memory = 0.0_f64;
        simulation.for_each_contact(&mut |view| {
            let column = view.layout.column("overlap_max");
            memory = memory.max(column.map_or(0.0, |column| view.memory[column]));
        });
        memory
    };
    let mut simulation = powder(viscous_luding());
    let before = deepest(&simulation);
    assert!(before > 1e-6, "{before}");
    simulation.set_interactions(interactions(with_adhesion(200.0), with_adhesion(900.0))).unwrap();
    assert_eq!(deepest(&simulation), before);
    let elastic = ContactModel { normal: Linear::new(500.0, 1e-3).into(), ..viscous_luding() };
    simulation.set_interactions(interactions(elastic, elastic)).unwrap();
    assert_eq!(deepest(&simulation), 0.0);
}

#[test]
fn a_wall_that_is_away_stands_still_and_begins_its_motion_anew() {
    let displacement = vector(0.0, 0.0, 2.0 * RADIUS);
    let cosine = WallMotion::Cosine(Cosine { displacement, period: 1e-3, cycles: 0.5 });
    let mut far = setup(vec![sphere(vector(0.0, 0.0, 1.0), Vector3::zero(), RADIUS)], elastic());
    far.walls = vec![Wall { motion: cosine, ..floor() }];
    far.time_step = 1e-6;
    let mut simulation = Simulation::new(far).unwrap();
    simulation.set_wall_present(0, false);
    advance(&mut simulation, 700);
    assert_eq!(simulation.walls()[0].point, Vector3::zero());
    assert_eq!(simulation.wall_velocity(0), Vector3::zero());
    simulation.set_wall_present(0, true);
    advance(&mut simulation, 250);
    assert!((simulation.walls()[0].point.z / RADIUS - 1.0).abs() < 1e-9);
    advance(&mut simulation, 500);
    assert!((simulation.walls()[0].point.z / (2.0 * RADIUS) - 1.0).abs() < 1e-12);
    let velocity = vector(0.0, 0.0, 1.0);
    simulation.set_wall_motion(0, WallMotion::Velocity(Velocity { velocity })).unwrap();
    let servo =
        Servo { pressure: PressureRamp { from: 1e3, to: 1e3, duration: 0.0 }, mass: 1e-6, damping: 0.0 };
    // Without an area for the pressure to act on it cannot move so, and goes on as before.
    let refused = simulation.set_wall_motion(0, WallMotion::Servo(servo));
    assert_eq!(refused, Err(SetupError::NoArea { wall: 0 }));
    simulation.set_wall_present(0, false);
    let before = simulation.walls()[0].point;
    advance(&mut simulation, 100);
    assert_eq!(simulation.walls()[0].point, before);
}

#[test]
fn forces_of_a_program_move_particles_as_a_field_of_that_strength_does() {
    let ball = |x: f64| sphere(vector(x, 0.0, 1.5 * RADIUS), vector(0.0, 0.0, -0.2), RADIUS);
    let bed = |strength: f64| {
        let mut bed = setup(vec![ball(0.0), ball(2.5 * RADIUS)], viscous_luding());
        (bed.walls, bed.background) = (vec![floor()], gravity(strength));
        start(bed, 50.0)
    };
    let (mut fallen, mut pushed) = (bed(9.81), bed(0.0));
    let weight = vector(0.0, 0.0, -9.81 * ball(0.0).mass);
    pushed.set_applied_forces(&[weight, weight]).unwrap();
    let set = pushed.ledger().switched;
    for _ in 0..40 {
        fallen.advance(25).unwrap();
        pushed.advance(25).unwrap();
        // A program may set them again in every step.
        pushed.set_applied_forces(&[weight, weight]).unwrap();
    }
    assert!(fallen.ledger().dissipated_plastic > 0.0);
    // Gravity is added to the same sums in the same place; setting adds round-off to the force of one half kick.
    let apart = difference(fallen.domain(), &states(&fallen), &states(&pushed));
    assert!(apart < 1e-9 * RADIUS, "{apart} m");
    let (of_field, of_program) = (fallen.ledger(), pushed.ledger());
    // What is left open is what contacts leave open, whichever way the weight comes.
    let errors = [of_field, of_program].map(|ledger| ledger.relative_error());
    assert!(errors[0].abs() < 1e-3 && (errors[0] - errors[1]).abs() < 1e-9, "{errors:?}");
    // What the field takes from its potential is the work of the program, booked with what setting it changes.
    let potential = of_field.gravity - 2.0 * 9.81 * ball(0.0).mass * 1.5 * RADIUS;
    let work = of_program.switched - set;
    assert!((potential + work).abs() < 1e-9 * of_field.scale, "{potential} J, {work} J");
    let refused = pushed.set_applied_forces(&[weight]).unwrap_err().to_string();
    assert!(refused.contains("1 vectors for 2 particles"), "{refused}");
}

#[test]
fn what_a_program_sets_keeps_the_ledger_closed_and_the_memory_of_contacts() {
    let mut powder = implosion(60, 10.0 * RADIUS, 9, viscous_luding());
    powder.walls = cube_of_walls(40.0 * RADIUS);
    let mut simulation = start(powder, 50.0);
    simulation.advance(600).unwrap();
    let by_id = |simulation: &Simulation, of: fn(&pulvis_core::Particles) -> pulvis_core::Vectors<'_>| {
        let rows = simulation.particles().rows_by_id();
        let vectors = of(simulation.particles());
        rows.into_iter().map(|row| vectors[row]).collect::<Vec<_>>()
    };
    let remembered = |simulation: &Simulation| {
        let mut sum = (0, 0.0);
        simulation.for_each_contact(&mut |contact| sum = (sum.0 + 1, sum.1 + contact.memory[0]));
        sum
    };
    let (contacts, memory) = remembered(&simulation);
    assert!(contacts > 30 && memory > 0.0);
    let closing = simulation.ledger().closing_error();
    let shift = vector(0.3 * RADIUS, 0.0, 0.0);
    let positions = by_id(&simulation, |particles| particles.positions());
    let shifted: Vec<_> = positions.iter().map(|position| *position + shift).collect();
    simulation.set_positions(&shifted).unwrap();
    assert_eq!(by_id(&simulation, |particles| particles.positions()), shifted);
    // Overlaps change by round-off, and with them what contacts remember.
    let (same, kept) = remembered(&simulation);
    assert!(same == contacts && (kept / memory - 1.0).abs() < 1e-9, "{kept} {memory}");
    let before = simulation.ledger();
    let velocities = by_id(&simulation, |particles| particles.velocities());
    simulation
        .set_velocities(&velocities.iter().map(|velocity| *velocity * 2.0).collect::<Vec<_>>())
        .unwrap();
    let still = vec![Vector3::zero(); velocities.len()];
    simulation.set_angular_velocities(&still).unwrap();
    let after = simulation.ledger();
    let faster = after.kinetic_translation / before.kinetic_translation;
    assert!((faster - 4.0).abs() < 1e-12 && after.kinetic_rotation == 0.0, "{faster}");
    assert!((after.closing_error() - closing).abs() < 1e-12 * after.scale, "{after:?}");
    simulation.advance(300).unwrap();
    assert!(simulation.ledger().relative_error().abs() < 1e-3);
    let refused = simulation.set_velocities(&[vector(f64::NAN, 0.0, 0.0); 60]).unwrap_err().to_string();
    assert!(refused.contains("finite"), "{refused}");
}
