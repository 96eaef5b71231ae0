//! `cargo xtask sanitize` and `cargo xtask fuzz`: builds with the instruments of the compiler.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::Outcome;
use crate::process::{self, cargo, root, target, works};

/// Where the compiler has a runtime for both.
const HOST: &str = "x86_64-unknown-linux-gnu";

/// Crates with unsafe code, or next to it.
const UNSAFE: [&str; 3] = ["pulvis-math", "pulvis-parallel", "pulvis-core"];

fn is_host() -> bool {
    if cfg!(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu")) {
        return true;
    }
    println!("skipped: this is no {HOST}");
    false
}

/// All tests of the crates with unsafe code, with every access to memory checked. That the stable compiler has the sanitizer only
/// behind a flag is no matter of these tests.
pub fn run() -> Outcome {
    if !is_host() {
        return Ok(());
    }
    let mut command = cargo(&["test", "--quiet", "--target", HOST, "--lib", "--tests"]);
    for name in UNSAFE {
        command.args(["-p", name]);
    }
    command.env("RUSTC_BOOTSTRAP", "1").env("RUSTFLAGS", "-Zsanitizer=address");
    run_in("sanitize", &mut command)
}

/// One of `fuzz/targets` for some seconds, from the sound and the bad files of the tests.
pub fn fuzz(name: &str, seconds: &str) -> Outcome {
    if !root().join(format!("fuzz/targets/{name}.rs")).is_file() {
        return Err(format!("`{name}` is none of the targets of fuzz/targets"));
    }
    if seconds.parse::<u32>().is_err() {
        return Err(format!("`{seconds}` is no number of seconds"));
    }
    if !is_host() {
        return Ok(());
    }
    if !works(Command::new("c++").arg("--version")) {
        println!("skipped: there is no C++ compiler `c++`, with which the fuzzer is built");
        return Ok(());
    }
    // What `cargo fuzz` sets; none of it needs a nightly compiler.
    let flags = [
        "--cfg fuzzing",
        "-Cpasses=sancov-module",
        "-Cllvm-args=-sanitizer-coverage-level=4",
        "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
        "-Cllvm-args=-sanitizer-coverage-pc-table",
        "-Cllvm-args=-sanitizer-coverage-trace-compares",
    ];
    let folder = target().join("fuzz");
    let [seeds, found] = ["seeds", "found"].map(|part| folder.join(part).join(name));
    collect_seeds(name, &seeds)?;
    fs::create_dir_all(&found).map_err(|error| format!("{}: {error}", found.display()))?;
    let words = folder.join(format!("{name}.words"));
    write_words(&seeds, &words)?;
    let mut build =
        cargo(&["build", "--release", "--target", HOST, "--manifest-path", "fuzz/Cargo.toml", "--bin", name]);
    build.env("RUSTFLAGS", flags.join(" "));
    run_in("fuzz", &mut build)?;
    let mut command = Command::new(folder.join(HOST).join("release").join(name));
    command.arg(&found).arg(&seeds).current_dir(&folder);
    command.arg(format!("-dict={}", words.display())).arg(format!("-max_total_time={seconds}"));
    command.args([
        "-timeout=20",
        "-rss_limit_mb=1024",
        "-max_len=16384",
        "-print_final_stats=1",
        "-verbosity=0",
    ]);
    process::run(&mut command)
}

/// With a target folder of its own: the flags would have everything else compiled anew.
fn run_in(folder: &str, command: &mut Command) -> Outcome {
    process::run(command.env("CARGO_TARGET_DIR", target().join(folder)))
}

/// Copies of all files that a target may start from.
fn collect_seeds(name: &str, into: &Path) -> Outcome {
    let tests = root().join("crates/pulvis-input/tests");
    let own = root().join("fuzz/seeds").join(name);
    let folders = [own, tests.join("good"), tests.join("bad"), root().join("experiments/restitution")];
    let is_toml = |path: &Path| path.extension().is_some_and(|ending| ending == "toml");
    let failed = |error: std::io::Error| format!("{}: {error}", into.display());
    fs::create_dir_all(into).map_err(failed)?;
    let readers = ["collision", "probe"];
    for (number, folder) in folders.iter().enumerate().filter(|(_, folder)| folder.is_dir()) {
        let files = fs::read_dir(folder).map_err(failed)?.filter_map(Result::ok).map(|entry| entry.path());
        for file in files.filter(|file| file.is_file()) {
            let stem = file.file_name().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
            let reader = readers.into_iter().find(|reader| stem.starts_with(reader)).unwrap_or("scenario");
            let reader = if number == 3 { "collision" } else { reader };
            if number == 0 || is_toml(&file) && reader == name {
                fs::copy(&file, into.join(format!("{number}-{stem}"))).map_err(failed)?;
            }
        }
    }
    Ok(())
}

/// The words of all seeds, which a fuzzer would not find by single letters.
fn write_words(seeds: &Path, file: &Path) -> Outcome {
    let failed = |error: std::io::Error| format!("{}: {error}", file.display());
    let mut words = BTreeSet::new();
    for entry in fs::read_dir(seeds).map_err(failed)?.filter_map(Result::ok) {
        let text = String::from_utf8_lossy(&fs::read(entry.path()).map_err(failed)?).into_owned();
        let split = text.split(|letter: char| !letter.is_ascii_alphanumeric() && !"_-".contains(letter));
        words.extend(split.filter(|word| (3..40).contains(&word.len())).map(str::to_owned));
    }
    let lines: String = words.iter().map(|word| format!("\"{word}\"\n")).collect();
    fs::write(file, lines).map_err(failed)
}
