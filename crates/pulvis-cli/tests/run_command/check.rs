//! `pulvis check`: what it tells, and what it warns of.

use crate::place::*;

use std::fs;

#[test]
fn check_says_what_the_run_will_be_like_and_writes_nothing() {
    // A start without contacts: a packing needs more memory.
    let wide = [(r#"spacing = "2.2 mm""#, r#"spacing = "4 mm""#), ("6.6 mm", "12 mm")];
    let place = Place::new("check", &wide);
    let output = place.pulvis(&["check", "s.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    let text = out(&output);
    // By hand: mass 4/3 π r³ ρ. S1 (10), (34), (37) with η = 4, β = 1: the limit overlap is
    // kp/(kp − k1) φ_f a12 = 1.25 · 0.05 · 1 mm = 62.5 µm, v_p = 62.5 µm √(k1/m_r) with the reduced mass
    // m_r = m/2; pairs stick from 0.5 v_p to 1.1547 v_p.
    for line in [
        "s.toml: untitled: valid",
        "particles         27 with radii 1.0000e-3 to 1.0000e-3 m",
        "masses            8.3776e-6 to 8.3776e-6 kg, together 2.2619e-4 kg",
        "walls             x-low, x-high, y-low, y-high, z-low, z-high",
        "contact grain-grain shortest motion 2.8755e-4 s",
        "                  normal luding: k1 = 100 N/m, kp = 500 N/m, kc = 100 N/m, phi_f = 0.05",
        "fully plastic above v_p = 3.0538e-1 m/s",
        "sticks from 1.5269e-1 to 3.5262e-1 m/s",
        "mix: time step 5.7509e-6 s, 174 steps, shortest motion 2.8755e-4 s (grain-grain)",
        "memory            ",
        " candidate contacts at the start and two states for checkpoints, ",
        " with the contacts of a dense packing, 12 neighbours each: ",
        " bytes a particle\n",
        "steps/s on this machine",
        "output            s-run",
    ] {
        assert!(text.contains(line), "no `{line}` in\n{text}");
    }
    assert_eq!(fs::read_dir(&place.0).unwrap().count(), 1);
}

#[test]
fn check_tells_softness_and_bond_number_of_what_is_pressed() {
    // 27 particles are no bulk, 64 are.
    let many =
        [("counts = [3, 3, 3]", "counts = [4, 4, 4]"), (r#"spacing = "2.2 mm""#, r#"spacing = "2.2 mm""#)];
    let pressed = [many[0], many[1], ("6.6 mm", "8.8 mm"), (UNTIL, PRESSED)];
    let text = checked("regime", &pressed);
    // By hand: f = π (2 mm)² 100 Pa/3.6 = 3.4907e-4 N, δ = f/k1 = 3.4907 µm: p* = 100 Pa · 2 mm/(100 N/m); x = 4 δ/62.5 µm =
    // 0.2234 with β = 1: f_t/f = x/(2 + x) = 0.10047, and Bo = 0.10047 π/3.6.
    for line in [
        "regime            mix: 1.000e2 Pa of the wall z-high\n",
        "                  grain-grain p* = 2.0e-3 (soft), Bo = 0.09 (cohesion hardly matters), X = 0.06 (below the plastic limit)\n",
    ] {
        assert!(text.contains(line), "no `{line}` in\n{text}");
    }
}

/// What `check` says of a scenario that is valid.
fn checked(name: &str, changes: &[(&str, &str)]) -> String {
    let output = Place::new(name, changes).pulvis(&["check", "s.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    out(&output)
}

fn warnings(text: &str) -> Vec<&str> {
    text.lines().filter_map(|line| line.strip_prefix("warning           ")).collect()
}

const NORMAL: &str =
    r#"normal = { law = "luding", k1 = "100 N/m", kp = "500 N/m", kc = "100 N/m", phi_f = 0.05 }"#;
const UNTIL: &str = r#"until = { time = "1 ms" }"#;
const PRESSED: &str = r#"until = { time = "1 ms" }
walls.z-high = { control = "servo", pressure = "100 Pa", mass = "1 g", damping = "1e-2 kg/s" }"#;
const VELOCITY: &str = r#"velocity = { standard_deviation = "1 m/s" }"#;

#[test]
fn speeds_of_sticking_are_those_with_the_dashpot() {
    assert!(warnings(&checked("undamped", &[])).is_empty());
    let dashpot =
        |gamma: &str| format!("{NORMAL}\nviscosity = {{ law = \"constant\", gamma_0 = \"{gamma} kg/s\" }}");
    let damped = checked("damped", &[(NORMAL, &dashpot("1e-2"))]);
    assert!(damped.contains("fully plastic above v_p = 3.0538e-1 m/s, dashpot left out"), "{damped}");
    // A new user saw all pairs stick from 0.1 to 0.5 m/s, which the closed form without dashpot denies.
    let line = damped.lines().find(|line| line.contains("sticks from ")).unwrap();
    let words: Vec<&str> = line.split_whitespace().collect();
    let number = |position: usize| words[position].parse::<f64>().unwrap();
    assert!(number(2) < 0.1 && number(4) > 0.5, "{line}");
    assert!(line.ends_with(" m/s, head on, by collisions"), "{line}");
    let place = Place::new("overdamped", &[(NORMAL, &dashpot("10"))]);
    let refused = error(&place.pulvis(&["check", "s.toml"]));
    let at = "error: s.toml:6:13: contacts.grain-grain.viscosity: contact grain-grain (stage mix): the dashpot along the normal is 109 times the critical one; such a contact creeps, and makes the time step shorter than its springs need; expected at most the critical one\n";
    assert!(refused.starts_with(at), "{refused}");
    let overdamped = out(&place.pulvis(&["check", "s.toml", "--allow", "overdamped"]));
    // 10 kg/s over 2 √(kp m/2) = 2 √(500 N/m · 4.1888e-6 kg) = 9.1529e-2 kg/s.
    assert_eq!(
        warnings(&overdamped),
        [
            "allowed by `overdamped`: contacts with dashpots beyond critical",
            "contact grain-grain (stage mix): the dashpot along the normal is 109 times the critical one; such a contact creeps, and makes the time step shorter than its springs need"
        ]
    );
    assert!(!overdamped.contains("sticks"), "{overdamped}");
}

#[test]
fn a_stage_that_waits_for_rest_where_nothing_moves_is_told() {
    let rest = r#"until = { kinetic_to_elastic = 1e-3, time = "1 ms" }"#;
    let text = checked("idle", &[(VELOCITY, ""), (UNTIL, rest)]);
    let idle = "stage mix: nothing moves (no gravity, no wall that moves, all particles at rest), so that waiting for rest tells nothing; is gravity missing?";
    assert_eq!(warnings(&text), [idle]);
    let gravity =
        ("[materials.grain]", "gravity = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n[materials.grain]");
    assert!(warnings(&checked("falling", &[gravity, (VELOCITY, ""), (UNTIL, rest)])).is_empty());
    let endless = r#"until = { kinetic_to_elastic = 1e-3 }"#;
    assert_eq!(
        warnings(&checked("endless", &[gravity, (VELOCITY, ""), (UNTIL, endless)])),
        ["stage mix: it has no `time`: it goes on for ever if its rule never holds"]
    );
}

#[test]
fn rules_that_can_never_hold_are_told() {
    let strain = r#"until = { time = "1 ms", strain = { axis = "x", value = -0.1 } }"#;
    let text = checked("strain", &[(UNTIL, strain)]);
    assert_eq!(warnings(&text), ["stage mix: the rule `strain` never holds: no wall moves along x"]);
    let stress =
        r#"until = { time = "1 ms", stress = { axis = "z", value = "2 kPa", crosses = "upwards" } }"#;
    let servo = format!(
        "{stress}\nwalls.z-high = {{ control = \"servo\", pressure = \"1 kPa\", mass = \"10 mg\", damping = \"1e-3 kg/s\" }}"
    );
    let text = checked("stress", &[(UNTIL, &servo)]);
    assert_eq!(
        warnings(&text),
        [
            "stage mix: the rule `stress` holds in overshoots at most: the servo along z keeps between 1e3 and 1e3 Pa, the rule waits for 2e3 Pa"
        ]
    );
    let idle = warnings_of_idle_stress(stress);
    assert!(idle.contains("the rule `stress` never holds: nothing presses the walls along z"), "{idle}");
}

fn warnings_of_idle_stress(stress: &str) -> String {
    checked("idle_stress", &[(VELOCITY, ""), (UNTIL, stress)])
}

#[test]
fn a_folder_that_a_run_would_refuse_and_the_room_for_its_files_are_told() {
    let place = Place::new("room", &[]);
    assert_eq!(place.pulvis(&["run", "s.toml"]).status.code(), Some(0));
    let text = out(&place.pulvis(&["check", "s.toml"]));
    assert_eq!(
        warnings(&text),
        [
            "`pulvis run` will refuse this: output folder s-run is not empty; choose another one with `--output DIR`, go on with the run in it with `--resume s-run`, or write over that with `--force`"
        ]
    );
    let line = text.lines().find(|line| line.contains(" frames of ")).unwrap();
    assert!(line.contains("2 frames of ") && line.ends_with(" are free"), "{line}");
    // 18 rows of some 50 columns: the estimate is near the truth.
    let (_, series) = line.split_once("time series ").unwrap();
    let told: f64 = series.split_whitespace().next().unwrap().parse().unwrap();
    let truth = fs::metadata(place.0.join("s-run/timeseries.csv")).unwrap().len() as f64 / 1000.0;
    assert!((0.5..2.0).contains(&(told / truth)), "{told} kB told, {truth} kB written");
}

#[cfg(not(feature = "hdf5"))]
#[test]
fn a_format_that_is_not_built_in_is_refused_before_anything_is_written() {
    let files = "{ steps = 10 }\n\n[[output.files]]\nformat = \"csv\"\n\n[[output.files]]\nname = \"packed\"\nformat = \"hdf5\"";
    let place = Place::new("not_built", &[("{ steps = 10 }", files)]);
    for command in [&["check", "s.toml"][..], &["run", "s.toml", "--output", "out"]] {
        let refused = place.pulvis(command);
        assert_eq!(refused.status.code(), Some(2));
        assert_eq!(
            error(&refused),
            "error: s.toml:30:10: output.files[1].format: this program was built without the format \"hdf5\"; expected a program that has it, or another format\n  |\n30| format = \"hdf5\"\n  |          ^^^^^^\n  \
             help: build it with `cargo build --release -p pulvis-cli --features hdf5`, which needs the HDF5 library and its headers (Debian: libhdf5-dev)\n"
        );
    }
    assert!(!place.0.join("out").exists());
}

#[test]
fn output_that_certainly_does_not_fit_onto_the_disk_is_refused() {
    let every_step =
        [(UNTIL, r#"until = { time = "1e9 s" }"#), ("{ steps = 10 }", "{ steps = 10 }\nvtk = { steps = 1 }")];
    let place = Place::new("full_disk", &every_step);
    for command in [&["check", "s.toml"][..], &["run", "s.toml", "--output", "out"]] {
        let refused = place.pulvis(command);
        assert_eq!(refused.status.code(), Some(2));
        let text = error(&refused);
        assert!(text.starts_with("error: s.toml:24:7: output.vtk: the files take "), "{text}");
        assert!(text.contains(" GB are free at ") && text.contains("`--allow disk`"), "{text}");
    }
    assert!(!place.0.join("out").exists());
    let allowed = out(&place.pulvis(&["check", "s.toml", "--allow", "disk"]));
    let told = warnings(&allowed);
    assert_eq!(
        told,
        [
            "allowed by `disk`: more output than fits onto the disk",
            "the disk has not enough room for the output"
        ]
    );
}

/// A lattice of so many layers of a million sites each, in a box that holds it.
fn layers(count: usize) -> [(&'static str, String); 2] {
    let lattice = LATTICE.replace("[3, 3, 3]", &format!("[1000, 1000, {count}]"));
    [
        (LATTICE, lattice),
        (r#"["6.6 mm", "6.6 mm", "6.6 mm"]"#, format!(r#"["2.2 m", "2.2 m", "{} mm"]"#, 3 * count)),
    ]
}

#[test]
fn more_particles_than_can_be_numbered_are_refused_before_any_is_made() {
    let [lattice, walls] = layers(2000);
    let place = Place::new("too_many", &[(lattice.0, &lattice.1), (walls.0, &walls.1)]);
    for command in ["check", "run"] {
        let output = place.pulvis(&[command, "s.toml"]);
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""));
        let expected = "error: s.toml:10:78: particles[0].arrangement.counts: there are 2000000000 particles; expected 1073741823 or fewer, which the engine can number";
        assert!(error(&output).contains(expected), "{}", error(&output));
    }
    assert_eq!(fs::read_dir(&place.0).unwrap().count(), 1);
}

#[test]
#[cfg(target_os = "linux")]
fn more_particles_than_the_memory_holds_are_refused_before_any_is_made() {
    let [lattice, walls] = layers(30);
    let place = Place::new("too_large", &[(lattice.0, &lattice.1), (walls.0, &walls.1)]);
    // Four gigabytes for a sample that needs more than ten: without the estimate, an abort.
    let limited = format!("ulimit -v 4000000; exec {} \"$@\"", env!("CARGO_BIN_EXE_pulvis"));
    for arguments in [&["check", "s.toml"][..], &["run", "s.toml", "--output", "out"]] {
        let mut shell = std::process::Command::new("sh");
        let output =
            shell.args(["-c", &limited, "sh"]).args(arguments).current_dir(&place.0).output().unwrap();
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""), "{}", error(&output));
        let text = error(&output);
        assert!(text.contains("30000000 particles need about "), "{text}");
        assert!(text.contains("B of memory before the first step, and "), "{text}");
        assert!(
            text.contains(" GB of memory are available; expected particles that fit into the memory"),
            "{text}"
        );
        assert!(text.contains("lets it pass with `--allow memory`"), "{text}");
    }
    assert!(!place.0.join("out").exists());
}

#[test]
fn several_files_are_checked_in_one_go() {
    let place = Place::new("several", &[]);
    fs::write(place.0.join("bad.toml"), place.read("s.toml").replace("1 ms", "1 mm")).unwrap();
    let output = place.pulvis(&["check", "bad.toml", "s.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(out(&output).contains("s.toml: untitled: valid"), "{}", out(&output));
    assert!(
        error(&output).starts_with("error: bad.toml:20:18: stages[0].until.time: "),
        "{}",
        error(&output)
    );
}

#[test]
fn check_prints_the_numbers_that_follow_from_the_materials() {
    let hertz = "normal = { law = \"hertz\" }";
    let elastic = "[materials.grain]\nyoung_modulus = \"6e7 Pa\"\npoisson_ratio = 0.25";
    let text = checked("mixed", &[("[materials.grain]", elastic), (NORMAL, hertz)]);
    // Two equal bodies: E* = E/(2 (1 − ν²)) = 6e7/1.875 Pa.
    let line = "normal hertz: effective_modulus = 3.2e7 Pa (of the materials by ";
    assert!(text.contains(line), "no `{line}` in\n{text}");
}
