//! Force-overlap loops of the Luding law against values from outside this crate and values derived by
//! hand.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeMap;

use pulvis_contact::normal::{Interpolation, LudingMemory};
use pulvis_contact::{Luding, NormalLaw, NormalMotion, NormalResponse, Pair};

/// The columns of `tests/data/luding_reference.csv` that a loop needs.
struct Row {
    group: String,
    law: Luding,
    pair: Pair,
    quantity: String,
    value: f64,
    x: String,
    note: String,
}

fn rows(figure: &str) -> Vec<Row> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/luding_reference.csv");
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names = reader.headers().unwrap().clone();
    let records = reader.records().map(Result::unwrap);
    let field = |record: &csv::StringRecord, name: &str| {
        record[names.iter().position(|known| known == name).unwrap()].to_owned()
    };
    let number = |record: &csv::StringRecord, name: &str| field(record, name).parse::<f64>().unwrap();
    records
        .filter(|record| field(record, "figure") == figure && field(record, "seed_paper") == "1")
        .map(|record| Row {
            group: field(&record, "curve"),
            law: Luding {
                k1: number(&record, "k1"),
                kp: number(&record, "kp"),
                kc: number(&record, "kc"),
                phi_f: number(&record, "phi_f"),
                interpolation: Interpolation::Linear,
            },
            pair: Pair::spheres(
                number(&record, "m1"),
                number(&record, "m2"),
                number(&record, "a1"),
                number(&record, "a2"),
            ),
            quantity: field(&record, "quantity"),
            value: number(&record, "value"),
            x: field(&record, "x"),
            note: field(&record, "note"),
        })
        .collect()
}

/// δ_p of figure 10's untuned contact, in which all its loops are given [m].
fn reference_limit() -> f64 {
    LAW.plastic_limit(&pair())
}

const LAW: Luding =
    Luding { k1: 100.0, kp: 500.0, kc: 100.0, phi_f: 0.05, interpolation: Interpolation::Linear };

/// The answer at rest at an overlap [m].
fn respond(law: &Luding, pair: &Pair, overlap: f64, memory: &mut LudingMemory<f64>) -> NormalResponse {
    law.respond(&NormalMotion::at_rest(pair, overlap), memory)
}

fn pair() -> Pair {
    Pair::spheres(1.1150559525141375e-5, 1.1150559525141375e-5, 1.1e-3, 1.1e-3)
}

/// Where a pair of η = 4, β = 1 first stops on the adhesive branch, over δ_p: S1 (36) and (38) in
/// compact form. The samples in time step over this turning point.
fn first_stop(chi: f64) -> f64 {
    let (eta, beta) = (4.0, 1.0);
    let x = eta * chi;
    if chi <= 1.0 {
        chi * ((beta * x - 1.0 - beta) / (beta * (1.0 + beta + x))).sqrt()
    } else {
        (((1.0 + beta) * eta / (1.0 + eta + beta) - chi * chi) / beta).sqrt()
    }
}

#[test]
fn the_collisions_of_figure_7_pass_through_the_reference_forces() {
    let mut curves: BTreeMap<String, Vec<Row>> = BTreeMap::new();
    for row in rows("7") {
        curves.entry(row.group.clone()).or_default().push(row);
    }
    let mut points = 0;
    for (curve, rows) in curves {
        let value = |quantity: &str| rows.iter().find(|row| row.quantity == quantity).unwrap().value;
        let series = |quantity: &str| {
            let chosen = rows.iter().filter(|row| row.quantity == quantity);
            chosen.map(|row| (&row.note, row.value)).collect::<Vec<_>>()
        };
        let chi: f64 = curve.trim_start_matches("chi=").split(' ').next().unwrap().parse().unwrap();
        let mut turning_points = vec![value("delta_max_over_dp"), first_stop(chi)].into_iter();
        let (law, pair) = (rows[0].law, rows[0].pair);
        let limit = law.plastic_limit(&pair);
        let mut memory = LudingMemory::default();
        let mut unloading = false;
        for ((note, overlap), (_, force)) in
            series("delta_over_dp").into_iter().zip(series("f_total_over_k1dp"))
        {
            if overlap <= 0.0 {
                break;
            }
            // On k2 the collision has turned, first at the largest overlap, later on the adhesive branch.
            let elastic = note.ends_with("branch=k2");
            if let Some(turn) = (elastic && !unloading).then(|| turning_points.next()).flatten() {
                respond(&law, &pair, turn * limit, &mut memory);
            }
            unloading = elastic;
            let answer = respond(&law, &pair, overlap * limit, &mut memory);
            let found = answer.force / (law.k1 * limit);
            assert!((found - force).abs() < 1e-12, "{curve}, {note}: {found}, reference {force}");
            points += 1;
        }
    }
    assert!(points > 50, "only {points} points of figure 7 were compared");
}

#[test]
fn the_quasi_static_loops_of_figure_10_pass_through_the_reference_points() {
    let mut memories: BTreeMap<String, LudingMemory<f64>> = BTreeMap::new();
    let mut points = 0;
    for row in rows("10").iter().filter(|row| row.quantity == "f_over_k1dp_ref") {
        let memory = memories.entry(row.group.clone()).or_default();
        let (overlap, branch) =
            row.note.strip_prefix("delta/dp_ref=").unwrap().split_once(" branch=").unwrap();
        let overlap = overlap.parse::<f64>().unwrap() * reference_limit();
        let answer = respond(&row.law, &row.pair, overlap, memory);
        let found = answer.force / (row.law.k1 * reference_limit());
        assert!(
            (found - row.value).abs() < 1e-12,
            "{}, step {}: {found}, reference {} on {branch}",
            row.group,
            row.x,
            row.value
        );
        points += 1;
    }
    assert!(points > 30, "only {points} points of figure 10 were compared");
}

#[test]
fn equal_stiffnesses_make_an_elastic_contact_with_any_interpolation() {
    for interpolation in [Interpolation::Linear, Interpolation::SquareRoot, Interpolation::Constant] {
        let law = Luding { kp: 100.0, interpolation, ..LAW };
        let mut memory = LudingMemory::default();
        for overlap in [1e-6, 5e-5, 1e-3, 2e-5, 0.0, 3e-6] {
            let answer = respond(&law, &pair(), overlap, &mut memory);
            // One rounding of k1 δ.
            assert!((answer.force - 100.0 * overlap).abs() <= 1e-15, "{interpolation:?}: {answer:?}");
            assert!((answer.stored_energy - 50.0 * overlap * overlap).abs() <= 1e-18);
            assert_eq!((answer.dissipated_plastic, answer.dissipated_adhesive), (0.0, 0.0));
        }
    }
}

#[test]
fn without_adhesion_the_force_is_zero_below_the_plastic_overlap_and_never_negative() {
    let law = Luding { kc: 0.0, ..LAW };
    let limit = law.plastic_limit(&pair());
    let mut memory = LudingMemory::default();
    respond(&law, &pair(), limit, &mut memory);
    // δ_0 = (1 − k1/kp) δ_p = 0.8 δ_p; above it the slope is kp.
    let at = |x: f64, memory: &mut LudingMemory<f64>| {
        respond(&law, &pair(), x * limit, memory).force / (law.k1 * limit)
    };
    assert!((at(0.9, &mut memory) - 0.5).abs() < 1e-12);
    assert!(at(0.8, &mut memory).abs() < 1e-12);
    assert_eq!(at(0.4, &mut memory), 0.0);
    // D has shrunk to the D whose plastic overlap is 0.4 δ_p: X = (y + √(y² + 4 y/η))/2.
    let shrunk = 0.5 * (0.4 + (0.16_f64 + 0.4).sqrt());
    assert!((memory.overlap_max / limit - shrunk).abs() < 1e-12);
    let k2 = 1.0 + 4.0 * shrunk;
    assert!((at(0.5, &mut memory) - 0.1 * k2).abs() < 1e-12);
}

/// One loop: load to δ_max, unload to the tensile extremum, half way down the adhesive branch,
/// all with the expected k2 [N/m].
fn loop_of(interpolation: Interpolation, overlap_max: f64, k2: f64) {
    let law = Luding { interpolation, ..LAW };
    let mut memory = LudingMemory::default();
    let mut at = |overlap: f64| respond(&law, &pair(), overlap, &mut memory).force;
    let scale = 1e-12 * law.k1 * law.plastic_limit(&pair()).min(1.0);
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < scale, "{found} {expected}");
    let force_free = (1.0 - law.k1 / k2) * overlap_max;
    let overlap_min = (k2 - law.k1) / (k2 + law.kc) * overlap_max;
    close(at(0.5 * overlap_max), 0.5 * law.k1 * overlap_max);
    close(at(overlap_max), law.k1 * overlap_max);
    close(at(force_free), 0.0);
    close(at(overlap_min), -law.kc * overlap_min);
    close(at(0.5 * overlap_min), -0.5 * law.kc * overlap_min);
}

#[test]
fn a_square_root_contact_hardens_with_the_root_of_the_overlap() {
    // D = δ_p/4: k2 = k1 + (kp − k1)/2 = 300 N/m, S1 (D.1).
    let quarter = 0.25 * reference_limit();
    loop_of(Interpolation::SquareRoot, quarter, 300.0);
    // On the adhesive branch at y = δ/δ_p the new D is s² δ_p with s³ − y s − y (1 + β)/η = 0;
    // s = 1/2 gives y = (1/8)/(1/2 + 1/2) = 1/8.
    let law = Luding { interpolation: Interpolation::SquareRoot, ..LAW };
    let limit = law.plastic_limit(&pair());
    let mut memory = LudingMemory::default();
    respond(&law, &pair(), limit, &mut memory);
    let answer = respond(&law, &pair(), 0.125 * limit, &mut memory);
    assert!((answer.force + 0.125 * law.kc * limit).abs() < 1e-12 * law.k1 * limit);
    assert!((memory.overlap_max / limit - 0.25).abs() < 1e-14, "{}", memory.overlap_max / limit);
    // Re-loading follows k2 = 300 N/m.
    let step = 0.01 * limit;
    let reloaded = respond(&law, &pair(), 0.125 * limit + step, &mut memory);
    assert!((reloaded.force - answer.force - 300.0 * step).abs() < 1e-12 * law.k1 * limit);
}

#[test]
fn a_contact_of_constant_stiffness_unloads_along_kp_from_any_overlap() {
    loop_of(Interpolation::Constant, 1e-5, 500.0);
    loop_of(Interpolation::Constant, 5.0 * reference_limit(), 500.0);
    // Walton and Braun: the plastic loss is ½ k1 D δ_0, restitution √(k1/kp) without adhesion.
    let law = Luding { interpolation: Interpolation::Constant, kc: 0.0, ..LAW };
    let mut memory = LudingMemory::default();
    let overlap = 3e-5;
    let answer = respond(&law, &pair(), overlap, &mut memory);
    let work = 0.5 * law.k1 * overlap * overlap;
    assert!((answer.stored_energy / work - law.k1 / law.kp).abs() < 1e-14);
    assert!((answer.dissipated_plastic / work - 0.8).abs() < 1e-14);
}

#[test]
fn a_full_loop_loses_half_of_force_free_overlap_times_both_extreme_forces() {
    // W = ½ δ_0 (k1 D + kc δ_min), the area of the loop; at D = δ_p: δ_0 = 0.8, δ_min = 2/3.
    let limit = reference_limit();
    let mut memory = LudingMemory::default();
    let loaded = respond(&LAW, &pair(), 1.7 * limit, &mut memory);
    let opened = respond(&LAW, &pair(), 0.0, &mut memory);
    let lost = loaded.dissipated_plastic + opened.dissipated_adhesive;
    let expected = 0.5 * 0.8 * (1.0 + 2.0 / 3.0) * LAW.k1 * limit * limit;
    assert!((lost / expected - 1.0).abs() < 1e-13, "{lost} {expected}");
}

#[test]
fn a_contact_that_remembers_more_than_its_law_allows_is_fully_plastic_and_no_stiffer() {
    let law = Luding { k1: 100.0, kp: 500.0, kc: 50.0, phi_f: 0.05, interpolation: Interpolation::Linear };
    let pair = Pair::spheres(1e-6, 1e-6, 1e-3, 1e-3);
    let limit: f64 = law.plastic_limit(&pair);
    let overlap = 0.9 * limit;
    let respond = |overlap_max: f64| {
        law.respond(&NormalMotion::at_rest(&pair, overlap), &mut LudingMemory { overlap_max })
    };
    let (beyond, at_limit) = (respond(1.5 * limit), respond(limit));
    assert_eq!((beyond.force, beyond.stored_energy), (at_limit.force, at_limit.stored_energy));
    assert!((respond(limit).force - 500.0 * (overlap - 0.05 * 1e-3)).abs() < 1e-15);
}
