//! `pulvis reproduce`: the figures of papers, computed anew.

use std::io::{IsTerminal, Write as _};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use pulvis_input::Problem;
use pulvis_input::figure::{FIGURE_FILE, FigureScenario};
use pulvis_io::table::{Cell, Table};
use pulvis_lab::reproduction::{Attempt, RunDone, Seats, Workplace, files, report, run_all};

use super::machine::facts;
use super::picture_file::{Resolution, exists};
use super::words::duration;
use crate::failure::{Failure, INTERRUPTED, print};

/// Computes figures of papers anew, draws them, holds them against theory, and writes a report.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Names of figures; without them, all that are quick
    names: Vec<String>,
    /// All figures, those that take long too
    #[arg(long, conflicts_with = "names")]
    all: bool,
    /// List the figures and compute nothing
    #[arg(long)]
    list: bool,
    /// The folder in which each figure has a folder of its own
    #[arg(long, value_name = "DIR", default_value = "experiments/figures")]
    from: PathBuf,
    /// Folder for report, pictures and tables
    #[arg(short, long, value_name = "DIR", default_value = "reproduced")]
    output: PathBuf,
    #[command(flatten)]
    resolution: Resolution,
    /// Take the runs in the output folder that have ended and had the same scenarios; goes on with --force where it was
    /// interrupted
    #[arg(long)]
    reuse: bool,
    /// Write over a report that exists
    #[arg(long)]
    force: bool,
    /// No progress bar
    #[arg(short, long)]
    quiet: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let folders = folders(&arguments.from)?;
    let names: Vec<&str> = folders.iter().filter_map(|folder| folder.file_name()?.to_str()).collect();
    if let Some(unknown) = arguments.names.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(Failure::bad_input(format!(
            "{}\n  help: `pulvis reproduce --list` shows all",
            Problem::unknown_choice(unknown, &names)
        )));
    }
    let wanted = |folder: &&PathBuf| {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        arguments.names.is_empty() || arguments.names.iter().any(|wanted| *wanted == name)
    };
    // All are read before any is computed, and all mistakes are told.
    let read = folders.iter().filter(wanted).map(FigureScenario::load);
    let (read, mistakes): (Vec<_>, Vec<_>) = read.partition(Result::is_ok);
    let mistakes: Vec<String> =
        mistakes.into_iter().filter_map(|errors| Some(errors.err()?.to_string())).collect();
    if !mistakes.is_empty() {
        return Err(Failure::bad_input(mistakes.join("\n\n")));
    }
    let mut figures: Vec<FigureScenario> = read.into_iter().flatten().collect();
    // Printed figures first; they are in the order of their names.
    figures.sort_by_key(|figure| figure.reproduces.is_empty());
    if arguments.list {
        return list(&figures);
    }
    let everything = arguments.all || !arguments.names.is_empty();
    compute(arguments, figures.into_iter().filter(|figure| everything || !figure.is_long).collect())
}

/// The folders below `from` that are figures, by name.
fn folders(from: &Path) -> Result<Vec<PathBuf>, Failure> {
    let refused = |reason: String| {
        Failure::bad_input(format!(
            "{}: {reason}; expected a folder with figures\n  help: call the command in the folder of Pulvis' \
             sources, or name the folder with --from",
            from.display()
        ))
    };
    let entries = std::fs::read_dir(from).map_err(|error| refused(error.to_string()))?;
    let mut folders = Vec::new();
    for entry in entries {
        let path = entry.map_err(|error| refused(error.to_string()))?.path();
        if path.join(FIGURE_FILE).is_file() {
            folders.push(path);
        }
    }
    if folders.is_empty() {
        return Err(refused(format!("no folder in it has a file {FIGURE_FILE}")));
    }
    folders.sort();
    Ok(folders)
}

fn list(figures: &[FigureScenario]) -> Result<ExitCode, Failure> {
    let mut table = Table::new(["name", "reproduces", "shows", "takes long"]);
    for figure in figures {
        let long = if figure.is_long { "yes" } else { "" };
        let cells = [&figure.name, &figure.reproduces.join(", "), &figure.title, &long.to_owned()];
        table.push(cells.map(|text| Cell::from(text.as_str()))).map_err(Failure::while_running)?;
    }
    print(&table.to_text(3))?;
    Ok(ExitCode::SUCCESS)
}

fn compute(arguments: &Arguments, figures: Vec<FigureScenario>) -> Result<ExitCode, Failure> {
    prepare(arguments, &figures)?;
    let stop = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&stop);
    ctrlc::set_handler(move || handler.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::while_running(format!("cannot listen for Ctrl-C: {error}")))?;
    let start = std::time::Instant::now();
    let count = figures.len();
    let bar = bar(arguments.quiet, count as u64);
    let tell = |run: &RunDone| match &bar {
        Some(bar) => bar.println(describe_run(run)),
        None if !arguments.quiet => tell_user(&describe_run(run)),
        None => {}
    };
    let workplace = Workplace {
        folder: &arguments.output,
        stop: &stop,
        reuse: arguments.reuse,
        version: env!("CARGO_PKG_VERSION"),
        tell: &tell,
        seats: Seats::new(std::thread::available_parallelism().map_or(1, NonZero::get)),
    };
    let attempts = run_all(figures, &workplace, arguments.resolution.dpi, &mut |attempt| match &bar {
        Some(bar) => {
            bar.println(describe(attempt));
            bar.inc(1);
        }
        // What fails is told in any case.
        None if !arguments.quiet || !attempt.passes() => tell_user(&describe(attempt)),
        None => {}
    });
    if let Some(bar) = &bar {
        bar.finish_and_clear();
    }
    let mut facts = facts(start.elapsed().as_secs_f64());
    facts.push((
        "random numbers".to_owned(),
        "those of the seeds in the scenarios; collisions and paths have none".to_owned(),
    ));
    let written = report(&attempts, facts).map_err(Failure::while_running)?;
    written.write(&arguments.output).map_err(Failure::while_running)?;
    let good = attempts.iter().filter(|attempt| attempt.passes()).count();
    print(&format!(
        "{good} of {count} figures as they have to be, in {}\nwritten to {}: report.html, report.md, and PNG, SVG, CSV of each figure\n",
        duration(start.elapsed().as_secs_f64()),
        arguments.output.display()
    ))?;
    Ok(match (attempts.len() < count, good < count) {
        (true, _) => ExitCode::from(INTERRUPTED),
        (false, true) => ExitCode::FAILURE,
        (false, false) => ExitCode::SUCCESS,
    })
}

/// Creates the output folder, in which nothing may be written over.
fn prepare(arguments: &Arguments, figures: &[FigureScenario]) -> Result<(), Failure> {
    let folder = &arguments.output;
    let own = figures.iter().flat_map(files);
    let mut all = ["report.html", "report.md"].map(str::to_owned).into_iter().chain(own);
    if let Some(file) = all.find(|file| !arguments.force && folder.join(file).exists()) {
        return Err(exists(&folder.join(file)));
    }
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::bad_input(format!(
            "cannot create the folder {}: {error}; name a folder in which you may write with --output",
            folder.display()
        ))
    })
}

fn bar(quiet: bool, count: u64) -> Option<ProgressBar> {
    (!quiet && std::io::stderr().is_terminal()).then(|| {
        let bar = ProgressBar::new(count);
        // The template is a constant; without it the bar shows less.
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos} of {len} figures, {elapsed}") {
            bar.set_style(style);
        }
        bar.tick();
        bar
    })
}

/// A line on the standard error stream.
fn tell_user(line: &str) {
    // Nobody is left to be told if the stream is closed.
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// One line on a run of a figure.
fn describe_run(run: &RunDone) -> String {
    let RunDone { figure, data, variant, duration, is_reused } = run;
    let of = if variant.is_empty() { String::new() } else { format!(", {variant}") };
    let state = if *is_reused { "was there" } else { "done" };
    format!("{figure}: run {data}{of} {state} ({duration:.1} s)")
}

/// One line on a figure that is finished.
fn describe(attempt: &Attempt) -> String {
    let state = match &attempt.outcome {
        Err(error) => format!("failed: {error}"),
        Ok(reproduction) => {
            let missed = reproduction.checks.iter().filter(|check| !check.passes());
            let missed: Vec<String> = missed
                .map(|check| {
                    format!(
                        "{}: {:.2e}, at most {:.2e} ({})",
                        check.what, check.deviation, check.most, check.place
                    )
                })
                .collect();
            let unseen = reproduction.features.iter().filter(|feature| !feature.passes());
            let unseen =
                unseen.map(|seen| format!("{} {}: {:.3}", seen.feature.key, seen.feature.what, seen.mean()));
            let missed: Vec<String> = missed.into_iter().chain(unseen).collect();
            let seen = reproduction.features.iter().filter(|feature| feature.is_seen()).count();
            if missed.is_empty() {
                match (reproduction.checks.len(), reproduction.features.len()) {
                    (checks, 0) => format!("{checks} checks passed"),
                    (0, features) => format!("{seen} of {features} features seen, the others as known"),
                    (checks, features) => {
                        format!("{checks} checks passed, {seen} of {features} features seen")
                    }
                }
            } else {
                format!("missed: {}", missed.join("; "))
            }
        }
    };
    format!("{} ({:.1} s): {state}", attempt.figure.name, attempt.duration)
}
