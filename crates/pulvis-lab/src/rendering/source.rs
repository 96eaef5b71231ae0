//! Where frames come from: the files of a run, or a checkpoint.

use std::path::{Path, PathBuf};

use pulvis_input::scenario::Scenario;
use pulvis_io::vtk::{Entry, Frame, read_frame, read_frame_without_contacts, read_series};

use super::error::RenderError;
use crate::protocol::{RECORD, checkpoint_files, frame_of_checkpoint};

/// The index of frames in the folder of a run.
const INDEX: &str = "series.pvd";

/// The frames of a run.
#[derive(Debug)]
pub(super) struct Source {
    /// What the run was, where its record can be read.
    pub(super) scenario: Option<Scenario>,
    /// Where pictures go unless told otherwise.
    pub(super) folder: PathBuf,
    frames: Frames,
}

#[derive(Debug)]
enum Frames {
    Files(Vec<Entry>),
    Checkpoint { name: String, time: f64, frame: Box<Frame> },
}

/// One frame of a source.
#[derive(Clone, Debug)]
pub(super) struct Instant {
    /// What the picture of it is called.
    pub(super) name: String,
    /// \[s\]
    pub(super) time: f64,
    /// Its file, if it has one.
    file: Option<PathBuf>,
}

impl Source {
    /// # Errors
    /// There is no run, or one without frames, or a checkpoint that cannot be used.
    pub(super) fn open(run: &Path) -> Result<Self, RenderError> {
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
        let scenario = text.and_then(|text| Scenario::from_str(RECORD, &text).ok());
        Ok(Self { scenario, folder: run.to_owned(), frames: Frames::Files(entries) })
    }

    fn of_checkpoint(file: &Path) -> Result<Self, RenderError> {
        let (scenario, time, frame) = frame_of_checkpoint(file)?;
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self {
            scenario: Some(scenario),
            folder: file.parent().unwrap_or(Path::new("")).to_owned(),
            frames: Frames::Checkpoint { name, time, frame: Box::new(frame) },
        })
    }

    /// Whether there are frames in files.
    pub(super) fn is_run(&self) -> bool {
        matches!(self.frames, Frames::Files(_))
    }

    /// All frames.
    pub(super) fn instants(&self) -> Vec<Instant> {
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
    pub(super) fn read(&self, instant: &Instant, with_contacts: bool) -> Result<Frame, RenderError> {
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
