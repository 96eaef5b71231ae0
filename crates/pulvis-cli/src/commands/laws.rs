//! `pulvis laws`: the catalogue.

use std::fmt::Write;
use std::process::ExitCode;

use clap::Args;
use pulvis_contact::catalogue::{Kind, LawEntry, Role};
use pulvis_input::Problem;
use pulvis_input::contact::entries;
use pulvis_io::table::{Cell, Table};

use crate::failure::{Failure, print};

/// Lists the contact laws, or describes one in full.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Name of a law; without it, all laws are listed
    law: Option<String>,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let text = match &arguments.law {
        None => list()?,
        Some(name) => {
            let found: Vec<_> = all().into_iter().filter(|entry| entry.name == name).collect();
            if found.is_empty() {
                return Err(unknown(name));
            }
            let mut texts = Vec::new();
            for (number, entry) in found.iter().enumerate() {
                // A law that plays several roles has the same text in each but for its table.
                texts.push(describe(entry, number == 0)?);
            }
            texts.join("\n")
        }
    };
    print(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn all() -> Vec<&'static LawEntry> {
    Role::ALL.into_iter().flat_map(entries).collect()
}

fn unknown(name: &str) -> Failure {
    let mut names: Vec<&str> = all().iter().map(|entry| entry.name).collect();
    names.dedup();
    names.sort_unstable();
    names.dedup();
    Failure::bad_input(format!(
        "{}\n  help: `pulvis laws` lists all laws",
        Problem::unknown_choice(name, &names)
    ))
}

fn list() -> Result<String, Failure> {
    let mut table = Table::new(["role", "law", "parameters", "summary"]);
    for entry in all() {
        let names: Vec<_> = entry.parameters.iter().map(|parameter| parameter.name).collect();
        let row = [entry.role.key(), entry.name, &names.join(", "), entry.summary].map(Cell::from);
        table.push(row).map_err(Failure::while_running)?;
    }
    Ok(format!("{}\n`pulvis laws NAME` describes a law in full.\n", table.to_text(6)))
}

/// One law in full.
fn describe(entry: &LawEntry, whole: bool) -> Result<String, Failure> {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{} ({} law)\n  {}", entry.name, entry.role.key(), entry.summary);
    if whole {
        let _ = writeln!(text, "\nEquations\n{}", indented(entry.equations));
    }
    if !entry.parameters.is_empty() {
        let _ = writeln!(text, "\nParameters\n{}", indented(&parameters(entry)?));
    }
    for parameter in entry.parameters {
        if let Kind::Choice(options) = parameter.kind {
            let _ = writeln!(text, "\n{}", parameter.name);
            for option in options {
                let _ = writeln!(text, "  {:<16} {}", option.name, option.meaning);
            }
        }
    }
    for quantity in entry.particle_quantities {
        let allowed = quantity.allowed();
        let _ = writeln!(
            text,
            "\nReads of each particle\n  {} [{}]  {}, {allowed}",
            quantity.name,
            quantity.unit(),
            quantity.meaning
        );
    }
    let memory = if entry.memory.is_empty() { "none".to_owned() } else { entry.memory.join(", ") };
    let _ = writeln!(text, "\nMemory of a contact\n  {memory}");
    let _ = writeln!(text, "\nVerified against\n  {}", entry.closed_form);
    let _ = writeln!(text, "\nSource\n  {}", entry.source);
    let _ = writeln!(text, "\nExample\n  [contact.{}]\n{}", entry.role.key(), indented(entry.example));
    Ok(text)
}

fn parameters(entry: &LawEntry) -> Result<String, Failure> {
    let mut table = Table::new(["name", "symbol", "unit", "range", "default", "meaning"]);
    for parameter in entry.parameters {
        let row = [
            parameter.name.to_owned(),
            parameter.symbol.to_owned(),
            parameter.unit(),
            parameter.allowed(),
            parameter.default_text(),
            parameter.meaning.to_owned(),
        ];
        table.push(row.map(Cell::from)).map_err(Failure::while_running)?;
    }
    Ok(table.to_text(6))
}

fn indented(text: &str) -> String {
    let lines: Vec<String> = text.lines().map(|line| format!("  {line}").trim_end().to_owned()).collect();
    lines.join("\n")
}
