//! Formats with files of their own for every instant.

use super::{FramePosition, FrameWriter, Instant, Precision, Series};
use crate::IoError;
use std::path::{Path, PathBuf};

/// Writes one instant into files; the names are those that `names` gives for its number.
pub(super) struct Numbered {
    folder: PathBuf,
    name: String,
    precision: Precision,
    frames: u64,
    names: fn(&str, u64) -> Vec<String>,
    write: fn(&[PathBuf], &Instant<'_>, Precision) -> Result<(), IoError>,
}

impl std::fmt::Debug for Numbered {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { folder, name, frames, .. } = self;
        let mut description = formatter.debug_struct("Numbered");
        description
            .field("folder", folder)
            .field("name", name)
            .field("frames", frames)
            .finish_non_exhaustive()
    }
}

impl Numbered {
    pub(super) fn open(
        series: &Series<'_>,
        names: fn(&str, u64) -> Vec<String>,
        write: fn(&[PathBuf], &Instant<'_>, Precision) -> Result<(), IoError>,
    ) -> Box<dyn FrameWriter> {
        let frames = series.resume.map_or(0, |position| position.frames);
        let (folder, name) = (Path::to_path_buf(series.folder), series.name.to_owned());
        Box::new(Self { folder, name, precision: series.precision, frames, names, write })
    }
}

impl FrameWriter for Numbered {
    fn next_files(&self, _instant: &Instant<'_>) -> Vec<String> {
        (self.names)(&self.name, self.frames)
    }

    fn growing(&self) -> Vec<String> {
        Vec::new()
    }

    fn write(&mut self, instant: &Instant<'_>) -> Result<(), IoError> {
        let paths: Vec<PathBuf> =
            self.next_files(instant).iter().map(|name| self.folder.join(name)).collect();
        (self.write)(&paths, instant, self.precision)?;
        self.frames += 1;
        Ok(())
    }

    fn position(&mut self) -> Result<FramePosition, IoError> {
        Ok(FramePosition { frames: self.frames, files: Vec::new() })
    }
}
