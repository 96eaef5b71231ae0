//! `cargo xtask hdf5`: the program with the feature `hdf5`, and its files read by h5py.

use std::path::Path;
use std::process::Command;

use crate::Outcome;
use crate::process::{cargo, root, run, scratch, works};
use crate::tests::python_with_vtk;

/// What the library is called where `apt` is.
const PACKAGES: [&str; 2] = ["libhdf5-dev", "pkg-config"];

/// Tests of the writer and of runs that stop and go on, then files of the writer and of a run in h5py.
pub fn run_all() -> Outcome {
    let has_library = || {
        works(Command::new("pkg-config").args(["--exists", "hdf5"]))
            || works(Command::new("h5cc").arg("-showconfig"))
    };
    if !has_library() && works(Command::new("apt-get").arg("--version")) {
        println!("installing HDF5 (once)");
        let install = ["install", "--yes", "--quiet", "--no-install-recommends"];
        works(Command::new("apt-get").args(["update", "--quiet"]));
        works(Command::new("apt-get").args(install).args(PACKAGES).env("DEBIAN_FRONTEND", "noninteractive"));
    }
    if !has_library() {
        println!("skipped: there is no HDF5 library here (Debian: {})", PACKAGES.join(" "));
        return Ok(());
    }
    run(&mut cargo(&["test", "-p", "pulvis-io", "--features", "hdf5", "--lib", "frames"]))?;
    run(&mut cargo(&["test", "-p", "pulvis-lab", "--features", "hdf5", "--test", "protocol_run"]))?;
    let folder = scratch("hdf5")?;
    let sample = folder.join("sample");
    let example =
        ["run", "--quiet", "-p", "pulvis-io", "--features", "hdf5", "--example", "sample_run", "--"];
    run(cargo(&example).arg(&sample))?;
    let of_run = folder.join("run");
    let program =
        ["run", "--quiet", "-p", "pulvis-cli", "--features", "hdf5", "--bin", "pulvis", "--", "run"];
    let scenario = root().join("xtask/src/hdf5.toml");
    run(cargo(&program).arg(scenario).args(["--quiet", "--output"]).arg(&of_run))?;
    read(&sample, &of_run)
}

/// Has h5py read both, unless it cannot be had, which is said.
fn read(sample: &Path, of_run: &Path) -> Outcome {
    let Some(python) = python_with_vtk() else { return Ok(()) };
    let has_h5py = || works(Command::new(&python).args(["-c", "import h5py"]));
    let install = ["-m", "pip", "install", "--quiet", "--retries", "1", "--timeout", "20", "h5py"];
    let installed = has_h5py() || works(Command::new(&python).args(install)) && has_h5py();
    if !installed {
        println!("skipped: HDF5 files are not read by h5py, `pip install h5py` does not work here");
        return Ok(());
    }
    run(Command::new(&python).arg(root().join("scripts/check_formats.py")).arg(sample.join("formats")))?;
    run(Command::new(&python).arg(root().join("scripts/check_hdf5.py")).arg(of_run))
}
