//! `pulvis probe` from outside: outputs, files and exit codes.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

const PROBE: &str = "[probe]\nbodies = \"wall\"\nradius = \"1 mm\"\ndensity = \"2000 kg/m^3\"\n\
overlap = [\"-1 um\", \"20 um\", \"-1 um\"]\npoints = 50\n\
[contact.normal]\nlaw = \"luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"100 N/m\"\nphi_f = 0.05\n";

fn pulvis(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pulvis")).args(arguments).output().unwrap()
}

fn out(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// A folder of this test with the scenarios `one.toml` and `two.toml`, the second with laws to compare.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("one.toml"), PROBE).unwrap();
    let compared = "[[compare]]\nnormal = { law = \"linear\", k = \"100 N/m\" }\n";
    fs::write(folder.join("two.toml"), format!("{PROBE}{compared}")).unwrap();
    folder
}

#[test]
fn csv_has_the_promised_columns_and_every_instant() {
    let folder = folder("probe-csv");
    let one = folder.join("one.toml");
    let csv = out(&pulvis(&["probe", one.to_str().unwrap(), "--format", "csv"]));
    let promised = "time,overlap,force,contact_radius,stored_energy,dissipated,branch,shear,shear_force,roll_torque,twist_torque";
    assert!(csv.starts_with(promised), "{}", csv.lines().next().unwrap());
    assert_eq!(csv.lines().count(), 1 + 1 + 2 * 50);
    let text = out(&pulvis(&["probe", one.to_str().unwrap()]));
    assert!(text.lines().count() < 20 && text.contains("k2"), "{text}");
    let json = out(&pulvis(&["probe", one.to_str().unwrap(), "--format", "json"]));
    assert!(json.contains("\"contact_radius\""));
}

#[test]
fn several_files_and_laws_share_a_picture_and_a_table() {
    let folder = folder("probe-picture");
    let (one, two, picture) = (folder.join("one.toml"), folder.join("two.toml"), folder.join("f.svg"));
    let arguments = [
        "probe",
        one.to_str().unwrap(),
        two.to_str().unwrap(),
        "--format",
        "csv",
        "--plot",
        picture.to_str().unwrap(),
    ];
    let csv = out(&pulvis(&arguments));
    for label in ["one", "two: luding", "two: linear"] {
        assert_eq!(csv.lines().filter(|line| line.ends_with(&format!(",{label}"))).count(), 101, "{label}");
        assert!(fs::read_to_string(&picture).unwrap().contains(label), "{label}");
    }
    let again = pulvis(&arguments);
    assert_eq!(again.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&again.stderr).contains("f.svg exists"));
}

#[test]
fn bad_input_ends_with_exit_code_2_and_says_where() {
    let folder = folder("probe-bad");
    let one = folder.join("one.toml");
    let one = one.to_str().unwrap();
    for (arguments, words) in [
        (vec!["probe"], "<FILES>"),
        (vec!["probe", "no_such_file.toml"], "there is no such file"),
        (vec!["probe", one, "--set", "probe.overlap[0]=1 um"], "probe.overlap[0]"),
        (vec!["probe", one, "--plot", "f.pdf"], "choose one of: png, svg"),
    ] {
        let output = pulvis(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(error.contains(words), "{arguments:?}: {error}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}
