//! Runs that are stopped or killed, and go on to the same files.
#![cfg(unix)]

use crate::place::*;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Grains that fall, are pressed by a servo wall and shaken: memory, attraction, a switch of laws, stop rules, and some of
/// everything that a run writes.
pub const SHAKEN: &str = r#"title = "Pressed \"and\" shaken"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
seed = 3

[materials.grain]
density = "2000 kg/m^3"

[contacts.grain-grain]
normal = { law = "luding", k1 = "100 N/m", kp = "500 N/m", kc = "100 N/m", phi_f = 0.05 }
noncontact = { law = "jump-in", f_a = "1e-5 N", kc_a = "inf" }
viscosity = { law = "constant", gamma_0 = "2e-3 kg/s" }
sliding = { law = "spring-slider", kt = "20 N/m", mu = 0.5 }
rolling = { law = "spring-slider", kr = "10 N/m", mu_r = 0.1 }

[[particles]]
material = "grain"
radius = { distribution = "uniform", minimum = "0.8 mm", maximum = "1 mm" }
arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [3, 3, 4], spacing = "2.2 mm", jitter = 0.02 }
velocity = { standard_deviation = "0.2 m/s" }

[box]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["6.6 mm", "6.6 mm", "8.8 mm"]
material = "grain"

[[stages]]
name = "fall"
until = { time = "30 ms" }

[[stages]]
name = "press"
until = { kinetic_to_elastic = 1e-7, minimum_time = "5 ms", time = "30 ms" }
walls.z-high = { control = "servo", pressure = "20 Pa", from = "1 Pa", ramp = "10 ms", mass = "0.5 g", damping = "0.1 kg/s" }

[[stages]]
name = "shake"
walls.x-high = { control = "cosine", displacement = ["-0.3 mm", "0 mm", "0 mm"], period = "10 ms", cycles = 3.0 }
set = { "contacts.grain-grain.normal.kc" = "20 N/m" }
program_updates = 50
programs = { "contacts.grain-grain.sliding.mu" = [["0 ms", 0.5], ["20 ms", 0.2]], "background.drag" = [["5 ms", "0 kg/s"], ["25 ms", "1e-5 kg/s"]] }

[output]
timeseries = { interval = "0.2 ms" }
plots = false
vtk = { steps = 1000 }
checkpoints = { wall_clock = "5 ms", stage_ends = true }
dimensionless = { length = "2 mm", stiffness = "500 N/m", reference_stage = "press" }
"#;

/// All files of a run but the lock.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let files = names.filter(|name| ![".pulvis-lock", "status.json"].contains(&name.as_str()));
    files.map(|name| (name.clone(), fs::read(folder.join(name)).unwrap())).collect()
}

/// Every file that the one run has left, the other has left too, byte by byte.
pub fn assert_same_files(found: &Path, expected: &Path) {
    let (found, expected) = (files(found), files(expected));
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&found), names(&expected));
    for (name, bytes) in &found {
        assert!(*bytes == expected[name], "{name} has other bytes");
    }
}

/// A folder with [`SHAKEN`], and the run that nothing interrupts in `whole`; answers with its duration.
pub fn shaken(name: &str, changes: &[(&str, &str)]) -> (Place, Duration) {
    let place = Place::with(name, SHAKEN, changes);
    let began = Instant::now();
    let output = place.pulvis(&["run", "s.toml", "--output", "whole", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    (place, began.elapsed())
}

pub fn resume(place: &Place, folder: &str, further: &[&str]) -> Output {
    place.pulvis(&[&["run", "--resume", folder, "--quiet"], further].concat())
}

pub fn is_complete(output: &Output) -> bool {
    output.status.code() == Some(0)
}

/// What came of the killed runs of a test.
#[derive(Debug, Default)]
struct Tally {
    kills: usize,
    /// A file was being written, as what was left of it says.
    in_writing: usize,
    began_again: usize,
}

/// Kills runs at random moments of their lives, some of them again while they go on, until each has ended; all files
/// must be those of the run that was never killed.
fn kill_at_random(name: &str, runs: u32) {
    let (place, duration) = shaken(name, &[("plots = false\n", "")]);
    let mut tally = Tally::default();
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    let mut moment = || {
        random = random.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        duration.mul_f64((random >> 11) as f64 / (1_u64 << 53) as f64)
    };
    for run in 0..runs {
        let folder = format!("killed-{run}");
        let path = place.0.join(&folder);
        let threads = (1 + run % 2).to_string();
        let start = ["run", "s.toml", "--output", &folder, "--quiet"];
        let go_on = ["run", "--resume", &folder, "--quiet", "--threads", &threads];
        let mut arguments = &start[..];
        for _ in 0..2 {
            let mut child = Ended(place.command(arguments).stdout(Stdio::null()).spawn().unwrap());
            sleep(moment());
            child.0.kill().unwrap();
            child.0.wait().unwrap();
            tally.kills += 1;
            let part = |(name, _): (String, _)| name.ends_with(".part");
            let left = if path.exists() { files(&path) } else { BTreeMap::new() };
            tally.began_again += usize::from(!left.contains_key("checkpoint.pulvis"));
            if !left.contains_key("run.toml") || !left.contains_key("run.files") {
                // Killed before it was one: nothing to go on with, and the folder is free.
                let _ = fs::remove_dir_all(&path);
                continue;
            }
            tally.in_writing += usize::from(left.into_iter().any(part));
            arguments = &go_on[..];
        }
        let output = place.pulvis(arguments);
        let has_ended = error(&output).contains("has ended: there is nothing to resume");
        assert!(is_complete(&output) || has_ended, "run {run}: {}", error(&output));
        assert_same_files(&path, &place.0.join("whole"));
        fs::remove_dir_all(&path).unwrap();
    }
    eprintln!("{runs} runs, {tally:?}, all files the same");
}

#[test]
fn runs_that_are_killed_go_on_to_the_same_files() {
    kill_at_random("killed", 5);
}

#[test]
#[ignore = "minutes: `cargo xtask slow`"]
fn runs_that_are_killed_at_200_moments_go_on_to_the_same_files() {
    kill_at_random("killed_often", 100);
}

/// Sends a signal to a run when it has written some rows.
fn stopped(place: &Place, folder: &str, signal: &str) -> Output {
    let run = spawn(place.command(&["run", "s.toml", "--output", folder, "--quiet"]));
    wait_for_bytes(&place.0.join(folder).join("timeseries.csv"), 30_000);
    let kill = Command::new("kill").arg(signal).arg(run.id().to_string()).status().unwrap();
    assert!(kill.success());
    finish(run)
}

#[test]
fn a_run_that_is_asked_to_stop_can_go_on_with_other_threads_and_instructions() {
    let changes = [("wall_clock = \"5 ms\"", "wall_clock = \"1 h\"")];
    let (place, _) = shaken("stopped", &changes);
    for (signal, further) in [("-INT", ["--threads", "2"]), ("-TERM", ["--instructions", "sse2"])] {
        let folder = &signal[1..];
        let output = stopped(&place, folder, signal);
        assert_eq!(output.status.code(), Some(130), "{}", error(&output));
        let advice = format!("go on with `pulvis run --resume {folder}`\n");
        assert!(out(&output).ends_with(&advice), "{}", out(&output));
        let second = place.pulvis(&["run", "s.toml", "--output", folder]);
        assert_eq!(second.status.code(), Some(2), "{}", error(&second));
        let output = resume(&place, folder, &further);
        assert!(is_complete(&output), "{}", error(&output));
        assert!(out(&output).contains("\nit went on from step "), "{}", out(&output));
        assert_same_files(&place.0.join(folder), &place.0.join("whole"));
        let again = resume(&place, folder, &[]);
        let expected = format!(
            "error: the run in {folder} has ended: there is nothing to resume; to go on from its end, write a scenario with `start_from`\n"
        );
        assert_eq!((again.status.code(), error(&again)), (Some(2), expected));
    }
}

#[test]
fn a_run_without_a_checkpoint_begins_again() {
    let (place, _) = shaken("no_checkpoint", &[("wall_clock = \"5 ms\"", "wall_clock = \"1 h\"")]);
    let mut run = Ended(place.command(&["run", "s.toml", "--output", "out", "--quiet"]).spawn().unwrap());
    wait_for_rows(&place.0.join("out/timeseries.csv"));
    run.0.kill().unwrap();
    run.0.wait().unwrap();
    for file in ["checkpoint.stage-1.pulvis", "checkpoint.stage-2.pulvis"] {
        let _ = fs::remove_file(place.0.join("out").join(file));
    }
    let output = resume(&place, "out", &[]);
    assert!(is_complete(&output), "{}", error(&output));
    assert_eq!(error(&output), "warning: the run has no checkpoint: it begins again\n");
    assert_same_files(&place.0.join("out"), &place.0.join("whole"));
}

/// A copy of an interrupted run, to be damaged.
fn copy(place: &Place, from: &str, to: &str) {
    fs::create_dir(place.0.join(to)).unwrap();
    for (name, bytes) in files(&place.0.join(from)) {
        fs::write(place.0.join(to).join(name), bytes).unwrap();
    }
}

#[test]
fn checkpoints_that_cannot_be_used_are_refused_and_another_one_is_offered() {
    let (place, _) = shaken("damaged", &[]);
    let output = stopped(&place, "run", "-INT");
    assert_eq!(output.status.code(), Some(130), "{}", error(&output));
    let sound = fs::read(place.0.join("run/checkpoint.pulvis")).unwrap();
    let mut flipped = sound.clone();
    flipped[sound.len() / 2] ^= 1;
    let newer =
        String::from_utf8_lossy(&sound[..60]).replacen("checkpoint 6", "checkpoint 7", 1).into_bytes();
    let older =
        String::from_utf8_lossy(&sound[..60]).replacen("checkpoint 6", "checkpoint 1", 1).into_bytes();
    let cases: [(&str, &[u8], &str); 5] = [
        ("flipped", &flipped, "is damaged or cut off: its checksum is another one"),
        ("cut", &sound[..sound.len() - 100], "is damaged or cut off: its checksum is another one"),
        ("foreign", b"title = \"mine\"", "is no checkpoint of Pulvis"),
        (
            "newer",
            &newer,
            "has version 7 of the format, and this program reads version 6; take a newer Pulvis",
        ),
        (
            "older",
            &older,
            "has version 1 of the format, and this program reads version 6; take the Pulvis that its header names",
        ),
    ];
    for (name, bytes, reason) in cases {
        copy(&place, "run", name);
        fs::write(place.0.join(name).join("checkpoint.pulvis"), bytes).unwrap();
        let before = files(&place.0.join(name));
        let refused = resume(&place, name, &[]);
        let message = error(&refused);
        assert_eq!(refused.status.code(), Some(2), "{message}");
        assert!(
            message.starts_with(&format!("error: {name}/checkpoint.pulvis {reason}; {name}/checkpoint.")),
            "{message}"
        );
        assert!(message.ends_with(") is whole, name it instead\n"), "{message}");
        assert!(files(&place.0.join(name)) == before, "{name}: nothing has been touched");
        let info = place.pulvis(&["info", name]);
        assert_eq!(info.status.code(), Some(2));
        assert!(
            error(&info).contains(reason) && out(&info).contains("a whole checkpoint of"),
            "{}",
            out(&info)
        );
        let offered = message
            .split("; ")
            .nth(usize::from(["newer", "older"].contains(&name)) + 1)
            .unwrap()
            .split(' ')
            .next()
            .unwrap();
        let output = resume(&place, offered, &[]);
        assert!(is_complete(&output), "{}", error(&output));
        assert_same_files(&place.0.join(name), &place.0.join("whole"));
    }
}

#[test]
fn a_folder_that_does_not_fit_its_checkpoint_is_refused() {
    let (place, _) = shaken("misfit", &[]);
    stopped(&place, "run", "-INT");
    let refused = |name: &str, file: &str, change: fn(String) -> String, code: i32, message: &str| {
        copy(&place, "run", name);
        let text = change(place.read(&format!("{name}/{file}")));
        fs::write(place.0.join(name).join(file), text).unwrap();
        let refused = resume(&place, name, &[]);
        assert_eq!((refused.status.code(), error(&refused).as_str()), (Some(code), message));
    };
    refused(
        "scenario",
        "run.toml",
        |text| text.replacen("0.05", "0.06", 1),
        2,
        "error: scenario/checkpoint.pulvis does not belong to this run: its scenario is not the one in scenario/run.toml\n",
    );
    refused(
        "rows",
        "timeseries.csv",
        |text| text.replacen("\n0,", "\n1,", 1),
        1,
        "error: rows/timeseries.csv has changed since the checkpoint: its rows are other ones; resume from a copy of the run as it was, or run it again\n",
    );
    refused(
        "list",
        "run.files",
        |text| text.replace("timeseries.csv\n", ""),
        1,
        "error: list/run.files has changed since the checkpoint: it does not list the files of the checkpoint; resume from a copy of the run as it was, or run it again\n",
    );
    fs::create_dir(place.0.join("empty")).unwrap();
    for folder in ["empty", "none", "s.toml"] {
        let refused = resume(&place, folder, &[]);
        assert_eq!(refused.status.code(), Some(2));
        let expected = format!(
            "error: {folder} holds no run of Pulvis that could be resumed; name the output folder of a run, or a checkpoint in it\n"
        );
        assert_eq!(error(&refused), expected);
    }
    for arguments in [
        &["--resume", "run", "s.toml"][..],
        &["--resume", "run", "--force"],
        &["--resume", "run", "--set", "a=1"],
    ] {
        let refused = place.pulvis(&[&["run"], arguments].concat());
        assert_eq!(refused.status.code(), Some(2));
        assert!(error(&refused).contains("cannot be used with"), "{}", error(&refused));
    }
}

#[test]
fn a_run_that_goes_on_is_not_resumed() {
    let place = Place::with("busy", SHAKEN, &[("time = \"30 ms\" }\n\n", "time = \"10000 s\" }\n\n")]);
    let run = Ended(
        place.command(&["run", "s.toml", "--output", "out", "--quiet", "--allow", "disk"]).spawn().unwrap(),
    );
    wait_for_rows(&place.0.join("out/timeseries.csv"));
    let refused = resume(&place, "out", &[]);
    let message = error(&refused);
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(
        message.contains(&format!("a run is going on in the output folder out (process {})", run.0.id()))
    );
}

#[test]
fn an_alarm_leaves_a_checkpoint_of_a_sound_state() {
    let pressed = "until = { time = \"20 ms\" }\nwalls.z-high = { control = \"servo\", pressure = \"1e5 Pa\", mass = \"1 g\", damping = \"0 kg/s\" }";
    let place = Place::new(
        "alarm_checkpoint",
        &[
            ("until = { time = \"1 ms\" }", pressed),
            ("timeseries = { steps = 10 }", "timeseries = { steps = 10 }\ncheckpoints = { steps = 100 }"),
        ],
    );
    let output = place.pulvis(&["run", "s.toml", "--output", "out"]);
    let message = error(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    let (_, step) = message.split_once("its last checkpoint is of step ").unwrap();
    let (step, _) = step.split_once(';').unwrap();
    let info = out(&place.pulvis(&["info", "out/checkpoint.pulvis"]));
    assert!(info.contains(&format!("\nstep = {step}\n")), "{info}");
    let before = files(&place.0.join("out"));
    let again = resume(&place, "out", &[]);
    assert_eq!(again.status.code(), Some(1));
    assert!(
        error(&again).starts_with(message.split("\n  ").next().unwrap()),
        "the same alarm in the same step"
    );
    let after = files(&place.0.join("out"));
    for name in ["timeseries.csv", "series.pvd", "energies.png", "run.files"] {
        assert!(before[name] == after[name], "{name} has other bytes");
    }
}
