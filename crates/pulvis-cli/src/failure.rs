//! How commands fail: a message on the standard error stream and an exit code.

use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;

/// Exit code of a command that the user stopped, as shells expect it (128 + SIGINT).
pub const INTERRUPTED: u8 = 130;

/// A failed command.
#[derive(Debug)]
pub struct Failure {
    message: String,
    code: u8,
}

impl Failure {
    /// The input is to blame: exit code 2.
    pub fn bad_input(message: impl Display) -> Self {
        Self { message: message.to_string(), code: 2 }
    }

    /// Something went wrong on the way: exit code 1.
    pub fn while_running(message: impl Display) -> Self {
        Self { message: message.to_string(), code: 1 }
    }

    /// The same, of a rank that is not the first.
    pub fn on_rank(self, rank: usize) -> Self {
        Self { message: format!("rank {rank}: {}", self.message), ..self }
    }

    /// The exit code, where somebody else prints the message.
    pub fn silent(&self) -> ExitCode {
        ExitCode::from(self.code)
    }

    /// Prints the message; answers with the exit code.
    pub fn report(&self) -> ExitCode {
        let text = self.message.trim_end();
        // Errors of the reader come with their own heading.
        let heading = if text.starts_with("error:") { "" } else { "error: " };
        // Nobody is left to be told if the standard error stream is closed.
        let _ = writeln!(io::stderr(), "{heading}{text}");
        ExitCode::from(self.code)
    }
}

/// Prints to the standard output; a reader that has gone away (`pulvis laws | head`) is no error.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::while_running(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}
