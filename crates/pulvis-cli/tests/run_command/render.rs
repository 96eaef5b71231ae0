//! Pictures of runs: files, sizes, frames, refusals.

use crate::place::*;

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;

/// Width, height, number of frames and the pixels of the first one.
fn decoded(path: &Path) -> (u32, u32, u32, Vec<u8>) {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap();
    let frames = reader.info().animation_control().map_or(1, |control| control.num_frames);
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let (width, height) = (reader.info().width, reader.info().height);
    for _ in 1..frames {
        reader.next_frame(&mut vec![0; pixels.len()]).unwrap();
    }
    (width, height, frames, pixels)
}

/// A place in whose folder `out` 27 grains have flown about, with six frames.
fn flown(name: &str) -> Place {
    let every = "timeseries = { steps = 10 }\nvtk = { interval = \"0.2 ms\" }\nplots = false";
    let place = Place::new(name, &[("timeseries = { steps = 10 }", every)]);
    let output = place.pulvis(&["run", "s.toml", "--output", "out", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    place
}

impl Place {
    /// Draws; answers with what was printed.
    fn render(&self, arguments: &[&str]) -> String {
        let output = self.pulvis(&[&["render", "out", "--quiet", "--size", "160x120"], arguments].concat());
        assert_eq!((output.status.code(), error(&output).as_str()), (Some(0), ""), "{arguments:?}");
        out(&output)
    }

    fn picture(&self, arguments: &[&str]) -> Vec<u8> {
        self.render(&[&["--output", "picture.png", "--force"], arguments].concat());
        decoded(&self.0.join("picture.png")).3
    }
}

#[test]
fn the_last_frame_becomes_a_picture_of_the_asked_size_in_the_folder_of_the_run() {
    let place = flown("render_last");
    assert_eq!(place.render(&[]), "out/render_0005.png\n");
    let (width, height, frames, pixels) = decoded(&place.0.join("out/render_0005.png"));
    assert_eq!((width, height, frames), (160, 120, 1));
    assert!(pixels.iter().any(|&part| part < 128), "something is drawn");
    let again = place.pulvis(&["render", "out"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(error(&again).starts_with("error: out/render_0005.png exists; "), "{}", error(&again));
    // The run still knows its own files.
    let forced = place.pulvis(&["run", "s.toml", "--output", "out", "--quiet", "--force"]);
    assert_eq!(forced.status.code(), Some(0), "{}", error(&forced));
    assert!(place.0.join("out/render_0005.png").exists());
}

#[test]
fn every_option_changes_what_is_seen_and_threads_do_not() {
    let place = flown("render_options");
    let plain = place.picture(&["--threads", "1"]);
    assert!(place.picture(&["--threads", "2"]) == plain);
    assert!(place.picture(&["--view", "iso", "--frame", "5", "--color", "coordination"]) == plain);
    let front = place.picture(&["--view", "y"]);
    assert!(place.picture(&["--view", "-90,0"]) == front);
    let mut seen = vec![plain, front];
    for arguments in [
        &["--frame", "0"][..],
        &["--view", "x"],
        &["--view", "z"],
        &["--color", "speed"],
        &["--color", "depth"],
        &["--color", "stress"],
        &["--color", "material"],
        &["--color", "omega"],
        &["--clip", "x<50%"],
        &["--clip", "x>3.3 mm", "--clip", "y<50%"],
        &["--contacts"],
        &["--contacts", "--color", "speed"],
        &["--parallel"],
        &["--dark"],
    ] {
        let picture = place.picture(arguments);
        assert!(!seen.contains(&picture), "{arguments:?}");
        seen.push(picture);
    }
}

#[test]
fn all_frames_become_numbered_pictures_or_a_film() {
    let place = flown("render_all");
    assert_eq!(place.render(&["--frame", "all"]), "out/render_0000.png to out/render_0005.png\n");
    place.render(&["--frame", "all", "--output", "p.png"]);
    assert_eq!(place.render(&["--frame", "all", "--output", "film.apng"]), "film.apng\n");
    let first = decoded(&place.0.join("out/render_0000.png"));
    assert!(decoded(&place.0.join("p_0000.png")) == first);
    let film = decoded(&place.0.join("film.apng"));
    assert_eq!((film.0, film.1, film.2), (160, 120, 6));
    assert!(film.3 == first.3);
    let hidden = fs::read_dir(&place.0).unwrap();
    let hidden =
        hidden.filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|e| e == "part"));
    assert_eq!(hidden.count(), 0);
}

#[test]
fn a_checkpoint_is_drawn_as_the_last_frame_is() {
    let place = flown("render_checkpoint");
    let last = place.picture(&[]);
    let file = "out/checkpoint.pulvis";
    let output = place.pulvis(&["render", file, "--size", "160x120", "--quiet", "--output", "c.png"]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    assert!(decoded(&place.0.join("c.png")).3 == last);
    // Without frames, the message leads to the checkpoint.
    let place = Place::new("render_no_frames", &[("timeseries", "vtk = false\nplots = false\ntimeseries")]);
    assert_eq!(place.pulvis(&["run", "s.toml", "--output", "out"]).status.code(), Some(0));
    let refused = place.pulvis(&["render", "out"]);
    let message = error(&refused);
    assert_eq!(refused.status.code(), Some(2));
    let expected = "error: the run in out has no frames to draw; let the scenario write some: `vtk = true` in [output], \
                    or `vtk = { interval = \"1 ms\" }` for a sequence\n  help: its checkpoint can be drawn: `pulvis render \
                    out/checkpoint.pulvis`\n";
    assert_eq!(message, expected);
    let drawn = place.pulvis(&["render", file, "--output", "c.png"]);
    assert_eq!(drawn.status.code(), Some(0), "{}", error(&drawn));
}

#[test]
fn what_cannot_be_drawn_is_refused_with_exit_code_2_and_nothing_is_written() {
    let place = flown("render_refused");
    fs::create_dir(place.0.join("empty")).unwrap();
    for (arguments, words) in [
        (&["none"][..], "there is no none; expected the folder of a run, or a checkpoint"),
        (&["empty"], "no run is in empty; expected a folder with the file run.toml or series.pvd"),
        (&["s.toml"], "s.toml"),
        (&["out", "--frame", "6"], "frame 6 is not there; expected 0 to 5, `last` or `all`"),
        (&["out", "--frame", "first"], "expected the number of a frame from 0, `last` or `all`"),
        (&["out", "--color", "sped"], "did you mean `speed`"),
        (&["out", "--size", "10x10"], "each from 64 to 8192, for example 1600x1200"),
        (&["out", "--view", "w"], "expected x (from the right), y (from the front)"),
        (&["out", "--clip", "x<2"], "has no unit"),
        (&["out", "--output", "p.jpg"], "p.jpg: no picture format is called `jpg`; choose one of: png, apng"),
        (&["out", "--fps", "0"], "0 is not in 1..=1000"),
        (&["out/checkpoint.pulvis", "--output", "f.apng"], "a film needs frames"),
    ] {
        let output = place.pulvis(&[&["render"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", error(&output));
        assert!(error(&output).contains(words), "{arguments:?}: {}", error(&output));
        assert!(output.stdout.is_empty());
    }
    let pictures = fs::read_dir(place.0.join("out")).unwrap();
    let pictures =
        pictures.filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|e| e == "png"));
    assert_eq!(pictures.count(), 0);
    // A frame that is broken is told with its file.
    let file = place.0.join("out/particles_0005.vtp");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, &text[..text.len() / 2]).unwrap();
    let output = place.pulvis(&["render", "out"]);
    assert_eq!(output.status.code(), Some(2));
    let message = error(&output);
    assert!(message.contains("particles_0005.vtp is not a file that Pulvis wrote: "), "{message}");
}
