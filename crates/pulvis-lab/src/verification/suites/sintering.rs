//! Contacts that change with time and temperature.

use pulvis_contact::ContactModel;
use pulvis_contact::catalogue::Values;
use pulvis_math::elementary;

use super::{Bench, ROUND_OFF, Suite, Tolerance};
use crate::verification::contact::{Path, normal_by, values};
use crate::verification::data::Row;

pub(super) const SUITES: &[Suite] = &[("sinter-luding", sinter_luding), ("sinter-overlap", sinter_overlap)];

/// As long as nothing that relaxes is left, over the time scale.
const FOR_EVER: f64 = 1e18;

/// Contact that is 100 N/m stiff when cold, with these temperatures [K] of melting, and the time scale [s].
fn softening(melting: f64, width: f64, time_scale: f64) -> Option<ContactModel> {
    let numbers = [
        ("k1", 100.0),
        ("kp", 500.0),
        ("kc", 20.0),
        ("phi_f", 0.2),
        ("t_melt", melting),
        ("t_width", width),
        ("time_scale", time_scale),
    ];
    normal_by("sinter-luding", &values(&numbers))
}

/// The stiffness of plastic loading [N/m]: force over overlap where the contact yields.
fn plastic_stiffness(path: &mut Path) -> f64 {
    let overlap = 2e-4;
    path.go(overlap).normal_force / overlap
}

fn sinter_luding(bench: &mut Bench) {
    let (melting, width) = (500.0, 10.0);
    // At which the stiffness settles at a value, k1/2 [1 + tanh((T_m − T)/ΔT)]; a cold contact at 1 K.
    let temperature = |settled: f64| {
        let share = settled / 100.0;
        if share < 1.0 { melting - 0.5 * width * elementary::ln(share / (1.0 - share)) } else { 1.0 }
    };
    bench.rows("luding_sintering", &["k1"], ROUND_OFF, |row| {
        let (start, settled, time_scale) = (row.get("k1_0")?, row.get("k_T")?, row.get("t0")?);
        let mut path = Path::at_wall(&softening(melting, width, time_scale)?, 1e-3);
        path.go(1e-5);
        if start < 100.0 {
            path.temperature = temperature(start);
            path.go_in(1e-5, FOR_EVER * time_scale);
        }
        path.temperature = temperature(settled);
        path.go_in(1e-5, row.get("t")?);
        Some(plastic_stiffness(&mut path))
    });
    bench.rows("luding_sintering", &["k_T"], ROUND_OFF, |row| {
        let mut path = Path::at_wall(&softening(row.get("T_melt")?, row.get("dT")?, 1.0)?, 1e-3);
        path.go(1e-5);
        path.temperature = row.get("T")?;
        path.go_in(1e-5, FOR_EVER);
        Some(plastic_stiffness(&mut path))
    });
}

/// Elastic stiffness of necks when they begin [N/m].
const NECK_STIFFNESS: f64 = 1e3;

/// The plastic overlap [m] of a neck that nothing but the sintering force pulls, after a time, in steps in which the elastic
/// part would fall by this share.
fn neck(row: &Row, step: f64) -> Option<f64> {
    let (rate, diameter, tension) = (row.get("rate")?, row.get("d_eff")?, 0.1);
    let numbers: Values = values(&[
        ("k1", NECK_STIFFNESS),
        ("kp", 2.0 * NECK_STIFFNESS),
        ("kc", 0.0),
        ("phi_f", 0.5),
        ("sinter_tension", tension),
        ("rate", rate),
    ]);
    let model = normal_by("sinter-overlap", &numbers.with_choice("growth", "parhami-mcmeeking"))?;
    let mut path = Path::at_wall(&model, 0.5 * diameter);
    let (pull, end) = (tension * diameter, row.get("t")?);
    let (mut overlap, mut plastic, mut time) = (pull / NECK_STIFFNESS, 0.0, 0.0);
    path.go(overlap);
    while time < end {
        let relative = overlap / diameter;
        let fall = 2.0 * rate * NECK_STIFFNESS / (0.75 * tension * relative * relative);
        let duration = (step / fall).min(end - time);
        let answer = path.go_in(overlap, duration);
        plastic = overlap - (answer.normal_force + pull) / answer.stiffness;
        overlap = plastic + pull / answer.stiffness;
        time += duration;
    }
    Some(plastic)
}

fn sinter_overlap(bench: &mut Bench) {
    let stretched = Tolerance { relative: 1e-3, reason: "the neck is stretched elastically by 5e-4" };
    bench.rows("sinter_parhami", &["delta_p"], stretched, |row| {
        let (coarse, fine) = (neck(row, 0.04)?, neck(row, 0.02)?);
        Some(fine + (fine - coarse))
    });
}
