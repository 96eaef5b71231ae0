//! Values on a regular grid as a VTK image, `.vti`.

use super::frame::Column;
use super::polydata::{section, write_column};
use crate::frames::Precision;
use crate::{IoError, file};
use std::io::Write;
use std::path::Path;

/// A regular grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageGrid {
    /// Lower corner \[m\].
    pub origin: [f64; 3],
    /// Edges of a cell \[m\].
    pub spacing: [f64; 3],
    /// Number of cells along each axis.
    pub cells: [usize; 3],
}

/// Writes an image with one value per cell, x fastest: `path` should end in `.vti`.
///
/// # Errors
/// A column of the wrong length, or a file that cannot be written.
pub fn write_image(path: &Path, grid: &ImageGrid, columns: &[Column<'_>]) -> Result<(), IoError> {
    let cells: usize = grid.cells.iter().product();
    super::frame::check(columns, cells, "cells")?;
    let words = |values: [f64; 3]| values.map(|value| format!("{value:?}")).join(" ");
    let extent = grid.cells.map(|count| format!("0 {count}")).join(" ");
    file::replace(path, |out| {
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(
            out,
            "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">"
        )?;
        writeln!(
            out,
            "<ImageData WholeExtent=\"{extent}\" Origin=\"{}\" Spacing=\"{}\">",
            words(grid.origin),
            words(grid.spacing)
        )?;
        writeln!(out, "<Piece Extent=\"{extent}\">")?;
        section(out, "PointData", |_| Ok(()))?;
        section(out, "CellData", |out| {
            columns.iter().try_for_each(|column| write_column(out, column, Precision::Double))
        })?;
        writeln!(out, "</Piece>\n</ImageData>\n</VTKFile>")
    })
}
