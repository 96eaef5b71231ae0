//! Neighbour search: cell order, candidate pairs, and when both are out of date.

mod grid;
mod skin;

pub(crate) use grid::{CellGrid, Stretch};
pub(crate) use skin::{Moved, Skin};
