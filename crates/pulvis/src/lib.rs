//! Pulvis as one dependency: everything a Rust user needs, under one name.
pub use pulvis_boundary as boundary;
pub use pulvis_contact as contact;
pub use pulvis_core as core;
pub use pulvis_input as input;
pub use pulvis_io as io;
pub use pulvis_lab as lab;
pub use pulvis_math as math;
pub use pulvis_packing as packing;
