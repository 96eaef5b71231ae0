//! `pulvis run`: the stages of a scenario.

use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use clap::Args;
use pulvis_core::InstructionSet;
use pulvis_input::scenario::Scenario;
use pulvis_io::table::significant;
use pulvis_lab::protocol::{
    Average, Followed, Following, PictureOptions, Progress, RunError, RunOptions, RunSummary, dismiss,
    follow, follow_nobody, load_scenario, resume, run,
};
use pulvis_parallel::exchange::Exchange;

use super::allow::Allowed;
use super::picture_file::Resolution;
use super::progress::{ProgressLine, Style};
use super::set::Settings;
use super::words::duration;
use crate::failure::{Failure, INTERRUPTED, print};
use crate::ranks;

/// Runs the stages of a scenario and writes tables, VTK files and pictures into a fresh folder.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scenario file (TOML)
    #[arg(required_unless_present = "resume")]
    file: Option<PathBuf>,
    /// Go on with the interrupted run in this folder, from its latest checkpoint, or from the checkpoint file that is named
    #[arg(long, value_name = "RUN", conflicts_with_all = ["file", "output", "force", "pairs", "names"])]
    resume: Option<PathBuf>,
    /// Output folder, instead of the scenario's own
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    set: Settings,
    #[command(flatten)]
    allowed: Allowed,
    /// Remove the files of the run that is in the output folder, if it has ended, and run again
    #[arg(long)]
    force: bool,
    /// Number of threads; results do not depend on it [default: all processors that get 500 particles each]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Instruction set (sse2, avx2, avx512); results do not depend on it [default: the widest of the processor]
    #[arg(long, value_name = "SET", value_parser = instruction_set)]
    instructions: Option<InstructionSet>,
    #[command(flatten)]
    resolution: Resolution,
    /// Write plots as SVG beside PNG
    #[arg(long)]
    svg: bool,
    /// How progress is told on the standard error stream
    #[arg(long, value_enum, value_name = "STYLE", default_value = "auto")]
    progress: Style,
    /// Seconds between two lines of progress; the end of each stage is always told
    #[arg(long, value_name = "SECONDS", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..))]
    progress_interval: u32,
    /// No progress: as `--progress none`
    #[arg(short, long, conflicts_with = "progress")]
    quiet: bool,
}

/// Tells a warning on the standard error stream.
fn warn(text: &str) {
    // Nobody is left to be told if the stream is closed.
    let _ = writeln!(std::io::stderr(), "warning: {text}");
}

/// An instruction set by its name.
fn instruction_set(name: &str) -> Result<InstructionSet, String> {
    let available =
        || InstructionSet::available().iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    InstructionSet::named(name).ok_or_else(|| format!("this processor has {}", available()))
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let exchange = ranks::exchange()?;
    let Some(exchange) = exchange else { return lead(arguments, load(arguments)?, None) };
    let loaded = load(arguments);
    match (loaded, exchange.rank()) {
        (Ok(scenario), 0) => lead(arguments, scenario, Some(exchange)),
        (Err(failure), 0) => {
            dismiss(&exchange);
            Err(failure)
        }
        (Ok(scenario), _) => follow_leader(arguments, scenario.as_ref(), &exchange),
        // The first rank says the same, unless only this one cannot read the file.
        (Err(failure), rank) if follow_nobody(&exchange) => Err(failure.on_rank(rank)),
        (Err(failure), _) => Ok(failure.silent()),
    }
}

/// The scenario to run; `None` where a run is resumed.
fn load(arguments: &Arguments) -> Result<Option<Scenario>, Failure> {
    let Some(file) = &arguments.file else { return Ok(None) };
    let mut scenario = load_scenario(file, &arguments.set.pairs).map_err(Failure::bad_input)?;
    arguments.allowed.apply(&mut scenario);
    Ok(Some(scenario))
}

/// A flag that the user sets by stopping the program.
fn stop_flag() -> Result<Arc<AtomicBool>, Failure> {
    let stop = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&stop);
    // Also SIGTERM and SIGHUP. A second Ctrl-C while files are being completed changes nothing: they are complete in a moment.
    ctrlc::set_handler(move || handler.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::while_running(format!("cannot listen for Ctrl-C: {error}")))?;
    Ok(stop)
}

fn options(arguments: &Arguments, exchange: Option<Arc<dyn Exchange>>) -> RunOptions {
    RunOptions {
        folder: arguments.output.clone(),
        force: arguments.force,
        threads: arguments.threads.map(usize::from),
        instructions: arguments.instructions,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        pictures: PictureOptions { dpi: arguments.resolution.dpi, svg: arguments.svg },
        exchange,
        warn,
    }
}

fn failure(error: RunError) -> Failure {
    if error.is_bad_input() { Failure::bad_input(error) } else { Failure::while_running(error) }
}

/// What a rank does that is not the first: it writes nothing, and says only what the first one does not.
fn follow_leader(
    arguments: &Arguments,
    scenario: Option<&Scenario>,
    exchange: &Arc<dyn Exchange>,
) -> Result<ExitCode, Failure> {
    let stop = stop_flag()?;
    let options = options(arguments, Some(Arc::clone(exchange)));
    let following = match (scenario, &arguments.resume) {
        (Some(scenario), _) => Following::Scenario(scenario),
        (None, Some(path)) => Following::Resumed(path),
        // One of them is required.
        (None, None) => return Ok(ExitCode::SUCCESS),
    };
    match follow(following, &options, exchange, &stop) {
        Ok(Followed::ToTheEnd) if stop.load(Ordering::Relaxed) => Ok(ExitCode::from(INTERRUPTED)),
        Ok(Followed::ToTheEnd) => Ok(ExitCode::SUCCESS),
        Ok(Followed::UntilTold(error)) => Ok(failure(error).silent()),
        Err(error) => Err(failure(error).on_rank(exchange.rank())),
    }
}

/// What the only rank does, or the first of several.
fn lead(
    arguments: &Arguments,
    scenario: Option<Scenario>,
    exchange: Option<Arc<dyn Exchange>>,
) -> Result<ExitCode, Failure> {
    let stop = stop_flag()?;
    let options = options(arguments, exchange);
    let style = if arguments.quiet { Style::None } else { arguments.progress };
    let mut line = ProgressLine::new(style, Duration::from_secs(arguments.progress_interval.into()));
    let mut watch = |progress: &Progress| line.show(progress);
    let result = match (&scenario, &arguments.resume) {
        (Some(scenario), _) => run(scenario, &options, &stop, &mut watch),
        (None, Some(folder)) => resume(folder, &options, &stop, &mut watch),
        // One of them is required.
        (None, None) => return Ok(ExitCode::SUCCESS),
    };
    line.close();
    let summary = result.map_err(failure)?;
    print(&describe(&summary))?;
    Ok(if summary.interrupted() { ExitCode::from(INTERRUPTED) } else { ExitCode::SUCCESS })
}

fn describe(summary: &RunSummary) -> String {
    let state =
        if summary.interrupted() { "interrupted; files are complete up to the last step" } else { "done" };
    let steps = summary.steps - summary.steps_before;
    let rate = steps as f64 * summary.particles as f64 / summary.wall_clock.max(1e-9);
    let mut text = format!(
        "{state}: {steps} steps of {} particles in {} ({rate:.2e} particle-steps/s)\n",
        summary.particles,
        duration(summary.wall_clock)
    );
    if summary.steps_before > 0 {
        text += &format!("it went on from step {}\n", summary.steps_before);
    }
    text += &format!(
        "energy ledger: relative closing error {:.1e} at the end, {:.1e} at most\n",
        summary.energy_error, summary.energy_error_max
    );
    text += &averages(&summary.averages);
    text += &format!("written to {}:\n", summary.folder.display());
    text += "  run.toml, timeseries.csv";
    if summary.folder.join("series.pvd").exists() {
        text += ", series.pvd (ParaView)";
    }
    if !summary.averages.is_empty() {
        text += ", averages.json";
    }
    for picture in &summary.pictures {
        if let Some(name) = picture.file_name() {
            text += &format!(", {}", name.to_string_lossy());
        }
    }
    text += "\n";
    if summary.can_be_resumed {
        text += &format!("go on with `pulvis run --resume {}`\n", summary.folder.display());
    }
    text
}

/// What is told of averages; all of them are in a file.
const TOLD: [&str; 6] = [
    "pressure",
    "deviatoric_stress",
    "solid_fraction",
    "coordination",
    "corrected_coordination",
    "granular_temperature",
];

/// The most important averages, a line for each observer and stage.
fn averages(averages: &[Average]) -> String {
    let mut text = String::new();
    let mut before = None;
    let told = averages.iter().filter(|average| TOLD.contains(&average.quantity.as_str()));
    for average in told.filter(|average| average.mean.is_finite()) {
        let place = (&average.observer, &average.stage);
        if before != Some(place) {
            let end = if before.is_some() { "\n" } else { "" };
            text += &format!("{end}{} in stage {}: ", average.observer, average.stage);
        } else {
            text += ", ";
        }
        before = Some(place);
        let error = average.standard_error.map(|error| format!(" ± {}", significant(error, 2)));
        let unit = if average.unit == "1" { String::new() } else { format!(" {}", average.unit) };
        let name = average.quantity.replace('_', " ");
        text += &format!("{name} {}{}{unit}", significant(average.mean, 5), error.unwrap_or_default());
    }
    if before.is_some() { text + "\n" } else { text }
}
