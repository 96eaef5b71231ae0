//! `pulvis run` and `pulvis check` from outside: files, messages, exit codes, Ctrl-C.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stderr)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// 27 grains in a box that fly for less than a second of wall-clock time.
const TINY: &str = r#"[materials.grain]
density = "2000 kg/m^3"

[contacts.grain-grain]
normal = { law = "luding", k1 = "100 N/m", kp = "500 N/m", kc = "100 N/m", phi_f = 0.05 }

[[particles]]
material = "grain"
radius = { distribution = "fixed", value = "1 mm" }
arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [3, 3, 3], spacing = "2.2 mm" }
velocity = { standard_deviation = "1 m/s" }

[box]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["6.6 mm", "6.6 mm", "6.6 mm"]
material = "grain"

[[stages]]
name = "mix"
until = { time = "1 ms" }

[output]
timeseries = { steps = 10 }
"#;

/// The line of [`TINY`] that places its grains.
const LATTICE: &str = r#"arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [3, 3, 3], spacing = "2.2 mm" }"#;

/// A folder of one test with the scenario `s.toml` in it; commands run there.
struct Place(PathBuf);

impl Place {
    /// [`TINY`] with some texts replaced; each of them must be there.
    fn new(name: &str, changes: &[(&str, &str)]) -> Self {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("run_command").join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let text = changes.iter().fold(TINY.to_owned(), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replace(old, new)
        });
        fs::write(folder.join("s.toml"), text).unwrap();
        Self(folder)
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pulvis"));
        command.args(arguments).current_dir(&self.0);
        command
    }

    fn pulvis(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.0.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
    }
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn error(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// All lines whole, all files of the index there, the record a scenario: what a finished run leaves.
fn assert_files_are_complete(place: &Place, folder: &str) {
    let series = place.read(&format!("{folder}/timeseries.csv"));
    assert!(series.ends_with('\n'));
    let columns = series.lines().next().unwrap().split(',').count();
    assert!(series.lines().count() > 1 && columns > 20);
    assert!(series.lines().all(|line| line.split(',').count() == columns));
    let index = place.read(&format!("{folder}/series.pvd"));
    assert!(index.starts_with("<?xml") && index.trim_end().ends_with("</VTKFile>"), "{index}");
    let frames: Vec<&str> =
        index.split("file=\"").skip(1).filter_map(|rest| Some(rest.split_once('"')?.0)).collect();
    assert!(frames.len() >= 2, "{index}");
    for frame in frames {
        let blocks = place.read(&format!("{folder}/{frame}"));
        for block in blocks.split("file=\"").skip(1) {
            let file = place.0.join(folder).join(block.split_once('"').unwrap().0);
            // The data are binary; the end of the file is text.
            let bytes = fs::read(&file).unwrap();
            assert!(bytes.trim_ascii_end().ends_with(b"</VTKFile>"), "{}", file.display());
        }
    }
    for picture in ["energies.png", "stress.png", "particles.png"] {
        let bytes = fs::read(place.0.join(folder).join(picture)).unwrap();
        assert!(bytes.starts_with(b"\x89PNG") && bytes.ends_with(b"IEND\xaeB`\x82"), "{picture}");
    }
    let again = place.pulvis(&["check", &format!("{folder}/run.toml")]);
    assert_eq!(again.status.code(), Some(0), "{}", error(&again));
}

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
        "fully plastic above v_p = 3.0538e-1 m/s",
        "sticks from 1.5269e-1 to 3.5262e-1 m/s",
        "mix: time step 5.7509e-6 s, 174 steps, shortest contact 2.8755e-4 s (grain-grain)",
        "memory            ",
        " candidate contacts at the start, ",
        " with the contacts of a dense packing, 12 neighbours each: ",
        " bytes a particle\n",
        "steps/s on this machine",
        "output            s-run",
    ] {
        assert!(text.contains(line), "no `{line}` in\n{text}");
    }
    assert_eq!(fs::read_dir(&place.0).unwrap().count(), 1);
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
        "error: s.toml:10:15: particles[0].arrangement: particle 0 overlaps particle 1 by 30 % of its radius at the start; expected at most 10 %",
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
fn folders_that_cannot_be_written_are_refused() {
    let place = Place::new("folders", &[]);
    fs::write(place.0.join("file"), "mine").unwrap();
    fs::create_dir(place.0.join("used")).unwrap();
    fs::write(place.0.join("used/notes.txt"), "mine").unwrap();
    let in_use = "error: output folder used is not empty; choose another one with `--output DIR`, or write over the run in it with `--force`\n";
    for (folder, message) in [
        ("used", in_use),
        (
            "file",
            "error: output folder file: Not a directory (os error 20); choose another one with `--output DIR`\n",
        ),
        (
            "file/below",
            "error: output folder file/below: Not a directory (os error 20); choose another one with `--output DIR`\n",
        ),
    ] {
        let output = place.pulvis(&["run", "s.toml", "--output", folder]);
        // The text of the system's own error differs between systems.
        let found = error(&output);
        if cfg!(target_os = "linux") || folder == "used" {
            assert_eq!(found, message);
        } else {
            assert!(found.starts_with(&format!("error: output folder {folder}: ")), "{found}");
        }
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""));
    }
    assert_eq!(place.read("file") + &place.read("used/notes.txt"), "minemine");
    // With --force a run is written beside what is no run.
    let forced = place.pulvis(&["run", "s.toml", "--output", "used", "--force"]);
    assert_eq!(forced.status.code(), Some(0), "{}", error(&forced));
    assert_files_are_complete(&place, "used");
    assert_eq!(place.read("used/notes.txt"), "mine");
    // And again over the run itself.
    assert_eq!(
        place.pulvis(&["run", "s.toml", "--output", "used"]).status.code(),
        Some(2),
        "a run is not written over without --force"
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
        (&["check", "s.toml", "more"], "error: unexpected argument 'more' found"),
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

/// Waits until the run has written some of its time series.
fn wait_for_rows(series: &Path) {
    let began = Instant::now();
    while fs::metadata(series).map_or(0, |data| data.len()) < 2000 {
        assert!(began.elapsed() < Duration::from_secs(60), "no row after a minute");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Waits for the end of a run that has been told to stop; ends it by force after a minute.
fn finish(mut run: Child) -> Output {
    let began = Instant::now();
    while run.try_wait().unwrap().is_none() {
        if began.elapsed() > Duration::from_secs(60) {
            run.kill().unwrap();
            panic!("the run goes on after Ctrl-C");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    run.wait_with_output().unwrap()
}
