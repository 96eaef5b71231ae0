//! The writer, over the HDF5 library.

use super::super::{FramePosition, FrameWriter, Instant, Series};
use super::layout::{self, Style};
use crate::IoError;
use crate::file::temporary_name;
use hdf5_metno::{Error, File, Result as Written};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// It is here.
pub(super) const MISSING: Option<&str> = None;

pub(super) fn open(series: &Series<'_>) -> Result<Box<dyn FrameWriter>, IoError> {
    let names = Names::new(series.name);
    let style = Style::new(series);
    let mut writer = Hdf5 { folder: series.folder.to_owned(), names, style, entries: Vec::new() };
    let frames = series.resume.map_or(0, |position| position.frames as usize);
    if frames > 0 {
        writer.cut_back(frames)?;
    }
    Ok(Box::new(writer))
}

/// An instant in the index.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) file: String,
    pub(super) step: u64,
    pub(super) time: f64,
    pub(super) particles: u64,
    pub(super) contacts: u64,
}

#[derive(Debug)]
struct Hdf5 {
    folder: PathBuf,
    names: Names,
    style: Style,
    entries: Vec<Entry>,
}

/// How files are called.
#[derive(Debug)]
struct Names {
    /// What begins the name of an instant.
    frame: String,
    index: String,
}

impl Names {
    fn new(series: &str) -> Self {
        let [frame, index] = if series.is_empty() { ["frame", "series"] } else { [series; 2] };
        Self { frame: frame.to_owned(), index: format!("{index}.h5") }
    }

    fn of_frame(&self, number: usize) -> String {
        format!("{}_{number:04}.h5", self.frame)
    }
}

impl Hdf5 {
    fn index(&self) -> PathBuf {
        self.folder.join(&self.names.index)
    }

    /// Keeps the first instants of the index only.
    fn cut_back(&mut self, frames: usize) -> Result<(), IoError> {
        let path = self.index();
        let file = File::open(&path).map_err(|error| failed("read", &path, &error))?;
        let entries = layout::read_index(&file, |number| self.names.of_frame(number));
        self.entries = entries.map_err(|error| failed("read", &path, &error))?;
        drop(file);
        let found = self.entries.len();
        if found < frames {
            let problem = format!("it lists {found} frames, and the checkpoint knows of {frames}");
            return Err(IoError::Changed { path, problem });
        }
        self.entries.truncate(frames);
        self.write_index()
    }

    fn write_index(&self) -> Result<(), IoError> {
        replace(&self.index(), |file| layout::write_index(file, &self.entries))
    }
}

impl FrameWriter for Hdf5 {
    fn next_files(&self, _instant: &Instant<'_>) -> Vec<String> {
        vec![self.names.of_frame(self.entries.len()), self.names.index.clone()]
    }

    fn growing(&self) -> Vec<String> {
        vec![self.names.index.clone()]
    }

    fn write(&mut self, instant: &Instant<'_>) -> Result<(), IoError> {
        let file = self.names.of_frame(self.entries.len());
        replace(&self.folder.join(&file), |file| layout::write_instant(file, instant, &self.style))?;
        self.entries.push(Entry {
            file,
            step: instant.step,
            time: instant.time,
            particles: instant.frame.particles.points.len() as u64,
            contacts: instant.frame.contacts.points.len() as u64 / 2,
        });
        self.write_index()
    }

    fn position(&mut self) -> Result<FramePosition, IoError> {
        Ok(FramePosition { frames: self.entries.len() as u64, files: Vec::new() })
    }
}

/// Writes a file under another name and renames it: it is whole, or what it was before.
fn replace(path: &Path, write: impl FnOnce(&File) -> Written<()>) -> Result<(), IoError> {
    let temporary = temporary_name(path);
    let written = File::create(&temporary).and_then(|file| {
        write(&file)?;
        // What is not told here would be lost in a drop.
        file.flush()?;
        file.close()
    });
    let written = written
        .map_err(|error| failed("write", path, &error))
        .and_then(|()| fs::rename(&temporary, path).map_err(|source| IoError::system("write", path, source)));
    if written.is_err() {
        // The leftover is of no use; that it cannot be removed either is not the error worth telling.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// An error of the library; one of the system is told as such.
fn failed(action: &'static str, path: &Path, error: &Error) -> IoError {
    let text = error.to_string();
    let number = text.split_once("errno = ").and_then(|(_, rest)| rest.split(',').next()?.parse().ok());
    IoError::system(action, path, number.map_or_else(|| io::Error::other(text), io::Error::from_raw_os_error))
}
