//! Stages that take particles away, and quantities that go with the particles into the files.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod protocol_scenarios;

use std::fs;

use protocol_scenarios::{Series, run, scenario};

const BED: &str = r#"
[materials.grain]
density = "2500 kg/m^3"
[contacts.grain-grain]
normal = { law = "linear", k = "1000 N/m" }
viscosity = { law = "constant", gamma_0 = "1e-3 kg/s" }

[[particles]]
material = "grain"
radius = { distribution = "uniform", minimum = "0.4 mm", maximum = "0.5 mm" }
arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [4, 4, 4], spacing = "1 mm" }
velocity = { standard_deviation = "10 cm/s" }
columns = { charge = "1 pC", batch = 1 }

[[particles]]
material = "grain"
radius = { distribution = "fixed", value = "0.3 mm" }
arrangement = { kind = "list", positions = [["2 mm", "2 mm", "5 mm"]] }
columns = { batch = 2, charge = "-2 pC" }

[box]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["4 mm", "4 mm", "6 mm"]
material = "grain"

[[stages]]
name = "all"
until = { time = "2 ms" }
[[stages]]
name = "without a corner"
until = { time = "2 ms" }
remove = { kind = "sphere", centre = ["0 mm", "0 mm", "0 mm"], radius = "1.8 mm" }
[[stages]]
name = "none"
until = { time = "0.1 ms" }
remove = { kind = "box", lower = ["-1 mm", "-1 mm", "-1 mm"], upper = ["9 mm", "9 mm", "9 mm"] }
"#;

#[test]
fn stages_take_particles_away_and_the_ledger_stays_closed() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario(BED), folder.path());
    let series = Series::read(folder.path());
    let counts = [1, 2, 3].map(|stage| series.of_stage("particles", stage));
    let [all, some, none] = counts.map(|counts| {
        assert!(counts.iter().all(|count| *count == counts[0]), "{counts:?}");
        counts[0]
    });
    assert!(all == 65.0 && some < 63.0 && some > 40.0 && none == 0.0, "{all} {some} {none}");
    let [outflow, kinetic] = ["outflow", "kinetic"].map(|name| series.column(name));
    assert!(series.of_stage("outflow", 1).iter().all(|&energy| energy == 0.0));
    assert!(
        series.of_stage("outflow", 2)[0] > 0.0 && outflow.last() > Some(&series.of_stage("outflow", 2)[0])
    );
    assert_eq!(kinetic.last(), Some(&0.0));
    // Dashpots without cohesion at 50 steps a contact; the removal itself is exact.
    assert!(summary.energy_error_max < 1e-3, "{}", summary.energy_error_max);
    assert_eq!(summary.particles, 0);
}

#[test]
fn quantities_of_groups_stand_in_the_files_of_the_particles_that_are_left() {
    let folder = tempfile::tempdir().unwrap();
    run(&scenario(BED), folder.path());
    let mut frames: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .flat_map(|entry| {
            let path = entry.unwrap().path();
            if path.is_dir() {
                fs::read_dir(path).unwrap().map(|file| file.unwrap().path()).collect()
            } else {
                vec![path]
            }
        })
        .filter(|path| {
            path.to_string_lossy().contains("article") && path.extension().is_some_and(|end| end == "vtp")
        })
        .collect();
    frames.sort();
    // The start and the ends of three stages.
    assert_eq!(frames.len(), 4, "{frames:?}");
    for (frame, path) in frames.iter().enumerate() {
        let text = String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
        for column in ["charge", "batch", "coordination"] {
            assert!(text.contains(&format!("Name=\"{column}\"")), "{path:?} {column}");
        }
        let points = if frame < 2 { "NumberOfPoints=\"65\"" } else { "NumberOfPoints=\"" };
        assert!(text.contains(points) && (frame < 2 || !text.contains("NumberOfPoints=\"65\"")), "{path:?}");
    }
}
