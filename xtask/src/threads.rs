//! `cargo xtask loom` and `cargo xtask miri`: what tests by chance do not find in the code that threads share.

use std::process::Command;

use crate::Outcome;
use crate::process::{cargo, root, run, target, works};

/// Switches between threads at places where none had to wait. Three take seconds and find every fault that has been
/// put in on trial, four take minutes.
const PREEMPTIONS: &str = "3";

/// The models of `crates/pulvis-parallel/src/loom_tests.rs`.
pub fn loom() -> Outcome {
    let mut command = cargo(&["test", "--quiet", "-p", "pulvis-parallel", "--lib"]);
    // The flag would have everything else compiled anew: a folder of its own.
    command.env("RUSTFLAGS", "--cfg loom").env("CARGO_TARGET_DIR", target().join("loom"));
    if std::env::var_os("LOOM_MAX_PREEMPTIONS").is_none() {
        command.env("LOOM_MAX_PREEMPTIONS", PREEMPTIONS);
    }
    run(&mut command)
}

/// The tests of the crate that holds the unsafe code of threads, interpreted.
pub fn miri() -> Outcome {
    let nightly = |arguments: &[&str]| {
        let mut command = Command::new("cargo");
        // A toolchain that this task was started with must not go before the one asked for.
        command.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN").current_dir(root());
        command.arg("+nightly").args(arguments);
        command
    };
    if !works(&mut nightly(&["miri", "--version"])) {
        println!("skipped: Miri is not installed; `rustup +nightly component add miri rust-src` installs it");
        return Ok(());
    }
    let mut command = nightly(&["miri", "test", "-p", "pulvis-parallel", "--lib"]);
    // Threads outlive no test, but the pool's names and clocks are the system's.
    run(command.env("MIRIFLAGS", "-Zmiri-disable-isolation").env("CARGO_TARGET_DIR", target().join("miri")))
}
