//! The checks, law by law. Laws that are not in the catalogue are left out.

mod adhesive;
mod attractions;
mod bonds;
mod elastic;
mod friction;
mod linear;
mod plastic;
mod plastic_spheres;
mod sintering;

use super::bench::{Bench, Tolerance};

/// A law, and what adds its checks.
pub(super) type Suite = (&'static str, fn(&mut Bench));

/// Every suite; the laws of a file in one list.
pub(super) const ALL: &[&[Suite]] = &[
    linear::SUITES,
    elastic::SUITES,
    adhesive::SUITES,
    plastic::SUITES,
    plastic_spheres::SUITES,
    sintering::SUITES,
    attractions::SUITES,
    friction::SUITES,
    bonds::SUITES,
];

/// A formula evaluated once.
const ROUND_OFF: Tolerance = Tolerance { relative: 1e-12, reason: "round-off" };

/// A collision integrated with error control.
const INTEGRATED: Tolerance = Tolerance { relative: 1e-10, reason: "integration to round-off" };

/// A number that is printed with so many digits.
const TEN_DIGITS: Tolerance = Tolerance { relative: 1e-9, reason: "printed with ten digits" };

/// The place of a flat minimum, or of what grows like a root.
const FLAT: Tolerance = Tolerance { relative: 1e-7, reason: "a root of the round-off" };
