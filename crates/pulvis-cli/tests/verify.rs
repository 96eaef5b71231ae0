//! `pulvis verify` from outside: tables and exit codes.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::process::{Command, Output};

fn pulvis(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pulvis")).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn a_law_is_verified_in_every_format() {
    let shown = pulvis(&["verify", "hertz"]);
    assert_eq!(shown.status.code(), Some(0), "{}", text(&shown.stdout));
    let shown = text(&shown.stdout);
    assert!(shown.contains("fmax") && shown.ends_with("0 of 9 checks missed\n"), "{shown}");
    let csv = text(&pulvis(&["verify", "hertz", "--format", "csv"]).stdout);
    assert!(
        csv.starts_with("law,quantity,expected,found,error,tolerance,result,reason,source,case\n"),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), 10);
    let json = text(&pulvis(&["verify", "hertz", "dmt", "--format", "json"]).stdout);
    assert!(json.contains("\"dmt\"") && json.contains("\"hertz\""), "{json}");
}

#[test]
fn an_unknown_law_is_bad_input_with_its_neighbour() {
    let output = pulvis(&["verify", "hertz", "walton-jonson"]);
    assert_eq!(output.status.code(), Some(2));
    let message = text(&output.stderr);
    assert!(message.contains("did you mean `walton-johnson`?"), "{message}");
    assert!(output.stdout.is_empty());
}

#[test]
fn a_miss_is_named_and_ends_with_exit_code_1() {
    let output = pulvis(&["verify", "hertz", "--tolerance-factor", "1e-12"]);
    assert_eq!(output.status.code(), Some(1));
    let shown = text(&output.stdout);
    assert!(shown.contains("MISS hertz: ") && !shown.ends_with(" 0 of 9 checks missed\n"), "{shown}");
    assert_eq!(pulvis(&["verify", "--tolerance-factor", "-1"]).status.code(), Some(2));
}
