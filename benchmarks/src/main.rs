//! The `pulvis-bench` command: the engine's speed on the workloads that other codes were timed on, and
//! that of each law's kernel.
#![allow(clippy::print_stdout, clippy::print_stderr)] // this is where text meets people

mod command;
mod failure;
mod kernels;
mod models;
mod observed;
mod ranks;
mod scaling;
mod timing;
mod workload;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let code = match command::Arguments::parse().execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    };
    ranks::finish();
    code
}
