//! Neighbour search: cell order, candidate pairs, and when both are out of date.

mod grid;
mod moved;
mod skin;

pub(crate) use grid::{CellGrid, RowRangePair};
pub(crate) use moved::Moved;
pub(crate) use skin::Skin;
