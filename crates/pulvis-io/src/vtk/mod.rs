//! Particles and contacts as VTK files that both ParaView and OVITO read.
//!
//! A run folder looks like this:
//!
//! ```text
//! series.pvd             the index: time and file of every frame; open this one
//! frame_0000.vtm         one instant: the blocks Particles, Contacts, Walls and Surfaces
//! particles_0000.vtp     points with one array per column
//! contacts_0000.vtp      lines between the centres in contact, with one array per column
//! walls_0000.vtp         edges of walls, and axes of cylinders with their radius
//! surfaces_0000.vtp      walls as triangles; written when a wall has moved, and named by all frames until the next
//! ```
//!
//! The readers agree on one encoding only, which is therefore the one written here: inline base64 without compression,
//! 64-bit lengths, little-endian, no `FieldData` (OVITO refuses a file that has one, so the time lives in the index),
//! the position array named `Points`, and a contact file with two points of its own per line (OVITO tells contacts
//! from a surface by that). Checked with VTK 9.7, pyvista 0.49 and OVITO 3.17; `scripts/check_vtk.py` repeats the check
//! on any run folder. [`SeriesWriter::compressed`] is for those who do without OVITO: appended bytes with zlib, which VTK and ParaView
//! read, and OVITO 3.17 and [`read_frame`] do not.
//!
//! Column names that OVITO understands unaided: `id`, `type`, `radius`, `v` (velocity), `omega`, `f` (force) for
//! particles and `id1`, `id2`, `force` for contacts. ParaView takes any name.
//!
//! A frame names no file without lines: OVITO 3.17 would lose its particles. Known limit: in a frame without contacts OVITO
//! goes on showing the contacts of the first frame; ParaView shows none.
//!
//! ```
//! use pulvis_io::vtk::{Column, ContactFrame, ParticleFrame, SeriesWriter, WallFrame, read_frame, read_series};
//!
//! # fn main() -> Result<(), pulvis_io::IoError> {
//! # let scratch = tempfile::tempdir().expect("a temporary folder");
//! # let folder = scratch.path();
//! let positions = [[0.0, 0.0, 0.0], [0.0019, 0.0, 0.0]];
//! let particles = ParticleFrame {
//!     positions: &positions,
//!     columns: &[Column::index("id", &[1, 2]), Column::scalar("radius", &[0.001, 0.001])],
//! };
//! let contacts = ContactFrame {
//!     ends: &[[positions[0], positions[1]]],
//!     columns: &[
//!         Column::index("id1", &[1]),
//!         Column::index("id2", &[2]),
//!         Column::vector("force", &[[-0.5, 0.0, 0.0]]),
//!     ],
//! };
//! let mut series = SeriesWriter::create(folder, "")?;
//! let walls = WallFrame { ends: &[[[-0.001, 0.0, -0.001], [0.003, 0.0, -0.001]]], radii: &[0.0] };
//! series.write(0.0, &particles, &contacts, &walls)?;
//!
//! let frames = read_series(&folder.join("series.pvd"))?;
//! let frame = read_frame(&folder.join(&frames[0].file))?;
//! assert_eq!(frame.particles.points, positions);
//! # Ok(())
//! # }
//! ```

mod frame;
mod image;
mod index;
mod polydata;
mod read;
mod series;

pub use frame::{
    Column, ContactFrame, ParticleFrame, Values, WallFrame, write_contacts, write_particles, write_walls,
};
pub use image::{ImageGrid, write_image};
pub use index::{Entry, read_series};
pub use read::{Frame, Numbers, PolyData, read_frame, read_frame_without_contacts, read_polydata};
pub use series::SeriesWriter;
