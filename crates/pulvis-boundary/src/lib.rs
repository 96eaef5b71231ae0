//! What surrounds the particles: blocks of space, periodic directions, gravity and drag, shapes of walls and
//! how they move.
//!
//! These are the types that scenario files are read into, that packings are made in and that the engine
//! computes with. They know no particles, no engine and no files.

mod background;
mod cuboid;
mod deformation;
mod domain;
mod electrostatics;
pub mod motion;
mod region;
mod shape;
mod temperature;

pub use background::{Background, Drag};
pub use cuboid::Cuboid;
pub use deformation::UpperTriangular;
pub use domain::{Domain, Images};
pub use electrostatics::Electrostatics;
pub use motion::{CellContent, CellControl, CellMotion, GroupMotion, WallMotion};
pub use region::Region;
pub use shape::{
    Cone, Cylinder, CylinderSide, Disk, EdgedShape, Edgeless, EdgelessShape, FeatureSurface, InvalidMesh,
    MOST_HOLLOW, Mesh, Plane, PlaneWithHole, Shape, Surface, TriangleMesh, Tube, WallShape,
};
pub use temperature::{InvalidProgram, TemperatureProgram};
