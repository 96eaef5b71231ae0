//! The folder of a run: what is refused, and what `--force` removes.

use crate::place::*;

use std::fs;

#[test]
fn folders_that_cannot_be_written_are_refused() {
    let place = Place::new("folders", &[]);
    fs::write(place.0.join("file"), "mine").unwrap();
    fs::create_dir(place.0.join("used")).unwrap();
    fs::write(place.0.join("used/notes.txt"), "mine").unwrap();
    let in_use = "error: output folder used is not empty; choose another one with `--output DIR`\n";
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
}

#[test]
fn force_removes_the_files_of_an_old_run_and_nothing_else() {
    let place = Place::new("force", &[]);
    let run = |arguments: &[&str]| place.pulvis(&[&["run", "s.toml", "--output", "out"], arguments].concat());
    assert_eq!(run(&[]).status.code(), Some(0));
    fs::rename(place.0.join("out/particles_0001.vtp"), place.0.join("out/particles_final.vtp")).unwrap();
    fs::write(place.0.join("out/notes.txt"), "mine").unwrap();
    let refused = run(&[]);
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(
        error(&refused),
        "error: output folder out is not empty; choose another one with `--output DIR`, go on with the run in it with `--resume out`, or write over that with `--force`\n"
    );
    let forced = run(&["--force", "--set", "stages[0].until.time=0.5 ms"]);
    assert_eq!(forced.status.code(), Some(0), "{}", error(&forced));
    assert_files_are_complete(&place, "out");
    assert_eq!(place.read("out/notes.txt"), "mine");
    assert!(place.0.join("out/particles_final.vtp").exists());
    // The record lists all files that are there but the user's own.
    let listed = place.read("out/run.files");
    for entry in fs::read_dir(place.0.join("out")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let own = ["notes.txt", "particles_final.vtp", ".pulvis-lock"].contains(&name.as_str());
        assert_eq!(listed.lines().any(|line| line == name), !own, "{name}");
    }
}

#[test]
fn force_touches_no_folder_that_holds_no_run() {
    let place = Place::new("force_no_run", &[]);
    fs::create_dir(place.0.join("pictures")).unwrap();
    fs::write(place.0.join("pictures/stress.png"), "mine").unwrap();
    fs::write(place.0.join("pictures/particles_0099.vtp"), "mine").unwrap();
    let refused = place.pulvis(&["run", "s.toml", "--output", "pictures", "--force"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        error(&refused).starts_with(
            "error: output folder pictures is not empty and holds no run of Pulvis with its list"
        ),
        "{}",
        error(&refused)
    );
    assert_eq!(place.read("pictures/stress.png") + &place.read("pictures/particles_0099.vtp"), "minemine");
    assert_eq!(fs::read_dir(place.0.join("pictures")).unwrap().count(), 2);
}

#[test]
#[cfg(unix)]
fn a_run_that_goes_on_is_not_written_over_and_one_that_was_killed_is() {
    let long = [("\"1 ms\"", "\"10000 s\""), ("steps = 10", "steps = 1000")];
    let place = Place::new("lock", &long);
    let first = place.command(&["run", "s.toml", "--output", "out", "--quiet"]).spawn().unwrap();
    let mut first = Ended(first);
    wait_for_rows(&place.0.join("out/timeseries.csv"));
    let arguments = ["run", "s.toml", "--output", "out", "--force", "--quiet"];
    let second = place.pulvis(&arguments);
    let expected = format!(
        "error: a run is going on in the output folder out (process {}); wait for its end or stop it, or choose another folder with `--output DIR`\n",
        first.0.id()
    );
    assert_eq!((second.status.code(), error(&second)), (Some(2), expected));
    // The first one has noticed nothing.
    let rows = fs::metadata(place.0.join("out/timeseries.csv")).unwrap().len();
    wait_for_bytes(&place.0.join("out/timeseries.csv"), rows + 2000);
    first.0.kill().unwrap();
    first.0.wait().unwrap();
    let short = [&arguments[..], &["--set", "stages[0].until.time=1 ms"]].concat();
    let third = place.pulvis(&short);
    assert_eq!(third.status.code(), Some(0), "{}", error(&third));
}
