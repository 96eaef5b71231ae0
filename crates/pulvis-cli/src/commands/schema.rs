//! `pulvis schema`: what editors know of scenario files.

use std::process::ExitCode;

use clap::Args;
use clap::builder::PossibleValuesParser;
use pulvis_input::schema::{FileKind, schema};

use crate::failure::{Failure, print};

/// Prints the JSON schema of a kind of file. Editors with a TOML plug-in (Even Better TOML, taplo) complete keys, show their
/// meaning and mark mistakes with it: begin a file with `#:schema ./scenario.schema.json`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Which files: those of `run`, `collide`, `probe` or `study`
    #[arg(default_value = "scenario", value_parser = PossibleValuesParser::new(FileKind::ALL.map(|(name, _)| name)))]
    kind: String,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let found = FileKind::ALL.into_iter().find(|(name, _)| *name == arguments.kind);
    let (_, kind) = found.ok_or_else(|| Failure::bad_input(format!("no file is a `{}`", arguments.kind)))?;
    // Indented, for those who look into it.
    print(&format!("{:#}\n", schema(kind)))?;
    Ok(ExitCode::SUCCESS)
}
