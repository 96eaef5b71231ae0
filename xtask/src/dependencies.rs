//! Licences, bans and sources of dependencies, by `deny.toml`.

use crate::Outcome;
use crate::process::{cargo, run, works};

/// `cargo deny`, where it is installed.
pub fn check() -> Outcome {
    if !works(&mut cargo(&["deny", "--version"])) {
        println!(
            "skipped: cargo-deny is not installed, licences and sources of dependencies are not looked at"
        );
        return Ok(());
    }
    run(&mut cargo(&["deny", "check", "licenses", "bans", "sources"]))
}
