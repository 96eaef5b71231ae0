//! Laws that read what the bodies carry, and the temperature.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_contact::catalogue::Values;
use pulvis_contact::{ContactModel, NonContact, Normal};
use pulvis_core::{InstructionSet, NamedColumn, Setup, SetupError, Simulation, TemperatureProgram};

/// 1/(4 π ε_0) [N m²/C²].
const COULOMB_CONSTANT: f64 = 8.987_551_792_3e9;

fn normal(name: &str, numbers: &[(&str, f64)]) -> ContactModel {
    let values = numbers.iter().fold(Values::new(), |values, (name, number)| values.with(name, *number));
    ContactModel::frictionless(Normal::build(name, &values).unwrap().unwrap())
}

fn charged(mut model: ContactModel, cutoff: f64) -> ContactModel {
    let values = Values::new().with("cutoff", cutoff);
    model.laws.noncontact = NonContact::build("coulomb", &values).unwrap().unwrap();
    model
}

fn column(name: &str, unit: &str, values: Vec<f64>) -> NamedColumn {
    NamedColumn { name: name.to_owned(), unit: unit.to_owned(), values }
}

#[test]
fn two_opposite_charges_go_round_each_other_as_kepler_says() {
    let (radius, charge, distance) = (1e-3, 1e-11, 4e-3);
    let at = |x: f64, y: f64| sphere(vector(x, 0.0, 0.0), vector(0.0, y, 0.0), radius);
    let mass = at(0.0, 0.0).mass;
    let strength = COULOMB_CONSTANT * charge * charge / (0.5 * mass);
    // At the far end with nine tenths of the speed of a circle: A = r/(2 − 0.81).
    let speed = 0.9 * (strength / distance).sqrt();
    let half_axis = distance / 1.19;
    let period = std::f64::consts::TAU * (half_axis * half_axis * half_axis / strength).sqrt();
    let pair = vec![at(0.5 * distance, 0.5 * speed), at(-0.5 * distance, -0.5 * speed)];
    // The shift is (distance/cutoff)² = 1e-8 of the force.
    let mut setup = setup(pair, charged(elastic(), 1e4 * distance));
    let steps = 10_000;
    setup.time_step = period / f64::from(steps);
    let charges = column("charge", "C", vec![charge, -charge]);
    let mut pair = Simulation::with_columns(setup, vec![charges]).unwrap();
    let start = pair.ledger();
    let energy = start.kinetic() + start.electrostatic;
    pair.advance(10 * steps as u64).unwrap();
    let ledger = pair.ledger();
    let drift = (ledger.kinetic() + ledger.electrostatic - energy) / energy;
    assert!(drift.abs() < 1e-6, "{drift}");
    assert!(ledger.relative_error().abs() < 1e-6, "{ledger:?}");
    let states = states(&pair);
    let between = states[0].position - states[1].position;
    // Velocity-Verlet is fast by some (2 π/10 000)²/24 of the phase, 1e-6 in ten periods; the shift by 1e-8.
    assert!((between.x / distance - 1.0).abs() < 1e-6, "{between:?}");
    assert!((between.y / distance).abs() < 1e-4, "{between:?}");
    assert_eq!(ledger.adhesive, 0.0);
}

/// Charged core-shell grains that fall together.
fn cloud(count: usize) -> (Setup, Vec<NamedColumn>) {
    let model = charged(normal("core-shell", &[("k1", 100.0), ("kp", 500.0)]), 6.0 * RADIUS);
    let mut setup = implosion(count, 14.0 * RADIUS, 9, model);
    setup.walls = cube_of_walls(14.0 * RADIUS);
    setup.time_step = contact_time(&setup) / 50.0;
    let sign = |index: usize| if index.is_multiple_of(3) { 1.0 } else { -0.6 };
    let charges = (0..count).map(|index| sign(index) * 2e-10 * (1.0 + 0.01 * index as f64)).collect();
    let shells = (0..count).map(|index| RADIUS * 1e-3 * (index % 5) as f64).collect();
    (setup, vec![column("charge", "C", charges), column("shell_thickness", "m", shells)])
}

#[test]
fn charges_act_as_the_sum_over_all_pairs_says() {
    let (setup, columns) = cloud(40);
    let (cutoff, charges) = (6.0 * RADIUS, columns[0].values.clone());
    let grains = setup.particles.clone();
    let cloud = Simulation::with_columns(setup, columns).unwrap();
    let rows = cloud.particles().rows_by_id();
    let mut energy = 0.0;
    for (id, grain) in grains.iter().enumerate() {
        let mut force = vector(0.0, 0.0, 0.0);
        for (other_id, other) in grains.iter().enumerate().filter(|(other, _)| *other != id) {
            let between = grain.position - other.position;
            let (distance, end) = (between.norm(), grain.radius + other.radius + cutoff);
            if distance >= end {
                continue;
            }
            let strength = COULOMB_CONSTANT * charges[id] * charges[other_id];
            let size = strength * (1.0 / (distance * distance) - 1.0 / (end * end));
            force += between * (size / distance);
            // Of the shifted force: from the distance to its end.
            energy += 0.5 * strength * (1.0 / distance - 2.0 / end + distance / (end * end));
        }
        let found = cloud.particles().forces()[rows[id]];
        // Cancellation of the plain formula near the cutoff.
        assert!((found - force).norm() <= 1e-9 * force.norm(), "{id}: {found:?} {force:?}");
    }
    let found = cloud.ledger().electrostatic;
    assert!((found / energy - 1.0).abs() < 1e-9, "{found} {energy}");
}

#[test]
fn charged_shells_have_the_same_bits_however_they_are_computed_and_close_the_ledger() {
    let run = |threads: usize, instructions: InstructionSet| {
        let (setup, columns) = cloud(120);
        let mut cloud = Simulation::with_columns(setup, columns).unwrap();
        cloud.set_threads(threads).unwrap();
        cloud.set_instructions(instructions);
        cloud.advance(1500).unwrap();
        let bits = |state: &State| [state.position, state.velocity].map(|v| v.to_array().map(f64::to_bits));
        let all: Vec<_> = states(&cloud).iter().map(bits).collect();
        (all, cloud.ledger(), cloud.rebuilds())
    };
    let plain = InstructionSet::available()[0];
    let (expected, ledger, rebuilds) = run(1, plain);
    assert!(rebuilds > 2, "{rebuilds}");
    assert!(ledger.electrostatic != 0.0 && ledger.elastic_normal > 0.0, "{ledger:?}");
    assert!(ledger.relative_error().abs() < 1e-3, "{ledger:?}");
    for &instructions in &InstructionSet::available() {
        for threads in [1, 3] {
            let (bits, other, _) = run(threads, instructions);
            assert_eq!(bits, expected, "{threads} threads, {instructions:?}");
            assert_eq!(other, ledger, "{threads} threads, {instructions:?}");
        }
    }
}

#[test]
fn quantities_that_laws_read_must_be_there_and_a_change_of_them_is_booked() {
    let (setup, mut columns) = cloud(20);
    let shells = columns.pop().unwrap();
    let refused = Simulation::with_columns(setup.clone(), columns.clone()).unwrap_err();
    assert!(matches!(&refused, SetupError::Column { name, .. } if name == "shell_thickness"), "{refused}");
    let negative = NamedColumn { values: vec![-1e-6; 20], ..shells.clone() };
    let with_negative = vec![columns[0].clone(), negative];
    let refused = Simulation::with_columns(setup.clone(), with_negative).unwrap_err();
    assert!(refused.to_string().contains("-0.000001 m, expected >= 0"), "{refused}");
    columns.push(shells);
    let mut cloud = Simulation::with_columns(setup, columns.clone()).unwrap();
    let before = cloud.ledger();
    let doubled = columns[0].values.iter().map(|charge| 2.0 * charge).collect();
    cloud.set_column(NamedColumn { values: doubled, ..columns[0].clone() }).unwrap();
    let after = cloud.ledger();
    assert!((after.electrostatic / (4.0 * before.electrostatic) - 1.0).abs() < 1e-12, "{after:?}");
    // With what the discrete energy changes by, dt²/8 Σ f²/m.
    assert!((after.switched / (3.0 * before.electrostatic) - 1.0).abs() < 1e-5, "{after:?}");
    assert!(after.closing_error().abs() < 1e-12 * before.electrostatic.abs(), "{after:?}");
}

/// A powder that softens while it is pressed together.
fn oven() -> (Setup, TemperatureProgram) {
    let model = normal(
        "sinter-luding",
        &[
            ("k1", 200.0),
            ("kp", 1000.0),
            ("kc", 50.0),
            ("phi_f", 0.1),
            ("t_melt", 500.0),
            ("t_width", 20.0),
            ("time_scale", 1e-3),
        ],
    );
    let mut setup = implosion(120, 14.0 * RADIUS, 4, model);
    setup.walls = cube_of_walls(14.0 * RADIUS);
    setup.time_step = contact_time(&setup) / 50.0;
    let end = 1500.0 * setup.time_step;
    let program = TemperatureProgram::new(vec![(0.0, 300.0), (0.5 * end, 520.0), (end, 400.0)]).unwrap();
    (setup, program)
}

#[test]
fn a_powder_that_is_heated_loses_energy_thermally_and_goes_on_from_a_state_with_the_same_bits() {
    let (setup, program) = oven();
    let (interactions, walls) = (setup.interactions.clone(), setup.walls.clone());
    let mut powder = Simulation::new(setup).unwrap();
    assert_eq!(powder.temperature(), None);
    powder.set_temperature(Some(program.clone()));
    assert_eq!(powder.temperature(), Some(300.0));
    powder.advance(800).unwrap();
    let state = powder.export_state();
    powder.advance(700).unwrap();
    let ledger = powder.ledger();
    assert!(ledger.dissipated_thermal > 0.01 * ledger.dissipated(), "{ledger:?}");
    assert!(ledger.relative_error().abs() < 1e-3, "{ledger:?}");
    assert!((powder.temperature().unwrap() - 400.0).abs() < 1e-9);
    let mut continued = Simulation::import_state(interactions, walls, &state).unwrap();
    assert_eq!(continued.temperature(), state.temperature.as_ref().map(|program| program.at(state.time)));
    assert_eq!(state.temperature.as_ref(), Some(&program));
    continued.advance(700).unwrap();
    assert_eq!(states(&continued), states(&powder));
    assert_eq!(continued.ledger(), ledger);
}

#[test]
fn the_liquid_of_two_grains_holds_them_as_far_as_its_bridge_reaches() {
    let values = Values::new().with("liquid_share", 0.1).with("surface_tension", 0.072);
    let mut model = elastic();
    model.laws.noncontact = NonContact::build("liquid-bridge", &values).unwrap().unwrap();
    // A pair that touches and parts, and a dry one beside it: V = 0.1 (V_i + V_j) = 1e-13 m³, S_c = V^(1/3).
    let rupture = 4.641_588_833_612_779e-5;
    let at = |x: f64, y: f64, speed: f64| sphere(vector(x, y, 0.0), vector(speed, 0.0, 0.0), RADIUS);
    let pairs = |gap: f64, speed: f64| {
        let x = RADIUS + 0.5 * gap;
        vec![
            at(-x, 0.0, speed),
            at(x, 0.0, -speed),
            at(-x, 10.0 * RADIUS, speed),
            at(x, 10.0 * RADIUS, -speed),
        ]
    };
    let mut setup = setup(pairs(-1e-9, 0.0), model);
    setup.time_step = 1e-7;
    let liquid = |values: [f64; 4]| vec![column("liquid", "m^3", values.to_vec())];
    let mut grains = Simulation::with_columns(setup.clone(), liquid([1e-12, 0.0, 0.0, 0.0])).unwrap();
    // R_w is the radius of equal spheres; with a spring that pushes by 1000 N/m over 1 nm.
    let strength = std::f64::consts::TAU * 0.072 * RADIUS;
    let force =
        |grains: &Simulation, id: usize| grains.particles().forces()[grains.particles().rows_by_id()[id]].x;
    assert!((force(&grains, 0) / (strength - 1e-6) - 1.0).abs() < 1e-9, "{}", force(&grains, 0));
    assert!((force(&grains, 2) / -1e-6 - 1.0).abs() < 1e-6, "{}", force(&grains, 2));
    let start = grains.ledger();
    assert!(start.capillary < 0.0);
    // Twice the liquid: the bridge of the moment has another potential, which is booked.
    grains.set_column(liquid([2e-12, 0.0, 0.0, 0.0]).remove(0)).unwrap();
    let doubled = grains.ledger();
    assert!(doubled.capillary < start.capillary);
    assert!((doubled.switched / (doubled.capillary - start.capillary) - 1.0).abs() < 1e-3, "{doubled:?}");
    let refused = grains.set_column(liquid([-1e-12, 0.0, 0.0, 0.0]).remove(0)).unwrap_err();
    assert!(refused.to_string().contains("expected >= 0"), "{refused}");
    assert_eq!(grains.ledger(), doubled);
    // The way apart: it pulls up to the rupture distance, and not beyond.
    setup.particles = pairs(-1e-9, -0.5);
    let mut grains = Simulation::with_columns(setup, liquid([0.0, 1e-12, 0.0, 0.0])).unwrap();
    let mut pulled = 0.0_f64;
    for _ in 0..2000 {
        grains.step().unwrap();
        let rows = grains.particles().rows_by_id();
        let positions = grains.particles().positions();
        let gap = (positions[rows[1]] - positions[rows[0]]).norm() - 2.0 * RADIUS;
        if force(&grains, 0) > 0.0 {
            pulled = pulled.max(gap);
        }
        assert!(force(&grains, 2) <= 0.0, "the dry pair");
    }
    // Within the step in which it breaks: 1e-7 s at 1 m/s.
    assert!((pulled / rupture - 1.0).abs() < 1e-7 / rupture, "{pulled} {rupture}");
    let ledger = grains.ledger();
    assert!(ledger.relative_error().abs() < 1e-4 && ledger.capillary == 0.0, "{ledger:?}");
}
