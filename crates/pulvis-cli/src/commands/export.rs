//! `pulvis export`: a run as one page that works from disk.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::picture_file::exists;
use super::view::refused;
use crate::failure::{Failure, print};

/// Writes the frames of a run into one HTML file, which shows them as `pulvis view` does, without a server.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Folder of a run
    run: PathBuf,
    /// The file; of a large run some frames are left out, then contacts, then particles
    #[arg(long, value_name = "FILE.html")]
    html: PathBuf,
    /// Write over a file that exists
    #[arg(long)]
    force: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let Arguments { run, html, force } = arguments;
    if html.exists() && !force {
        return Err(exists(html));
    }
    let written = pulvis_view::export(run, html).map_err(refused)?;
    let megabytes = written.bytes as f64 / 1e6;
    let mut text = format!(
        "{}: {} of {} frames, {megabytes:.1} MB\n",
        html.display(),
        written.frames,
        written.frames_of_run
    );
    if written.one_of > 1 {
        text += &format!("of the particles one of {} is shown\n", written.one_of);
    }
    print(&text)?;
    Ok(ExitCode::SUCCESS)
}
