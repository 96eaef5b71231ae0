//! Runs that start from the state of another run.

use crate::place::*;

use std::fs;

/// [`TINY`] with friction, a wall that moves and drag: the first of three stages, which is kept.
fn first_stage() -> String {
    let (before, _) = TINY.split_once("[output]").unwrap();
    let changes = [
        (
            "phi_f = 0.05 }\n",
            "phi_f = 0.05 }\nsliding = { law = \"spring-slider\", kt = \"20 N/m\", mu = 0.5 }\n",
        ),
        ("until = { time = \"1 ms\" }\n", FIRST),
    ];
    changes.iter().fold(before.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    })
}

/// What the first stage does.
const FIRST: &str = r#"until = { time = "3 ms" }
walls.x-high = { control = "cosine", displacement = ["-0.2 mm", "0 mm", "0 mm"], period = "2 ms", cycles = 2.0 }
set = { "background.drag" = "1e-5 kg/s" }
"#;

/// The stages that follow.
const REST: &str = r#"[[stages]]
name = "press"
until = { time = "2 ms" }
walls.z-high = { control = "servo", pressure = "20 Pa", mass = "0.5 g", damping = "0.1 kg/s" }
set = { "contacts.grain-grain.normal.kc" = "20 N/m" }

[[stages]]
name = "rest"
until = { time = "1 ms" }

[output]
timeseries = { interval = "0.1 ms" }
vtk = { interval = "0.5 ms" }
checkpoints = { stage_ends = true }
"#;

fn run(place: &Place, file: &str, folder: &str) {
    let output = place.pulvis(&["run", file, "--output", folder, "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
}

/// The parent in `parent`.
fn parent(name: &str) -> Place {
    let place = Place::with(name, &format!("{}{REST}", first_stage()), &[]);
    run(&place, "s.toml", "parent");
    place
}

fn branch(place: &Place, start: &str, rest: &str) {
    fs::write(place.0.join("b.toml"), format!("start_from = {start}\n\n{rest}")).unwrap();
}

/// Rows of stages from `first` on, with other numbers of stages, and without the columns that look back to the start of the run.
fn rows(place: &Place, folder: &str, first: usize) -> Vec<String> {
    let text = place.read(&format!("{folder}/timeseries.csv"));
    let stage = |row: &str| row.split(',').nth(2).unwrap().parse::<usize>().unwrap();
    let without_stage = |row: &str| {
        let fields = row.split(',').enumerate().filter(|(column, _)| *column != 2).map(|(_, field)| field);
        fields.collect::<Vec<_>>().join(",")
    };
    text.lines().skip(1).filter(|row| stage(row) >= first).map(without_stage).collect()
}

/// The frames of a run from the last one back.
fn last_frames(place: &Place, folder: &str, kind: &str, count: usize) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(place.0.join(folder))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.starts_with(kind) && name.ends_with(".vtp"))
        .collect();
    names.sort();
    names.iter().rev().take(count).map(|name| place.read(&format!("{folder}/{name}"))).collect()
}

#[test]
fn a_branch_that_changes_nothing_has_the_bits_of_the_run_that_it_branches_from() {
    let place = parent("branch_same");
    branch(&place, "{ run = \"parent\", stage = \"mix\" }", REST);
    run(&place, "b.toml", "branch");
    let rows_of_branch = rows(&place, "branch", 1);
    assert!(rows_of_branch.len() > 30);
    assert_eq!(rows_of_branch, rows(&place, "parent", 2));
    for kind in ["particles_", "contacts_"] {
        assert!(last_frames(&place, "branch", kind, 6) == last_frames(&place, "parent", kind, 6), "{kind}");
    }
    // A branch of a branch, whose first stage is the parent's last one.
    let (_, rest) = REST.split_once("\n\n").unwrap();
    branch(&place, "{ run = \"branch\", stage = \"press\" }", rest);
    run(&place, "b.toml", "twig");
    assert_eq!(rows(&place, "twig", 1), rows(&place, "parent", 3));
    for kind in ["particles_", "contacts_"] {
        assert!(last_frames(&place, "twig", kind, 2) == last_frames(&place, "parent", kind, 2), "{kind}");
    }
    // What a branch has written out can be run again.
    run(&place, "twig/run.toml", "again");
    assert_eq!(place.read("again/timeseries.csv"), place.read("twig/timeseries.csv"));
}

#[test]
fn branches_change_laws_stages_and_outputs_from_the_command_line_too() {
    let place = parent("branch_changed");
    let other = REST.replace("20 N/m", "90 N/m").replace("vtk = { interval = \"0.5 ms\" }", "vtk = false");
    branch(&place, "\"parent/checkpoint.stage-1.pulvis\"", &other);
    run(&place, "b.toml", "branch");
    assert!(!place.0.join("branch/series.pvd").exists());
    let (found, expected) = (rows(&place, "branch", 1), rows(&place, "parent", 2));
    assert_eq!(found[0].split(',').next(), expected[0].split(',').next(), "they start in the same step");
    assert_ne!(found, expected);
    branch(&place, "{ run = \"parent\", stage = \"mix\" }", REST);
    let set = ["--set", "contacts.grain-grain.normal.kp=\"600 N/m\""];
    let output = place.pulvis(&[&["run", "b.toml", "--output", "set", "--quiet"], &set[..]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    assert!(place.read("set/run.toml").contains("kp = \"600.0 N/m\""));
    let check = place.pulvis(&["check", "b.toml"]);
    assert_eq!(check.status.code(), Some(0), "{}", error(&check));
    assert!(
        out(&check).starts_with("b.toml: untitled: valid\nparticles         27 with radii"),
        "{}",
        out(&check)
    );
}

#[test]
fn states_that_a_scenario_cannot_start_from_are_refused() {
    let place = parent("branch_refused");
    let refused = |start: &str, rest: &str, message: &str| {
        branch(&place, start, rest);
        for command in [&["check", "b.toml"][..], &["run", "b.toml", "--output", "out"]] {
            let output = place.pulvis(command);
            assert_eq!(output.status.code(), Some(2), "{}", error(&output));
            let found = error(&output).replace(&format!("{}/", place.0.display()), "");
            assert_eq!(found.lines().next(), Some(message), "{found}");
        }
        assert!(!place.0.join("out").exists());
    };
    refused(
        "{ run = \"parent\", stage = \"pres\" }",
        REST,
        "error: b.toml:1:14: start_from: there is no checkpoint of the end of the stage \"pres\" in parent; there are some of rest, press, mix",
    );
    refused("\"s.toml\"", REST, "error: b.toml:1:14: start_from: s.toml is no checkpoint of Pulvis");
    fs::create_dir(place.0.join("nothing")).unwrap();
    refused("\"nothing\"", REST, "error: b.toml:1:14: start_from: there is no checkpoint in nothing");
    refused(
        "true",
        REST,
        "error: b.toml:1:14: start_from: found true; expected the folder of a run, one of its checkpoint files, or { run = \"FOLDER\", stage = \"NAME\" }",
    );
    let set = "set = { \"contacts.grain-grain.normal.kc\" = \"20 N/m\" }\n";
    let powder = "[materials.powder]\ndensity = \"1 kg/m^3\"\n";
    let contacts = "[contacts.powder-powder.normal]\nlaw = \"linear\"\nk = \"1 N/m\"\n";
    let particles = "[[particles]]\nmaterial = \"powder\"\nradius = { distribution = \"fixed\", value = \"1 mm\" }\narrangement = { kind = \"list\", positions = [[\"3 mm\", \"3 mm\", \"3 mm\"]] }\n";
    let walls = "[box]\nlower = [\"0 mm\", \"0 mm\", \"0 mm\"]\nupper = [\"6.6 mm\", \"6.6 mm\", \"6.6 mm\"]\nmaterial = \"powder\"\n";
    refused(
        "\"parent\"",
        &format!("{powder}{contacts}{particles}{walls}{}", REST.replace(set, "")),
        "error: b.toml:3:2: materials: powder; expected those of the run: grain",
    );
    let larger = "[box]\nlower = [\"0 mm\", \"0 mm\", \"0 mm\"]\nupper = [\"6.6 mm\", \"6.6 mm\", \"9 mm\"]\nmaterial = \"grain\"\n";
    refused(
        "\"parent\"",
        &format!("{larger}{REST}"),
        "error: b.toml:3:1: box: the walls have other shapes, sizes or areas; expected those of the run",
    );
}
