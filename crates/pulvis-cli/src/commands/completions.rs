//! `pulvis completions`: what shells complete.

use std::process::ExitCode;

use clap::Args;
use clap_complete::{Shell, generate};

use crate::failure::{Failure, print};

/// Prints the completions of a shell. For bash: `pulvis completions bash > ~/.local/share/bash-completion/completions/pulvis`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut crate::command_line(), "pulvis", &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(ExitCode::SUCCESS)
}
