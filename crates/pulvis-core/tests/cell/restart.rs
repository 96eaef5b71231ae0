//! A deforming cell goes on with the same bits, on any number of threads.

use super::common::{start, states, viscous_luding};
use super::{constant, gas};
use pulvis_core::{CellControl, CellMotion, Interactions, Simulation};

/// A gas that is compressed along two axes by stresses and sheared.
fn driven() -> Simulation {
    let mut simulation = start(gas(150, 0.33, 0.05, viscous_luding()), 25.0);
    let mut motion = CellMotion { inertial_number: 0.1, ..CellMotion::default() };
    motion.components[0] = CellControl::Stress(constant(300.0));
    motion.components[1] = CellControl::Stress(constant(200.0));
    motion.components[2] = CellControl::Rate(-1.0);
    motion.components[3] = CellControl::Rate(60.0);
    simulation.set_cell_motion(motion).unwrap();
    simulation
}

fn interactions() -> Interactions {
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, viscous_luding());
    interactions
}

#[test]
fn a_resumed_cell_goes_on_with_the_same_bits() {
    for stop in [1, 137, 900] {
        let mut whole = driven();
        whole.advance(stop).unwrap();
        let state = whole.export_state();
        let mut resumed = Simulation::import_state(interactions(), Vec::new(), &state).unwrap();
        assert!(state == resumed.export_state(), "stop after {stop}");
        whole.advance(1500).unwrap();
        resumed.advance(1500).unwrap();
        assert!(whole.rebuilds() > 2 && whole.export_state() == resumed.export_state(), "stop after {stop}");
    }
}

#[test]
fn threads_and_the_length_of_calls_change_no_bit_of_a_deforming_cell() {
    let mut one = driven();
    one.advance(1200).unwrap();
    for threads in [2, 3] {
        let mut others = driven();
        others.set_threads(threads).unwrap();
        for _ in 0..400 {
            others.advance(3).unwrap();
        }
        assert!(one.export_state() == others.export_state(), "{threads} threads");
    }
    assert!(states(&one).iter().all(|state| state.position.is_finite()));
}

#[test]
fn a_list_that_the_flow_has_outrun_is_made_again() {
    // Whatever the skin, the forces are the same: no contact is missed.
    let run = |skin: f64| {
        let mut simulation = driven();
        simulation.set_skin(skin).unwrap();
        simulation.advance(1000).unwrap();
        (simulation.rebuilds(), states(&simulation), simulation.contact_totals().pairs)
    };
    let ((many, thin, pairs), (few, thick, others)) = (run(0.02e-3), run(0.3e-3));
    assert!(many > 2 * few && few > 0, "{many} {few}");
    assert_eq!(pairs, others);
    let off = thin.iter().zip(&thick).map(|(one, other)| (one.velocity - other.velocity).norm());
    assert!(off.fold(0.0, pulvis_math::max_or_nan) < 1e-7);
}
