//! `cargo xtask python`: the Python package, built as a wheel, installed into an environment of its own, and tested there.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;
use crate::process::{root, run, scratch, target, works};

/// What the tests need beside the package.
const TOOLS: [&str; 9] =
    ["maturin>=1.8,<2", "numpy", "pandas", "matplotlib", "scipy", "pytest", "mypy", "nbclient", "ipykernel"];

/// The wheel that users get: optimised, installed and tested.
pub fn run_all() -> Outcome {
    check("release")
}

/// A wheel of the profile that all tests have, so that most of it is built already.
pub fn run_with_tests() -> Outcome {
    check("dev")
}

/// Wheel, installation and tests.
fn check(profile: &str) -> Outcome {
    let package = root().join("python");
    let Some(python) = environment() else { return Ok(()) };
    let wheels = scratch(&format!("wheels-{profile}"))?;
    let maturin = ["-m", "maturin", "build", "--profile", profile, "--locked", "--quiet", "--out"];
    let mut command = Command::new(&python);
    command.args(maturin).arg(&wheels).current_dir(&package).env("CARGO_TARGET_DIR", target());
    run(&mut command)?;
    let mut install = Command::new(&python);
    install.args(["-m", "pip", "install", "--quiet", "--force-reinstall", "--no-deps"]).arg(newest(&wheels)?);
    run(&mut install)?;
    let mut tests = Command::new(&python);
    run(tests.args(["-m", "pytest", "-p", "no:cacheprovider"]).current_dir(&package))
}

/// The wheel that was built last.
fn newest(folder: &Path) -> Outcome<PathBuf> {
    let error = |error: std::io::Error| format!("{}: {error}", folder.display());
    let files = std::fs::read_dir(folder).map_err(error)?.filter_map(Result::ok).map(|entry| entry.path());
    let wheels = files.filter(|path| path.extension().is_some_and(|ending| ending == "whl"));
    let newest = wheels.max_by_key(|path| path.metadata().and_then(|data| data.modified()).ok());
    newest.ok_or_else(|| format!("maturin left no wheel in {}", folder.display()))
}

/// The Python of an environment that has the tools; without one, says so.
pub fn environment() -> Option<PathBuf> {
    let folder = target().join("xtask-python-package");
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let imports = "import maturin, numpy, pandas, matplotlib, scipy, pytest, mypy, nbclient, ipykernel";
    let has_tools = || works(Command::new(&python).args(["-c", imports]));
    if has_tools() {
        return Some(python);
    }
    let skipped = |why: &str| {
        println!("skipped: the Python package is not tested, {why}");
        None
    };
    let new_enough = ["-c", "import sys; sys.exit(sys.version_info < (3, 10))"];
    let system = ["python3", "python"].into_iter().find(|name| works(Command::new(name).args(new_enough)));
    let Some(system) = system else { return skipped("there is no Python 3.10 or newer here") };
    println!("installing what the tests of the Python package need (once)");
    if !works(Command::new(system).args(["-m", "venv"]).arg(&folder)) {
        return skipped("`python3 -m venv` does not work here");
    }
    let install = ["-m", "pip", "install", "--quiet", "--retries", "1", "--timeout", "20"];
    if !works(Command::new(&python).args(install).args(TOOLS)) || !has_tools() {
        return skipped("pip cannot install what its tests need");
    }
    Some(python)
}
