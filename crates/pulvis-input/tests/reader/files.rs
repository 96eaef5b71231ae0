//! Every file in `tests/reader/bad` ends with the messages that it must cause.
//!
//! A line `#^ 3:10: contact.normal.kp: ...` is the first line of one message without `error: <file>:`;
//! several mistakes are several such lines, in the order of the file. Changing a message shows up in review.

use crate::schema;
use std::fs;
use std::path::{Path, PathBuf};

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reader").join(folder);
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_bad_file_is_refused_with_exactly_its_messages() {
    let mut wrong = String::new();
    let paths = files("bad");
    assert!(paths.len() > 15, "the folder of bad files was not found");
    for path in paths {
        let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
        let expected: Vec<&str> =
            text.lines().filter_map(|line| line.strip_prefix("#^")).map(str::trim).collect();
        let got: Vec<String> = match schema::load(&path) {
            Ok(case) => vec![format!("accepted: {case:?}")],
            Err(errors) => errors.errors().iter().map(|error| error.headline()).collect(),
        };
        if expected != got {
            let expected = expected.join("\n  ");
            let got = got.join("\n  ");
            wrong.push_str(&format!("\n{}\n expected\n  {expected}\n got\n  {got}\n", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn every_good_file_is_read() {
    for path in files("good") {
        if let Err(errors) = schema::load(&path) {
            panic!("{errors}");
        }
    }
}
