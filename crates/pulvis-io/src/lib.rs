//! Output of Pulvis: tables, VTK files, plots and pictures.
//!
//! This crate knows no physics and no engine type: every writer takes borrowed slices and names, so the engine, the
//! experiments and the Python bindings can all use it.
//!
//! | module | writes | read by |
//! | --- | --- | --- |
//! | [`vtk`] | particles and contacts, one frame per instant, and the index of a run | ParaView, VTK, pyvista, OVITO |
//! | [`frames`] | instants of a run as VTK, LAMMPS dumps, extended XYZ, npz, CSV or HDF5 | OVITO, LAMMPS, NumPy, pandas, h5py |
//! | [`table`] | tables as aligned text, CSV or JSON; time series while a run goes on | people, spreadsheets, scripts |
//! | [`plot`] | charts of curves as PNG or SVG, or as text | people |
//! | [`report`] | sections of pictures and tables as one HTML page, and as Markdown | people |
//! | [`picture`] | packings of spheres as PNG | people |
//! | [`checkpoint`] | the state of a run, with a checksum | Pulvis; the header: people |
//!
//! # Promises shared by all writers
//!
//! * **A file is whole or absent.** Each file is written under a hidden temporary name beside its place and then renamed,
//!   so a killed run, a full disk or a reader that looks too early never meets half a file. Time series, which grow, are
//!   handed to the system in complete lines.
//! * **The same input gives the same bytes.** No date, host name or random identifier is written.
//! * **Strange numbers do no harm.** Not-a-number and infinities are kept in VTK and CSV, become `null` in JSON, and gaps
//!   or marks with a note in plots and pictures; nothing panics.
//! * **Errors say what to do.** All are [`IoError`].
//!
//! ```
//! use pulvis_io::table::{Cell, Table};
//!
//! # fn main() -> Result<(), pulvis_io::IoError> {
//! let mut table = Table::new(["overlap [m]", "force [N]"]);
//! table.push([Cell::Number(1.0e-6), Cell::Number(0.125)])?;
//! println!("{}", table.to_text(4));
//! # Ok(())
//! # }
//! ```
#![allow(clippy::disallowed_methods)] // the last bit of a plotted number is far below a pixel

pub mod checkpoint;
mod colour;
mod error;
mod file;
mod font;
pub mod frames;
pub mod picture;
pub mod plot;
pub mod report;
pub mod table;
pub mod vtk;

pub use colour::{Colour, ColourMap};
pub use error::IoError;
pub use file::name_of_temporary;
