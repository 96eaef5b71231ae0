//! `pulvis explain`: why a run went wrong.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use pulvis_lab::protocol::explain;

use crate::failure::{Failure, print};

/// Says what stopped a run: the alarm and its likely cause, the last rows before it, the deepest contacts, and the forces on
/// the particles concerned.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Output folder of the run
    folder: PathBuf,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let explanation = explain(&arguments.folder).map_err(Failure::bad_input)?;
    print(&explanation.to_string())?;
    Ok(ExitCode::SUCCESS)
}
