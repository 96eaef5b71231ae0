//! `pulvis man`: manual pages, made of the same descriptions as `--help`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Command};
use pulvis_io::checkpoint::write_text;

use crate::failure::{Failure, print};

/// Prints the manual page of the program, or of a command, as roff: `pulvis man run | man -l -`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Command whose page is printed
    #[arg(conflicts_with = "directory")]
    command: Option<String>,
    /// Write the pages of the program and of all commands into this folder, which exists
    #[arg(long, value_name = "DIR")]
    directory: Option<PathBuf>,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut program = crate::command_line();
    // Fills in what `--help` shows of every command.
    program.build();
    if let Some(folder) = &arguments.directory {
        if !folder.is_dir() {
            let problem = format!("{}: there is no such folder; make it first", folder.display());
            return Err(Failure::bad_input(problem));
        }
        for (name, page) in pages(&program)? {
            write_text(&folder.join(format!("{name}.1")), &page).map_err(Failure::while_running)?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let page = match &arguments.command {
        None => page(&program)?,
        Some(name) => {
            let found = program.get_subcommands().find(|command| command.get_name() == name);
            let command = found.ok_or_else(|| {
                let known: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
                let known = known.join(", ");
                Failure::bad_input(format!("there is no command `{name}`; expected one of: {known}"))
            })?;
            page(command)?
        }
    };
    print(&page)?;
    Ok(ExitCode::SUCCESS)
}

/// The pages of the program and of all its commands, by their names.
fn pages(program: &Command) -> Result<Vec<(String, String)>, Failure> {
    let commands = program.get_subcommands().filter(|command| command.get_name() != "help");
    std::iter::once(program)
        .chain(commands)
        .map(|command| {
            let name = command.get_display_name().unwrap_or(command.get_name());
            Ok((name.to_owned(), page(command)?))
        })
        .collect()
}

fn page(command: &Command) -> Result<String, Failure> {
    let mut roff = Vec::new();
    let command = command.clone().version(env!("CARGO_PKG_VERSION"));
    clap_mangen::Man::new(command).render(&mut roff).map_err(Failure::while_running)?;
    Ok(String::from_utf8_lossy(&roff).into_owned())
}
