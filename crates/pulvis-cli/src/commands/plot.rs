//! `pulvis plot`: columns of a run's time series.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use pulvis_lab::run_plot::{RunPlot, RunSeries};

use super::picture_file;
use crate::failure::{Failure, print};

/// Width and height of a chart where the terminal does not tell.
const SIZE: [usize; 2] = [80, 20];

/// Draws columns of a run's time series, also while it goes on: in the terminal, or into a picture.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Output folder of the run
    folder: PathBuf,
    /// Columns of timeseries.csv, or formulas of columns such as "kinetic/elastic"; those of one unit share a chart [default: kinetic elastic dissipated]
    #[arg(value_name = "QUANTITY")]
    quantities: Vec<String>,
    /// List the columns with meaning and unit, and draw nothing
    #[arg(long)]
    list: bool,
    /// What is drawn along the horizontal axis [default: time]
    #[arg(short, long, value_name = "QUANTITY")]
    x: Option<String>,
    /// Rows of one stage only, by its number or name
    #[arg(long)]
    stage: Option<String>,
    /// Logarithmic horizontal axis
    #[arg(long)]
    log_x: bool,
    /// Logarithmic vertical axes
    #[arg(long)]
    log_y: bool,
    /// Draw into a picture instead of the terminal
    #[arg(short, long, value_name = "FILE.png|svg")]
    output: Option<PathBuf>,
    #[command(flatten)]
    resolution: picture_file::Resolution,
    /// Write over a picture that exists
    #[arg(long)]
    force: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if let Some(file) = &arguments.output {
        picture_file::check(file, arguments.force)?;
    }
    let series = RunSeries::read(&arguments.folder).map_err(Failure::bad_input)?;
    if arguments.list {
        let line = |(name, meaning, unit)| format!("{name:<26} {unit:<6} {meaning}\n");
        print(&series.columns().map(line).collect::<String>())?;
        return Ok(ExitCode::SUCCESS);
    }
    let plot = RunPlot {
        quantities: arguments.quantities.clone(),
        abscissa: arguments.x.clone(),
        stage: arguments.stage.clone(),
        logarithmic: [arguments.log_x, arguments.log_y],
    };
    if let Some(file) = &arguments.output {
        let figure = series.figure(&plot).map_err(Failure::bad_input)?.dpi(arguments.resolution.dpi);
        figure.write(file).map_err(Failure::while_running)?;
        print(&format!("{}\n", file.display()))?;
        return Ok(ExitCode::SUCCESS);
    }
    let [width, height] = size();
    let charts = series.charts(&plot).map_err(Failure::bad_input)?;
    let texts: Vec<String> = charts.iter().map(|chart| chart.to_text(width, height, has_colours())).collect();
    print(&texts.join("\n"))?;
    Ok(ExitCode::SUCCESS)
}

/// Columns and rows of the terminal; shells tell them, and `COLUMNS` and `LINES` say something else.
fn size() -> [usize; 2] {
    let told = |name: &str| std::env::var(name).ok()?.parse::<usize>().ok().filter(|size| *size > 0);
    let size = console::Term::stdout().size_checked().map(|(rows, columns)| [columns, rows].map(usize::from));
    let [columns, rows] = size.unwrap_or(SIZE);
    // A line for the next prompt, and no chart of a whole tall screen.
    let rows = told("LINES").unwrap_or(rows).saturating_sub(1).min(30);
    [told("COLUMNS").unwrap_or(columns), rows]
}

/// Whether curves may be told apart by colours: in a terminal, unless `NO_COLOR` (<https://no-color.org>) asks for none.
fn has_colours() -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    std::io::stdout().is_terminal() && !refused
}
