//! `pulvis run`: the stages of a scenario.

use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use pulvis_core::InstructionSet;
use pulvis_input::scenario::Scenario;
use pulvis_lab::protocol::{Progress, RunOptions, RunSummary, run};

use super::words::duration;
use crate::failure::{Failure, print};

/// Exit code of a run that the user stopped, as shells expect it (128 + SIGINT).
const INTERRUPTED: u8 = 130;

/// Runs the stages of a scenario and writes tables, VTK files and pictures into a fresh folder.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scenario file (TOML)
    file: PathBuf,
    /// Output folder, instead of the scenario's own
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Write over the run that is in the output folder
    #[arg(long)]
    force: bool,
    /// Number of threads; results do not depend on it [default: all processors that get 500 particles each]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Instruction set (sse2, avx2, avx512); results do not depend on it [default: the widest of the processor]
    #[arg(long, value_name = "SET", value_parser = instruction_set)]
    instructions: Option<InstructionSet>,
    /// No progress line
    #[arg(short, long)]
    quiet: bool,
}

/// An instruction set by its name.
fn instruction_set(name: &str) -> Result<InstructionSet, String> {
    let available =
        || InstructionSet::available().iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    InstructionSet::named(name).ok_or_else(|| format!("this processor has {}", available()))
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let scenario = Scenario::load(&arguments.file).map_err(Failure::bad_input)?;
    let stop = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&stop);
    // A second Ctrl-C while files are being completed changes nothing: they are complete in a moment.
    ctrlc::set_handler(move || handler.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::while_running(format!("cannot listen for Ctrl-C: {error}")))?;
    let options = RunOptions {
        folder: arguments.output.clone(),
        force: arguments.force,
        threads: arguments.threads.map(usize::from),
        instructions: arguments.instructions,
        version: env!("CARGO_PKG_VERSION").to_owned(),
    };
    let mut line = ProgressLine::new(arguments.quiet);
    let result = run(&scenario, &options, &stop, &mut |progress| line.show(progress));
    line.close();
    let summary = result.map_err(|error| {
        if error.is_bad_input() { Failure::bad_input(error) } else { Failure::while_running(error) }
    })?;
    print(&describe(&summary))?;
    Ok(if summary.interrupted() { ExitCode::from(INTERRUPTED) } else { ExitCode::SUCCESS })
}

/// One line that is written over and over in a terminal; elsewhere, a line at the end of each stage.
struct ProgressLine {
    bar: Option<ProgressBar>,
    quiet: bool,
}

impl ProgressLine {
    fn new(quiet: bool) -> Self {
        let bar = (!quiet && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new(1000);
            // The template is a constant; without it the bar shows less.
            if let Ok(style) = ProgressStyle::with_template("{bar:20} {msg}") {
                bar.set_style(style);
            }
            bar
        });
        Self { bar, quiet }
    }

    fn show(&mut self, progress: &Progress) {
        let message = describe_progress(progress);
        match (&self.bar, progress.ending) {
            (Some(bar), None) => {
                bar.set_position((1000.0 * progress.fraction.unwrap_or(0.0)) as u64);
                bar.set_message(message);
            }
            (Some(bar), Some(_)) => bar.println(message),
            (None, Some(_)) if !self.quiet => {
                let _ = writeln!(std::io::stderr(), "{message}");
            }
            (None, _) => {}
        }
    }

    fn close(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn describe_progress(progress: &Progress) -> String {
    let stage = format!("[{}/{}] {}", progress.number, progress.stages, progress.stage);
    let state = match (progress.ending, progress.remaining) {
        (Some(ending), _) => format!("{} after step {}", ending.text(), progress.steps),
        (None, Some(remaining)) => {
            format!("{:.0} steps/s, {} left", progress.steps_per_second, duration(remaining))
        }
        (None, None) => format!("{:.0} steps/s", progress.steps_per_second),
    };
    format!("{stage}: t = {:.4e} s, {state}, energy error {:.1e}", progress.time, progress.energy_error)
}

fn describe(summary: &RunSummary) -> String {
    let state =
        if summary.interrupted() { "interrupted; files are complete up to the last step" } else { "done" };
    let rate = summary.steps as f64 * summary.particles as f64 / summary.wall_clock.max(1e-9);
    let mut text = format!(
        "{state}: {} steps of {} particles in {} ({rate:.2e} particle-steps/s)\n",
        summary.steps,
        summary.particles,
        duration(summary.wall_clock)
    );
    text += &format!(
        "energy ledger: relative closing error {:.1e} at the end, {:.1e} at most\n",
        summary.energy_error, summary.energy_error_max
    );
    text += &format!("written to {}:\n", summary.folder.display());
    text += "  run.toml, timeseries.csv";
    if summary.folder.join("series.pvd").exists() {
        text += ", series.pvd (ParaView)";
    }
    for picture in &summary.pictures {
        if let Some(name) = picture.file_name() {
            text += &format!(", {}", name.to_string_lossy());
        }
    }
    text + "\n"
}
