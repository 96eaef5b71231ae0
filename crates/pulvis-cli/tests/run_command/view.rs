//! `pulvis view` and `pulvis export` from outside: refusals, Ctrl-C, files.

use crate::place::*;

use std::fs;
use std::net::TcpListener;

#[test]
fn a_page_without_a_run_or_a_port_is_refused_with_what_to_do() {
    let place = Place::new("view_refusals", &[]);
    let refused = |arguments: &[&str]| {
        let output = place.pulvis(&[&["view", "--no-open"], arguments].concat());
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""), "{arguments:?}");
        error(&output)
    };
    let nowhere = refused(&["nowhere"]);
    assert_eq!(nowhere, "error: there is no nowhere; expected the folder of a run\n");
    assert!(refused(&["."]).starts_with("error: no run is in .; expected a folder with the file run.toml"));
    assert!(refused(&["s.toml"]).starts_with("error: s.toml is a file; expected the folder of a run"));
    let taken = TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let message = refused(&["--port", &port]);
    assert!(message.contains(&format!("port {port} of 127.0.0.1 is taken; choose another one")), "{message}");
}

#[test]
fn a_run_becomes_one_file_that_is_never_written_over_without_force() {
    let place = Place::new("view_export", &[("timeseries = { steps = 10 }", "vtk = true\nplots = false")]);
    let output = place.pulvis(&["run", "s.toml", "--output", "out", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", error(&output));
    let export = |more: &[&str]| place.pulvis(&[&["export", "out", "--html", "run.html"], more].concat());
    let first = export(&[]);
    assert_eq!(first.status.code(), Some(0), "{}", error(&first));
    assert!(out(&first).starts_with("run.html: "), "{}", out(&first));
    let text = fs::read_to_string(place.0.join("run.html")).unwrap();
    assert!(text.contains("id=\"embedded\"") && text.contains("importmap"));
    let again = export(&[]);
    assert_eq!(again.status.code(), Some(2));
    assert!(error(&again).starts_with("error: run.html exists; "), "{}", error(&again));
    assert_eq!(export(&["--force"]).status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_the_page_in_good_order() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};

    let mut command = Command::new(env!("CARGO_BIN_EXE_pulvis"));
    let mut view = command.args(["view", "--no-open"]).stdout(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(view.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with("http://127.0.0.1:"), "{line}");
    let told = Command::new("kill").args(["-INT", &view.id().to_string()]).status().unwrap();
    assert!(told.success());
    assert_eq!(view.wait().unwrap().code(), Some(0));
}
