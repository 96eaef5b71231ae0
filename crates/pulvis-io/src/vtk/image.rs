//! Values on a regular grid as a VTK image, `.vti`.

use super::frame::Column;
use super::polydata::{Xml, section, write_column};
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
        let xml = &mut Xml::new(out, false);
        let head = xml.head();
        writeln!(xml.out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" {head}>")?;
        writeln!(
            xml.out,
            "<ImageData WholeExtent=\"{extent}\" Origin=\"{}\" Spacing=\"{}\">",
            words(grid.origin),
            words(grid.spacing)
        )?;
        writeln!(xml.out, "<Piece Extent=\"{extent}\">")?;
        section(xml, "PointData", |_| Ok(()))?;
        section(xml, "CellData", |xml| {
            columns.iter().try_for_each(|column| write_column(xml, column, Precision::Double))
        })?;
        writeln!(xml.out, "</Piece>\n</ImageData>\n</VTKFile>")
    })
}
