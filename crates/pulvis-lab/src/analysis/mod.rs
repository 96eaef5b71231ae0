//! Coarse graining of a run: fields of density, velocity, stress and fabric on a grid, and their profiles.

mod fields;
mod files;
mod grid;
mod kernel;
mod sample;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use pulvis_boundary::Domain;
use pulvis_io::IoError;
use thiserror::Error;

pub use fields::Fields;
pub use grid::Grid;
pub use kernel::Kernel;
pub use sample::Sample;

use crate::rendering::{FrameChoice, FrameSource, RenderError};

/// Most cells of a grid; more do not fit into a file that anybody opens.
const MOST_CELLS: f64 = 2e7;

/// How a run is coarse-grained.
#[derive(Clone, Copy, Debug)]
pub struct AnalysisPlan {
    /// Which frames.
    pub frames: FrameChoice,
    /// The kernel.
    pub kernel: Kernel,
    /// Its width \[m\]; `None`: twice the mean radius of the particles.
    pub width: Option<f64>,
    /// Edge of a cell \[m\]; `None`: half the width.
    pub cell: Option<f64>,
    /// The axis along which there are profiles, too.
    pub profile: Option<usize>,
}

/// Why a run cannot be analysed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// There are no such frames.
    #[error(transparent)]
    Source(#[from] RenderError),
    /// The scenario of the run is not there.
    #[error("the run in {} has no scenario that could be read: run.toml tells densities and periods", .0.display())]
    NoScenario(PathBuf),
    /// A frame without something that is needed.
    #[error("the {block} of a frame have no column `{column}`, which the key `vtk` of [output] writes")]
    Column {
        /// Particles or contacts.
        block: &'static str,
        /// The column.
        column: &'static str,
    },
    /// The cell deforms, and frames do not tell how it is.
    #[error(
        "the periodic cell of this run deforms, and its frames do not tell its state; name a checkpoint of it, for example {}",
        .0.display()
    )]
    Cell(PathBuf),
    /// Frames without particles.
    #[error("there is no particle in the frame at {0:e} s, nor in any other that was asked for")]
    Empty(f64),
    /// Too many cells.
    #[error(
        "{found:.1e} cells of {cell:e} m do not fit into a file; expected {MOST_CELLS:.0e} at most, choose larger cells with `--cell`"
    )]
    Cells {
        /// Number of cells.
        found: f64,
        /// Their edge \[m\].
        cell: f64,
    },
    /// A folder that exists.
    #[error("{} is not empty; choose another folder with `--output DIR`, or write over its files with `--force`", .0.display())]
    Folder(PathBuf),
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] IoError),
    /// The folder cannot be made.
    #[error("cannot make {}: {source}", .folder.display())]
    NoFolder {
        /// The folder.
        folder: PathBuf,
        /// Why not.
        source: std::io::Error,
    },
}

impl AnalysisError {
    /// Whether what was asked for is to blame, and nothing has been written yet.
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, Self::Output(_) | Self::NoFolder { .. })
    }
}

/// What came of an analysis.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The files that were written.
    pub files: Vec<PathBuf>,
    /// Width of the kernel \[m\].
    pub width: f64,
    /// Cells along each axis of the last grid.
    pub counts: [usize; 3],
}

/// Coarse-grains frames of a run, or a checkpoint, into files in a folder.
///
/// # Errors
/// There are no such frames, they lack what is needed, or files cannot be written.
pub fn analyse(
    run: &Path,
    plan: &AnalysisPlan,
    folder: &Path,
    force: bool,
) -> Result<Analysis, AnalysisError> {
    let source = FrameSource::open(run)?;
    let scenario = source.scenario.as_ref().ok_or_else(|| AnalysisError::NoScenario(run.to_owned()))?;
    let domain = match source.domain() {
        Some(domain) => domain,
        None if scenario.stages.iter().any(|stage| stage.cell.is_some()) => {
            return Err(AnalysisError::Cell(run.join("checkpoint.pulvis")));
        }
        None => scenario.domain.unwrap_or_else(Domain::unbounded),
    };
    let is_empty = std::fs::read_dir(folder).map_or(true, |mut entries| entries.next().is_none());
    if !is_empty && !force {
        return Err(AnalysisError::Folder(folder.to_owned()));
    }
    let mut analysis = Analysis { files: Vec::new(), width: 0.0, counts: [0; 3] };
    let instants = source.choose(plan.frames)?;
    // Frames are read twice, one at a time: many of them do not fit into the memory together.
    let mut extent = Extent::default();
    for instant in &instants {
        let frame = source.read(instant, false)?;
        extent.add(&Sample::of_frame(scenario, domain, instant.time, &frame)?);
    }
    let time = instants.first().map_or(0.0, |instant| instant.time);
    let radius = extent.radius.ok_or(AnalysisError::Empty(time))?;
    analysis.width = plan.width.unwrap_or(2.0 * radius);
    let cell = plan.cell.unwrap_or(0.5 * analysis.width);
    // One grid for all instants, so that they can be compared.
    let grid = extent.grid(plan.kernel.reach(analysis.width), cell, domain)?;
    analysis.counts = grid.counts;
    std::fs::create_dir_all(folder)
        .map_err(|source| AnalysisError::NoFolder { folder: folder.to_owned(), source })?;
    let mut add = |name: String| {
        let path = folder.join(name);
        analysis.files.push(path.clone());
        path
    };
    for instant in &instants {
        let name = &instant.name;
        let sample = Sample::of_frame(scenario, domain, instant.time, &source.read(instant, true)?)?;
        let fields = Fields::new(&sample, grid.clone(), plan.kernel, analysis.width);
        files::write_vtk(&fields, &add(format!("fields_{name}.vti")))?;
        files::write_table(&fields, &add(format!("fields_{name}.csv")))?;
        if let Some(axis) = plan.profile {
            let letter = ["x", "y", "z"][axis];
            files::write_table(&fields.profile(axis), &add(format!("profile_{letter}_{name}.csv")))?;
        }
    }
    files::write_descriptions(&add("fields.json".to_owned()))?;
    Ok(analysis)
}

/// The block around all particles of some instants.
#[derive(Clone, Debug)]
struct Extent {
    lower: [f64; 3],
    upper: [f64; 3],
    /// The mean radius of the first instant with particles \[m\]: before inlets have brought anything there is none.
    radius: Option<f64>,
}

impl Default for Extent {
    fn default() -> Self {
        Self { lower: [f64::INFINITY; 3], upper: [f64::NEG_INFINITY; 3], radius: None }
    }
}

impl Extent {
    fn add(&mut self, sample: &Sample) {
        for grain in &sample.particles {
            for axis in 0..3 {
                // Contact points on walls lie on the surfaces of particles.
                self.lower[axis] = self.lower[axis].min(grain.position[axis] - grain.radius);
                self.upper[axis] = self.upper[axis].max(grain.position[axis] + grain.radius);
            }
        }
        let count = sample.particles.len();
        if self.radius.is_none() && count > 0 {
            let sum: f64 = sample.particles.iter().map(|grain| grain.radius).sum();
            self.radius = Some(sum / count as f64);
        }
    }

    /// A grid that holds all particles with the reach of the kernel around them, so that nothing is lost.
    fn grid(&self, reach: f64, cell: f64, domain: Domain) -> Result<Grid, AnalysisError> {
        let lower = self.lower.map(|lower| lower - reach);
        let upper = self.upper.map(|upper| upper + reach);
        let found: f64 = (0..3).map(|axis| ((upper[axis] - lower[axis]) / cell).max(1.0)).product();
        // Not finite where nothing is.
        if found.is_finite() && found <= MOST_CELLS {
            return Ok(Grid::new(lower, upper, cell, domain));
        }
        Err(AnalysisError::Cells { found, cell })
    }
}
