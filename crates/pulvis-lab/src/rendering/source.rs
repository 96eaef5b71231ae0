//! Where frames come from: the files of a run, or a checkpoint.

use std::path::{Path, PathBuf};

use pulvis_boundary::Domain;
use pulvis_input::scenario::Scenario;
use pulvis_io::vtk::{Entry, Frame, read_frame, read_frame_without_contacts, read_series};

use super::error::RenderError;
use super::plan::FrameChoice;
use crate::protocol::{RECORD, checkpoint_files, frame_of_checkpoint, scenario_from_text};

/// The index of frames in the folder of a run.
const INDEX: &str = "series.pvd";

/// The frames of a run.
#[derive(Debug)]
pub(crate) struct Source {
    /// What the run was, where its record can be read.
    pub(crate) scenario: Option<Scenario>,
    /// Where pictures go unless told otherwise.
    pub(crate) folder: PathBuf,
    frames: Frames,
}

#[derive(Debug)]
enum Frames {
    Files(Vec<Entry>),
    Checkpoint { name: String, time: f64, frame: Box<Frame>, domain: Box<Domain> },
}

/// One frame of a source.
#[derive(Clone, Debug)]
pub(crate) struct Instant {
    /// What the picture of it is called.
    pub(crate) name: String,
    /// \[s\]
    pub(crate) time: f64,
    /// Its file, if it has one.
    file: Option<PathBuf>,
}

impl Source {
    /// # Errors
    /// There is no run, or one without frames, or a checkpoint that cannot be used.
    pub(crate) fn open(run: &Path) -> Result<Self, RenderError> {
        if run.is_file() {
            return Self::of_checkpoint(run);
        }
        if !run.is_dir() {
            return Err(RenderError::Nothing(run.to_owned()));
        }
        let (index, record) = (run.join(INDEX), run.join(RECORD));
        if !index.is_file() && !record.is_file() {
            return Err(RenderError::NoRun(run.to_owned()));
        }
        let entries =
            if index.is_file() { read_series(&index).map_err(RenderError::Frame)? } else { Vec::new() };
        if entries.is_empty() {
            let checkpoint = checkpoint_files(run).into_iter().next();
            return Err(RenderError::NoFrames { folder: run.to_owned(), checkpoint });
        }
        // Title, names and units; a picture without them is better than none.
        let text = std::fs::read_to_string(&record).ok();
        let scenario = text.and_then(|text| scenario_from_text(RECORD, &text).ok());
        Ok(Self { scenario, folder: run.to_owned(), frames: Frames::Files(entries) })
    }

    fn of_checkpoint(file: &Path) -> Result<Self, RenderError> {
        let (scenario, domain, time, frame) = frame_of_checkpoint(file)?;
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self {
            scenario: Some(scenario),
            folder: file.parent().unwrap_or(Path::new("")).to_owned(),
            frames: Frames::Checkpoint { name, time, frame: Box::new(frame), domain: Box::new(domain) },
        })
    }

    /// The periodic domain as it is in a checkpoint; files do not tell.
    pub(crate) fn domain(&self) -> Option<Domain> {
        match &self.frames {
            Frames::Checkpoint { domain, .. } => Some(**domain),
            Frames::Files(_) => None,
        }
    }

    /// The frames that were asked for.
    ///
    /// # Errors
    /// There are no such ones.
    pub(crate) fn choose(&self, frames: FrameChoice) -> Result<Vec<Instant>, RenderError> {
        let mut instants = self.instants();
        let count = instants.len();
        Ok(match frames {
            FrameChoice::All => instants,
            FrameChoice::Last => instants.split_off(count - 1),
            FrameChoice::Number(found) if found < count => instants.drain(found..=found).collect(),
            FrameChoice::Time(time) => {
                // Times went through text, and are sums of steps.
                let is_it = |instant: &Instant| (instant.time - time).abs() <= 1e-9 * time.abs();
                match instants.into_iter().find(is_it) {
                    Some(instant) => vec![instant],
                    None => return Err(RenderError::NoTime { time }),
                }
            }
            FrameChoice::Number(found) => return Err(RenderError::NoFrame { found, count }),
        })
    }

    /// Whether there are frames in files.
    pub(crate) fn is_run(&self) -> bool {
        matches!(self.frames, Frames::Files(_))
    }

    /// All frames.
    pub(crate) fn instants(&self) -> Vec<Instant> {
        match &self.frames {
            Frames::Checkpoint { name, time, .. } => {
                vec![Instant { name: name.clone(), time: *time, file: None }]
            }
            Frames::Files(entries) => {
                let instant = |(number, entry): (usize, &Entry)| Instant {
                    name: format!("{number:04}"),
                    time: entry.time,
                    file: Some(self.folder.join(&entry.file)),
                };
                entries.iter().enumerate().map(instant).collect()
            }
        }
    }

    /// # Errors
    /// A file cannot be read.
    pub(crate) fn read(&self, instant: &Instant, with_contacts: bool) -> Result<Frame, RenderError> {
        match (&self.frames, &instant.file) {
            (Frames::Checkpoint { frame, .. }, _) => Ok((**frame).clone()),
            (Frames::Files(_), Some(file)) => {
                let read = if with_contacts { read_frame } else { read_frame_without_contacts };
                read(file).map_err(RenderError::Frame)
            }
            (Frames::Files(_), None) => Ok(Frame::default()),
        }
    }
}
