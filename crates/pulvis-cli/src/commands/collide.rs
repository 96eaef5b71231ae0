//! `pulvis collide`: two bodies, head on or under an angle.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use pulvis_input::InputErrors;
use pulvis_input::collision::CollisionScenario;
use pulvis_lab::collision::{SweepPoint, figure, result_table, sweep, trajectory_table};

use super::picture_file::{Resolution, check, exists};
use super::set::Settings;
use crate::failure::{Failure, print};

/// Significant digits of the table on the screen; CSV and JSON hold all.
const DIGITS: usize = 7;

/// Collides two spheres, or a sphere and a plane, over a sweep of velocities, angles, spins or law parameters.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Collision scenario (TOML)
    file: PathBuf,
    /// How the table of results is written
    #[arg(long, value_parser = ["text", "csv", "json"], default_value = "text")]
    format: String,
    /// Write the course of every collision into this folder, one CSV file each
    #[arg(long, value_name = "DIR")]
    trajectory: Option<PathBuf>,
    /// Draw restitution, force loops and energies
    #[arg(long, value_name = "FILE.png|svg")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    resolution: Resolution,
    #[command(flatten)]
    set: Settings,
    /// Write over trajectories and pictures that exist
    #[arg(long)]
    force: bool,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let bad_scenario = |errors: InputErrors| Failure::bad_input(errors);
    let scenario = CollisionScenario::load(&arguments.file, &arguments.set.pairs).map_err(bad_scenario)?;
    // Before anything is computed: nobody likes to hear afterwards that there is no place for it.
    let trajectories = match &arguments.trajectory {
        Some(folder) => prepare(folder, scenario.cases.len(), arguments.force)?,
        None => Vec::new(),
    };
    if let Some(file) = &arguments.plot {
        check(file, arguments.force)?;
    }
    let points = sweep(&scenario, !trajectories.is_empty()).map_err(Failure::while_running)?;
    for (point, file) in points.iter().zip(&trajectories) {
        let table = trajectory_table(&point.collision.course).map_err(Failure::while_running)?;
        table.write(file).map_err(Failure::while_running)?;
    }
    if let Some(file) = &arguments.plot {
        let picture = figure(&scenario, &points).map_err(Failure::while_running)?;
        picture.dpi(arguments.resolution.dpi).write(file).map_err(Failure::while_running)?;
    }
    print(&results(&scenario, &points, &arguments.format)?)?;
    Ok(ExitCode::SUCCESS)
}

/// The results in a format of the table writer; in `text`, rounded.
fn results(scenario: &CollisionScenario, points: &[SweepPoint], format: &str) -> Result<String, Failure> {
    let text = format == "text";
    let table = result_table(scenario, points, text).map_err(Failure::while_running)?;
    if text {
        return Ok(format!("all quantities in SI units\n\n{}", table.to_text(DIGITS)));
    }
    let format = pulvis_io::table::format(format).map_err(Failure::bad_input)?;
    table.to_string(format).map_err(Failure::while_running)
}

/// Creates the folder of the trajectories; answers with the files, none of which may exist.
fn prepare(folder: &Path, count: usize, force: bool) -> Result<Vec<PathBuf>, Failure> {
    let digits = count.to_string().len().max(3);
    let files: Vec<_> =
        (1..=count).map(|number| folder.join(format!("trajectory_{number:0digits$}.csv"))).collect();
    if let Some(file) = files.iter().find(|file| !force && file.exists()) {
        return Err(exists(file));
    }
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::bad_input(format!(
            "cannot create the folder {}: {error}; name a folder in which you may write",
            folder.display()
        ))
    })?;
    Ok(files)
}
