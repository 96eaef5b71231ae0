//! The bitwise contract: whatever only changes how fast the engine is leaves every bit as it was.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::*;
use pulvis_contact::noncontact::JumpIn;
use pulvis_contact::{ContactModel, Linear, NonContact};
use pulvis_core::walls::{Cylinder, CylinderSide, FaceArea, PressureRamp, Rotation, Servo, Wall, WallMotion};
use pulvis_core::{Background, ContactPartner, Domain, InstructionSet, Setup, Simulation};
use pulvis_math::Vector3;

const STEPS_PER_CONTACT: f64 = 25.0;

/// How a system is advanced; the physics is the same for all.
#[derive(Clone, Copy, Debug)]
struct Way {
    threads: usize,
    instructions: InstructionSet,
    ledger: bool,
    /// Steps at a time.
    at_a_time: u64,
}

impl Way {
    /// One thread, the plainest instructions, step by step.
    fn plainest() -> Self {
        Self { threads: 1, instructions: InstructionSet::available()[0], ledger: true, at_a_time: 1 }
    }

    fn advance(self, setup: &Setup, steps: u64) -> Simulation {
        let mut simulation = start(setup.clone(), STEPS_PER_CONTACT);
        simulation.set_threads(self.threads).unwrap();
        assert_eq!(simulation.threads(), self.threads);
        simulation.set_instructions(self.instructions);
        if !self.ledger {
            simulation.disable_ledger();
        }
        let mut left = steps;
        while left > 0 {
            let now = self.at_a_time.min(left);
            if self.at_a_time == 1 {
                simulation.step().unwrap();
            } else {
                simulation.advance(now).unwrap();
            }
            left -= now;
        }
        simulation
    }
}

type Bits = Vec<(String, Vec<u64>)>;

fn bits_of(vectors: impl Iterator<Item = Vector3>) -> Vec<u64> {
    vectors.flat_map(Vector3::to_array).map(f64::to_bits).collect()
}

/// Every number of the state by the names of its kinds: particles in the order of their ids, walls, and
/// contacts in the order of the engine.
fn state(simulation: &Simulation) -> Bits {
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    let columns = [
        ("positions", particles.positions()),
        ("velocities", particles.velocities()),
        ("spins", particles.angular_velocities()),
        ("forces", particles.forces()),
        ("torques", particles.torques()),
    ];
    let mut bits: Bits = columns
        .into_iter()
        .map(|(name, column)| (name.to_owned(), bits_of(rows.iter().map(|&row| column[row]))))
        .collect();
    for (place, wall) in simulation.walls().iter().enumerate() {
        let motion = [wall.point, simulation.wall_velocity(place), simulation.wall_force(place)];
        let mut of_wall = bits_of(motion.into_iter());
        of_wall.push(simulation.wall_torque(place).to_bits());
        bits.push((format!("wall {place}"), of_wall));
    }
    bits.push(("rows".to_owned(), rows.into_iter().map(|row| row as u64).collect()));
    let mut contacts = Vec::new();
    simulation.for_each_contact(&mut |contact| {
        contacts.push(u64::from(contact.first));
        contacts.push(match contact.second {
            ContactPartner::Particle(id) => u64::from(id),
            ContactPartner::Wall(place) => !(place as u64),
        });
        contacts.extend([contact.overlap, contact.normal_force].map(f64::to_bits));
        contacts.extend(contact.memory.iter().map(|column| column.to_bits()));
        contacts.extend(bits_of([contact.force].into_iter()));
    });
    bits.push(("contacts".to_owned(), contacts));
    bits.push((
        "time, steps, lists".to_owned(),
        vec![
            simulation.time().to_bits(),
            simulation.steps(),
            simulation.rebuilds(),
            simulation.candidates() as u64,
        ],
    ));
    bits
}

/// The ledger, account by account.
fn accounts(simulation: &Simulation) -> Bits {
    let accounts = simulation.ledger().accounts();
    accounts.into_iter().map(|(name, energy)| (name.to_string(), vec![energy.to_bits()])).collect()
}

fn assert_same(way: Way, found: &Bits, expected: &Bits) {
    assert_eq!(found.len(), expected.len());
    for ((name, bits), (_, plainest)) in found.iter().zip(expected) {
        let differing = bits.iter().zip(plainest).filter(|(one, other)| one != other).count();
        let all = plainest.len();
        assert!(
            bits.len() == all && differing == 0,
            "{way:?}: {name}: {differing} of {all} numbers differ from those of the plainest way"
        );
    }
}

/// Advances the system in every way that is offered, and answers with what the plainest came to.
fn assert_the_same_bits_in_every_way(setup: &Setup, steps: u64) -> Simulation {
    let plainest = Way::plainest().advance(setup, steps);
    let (state_expected, accounts_expected) = (state(&plainest), accounts(&plainest));
    let mut ways = Vec::new();
    for (number, &instructions) in InstructionSet::available().iter().enumerate() {
        // Every number of threads with every instruction set, alternately with and without the ledger.
        for (place, threads) in [1, 2, 3, 8].into_iter().enumerate() {
            ways.push(Way { threads, instructions, ledger: (number + place) % 2 == 0, at_a_time: steps });
        }
        ways.push(Way { instructions, at_a_time: 7, ..Way::plainest() });
    }
    ways.push(Way { ledger: false, ..Way::plainest() });
    for way in ways {
        let simulation = way.advance(setup, steps);
        assert_same(way, &state(&simulation), &state_expected);
        if way.ledger {
            assert_same(way, &accounts(&simulation), &accounts_expected);
        }
    }
    assert!(plainest.rebuilds() > 2, "only {} new lists of candidates", plainest.rebuilds());
    plainest
}

/// Contacts that press, and those that only pull.
fn touching(simulation: &Simulation) -> [usize; 2] {
    let mut counts = [0; 2];
    simulation.for_each_contact(&mut |contact| counts[usize::from(contact.overlap <= 0.0)] += 1);
    counts
}

#[test]
fn linear_contacts_that_slide_have_the_same_bits_however_they_are_computed() {
    let mut model = ContactModel::frictionless(Linear::new(1000.0, 1e-2));
    model.laws.sliding = Some(slider(300.0, 1e-4, 0.5));
    let edge = 22.0 * RADIUS;
    let mut setup = implosion(700, edge, 5, model);
    setup.walls = cube_of_walls(edge);
    // What pushes back on the wall that a pressure drives moves it: its force comes back in all others.
    let lid = setup.walls.len() - 1;
    let pressure = PressureRamp { from: 0.0, to: 200.0, duration: 1e-3 };
    setup.walls[lid].motion = WallMotion::Servo(Servo { pressure, mass: 1e-5, damping: 1e-2 });
    setup.walls[lid].area = FaceArea::Given(edge * edge);
    let simulation = assert_the_same_bits_in_every_way(&setup, 1200);
    let [pressing, _] = touching(&simulation);
    assert!(pressing > 150, "only {pressing} contacts: too little to disagree about");
    assert!(simulation.wall_force(lid).norm() > 0.0);
    assert!(simulation.ledger().dissipated_sliding > 0.0);
}

#[test]
fn viscous_luding_contacts_that_slide_roll_twist_and_attract_have_the_same_bits_however_they_are_computed() {
    let mut model = viscous_luding();
    model.laws.noncontact = NonContact::JumpIn(JumpIn { f_a: 3e-5, kc_a: 0.3 });
    let edge = 20.0 * RADIUS;
    let mut setup = implosion(500, edge, 6, model);
    setup.walls = cube_of_walls(edge);
    setup.background = Background { drag: 1e-7, ..gravity(9.81) };
    let simulation = assert_the_same_bits_in_every_way(&setup, 700);
    let [pressing, pulling] = touching(&simulation);
    assert!(pressing > 300 && pulling > 10, "{pressing} pressing, {pulling} pulling");
    let ledger = simulation.ledger();
    let without = ["dissipated_capillary", "dissipated_fracture", "dissipated_thermal"];
    let dissipated = |name: &str| name.contains("dissipated") && !without.contains(&name);
    for (name, energy) in ledger.accounts().into_iter().filter(|(name, _)| dissipated(name)) {
        assert!(energy > 0.0, "{name}");
    }
}

#[test]
fn small_and_large_particles_have_the_same_bits_however_they_are_computed() {
    let setup = wide_distribution(1800, 9.0 * RADIUS, 0.7);
    let simulation = assert_the_same_bits_in_every_way(&setup, 800);
    let mut across = 0;
    let mut pressing = 0;
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    simulation.for_each_contact(&mut |contact| {
        pressing += 1;
        if let ContactPartner::Particle(second) = contact.second {
            let apart = contact.centre_second - particles.positions()[rows[second as usize]];
            across += usize::from(apart.norm() > RADIUS);
        }
    });
    assert!(pressing > 200, "only {pressing} contacts: too little to disagree about");
    assert!(across > 5, "only {across} contacts across the periodic boundary");
}

#[test]
fn grains_in_a_drum_that_rotates_have_the_same_bits_however_they_are_computed() {
    let edge = 18.5 * RADIUS;
    let mut setup = implosion(380, edge, 5, viscous_luding());
    let middle = vector(0.5 * edge, 0.0, 0.5 * edge);
    let (axis, upper) = (vector(0.0, 1.0, 0.0), vector(1.0, 21.5 * RADIUS, 1.0));
    setup.domain = Domain::periodic(Vector3::zero(), upper, [false, true, false]);
    for particle in &mut setup.particles {
        particle.velocity = particle.velocity * -1.5;
    }
    let motion = WallMotion::Rotation(Rotation { angular_velocity: 60.0 });
    let drum = Cylinder { axis, radius: 14.5 * RADIUS, side: CylinderSide::Inside };
    setup.walls = vec![Wall { motion, ..Wall::of_shape("drum", 0, middle, drum) }];
    let simulation = assert_the_same_bits_in_every_way(&setup, 800);
    let mut at_wall = 0;
    simulation.for_each_contact(&mut |contact| {
        at_wall += usize::from(matches!(contact.second, ContactPartner::Wall(_)));
    });
    assert!(at_wall > 10, "only {at_wall} contacts with the drum");
    assert!(simulation.wall_torque(0).abs() > 0.0 && simulation.ledger().work_walls.abs() > 0.0);
}

#[test]
fn another_order_of_sums_would_be_seen_in_the_bits() {
    // The control of this file: with another skin the same contacts stand in other blocks, and nothing
    // but the order changes in which their forces and torques are summed.
    let setup = wide_distribution(1800, 9.0 * RADIUS, 0.7);
    let way = Way::plainest();
    let usual = state(&way.advance(&setup, 1000));
    let mut simulation = start(setup, STEPS_PER_CONTACT);
    simulation.set_instructions(way.instructions);
    simulation.set_skin(0.1 * RADIUS).unwrap();
    simulation.advance(1000).unwrap();
    let ((name, one), (_, other)) = (&state(&simulation)[0], &usual[0]);
    assert_eq!(name, "positions");
    let differing = one.iter().zip(other).filter(|(one, other)| one != other).count();
    assert!(differing > 10, "only {differing} of {} numbers differ", one.len());
}
