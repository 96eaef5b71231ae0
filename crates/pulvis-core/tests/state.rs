//! A state is everything that decides the next bit: what goes on from it goes on as if nothing had happened.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::*;
use pulvis_boundary::motion::AxisRotation;
use pulvis_contact::NonContact;
use pulvis_contact::noncontact::JumpIn;
use pulvis_core::walls::{Cosine, Extent, FaceArea, PressureRamp, Servo, Velocity, WallMotion};
use pulvis_core::{
    Background, Electrostatics, GroupMotion, MemoryError, NamedColumn, Region, Setup, SetupError, Simulation,
    State, StateError,
};

/// Every bit of a state, negative zeros and all.
fn bits(state: &State) -> String {
    format!("{state:?}")
}

fn import(setup: &Setup, state: &State) -> Result<Simulation, StateError> {
    Simulation::import_state(setup.interactions.clone(), setup.walls.clone(), state)
}

/// Advances a system to some steps, takes its state there, and lets a simulation that is made of it go on, with
/// another number of threads each time, beside one that has never been asked.
fn assert_goes_on_from_any_step(name: &str, setup: &Setup, mut never_asked: Simulation, steps: [u64; 4]) {
    let mut asked = never_asked.clone();
    let (mut mid_life, mut rebuilds) = (0, 0);
    for (number, steps) in steps.into_iter().enumerate() {
        never_asked.advance(steps).unwrap();
        asked.advance(steps).unwrap();
        let state = asked.export_state();
        assert_eq!(bits(&state), bits(&asked.export_state()), "{name}: another export gives something else");
        let mut imported = import(setup, &state).unwrap();
        assert_eq!(bits(&imported.export_state()), bits(&state), "{name}: not what was imported");
        assert_eq!(imported.candidates(), asked.candidates());
        assert_eq!(imported.contact_totals(), asked.contact_totals());
        assert_eq!(imported.ledger(), asked.ledger());
        mid_life += u64::from(state.list.steps > 0);
        imported.set_threads(1 + number % 3).unwrap();
        let mut going_on = asked.clone();
        // The last one in two goes, to see that states do not depend on how a run is cut.
        for steps in [137, 163] {
            imported.advance(steps).unwrap();
            going_on.advance(steps).unwrap();
            let same = bits(&imported.export_state()) == bits(&going_on.export_state());
            assert!(same, "{name}: other bits {steps} steps after step {}", state.step);
            assert_eq!(imported.ledger(), going_on.ledger());
        }
        rebuilds += imported.rebuilds() - state.list.rebuilds;
        // The run goes on from the import, as after a restart.
        asked = import(setup, &state).unwrap();
    }
    let same = bits(&asked.export_state()) == bits(&never_asked.export_state());
    assert!(same, "{name}: whoever is asked goes on in another way");
    assert!(
        mid_life >= 3 && rebuilds > 0,
        "{name}: {mid_life} in the middle of a list, {rebuilds} new lists"
    );
}

/// A powder that attracts itself at a distance, pressed by a servo wall along z while another wall swings along x:
/// the area of the servo's face depends on where the other one is.
fn pressed_bed() -> Setup {
    let mut model = viscous_luding();
    model.laws.noncontact = NonContact::JumpIn(JumpIn { f_a: 3e-5, kc_a: 0.3 });
    let edge = 14.0 * RADIUS;
    let mut bed = implosion(250, edge, 6, model);
    bed.walls = cube_of_walls(edge);
    for (index, wall) in bed.walls.iter_mut().enumerate() {
        wall.name = format!("{}-{index}", wall.name);
    }
    bed.background = Background { drag: 1e-7, rotational_drag: 1e-8, ..gravity(9.81) };
    let pressure = PressureRamp { from: 0.0, to: 200.0, duration: 1e-3 };
    bed.walls[5].motion = WallMotion::Servo(Servo { pressure, mass: 1e-5, damping: 1e-2 });
    bed.walls[5].area = FaceArea::Product([Extent::Between(0, 1), Extent::Given(edge)]);
    let displacement = vector(-RADIUS, 0.0, 0.0);
    bed.walls[1].motion = WallMotion::Cosine(Cosine { displacement, period: 2e-3, cycles: 10.0 });
    bed
}

#[test]
fn a_periodic_gas_goes_on_from_any_step() {
    let gas = elastic_gas(500);
    assert_goes_on_from_any_step("gas", &gas, start(gas.clone(), 30.0), [1, 206, 57, 311]);
}

#[test]
fn a_pressed_bed_with_all_kinds_of_memory_goes_on_from_any_step() {
    let bed = pressed_bed();
    let simulation = start(bed.clone(), 25.0);
    assert_goes_on_from_any_step("bed", &bed, simulation.clone(), [3, 401, 119, 77]);
    let mut later = simulation;
    later.advance(600).unwrap();
    let state = later.export_state();
    let remembered: usize = state.memory.iter().map(|table| table.first.len()).sum();
    assert!(state.memory.len() == 2 && remembered > 300, "{remembered}");
    let acting = state.list.active.iter().filter(|acts| **acts).count();
    assert!(acting > 20 && acting < state.list.active.len(), "{acting}");
}

#[test]
fn a_bed_that_a_program_pushes_goes_on_from_any_step() {
    let bed = pressed_bed();
    let mut simulation = start(bed.clone(), 25.0);
    simulation.advance(200).unwrap();
    let count = simulation.particles().len();
    // Another force for each, so that one that went to the wrong row would show.
    let forces: Vec<_> =
        (0..count).map(|id| vector(1e-7 * id as f64, -2e-7, 1e-8 * (id % 7) as f64)).collect();
    simulation.set_applied_forces(&forces).unwrap();
    let state = simulation.export_state();
    let of_second = state.particles.id.iter().position(|&id| id == 2).unwrap();
    assert_eq!(state.particles.applied_force[of_second], [2e-7, -2e-7, 2e-8]);
    assert_goes_on_from_any_step("pushed", &bed, simulation, [5, 303, 88, 150]);
    let mut damaged = state.clone();
    damaged.particles.applied_force.pop();
    let refused = import(&bed, &damaged).unwrap_err().to_string();
    assert!(refused.contains("`applied_force` has 249 entries, expected 250"), "{refused}");
}

#[test]
fn small_and_large_particles_that_fly_around_a_periodic_box_go_on_from_any_step() {
    let powder = wide_distribution(700, 7.0 * RADIUS, 0.7);
    assert_goes_on_from_any_step("wide", &powder, start(powder.clone(), 25.0), [2, 203, 150, 99]);
}

#[test]
fn charges_that_act_over_all_distances_go_on_from_any_step() {
    let mut cloud = implosion(300, 20.0 * RADIUS, 9, viscous_luding());
    cloud.interactions.set_electrostatics(Some(Electrostatics::default()));
    cloud.time_step = contact_time(&cloud) / 40.0;
    let values = (0..300).map(|index| if index % 2 == 0 { 3e-10 } else { -1e-10 }).collect();
    let charges = NamedColumn { name: "charge".to_owned(), unit: "C".to_owned(), values };
    let start = Simulation::with_columns(cloud.clone(), vec![charges]).unwrap();
    assert!(start.ledger().electrostatic != 0.0);
    assert_goes_on_from_any_step("charges", &cloud, start, [2, 203, 150, 99]);
}

#[test]
fn a_bed_with_grains_that_are_held_led_and_free_again_goes_on_from_any_step() {
    let bed = pressed_bed();
    let mut simulation = start(bed.clone(), 25.0);
    simulation.advance(900).unwrap();
    let period = 40.0 * simulation.time_step();
    let (displacement, cycles) = (vector(0.02 * RADIUS, 0.0, 0.0), 100.0);
    let middle = vector(7.0 * RADIUS, 7.0 * RADIUS, 7.0 * RADIUS);
    let axis = AxisRotation { point: middle, axis: vector(0.0, 1.0, 1.0), angular_velocity: 20.0 };
    let motions = [
        GroupMotion::Fixed,
        GroupMotion::Cosine(Cosine { displacement, period, cycles }),
        GroupMotion::Rotation(axis),
        GroupMotion::Velocity(Velocity { velocity: vector(0.0, 0.02, 0.0) }),
        GroupMotion::Free,
    ];
    for (number, motion) in motions.into_iter().enumerate() {
        let ids: Vec<u32> = (0..8).map(|member| 5 * member + number as u32).collect();
        simulation.set_group(&format!("group {number}"), &ids).unwrap();
        simulation.set_group_motion(&format!("group {number}"), motion).unwrap();
    }
    assert_goes_on_from_any_step("groups", &bed, simulation.clone(), [3, 201, 119, 77]);
    simulation.advance(400).unwrap();
    let ledger = simulation.ledger();
    let works: f64 = simulation.groups().iter().map(|group| group.work()).sum();
    assert!(works.abs() > 1e-3 * ledger.scale && ledger.relative_error().abs() < 1e-2, "{works} {ledger:?}");
}

#[test]
fn what_has_lost_and_won_particles_and_been_switched_goes_on_from_any_step() {
    let mut bed = pressed_bed();
    bed.walls[1].motion = WallMotion::Fixed;
    let mut simulation = start(bed.clone(), 25.0);
    let charges = (0..250).map(|id| f64::from(id) * 1e-12).collect();
    let charge = NamedColumn { name: "charge".into(), unit: "C".into(), values: charges };
    simulation.set_column(charge.clone()).unwrap();
    simulation.advance(333).unwrap();
    let middle = vector(7.0 * RADIUS, 7.0 * RADIUS, 7.0 * RADIUS);
    let removed = simulation.remove_within(&Region::Sphere { centre: middle, radius: 3.0 * RADIUS });
    assert!(removed.len() > 5, "{removed:?}");
    let guest = sphere(middle, vector(0.3, 0.0, -0.5), 0.8 * RADIUS);
    let id = simulation.insert_with(&[guest], &[NamedColumn { values: vec![7.0], ..charge }]).unwrap();
    simulation.set_wall_present(3, false);
    simulation.set_time_step(0.7 * simulation.time_step()).unwrap();
    simulation.set_background(gravity(5.0)).unwrap();
    simulation.set_skin(0.2 * RADIUS).unwrap();
    assert_goes_on_from_any_step("changed", &bed, simulation.clone(), [41, 60, 101, 33]);
    let mut restored = import(&bed, &simulation.export_state()).unwrap();
    assert_eq!(restored.insert_with(&[guest], &[]).unwrap_err(), {
        let problem = "particles have it, but no values are given for those that come".to_owned();
        SetupError::Column { name: "charge".to_owned(), problem }
    });
    let particles = restored.particles();
    let charge = &particles.column("charge").unwrap().values;
    let row = particles.rows_by_id()[particles.len() - 1];
    assert_eq!((particles.ids()[row], charge[row]), (id[0], 7.0));
    assert!(
        particles.ids().iter().zip(charge).all(|(&id, &charge)| id == 250 || charge == f64::from(id) * 1e-12)
    );
    restored.remove(&[250]).unwrap();
    assert_eq!(restored.export_state().next_id, 251);
}

#[test]
fn more_particles_than_the_grid_samples_and_some_far_away_are_listed_in_the_same_order_again() {
    // Where few fly far off, cells are made for a sample of the particles: it depends on the order they had before.
    let edge = 60.0 * RADIUS;
    let mut powder = implosion(9000, edge, 3, elastic());
    for (number, particle) in powder.particles.iter_mut().enumerate().filter(|(number, _)| number % 900 == 0)
    {
        particle.position += vector(5.0, -3.0, 2.0) * (1.0 + number as f64 / 900.0);
    }
    let mut simulation = start(powder.clone(), 25.0);
    simulation.advance(60).unwrap();
    let state = simulation.export_state();
    let mut imported = import(&powder, &state).unwrap();
    simulation.advance(60).unwrap();
    imported.advance(60).unwrap();
    assert!(bits(&imported.export_state()) == bits(&simulation.export_state()));
}

#[test]
fn a_simulation_without_particles_or_without_a_ledger_has_a_state_too() {
    let empty = Setup { time_step: 1e-6, ..setup(Vec::new(), elastic()) };
    let simulation = Simulation::new(empty.clone()).unwrap();
    let state = simulation.export_state();
    let mut imported = import(&empty, &state).unwrap();
    assert_eq!(bits(&imported.export_state()), bits(&state));
    imported.advance(10).unwrap();
    let gas = elastic_gas(100);
    let mut blind = start(gas.clone(), 30.0);
    blind.disable_ledger();
    blind.advance(50).unwrap();
    let mut imported = import(&gas, &blind.export_state()).unwrap();
    assert!(imported.ledger().closing_error().is_nan());
    imported.advance(50).unwrap();
    blind.advance(50).unwrap();
    assert_eq!(bits(&imported.export_state()), bits(&blind.export_state()));
}

/// The error of an import after something has been done to a sound state.
fn refusal(bed: &Setup, sound: &State, damage: impl FnOnce(&mut State)) -> StateError {
    let mut state = sound.clone();
    damage(&mut state);
    match import(bed, &state) {
        Err(error) => error,
        Ok(_) => panic!("a damaged state was taken in"),
    }
}

#[test]
fn a_damaged_state_is_refused() {
    let bed = pressed_bed();
    let mut simulation = start(bed.clone(), 25.0);
    simulation.advance(500).unwrap();
    let sound = simulation.export_state();
    let refused = |damage: fn(&mut State)| refusal(&bed, &sound, damage);
    let length =
        |column: &str, found, expected| StateError::Length { column: column.to_owned(), found, expected };
    assert_eq!(refused(|state| state.particles.radius.truncate(7)), length("radius", 7, 250));
    assert_eq!(refused(|state| state.particles.torque.clear()), length("torque", 0, 250));
    assert_eq!(refused(|state| state.walls.truncate(5)), length("walls", 5, 6));
    assert_eq!(refused(|state| state.list.former_row.truncate(249)), length("former_row", 249, 250));
    let value = |error: StateError| match error {
        StateError::Value { column, index, value, .. } => (column, index, value.to_string()),
        other => panic!("{other}"),
    };
    let expected = |column: &str, index: usize, value: &str| (column.to_owned(), index, value.to_owned());
    assert_eq!(
        value(refused(|state| state.particles.velocity[3][1] = f64::NAN)),
        expected("velocity", 3, "NaN")
    );
    assert_eq!(value(refused(|state| state.particles.radius[9] = -1.0)), expected("radius", 9, "-1"));
    assert_eq!(value(refused(|state| state.time_step = 0.0)), expected("time_step", 0, "0"));
    assert_eq!(value(refused(|state| state.list.former_row[4] = state.list.former_row[5])).0, "former_row");
    assert_eq!(value(refused(|state| state.list.former_row[0] = 250)), expected("former_row", 0, "250"));
    assert_eq!(value(refused(|state| state.ledger[2].1 = f64::NAN)).2, "NaN");
    let id = |error: StateError| match error {
        StateError::Id { id, .. } => id,
        other => panic!("{other}"),
    };
    assert_eq!(id(refused(|state| state.particles.id[0] = 999)), 999);
    assert_eq!(id(refused(|state| state.next_id = 100)), 249);
    let second = sound.particles.id[1];
    assert_eq!(id(refused(|state| state.particles.id[0] = state.particles.id[1])), second);
    let named = |error: StateError| match error {
        StateError::Name(error) => error.name,
        other => panic!("{other}"),
    };
    assert_eq!(named(refused(|state| state.ledger[0].0 = "elastic".to_owned())), "elastic_normal");
    assert_eq!(named(refused(|state| state.ledger.push(("heat".to_owned(), 1.0)))), "heat");
    assert_eq!(named(refused(|state| drop(state.walls[2].motion.pop()))), "displacement_z");
    let listed = refused(|state| state.list.position.swap(0, 200));
    assert!(matches!(listed, StateError::List { .. }), "{listed}");
    let blocks = refused(|state| state.list.active.push(true));
    assert!(matches!(blocks, StateError::List { .. }), "{blocks}");
    let chunks = refused(|state| state.list.remaining_skin.push(0.0));
    assert!(matches!(chunks, StateError::Length { .. }), "{chunks}");
    let memory = |error: StateError| match error {
        StateError::Memory(error) => error,
        other => panic!("{other}"),
    };
    assert!(matches!(
        memory(refused(|state| state.memory[0].columns[0].values[1] = f64::INFINITY)),
        MemoryError::Value { .. }
    ));
    assert!(matches!(
        memory(refused(|state| {
            state.memory[0].columns[0].values.pop();
        })),
        MemoryError::Length { .. }
    ));
    assert!(matches!(
        memory(refused(|state| state.memory[0].second[0] = 5_000)),
        MemoryError::NoContact { .. }
    ));
    assert!(matches!(
        memory(refused(|state| {
            let table = state.memory[0].clone();
            state.memory.push(table);
        })),
        MemoryError::Twice { .. }
    ));
}

#[test]
fn a_state_of_another_system_is_refused() {
    let bed = pressed_bed();
    let mut simulation = start(bed.clone(), 25.0);
    simulation.advance(500).unwrap();
    let state = simulation.export_state();
    let mut renamed = bed.clone();
    renamed.walls.swap(1, 2);
    let error = import(&renamed, &state).err().unwrap();
    assert_eq!(
        error.to_string(),
        "wall 1 of the state is `high-1`, expected `low-2`; give the walls of the exported simulation"
    );
    let mut without_torsion = bed.clone();
    let mut model = viscous_luding();
    model.laws.noncontact = NonContact::JumpIn(JumpIn { f_a: 3e-5, kc_a: 0.3 });
    model.laws.torsion = None;
    without_torsion.interactions.set(0, 0, model);
    let error = import(&without_torsion, &state).err().unwrap();
    assert!(matches!(error, StateError::Memory(MemoryError::Law { .. })), "{error}");
    let nothing = Setup { interactions: pulvis_core::Interactions::new(1), ..bed };
    let error = import(&nothing, &state).err().unwrap();
    assert_eq!(error, StateError::Setup(SetupError::NoModel { one: 0, other: 0 }));
}
