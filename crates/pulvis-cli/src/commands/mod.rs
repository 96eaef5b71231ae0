//! One file a command; the list is here.

mod allow;
mod analyze;
mod check;
mod collide;
mod completions;
mod explain;
mod export;
mod info;
mod laws;
mod machine;
mod man;
mod new;
mod picture_file;
mod plot;
mod probe;
mod progress;
mod regime;
mod render;
mod reproduce;
mod run;
mod schema;
mod set;
mod status;
mod study;
mod study_progress;
mod verify;
mod view;
mod words;

use std::process::ExitCode;

use clap::Subcommand;

use crate::failure::Failure;

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Writes a commented scenario to begin with
    New(new::Arguments),
    /// Checks a scenario and says what the run will be like, without running it
    Check(check::Arguments),
    /// Runs the stages of a scenario
    Run(run::Arguments),
    /// Says how far a run has come, from another shell
    Status(status::Arguments),
    /// Draws columns of a run's time series over time, in the terminal or as a picture
    Plot(plot::Arguments),
    /// Draws the particles of a run, with or without their contacts, as pictures or as a film
    Render(render::Arguments),
    /// Spreads particles and contacts of a run over a grid: density, velocity, stress, fabric
    Analyze(analyze::Arguments),
    /// Opens a laboratory of contact laws, and a run, in the browser
    View(view::Arguments),
    /// Writes a run as one HTML file that shows it without a server
    Export(export::Arguments),
    /// Says what checkpoints of runs hold, and whether they are whole
    Info(info::Arguments),
    /// Says what stopped a run, and what it was like before
    Explain(explain::Arguments),
    /// Collides two bodies, over a sweep of velocities, angles, spins or law parameters
    Collide(collide::Arguments),
    /// Leads a contact along a prescribed path, as an indenter does
    Probe(probe::Arguments),
    /// Lists the contact laws, or describes one in full
    Laws(laws::Arguments),
    /// Runs a scenario over seeds and values, in parallel, and holds the means against what is expected
    Study(study::Arguments),
    /// Computes figures of papers anew, holds them against theory, and writes a report
    Reproduce(reproduce::Arguments),
    /// Checks contact laws against closed forms, published numbers and values of another program
    Verify(verify::Arguments),
    /// Prints the JSON schema of a kind of file, for completion and hover texts in editors
    Schema(schema::Arguments),
    /// Prints the completions of a shell
    Completions(completions::Arguments),
    /// Prints the manual page of the program, or of a command
    Man(man::Arguments),
}

impl Command {
    /// Does it.
    pub fn execute(&self) -> Result<ExitCode, Failure> {
        match self {
            Self::New(arguments) => new::execute(arguments),
            Self::Check(arguments) => check::execute(arguments),
            Self::Run(arguments) => run::execute(arguments),
            Self::Render(arguments) => render::execute(arguments),
            Self::Analyze(arguments) => analyze::execute(arguments),
            Self::View(arguments) => view::execute(arguments),
            Self::Export(arguments) => export::execute(arguments),
            Self::Info(arguments) => info::execute(arguments),
            Self::Explain(arguments) => explain::execute(arguments),
            Self::Collide(arguments) => collide::execute(arguments),
            Self::Probe(arguments) => probe::execute(arguments),
            Self::Laws(arguments) => laws::execute(arguments),
            Self::Study(arguments) => study::execute(arguments),
            Self::Reproduce(arguments) => reproduce::execute(arguments),
            Self::Verify(arguments) => verify::execute(arguments),
            Self::Status(arguments) => status::execute(arguments),
            Self::Plot(arguments) => plot::execute(arguments),
            Self::Schema(arguments) => schema::execute(arguments),
            Self::Completions(arguments) => completions::execute(arguments),
            Self::Man(arguments) => man::execute(arguments),
        }
    }
}
