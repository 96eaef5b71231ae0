//! The `pulvis` command: a front door without physics.
#![allow(clippy::print_stdout, clippy::print_stderr)] // this is where text meets people

mod commands;
mod failure;
mod ranks;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use commands::Command;

/// Discrete element method for adhesive, elasto-plastic meso-particles.
#[derive(Debug, Parser)]
#[command(
    name = "pulvis",
    version,
    about,
    after_help = "Exit codes: 0 done, 1 failed while running, 2 bad input, 130 interrupted."
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// The whole command line, for what is made of its description.
pub(crate) fn command_line() -> clap::Command {
    Arguments::command()
}

fn main() -> ExitCode {
    let code = match Arguments::parse().command.execute() {
        Ok(code) => code,
        Err(failure) => failure.report(),
    };
    ranks::finish();
    code
}
