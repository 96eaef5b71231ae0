//! HDF5: a file for every instant, laid out after H5MD, and an index that ties them together.
//!
//! | file | path | what |
//! | --- | --- | --- |
//! | `NAME_0000.h5` | `/step`, `/time` | one number each; every `step` and `time` below is a link to them |
//! | | `/particles/all/box` | attributes `dimension`, `boundary`; `edges` (a vector a row), `offset` (lower corner) |
//! | | `/particles/all/QUANTITY/value` | \[1\]\[particles\], and the shape of the quantity |
//! | | `/contacts/QUANTITY/value` | \[1\]\[contacts\], and the shape of the quantity |
//! | | `/parameters/materials` | attribute `names`, which `species` counts from 0 |
//! | `NAME.h5` | `/frames/0000` | external link to the file of the instant |
//! | | `/step`, `/time`, `/particle_count`, `/contact_count` | a number for each instant |
//!
//! A file that grows would be lost with the process that is killed while it writes: HDF5 changes its tables in place, and no
//! length of the file gives back what it was. Files of one instant are whole or absent, and the index is replaced as a whole.
//!
//! # Source
//! P. de Buyl, P. H. Colberg, F. Höfling, Comput. Phys. Commun. 185, 1546 (2014), and the H5MD specification 1.1 with its
//! module `units`: elements with `step`, `time` and `value`, `box` with `edges` and `boundary`, attributes `unit`.

#[cfg(not(feature = "hdf5"))]
#[path = "disabled.rs"]
mod imp;
#[cfg(feature = "hdf5")]
#[path = "enabled.rs"]
mod imp;
#[cfg(feature = "hdf5")]
mod layout;

use super::Format;

/// `NAME_0000.h5` and the index `NAME.h5`.
pub(super) const FORMAT: Format = Format {
    name: "hdf5",
    summary: "HDF5 after H5MD, one file per instant and an index of links, for h5py and MATLAB",
    open: imp::open,
    missing: imp::MISSING,
};

/// What a quantity is called in these files: H5MD has names of its own.
pub fn name_of(name: &str) -> &str {
    match name {
        "v" => "velocity",
        "f" => "force",
        "type" => "species",
        other => other,
    }
}
