//! Attractions at a distance.

use pulvis_input::collision::{Bodies, Sphere};
use pulvis_math::elementary;

use super::{Bench, ROUND_OFF, Suite, Tolerance};
use crate::verification::contact::{Path, attraction, normal, outcome_with};
use crate::verification::data::Row;
use crate::verification::search::border;

pub(super) const SUITES: &[Suite] =
    &[("hamaker", hamaker), ("liquid-bridge", liquid_bridge), ("coulomb", coulomb)];

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

/// Two spheres of 1 mm and 2500 kg/m³ with charges of ±10 pC, as in studies of charged grains.
fn coulomb(bench: &mut Bench) {
    let (radius, charges) = (1e-3, [1e-11, -1e-11]);
    let sphere =
        Sphere { radius, mass: 4.0 / 3.0 * std::f64::consts::PI * 2500.0 * elementary::powi(radius, 3) };
    let reduced = 0.5 * sphere.mass;
    bench.expect_from("v_e = √(2 k_e q²/(m_r d)), less the shift s_c/r_c of the potential");
    let printed = Tolerance { relative: 5e-6, reason: "printed with six digits" };
    for cutoff in [2e-3, 2e-2, 20.0] {
        let found = attraction("coulomb", &[("cutoff", cutoff)]).map(|model| {
            let mut path = Path::between(&model, radius, radius).with("charge", charges);
            path.go(0.0);
            (2.0 * -path.stored / reduced).sqrt()
        });
        let expected = 13.1015e-3 * cutoff / (2.0 * radius + cutoff);
        bench.check("escape speed", format!("a=1e-3 q=1e-11 cutoff={cutoff:e}"), expected, found, printed);
    }
    bench.expect_from("e² = e_n² (1 + v_e²/v²) − v_e²/v²; bound below v_e √(1/e_n² − 1)");
    let (loss, escape) = (0.9_f64, 0.5 * 13.1015e-3);
    let pulled = Tolerance { relative: 1e-3, reason: "the pull in contact; v_e printed with six digits" };
    for velocity in [3e-3, 4e-3, 5e-3, 2e-2] {
        let found = || {
            let mut model = normal("walton-braun", &[("k1", 1e3), ("k2", 1e3 / (loss * loss))])?;
            model.laws.noncontact = attraction("coulomb", &[("cutoff", 2e-3)])?.laws.noncontact;
            let bodies = Bodies::Pair([sphere; 2]);
            outcome_with(&model, bodies, velocity, ("charge", charges)).map(|outcome| outcome.restitution)
        };
        let ratio = escape / velocity;
        let expected = (loss * loss * (1.0 + ratio * ratio) - ratio * ratio).max(0.0).sqrt();
        bench.check("e", format!("a=1e-3 q=1e-11 cutoff=2e-3 v={velocity:e}"), expected, found(), pulled);
    }
}
