//! Level 0 of the house: scalars, vectors, physical dimensions and checked numbers.
//!
//! Nothing here knows physics. The scalar trait [`Real`] lets one text of a force law serve a
//! single contact (`f64`) and the vectorised contact loop ([`Lanes`]).

mod dimension;

pub use dimension::Dimension;
