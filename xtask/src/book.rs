//! `cargo xtask book`: the chapters of the laws from the catalogue, and the book where mdbook is installed.
//!
//! Every law has a page, with a picture of what its example does for each role that it plays. The pictures and their
//! scenarios are drawn by `pulvis laws NAME --plot`.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use pulvis_contact::catalogue::{Kind, LawEntry, Parameter, Role};
use pulvis_input::contact::entries;

use crate::Outcome;
use crate::process::{capture, pulvis, root, run, scratch, works};

/// Where the chapters stand.
fn source() -> PathBuf {
    root().join("docs/book/src")
}

/// Writes the chapters with their pictures and builds the book.
pub fn write() -> Outcome {
    let folder = source().join("laws");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    draw(&folder)?;
    for (name, text) in chapters(&folder)? {
        let path = source().join(name);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    if works(Command::new("mdbook").arg("--version")) {
        return run(Command::new("mdbook").arg("build").arg("docs/book").current_dir(root()));
    }
    println!("skipped: mdbook is not installed, the chapters are readable as they are in docs/book/src");
    Ok(())
}

/// Whether the chapters and pictures are what the catalogue and the program make of the laws.
pub fn check() -> Outcome {
    let drawn = scratch("laws")?;
    draw(&drawn)?;
    let mut wrong = Vec::new();
    for (name, text) in chapters(&drawn)? {
        if std::fs::read_to_string(source().join(&name)).unwrap_or_default() != text {
            wrong.push(name);
        }
    }
    for file in files(&drawn)? {
        let known = std::fs::read(source().join("laws").join(&file)).unwrap_or_default();
        if std::fs::read(drawn.join(&file)).map_err(|error| format!("{file}: {error}"))? != known {
            wrong.push(format!("laws/{file}"));
        }
    }
    if wrong.is_empty() {
        return Ok(());
    }
    Err(format!("out of date below docs/book/src, run `cargo xtask book`: {}", wrong.join(", ")))
}

/// The names of the files in a folder.
fn files(folder: &Path) -> Outcome<Vec<String>> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let names = std::fs::read_dir(folder)
        .map_err(failed)?
        .map(|file| file.map(|file| file.file_name().to_string_lossy().into_owned()).map_err(failed));
    names.collect()
}

/// Every law of the catalogue in each of its roles.
fn all() -> impl Iterator<Item = &'static LawEntry> {
    Role::ALL.into_iter().flat_map(entries)
}

/// Whether a law has a page of its own.
fn has_page(entry: &LawEntry) -> bool {
    entry.name != "none" && !matches!(entry.role, Role::Conventions | Role::Expected)
}

/// What the picture of a law in a role is called, without its ending.
fn stem(entry: &LawEntry) -> String {
    format!("{}-{}", entry.role.key(), entry.name)
}

/// Draws all pictures into a folder, with the scenarios that they are drawn from.
fn draw(folder: &Path) -> Outcome {
    let program = pulvis()?;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for entry in all().filter(|entry| has_page(entry)) {
        let path = |ending: &str| folder.join(stem(entry)).with_extension(ending);
        let mut command = Command::new(&program);
        command.args(["laws", entry.name, "--role", entry.role.key(), "--force"]);
        command.arg("--plot").arg(path("svg")).arg("--scenario").arg(path("toml"));
        let output = capture(&mut command)?;
        if !output.status.success() {
            return Err(format!("{}: {}", entry.name, String::from_utf8_lossy(&output.stderr)));
        }
    }
    Ok(())
}

/// The chapters below docs/book/src by their names: the list of laws, one page for each law, and the summary. The
/// scenarios of the pictures stand in the folder `drawn`.
fn chapters(drawn: &Path) -> Outcome<Vec<(String, String)>> {
    let mut chapters = vec![("laws.md".to_owned(), list())];
    let mut names: Vec<&str> = Vec::new();
    for entry in all().filter(|entry| has_page(entry)) {
        if !names.contains(&entry.name) {
            names.push(entry.name);
            chapters.push((format!("laws/{}.md", entry.name), page(entry.name, drawn)?));
        }
    }
    let summary = source().join("SUMMARY.md");
    let known =
        std::fs::read_to_string(&summary).map_err(|error| format!("{}: {error}", summary.display()))?;
    let others = known.lines().filter(|line| !line.contains("](laws/"));
    let mut text = String::new();
    for line in others {
        let _ = writeln!(text, "{line}");
        if line.contains("](laws.md)") {
            for name in &names {
                let _ = writeln!(text, "  - [{name}](laws/{name}.md)");
            }
        }
    }
    chapters.push(("SUMMARY.md".to_owned(), text));
    Ok(chapters)
}

/// The page of a law in all its roles.
fn page(name: &str, drawn: &Path) -> Outcome<String> {
    let mut text = format!("{WRITTEN}# `{name}`\n");
    for entry in all().filter(|entry| has_page(entry) && entry.name == name) {
        let _ = writeln!(text, "\n## {}", heading(entry.role));
        describe(&mut text, entry);
        let file = stem(entry);
        let path = drawn.join(&file).with_extension("toml");
        let scenario =
            std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let command = if entry.role == Role::Viscosity { "collide" } else { "probe" };
        let _ = writeln!(
            text,
            "\nWhat the example does, drawn by `pulvis {command}` from [this scenario]({file}.toml), which `pulvis laws \
             {name} --role {} --scenario FILE` writes:\n\n![{name}, {}]({file}.svg)\n\n```toml\n{}\n```",
            entry.role.key(),
            entry.role.key(),
            scenario.trim_end()
        );
    }
    Ok(text)
}

/// The head of what is written here.
const WRITTEN: &str = "<!-- Written by `cargo xtask book` from the catalogue of pulvis-contact. Changes belong into the laws' own files. -->\n";

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

/// The list of all laws, and what has no page of its own.
fn list() -> String {
    let mut text = format!(
        "{WRITTEN}# The laws\n\n\
         A contact is composed of one law of each role. `pulvis laws` prints this list, `pulvis laws NAME` one law in full, \
         `pulvis laws NAME --plot FILE.png` a picture of it. Each law has a page of its own.\n\n\
         | role | law | summary |\n| --- | --- | --- |\n",
    );
    for entry in all() {
        let link = if has_page(entry) {
            format!("[`{0}`](laws/{0}.md)", entry.name)
        } else {
            format!("`{}`", entry.name)
        };
        let _ = writeln!(text, "| `{}` | {link} | {} |", entry.role.key(), cell(entry.summary));
    }
    for entry in all().filter(|entry| entry.name != "none" && !has_page(entry)) {
        let _ = writeln!(text, "\n## {}", heading(entry.role));
        describe(&mut text, entry);
    }
    text
}

// Writing to a String cannot fail.
fn describe(text: &mut String, entry: &LawEntry) {
    let _ = writeln!(text, "\n{}.\n", capitalised(entry.summary));
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
        Kind::Number { .. } | Kind::Numbers { .. } => parameter.allowed(),
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
