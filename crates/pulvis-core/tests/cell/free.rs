//! One particle alone in a cell that deforms.

use super::common::{RADIUS, elastic, setup, sphere, start, states, vector};
use super::{at_rates, cube, shear};
use pulvis_core::{Setup, Simulation, UpperTriangular};
use pulvis_math::Vector3;

const EDGE: f64 = 20e-3;
const VELOCITY: [f64; 3] = [0.3, 0.7, -0.2];

fn alone() -> Simulation {
    let particle = sphere(vector(4e-3, 7e-3, 11e-3), Vector3::from(VELOCITY), RADIUS);
    let other = sphere(vector(14e-3, 17e-3, 1e-3), Vector3::zero(), RADIUS);
    let mut simulation = start(Setup { domain: cube(EDGE), ..setup(vec![particle, other], elastic()) }, 50.0);
    simulation.remove(&[1]).unwrap();
    simulation
}

#[test]
fn a_free_particle_in_a_shear_flies_straight_in_the_laboratory() {
    let (mut simulation, rate) = (alone(), 80.0);
    simulation.set_cell_motion(shear(rate)).unwrap();
    let dt = simulation.time_step();
    // It crosses the sheared face several times.
    let steps = (0.1 / dt) as u64;
    simulation.advance(steps).unwrap();
    let time = steps as f64 * dt;
    let [x, y, z] = VELOCITY;
    let here = states(&simulation)[0];
    // c = v − γ' (y − middle), with the velocity v of the laboratory constant: c_x falls with the height that is flown.
    let expected = vector(x - rate * y * time, y, z);
    // Rounding errors of 60 000 steps.
    assert!((here.velocity - expected).norm() < 1e-10 * expected.norm(), "{:?}", here.velocity);
    let height = 7e-3 + y * time;
    let along = 4e-3 + (x + rate * (7e-3 - 0.5 * EDGE)) * time;
    // The image in the block: rows along y are shifted by the shear.
    let rows = (height / EDGE).floor();
    assert!(rows >= 3.0);
    let nearest = |away: f64| (away - (away / EDGE).round() * EDGE).abs();
    let (off_y, off_z) = (here.position.y - (height - rows * EDGE), here.position.z - (11e-3 + z * time));
    let off_x = here.position.x - (along - rows * rate * time * EDGE);
    assert!(
        nearest(off_y) < 1e-12 && nearest(off_z) < 1e-12 && nearest(off_x) < 1e-11,
        "{off_x} {off_y} {off_z}"
    );
    assert!((simulation.cell_strain().xy - rate * time).abs() < 1e-12 * rate * time);
    assert!(simulation.domain().tilts[0].abs() <= 0.5 * EDGE * (1.0 + 1e-12));
}

#[test]
fn compression_heats_a_free_particle_along_each_axis_by_what_the_cell_does_on_it() {
    let mut simulation = alone();
    let rates = UpperTriangular { xx: -60.0, yy: 5.0, zz: -10.0, ..UpperTriangular::ZERO };
    let before = simulation.ledger().kinetic();
    simulation.set_cell_motion(at_rates(rates)).unwrap();
    simulation.advance(4000).unwrap();
    let (size, velocity) = (simulation.domain().extent.size(), states(&simulation)[0].velocity);
    let time = simulation.time();
    for (axis, rate) in [(0, -60.0), (1, 5.0), (2, -10.0)] {
        let action = velocity[axis] * size[axis] / (VELOCITY[axis] * EDGE);
        assert!((action - 1.0).abs() < 1e-11, "axis {axis}: {action}");
        // The rule of the middle is of second order: e³ dt²/12 a time.
        let exact = f64::exp(rate * time);
        assert!((size[axis] / EDGE / exact - 1.0).abs() < 1e-8);
    }
    let ledger = simulation.ledger();
    let gained = ledger.kinetic() - before;
    assert!(gained.abs() > 0.1 * before && ledger.work_cell != 0.0);
    assert!((ledger.work_cell - gained).abs() < 1e-7 * before, "{} {gained}", ledger.work_cell);
}

#[test]
fn what_does_not_move_relative_to_the_flow_is_carried_along_with_it() {
    let mut simulation = start(
        Setup {
            domain: cube(EDGE),
            ..setup(
                vec![
                    sphere(vector(4e-3, 7e-3, 11e-3), Vector3::zero(), RADIUS),
                    sphere(vector(15e-3, 16e-3, 3e-3), Vector3::zero(), RADIUS),
                ],
                elastic(),
            )
        },
        50.0,
    );
    let rates = UpperTriangular { xx: -2.0, yy: 3.0, zz: 1.0, xy: 4.0, xz: -2.0, yz: 1.5 };
    simulation.set_cell_motion(at_rates(rates)).unwrap();
    let before = simulation.domain().edges().inverse();
    let from = states(&simulation);
    simulation.advance(3000).unwrap();
    let now = states(&simulation);
    assert!(now.iter().all(|state| state.velocity == Vector3::zero()));
    // The way from one to the other in edges of the cell, up to whole edges.
    let apart = before.times(from[0].position - from[1].position);
    let apart_now = simulation.domain().edges().inverse().times(now[0].position - now[1].position);
    for axis in 0..3 {
        let off = apart_now[axis] - apart[axis];
        assert!((off - off.round()).abs() < 1e-10, "axis {axis}: {off}");
    }
}
