//! `pulvis verify`: the contact laws against values that are not theirs.

use std::process::ExitCode;

use clap::Args;
use pulvis_input::Problem;
use pulvis_lab::verification::{Check, verification_table, verified_laws, verify};

use crate::failure::{Failure, print};

/// Significant digits of the table on the screen; CSV and JSON hold all.
const DIGITS: usize = 7;

/// Checks contact laws against closed forms, published numbers and values of another program.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Names of laws; without them, all laws are checked
    laws: Vec<String>,
    /// How the table of checks is written; csv and json also say why an error is allowed, and where a value is from
    #[arg(long, value_parser = ["text", "csv", "json"], default_value = "text")]
    format: String,
    /// Multiply every tolerance: with less than 1 it shows which checks have little to spare
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = factor)]
    tolerance_factor: f64,
}

fn factor(text: &str) -> Result<f64, String> {
    let factor: f64 = text.parse().map_err(|_| "expected a number".to_owned())?;
    if factor >= 0.0 && factor.is_finite() {
        Ok(factor)
    } else {
        Err("expected a number of at least 0".to_owned())
    }
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let known = verified_laws();
    let chosen: Vec<&str> = match arguments.laws[..] {
        [] => known.clone(),
        _ => arguments.laws.iter().map(String::as_str).collect(),
    };
    for law in &chosen {
        if !known.contains(law) {
            return Err(unknown(law, &known));
        }
    }
    let mut checks: Vec<Check> = chosen.into_iter().flat_map(verify).collect();
    checks.iter_mut().for_each(|check| check.tolerance *= arguments.tolerance_factor);
    print(&shown(&checks, &arguments.format)?)?;
    let missed = checks.iter().any(|check| !check.passes());
    Ok(if missed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn unknown(law: &str, known: &[&str]) -> Failure {
    Failure::bad_input(format!(
        "{}\n  help: these laws have checks; `pulvis laws` lists all",
        Problem::unknown_choice(law, known)
    ))
}

/// The checks in a format of the table writer; in `text`, rounded, with a last line that counts them.
fn shown(checks: &[Check], format: &str) -> Result<String, Failure> {
    let text = format == "text";
    let table = verification_table(checks, text).map_err(Failure::while_running)?;
    if !text {
        let format = pulvis_io::table::format(format).map_err(Failure::bad_input)?;
        return table.to_string(format).map_err(Failure::while_running);
    }
    let missed: Vec<&Check> = checks.iter().filter(|check| !check.passes()).collect();
    let mut lines = format!("all quantities in SI units\n\n{}\n", table.to_text(DIGITS));
    for check in &missed {
        let Check { law, quantity, case, source, .. } = check;
        lines.push_str(&format!("MISS {law}: {quantity}, {case}; expected by {source}\n"));
    }
    lines.push_str(&format!("{} of {} checks missed\n", missed.len(), checks.len()));
    Ok(lines)
}
