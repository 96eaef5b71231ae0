//! What a cell cannot do is refused before it starts, or stops the simulation.

use super::common::{elastic, floor, gravity, setup, sphere, start, vector};
use super::{at_rates, constant, cube, gas, shear};
use pulvis_core::{Alarm, CellControl, CellMotion, Domain, Setup, SetupError, Simulation, UpperTriangular};
use pulvis_math::Vector3;

fn system(domain: Domain) -> Setup {
    let particles = vec![
        sphere(vector(2e-3, 2e-3, 2e-3), Vector3::zero(), 0.5e-3),
        sphere(vector(5e-3, 5e-3, 5e-3), Vector3::zero(), 0.5e-3),
    ];
    Setup { domain, ..setup(particles, elastic()) }
}

fn problem(simulation: &mut Simulation, motion: CellMotion) -> String {
    match simulation.set_cell_motion(motion) {
        Err(SetupError::Cell { problem }) => problem,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_direction_that_does_not_repeat_cannot_deform() {
    let edges = vector(8e-3, 8e-3, 8e-3);
    let mut slab = start(system(Domain::periodic(Vector3::zero(), edges, [true, false, true])), 50.0);
    assert_eq!(problem(&mut slab, shear(1.0)), "xy deforms, but y is not periodic");
    let isotropic = CellMotion { isotropic: Some(constant(10.0)), ..CellMotion::default() };
    assert_eq!(problem(&mut slab, isotropic), "yy deforms, but y is not periodic");
    slab.set_cell_motion(at_rates(UpperTriangular { xx: -1.0, xz: 0.5, ..UpperTriangular::ZERO })).unwrap();
}

#[test]
fn walls_and_gravity_have_no_place_in_a_cell_that_deforms() {
    let edges = vector(8e-3, 8e-3, 8e-3);
    let setup = system(Domain::periodic(Vector3::zero(), edges, [true, true, false]));
    let mut simulation = start(Setup { walls: vec![floor()], ..setup.clone() }, 50.0);
    let squeeze = at_rates(UpperTriangular { xx: -1.0, ..UpperTriangular::ZERO });
    assert_eq!(problem(&mut simulation, squeeze), "the wall `floor` is there, which cannot follow it");
    simulation.set_wall_present(0, false);
    simulation.set_cell_motion(squeeze).unwrap();
    simulation.advance(3).unwrap();
    simulation.set_wall_present(0, true);
    let alarm = simulation.advance(1).unwrap_err().alarm;
    assert_eq!(alarm, Alarm::WallInMovingCell { wall: "floor".to_owned() });

    let mut simulation = start(Setup { background: gravity(9.81), ..setup }, 50.0);
    assert!(problem(&mut simulation, squeeze).starts_with("there is gravity"));
    simulation.set_background(gravity(0.0)).unwrap();
    simulation.set_cell_motion(squeeze).unwrap();
    assert!(simulation.set_background(gravity(1.0)).is_err());
}

#[test]
fn a_rate_that_no_time_step_can_follow_is_refused() {
    let mut simulation = start(system(cube(8e-3)), 50.0);
    let dt = simulation.time_step();
    assert!(problem(&mut simulation, shear(0.011 / dt)).contains("more than 0.01"));
    assert!(problem(&mut simulation, shear(f64::NAN)).contains("NaN"));
    simulation.set_cell_motion(shear(0.009 / dt)).unwrap();
    assert!(simulation.set_time_step(1.5 * dt).is_err());
    simulation.set_time_step(0.5 * dt).unwrap();
    let mut nothing = CellMotion::default();
    nothing.components[0] = CellControl::Stress(constant(0.0));
    assert!(problem(&mut simulation, nothing).contains("none differs from zero"));
    let mut twice = CellMotion { isotropic: Some(constant(1.0)), ..CellMotion::default() };
    twice.components[1] = CellControl::Rate(1.0);
    assert!(problem(&mut simulation, twice).starts_with("yy is controlled"));
}

#[test]
fn a_cell_that_becomes_too_narrow_stops_the_simulation() {
    let mut simulation = start(gas(20, 0.05, 0.0, elastic()), 50.0);
    let rates = UpperTriangular { xx: -0.7, yy: 0.5, zz: 0.2, ..UpperTriangular::ZERO };
    simulation.set_cell_motion(at_rates(rates * (1.0 / (4000.0 * simulation.time_step())))).unwrap();
    let error = simulation.advance(40_000).unwrap_err();
    match error.alarm {
        Alarm::CellTooNarrow { axis: 0, period, least } => {
            assert!(period < least && period > 0.5 * least, "{period} {least}");
        }
        other => panic!("{other}"),
    }
}
