//! `pulvis view`: the laboratory and a run in the browser.

use std::io::IsTerminal;
use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;
use std::process::{Command, ExitCode, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use pulvis_view::{ViewError, Viewer};

use crate::failure::{Failure, print};

/// Serves a page for the browser: a laboratory of contact laws, and the frames of a run, also while it goes on.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Folder of a run; without it, the laboratory alone
    run: Option<PathBuf>,
    /// Port [default: 8017, or the next free one]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    port: Option<u16>,
    /// Address at which others may open the page, too: all of them need the token that is printed. What is sent is not
    /// encrypted [default: 127.0.0.1, this machine alone]
    #[arg(long, value_name = "ADDRESS")]
    address: Option<IpAddr>,
    /// Do not open the browser
    #[arg(long)]
    no_open: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let address = arguments.address.unwrap_or(IpAddr::V4(Ipv4Addr::LOCALHOST));
    let viewer = Viewer::listen(arguments.run.as_deref(), address, arguments.port).map_err(refused)?;
    let stop = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&stop);
    ctrlc::set_handler(move || handler.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::while_running(format!("cannot listen for Ctrl-C: {error}")))?;
    print(&format!("{}\nCtrl-C ends it\n", viewer.url()))?;
    if !arguments.no_open && std::io::stdout().is_terminal() {
        open(viewer.url());
    }
    viewer.serve(&stop);
    Ok(ExitCode::SUCCESS)
}

pub fn refused(error: ViewError) -> Failure {
    if error.is_bad_input() { Failure::bad_input(error) } else { Failure::while_running(error) }
}

/// Asks the system for its browser. Where there is none, the address has been printed.
fn open(url: &str) {
    let (program, first): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("cmd", &["/C", "start", ""])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command.args(first).arg(url).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let _ = command.spawn();
}
