//! The frames of a run, numbered, with an index that is complete after every frame.

use super::frame::{
    ContactFrame, ParticleFrame, WallFrame, write_contacts_as, write_particles_as, write_triangles,
    write_walls,
};
use super::index::{Entry, read_blocks, read_series, write_blocks, write_series};
use super::read::{Frame, PolyData, read_polydata};
use crate::frames::Precision;
use crate::{IoError, file};
use std::path::{Path, PathBuf};

/// Writes frame after frame into one folder and keeps the index `series.pvd` up to date.
///
/// The order of writing is particles, contacts, walls, frame, index; each file appears whole. An interrupted run therefore leaves
/// an index whose every entry can be opened.
#[derive(Debug)]
pub struct SeriesWriter {
    folder: PathBuf,
    prefix: String,
    entries: Vec<Entry>,
    precision: Precision,
    /// Whether particles and contacts are compressed.
    compressed: bool,
    /// The last surfaces and their file, which later frames name as long as no wall moves.
    surfaces: Option<(String, PolyData)>,
}

impl SeriesWriter {
    /// Starts a series in `folder`, which is created if missing.
    ///
    /// A `prefix` that is not empty begins the name of every file (`settling_frame_0000.vtm`), for several series in one
    /// folder. An older series of the same name is replaced from the first frame on.
    ///
    /// # Errors
    /// The folder cannot be created.
    pub fn create(folder: impl Into<PathBuf>, prefix: &str) -> Result<Self, IoError> {
        let folder = folder.into();
        file::create_folder(&folder)?;
        let prefix = if prefix.is_empty() { String::new() } else { format!("{prefix}_") };
        Ok(Self {
            folder,
            prefix,
            entries: Vec::new(),
            precision: Precision::Double,
            compressed: false,
            surfaces: None,
        })
    }

    /// Goes on with the series of an interrupted run: its first `frames` frames stay, later ones leave the index and are
    /// written again.
    ///
    /// # Errors
    /// The index cannot be read or written, or has fewer frames.
    pub fn resume(folder: impl Into<PathBuf>, prefix: &str, frames: usize) -> Result<Self, IoError> {
        let mut series = Self::create(folder, prefix)?;
        if frames == 0 {
            return Ok(series);
        }
        let index = series.index();
        series.entries = read_series(&index)?;
        let found = series.entries.len();
        if found < frames {
            let problem = format!("it lists {found} frames, and the checkpoint knows of {frames}");
            return Err(IoError::Changed { path: index, problem });
        }
        series.entries.truncate(frames);
        if let Some(last) = series.entries.last() {
            let blocks = read_blocks(&series.folder.join(&last.file))?;
            let surfaces = blocks.into_iter().find(|(name, _)| name == "Surfaces");
            if let Some((_, file)) = surfaces {
                let data = read_polydata(&series.folder.join(&file))?;
                series.surfaces = Some((file, data));
            }
        }
        write_series(&index, &series.entries)?;
        Ok(series)
    }

    /// The same series with particles and contacts of this precision.
    #[must_use]
    pub fn with_precision(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }

    /// The same series with compressed particles and contacts, which ParaView and VTK read, and OVITO does not.
    #[must_use]
    pub fn compressed(self, compressed: bool) -> Self {
        Self { compressed, ..self }
    }

    /// Writes one frame at `time` \[s\] and lists it in the index; returns the frame's file.
    ///
    /// # Errors
    /// A time that is not finite or not later than the frame before, a column of the wrong length, or a file that cannot
    /// be written. The index then still holds the frames before.
    pub fn write(
        &mut self,
        time: f64,
        particles: &ParticleFrame<'_>,
        contacts: &ContactFrame<'_>,
        walls: &WallFrame<'_>,
    ) -> Result<PathBuf, IoError> {
        let previous = self.entries.last().map_or(f64::NEG_INFINITY, |entry| entry.time);
        if !time.is_finite() || time <= previous {
            return Err(IoError::FrameTime { time, previous });
        }
        let [particle_file, contact_file, wall_file, _, frame_file, _] = self.next_files();
        write_particles_as(&self.folder.join(&particle_file), particles, self.precision, self.compressed)?;
        write_contacts_as(&self.folder.join(&contact_file), contacts, self.precision, self.compressed)?;
        write_walls(&self.folder.join(&wall_file), walls)?;
        let path = self.folder.join(&frame_file);
        let mut blocks = vec![("Particles", &*particle_file)];
        // OVITO 3.17 loses all particles of a frame that names a file without lines.
        let lines = [("Contacts", &*contact_file, contacts.ends), ("Walls", &wall_file, walls.ends)];
        blocks.extend(
            lines.iter().filter(|(_, _, ends)| !ends.is_empty()).map(|&(name, file, _)| (name, file)),
        );
        blocks.extend(self.surfaces.iter().map(|(file, _)| ("Surfaces", file.as_str())));
        write_blocks(&path, &blocks)?;
        self.entries.push(Entry { time, file: frame_file });
        write_series(&self.index(), &self.entries)?;
        Ok(path)
    }

    /// Writes one frame that is in memory, as [`write`](Self::write) does.
    ///
    /// # Errors
    /// As of [`write`](Self::write).
    pub fn write_frame(&mut self, time: f64, frame: &Frame) -> Result<PathBuf, IoError> {
        let Frame { particles, contacts, walls, surfaces } = frame;
        self.write_surfaces(surfaces)?;
        let particles = ParticleFrame { positions: &particles.points, columns: &particles.borrowed() };
        let contacts = ContactFrame { ends: &contacts.lines(), columns: &contacts.borrowed() };
        let radii = walls.scalar("radius").unwrap_or_default();
        self.write(time, &particles, &contacts, &WallFrame { ends: &walls.lines(), radii: &radii })
    }

    /// Whether there are surfaces that differ from those of the frame before.
    pub(crate) fn has_moved(&self, surfaces: &PolyData) -> bool {
        !surfaces.points.is_empty() && self.surfaces.as_ref().is_none_or(|(_, before)| before != surfaces)
    }

    /// Writes the surfaces of the next frame, unless they are those of the one before.
    fn write_surfaces(&mut self, surfaces: &PolyData) -> Result<(), IoError> {
        if surfaces.points.is_empty() {
            self.surfaces = None;
        } else if self.has_moved(surfaces) {
            let [_, _, _, file, _, _] = self.next_files();
            write_triangles(&self.folder.join(&file), &surfaces.points, &surfaces.borrowed())?;
            self.surfaces = Some((file, surfaces.clone()));
        }
        Ok(())
    }

    /// Names of the files that the next frame will write: particles, contacts, walls, surfaces (if a wall has moved since the
    /// frame before), frame, index.
    pub fn next_files(&self) -> [String; 6] {
        let name = |kind: &str, ending: &str| {
            format!("{}{kind}_{number:04}.{ending}", self.prefix, number = self.entries.len())
        };
        let index = format!("{}series.pvd", self.prefix);
        let [particles, contacts, walls, surfaces] =
            ["particles", "contacts", "walls", "surfaces"].map(|kind| name(kind, "vtp"));
        [particles, contacts, walls, surfaces, name("frame", "vtm"), index]
    }

    /// Number of frames in the index.
    pub fn frames(&self) -> usize {
        self.entries.len()
    }

    /// Path of the index, the file to open in ParaView.
    pub fn index(&self) -> PathBuf {
        self.folder.join(format!("{}series.pvd", self.prefix))
    }

    /// The folder of the series.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use crate::vtk::{Numbers, read_frame};

    const NO_PARTICLES: ParticleFrame<'static> = ParticleFrame { positions: &[], columns: &[] };
    const NO_CONTACTS: ContactFrame<'static> = ContactFrame { ends: &[], columns: &[] };
    const NO_WALLS: WallFrame<'static> = WallFrame { ends: &[], radii: &[] };

    #[test]
    fn the_index_is_complete_after_every_frame() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = SeriesWriter::create(folder.path().join("run"), "").unwrap();
        for (number, time) in [0.0, 0.1, 0.30000000000000004].into_iter().enumerate() {
            let frame = series.write(time, &NO_PARTICLES, &NO_CONTACTS, &NO_WALLS).unwrap();
            let entries = read_series(&series.index()).unwrap();
            assert_eq!(entries.len(), number + 1);
            assert_eq!(entries[number].time.to_bits(), time.to_bits());
            assert_eq!(series.folder().join(&entries[number].file), frame);
            assert!(frame.exists());
        }
        let hidden = std::fs::read_dir(series.folder()).unwrap();
        let hidden =
            hidden.filter(|entry| entry.as_ref().unwrap().file_name().to_string_lossy().starts_with('.'));
        assert_eq!(hidden.count(), 0, "no temporary file stays");
    }

    #[test]
    fn a_frame_names_no_file_without_lines() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = SeriesWriter::create(folder.path(), "").unwrap();
        let frame = series.write(0.0, &NO_PARTICLES, &NO_CONTACTS, &NO_WALLS).unwrap();
        let named = |frame: &Path| -> Vec<String> {
            read_blocks(frame).unwrap().into_iter().map(|(name, _)| name).collect()
        };
        assert_eq!(named(&frame), ["Particles"]);
        let walls = WallFrame { ends: &[[[0.0; 3], [1.0; 3]]], radii: &[0.0] };
        let frame = series.write(1.0, &NO_PARTICLES, &NO_CONTACTS, &walls).unwrap();
        assert_eq!(named(&frame), ["Particles", "Walls"]);
    }

    /// A triangle of wall 0 at a height.
    fn surface(height: f64) -> Frame {
        let points = vec![[0.0, 0.0, height], [1.0, 0.0, height], [0.0, 1.0, height]];
        let columns = vec![("wall".to_owned(), Numbers::Integer(vec![0]))];
        Frame { surfaces: PolyData { points, columns }, ..Frame::default() }
    }

    #[test]
    fn surfaces_are_written_when_walls_move_and_named_by_all_frames() {
        let folder = tempfile::tempdir().unwrap();
        let named = |frame: &Path| {
            let blocks = read_blocks(frame).unwrap();
            blocks.into_iter().find(|(name, _)| name == "Surfaces").map(|(_, file)| file)
        };
        let mut series = SeriesWriter::create(folder.path(), "").unwrap();
        let mut files = Vec::new();
        for (time, height) in [(0.0, 1.0), (1.0, 1.0), (2.0, 0.5)] {
            let frame = series.write_frame(time, &surface(height)).unwrap();
            assert_eq!(read_frame(&frame).unwrap().surfaces, surface(height).surfaces);
            files.push(named(&frame));
        }
        let expected = [0, 0, 2].map(|number| Some(format!("surfaces_{number:04}.vtp")));
        assert_eq!(files, expected);
        // A resumed run knows which file the frame before has named.
        let mut series = SeriesWriter::resume(folder.path(), "", 2).unwrap();
        let frame = series.write_frame(2.0, &surface(1.0)).unwrap();
        assert_eq!(named(&frame), expected[0]);
        let frame = series.write_frame(3.0, &Frame::default()).unwrap();
        assert_eq!(named(&frame), None);
    }

    #[test]
    fn a_resumed_run_writes_the_frames_after_the_checkpoint_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = SeriesWriter::create(folder.path(), "a&b").unwrap();
        for time in [0.0, 1.0, 2.0] {
            series.write(time, &NO_PARTICLES, &NO_CONTACTS, &NO_WALLS).unwrap();
        }
        let mut series = SeriesWriter::resume(folder.path(), "a&b", 2).unwrap();
        assert_eq!(series.frames(), 2);
        assert_eq!(read_series(&series.index()).unwrap().len(), 2);
        let frame = series.write(1.5, &NO_PARTICLES, &NO_CONTACTS, &NO_WALLS).unwrap();
        assert!(frame.ends_with("a&b_frame_0002.vtm"));
        let times: Vec<f64> = read_series(&series.index()).unwrap().iter().map(|entry| entry.time).collect();
        assert_eq!(times, [0.0, 1.0, 1.5]);
        let missing = SeriesWriter::resume(folder.path(), "a&b", 4);
        assert!(matches!(missing, Err(IoError::Changed { .. })), "{missing:?}");
    }

    #[test]
    fn a_time_that_goes_back_or_is_no_number_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = SeriesWriter::create(folder.path(), "").unwrap();
        series.write(1.0, &NO_PARTICLES, &NO_CONTACTS, &NO_WALLS).unwrap();
        for time in [1.0, 0.5, f64::NAN, f64::INFINITY] {
            let error = series.write(time, &NO_PARTICLES, &NO_CONTACTS, &NO_WALLS);
            assert!(matches!(error, Err(IoError::FrameTime { previous: 1.0, .. })));
        }
        assert_eq!(series.frames(), 1);
    }
}
