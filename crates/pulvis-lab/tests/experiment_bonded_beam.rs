//! The experiment `bonded-beam` gives what its `expected.toml` says.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod protocol_scenarios;

use protocol_scenarios::{Series, run};
use pulvis_input::{Dimension, Document, Reported, Scenario, TableReader};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../experiments/bonded-beam");

/// Deflection [m] and angular frequency [1/s], each with its tolerance.
fn expected(mut root: TableReader<'_>) -> Result<[[f64; 2]; 2], Reported> {
    let deflection = root.required("deflection", Dimension::LENGTH)?;
    let frequency = root.required("frequency", Dimension::RATE)?;
    let mut tolerance = |key| root.required(key, Dimension::NONE);
    let tolerances = [tolerance("deflection_tolerance")?, tolerance("frequency_tolerance")?];
    root.finish();
    Ok([[deflection, tolerances[0]], [frequency, tolerances[1]]])
}

#[test]
fn bonded_spheres_bend_and_swing_as_a_beam() {
    let scenario = Scenario::load(format!("{FOLDER}/experiment.toml")).unwrap();
    let expected = Document::load(format!("{FOLDER}/expected.toml")).unwrap().read(expected).unwrap();
    let folder = tempfile::tempdir().unwrap();
    run(&scenario, folder.path());
    let series = Series::read(folder.path());
    assert_eq!(series.column("bonds").last(), Some(&10.0));
    let bent = -series.of_stage("centre_of_mass_y", 1).last().unwrap();
    let (times, heights) = (series.of_stage("time", 2), series.of_stage("centre_of_mass_y", 2));
    let points: Vec<(f64, f64)> = times.into_iter().zip(heights).collect();
    let crossing = |pair: &[(f64, f64)]| {
        let [(time, before), (next, now)] = [pair[0], pair[1]];
        (before < 0.0 && now >= 0.0).then(|| time + (next - time) * before / (before - now))
    };
    let crossings: Vec<f64> = points.windows(2).filter_map(crossing).collect();
    let periods = crossings.len() - 1;
    assert!(periods >= 4, "{crossings:?}");
    let frequency = std::f64::consts::TAU * periods as f64 / (crossings[periods] - crossings[0]);
    for (found, [value, tolerance]) in [bent, frequency].into_iter().zip(expected) {
        assert!((found / value - 1.0).abs() <= tolerance, "{found}, expected {value}");
    }
}
