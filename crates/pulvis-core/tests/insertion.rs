//! Particles come and go between steps: the ledger stays closed, contacts of those that stay remember.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use std::collections::BTreeMap;

use common::*;
use pulvis_boundary::Cuboid;
use pulvis_core::{ContactPartner, Domain, Particle, Region, Setup, SetupError, Simulation};
use pulvis_math::Vector3;

const EDGE: f64 = 10.0 * RADIUS;

/// A box of powder in the middle of its collapse.
fn powder(count: usize, edge: f64) -> Simulation {
    let mut powder = implosion(count, edge, 9, viscous_luding());
    powder.walls = cube_of_walls(edge);
    let mut simulation = start(Setup { background: gravity(9.81), ..powder }, 50.0);
    simulation.advance(1_500).unwrap();
    assert!(simulation.ledger().elastic_sliding > 0.0 && simulation.ledger().dissipated_plastic > 0.0);
    simulation
}

fn falling(x: f64, z: f64) -> Particle {
    sphere(vector(x, 0.0, z), vector(0.1, 0.0, -0.2), RADIUS)
}

fn ids(simulation: &Simulation) -> Vec<u32> {
    let mut ids = simulation.particles().ids().to_vec();
    ids.sort_unstable();
    ids
}

/// Overlap and memory of every contact, by its bodies.
fn contacts(simulation: &Simulation) -> BTreeMap<(u32, i64), (f64, Vec<f64>)> {
    let mut contacts = BTreeMap::new();
    simulation.for_each_contact(&mut |contact| {
        let second = match contact.second {
            ContactPartner::Particle(id) => i64::from(id),
            ContactPartner::Wall(index) => -1 - index as i64,
        };
        contacts.insert((contact.first, second), (contact.overlap, contact.memory.to_vec()));
    });
    contacts
}

/// The same contacts with the same memory. Springs are turned into the plane of the contact whenever a force is
/// computed: round-off of their components.
fn assert_same_contacts(found: &Simulation, expected: &BTreeMap<(u32, i64), (f64, Vec<f64>)>) {
    let found = contacts(found);
    // A view shows contacts that act: none may have begun or ceased to.
    assert!(found.keys().eq(expected.keys()));
    for ((bodies, (overlap, memory)), (overlap_before, before)) in found.iter().zip(expected.values()) {
        assert_eq!((overlap, memory[0]), (overlap_before, before[0]), "{bodies:?}");
        let length = before.iter().map(|value| value * value).sum::<f64>().sqrt();
        let same = memory.iter().zip(before).all(|(one, other)| (one - other).abs() <= 1e-13 * length);
        assert!(same, "{bodies:?}: {memory:?} {before:?}");
    }
}

/// Free flight under constant forces, far from each other: each particle's change of velocity is its force times the time
/// over its mass.
#[test]
fn forces_of_a_program_stay_with_their_particles_and_inserted_ones_have_none() {
    let still = |x: f64| Particle { velocity: Vector3::zero(), ..falling(x, 1.0) };
    let mut simulation = start(setup(vec![still(0.0), still(1.0), still(2.0)], elastic()), 50.0);
    simulation.set_applied_forces(&[1e-6, 2e-6, 3e-6].map(|along| vector(0.0, along, 0.0))).unwrap();
    // To the left of all others: it gets the first row.
    assert_eq!(simulation.insert(&[still(-3.0), still(7.0)]).unwrap(), [3, 4]);
    simulation.remove(&[1]).unwrap();
    let steps = 400;
    simulation.advance(steps).unwrap();
    let (particles, time) = (simulation.particles(), steps as f64 * simulation.time_step());
    let speed = |force: f64| force * time / still(0.0).mass;
    for (row, expected) in particles.rows_by_id().into_iter().zip([1e-6, 3e-6, 0.0, 0.0].map(speed)) {
        let found = particles.velocities()[row];
        // Two kicks a step, each of round-off.
        let close = (found.y - expected).abs() <= 1e-13 * speed(3e-6);
        assert!(close && found.x == 0.0 && found.z == 0.0, "id {}: {found:?}", particles.ids()[row]);
    }
    let applied = particles.applied_forces().unwrap();
    let of = |id: u32| applied[particles.ids().iter().position(|&other| other == id).unwrap()].y;
    assert_eq!([0, 2, 3, 4].map(of), [1e-6, 3e-6, 0.0, 0.0]);
    let refused = simulation.set_applied_forces(&[Vector3::zero(); 3]).unwrap_err().to_string();
    assert!(refused.contains("3 vectors for 4 particles; give one for each that is there now"), "{refused}");
    simulation.set_applied_forces(&[vector(0.0, -1e-6, 0.0); 4]).unwrap();
    simulation.advance(1).unwrap();
    simulation.set_applied_forces(&[]).unwrap();
    assert!(simulation.particles().applied_forces().is_none());
}

#[test]
fn ids_count_on_and_are_never_given_twice() {
    let mut simulation = start(setup(vec![falling(0.0, 1.0), falling(1.0, 1.0)], elastic()), 50.0);
    assert_eq!(simulation.insert(&[falling(2.0, 1.0), falling(3.0, 1.0)]).unwrap(), [2, 3]);
    simulation.remove(&[3, 1, 3]).unwrap();
    assert_eq!(ids(&simulation), [0, 2]);
    assert_eq!(simulation.insert(&[falling(4.0, 1.0)]).unwrap(), [4]);
    assert_eq!(simulation.remove_where(|particles, row| particles.ids()[row] != 2), [0, 4]);
    assert_eq!(simulation.insert(&[]).unwrap(), []);
    assert_eq!(ids(&simulation), [2]);
}

#[test]
fn what_a_particle_carries_in_and_out_is_its_kinetic_potential_and_elastic_energy() {
    // Pressed into the floor by 4 % of its radius, without losses: all parts in closed form.
    let mut bed = setup(vec![falling(0.0, 1.0)], elastic());
    (bed.walls, bed.background) = (vec![floor()], gravity(9.81));
    let mut simulation = start(bed, 50.0);
    simulation.advance(100).unwrap();
    let before = simulation.ledger();
    let (height, overlap) = (0.96 * RADIUS, 0.04 * RADIUS);
    let mut guest = falling(0.5, height);
    guest.angular_velocity = vector(30.0, -10.0, 5.0);
    let ids = simulation.insert(&[guest]).unwrap();
    let after = simulation.ledger();
    let rotation = 0.5 * 0.4 * guest.mass * RADIUS * RADIUS * guest.angular_velocity.norm_squared();
    let kinetic = 0.5 * guest.mass * guest.velocity.norm_squared() + rotation;
    let force = 1000.0 * overlap - guest.mass * 9.81;
    let discretisation =
        -0.125 * simulation.time_step() * simulation.time_step() * force * force / guest.mass;
    let elastic = 0.5 * 1000.0 * overlap * overlap;
    let expected = kinetic + elastic + guest.mass * 9.81 * height + discretisation;
    // Differences of sums that are some hundred times as large.
    let scale = after.stored().abs();
    assert!((after.inflow - expected).abs() < 1e-14 * scale, "{} {expected}", after.inflow);
    assert!((after.elastic_normal / elastic - 1.0).abs() < 1e-12);
    assert!((after.closing_error() - before.closing_error()).abs() < 1e-14 * scale);
    assert_eq!((after.outflow, after.switched, after.dissipated()), (0.0, 0.0, 0.0));
    simulation.remove(&ids).unwrap();
    let gone = simulation.ledger();
    assert!((gone.outflow - expected).abs() < 1e-14 * scale, "{} {expected}", gone.outflow);
    assert!((gone.closing_error() - before.closing_error()).abs() < 1e-14 * scale);
    assert_eq!(gone.elastic_normal, before.elastic_normal);
}

#[test]
fn plastic_work_that_was_done_before_a_contact_came_in_is_not_booked_as_lost_here() {
    let mut simulation = powder(40, EDGE);
    let before = simulation.ledger();
    // Deep in the corner, behind everything: overlaps two walls.
    simulation.insert(&[sphere(vector(0.0, 0.0, 0.0), Vector3::zero(), 0.2 * RADIUS)]).unwrap();
    let after = simulation.ledger();
    assert_eq!(after.dissipated(), before.dissipated());
    assert!(after.inflow > 0.0 && after.inflow.is_finite());
}

#[test]
fn the_closing_error_does_not_move_when_particles_come_or_go_and_stays_as_small_afterwards() {
    let mut simulation = powder(40, EDGE);
    let before = simulation.ledger();
    let leaving: Vec<u32> = (0..40).step_by(3).collect();
    simulation.remove(&leaving).unwrap();
    let removed = simulation.ledger();
    let round_off = 1e-13 * removed.scale.max(before.scale);
    assert!((removed.closing_error() - before.closing_error()).abs() < round_off);
    assert!(removed.outflow > 0.0 && removed.inflow == 0.0);
    assert_eq!(removed.dissipated(), before.dissipated());
    let top = 0.9 * EDGE;
    let guests: Vec<Particle> = (1..5)
        .map(|number| {
            sphere(vector(f64::from(number) * 2.0 * RADIUS, top, top), vector(0.1, -0.3, -0.5), RADIUS)
        })
        .collect();
    assert_eq!(simulation.insert(&guests).unwrap(), [40, 41, 42, 43]);
    let inserted = simulation.ledger();
    assert!((inserted.closing_error() - before.closing_error()).abs() < round_off);
    let carried: f64 = guests.iter().map(|guest| 0.5 * guest.mass * guest.velocity.norm_squared()).sum();
    assert!(inserted.inflow > carried, "{} {carried}", inserted.inflow);
    // The same bound as for switches (tests/stages.rs).
    let worst = advance_watching(&mut simulation, 1_500, 10);
    assert!(worst < 1e-3, "{worst}");
    assert_eq!(simulation.particles().len(), 30);
}

#[test]
fn contacts_of_those_that_stay_keep_their_memory_when_chunks_are_cut_again() {
    // 1800 rows are cut into chunks of 150, 1500 into chunks of 128.
    let edge = 32.0 * RADIUS;
    let mut simulation = powder(1800, edge);
    let before = contacts(&simulation);
    let leaving: Vec<u32> = (0..1800).filter(|id| id % 6 == 1).collect();
    simulation.remove(&leaving).unwrap();
    let left = |id: i64| id < 0 || id % 6 != 1;
    let mut expected = before;
    expected.retain(|&(first, second), _| left(i64::from(first)) && left(second));
    let flattened = expected.values().filter(|(_, memory)| memory[0] > 0.0).count();
    assert!(flattened > 300, "{flattened}");
    assert_same_contacts(&simulation, &expected);
    let above = vector(0.5 * edge, 0.5 * edge, 40.0 * edge);
    let guests: Vec<Particle> = (0..300)
        .map(|number| {
            sphere(above + vector(0.0, 0.0, f64::from(number) * 3.0 * RADIUS), Vector3::zero(), RADIUS)
        })
        .collect();
    // No lid: what is behind it would be pressed on.
    simulation.set_wall_present(5, false);
    let before = contacts(&simulation);
    simulation.insert(&guests).unwrap();
    assert_same_contacts(&simulation, &before);
    assert_eq!(simulation.particles().len(), 1800);
}

#[test]
fn whether_particles_stand_there_from_the_start_or_are_inserted_before_the_first_step_is_the_same() {
    let all = Setup { walls: cube_of_walls(EDGE), ..implosion(60, EDGE, 4, viscous_luding()) };
    let time_step = contact_time(&all) / 50.0;
    let whole = Setup { time_step, ..all.clone() };
    let mut half = whole.clone();
    half.particles.truncate(30);
    let [mut whole, mut half] = [whole, half].map(|setup| Simulation::new(setup).unwrap());
    half.insert(&all.particles[30..]).unwrap();
    for simulation in [&mut whole, &mut half] {
        simulation.advance(1_000).unwrap();
    }
    // Contacts add up in another order; collisions multiply such rounding errors.
    let difference = difference(whole.domain(), &states(&whole), &states(&half));
    assert!(difference < 1e-9, "{difference}");
    let [whole, half] = [whole, half].map(|simulation| simulation.ledger());
    assert!(whole.dissipated() > 0.0 && (half.dissipated() / whole.dissipated() - 1.0).abs() < 1e-9);
    assert!(((half.inflow + half.initial) / whole.initial - 1.0).abs() < 1e-12);
}

#[test]
fn who_stays_moves_as_if_those_out_of_reach_had_never_been_there() {
    // Without dashpots: those see the predicted velocity in a step, and the velocity itself after a removal.
    let near = implosion(30, EDGE, 4, luding());
    let mut both = near.clone();
    let mut far = near.particles.clone();
    far.iter_mut().for_each(|particle| particle.position.x += 5.0 * EDGE);
    both.particles.splice(0..0, far);
    let time_step = contact_time(&near) / 50.0;
    let [mut near, mut both] =
        [near, both].map(|setup| Simulation::new(Setup { time_step, ..setup }).unwrap());
    near.advance(700).unwrap();
    both.advance(700).unwrap();
    let corner = vector(3.0 * EDGE, -EDGE, -EDGE);
    let removed = both.remove_within(&Region::Box(Cuboid { lower: corner, upper: vector(1.0, 1.0, 1.0) }));
    assert_eq!(removed, (0..30).collect::<Vec<_>>());
    near.advance(700).unwrap();
    both.advance(700).unwrap();
    let difference = difference(near.domain(), &states(&near), &states(&both));
    assert!(difference < 1e-9, "{difference}");
}

#[test]
fn all_may_leave_and_others_may_come() {
    let mut simulation = powder(20, EDGE);
    let before = simulation.ledger();
    let everywhere = Region::Sphere { centre: Vector3::zero(), radius: 1.0 };
    assert_eq!(simulation.remove_within(&everywhere).len(), 20);
    simulation.advance(100).unwrap();
    let empty = simulation.ledger();
    assert_eq!((empty.kinetic(), empty.elastic(), simulation.candidates()), (0.0, 0.0, 0));
    assert!((empty.closing_error() - before.closing_error()).abs() < 1e-13 * before.scale);
    let guests = implosion(30, EDGE, 3, viscous_luding()).particles;
    simulation.insert(&guests).unwrap();
    let worst = advance_watching(&mut simulation, 1_000, 10);
    assert!(worst < 1e-3, "{worst}");
    let mut never_any = Simulation::new(Setup { time_step: 1e-6, ..setup(Vec::new(), elastic()) }).unwrap();
    assert_eq!(never_any.insert(&guests).unwrap(), (0..30).collect::<Vec<_>>());
    never_any.advance(1_000).unwrap();
    assert!(never_any.candidates() > 0);
}

#[test]
fn a_refused_insertion_or_removal_changes_nothing() {
    let edge = 5.0 * RADIUS;
    let domain = Domain::periodic(Vector3::zero(), vector(edge, 1.0, 1.0), [true, false, false]);
    let gas = Setup { domain, ..setup(vec![falling(0.0, 0.1), falling(2.0 * RADIUS, 0.2)], elastic()) };
    let mut simulation = start(gas, 50.0);
    simulation.advance(10).unwrap();
    let mut untouched = simulation.clone();
    let stranger = Particle { material: 7, ..falling(0.0, 0.5) };
    assert_eq!(simulation.insert(&[stranger]), Err(SetupError::NoModel { one: 0, other: 7 }));
    let huge = sphere(vector(0.0, 0.0, 0.5), Vector3::zero(), 3.0 * RADIUS);
    let refused = simulation.insert(&[huge]).unwrap_err();
    assert!(matches!(refused, SetupError::ShortPeriod { axis: 0, .. }), "{refused}");
    assert_eq!(simulation.remove(&[1, 2]), Err(SetupError::UnknownParticle { id: 2 }));
    assert_eq!(simulation.remove_where(|_, _| false), []);
    for simulation in [&mut simulation, &mut untouched] {
        simulation.advance(500).unwrap();
    }
    assert_eq!(states(&simulation), states(&untouched));
    assert_eq!(simulation.rebuilds(), untouched.rebuilds());
    assert_eq!(simulation.insert(&[falling(0.0, 0.5)]).unwrap(), [2]);
}

#[test]
fn the_bits_after_insertion_and_removal_are_the_same_for_any_number_of_threads() {
    let run = |threads: usize| {
        let edge = 24.0 * RADIUS;
        let powder = Setup { walls: cube_of_walls(edge), ..implosion(700, edge, 5, viscous_luding()) };
        let mut simulation = start(powder, 25.0);
        simulation.set_threads(threads).unwrap();
        simulation.advance(400).unwrap();
        let core = Region::Sphere { centre: vector(0.5 * edge, 0.5 * edge, 0.5 * edge), radius: 0.2 * edge };
        assert!(simulation.remove_within(&core).len() > 20);
        simulation.advance(300).unwrap();
        let guest = sphere(vector(0.5 * edge, 0.5 * edge, 0.5 * edge), vector(0.0, 0.0, 1.0), 0.2 * RADIUS);
        simulation.insert(&[guest]).unwrap();
        simulation.advance(300).unwrap();
        (states(&simulation), simulation.ledger())
    };
    let one = run(1);
    assert!(one.1.outflow > 0.0 && one.1.inflow > 0.0);
    for threads in [2, 3] {
        assert_eq!(run(threads), one, "{threads} threads");
    }
}
