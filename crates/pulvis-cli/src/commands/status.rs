//! `pulvis status`: how far a run has come, from another shell.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use pulvis_lab::protocol::{ProgressRecord, RunPhase, RunStatus, run_status};

use super::words::duration;
use crate::failure::{Failure, print};

/// Says what a run is doing, how far it has come, how fast it is and how long its stage still takes. Nothing is changed.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Output folders of runs
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// Print JSON: an object, of several runs a list of objects with their folders
    #[arg(long)]
    json: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut found = Vec::new();
    for folder in &arguments.folders {
        found.push((folder.as_path(), run_status(folder).map_err(Failure::bad_input)?));
    }
    let text = match (&found[..], arguments.json) {
        ([(_, status)], true) => format!("{}\n", status.to_json()),
        (all, true) => {
            let items: Vec<String> = all.iter().map(|(folder, status)| with_folder(folder, status)).collect();
            format!("[\n{}\n]\n", items.join(",\n"))
        }
        (all, false) => {
            let texts: Vec<String> = all.iter().map(|(folder, status)| describe(folder, status)).collect();
            texts.join("\n")
        }
    };
    print(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// The object of one run among several.
fn with_folder(folder: &Path, status: &RunStatus) -> String {
    let name = folder.display().to_string().replace('\\', "\\\\").replace('"', "\\\"");
    status.to_json().replacen('{', &format!("{{\n  \"folder\": \"{name}\","), 1)
}

// Writing to a String cannot fail.
fn describe(folder: &Path, status: &RunStatus) -> String {
    let mut text = String::new();
    let process = status.process.map_or(String::new(), |process| format!(" (process {process})"));
    let _ = writeln!(text, "{}: {}{process}", folder.display(), words(status.state));
    if let Some(progress) = &status.progress {
        describe_progress(&mut text, progress, status.state == RunPhase::Running);
    }
    if let Some(wall_clock) = status.wall_clock {
        let _ = writeln!(text, "computed      {}", duration(wall_clock));
    }
    if let Some(silent) = status.silent {
        let _ = writeln!(text, "last sign     {} ago", duration(silent));
    }
    if let Some(checkpoint) = &status.checkpoint {
        let _ = writeln!(text, "checkpoint    {}", checkpoint.display());
    }
    if let Some(message) = &status.message {
        let _ = writeln!(text, "message       {message}");
    }
    if matches!(status.state, RunPhase::Interrupted | RunPhase::Killed) {
        let _ = writeln!(text, "go on with `pulvis run --resume {}`", folder.display());
    }
    text
}

fn describe_progress(text: &mut String, progress: &ProgressRecord, is_running: bool) {
    let ProgressRecord { stage, number, stages, time, step, particles, fraction, remaining, ending, .. } =
        progress;
    let done = match (ending, fraction) {
        (Some(ending), _) => format!(", {ending}"),
        (None, Some(fraction)) => format!(", {:.1} % done", 100.0 * fraction),
        (None, None) => String::new(),
    };
    let _ = writeln!(text, "stage         [{number}/{stages}] {stage}{done}");
    let _ = writeln!(text, "time          {time:.4e} s, step {step}");
    if let (Some(steps), Some(particle_steps)) =
        (progress.steps_per_second, progress.particle_steps_per_second)
    {
        let _ = writeln!(
            text,
            "speed         {steps:.0} steps/s of {particles} particles, {particle_steps:.2e} particle-steps/s"
        );
    }
    if let Some(remaining) = remaining.filter(|_| is_running) {
        let _ = writeln!(text, "estimate      {} left in this stage", duration(remaining));
    }
    let error = progress.energy_error.map_or("no number".to_owned(), |error| format!("{error:.1e}"));
    let _ = writeln!(text, "energy error  {error}");
}

fn words(state: RunPhase) -> &'static str {
    match state {
        RunPhase::Killed => "killed: its process has ended without a word",
        RunPhase::Unknown => "not ended; whether its process lives cannot be told on this file system",
        state => state.text(),
    }
}
