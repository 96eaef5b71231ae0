//! `pulvis analyze`: coarse-grained fields of a run.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use clap::builder::PossibleValuesParser;
use pulvis_input::{Dimension, QuantityRule, parse_quantity};
use pulvis_lab::analysis::{AnalysisError, AnalysisPlan, Kernel, analyse};
use pulvis_lab::rendering::FrameChoice;

use crate::failure::{Failure, print};

/// Spreads the particles and contacts of a run over a grid: density, momentum, velocity, stress and fabric as VTK images and
/// tables, with profiles along an axis if asked. Sums over the grid are those of the sample.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Output folder of a run, or a checkpoint
    run: PathBuf,
    /// Which frames: a number from 0, `last` or `all`
    #[arg(long, value_name = "N|last|all", default_value = "last")]
    frame: FrameChoice,
    /// How a point is spread
    #[arg(long, default_value = "lucy", value_parser = PossibleValuesParser::new(Kernel::ALL.map(|(name, _)| name)))]
    kernel: String,
    /// Width of the kernel: where Lucy's ends, the standard deviation of the Gaussian; "2 mm" [default: twice the mean radius]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    width: Option<f64>,
    /// Edge of a cell [default: half the width]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    cell: Option<f64>,
    /// Profiles along an axis, means over the cells across it
    #[arg(long, value_name = "AXIS", value_parser = ["x", "y", "z"])]
    profile: Option<String>,
    /// Folder of the results [default: `analysis` in the folder of the run]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Write over the files of an analysis that is there
    #[arg(long)]
    force: bool,
}

/// A length such as "2 mm".
fn length(text: &str) -> Result<f64, String> {
    parse_quantity(text, QuantityRule::of(Dimension::LENGTH).above(0.0)).map_err(|error| error.to_string())
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let kernel = Kernel::ALL.into_iter().find(|(name, _)| *name == arguments.kernel);
    let plan = AnalysisPlan {
        frames: arguments.frame,
        kernel: kernel.map_or(Kernel::Lucy, |(_, kernel)| kernel),
        width: arguments.width,
        cell: arguments.cell,
        profile: arguments
            .profile
            .as_deref()
            .and_then(|axis| ["x", "y", "z"].iter().position(|one| *one == axis)),
    };
    let of_run =
        if arguments.run.is_file() { arguments.run.with_extension("") } else { arguments.run.clone() };
    let folder = arguments.output.clone().unwrap_or_else(|| match arguments.run.is_file() {
        true => of_run.with_file_name("analysis"),
        false => of_run.join("analysis"),
    });
    let analysis = analyse(&arguments.run, &plan, &folder, arguments.force).map_err(refused)?;
    let [x, y, z] = analysis.counts;
    let mut text =
        format!("{} kernel of width {:.4e} m on {x} x {y} x {z} cells\n", arguments.kernel, analysis.width);
    for file in &analysis.files {
        text += &format!("{}\n", file.display());
    }
    print(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn refused(error: AnalysisError) -> Failure {
    if error.is_bad_input() { Failure::bad_input(error) } else { Failure::while_running(error) }
}
