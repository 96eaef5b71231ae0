//! `pulvis render`: pictures of the particles of a run.

use std::io::{IsTerminal, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use pulvis_io::picture::{Paper, Projection, Scene};
use pulvis_lab::rendering::{Clip, FrameChoice, Plan, Quantity, RenderError, Rendering, ViewPoint};

use super::picture_file::exists;
use super::words::duration;
use crate::failure::{Failure, INTERRUPTED, print};

/// Draws the particles of a run from its frames, or from a checkpoint.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Folder of a run, or a checkpoint file
    run: PathBuf,
    /// Which frame: its number from 0, `last`, or `all`
    #[arg(long, value_name = "N|last|all", default_value = "last")]
    frame: FrameChoice,
    /// What particles are coloured by: speed, depth, stress, coordination, material, or a column of the frames (radius, omega,
    /// f, ...) [default: material where there are several, else coordination; with --contacts none]
    #[arg(long, value_name = "QUANTITY")]
    color: Option<String>,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1200x900", value_parser = size)]
    size: [u32; 2],
    /// From where: x (from the right), y (from the front), z (from above), iso, or azimuth and elevation in degrees
    #[arg(long, value_name = "x|y|z|iso|AZ,EL", default_value = "iso", allow_hyphen_values = true)]
    view: ViewPoint,
    /// Show only particles whose centre lies on one side: "y<2 mm", "z>0.1 m", "x<50%"; may be given several times
    #[arg(long, value_name = "AXIS<PLACE")]
    clip: Vec<Clip>,
    /// Show contacts as tubes, as thick as their force is large, and particles small
    #[arg(long)]
    contacts: bool,
    /// The same scale at any distance, in place of perspective
    #[arg(long)]
    parallel: bool,
    /// Light ink on a dark ground
    #[arg(long)]
    dark: bool,
    /// PNG file, numbered if there are several frames; or APNG file, a film [default: render_NNNN.png in the folder of the run]
    #[arg(short, long, value_name = "FILE.png|apng")]
    output: Option<PathBuf>,
    /// Pictures per second of a film
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u16).range(1..=1000))]
    fps: u16,
    /// Number of threads; pictures do not depend on it [default: all processors]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Write over pictures that exist
    #[arg(long)]
    force: bool,
    /// No progress bar
    #[arg(short, long)]
    quiet: bool,
}

/// A size such as `1600x1200`.
fn size(text: &str) -> Result<[u32; 2], String> {
    let [least, most] = Scene::SIDES;
    let side = |text: &str| text.parse().ok().filter(|side| (least..=most).contains(side));
    let sides = text.split_once('x').and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| {
        format!("expected width and height in pixels, each from {least} to {most}, for example 1600x1200")
    })
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let start = std::time::Instant::now();
    let rendering = Rendering::prepare(&arguments.run, plan(arguments), arguments.output.as_deref());
    let rendering = rendering.map_err(refused)?;
    if let Some(file) = rendering.files().iter().find(|file| !arguments.force && file.exists()) {
        return Err(exists(file));
    }
    let stop = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&stop);
    ctrlc::set_handler(move || handler.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::while_running(format!("cannot listen for Ctrl-C: {error}")))?;
    let bar = bar(arguments.quiet, rendering.pictures() as u64);
    let written = rendering.write(&stop, &mut || bar.iter().for_each(|bar| bar.inc(1))).map_err(refused)?;
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
    let files = &rendering.files()[..written];
    match files {
        [] => {}
        [file] => print(&format!("{}\n", file.display()))?,
        [first, .., last] => print(&format!("{} to {}\n", first.display(), last.display()))?,
    }
    if written < rendering.files().len() {
        return Ok(ExitCode::from(INTERRUPTED));
    }
    if !arguments.quiet {
        let count = rendering.pictures();
        let pictures = if count == 1 { "picture" } else { "pictures" };
        // Nobody is left to be told if the standard error stream is closed.
        let _ =
            writeln!(std::io::stderr(), "{count} {pictures} in {}", duration(start.elapsed().as_secs_f64()));
    }
    Ok(ExitCode::SUCCESS)
}

fn plan(arguments: &Arguments) -> Plan {
    let plan = Plan::default();
    Plan {
        frames: arguments.frame,
        colour: arguments.color.as_deref().map(Quantity::named),
        contacts: arguments.contacts,
        view: arguments.view,
        projection: if arguments.parallel { Projection::Parallel } else { Projection::Perspective },
        size: arguments.size,
        clips: arguments.clip.clone(),
        paper: if arguments.dark { Paper::Black } else { Paper::White },
        per_second: arguments.fps,
        threads: arguments.threads.map_or(plan.threads, usize::from),
    }
}

fn refused(error: RenderError) -> Failure {
    if error.is_bad_input() { Failure::bad_input(error) } else { Failure::while_running(error) }
}

fn bar(quiet: bool, count: u64) -> Option<ProgressBar> {
    (!quiet && count > 1 && std::io::stderr().is_terminal()).then(|| {
        let bar = ProgressBar::new(count);
        // The template is a constant; without it the bar shows less.
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos} of {len} pictures, {elapsed}") {
            bar.set_style(style);
        }
        bar
    })
}
