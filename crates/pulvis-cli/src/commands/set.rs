//! `--set KEY=VALUE`: values of a scenario from the command line.

use clap::Args;
use pulvis_input::Replacement;

/// The values to replace.
#[derive(Debug, Args)]
pub struct Settings {
    /// Replace a value of the scenario, for example contact.normal.kc="50 N/m" or stages[0].until.time="1 ms"
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = replacement)]
    pub pairs: Vec<(String, Replacement)>,
}

/// `key=value` of the command line.
fn replacement(text: &str) -> Result<(String, Replacement), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() && !value.trim().is_empty() => {
            Ok((key.trim().to_owned(), Replacement::parse(value)))
        }
        _ => Err("expected KEY=VALUE, for example contact.normal.kc=\"50 N/m\"".to_owned()),
    }
}
