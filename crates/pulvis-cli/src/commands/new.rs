//! `pulvis new`: a commented file to begin with.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::failure::{Failure, print};

/// Writes a commented scenario to begin with, or lists those that there are.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The file to write; `.toml` is added where it is missing
    #[arg(required_unless_present = "list")]
    name: Option<PathBuf>,
    /// What to begin with
    #[arg(long, value_name = "TEMPLATE", default_value = "tablet", value_parser = PossibleValuesParser::new(TEMPLATES.iter().map(|template| template.name)))]
    from: String,
    /// List the templates and write nothing
    #[arg(long)]
    list: bool,
}

/// A file to begin with. Its first line tells in a sentence what it does.
struct Template {
    name: &'static str,
    /// The command that it is for.
    command: &'static str,
    text: &'static str,
}

macro_rules! templates {
    ($($name:literal for $command:literal),* $(,)?) => {
        &[$(Template { name: $name, command: $command, text: include_str!(concat!("../../templates/", $name, ".toml")) }),*]
    };
}

// A new template is its file and its name here.
const TEMPLATES: &[Template] = templates![
    "pair" for "collide",
    "probe" for "probe",
    "tablet" for "run",
    "compression" for "run",
    "shear" for "run",
    "oedometer" for "run",
    "drum" for "run",
    "hopper" for "run",
    "heap" for "run",
    "chute" for "run",
    "cold-spray" for "run",
    "aggregates" for "run",
];

impl Template {
    fn summary(&self) -> &'static str {
        self.text.lines().next().unwrap_or_default().trim_start_matches("# ")
    }

    /// The text with the name of the file in the commands that it shows.
    fn named(&self, stem: &str) -> String {
        self.text.replace("NAME.toml", &format!("{stem}.toml")).replace("NAME", stem)
    }
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let Some(name) = arguments.name.as_ref().filter(|_| !arguments.list) else {
        let rows =
            TEMPLATES.iter().map(|one| format!("{:<12} {:<8} {}\n", one.name, one.command, one.summary()));
        print(&format!("{:<12} {:<8} what it does\n{}", "template", "for", rows.collect::<String>()))?;
        return Ok(ExitCode::SUCCESS);
    };
    let Some(template) = TEMPLATES.iter().find(|template| template.name == arguments.from) else {
        return Err(Failure::bad_input(format!("there is no template `{}`", arguments.from)));
    };
    let path = with_ending(name);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    write(&path, &template.named(&stem))?;
    let shown = path.display();
    let next = match template.command {
        "run" => format!("pulvis check {shown}\n  pulvis run {shown}"),
        command => format!("pulvis {command} {shown} --plot {stem}.png"),
    };
    print(&format!("written to {shown}: {}\nnext:\n  {next}\n", template.summary()))?;
    Ok(ExitCode::SUCCESS)
}

fn with_ending(name: &Path) -> PathBuf {
    match name.extension() {
        Some(ending) if ending == "toml" => name.to_owned(),
        _ => {
            let mut name = name.as_os_str().to_owned();
            name.push(".toml");
            name.into()
        }
    }
}

/// Writes a file that must not exist yet.
fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let refuse = |what: String| Failure::bad_input(format!("{}: {what}", path.display()));
    let mut file = OpenOptions::new().write(true).create_new(true).open(path).map_err(|error| {
        refuse(match error.kind() {
            ErrorKind::AlreadyExists => "exists already and is kept; choose another name".to_owned(),
            _ => format!("cannot be written: {error}"),
        })
    })?;
    file.write_all(text.as_bytes()).map_err(|error| refuse(format!("cannot be written: {error}")))
}
