//! Instants as VTK files; see [`crate::vtk`].

use super::{Format, FramePosition, FrameWriter, Instant};
use crate::IoError;
use crate::vtk::SeriesWriter;

/// One set of files per instant and `NAME_series.pvd`.
pub(super) const FORMAT: Format = Format {
    name: "vtk",
    summary: "particles, contacts and walls for ParaView and OVITO, with an index of the times",
    open: |series| {
        let (folder, name, precision) = (series.folder, series.name, series.precision);
        let frames = series.resume.map_or(0, |position| position.frames as usize);
        let writer = SeriesWriter::resume(folder, name, frames)?;
        let writer = writer.with_precision(precision).compressed(series.compressed);
        Ok(Box::new(writer))
    },
    missing: None,
};

impl FrameWriter for SeriesWriter {
    fn next_files(&self, instant: &Instant<'_>) -> Vec<String> {
        let [particles, contacts, walls, surfaces, frame, index] = SeriesWriter::next_files(self);
        let surfaces = self.has_moved(&instant.frame.surfaces).then_some(surfaces);
        [particles, contacts, walls].into_iter().chain(surfaces).chain([frame, index]).collect()
    }

    fn growing(&self) -> Vec<String> {
        SeriesWriter::next_files(self).into_iter().next_back().into_iter().collect()
    }

    fn write(&mut self, instant: &Instant<'_>) -> Result<(), IoError> {
        self.write_frame(instant.time, instant.frame).map(drop)
    }

    fn position(&mut self) -> Result<FramePosition, IoError> {
        Ok(FramePosition { frames: self.frames() as u64, files: Vec::new() })
    }
}
