//! The work that a cell does, and where it goes.

use super::common::{elastic_gas, order, setup, slider, start, viscous_luding};
use super::{at_rates, gas, packing, shear, stress};
use pulvis_contact::viscosity::{Constant, Viscosity};
use pulvis_contact::{ContactModel, Linear};
use pulvis_core::{CellMotion, Setup, UpperTriangular};

/// A linear spring with all dashpots and friction that never slides: no law has a kink but at touching.
fn smooth() -> ContactModel {
    let mut model = ContactModel::frictionless(Linear::new(100.0, 0.0));
    model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: 1e-3 });
    model.laws.sliding = Some(slider(40.0, 2e-4, 50.0));
    model.laws.rolling = Some(slider(20.0, 1e-4, 50.0));
    model
}

#[test]
fn the_ledger_closes_to_second_order_in_a_cell_that_is_sheared_and_compressed() {
    let rates = UpperTriangular { xx: -3.0, yy: -6.0, zz: 2.0, xy: 25.0, xz: -8.0, yz: 4.0 };
    let errors = [25.0, 50.0, 100.0, 200.0].map(|steps_per_contact| {
        let Setup { particles, domain, .. } = gas(60, 0.4, 0.05, smooth());
        let mut simulation = start(Setup { domain, ..setup(particles, smooth()) }, steps_per_contact);
        simulation.set_cell_motion(at_rates(rates)).unwrap();
        simulation.advance((12.0 * steps_per_contact) as u64).unwrap();
        assert!(simulation.contact_totals().pairs > 5.0);
        let ledger = simulation.ledger();
        assert!(ledger.work_cell.abs() > 1e-3 * ledger.scale, "{} {}", ledger.work_cell, ledger.scale);
        ledger.relative_error().abs()
    });
    let found = order(&errors);
    assert!(errors[3] < 1e-4 && found > 1.6, "{errors:?}: order {found}");
}

#[test]
fn an_elastic_gas_is_compressed_by_the_work_of_the_cell_alone() {
    let mut simulation = start(elastic_gas(300), 50.0);
    let rate = -0.1 / (4000.0 * simulation.time_step());
    let before = simulation.ledger().kinetic();
    simulation
        .set_cell_motion(at_rates(UpperTriangular { xx: rate, yy: rate, zz: rate, ..UpperTriangular::ZERO }))
        .unwrap();
    simulation.advance(4000).unwrap();
    let ledger = simulation.ledger();
    // T V^(2/3) is constant for an ideal gas, whose translation this is; a dense one is heated faster.
    let heated = ledger.kinetic_translation / before;
    assert!(heated > f64::exp(0.2) && heated < 2.0, "{heated}");
    assert!((ledger.work_cell - (ledger.stored() - ledger.initial)).abs() < 1e-4 * before);
}

#[test]
fn what_steady_shear_puts_in_contacts_take_out() {
    let mut simulation = packing(120, 0.64, 25.0);
    let rate = 0.5 / (10_000.0 * simulation.time_step());
    simulation.set_cell_motion(shear(rate)).unwrap();
    simulation.advance(10_000).unwrap();
    let before = simulation.ledger();
    let mut power = 0.0;
    for _ in 0..20_000 {
        simulation.advance(1).unwrap();
        power -= rate * stress(&simulation, 0, 1) * simulation.domain().extent.volume();
    }
    let after = simulation.ledger();
    let (work, dissipated) = (after.work_cell - before.work_cell, after.dissipated() - before.dissipated());
    assert!(work > 0.0 && simulation.contact_totals().pairs > 100.0);
    // V |σ_xy| γ' over all steps is the work of the cell, which contacts dissipate: what they store does not grow.
    let sum = power * simulation.time_step();
    assert!((sum / work - 1.0).abs() < 1e-3, "{sum} {work}");
    assert!((dissipated / work - 1.0).abs() < 0.05, "{dissipated} {work}");
    assert!(after.relative_error().abs() < 1e-3, "{}", after.relative_error());
    simulation.set_cell_motion(CellMotion::default()).unwrap();
    simulation.advance(100).unwrap();
    assert_eq!(simulation.ledger().work_cell, after.work_cell);
}

#[test]
fn drag_acts_against_the_motion_relative_to_the_flow() {
    let mut setup = gas(30, 0.02, 0.05, viscous_luding());
    setup.background.drag = 1e-4;
    let mut simulation = start(setup, 50.0);
    simulation.set_cell_motion(shear(20.0)).unwrap();
    simulation.advance(30_000).unwrap();
    let ledger = simulation.ledger();
    assert!(ledger.dissipated_background > 0.0 && ledger.relative_error().abs() < 1e-3);
    // The velocity of the shear at the faces is some 0.1 m/s; what is left relative to it decays with the drag.
    let fastest =
        simulation.particles().velocities().iter().map(|v| v.norm()).fold(0.0, pulvis_math::max_or_nan);
    assert!(fastest < 0.02, "{fastest}");
}
