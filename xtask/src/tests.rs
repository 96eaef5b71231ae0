//! `cargo xtask test`: the tests of the workspace, and readers of its files that are not its own.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;
use crate::process::{cargo, pulvis, root, run, scratch, target, works};
use crate::python;

/// All tests.
pub fn run_all() -> Outcome {
    if works(&mut cargo(&["nextest", "--version"])) {
        run(&mut cargo(&["nextest", "run", "--workspace", "--no-fail-fast"]))?;
        run(&mut cargo(&["test", "--workspace", "--doc", "--quiet"]))?;
    } else {
        println!("skipped: cargo-nextest is not installed; `cargo test` runs the same tests");
        run(&mut cargo(&["test", "--workspace"]))?;
    }
    sample_files()?;
    python::run_with_tests()
}

/// Installs what tests need beside cargo, where it can be had.
pub fn prepare() {
    let _ = (python_with_vtk(), python::environment());
}

/// What takes too long for every change, in the release build.
pub fn run_slow() -> Outcome {
    let beds = ["test", "--release", "-p", "pulvis-core", "--test", "beds", "--", "--ignored", "--nocapture"];
    run(&mut cargo(&beds))?;
    let killed =
        ["test", "--release", "-p", "pulvis-cli", "--test", "run_command", "--", "--ignored", "--nocapture"];
    run(&mut cargo(&killed))?;
    let mut fuzz = cargo(&["test", "--release", "-p", "pulvis-lab", "--test", "fuzz", "--", "--nocapture"]);
    run(fuzz.env("PULVIS_FUZZ_CASES", "100000"))?;
    let mut paths = cargo(&[
        "test",
        "--release",
        "-p",
        "pulvis-contact",
        "--test",
        "law_conformance",
        "--test",
        "law_friction",
    ]);
    run(paths.env("PULVIS_TESTKIT_CASES", "100"))
}

/// A driven bed for so many minutes, in the release build.
pub fn soak(minutes: &str) -> Outcome {
    if !minutes.parse().is_ok_and(|minutes: f64| minutes > 0.0) {
        return Err(format!("`{minutes}` is no number of minutes"));
    }
    let arguments =
        ["test", "--release", "-p", "pulvis-core", "--test", "soak", "--", "--ignored", "--nocapture"];
    run(cargo(&arguments).env("PULVIS_SOAK_MINUTES", minutes))
}

/// Writes the bits anew that the runs of `crates/pulvis-cli/tests/golden_bits` give now.
pub fn renew_golden_bits() -> Outcome {
    let mut command = cargo(&["test", "--quiet", "-p", "pulvis-cli", "--test", "golden_bits"]);
    run(command.env("PULVIS_RENEW_GOLDEN_BITS", "1"))?;
    println!("look at what `git diff crates/pulvis-cli/tests/golden_bits` shows before you commit it");
    Ok(())
}

/// The files that a run leaves, read by the VTK library itself.
fn sample_files() -> Outcome {
    let folder = scratch("sample_run")?;
    let path = folder.to_string_lossy();
    run(&mut cargo(&["run", "--quiet", "-p", "pulvis-io", "--example", "sample_run", "--", &path]))?;
    read_by_vtk(&folder, &["--sample"])?;
    read_by_vtk(&folder.join("compressed"), &["--sample", "--without-ovito"])?;
    let Some(python) = python_with_vtk() else { return Ok(()) };
    run(Command::new(&python).arg(root().join("scripts/check_formats.py")).arg(folder.join("formats")))?;
    schemas(&python)
}

/// The schemas for editors, held against all scenario files by a validator that is not ours.
fn schemas(python: &Path) -> Outcome {
    let has_validator = || works(Command::new(python).args(["-c", "import tomllib, jsonschema"]));
    // An environment of an earlier version has none.
    let install = ["-m", "pip", "install", "--quiet", "--retries", "1", "--timeout", "20", "jsonschema"];
    let installed = has_validator() || works(Command::new(python).args(install)) && has_validator();
    if !installed {
        println!("skipped: schemas are not checked, Python has no `jsonschema`, or is older than 3.11");
        return Ok(());
    }
    let mut command = Command::new(python);
    run(command.arg(root().join("scripts/check_schema.py")).arg(pulvis()?).arg(root()))
}

/// Has Python's VTK read a run folder, unless it cannot be had, which is said.
pub fn read_by_vtk(folder: &std::path::Path, options: &[&str]) -> Outcome {
    let Some(python) = python_with_vtk() else { return Ok(()) };
    let mut command = Command::new(python);
    run(command.arg(root().join("scripts/check_vtk.py")).arg(folder).args(options))
}

/// A Python that has VTK, in a private environment below the target folder.
pub fn python_with_vtk() -> Option<PathBuf> {
    let environment = target().join("xtask-python");
    let python = environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let has_vtk = || works(Command::new(&python).args(["-c", "import vtkmodules.vtkIOXML, numpy, pandas"]));
    if has_vtk() {
        return Some(python);
    }
    let system = ["python3", "python"].into_iter().find(|name| works(Command::new(name).arg("--version")));
    let Some(system) = system else {
        println!("skipped: VTK files are not read by VTK's own reader, there is no Python here");
        return None;
    };
    println!(
        "installing VTK for Python into {} (once)",
        environment.strip_prefix(root()).unwrap_or(&environment).display()
    );
    if !works(Command::new(system).args(["-m", "venv"]).arg(&environment)) {
        println!(
            "skipped: VTK files are not read by VTK's own reader, `{system} -m venv` does not work here"
        );
        return None;
    }
    let install = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--retries",
        "1",
        "--timeout",
        "20",
        "vtk",
        "numpy",
        "pandas",
        "jsonschema",
    ];
    if !works(Command::new(&python).args(install)) || !has_vtk() {
        println!(
            "skipped: files are not read by their own readers, `pip install vtk numpy pandas jsonschema` does not work here"
        );
        return None;
    }
    Some(python)
}
