//! `cargo xtask book`: the table of laws from the catalogue, and the book where mdbook is installed.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;

use pulvis_contact::catalogue::{Kind, LawEntry, Parameter, Role};
use pulvis_input::contact::entries;

use crate::Outcome;
use crate::process::{root, run, works};

fn chapter() -> PathBuf {
    root().join("docs/book/src/laws.md")
}

/// Writes the chapter and builds the book.
pub fn write() -> Outcome {
    std::fs::write(chapter(), laws()).map_err(|error| format!("{}: {error}", chapter().display()))?;
    if works(Command::new("mdbook").arg("--version")) {
        return run(Command::new("mdbook").arg("build").arg("docs/book").current_dir(root()));
    }
    println!("skipped: mdbook is not installed, the chapters are readable as they are in docs/book/src");
    Ok(())
}

/// Whether the chapter is what the catalogue says.
pub fn check() -> Outcome {
    let known = std::fs::read_to_string(chapter()).unwrap_or_default();
    if known == laws() {
        Ok(())
    } else {
        Err("docs/book/src/laws.md is out of date; run `cargo xtask book`".to_owned())
    }
}

/// What a role is called in a heading.
fn heading(role: Role) -> &'static str {
    match role {
        Role::Normal => "Normal force while two bodies overlap",
        Role::NonContact => "Attraction at a distance",
        Role::Viscosity => "Dashpots along the line of centres",
        Role::Sliding => "Sliding",
        Role::Rolling => "Rolling",
        Role::Torsion => "Torsion",
        Role::Bond => "Bonds",
        Role::Conventions => "Conventions",
        Role::Expected => "What contacts are expected to go through",
    }
}

/// The chapter.
fn laws() -> String {
    let mut text = String::from(
        "<!-- Written by `cargo xtask book` from the catalogue of pulvis-contact. Changes belong into the laws' own files. -->\n\
         # The laws\n\n\
         A contact is composed of one law of each role. `pulvis laws` prints this list, `pulvis laws NAME` one law in full.\n\n\
         | role | law | summary |\n| --- | --- | --- |\n",
    );
    for entry in Role::ALL.into_iter().flat_map(entries) {
        let _ = writeln!(text, "| `{}` | `{}` | {} |", entry.role.key(), entry.name, cell(entry.summary));
    }
    for role in Role::ALL {
        let _ = writeln!(text, "\n## {}", heading(role));
        for entry in entries(role).into_iter().filter(|entry| entry.name != "none") {
            describe(&mut text, entry);
        }
    }
    text
}

// Writing to a String cannot fail.
fn describe(text: &mut String, entry: &LawEntry) {
    let _ = writeln!(text, "\n### `{}`\n\n{}.\n", entry.name, capitalised(entry.summary));
    let _ = writeln!(text, "```text\n{}\n```\n", entry.equations);
    let _ = writeln!(
        text,
        "| parameter | symbol | unit | allowed | default | meaning |\n| --- | --- | --- | --- | --- | --- |"
    );
    for parameter in entry.parameters {
        let _ = writeln!(text, "{}", row(parameter));
    }
    for parameter in entry.parameters {
        let Kind::Choice(options) = parameter.kind else { continue };
        let _ = writeln!(text, "\nChoices of `{}`:\n", parameter.name);
        for option in options {
            let _ = writeln!(text, "- `\"{}\"`: {}", option.name, option.meaning);
        }
    }
    for quantity in entry.particle_quantities {
        let (name, unit, allowed) = (quantity.name, quantity.unit(), quantity.allowed());
        let _ =
            writeln!(text, "\nReads `{name}` of each particle [{unit}]: {}, {allowed}.", quantity.meaning);
    }
    if !entry.memory.is_empty() {
        let _ = writeln!(text, "\nMemory of a contact: {}.", entry.memory.join(", "));
    }
    let _ = writeln!(text, "\nVerified against: {}.", entry.closed_form);
    let _ = writeln!(text, "\nSource: {}.", entry.source);
    let _ = writeln!(text, "\n```toml\n[contacts.grain-grain.{}]\n{}\n```", entry.role.key(), entry.example);
}

fn row(parameter: &Parameter) -> String {
    let Parameter { name, symbol, meaning, .. } = parameter;
    let allowed = match parameter.kind {
        Kind::Choice(_) => "see below".to_owned(),
        Kind::Number { .. } => parameter.allowed(),
    };
    let cells =
        [&format!("`{name}`"), *symbol, &parameter.unit(), &allowed, &parameter.default_text(), *meaning]
            .map(cell);
    format!("| {} |", cells.join(" | "))
}

/// Text that does not end its cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

fn capitalised(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or_else(String::new, |first| first.to_uppercase().chain(characters).collect())
}
