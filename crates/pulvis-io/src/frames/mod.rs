//! Instants of a run in the formats of other programs, one after the other.
//!
//! | format | files | read by |
//! | --- | --- | --- |
//! | `vtk` | one set of files per instant and an index with the times, see [`vtk`](crate::vtk) | ParaView, VTK, pyvista, OVITO |
//! | `lammps-dump` | two text files that grow: particles, and contacts as a local dump | OVITO, LAMMPS, VMD, ASE |
//! | `xyz` | one extended XYZ file that grows | OVITO, ASE |
//! | `npz` | one archive of arrays per instant | NumPy |
//! | `hdf5` | one file per instant and an index of links; where the feature `hdf5` is built in | h5py, MATLAB, h5dump |
//! | `csv` | one table of particles and one of contacts per instant | pandas, spreadsheets, Pulvis |
//!
//! Numbers are in SI. Text has the shortest decimals that read back as the same number, of 64 bits or, with
//! [`Precision::Single`], of 32.

mod csv;
mod growing;
mod hdf5;
mod lammps;
mod names;
mod npz;
mod numbered;
mod vtk;
mod xyz;

pub use hdf5::name_of as hdf5_name;
pub use names::{component_names, shape};

use crate::IoError;
use crate::table::SeriesPosition;
use crate::vtk::Frame;
use std::fmt::Debug;
use std::path::Path;

/// Every format. A new one is a file beside this one and a line here.
pub const FORMATS: &[Format] =
    &[vtk::FORMAT, lammps::FORMAT, xyz::FORMAT, npz::FORMAT, csv::FORMAT, hdf5::FORMAT];

/// A way to write instants.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// Name by which users choose it.
    pub name: &'static str,
    /// What it is good for, in one line.
    pub summary: &'static str,
    /// Starts the files, or goes on with them.
    pub open: fn(&Series<'_>) -> Result<Box<dyn FrameWriter>, IoError>,
    /// How to build a program that has it, where this one was built without.
    pub missing: Option<&'static str>,
}

/// Where instants go, and how.
#[derive(Clone, Copy, Debug)]
pub struct Series<'a> {
    /// The folder, which exists.
    pub folder: &'a Path,
    /// How the names of all files begin.
    pub name: &'a str,
    /// How exact numbers are.
    pub precision: Precision,
    /// Whether files are compressed; of use to `vtk` and `hdf5` only.
    pub compressed: bool,
    /// Whether contacts are written, where a format has files of their own for them.
    pub contacts: bool,
    /// The units of columns; of use to `hdf5` only.
    pub units: Units<'a>,
    /// How far an interrupted run had come; what was written later is cut off or replaced. `None` starts anew.
    pub resume: Option<&'a FramePosition>,
}

/// Names of columns and their units in SI.
#[derive(Clone, Copy, Debug, Default)]
pub struct Units<'a> {
    /// Those of particles.
    pub particles: &'a [(String, String)],
    /// Those of contacts.
    pub contacts: &'a [(String, String)],
}

/// How exact written numbers are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 64 bits: what is read back is what was written.
    #[default]
    Double,
    /// 32 bits: a relative error of 6e-8, half the size.
    Single,
}

/// How far a series of instants has come.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FramePosition {
    /// Number of instants.
    pub frames: u64,
    /// Lengths and hashes of the files that grow, in the order of [`FrameWriter::growing`].
    pub files: Vec<SeriesPosition>,
}

/// One instant.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// Time \[s\].
    pub time: f64,
    /// Steps so far.
    pub step: u64,
    /// The box.
    pub bounds: Bounds,
    /// Names of the materials; the column `type` counts them from 0.
    pub materials: &'a [String],
    /// Particles, contacts, walls.
    pub frame: &'a Frame,
}

/// The box around the particles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// Lower corner \[m\].
    pub lower: [f64; 3],
    /// Upper corner of the box as it is without tilt \[m\].
    pub upper: [f64; 3],
    /// Shifts xy, xz, yz of the box vectors of a tilted cell \[m\].
    pub tilt: [f64; 3],
    /// Which directions are periodic.
    pub periodic: [bool; 3],
}

/// Writes instants.
pub trait FrameWriter: Debug + Send {
    /// Names of the files that this instant, the next one, will write.
    fn next_files(&self, instant: &Instant<'_>) -> Vec<String>;

    /// Names of the files that every instant changes.
    fn growing(&self) -> Vec<String>;

    /// Writes an instant.
    ///
    /// # Errors
    /// A file cannot be written, or the instant does not follow the one before.
    fn write(&mut self, instant: &Instant<'_>) -> Result<(), IoError>;

    /// How far it has come; all of it is handed to the system first.
    ///
    /// # Errors
    /// A file cannot be written.
    fn position(&mut self) -> Result<FramePosition, IoError>;
}

/// The format called `name`.
///
/// # Errors
/// No format has this name; the error lists those that exist.
pub fn format(name: &str) -> Result<&'static Format, IoError> {
    FORMATS.iter().find(|format| format.name == name).ok_or_else(|| {
        let known = FORMATS.iter().map(|format| format.name).collect::<Vec<_>>().join(", ");
        IoError::UnknownFormat { what: "output", given: name.to_owned(), known }
    })
}

#[cfg(test)]
mod tests;
