//! The same bits for any number of threads.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{cube_of_walls, gravity, implosion, start, viscous_luding};
use pulvis_core::Simulation;

/// Every number of the state, as bits.
fn bits(simulation: &mut Simulation) -> Vec<u64> {
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    let columns = [particles.positions(), particles.velocities(), particles.spins(), particles.forces()];
    let mut bits: Vec<u64> = columns
        .iter()
        .flat_map(|column| rows.iter().flat_map(|&row| column[row].to_array()))
        .map(f64::to_bits)
        .collect();
    bits.extend(simulation.ledger().accounts().iter().map(|(_, energy)| energy.to_bits()));
    for place in 0..simulation.walls().len() {
        bits.extend(simulation.wall_force(place).to_array().map(f64::to_bits));
    }
    bits
}

#[test]
fn one_two_three_and_eight_threads_give_the_same_bits() {
    let after = |threads: usize| {
        let mut setup = implosion(600, 12e-3, 5, viscous_luding());
        setup.walls = cube_of_walls(12e-3);
        setup.background = gravity(9.81);
        let mut simulation = start(setup, 50.0);
        simulation.set_threads(threads).unwrap();
        assert_eq!(simulation.threads(), threads);
        for _ in 0..2000 {
            simulation.step().unwrap();
        }
        let mut touching = 0;
        simulation.for_each_contact(&mut |contact| touching += u32::from(contact.overlap > 0.0));
        assert!(touching > 200, "only {touching} contacts: too little to disagree about");
        bits(&mut simulation)
    };
    let alone = after(1);
    for threads in [2, 3, 8] {
        assert!(after(threads) == alone, "{threads} threads give other bits than one");
    }
}
