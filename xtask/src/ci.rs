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
    let steps: [Step; 10] = [
        ("formatting", || run(&mut cargo(&["fmt", "--all", "--check"]))),
        ("documents", check_docs::run),
        ("dependencies", dependencies::check),
        ("lints", lints),
        ("API documentation", documentation),
        ("tests", tests::run_all),
        ("values of the laws", verification),
        ("pages of the laws", book::check),
        ("scenarios", scenarios::run),
        ("experiments", || experiments::run(None)),
    ];
    let (mut times, mut failures) = (Vec::new(), Vec::new());
    let mut take_in = |name: &'static str, (outcome, seconds): (Outcome, f64)| {
        if let Err(message) = outcome {
            eprintln!("error: {name}: {message}");
            failures.push(name);
        }
        times.push(format!("{name} {seconds:.0} s"));
    };
    let (checks, rest) = steps.split_at(5);
    let (builds, runs) = rest.split_at(1);
    // What the tests need of pip is waited for, not worked for: it comes meanwhile.
    std::thread::scope(|scope| {
        scope.spawn(tests::prepare);
        for &(name, step) in checks {
            take_in(name, timed(name, step));
        }
    });
    for &(name, step) in builds {
        take_in(name, timed(name, step));
    }
    // What tests threads waits more than it works: it goes on beside what only runs.
    std::thread::scope(|scope| {
        let beside = scope.spawn(|| timed("threads", threads::loom));
        for &(name, step) in runs {
            take_in(name, timed(name, step));
        }
        let lost = || (Err("it did not end in order".to_owned()), 0.0);
        take_in("threads", beside.join().unwrap_or_else(|_| lost()));
    });
    println!("\n{}", times.join(", "));
    if failures.is_empty() {
        println!("all well");
        return Ok(());
    }
    Err(format!("these steps failed: {}", failures.join(", ")))
}

/// What a step comes to, and how long it takes [s].
fn timed(name: &str, step: fn() -> Outcome) -> (Outcome, f64) {
    println!("\n==== {name}");
    let began = Instant::now();
    let outcome = step();
    (outcome, began.elapsed().as_secs_f64())
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
