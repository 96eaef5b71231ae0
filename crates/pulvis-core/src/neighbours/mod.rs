//! Neighbour search: cell order, pairs of neighbouring rows, and when the neighbour list is out of date.

mod grid;
mod moved;
mod skin;

pub(crate) use grid::{CellGrid, RowRangePair};
pub(crate) use moved::Moved;
pub(crate) use skin::{Carried, ListedWall, Skin};
