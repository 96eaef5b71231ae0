//! Runs: exit codes, messages, Ctrl-C.

use crate::place::*;

use std::fs;
use std::process::{Command, Stdio};

#[test]
fn a_run_ends_with_exit_code_0_and_says_where_its_files_are() {
    let place = Place::new("whole", &[]);
    let output = place.pulvis(&["run", "s.toml", "--output", "out"]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    let text = out(&output);
    assert!(text.starts_with("done: 174 steps of 27 particles in "), "{text}");
    assert!(text.contains("energy ledger: relative closing error "), "{text}");
    assert!(text.contains("written to out:\n  run.toml, timeseries.csv, series.pvd (ParaView)"), "{text}");
    // Without a terminal: a line for each stage.
    let progress = error(&output);
    assert!(progress.starts_with("[1/1] mix: t = 1.0007e-3 s, time over after step 174"), "{progress}");
    assert_eq!(progress.lines().count(), 1);
    assert_files_are_complete(&place, "out");
}

#[test]
fn the_folder_is_that_of_the_scenario_and_quiet_runs_say_nothing_on_their_way() {
    let place = Place::new("quiet", &[("[output]", "[output]\nfolder = \"mixed\"")]);
    let output = place.pulvis(&["run", "s.toml", "--quiet", "--threads", "2"]);
    assert_eq!((output.status.code(), error(&output).as_str()), (Some(0), ""));
    assert_files_are_complete(&place, "mixed");
}

#[test]
fn pictures_have_the_asked_resolution_and_plots_are_drawings_too() {
    let place = Place::new("resolution", &[]);
    let arguments = ["run", "s.toml", "--output", "out", "--quiet", "--dpi", "72", "--svg"];
    let output = place.pulvis(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    assert!(out(&output).contains("energies.png, energies.svg, stress.png, stress.svg, particles.png"));
    assert!(place.read("out/energies.svg").starts_with("<svg"));
    let file = fs::File::open(place.0.join("out/particles.png")).unwrap();
    let reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
    let (info, per_metre) = (reader.info(), (72.0_f64 / 0.0254).round() as u32);
    assert_eq!((info.width, info.height), (600, 450));
    assert_eq!(info.pixel_dims.unwrap().xppu, per_metre);
    // All of them are files of the run, and go with it.
    let again = place.pulvis(&["run", "s.toml", "--output", "out", "--quiet", "--force"]);
    assert_eq!(again.status.code(), Some(0), "{}", error(&again));
    assert!(!place.0.join("out/energies.svg").exists() && place.0.join("out/energies.png").exists());
    let refused = place.pulvis(&["run", "s.toml", "--output", "other", "--dpi", "10"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(error(&refused).contains("10 is not in 36..=600"), "{}", error(&refused));
}

#[test]
fn a_run_that_cannot_be_right_ends_with_exit_code_1_and_never_says_done() {
    let pressed = "until = { time = \"20 ms\" }\nwalls.z-high = { control = \"servo\", pressure = \"1e5 Pa\", mass = \"1 g\", damping = \"0 kg/s\" }";
    let place = Place::new("alarm", &[("until = { time = \"1 ms\" }", pressed)]);
    let output = place.pulvis(&["run", "s.toml", "--output", "out"]);
    let message = error(&output);
    assert_eq!((output.status.code(), out(&output).as_str()), (Some(1), ""), "{message}");
    assert!(message.starts_with("error: stage `mix`, step "), "{message}");
    assert!(message.contains("more than 1;") && message.contains("the contact is too soft"), "{message}");
    assert!(message.contains("the files in out are complete up to there"), "{message}");
    assert!(!message.contains("done") && !message.contains("time over"), "{message}");
    assert_files_are_complete(&place, "out");
}

/// What is wrong with a scenario, and the whole message.
fn refused(name: &str, changes: &[(&str, &str)], message: &str) {
    let place = Place::new(name, changes);
    for arguments in [&["check", "s.toml"][..], &["run", "s.toml", "--output", "out"]] {
        let output = place.pulvis(arguments);
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""), "{arguments:?}");
        assert_eq!(error(&output).lines().next(), Some(message), "{}", error(&output));
    }
    assert!(!place.0.join("out").exists(), "a run that cannot start writes nothing");
}

#[test]
fn a_time_step_that_is_too_long_is_refused() {
    refused(
        "step",
        &[("[[stages]]", "[time]\nstep = \"1 ms\"\n\n[[stages]]")],
        "error: s.toml:19:8: time.step: 1e-3 s is longer than 1/10 of the shortest contact (2.8755e-4 s, grain-grain); expected at most 2.8755e-5 s",
    );
}

#[test]
fn speeds_that_step_over_contacts_are_refused() {
    refused(
        "fast",
        &[(
            "until = { time = \"1 ms\" }",
            "until = { time = \"1 us\" }\nwalls.z-high = { control = \"velocity\", velocity = [\"0 m/s\", \"0 m/s\", \"-100 m/s\"] }",
        )],
        "error: s.toml:21:51: stages[0].walls.z-high.velocity: the wall z-high moves at 1.0000e2 m/s, 0.575 radii of the smallest particle (1.0000e-3 m) in a time step of 5.7509e-6 s; expected at most 0.25 radii in a step, 4.3471e1 m/s",
    );
}

#[test]
fn a_piston_that_is_driven_through_the_floor_is_refused() {
    refused(
        "piston",
        &[(
            "until = { time = \"1 ms\" }",
            "until = { time = \"10 ms\" }\nwalls.z-high = { control = \"velocity\", velocity = [\"0 m/s\", \"0 m/s\", \"-1 m/s\"] }",
        )],
        "error: s.toml:21:51: stages[0].walls.z-high.velocity: the walls z-low and z-high meet within 6.6016e-3 s of the stage, which lasts 1.0000e-2 s; expected space between walls that face each other",
    );
}

#[test]
fn a_contact_that_is_over_in_no_time_is_told_once_and_with_advice() {
    let changes = [
        (r#"value = "1 mm""#, r#"value = "1e-57 mm""#),
        (r#"k1 = "100 N/m", kp = "500 N/m""#, r#"k1 = "1e300 N/m", kp = "5e300 N/m""#),
    ];
    let message = "error: s.toml:9:10: particles[0].radius: the shortest contact has the time step 0 s; expected a time step greater than zero";
    refused("no_time", &changes, message);
    let output = Place::new("no_time", &changes).pulvis(&["check", "s.toml"]);
    let help = "\n  help: are radii, densities and stiffnesses given in the units that were meant?\n";
    assert!(error(&output).ends_with(help), "{}", error(&output));
}

#[test]
fn a_particle_behind_a_wall_is_refused() {
    let grains = r#"arrangement = { kind = "list", positions = [["3 mm", "3 mm", "3 mm"], ["5 mm", "5 mm", "-0.1 mm"]] }"#;
    refused(
        "behind",
        &[(LATTICE, grains)],
        "error: s.toml:10:15: particles[0].arrangement: particle 1, (0.005, 0.005, -0.0001) m, lies 0.0001 m behind the wall z-low; expected particles on the side to which the wall's normal points",
    );
}

#[test]
fn particles_that_overlap_deeply_at_the_start_are_refused() {
    refused(
        "overlap",
        &[("spacing = \"2.2 mm\"", "spacing = \"1.7 mm\"")],
        "error: s.toml:10:15: particles[0].arrangement: particle 0 overlaps particle 1 by 30 % of the smaller radius at the start; expected at most 10 %",
    );
}

#[test]
fn random_particles_without_room_are_refused() {
    let grains = r#"count = 30
arrangement = { kind = "random", lower = ["0 mm", "0 mm", "0 mm"], upper = ["6 mm", "6 mm", "6 mm"] }"#;
    refused(
        "no_room",
        &[(LATTICE, grains)],
        "error: s.toml:11:15: particles[0].arrangement: no room for sphere 15 of 30 (radius 0.001 m) after 20000 random trials; the solid fraction would be 0.582; expected room for all particles",
    );
}

#[test]
fn values_are_set_from_the_command_line_once_each() {
    let place = Place::new("set", &[]);
    let set = ["--set", "stages[0].until.time=0.5 ms", "--set", "contacts.grain-grain.normal.kc=\"50 N/m\""];
    let run = place.pulvis(&[&["run", "s.toml", "--output", "out"], &set[..]].concat());
    assert!(out(&run).starts_with("done: 87 steps of 27 particles in "), "{}", out(&run));
    let record = place.read("out/run.toml");
    assert!(record.contains("kc = \"50.0 N/m\"") && record.contains("set from outside the file"), "{record}");
    let check = place.pulvis(&[&["check", "s.toml"], &set[..]].concat());
    assert!(out(&check).contains(", 87 steps"), "{}", out(&check));
    for command in ["run", "check"] {
        let unknown = place.pulvis(&[command, "s.toml", "--set", "stages[0].until.tim=3 s"]);
        assert!(error(&unknown).contains("did you mean `time`?"), "{}", error(&unknown));
        let late = place.pulvis(&[command, "s.toml", "--set", "particles[0].arrangement.spacing=1.7 mm"]);
        assert!(error(&late).contains("overlaps particle 1 by 30 %"), "{}", error(&late));
    }
    let twice =
        ["check", "s.toml", "--set", "stages[0].until.time=1 s", "--set", "stages[0].\"until\".time=2 s"];
    let refused = place.pulvis(&twice);
    assert_eq!(
        error(&refused).lines().next(),
        Some(
            "error: s.toml:20:18: stages[0].until.time: the key is set twice from outside the file; expected each key once"
        )
    );
}

#[test]
fn missing_files_and_wrong_flags_end_with_exit_code_2() {
    let place = Place::new("flags", &[]);
    for (arguments, message) in [
        (&["run", "none.toml"][..], "error: none.toml: there is no such file"),
        (&["check", "none.toml"], "error: none.toml: there is no such file"),
        (&["run", "s.toml", "--frobnicate"], "error: unexpected argument '--frobnicate' found"),
        (
            &["run", "s.toml", "--threads", "0"],
            "error: invalid value '0' for '--threads <N>': 0 is not in 1..=1024",
        ),
        (
            &["run", "s.toml", "--output"],
            "error: a value is required for '--output <DIR>' but none was supplied",
        ),
        (&["check", "s.toml", "--force"], "error: unexpected argument '--force' found"),
        (&["check"], "error: the following required arguments were not provided:"),
        (&["run"], "error: the following required arguments were not provided:"),
    ] {
        let output = place.pulvis(arguments);
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""), "{arguments:?}");
        assert_eq!(error(&output).lines().next(), Some(message), "{arguments:?}");
    }
    assert_eq!(fs::read_dir(&place.0).unwrap().count(), 1, "nothing was written");
}

#[test]
#[cfg(unix)]
fn ctrl_c_ends_a_run_cleanly_with_all_files_complete() {
    // A run of hours, were it not stopped.
    let long = [("\"1 ms\"", "\"10000 s\""), ("steps = 10", "steps = 1000")];
    let place = Place::new("ctrl_c", &long);
    let mut command = place.command(&["run", "s.toml", "--output", "out"]);
    let run = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    wait_for_rows(&place.0.join("out/timeseries.csv"));
    let kill = Command::new("kill").arg("-INT").arg(run.id().to_string()).status().unwrap();
    assert!(kill.success());
    let output = finish(run);
    assert_eq!(output.status.code(), Some(130), "{}", error(&output));
    assert!(out(&output).starts_with("interrupted; files are complete up to the last step: "));
    assert!(error(&output).contains(", interrupted after step "), "{}", error(&output));
    assert_files_are_complete(&place, "out");
}
