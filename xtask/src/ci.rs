//! `cargo xtask ci`: everything that must hold before a change is merged, cheapest first.

use std::process::Command;
use std::time::Instant;

use crate::Outcome;
use crate::process::{cargo, pulvis, run};
use crate::{book, check_docs, dependencies, experiments, scenarios, tests, threads};

/// A step, by its name.
type Step = (&'static str, fn() -> Outcome);

/// Everything, in one profile, so that tests, binary and tasks share their builds. A step that fails does not hide the
/// findings of the next ones.
pub fn run_all() -> Outcome {
    let steps: [Step; 11] = [
        ("formatting", || run(&mut cargo(&["fmt", "--all", "--check"]))),
        ("documents", check_docs::run),
        ("dependencies", dependencies::check),
        ("lints", lints),
        ("API documentation", documentation),
        ("tests", tests::run_all),
        ("threads", threads::loom),
        ("values of the laws", verification),
        ("pages of the laws", book::check),
        ("scenarios", scenarios::run),
        ("experiments", || experiments::run(None)),
    ];
    let (mut times, mut failures) = (Vec::new(), Vec::new());
    for (name, step) in steps {
        println!("\n==== {name}");
        let began = Instant::now();
        if let Err(message) = step() {
            eprintln!("error: {name}: {message}");
            failures.push(name);
        }
        times.push(format!("{name} {:.0} s", began.elapsed().as_secs_f64()));
    }
    println!("\n{}", times.join(", "));
    if failures.is_empty() {
        println!("all well");
        return Ok(());
    }
    Err(format!("these steps failed: {}", failures.join(", ")))
}

fn lints() -> Outcome {
    run(&mut cargo(&["clippy", "--quiet", "--workspace", "--all-targets", "--", "-D", "warnings"]))
}

fn documentation() -> Outcome {
    let mut command = cargo(&["doc", "--quiet", "--workspace", "--no-deps"]);
    run(command.env("RUSTDOCFLAGS", "-D warnings"))
}

fn verification() -> Outcome {
    run(Command::new(pulvis()?).arg("verify"))
}
