//! `pulvis study`: a scenario over seeds and values.

use std::fmt::Write as _;
use std::io::Write as _;
use std::num::NonZero;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use pulvis_input::study::Study;
use pulvis_io::report::Verdict;
use pulvis_io::table::{Cell, Table, significant};
use pulvis_lab::study::{
    Checked, Plan, StudyError, StudyOptions, StudyResults, Told, check, load_study, plan, run_study,
    time_of_first_point,
};

use super::machine::facts;
use super::picture_file::Resolution;
use super::study_progress::StudyProgress;
use super::words::duration;
use crate::failure::{Failure, INTERRUPTED, print};

/// Runs a scenario over seeds and over every combination of some values, several runs at once; writes a table of all runs,
/// means with standard errors, their pictures, and a report that holds them against what is expected.
///
/// A run that fails is recorded and stops nothing. The same command goes on where it was interrupted, and computes only what is
/// missing after values or seeds have been added.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Study file (TOML)
    file: PathBuf,
    /// Folder for the runs, tables and the report [default: the name of the file with `-study`, in the current folder]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Threads of all runs together: one for each run while there are more runs than threads; results do not depend on it
    /// [default: all processors]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// List the runs, what is there of them and about how long they take; run nothing
    #[arg(long)]
    dry_run: bool,
    /// Begin all runs of the study anew; removes the files of the runs that are there, and nothing else
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    resolution: Resolution,
    /// No progress
    #[arg(short, long)]
    quiet: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let study = load_study(&arguments.file).map_err(Failure::bad_input)?;
    let version = env!("CARGO_PKG_VERSION");
    let plan = plan(&study, &folder(arguments), arguments.force, version).map_err(failure)?;
    let processors = std::thread::available_parallelism().map_or(1, NonZero::get);
    let threads = arguments.threads.map_or(processors, usize::from);
    let stop = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&stop);
    // Also SIGTERM and SIGHUP.
    ctrlc::set_handler(move || handler.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::while_running(format!("cannot listen for Ctrl-C: {error}")))?;
    let checked = check(&study, &plan, threads, &stop).map_err(failure)?;
    warn(&checked);
    if arguments.dry_run {
        print(&forecast(&study, &plan, &checked, threads)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let progress = StudyProgress::new(&study, plan.runs.len(), arguments.quiet);
    let tell = |told: &Told<'_>| progress.tell(told);
    let began = std::time::Instant::now();
    let options = StudyOptions {
        threads,
        version,
        dpi: arguments.resolution.dpi,
        stop: &stop,
        tell: &tell,
        facts: &facts,
    };
    let results = run_study(&study, &plan, &options);
    progress.close();
    let results = results.map_err(failure)?;
    print(&describe(&study, &plan, &results, began.elapsed().as_secs_f64()))?;
    Ok(if results.interrupted() {
        ExitCode::from(INTERRUPTED)
    } else if results.passes() {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

fn failure(error: StudyError) -> Failure {
    if error.is_bad_input() { Failure::bad_input(error) } else { Failure::while_running(error) }
}

/// The output folder: below the current one, where nothing else is said.
fn folder(arguments: &Arguments) -> PathBuf {
    let stem = arguments.file.file_stem().unwrap_or_default().to_string_lossy();
    arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}-study")))
}

fn warn(checked: &Checked) {
    for (text, point, further) in &checked.warnings {
        let others = match further {
            0 => String::new(),
            1 => " and at another point".to_owned(),
            further => format!(" and at {further} other points"),
        };
        // Nobody is left to be told if the standard error stream is closed.
        let _ = writeln!(std::io::stderr(), "warning: {text} (at {point}{others})");
    }
}

/// The list of all runs, and the time that those take which are missing.
fn forecast(study: &Study, plan: &Plan, checked: &Checked, threads: usize) -> Result<String, Failure> {
    let mut table = Table::new(["point", "seed", "particles", "steps", "state"]);
    // Particle-steps of the missing runs over those of a run at the first point: least and largest number.
    let mut work = [0.0; 2];
    let size = |steps: u64, particles: usize| (steps * particles as u64).max(1) as f64;
    for run in &plan.runs {
        let Some(own) = checked.forecasts.get(run.point) else { continue };
        let name = study.points.get(run.point).map_or("", |point| point.name.as_str());
        let steps = if own.open_ended {
            format!("{} to {}", own.least_steps, own.steps)
        } else {
            own.steps.to_string()
        };
        table
            .push([
                Cell::from(name),
                Cell::from(run.seed.to_string()),
                Cell::from(own.particles.to_string()),
                Cell::from(steps),
                Cell::from(run.state_in_words()),
            ])
            .map_err(Failure::while_running)?;
        if let Some(first) = checked.forecasts.first().filter(|_| !run.is_complete()) {
            work[0] += size(own.least_steps, own.particles) / size(first.least_steps, first.particles);
            work[1] += size(own.steps, own.particles) / size(first.steps, first.particles);
        }
    }
    let mut text = table.to_text(6);
    let (missing, all) = (plan.missing(), plan.runs.len());
    let _ = writeln!(text, "\n{missing} of {all} runs to be carried out, on {threads} threads");
    if missing > 0 {
        let of_first = time_of_first_point(plan).map_err(failure)?;
        let at_once = threads.min(missing) as f64;
        let [least, most] = [0, 1].map(|end: usize| of_first[end] * work[end] / at_once);
        let open = checked.forecasts.iter().any(|own| own.open_ended);
        let time = match (open, duration(least), duration(most)) {
            (true, least, most) if least != most => {
                format!("{least} to {most}; stages may end by other rules than time")
            }
            (_, _, most) => most,
        };
        let _ = writeln!(text, "time            about {time}");
    }
    let _ = writeln!(text, "output          {}", plan.folder.display());
    Ok(text)
}

fn describe(study: &Study, plan: &Plan, results: &StudyResults, seconds: f64) -> String {
    let (complete, all) = (results.count("complete"), results.runs.len());
    let there = results.runs.iter().filter(|run| run.was_there).count();
    let before = if there > 0 { format!(" ({there} were there)") } else { String::new() };
    let mut text = format!("{complete} of {all} runs complete{before}, in {}\n", duration(seconds));
    let failed = results.count("failed");
    if failed > 0 {
        let _ = writeln!(text, "{failed} failed: runs.csv says why, `pulvis explain RUN` tells more");
    }
    if results.interrupted() {
        let _ = writeln!(text, "interrupted; the same command, without --force, goes on");
    }
    let [passed, missed, open] =
        [Verdict::Passed, Verdict::Missed, Verdict::Failed].map(|verdict| results.verdicts(verdict));
    if passed + missed + open > 0 {
        let _ = writeln!(text, "{passed} of {} means as expected", passed + missed + open);
    }
    text += &missed_means(study, results);
    let _ = writeln!(
        text,
        "written to {}:\n  report.html, report.md, runs.csv, study.csv, study.json, PNG and SVG of each measure, runs/",
        plan.folder.display()
    );
    text
}

/// A line for each mean that is not as it is expected to be.
fn missed_means(study: &Study, results: &StudyResults) -> String {
    let mut text = String::new();
    for (index, (point, of_measures)) in study.points.iter().zip(&results.points).enumerate() {
        for (measure, result) in study.measures.iter().zip(of_measures) {
            let (Some(Verdict::Missed), Some(expected)) = (result.verdict, &measure.expected) else {
                continue;
            };
            let value = expected.values.get(index).copied().unwrap_or(f64::NAN);
            let numbers = [result.mean, value, result.allowed.unwrap_or(f64::NAN)];
            let [mean, value, allowed] = numbers.map(|number| significant(number, 5));
            let (key, name) = (&measure.key, &point.name);
            let _ = writeln!(text, "missed: {key} at {name}: {mean}, expected {value} within {allowed}");
        }
    }
    text
}
