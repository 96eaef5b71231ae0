//! `pulvis laws`: the catalogue.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use pulvis_contact::catalogue::{Kind, LawEntry, Role};
use pulvis_input::Problem;
use pulvis_input::contact::entries;
use pulvis_io::table::{Cell, Table};
use pulvis_lab::portrait::portrait;

use super::picture_file;
use crate::failure::{Failure, print};

/// Lists the contact laws, or describes one in full.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Name of a law; without it, all laws are listed
    law: Option<String>,
    /// Draw what the example of the law does
    #[arg(long, value_name = "FILE.png|svg", requires = "law")]
    plot: Option<PathBuf>,
    /// Write the scenario of that picture: a file for `pulvis probe`, of dashpots for `pulvis collide`
    #[arg(long, value_name = "FILE.toml", requires = "law")]
    scenario: Option<PathBuf>,
    /// Of a law that plays several roles, the role to be drawn; the first one if it is left out
    #[arg(long, requires = "law")]
    role: Option<String>,
    /// Write over files that exist
    #[arg(long)]
    force: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let Some(name) = &arguments.law else {
        print(&list()?)?;
        return Ok(ExitCode::SUCCESS);
    };
    let found: Vec<_> = all().into_iter().filter(|entry| entry.name == name).collect();
    if found.is_empty() {
        return Err(unknown(name));
    }
    if arguments.plot.is_some() || arguments.scenario.is_some() {
        let drawn = in_role(&found, arguments.role.as_deref())?;
        draw(drawn, arguments)?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut texts = Vec::new();
    for (number, entry) in found.iter().enumerate() {
        // A law that plays several roles has the same text in each but for its table.
        texts.push(describe(entry, number == 0)?);
    }
    print(&texts.join("\n"))?;
    Ok(ExitCode::SUCCESS)
}

/// The one of a law's entries that is for the role of this name.
fn in_role(found: &[&'static LawEntry], role: Option<&str>) -> Result<&'static LawEntry, Failure> {
    let keys: Vec<&str> = found.iter().map(|entry| entry.role.key()).collect();
    let wanted = match role {
        None => found.first(),
        Some(role) => found.iter().find(|entry| entry.role.key() == role),
    };
    wanted.copied().ok_or_else(|| {
        let role = role.unwrap_or_default();
        Failure::bad_input(format!("the law plays no role `{role}`; it plays: {}", keys.join(", ")))
    })
}

/// Writes the picture of a law, and its scenario.
fn draw(entry: &LawEntry, arguments: &Arguments) -> Result<(), Failure> {
    if let Some(file) = &arguments.plot {
        picture_file::check(file, arguments.force)?;
    }
    if let Some(file) = arguments.scenario.as_ref().filter(|file| file.exists() && !arguments.force) {
        return Err(picture_file::exists(file));
    }
    let Some(portrait) = portrait(entry).map_err(Failure::while_running)? else {
        let (name, role) = (entry.name, entry.role.key());
        return Err(Failure::bad_input(format!("`{name}` ({role}) has no forces that could be drawn")));
    };
    let mut text = String::new();
    if let Some(file) = &arguments.plot {
        portrait.figure.write(file).map_err(Failure::while_running)?;
        let _ = writeln!(text, "{}: what the example of `{}` does", file.display(), entry.name);
    }
    let command = format!("pulvis {}", portrait.command);
    if let Some(file) = &arguments.scenario {
        std::fs::write(file, &portrait.scenario)
            .map_err(|error| Failure::while_running(format!("{}: {error}", file.display())))?;
        let _ = writeln!(text, "{}: the scenario of the picture, for `{command}`", file.display());
    } else {
        let _ = writeln!(text, "drawn by `{command}` from:\n\n{}", indented(&portrait.scenario));
    }
    print(&text)
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
    Ok(format!(
        "{}\n`pulvis laws NAME` describes a law in full, `pulvis laws NAME --plot FILE.png` draws it.\n",
        table.to_text(6)
    ))
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
