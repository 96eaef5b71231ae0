//! Particles out of files of Pulvis and of other programs.

mod checkpoint;
mod dump;
mod error;
mod lammps_data;
mod rows;
mod table;
mod vtk;
mod xyz;

pub use checkpoint::{CheckpointParticles, CheckpointReader, GrainColumn};
pub use error::PointsError;

use super::arrangement::Grain;
use std::collections::BTreeMap;
use std::path::Path;

/// How a file of particles is read.
#[derive(Clone, Debug, PartialEq)]
pub struct FileReading {
    /// The format.
    pub format: PointsFormat,
    /// The instant, from 0, of a file that holds several; `None` is the last one.
    pub frame: Option<usize>,
    /// What the file's unit of length is [m].
    pub length_unit: f64,
    /// What the file's unit of time is [s].
    pub time_unit: f64,
    /// The material of each word that the file has for materials; `None`: the file's materials are not asked for.
    pub materials: Option<BTreeMap<String, usize>>,
}

/// A format of particle files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointsFormat {
    /// Values separated by commas or blanks.
    Table,
    /// A text dump of LAMMPS.
    LammpsDump,
    /// A data file of LAMMPS, atom style sphere.
    LammpsData,
    /// XYZ, extended or plain.
    Xyz,
    /// VTK's XML: points, or an index of files of points.
    Vtk,
    /// The folder of a run of Pulvis.
    Run,
    /// A checkpoint of a run, or the latest one in its folder.
    Checkpoint,
}

impl PointsFormat {
    /// All of them, with their names in a scenario.
    pub const ALL: [(&'static str, Self); 7] = [
        ("table", Self::Table),
        ("lammps-dump", Self::LammpsDump),
        ("lammps-data", Self::LammpsData),
        ("xyz", Self::Xyz),
        ("vtk", Self::Vtk),
        ("run", Self::Run),
        ("checkpoint", Self::Checkpoint),
    ];

    /// The name in a scenario.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, format)| *format == self).map_or("", |(name, _)| name)
    }

    /// What the ending of a file says; a table where it says nothing. A folder is that of a run.
    pub(super) fn of_path(path: &Path) -> Self {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match ending.as_str() {
            "dump" | "lammpstrj" => Self::LammpsDump,
            "data" | "lmp" => Self::LammpsData,
            "xyz" | "extxyz" => Self::Xyz,
            "vtp" | "vtu" | "vtm" | "pvd" => Self::Vtk,
            "pulvis" => Self::Checkpoint,
            _ if path.is_dir() => Self::Run,
            _ => Self::Table,
        }
    }
}

/// Particles, and what a file says of them beside what all particles have.
pub(super) type Read = (Vec<Grain>, Vec<GrainColumn>);

/// Reads a file of particles, or the folder of a run; checkpoints by a reader.
pub(super) fn read_points(
    path: &Path,
    reading: &FileReading,
    reader: Option<CheckpointReader>,
) -> Result<Read, PointsError> {
    let file = path.display().to_string();
    let alone = |grains| (grains, Vec::new());
    let (grains, columns) = match reading.format {
        PointsFormat::Vtk => vtk::read(path, reading, &[]).map(alone),
        PointsFormat::Run => vtk::read_run(path, reading).map(alone),
        PointsFormat::Checkpoint => checkpoint::read(path, reading, reader),
        _ => match std::fs::read_to_string(path) {
            Ok(text) => parse_points(&file, &text, reading).map(alone),
            Err(reason) => Err(unread(path, reason)),
        },
    }?;
    if grains.is_empty() {
        return Err(PointsError::Empty { file });
    }
    Ok((grains, columns))
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, PointsError> {
    std::fs::read(path).map_err(|reason| unread(path, reason))
}

fn unread(path: &Path, reason: std::io::Error) -> PointsError {
    let file = path.display().to_string();
    match reason.kind() {
        std::io::ErrorKind::NotFound => PointsError::Missing { file },
        _ => PointsError::Unreadable { file, reason },
    }
}

/// The particles of a file that is text.
fn parse_points(file: &str, text: &str, reading: &FileReading) -> Result<Vec<Grain>, PointsError> {
    let text = text.trim_start_matches('\u{feff}');
    match reading.format {
        PointsFormat::LammpsDump => dump::parse(file, text, reading),
        PointsFormat::LammpsData => lammps_data::parse(file, text, reading),
        PointsFormat::Xyz => xyz::parse(file, text, reading),
        _ => table::parse(file, text, reading),
    }
}

#[cfg(test)]
mod tests;
