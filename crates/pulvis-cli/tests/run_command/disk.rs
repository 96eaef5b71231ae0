//! Disks that are full or cannot be written to, and folders that vanish: an error, and a run that goes on.
#![cfg(unix)]

use crate::place::*;
use crate::resume::{SHAKEN, assert_same_files, is_complete, resume, shaken};

use std::fs;
use std::process::{Command, Output};

/// The command in a shell that lets no file grow beyond so many blocks of 512 bytes, as a full disk does.
fn in_small_room(place: &Place, blocks: u32, arguments: &str) -> Output {
    let script =
        format!("trap '' XFSZ; ulimit -f {blocks}; exec {} {arguments}", env!("CARGO_BIN_EXE_pulvis"));
    Command::new("sh").args(["-c", &script]).current_dir(&place.0).output().unwrap()
}

#[test]
fn without_room_a_run_ends_with_an_error_and_goes_on_when_there_is_room_again() {
    let (place, _) = shaken("small_room", &[]);
    let series = fs::metadata(place.0.join("whole/timeseries.csv")).unwrap().len();
    let blocks = u32::try_from(series / 512 / 2).unwrap();
    let output = in_small_room(&place, blocks, "run s.toml --output out --quiet");
    let message = error(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.starts_with("error: cannot write out/timeseries.csv: "), "{message}");
    let output = resume(&place, "out", &[]);
    assert!(is_complete(&output), "{}", error(&output));
    assert_same_files(&place.0.join("out"), &place.0.join("whole"));
}

#[test]
fn a_folder_that_vanishes_ends_a_run_with_an_error() {
    let place = Place::with("vanished", SHAKEN, &[("time = \"30 ms\" }\n\n", "time = \"10000 s\" }\n\n")]);
    let run = spawn(place.command(&["run", "s.toml", "--output", "out", "--quiet", "--allow", "disk"]));
    wait_for_rows(&place.0.join("out/timeseries.csv"));
    fs::rename(place.0.join("out"), place.0.join("elsewhere")).unwrap();
    let output = finish(run);
    assert_eq!(output.status.code(), Some(1), "{}", error(&output));
    assert!(error(&output).contains("\nerror: cannot write out/"), "{}", error(&output));
}

/// Runs a script of the shell in which `small` can be mounted as a file system in memory, seen by nobody else; `None`
/// where this machine does not let its users do so.
#[cfg(target_os = "linux")]
fn on_small_disk(place: &Place, script: &str) -> Option<Output> {
    fs::create_dir(place.0.join("small")).unwrap();
    let apart = |script: &str| {
        Command::new("unshare")
            .args(["--user", "--map-root-user", "--mount", "sh", "-c", script])
            .env("PULVIS", env!("CARGO_BIN_EXE_pulvis"))
            .current_dir(&place.0)
            .output()
    };
    let can = apart("mount -t tmpfs -o size=100k tmpfs small").is_ok_and(|output| output.status.success());
    can.then(|| apart(script).unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_and_one_that_cannot_be_written_to_are_told_and_a_run_goes_on_after_room_was_made() {
    let (place, _) = shaken("small_disk", &[("title = ", "allow = [\"disk\"]\ntitle = ")]);
    // The whole run takes 1.4 MB.
    let script = r#"
        mount -t tmpfs -o size=400k tmpfs small
        $PULVIS run s.toml --output small/out --quiet; echo "full: $?"
        $PULVIS info small/out/checkpoint.pulvis > /dev/null; echo "checkpoint: $?"
        mount -o remount,size=60m small
        mount -o remount,ro small
        $PULVIS run --resume small/out --quiet; echo "read-only: $?"
        $PULVIS run s.toml --output small/new --quiet; echo "new: $?"
        mount -o remount,rw small
        $PULVIS run --resume small/out --quiet > /dev/null; echo "room: $?"
        cp -r small/out kept
    "#;
    let Some(output) = on_small_disk(&place, script) else {
        eprintln!("skipped: this machine lets its users mount nothing");
        return;
    };
    let message = error(&output);
    assert_eq!(out(&output), "full: 1\ncheckpoint: 0\nread-only: 2\nnew: 2\nroom: 0\n", "{message}");
    let errors: Vec<&str> = message.lines().filter(|line| line.starts_with("error: ")).collect();
    let [full, resumed, new] = errors[..] else { panic!("{message}") };
    assert!(full.starts_with("error: cannot write small/out/") && full.contains("No space left"), "{full}");
    for (read_only, folder) in [(resumed, "small/out"), (new, "small/new")] {
        assert!(read_only.starts_with(&format!("error: output folder {folder}: Read-only")), "{read_only}");
    }
    assert_same_files(&place.0.join("kept"), &place.0.join("whole"));
}
