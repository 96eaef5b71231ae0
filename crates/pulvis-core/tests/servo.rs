//! Servo walls whose faces change while they move.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_core::walls::{Extent, FaceArea, PressureRamp, Servo, Wall, WallMotion};
use pulvis_core::{Setup, Simulation};
use pulvis_math::Vector3;

const PRESSURE: f64 = 3.0;
const DAMPING: f64 = 0.4;
/// Until the sides of the unit cube have halved, about.
const END: f64 = 0.6;

/// A unit cube whose upper walls x, y, z have these masses and are pushed by a pressure on faces between the others.
fn pressed_cube(masses: [f64; 3], time_step: f64) -> Simulation {
    let mut walls = cube_of_walls(1.0);
    for axis in 0..3 {
        let across = [1, 2].map(|turn| 2 * ((axis + turn) % 3));
        let pressure = PressureRamp { from: PRESSURE, to: PRESSURE, duration: 0.0 };
        let servo = Servo { pressure, mass: masses[axis], damping: DAMPING };
        let high = &mut walls[2 * axis + 1];
        *high = Wall {
            motion: WallMotion::Servo(servo),
            area: FaceArea::Product(across.map(|low| Extent::Between(low, low + 1))),
            ..high.clone()
        };
    }
    Simulation::new(Setup { walls, time_step, ..setup(Vec::new(), elastic()) }).unwrap()
}

fn sides(simulation: &Simulation) -> [f64; 3] {
    [0, 1, 2].map(|axis| simulation.walls()[2 * axis + 1].point[axis])
}

/// The sides at [`END`] by the classical method of Runge and Kutta for m X'' = −p Y Z − γ X' and so on.
fn reference(masses: [f64; 3]) -> Vector3 {
    let derivative = |[sides, speeds]: [Vector3; 2]| {
        let force =
            |axis: usize| -PRESSURE * sides[(axis + 1) % 3] * sides[(axis + 2) % 3] - DAMPING * speeds[axis];
        [speeds, vector(force(0) / masses[0], force(1) / masses[1], force(2) / masses[2])]
    };
    let mut state = [vector(1.0, 1.0, 1.0), Vector3::zero()];
    let steps = 20_000;
    let step = END / f64::from(steps);
    let moved = |[sides, speeds]: [Vector3; 2], [way, kick]: [Vector3; 2], share: f64| {
        [sides + way * (share * step), speeds + kick * (share * step)]
    };
    for _ in 0..steps {
        let first = derivative(state);
        let second = derivative(moved(state, first, 0.5));
        let third = derivative(moved(state, second, 0.5));
        let fourth = derivative(moved(state, third, 1.0));
        for (slope, weight) in [(first, 1.0), (second, 2.0), (third, 2.0), (fourth, 1.0)] {
            state = moved(state, slope, weight / 6.0);
        }
    }
    state[0]
}

#[test]
fn walls_that_change_each_others_faces_follow_their_equation_to_second_order() {
    let masses = [0.7, 1.0, 1.6];
    let expected = reference(masses);
    let errors = [50, 100, 200, 400].map(|steps| {
        let mut simulation = pressed_cube(masses, END / f64::from(steps));
        advance(&mut simulation, steps as usize);
        let [x, y, z] = sides(&simulation);
        (vector(x, y, z) - expected).norm()
    });
    assert!(errors[3] < 1e-5, "{errors:?}");
    let order = order(&errors);
    assert!((order - 2.0).abs() < 0.05, "order {order} of {errors:?}");
}

#[test]
fn the_three_directions_of_space_are_alike() {
    let mut simulation = pressed_cube([1.0; 3], 0.01);
    for step in 0..60 {
        simulation.step().unwrap();
        let [x, y, z] = sides(&simulation);
        assert!(x == y && y == z && x < 1.0, "step {step}: {x}, {y}, {z}");
    }
}
