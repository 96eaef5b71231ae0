//! `pulvis info`: what is in a checkpoint.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use pulvis_io::checkpoint::read_header;
use pulvis_lab::protocol::{checkpoint_files, size_in_words};

use crate::failure::{Failure, print};

/// Says what checkpoints hold and whether they are whole.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Checkpoint files, or folders of runs
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut refused = Vec::new();
    for path in &arguments.files {
        let files = if path.is_dir() { checkpoint_files(path) } else { vec![path.clone()] };
        if files.is_empty() {
            refused.push(Failure::bad_input(format!("there is no checkpoint in {}", path.display())));
        }
        for file in files {
            match describe(&file) {
                Ok(text) => print(&text)?,
                Err(failure) => refused.push(failure),
            }
        }
    }
    let Some(last) = refused.pop() else { return Ok(ExitCode::SUCCESS) };
    for failure in &refused {
        failure.report();
    }
    Err(last)
}

/// Lines of TOML.
fn describe(file: &Path) -> Result<String, Failure> {
    let header =
        read_header(file).map_err(|error| Failure::bad_input(format!("{} {error}", file.display())))?;
    let size = std::fs::metadata(file).map_or(0, |data| data.len());
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "# {}: a whole checkpoint of {}\n{header}\n", file.display(), size_in_words(size));
    Ok(text)
}
