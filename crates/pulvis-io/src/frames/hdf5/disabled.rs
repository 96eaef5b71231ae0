//! Instead of the writer, where the program was built without the feature `hdf5`.

use crate::IoError;
use crate::frames::{FrameWriter, Series};

/// How to get it.
pub(super) const MISSING: Option<&str> = Some(
    "build it with `cargo build --release -p pulvis-cli --features hdf5`, which needs the HDF5 library and its headers (Debian: libhdf5-dev)",
);

pub(super) fn open(_series: &Series<'_>) -> Result<Box<dyn FrameWriter>, IoError> {
    Err(IoError::NotBuilt { format: "hdf5", advice: MISSING.unwrap_or_default() })
}
