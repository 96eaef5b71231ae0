//! What the loops add up of the contacts is what a look at every contact gives.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{advance, cube_of_walls, gravity, implosion, start, viscous_luding};
use pulvis_core::{ContactPartner, ContactTotals, Simulation};

/// The totals by a look at one contact after the other.
fn looked_at(simulation: &Simulation) -> ContactTotals {
    let mut totals = ContactTotals::default();
    simulation.for_each_contact(&mut |contact| {
        let touching = f64::from(u8::from(contact.overlap > 0.0));
        match contact.second {
            ContactPartner::Particle(_) => totals.pairs += touching,
            ContactPartner::Wall(_) => totals.at_walls += touching,
        }
        totals.overlap_max = totals.overlap_max.max(contact.overlap);
        let branch = contact.centre_first - contact.centre_second;
        for row in 0..3 {
            for column in 0..3 {
                totals.virial[row][column] += contact.force[row] * branch[column];
            }
        }
    });
    totals
}

#[test]
fn sums_over_contacts_are_those_of_a_look_at_every_contact_for_any_number_of_threads() {
    let edge = 9e-3;
    let mut setup = implosion(400, edge, 3, viscous_luding());
    setup.walls = cube_of_walls(edge);
    setup.background = gravity(981.0);
    let mut all = Vec::new();
    for threads in [1, 2, 3] {
        let mut simulation = start(setup.clone(), 40.0);
        simulation.set_threads(threads).unwrap();
        advance(&mut simulation, 1500);
        let (totals, expected) = (simulation.contact_totals(), looked_at(&simulation));
        assert!(expected.pairs > 50.0 && expected.at_walls > 5.0, "{expected:?}");
        assert_eq!((totals.pairs, totals.at_walls), (expected.pairs, expected.at_walls));
        assert!((totals.overlap_max / expected.overlap_max - 1.0).abs() < 1e-12);
        let size = (0..3).map(|axis| expected.virial[axis][axis].abs()).sum::<f64>();
        for row in 0..3 {
            for column in 0..3 {
                let difference = totals.virial[row][column] - expected.virial[row][column];
                // The look takes the dashpots' velocities at the end of the step, the loop those predicted for it.
                assert!(difference.abs() < 1e-3 * size, "{totals:?} {expected:?}");
            }
        }
        all.push(totals);
    }
    assert!(all.iter().all(|totals| *totals == all[0]), "{all:?}");
}

#[test]
fn vectors_stand_where_their_layout_says() {
    let simulation = start(implosion(50, 9e-3, 3, viscous_luding()), 40.0);
    let particles = simulation.particles();
    let all = [
        particles.positions(),
        particles.velocities(),
        particles.angular_velocities(),
        particles.forces(),
        particles.torques(),
    ];
    for vectors in all {
        let (first, bytes) = vectors.layout();
        for row in 0..vectors.len() {
            let expected: *const f64 = &vectors[row].x;
            assert_eq!(first.wrapping_byte_add(row * bytes), expected);
            assert_eq!(expected.wrapping_add(2), &raw const vectors[row].z);
        }
    }
}
