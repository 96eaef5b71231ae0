//! `pulvis probe`: one contact on a prescribed path.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use pulvis_input::probe::ProbeScenario;
use pulvis_lab::probe::{ProbeCurve, figure, probe, result_table, summary_table};

use super::picture_file;
use super::set::Settings;
use crate::failure::{Failure, print};

/// Significant digits of the table on the screen; CSV and JSON hold all.
const DIGITS: usize = 5;

/// Leads a contact along a prescribed path of overlap, shear, roll and twist.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Probe scenarios (TOML); several are drawn into one picture
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// How the table is written; `text` shows turning points and changes of branch only
    #[arg(long, value_parser = ["text", "csv", "json"], default_value = "text")]
    format: String,
    /// Draw forces over displacements
    #[arg(long, value_name = "FILE.png|svg")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    resolution: picture_file::Resolution,
    #[command(flatten)]
    set: Settings,
    /// Write over a picture that exists
    #[arg(long)]
    force: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if let Some(file) = &arguments.plot {
        picture_file::check(file, arguments.force)?;
    }
    let load = |file: &PathBuf| ProbeScenario::load(file, &arguments.set.pairs).map_err(Failure::bad_input);
    let scenarios = arguments.files.iter().map(load).collect::<Result<Vec<_>, _>>()?;
    let mut curves = Vec::new();
    for (file, scenario) in arguments.files.iter().zip(&scenarios) {
        let computed = probe(scenario).map_err(Failure::while_running)?;
        curves.extend(named(file, computed, scenarios.len() > 1));
    }
    if let Some(file) = &arguments.plot {
        let title = match scenarios.as_slice() {
            [scenario] => scenario.title.as_deref(),
            _ => None,
        };
        figure(title, &curves).dpi(arguments.resolution.dpi).write(file).map_err(Failure::while_running)?;
    }
    print(&results(&curves, &arguments.format)?)?;
    Ok(ExitCode::SUCCESS)
}

/// Curves of one file, which carry its name where there are other files.
fn named(file: &Path, curves: Vec<ProbeCurve>, several: bool) -> Vec<ProbeCurve> {
    if !several {
        return curves;
    }
    let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let alone = curves.len() == 1;
    let rename = |curve: ProbeCurve| {
        let label = if alone { name.clone() } else { format!("{name}: {}", curve.label) };
        ProbeCurve { label, ..curve }
    };
    curves.into_iter().map(rename).collect()
}

/// The curves in a format of the table writer; in `text`, the instants that tell most, rounded.
fn results(curves: &[ProbeCurve], format: &str) -> Result<String, Failure> {
    if format == "text" {
        let table = summary_table(curves).map_err(Failure::while_running)?;
        let head = "turning points and changes of branch, all quantities in SI units";
        return Ok(format!("{head}\n\n{}", table.to_text(DIGITS)));
    }
    let format = pulvis_io::table::format(format).map_err(Failure::bad_input)?;
    let table = result_table(curves).map_err(Failure::while_running)?;
    table.to_string(format).map_err(Failure::while_running)
}
