//! Bonds.

use std::f64::consts::PI;

use pulvis_contact::bond::INTACT;
use pulvis_math::Vector3;

use super::{Bench, INTEGRATED, Suite, Tolerance};
use crate::collision::Regime;
use crate::verification::contact::{Path, bonded, outcome, restitution, wall};
use crate::verification::motion::{Start, frequency};
use crate::verification::search::border;

pub(super) const SUITES: &[Suite] =
    &[("elastic-brittle", elastic_brittle), ("jiang", jiang), ("parallel-bond", parallel_bond)];

const RADIUS: f64 = 1e-3;
/// At which bonds form in a first look [m].
const TOUCH: f64 = 1e-15;

/// A bond that has formed between two spheres of 1 mm.
fn formed(name: &str, numbers: &[(&str, f64)]) -> Option<Path> {
    let mut path = Path::between(&bonded(name, numbers)?, RADIUS, RADIUS);
    path.go(TOUCH);
    Some(path)
}

fn holds(path: &Path) -> bool {
    path.column("bond_state") == Some(INTACT)
}

fn elastic_brittle(bench: &mut Bench) {
    let numbers = [("normal_stiffness", 1e3), ("tensile_strength", 1e-3)];
    let case = "k_n=1e3 F_t=1e-3 m_r=1e-6";
    bench.expect_from("two masses on a spring");
    let oscillates = || {
        let model = bonded("elastic-brittle", &numbers)?;
        let start = Start {
            mass: 2e-6,
            radius: RADIUS,
            with_partner: true,
            overlap: 1e-9,
            gravity: 0.0,
            velocity: Vector3::new(1e-7, 0.0, 0.0),
            angular_velocity: Vector3::zero(),
        };
        frequency(3.16e4, |dt| start.simulation(&model, dt), |now| now.velocity.x)
    };
    let extrapolated = Tolerance { relative: 2e-6, reason: "next order of the step" };
    bench.check("frequency √(k_n/m_r)", case, 31_622.776_601_683_79, oscillates(), extrapolated);
    let breaks = || {
        let model = bonded("elastic-brittle", &numbers)?;
        let sticks = |speed: f64| {
            outcome(&model, wall(1e-6, RADIUS), speed).is_some_and(|end| end.regime == Regime::Stick)
        };
        border(0.02, 0.05, sticks)
    };
    bench.check("breaking speed F_t/√(k_n m_r)", case, 0.031_622_776_601_683_79, breaks(), INTEGRATED);
    let left =
        bonded("elastic-brittle", &numbers).and_then(|model| restitution(&model, wall(1e-6, RADIUS), 0.05));
    bench.check("restitution at 0.05 m/s", case, 0.774_596_669_241_483_4, left, INTEGRATED);
    beam(bench);
}

/// The stiffnesses of a beam, from its response to one displacement each.
fn beam(bench: &mut Bench) {
    let (young_modulus, poisson_ratio, radius) = (1e9, 0.25, 4e-4);
    let numbers = [
        ("young_modulus", young_modulus),
        ("poisson_ratio", poisson_ratio),
        ("bond_radius", radius),
        ("tensile_strength", 1e3),
    ];
    let path = || formed("elastic-brittle", &numbers);
    let length = 2.0 * RADIUS;
    let area = PI * radius * radius;
    let second_moment = 0.25 * area * radius * radius;
    let shear_modulus = young_modulus / (2.0 * (1.0 + poisson_ratio));
    let coefficient = 6.0 * (1.0 + poisson_ratio) / (7.0 + 6.0 * poisson_ratio);
    let slender = young_modulus * second_moment / (length * length);
    let phi = 12.0 * slender / (coefficient * shear_modulus * area);
    let small = 1e-9;
    let case = "E=1e9 nu=0.25 r=4e-4 L=2e-3";
    bench.expect_from("Timoshenko beam, Cowper's shear coefficient");
    let along = path().map(|path| (path.force(TOUCH) - path.force(-small)) / (TOUCH + small));
    bench.check("E A/L", case, young_modulus * area / length, along, ROUND_OFF_OF_SMALL);
    let across = path().map(|mut path| path.slide(small) / small);
    bench.check(
        "12 E I/((1+Phi) L^3)",
        case,
        12.0 * slender / ((1.0 + phi) * length),
        across,
        ROUND_OFF_OF_SMALL,
    );
    let about = path().map(|mut path| path.twist(small) / small);
    let expected = 2.0 * shear_modulus * second_moment / length;
    bench.check("G J/L", case, expected, about, ROUND_OFF_OF_SMALL);
}

/// Forces of displacements of 1e-9 m.
const ROUND_OFF_OF_SMALL: Tolerance =
    Tolerance { relative: 1e-11, reason: "round-off, bond that formed at an overlap of 1e-15 m" };

fn jiang(bench: &mut Bench) {
    bench.rows("jiang_bond", &["R_s"], INTEGRATED, |row| {
        let stiffness = 1e6;
        let numbers = [
            ("normal_stiffness", stiffness),
            ("shear_stiffness", stiffness),
            ("tensile_strength", row.get("R_nt")?),
            ("compressive_strength", row.get("R_nc")?),
            ("shear_factor", row.get("f_s")?),
            ("shear_exponent", row.get("n_s")?),
            ("moment_factor", 1.0),
            ("moment_exponent", 1.0),
        ];
        let mut path = formed("jiang", &numbers)?;
        path.go(TOUCH + row.get("F_n")? / stiffness);
        let bears = |shear: f64| {
            let mut sheared = path.clone();
            sheared.slide(shear);
            holds(&sheared)
        };
        border(0.0, 1e-4, bears).map(|shear| shear * stiffness)
    });
}

fn parallel_bond(bench: &mut Bench) {
    let (per_area, of_shear, radius) = (1e9, 4e8, 4e-4);
    let numbers = [
        ("normal_stiffness_per_area", per_area),
        ("shear_stiffness_per_area", of_shear),
        ("bond_radius", radius),
        ("tensile_strength", 1e3),
        ("shear_strength", 2e3),
    ];
    let case = "K_n=1e9 K_s=4e8 r=4e-4 sigma_c=1e3 tau_c=2e3";
    bench.expect_from("strength of materials: F/A, and M r/J");
    let path = formed("parallel-bond", &numbers);
    let bears = |lead: fn(&mut Path, f64) -> f64, most: f64| {
        let path = path.as_ref()?;
        border(0.0, most, |size| {
            let mut led = path.clone();
            lead(&mut led, size);
            holds(&led)
        })
    };
    let tension = bears(|path, size| path.go(TOUCH - size).normal_force, 1e-5).map(|size| size * per_area);
    bench.check("tensile stress when it breaks", case, 1e3, tension, INTEGRATED);
    let shear = bears(Path::slide, 1e-4).map(|size| size * of_shear);
    bench.check("shear stress when it breaks", case, 2e3, shear, INTEGRATED);
    // M r/J = K_s φ r.
    let twist = bears(Path::twist, 0.1).map(|angle| angle * of_shear * radius);
    bench.check("stress of torsion when it breaks", case, 2e3, twist, INTEGRATED);
}
