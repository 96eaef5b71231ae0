//! The XML of a `PolyData` file, streamed: nothing is held in memory but a few kilobytes.

use super::frame::{Column, Values};
use crate::frames::Precision;
use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use std::io::{self, Write};

/// What joins the points of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cells {
    /// Each point is a cell of its own; columns belong to the points.
    Vertices,
    /// Each pair of points in a row is a line; columns belong to the lines.
    Lines,
    /// Three points in a row are a triangle; columns belong to the triangles.
    Triangles,
}

/// Writes points (three coordinates each), the cells that join them, and the columns.
pub(crate) fn write(
    out: &mut impl Write,
    coordinates: &[f64],
    cells: Cells,
    columns: &[Column<'_>],
    precision: Precision,
) -> io::Result<()> {
    let points = coordinates.len() / 3;
    let [vertices, lines, triangles] = match cells {
        Cells::Vertices => [points, 0, 0],
        Cells::Lines => [0, points / 2, 0],
        Cells::Triangles => [0, 0, points / 3],
    };
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(
        out,
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">"
    )?;
    writeln!(out, "<PolyData>")?;
    writeln!(
        out,
        "<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{vertices}\" NumberOfLines=\"{lines}\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"{triangles}\">"
    )?;
    section(out, "Points", |out| floats(out, "Points", 3, coordinates, precision))?;
    let columns = |out: &mut _| columns.iter().try_for_each(|column| write_column(out, column, precision));
    match cells {
        Cells::Vertices => {
            section(out, "PointData", columns)?;
            section(out, "Verts", |out| topology(out, points, 1))?;
        }
        Cells::Lines => {
            section(out, "CellData", columns)?;
            section(out, "Lines", |out| topology(out, points, 2))?;
        }
        Cells::Triangles => {
            section(out, "CellData", columns)?;
            section(out, "Polys", |out| topology(out, points, 3))?;
        }
    }
    writeln!(out, "</Piece>\n</PolyData>\n</VTKFile>")
}

pub(super) fn section<W: Write>(
    out: &mut W,
    tag: &str,
    body: impl FnOnce(&mut W) -> io::Result<()>,
) -> io::Result<()> {
    writeln!(out, "<{tag}>")?;
    body(out)?;
    writeln!(out, "</{tag}>")
}

pub(super) fn write_column(
    out: &mut impl Write,
    column: &Column<'_>,
    precision: Precision,
) -> io::Result<()> {
    let name = column.name;
    match column.values {
        Values::Scalar(values) => floats(out, name, 1, values, precision),
        Values::Vector(values) => floats(out, name, 3, values.as_flattened(), precision),
        Values::Tensor(values) => floats(out, name, 9, values.as_flattened(), precision),
        Values::Integer(values) => array(out, name, "Int64", 1, values.iter().map(|x| x.to_le_bytes())),
        Values::Index(values) => {
            array(out, name, "Int64", 1, values.iter().map(|&x| i64::from(x).to_le_bytes()))
        }
    }
}

/// An array of floating numbers.
fn floats(
    out: &mut impl Write,
    name: &str,
    components: usize,
    values: &[f64],
    precision: Precision,
) -> io::Result<()> {
    match precision {
        Precision::Double => array(out, name, "Float64", components, values.iter().map(|x| x.to_le_bytes())),
        Precision::Single => {
            array(out, name, "Float32", components, values.iter().map(|&x| (x as f32).to_le_bytes()))
        }
    }
}

/// Points in a row belong together in groups of `size`.
fn topology(out: &mut impl Write, points: usize, size: usize) -> io::Result<()> {
    let integer = |value: usize| (value as u64).to_le_bytes();
    array(out, "connectivity", "Int64", 1, (0..points).map(integer))?;
    array(out, "offsets", "Int64", 1, (0..points / size).map(|group| integer((group + 1) * size)))
}

/// Bytes handed to the encoder at once; a multiple of its groups of three, so that it keeps nothing back.
const CHUNK: usize = 6144;

/// One array: the payload's length [byte] as a 64-bit integer and the payload, in one base64 stream.
fn array<I, const BYTES: usize>(
    out: &mut impl Write,
    name: &str,
    kind: &str,
    components: usize,
    values: I,
) -> io::Result<()>
where
    I: ExactSizeIterator<Item = [u8; BYTES]>,
{
    let name = escape(name);
    writeln!(
        out,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">"
    )?;
    let mut encoder = EncoderWriter::new(&mut *out, &STANDARD);
    encoder.write_all(&((BYTES * values.len()) as u64).to_le_bytes())?;
    // The encoder works on what one call hands it: single numbers would make it four times slower.
    let mut chunk = Vec::with_capacity(CHUNK);
    for value in values {
        chunk.extend_from_slice(&value);
        if chunk.len() >= CHUNK {
            encoder.write_all(&chunk)?;
            chunk.clear();
        }
    }
    encoder.write_all(&chunk)?;
    encoder.finish()?;
    drop(encoder);
    writeln!(out, "\n</DataArray>")
}

/// Text as an XML attribute.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // XML 1.0 has no way to write the other control characters.
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}
