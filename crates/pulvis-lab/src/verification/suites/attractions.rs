//! Attractions at a distance.

use super::{Bench, ROUND_OFF, Suite, Tolerance};
use crate::verification::contact::{Path, attraction};
use crate::verification::data::Row;
use crate::verification::search::border;

pub(super) const SUITES: &[Suite] = &[("hamaker", hamaker), ("liquid-bridge", liquid_bridge)];

fn hamaker(bench: &mut Bench) {
    bench.expect_from("A_H R/(6 z0^2)");
    let cut = Tolerance { relative: 2e-8, reason: "force shifted by (z0/cutoff)^2, cutoff = 1e4 z0" };
    for (constant, radius, expected) in
        [(6.5e-20, 1e-6, 6.770_833_333_333_333e-8), (1e-19, 5e-7, 5.208_333_333_333_333e-8)]
    {
        let found = attraction("hamaker", &[("hamaker", constant), ("z0", 4e-10), ("cutoff", 4e-6)])
            .map(|model| -Path::at_wall(&model, radius).force(0.0));
        let case = format!("A_H={constant:e} R={radius:e} z0=4e-10");
        bench.check("pull-off", case, expected, found, cut);
    }
}

/// A bridge that has formed between two equal spheres, whose radius is that of the row.
fn bridged(row: &Row) -> Option<Path> {
    let numbers = [
        ("volume", row.get("V")?),
        ("surface_tension", row.get("sigma").unwrap_or(0.072)),
        ("contact_angle", row.get("theta")?),
    ];
    let radius = row.get("R").unwrap_or(1e-3);
    let mut path = Path::between(&attraction("liquid-bridge", &numbers)?, radius, radius);
    path.go(1e-9);
    Some(path)
}

fn liquid_bridge(bench: &mut Bench) {
    bench.rows("liquid_bridge_willett", &["force", "rupture_distance"], ROUND_OFF, |row| {
        let path = bridged(row)?;
        match row.get("S") {
            Some(distance) => Some(path.force(-distance)),
            None => border(0.0, -1.0, |overlap| path.force(overlap) != 0.0).map(|overlap| -overlap),
        }
    });
    let quadrature = Tolerance { relative: 1e-10, reason: "quadrature of the expected value" };
    bench.rows("liquid_bridge_willett", &["rupture_work"], quadrature, |row| {
        let mut path = bridged(row)?;
        path.go(0.0);
        Some(-path.stored)
    });
}
