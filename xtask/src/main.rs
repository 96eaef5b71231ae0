//! Automation of the workspace: `cargo xtask <task>`, the same on a developer's machine and in CI.
#![allow(clippy::print_stdout, clippy::print_stderr)] // tasks talk to people
#![allow(clippy::disallowed_methods)] // no bit of a simulation is made here

mod book;
mod browser;
mod check_docs;
mod ci;
mod dependencies;
mod expected;
mod experiments;
mod figures;
mod hdf5;
mod mpi;
mod process;
mod python;
mod sanitizers;
mod scenarios;
mod table;
mod tests;
mod threads;

use std::process::ExitCode;

/// What comes of a task; the error is a sentence for people.
type Outcome<T = ()> = Result<T, String>;

const USAGE: &str = "\
usage: cargo xtask <task>

  test                 all tests; the VTK files read by Python's VTK, and the Python package, where pip can install what they need
  slow                 every law in beds of 1000 grains, 200 kills of runs, 100 000 damaged inputs, and a hundred times as many
                       random paths (half an hour)
  soak [MINUTES]       a driven bed for 10 minutes or as long as told: memory, ledger, contacts against brute force
  python               the Python package as users get it: the optimised wheel, and its tests in an environment of its own (minutes)
  mpi [KILLS]          runs on processes of Open MPI and MPICH: the files of one process, also after 4 kills at random moments, or as
                       many as told (minutes: it builds the program with each)
  hdf5                 the program with the feature `hdf5`, its files read by h5py (minutes: it builds what is around the engine once more)
  browser              the page of `pulvis view` in Chromium without a window, where Node.js and Chromium are (some minutes)
  ci                   everything that must hold before a change is merged
  experiments [FOLDER] runs the experiments that are short and compares them with their expected.toml
  scenarios            shows every good and bad scenario of the tests to the pulvis command
  loom                 tests threads in every order of their operations (loom, some switches between threads)
  miri                 looks for undefined behaviour in what threads share, where a nightly Miri is installed
  sanitize             the unsafe code of the engine under the address sanitizer (minutes: it builds the engine with it)
  fuzz TARGET [SECONDS] coverage-guided fuzzing of a reader for a minute or as long as told: scenario, collision, probe, mesh, import
  golden-bits          writes the bits of the runs of crates/pulvis-cli/tests/golden_bits anew
  figures              makes the pictures of README and docs anew
  book                 writes the book's pages of laws from the catalogue and the program, builds the book if mdbook is there
  book --check         says whether those pages and their pictures are up to date
  check-docs           paths named in ARCHITECTURE.md, length of files, paths of single machines
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["test"] => tests::run_all(),
        ["slow"] => tests::run_slow(),
        ["soak"] => tests::soak("10"),
        ["soak", minutes] => tests::soak(minutes),
        ["python"] => python::run_all(),
        ["mpi"] => mpi::run_all("4"),
        ["mpi", kills] => mpi::run_all(kills),
        ["hdf5"] => hdf5::run_all(),
        ["browser"] => browser::run_all(),
        ["ci"] => ci::run_all(),
        ["experiments"] => experiments::run(None),
        ["experiments", folder] => experiments::run(Some(folder)),
        ["scenarios"] => scenarios::run(),
        ["loom"] => threads::loom(),
        ["miri"] => threads::miri(),
        ["sanitize"] => sanitizers::run(),
        ["fuzz", target] => sanitizers::fuzz(target, "60"),
        ["fuzz", target, seconds] => sanitizers::fuzz(target, seconds),
        ["golden-bits"] => tests::renew_golden_bits(),
        ["figures"] => figures::run_all(),
        ["book"] => book::write(),
        ["book", "--check"] => book::check(),
        ["check-docs"] => check_docs::run(),
        [] | ["help" | "--help" | "-h"] => {
            print!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        _ => {
            eprint!("error: `{}` is no task\n\n{USAGE}", words.join(" "));
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
