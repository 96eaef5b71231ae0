//! Pictures of the particles of a run: from the frames that it wrote, from a checkpoint, or from the run itself.
//!
//! [`Rendering::prepare`] finds the frames and refuses what cannot be drawn, before anything is written;
//! [`Rendering::write`] draws them. The pictures of a sequence have the box, the colour bar and the thickness of tubes in
//! common, so that they can be compared and shown as a film.

mod clip;
mod drawing;
mod error;
mod extent;
mod plan;
mod quantity;
mod source;
mod view;

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use pulvis_input::scenario::Scenario;
use pulvis_io::picture::{Film, Picture, render};
use pulvis_io::vtk::Frame;

use crate::protocol::PictureOptions;
pub use clip::Clip;
use drawing::Drawing;
pub use error::RenderError;
use extent::Extent;
use plan::Paints;
pub use plan::{FrameChoice, Plan};
pub use quantity::Quantity;
use source::Instant;
pub(crate) use source::Source as FrameSource;
use source::Source;
pub use view::ViewPoint;

/// Pictures that can be drawn.
#[derive(Debug)]
pub struct Rendering {
    plan: Plan,
    source: Source,
    chosen: Vec<Instant>,
    output: Output,
}

/// Where pictures go.
#[derive(Debug)]
enum Output {
    /// One file a picture.
    Pictures(Vec<PathBuf>),
    /// One file for all.
    Film(PathBuf),
}

impl Rendering {
    /// Finds what is to be drawn: frames of the run in a folder, or the state in a checkpoint. `output` is a file that ends in
    /// `png`, with the number of the frame before its ending where there are several, or in `apng`, for a film; without it,
    /// the pictures stand in the folder of the run as `render_NNNN.png`.
    ///
    /// # Errors
    /// There are no such frames, or no such format.
    pub fn prepare(run: &Path, plan: Plan, output: Option<&Path>) -> Result<Self, RenderError> {
        let source = Source::open(run)?;
        let chosen = source.choose(plan.frames)?;
        let output = match output {
            None => {
                let file = |instant: &Instant| source.folder.join(format!("render_{}.png", instant.name));
                Output::Pictures(chosen.iter().map(file).collect())
            }
            Some(file) => outputs(file, &chosen, source.is_run())?,
        };
        Ok(Self { plan, source, chosen, output })
    }

    /// The files that [`write`](Self::write) will write.
    pub fn files(&self) -> &[PathBuf] {
        match &self.output {
            Output::Pictures(files) => files,
            Output::Film(file) => std::slice::from_ref(file),
        }
    }

    /// Number of pictures.
    pub fn pictures(&self) -> usize {
        self.chosen.len()
    }

    /// Draws the pictures; `watch` is told when one is complete, a true `stop` ends the work before the next one. Answers
    /// with the number of complete files.
    ///
    /// # Errors
    /// A frame cannot be read or has not what is asked for, or a file cannot be written.
    pub fn write(&self, stop: &AtomicBool, watch: &mut dyn FnMut()) -> Result<usize, RenderError> {
        let with_contacts =
            self.plan.contacts || self.plan.colour.as_ref().is_some_and(Quantity::needs_contacts);
        let read = |instant| self.source.read(instant, with_contacts);
        let first = read(&self.chosen[0])?;
        let paints = paints(&self.plan, &first);
        let alone = self.chosen.len() == 1;
        let mut extent = Extent::of(&first, &self.plan, &paints)?;
        for instant in &self.chosen[1..] {
            if stop.load(Ordering::Relaxed) {
                return Ok(0);
            }
            extent = extent.and(Extent::of(&read(instant)?, &self.plan, &paints)?);
        }
        let mut film = match &self.output {
            Output::Pictures(_) => None,
            Output::Film(file) => {
                let count = u32::try_from(self.chosen.len()).unwrap_or(u32::MAX);
                Some(Film::create(file, self.plan.size, count, self.plan.per_second)?)
            }
        };
        let limits = extent.limits.filter(|_| !alone);
        let mut first = Some(first);
        for (number, instant) in self.chosen.iter().enumerate() {
            if stop.load(Ordering::Relaxed) {
                return Ok(if film.is_some() { 0 } else { number });
            }
            let frame = match first.take() {
                Some(frame) => frame,
                None => read(instant)?,
            };
            let scenario = self.source.scenario.as_ref();
            let drawing = Drawing::of(&frame, instant.time, &self.plan, &paints, &extent, scenario)?;
            let picture = draw(&drawing, &self.plan, limits)?;
            match &mut film {
                Some(film) => film.add(&picture)?,
                None => picture.write(&self.files()[number])?,
            }
            watch();
        }
        film.map_or(Ok(()), Film::finish)?;
        Ok(self.files().len())
    }
}

/// The picture that a run draws of its particles: by material where there are several, else by their contacts; at 144 pixels
/// to the inch 1200 x 900 pixels.
pub(crate) fn default_picture(
    scenario: &Scenario,
    frame: &Frame,
    time: f64,
    dpi: u32,
) -> Result<Picture, RenderError> {
    let size = Plan::default().size.map(|side| side * dpi / PictureOptions::default().dpi);
    let plan = Plan { size, ..Plan::default() };
    let paints = paints(&plan, frame);
    let extent = Extent::of(frame, &plan, &paints)?;
    let drawing = Drawing::of(frame, time, &plan, &paints, &extent, Some(scenario))?;
    Ok(draw(&drawing, &plan, None)?.dpi(dpi))
}

fn draw(drawing: &Drawing, plan: &Plan, limits: Option<[[f64; 3]; 2]>) -> Result<Picture, RenderError> {
    drawing.with_scene(plan, limits, |scene| render(scene, plan.threads)).map_err(RenderError::Output)
}

fn paints(plan: &Plan, frame: &Frame) -> Paints {
    match &plan.colour {
        Some(quantity) => Paints::Particles(quantity.clone()),
        None if plan.contacts => Paints::Forces,
        None => {
            let kinds = frame.particles.scalar("type").unwrap_or_default();
            let several = kinds.iter().any(|kind| *kind != kinds[0]);
            Paints::Particles(if several { Quantity::Material } else { Quantity::Coordination })
        }
    }
}

/// The files of a given name.
fn outputs(file: &Path, chosen: &[Instant], is_run: bool) -> Result<Output, RenderError> {
    let ending = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match ending.as_str() {
        "apng" if is_run => Ok(Output::Film(file.to_owned())),
        "apng" => Err(RenderError::Film(file.to_owned())),
        "png" if chosen.len() == 1 => Ok(Output::Pictures(vec![file.to_owned()])),
        "png" => {
            let stem = file.file_stem().unwrap_or_default().to_string_lossy();
            let numbered = |instant: &Instant| file.with_file_name(format!("{stem}_{}.png", instant.name));
            Ok(Output::Pictures(chosen.iter().map(numbered).collect()))
        }
        _ => Err(RenderError::Format { file: file.to_owned(), found: ending }),
    }
}
