//! Several ranks advance a simulation together: the same bits for any number of them, and one word about what goes wrong.
//! Ranks are threads here; what they exchange is what processes exchange.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use std::sync::Arc;
use std::time::Duration;

use common::*;
use pulvis_boundary::Cuboid;
use pulvis_boundary::motion::{AxisRotation, PressureRamp};
use pulvis_contact::NonContact;
use pulvis_contact::bond;
use pulvis_contact::catalogue::Values;
use pulvis_contact::noncontact::JumpIn;
use pulvis_core::walls::{FaceArea, Mesh, Servo, TriangleMesh, Velocity, Wall, WallMotion};
use pulvis_core::{
    Alarm, Background, CellControl, CellMotion, Electrostatics, GroupMotion, Limits, NamedColumn, Region,
    Setup, Simulation, StepError,
};
use pulvis_math::Vector3;
use pulvis_parallel::exchange::ThreadRank;

/// What `work` answers on each of so many ranks.
fn on_ranks<T: Send>(ranks: usize, work: impl Fn(usize, Arc<ThreadRank>) -> T + Sync) -> Vec<T> {
    std::thread::scope(|scope| {
        let team = ThreadRank::patient_team(ranks, Duration::from_secs(20)).into_iter().enumerate();
        let work = &work;
        let started: Vec<_> =
            team.map(|(number, rank)| scope.spawn(move || work(number, Arc::new(rank)))).collect();
        started.into_iter().map(|thread| thread.join().unwrap()).collect()
    })
}

/// Everything that can be seen of a simulation, bit by bit.
fn seen(simulation: &Simulation) -> String {
    let mut contacts = Vec::new();
    simulation.for_each_contact(&mut |contact| contacts.push(format!("{contact:?}")));
    format!(
        "{:?}\n{:?}\n{:?}\n{:?}\n{contacts:?}",
        simulation.export_state(),
        simulation.ledger(),
        simulation.bonds(),
        simulation.candidates(),
    )
}

/// Runs a system alone and on several ranks: what is seen on every rank is what is seen alone. Answers with the one
/// that was alone.
fn assert_the_same_bits_on_any_number_of_ranks(
    name: &str,
    start: impl Fn() -> Simulation + Sync,
    run: impl Fn(&mut Simulation) + Sync,
) -> Simulation {
    let mut alone = start();
    run(&mut alone);
    let expected = seen(&alone);
    for (ranks, threads) in [(2, 1), (3, 2), (5, 1)] {
        let found = on_ranks(ranks, |number, rank| {
            let mut simulation = start();
            simulation.set_threads(threads).unwrap();
            simulation.set_exchange(rank);
            run(&mut simulation);
            (seen(&simulation) == expected, number, simulation.halo_rows())
        });
        for (is_same, number, _) in &found {
            assert!(is_same, "{name}: rank {number} of {ranks} has other bits than one rank");
        }
        assert!(found.iter().any(|(_, _, rows)| *rows > 0), "{name}: nothing was exchanged");
    }
    assert!(alone.rebuilds() > 2, "{name}: only {} lists", alone.rebuilds());
    alone
}

/// A powder that falls together, attracts itself at a distance, slides, rolls and twists, between walls of which one is
/// pushed by a pressure.
fn pressed_bed() -> Simulation {
    let mut model = viscous_luding();
    model.laws.noncontact = NonContact::JumpIn(JumpIn { f_a: 3e-5, kc_a: 0.3 });
    let edge = 20.0 * RADIUS;
    let mut bed = implosion(700, edge, 6, model);
    bed.walls = cube_of_walls(edge);
    bed.background = Background { drag: 1e-7, rotational_drag: 1e-8, ..gravity(9.81) };
    let pressure = PressureRamp { from: 0.0, to: 200.0, duration: 1e-3 };
    bed.walls[5].motion = WallMotion::Servo(Servo { pressure, mass: 1e-5, damping: 1e-2 });
    bed.walls[5].area = FaceArea::Given(edge * edge);
    start(bed, 25.0)
}

#[test]
fn a_pressed_bed_with_all_kinds_of_memory_has_the_same_bits_on_any_number_of_ranks() {
    let bed = assert_the_same_bits_on_any_number_of_ranks("bed", pressed_bed, |bed| {
        for steps in [700, 1, 2, 300] {
            bed.advance(steps).unwrap();
        }
    });
    let state = bed.export_state();
    let remembered: usize = state.memory.iter().map(|table| table.first.len()).sum();
    assert!(state.memory.len() == 2 && remembered > 700, "{remembered}");
    assert!(bed.wall_force(5).norm() > 0.0 && bed.ledger().dissipated_sliding > 0.0);
}

#[test]
fn particles_that_fly_around_a_periodic_box_through_all_ranks_have_the_same_bits() {
    // Radii from 0.15 to 1.5 `RADIUS`: lists of several levels. All fly several times through the box, with what their
    // contacts remember.
    let powder = || start(wide_distribution(900, 7.0 * RADIUS, 40.0), 25.0);
    let powder = assert_the_same_bits_on_any_number_of_ranks("powder", powder, |powder| {
        powder.advance(1500).unwrap();
    });
    let way = 40.0 * powder.time();
    assert!(way > 2.0 * 7.0 * RADIUS, "they flew {way} m only");
}

#[test]
fn charges_that_act_over_all_distances_have_the_same_bits_on_any_number_of_ranks() {
    let cloud = || {
        let mut cloud = implosion(700, 25.0 * RADIUS, 9, viscous_luding());
        cloud.interactions.set_electrostatics(Some(Electrostatics::default()));
        cloud.time_step = contact_time(&cloud) / 25.0;
        let values = (0..700).map(|index| if index % 2 == 0 { 3e-10 } else { -1e-10 }).collect();
        let charges = NamedColumn { name: "charge".to_owned(), unit: "C".to_owned(), values };
        Simulation::with_columns(cloud, vec![charges]).unwrap()
    };
    let cloud = assert_the_same_bits_on_any_number_of_ranks("charges", cloud, |cloud| {
        for steps in [500, 1, 2, 300] {
            cloud.advance(steps).unwrap();
        }
    });
    assert!(cloud.ledger().electrostatic != 0.0 && cloud.ledger().dissipated_sliding > 0.0);
}

#[test]
fn bonds_that_break_and_particles_that_come_and_go_have_the_same_bits_on_any_number_of_ranks() {
    let numbers = [
        ("normal_stiffness", 1e3),
        ("shear_stiffness", 5e2),
        ("bending_stiffness", 5e-5),
        ("torsion_stiffness", 3e-5),
        ("tensile_strength", 3e-3),
        ("shear_strength", 3e-3),
        ("bending_strength", 3e-3 * RADIUS),
        ("distance", 1e-8),
    ];
    let values = numbers.iter().fold(Values::new(), |values, (name, number)| values.with(name, *number));
    let clump = || {
        let mut model = elastic();
        model.laws.bond = Some(bond::build("elastic-brittle", &values).unwrap().unwrap().unwrap());
        let place = |index: usize| 2.0 * RADIUS * (index as f64 + 0.51);
        let cell = |number: usize| vector(place(number % 9), place(number / 9 % 9), place(number / 81));
        let falling = (0..729).map(|number| sphere(cell(number), vector(0.1, 0.0, -1.0), RADIUS)).collect();
        let mut clump = start(Setup { walls: vec![floor()], ..setup(falling, model) }, 30.0);
        assert_eq!(clump.form_bonds(), 1944);
        clump
    };
    let clump = assert_the_same_bits_on_any_number_of_ranks("clump", clump, |clump| {
        clump.advance(600).unwrap();
        let box_of_some = Cuboid { lower: vector(0.0, 0.0, 0.0), upper: vector(9.0, 9.0, 9.0) * RADIUS };
        clump.remove_within(&Region::Box(box_of_some));
        clump.insert(&[sphere(vector(9.0, 9.0, 30.0) * RADIUS, vector(0.0, 0.0, -2.0), RADIUS)]).unwrap();
        clump.advance(900).unwrap();
    });
    let bonds = clump.bonds();
    assert!(bonds.broken > 50 && bonds.intact > 50, "{bonds:?}");
}

#[test]
fn a_cell_that_is_sheared_under_a_stress_has_the_same_bits_on_any_number_of_ranks() {
    let sheared = || {
        let mut gas = elastic_gas(500);
        gas.interactions.set(0, 0, viscous_luding());
        let mut simulation = start(gas, 25.0);
        let mut motion = CellMotion { inertial_number: 0.1, ..CellMotion::default() };
        let constant = |stress: f64| PressureRamp { from: stress, to: stress, duration: 0.0 };
        motion.components[0] = CellControl::Stress(constant(300.0));
        motion.components[3] = CellControl::Rate(60.0);
        simulation.set_cell_motion(motion).unwrap();
        simulation
    };
    assert_the_same_bits_on_any_number_of_ranks("cell", sheared, |cell| cell.advance(400).unwrap());
}

#[test]
fn a_mesh_that_is_pushed_into_a_powder_has_the_same_bits_on_any_number_of_ranks() {
    let stirred = || {
        let edge = 22.0 * RADIUS;
        let mut bed = implosion(600, edge, 3, viscous_luding());
        let corner = |x: f64, y: f64| vector(x * edge, y * edge, -0.1 * RADIUS);
        let plate = [corner(0.1, 0.1), corner(0.9, 0.1), corner(0.9, 0.9), corner(0.1, 0.9)];
        let triangles = [[plate[0], plate[1], plate[2]], [plate[0], plate[2], plate[3]]];
        let surface = Arc::new(TriangleMesh::new(&triangles).unwrap());
        let mut wall = Wall::of_shape("mesh", 0, Vector3::zero(), Mesh::new(surface, vector(0.0, 0.0, 1.0)));
        wall.motion = WallMotion::Velocity(Velocity { velocity: vector(0.0, 0.0, 0.5) });
        bed.walls.push(wall);
        start(bed, 25.0)
    };
    let bed = assert_the_same_bits_on_any_number_of_ranks("mesh", stirred, |bed| bed.advance(900).unwrap());
    assert!(bed.wall_force(0).norm() > 0.0);
}

#[test]
fn a_group_that_is_led_through_a_powder_has_the_same_bits_on_any_number_of_ranks() {
    let led = || {
        let edge = 22.0 * RADIUS;
        let mut bed = start(implosion(600, edge, 3, viscous_luding()), 25.0);
        let group: Vec<u32> = (0..600).step_by(40).collect();
        bed.set_group("led", &group).unwrap();
        let (point, axis) = (vector(0.5, 0.5, 0.5) * edge, vector(0.0, 0.0, 1.0));
        let turning = AxisRotation { point, axis, angular_velocity: 20.0 };
        bed.set_group_motion("led", GroupMotion::Rotation(turning)).unwrap();
        bed
    };
    let bed = assert_the_same_bits_on_any_number_of_ranks("led", led, |bed| {
        bed.advance(400).unwrap();
        bed.advance(300).unwrap();
    });
    assert!(bed.groups()[0].work().abs() > 0.0);
}

#[test]
fn what_goes_wrong_on_one_rank_stops_all_with_the_same_words_and_the_same_state() {
    let run = |rank: Option<Arc<ThreadRank>>| {
        let mut bed = pressed_bed();
        // One grain is shot through the others.
        bed.insert(&[sphere(vector(10.0, 10.0, 19.0) * RADIUS, vector(0.0, 0.0, -20.0), 0.5 * RADIUS)])
            .unwrap();
        bed.set_limits(Limits { energy_error: f64::INFINITY, overlap: 0.4, ..Limits::default() });
        if let Some(rank) = rank {
            bed.set_exchange(rank);
        }
        let error: StepError = bed.advance(4000).unwrap_err();
        (error.to_string(), format!("{:?}", bed.first_deep_contact()), bed.steps())
    };
    let alone = run(None);
    assert!(alone.0.contains("overlap"), "{alone:?}");
    for found in on_ranks(3, |_, rank| run(Some(rank))) {
        assert_eq!(found, alone);
    }
}

#[test]
fn a_rank_that_is_lost_stops_the_others_with_a_message() {
    let errors = on_ranks(3, |number, rank| {
        let mut bed = pressed_bed();
        bed.set_exchange(rank);
        bed.advance(10).unwrap();
        if number == 1 {
            return None;
        }
        Some(bed.advance(10).unwrap_err())
    });
    for error in errors.into_iter().flatten() {
        let Alarm::RankLost { reason } = &error.alarm else { panic!("{error}") };
        assert!(reason.contains("is lost: it has ended"), "{reason}");
        assert!(error.to_string().contains("the ranks cannot go on together"), "{error}");
    }
}
