//! A driven bed for a long time: memory stays constant, the ledger closes, and the contacts are those that are there.
//!
//! `cargo xtask soak MINUTES` takes as long as it is told.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stderr,
    clippy::disallowed_methods
)]

mod common;

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use common::*;
use pulvis_core::walls::{Cosine, WallMotion};
use pulvis_core::{ContactPartner, Limits, Setup, Simulation};

/// Grains under gravity in a box whose floor shakes.
fn shaken_bed(count: usize) -> Simulation {
    let edge = 2.6 * RADIUS * (count as f64).cbrt();
    let mut walls = cube_of_walls(edge);
    let displacement = vector(0.0, 0.0, 0.5 * RADIUS);
    // Low along z; for longer than any soak.
    walls[4].motion = WallMotion::Cosine(Cosine { displacement, period: 5e-3, cycles: 1e9 });
    let mut bed = start(
        Setup { walls, background: gravity(9.81), ..implosion(count, edge, 7, viscous_luding()) },
        50.0,
    );
    bed.set_limits(Limits::default());
    bed
}

/// Touching pairs and wall contacts, as body and body or body and wall.
type Touching = BTreeSet<(u32, i64)>;

/// The contacts that touch, by the list; those within `margin` [m] of touching may be on either side.
fn listed(simulation: &Simulation, margin: f64) -> Touching {
    let mut touching = Touching::new();
    simulation.for_each_contact(&mut |contact| {
        if contact.overlap > margin {
            touching.insert(match contact.second {
                ContactPartner::Particle(other) => {
                    (contact.first.min(other), i64::from(contact.first.max(other)))
                }
                ContactPartner::Wall(wall) => (contact.first, -1 - wall as i64),
            });
        }
    });
    touching
}

/// The same from all pairs of bodies.
fn by_force(simulation: &Simulation, margin: f64) -> Touching {
    let particles = simulation.particles();
    let (ids, radii) = (particles.ids(), particles.radii());
    let positions: Vec<_> = particles.positions().iter().collect();
    let mut touching = Touching::new();
    for one in 0..ids.len() {
        for other in 0..one {
            let overlap = radii[one] + radii[other] - (positions[one] - positions[other]).norm();
            if overlap > margin {
                touching.insert((ids[one].min(ids[other]), i64::from(ids[one].max(ids[other]))));
            }
        }
        for (number, wall) in simulation.walls().iter().enumerate() {
            if radii[one] - wall.distance(positions[one]) > margin {
                touching.insert((ids[one], -1 - number as i64));
            }
        }
    }
    touching
}

/// Asserts that list and brute force find the same contacts; answers with how many.
fn compare(simulation: &Simulation) -> usize {
    let round_off = 1e-12 * RADIUS;
    // What is certain for one must be there for the other.
    for (certain, possible) in [
        (listed(simulation, round_off), by_force(simulation, -round_off)),
        (by_force(simulation, round_off), listed(simulation, -round_off)),
    ] {
        let missing: Vec<_> = certain.difference(&possible).collect();
        assert!(missing.is_empty(), "step {}: {missing:?}", simulation.steps());
    }
    by_force(simulation, 0.0).len()
}

/// Memory of this process that is not of files [byte], as of its program, parts of which come and go; `None` where the system
/// does not say.
fn resident() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("RssAnon:"))?;
    Some(1024.0 * line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()?)
}

#[test]
fn contacts_of_a_shaken_bed_are_those_of_brute_force_at_any_time() {
    let mut bed = shaken_bed(300);
    let (mut most, mut steps) = (0, 0);
    for sample in 0..40_u64 {
        // Any phase between two lists.
        steps = 37 + steps * 7 % 101 + sample;
        bed.advance(steps).unwrap();
        most = compare(&bed).max(most);
    }
    assert!(most > 300 && bed.rebuilds() > 5, "{most} contacts, {} lists", bed.rebuilds());
}

#[test]
#[ignore = "takes minutes: cargo xtask soak MINUTES"]
fn a_driven_bed_runs_for_long_with_constant_memory_a_closed_ledger_and_the_contacts_of_brute_force() {
    let minutes: f64 = std::env::var("PULVIS_SOAK_MINUTES").map_or(2.0, |text| text.parse().unwrap());
    // So large that a hundredth of its memory is more than the pieces in which the system gives it.
    const GRAINS: usize = 20_000;
    const ENOUGH: f64 = 1e10;
    let mut bed = shaken_bed(GRAINS);
    let particle_steps = |bed: &Simulation| bed.steps() as f64 * GRAINS as f64;
    let (began, whole) = (Instant::now(), Duration::from_secs_f64(60.0 * minutes));
    // The bed falls together and its lists grow to their size.
    bed.advance(30_000).unwrap();
    let (mut memory, mut looks, mut worst) = (Vec::new(), 0_u64, 0.0_f64);
    let mut told = began.elapsed();
    while began.elapsed() < whole && particle_steps(&bed) < ENOUGH {
        bed.advance(5_003).unwrap();
        let contacts = compare(&bed);
        looks += 1;
        let error = bed.ledger().relative_error().abs();
        assert!(error.is_finite());
        worst = worst.max(error);
        memory.extend(resident());
        if began.elapsed() - told > whole / 10 {
            told = began.elapsed();
            eprintln!(
                "{:.0} s: {:.2e} particle-steps, {contacts} contacts, ledger {error:.1e}, {:.2} MB",
                told.as_secs_f64(),
                particle_steps(&bed),
                memory.last().unwrap_or(&f64::NAN) / 1e6
            );
        }
    }
    let half = memory.len() / 2;
    let [low, high] =
        [f64::min, f64::max].map(|pick| memory[half..].iter().copied().reduce(pick).unwrap_or(1.0));
    eprintln!(
        "{:.2e} particle-steps, {looks} looks at the contacts, ledger {worst:.1e} at most, memory {:.2} to {:.2} MB in the second half",
        particle_steps(&bed),
        low / 1e6,
        high / 1e6
    );
    assert!(looks >= 2 && high <= 1.01 * low, "memory from {low} to {high} bytes");
    assert!(worst < 1e-2, "{worst}");
}
