//! Elastic spheres and their dashpots.

use pulvis_contact::ContactModel;
use pulvis_math::elementary;

use super::{Bench, INTEGRATED, ROUND_OFF, Suite, Tolerance};
use crate::verification::contact::{Path, damped, normal, outcome, restitution, wall};

pub(super) const SUITES: &[Suite] =
    &[("hertz", hertz), ("tsuji", tsuji), ("kuwabara-kono", kuwabara_kono), ("lee-radok", lee_radok)];

fn hertz(bench: &mut Bench) {
    bench.rows("hertz_elastic", &["dmax", "fmax", "tc", "amax"], INTEGRATED, |row| {
        let model = normal("hertz", &[("effective_modulus", row.get("E")?)])?;
        let radius = row.get("R")?;
        let outcome = outcome(&model, wall(row.get("m_r")?, radius), row.get("v")?)?;
        let path = Path::at_wall(&model, radius);
        match row.quantity {
            "dmax" => Some(outcome.overlap_max),
            "fmax" => Some(path.force(outcome.overlap_max)),
            "tc" => outcome.contact_duration,
            _ => Some(path.normal(outcome.overlap_max).contact_radius),
        }
    });
    bench.expect_from("conservation of energy");
    let found = normal("hertz", &[("effective_modulus", 1e8)])
        .and_then(|model| restitution(&model, wall(5e-6, 5e-4), 0.5));
    bench.check("e", "E=1e8 R=5e-4 m_r=5e-6 v=0.5", 1.0, found, INTEGRATED);
}

fn spheres() -> Option<ContactModel> {
    normal("hertz", &[("effective_modulus", 1e8)])
}

fn tsuji(bench: &mut Bench) {
    let e = |key: &str, value: f64, velocity: f64| {
        restitution(&damped(spheres()?, "tsuji", &[(key, value)])?, wall(5e-6, 5e-4), velocity)
    };
    bench.rows("hertz_tsuji", &["e"], INTEGRATED, |row| e("alpha", row.get("alpha")?, 0.5));
    // The dashpot that is made from e shall be the one that is printed for it: both give the same e.
    bench.rows("hertz_tsuji", &["alpha"], INTEGRATED, |row| {
        let found = e("restitution", row.get("e")?, 0.5)?;
        let logarithm = elementary::ln(found);
        let pi = std::f64::consts::PI;
        Some(-5.0_f64.sqrt() * logarithm / (pi * pi + logarithm * logarithm).sqrt())
    });
    bench.expect_from("Antypov & Elliott, EPL 94, 50004 (2011): e does not depend on the velocity");
    for velocity in [1e-3, 20.0] {
        let found = e("restitution", 0.5, velocity);
        bench.check("e", format!("restitution=0.5 v={velocity}"), 0.5, found, INTEGRATED);
    }
}

/// First coefficient of the series of e.
const C1: f64 = 1.153_448_858_1;

fn kuwabara_kono(bench: &mut Bench) {
    // k_H = (4/3) E* √R: with R = 1e-4 m, E* = 75 k_H.
    let collision = |k: f64, mass: f64, time: f64, velocity: f64| {
        let model = normal("hertz", &[("effective_modulus", 75.0 * k)])?;
        let model = damped(model, "kuwabara-kono", &[("dissipative_time", time)])?;
        outcome(&model, wall(mass, 1e-4), velocity)
    };
    let ode = Tolerance { relative: 1e-9, reason: "integration of the expected value" };
    bench.rows("hertz_kuwabara_kono", &["e_end_at_delta0", "t_end_at_delta0"], ode, |row| {
        let outcome = collision(row.get("k")?, row.get("m_r")?, row.get("A")?, row.get("v")?)?;
        if row.quantity == "e_end_at_delta0" { Some(outcome.restitution) } else { outcome.contact_duration }
    });
    bench.expect_from(
        "1 - C1 x + (3/5) C1^2 x^2, Ramirez, Poeschel, Brilliantov & Schwager, Phys. Rev. E 60, 4465 (1999)",
    );
    let series = Tolerance { relative: 3e-9, reason: "x^3 of the series, x = 1e-3" };
    for velocity in [0.01, 1.0] {
        // x = (3 A/2) (k_H/m_r)^(2/5) v^(1/5) = 1e-3.
        let rate = elementary::powf(1e13, 0.4) * elementary::powf(velocity, 0.2);
        let time = 1e-3 / (1.5 * rate);
        let x = C1 * 1e-3;
        let found = collision(1e7, 1e-6, time, velocity).map(|outcome| outcome.restitution);
        bench.check("e, series", format!("x=1e-3 v={velocity}"), 1.0 - x + 0.6 * x * x, found, series);
    }
}

fn lee_radok(bench: &mut Bench) {
    bench.rows("lee_radok_sls", &["force"], ROUND_OFF, |row| {
        let model = normal(
            "lee-radok",
            &[
                ("modulus_instant", row.get("E0")?),
                ("modulus_relaxed", row.get("Einf")?),
                ("relaxation_time", row.get("tau")?),
            ],
        )?;
        let mut path = Path::at_wall(&model, row.get("R")?);
        let overlap = row.get("delta")?;
        // Pressed in a moment, then held: 1e-20 of the relaxation time.
        let at_once = path.go_in(overlap, 1e-20 * row.get("tau")?).normal_force;
        let time = row.get("t")?;
        if time == 0.0 { Some(at_once) } else { Some(path.go_in(overlap, time).normal_force) }
    });
}
