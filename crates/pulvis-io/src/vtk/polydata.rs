//! The XML of a `PolyData` file, streamed: nothing is held in memory but a few kilobytes.

use super::frame::{Column, Values};
use crate::frames::Precision;
use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use flate2::Compression;
use flate2::write::ZlibEncoder;
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

/// Where and how arrays are written.
pub(super) struct Xml<'w, W: Write> {
    pub(super) out: &'w mut W,
    /// Compressed arrays, which follow at the end of the file; `None` writes them where they belong, as text.
    appended: Option<Vec<u8>>,
}

impl<'w, W: Write> Xml<'w, W> {
    /// Arrays where they belong, or compressed at the end.
    pub(super) fn new(out: &'w mut W, compressed: bool) -> Self {
        Self { out, appended: compressed.then(Vec::new) }
    }

    /// The attributes of the file.
    pub(super) fn head(&self) -> &'static str {
        match self.appended {
            None => "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"",
            Some(_) => {
                "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\""
            }
        }
    }

    /// The compressed arrays.
    pub(super) fn append(&mut self) -> io::Result<()> {
        let Some(data) = &self.appended else { return Ok(()) };
        write!(self.out, "<AppendedData encoding=\"raw\">\n_")?;
        self.out.write_all(data)?;
        writeln!(self.out, "\n</AppendedData>")
    }
}

/// Bytes that are compressed together: what VTK itself takes.
const BLOCK: usize = 32_768;

/// An array as the VTK library reads it: numbers of blocks, of bytes in a block, of bytes in a last block that is not full, and of
/// bytes of each compressed block, as 64-bit integers; then the blocks.
fn compress(bytes: &[u8], data: &mut Vec<u8>) -> io::Result<()> {
    let mut blocks = Vec::new();
    for block in bytes.chunks(BLOCK) {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(block)?;
        blocks.push(encoder.finish()?);
    }
    let sizes = blocks.iter().map(Vec::len);
    for number in [blocks.len(), BLOCK, bytes.len() % BLOCK].into_iter().chain(sizes) {
        data.extend((number as u64).to_le_bytes());
    }
    data.extend(blocks.concat());
    Ok(())
}

/// Writes points (three coordinates each), the cells that join them, and the columns.
pub(crate) fn write(
    out: &mut impl Write,
    coordinates: &[f64],
    cells: Cells,
    columns: &[Column<'_>],
    precision: Precision,
    compressed: bool,
) -> io::Result<()> {
    let xml = &mut Xml::new(out, compressed);
    let points = coordinates.len() / 3;
    let [vertices, lines, triangles] = match cells {
        Cells::Vertices => [points, 0, 0],
        Cells::Lines => [0, points / 2, 0],
        Cells::Triangles => [0, 0, points / 3],
    };
    let head = xml.head();
    writeln!(xml.out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" {head}>")?;
    writeln!(xml.out, "<PolyData>")?;
    writeln!(
        xml.out,
        "<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{vertices}\" NumberOfLines=\"{lines}\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"{triangles}\">"
    )?;
    section(xml, "Points", |xml| floats(xml, "Points", 3, coordinates, precision))?;
    let columns = |xml: &mut _| columns.iter().try_for_each(|column| write_column(xml, column, precision));
    match cells {
        Cells::Vertices => {
            section(xml, "PointData", columns)?;
            section(xml, "Verts", |xml| topology(xml, points, 1))?;
        }
        Cells::Lines => {
            section(xml, "CellData", columns)?;
            section(xml, "Lines", |xml| topology(xml, points, 2))?;
        }
        Cells::Triangles => {
            section(xml, "CellData", columns)?;
            section(xml, "Polys", |xml| topology(xml, points, 3))?;
        }
    }
    writeln!(xml.out, "</Piece>\n</PolyData>")?;
    xml.append()?;
    writeln!(xml.out, "</VTKFile>")
}

pub(super) fn section<'w, W: Write>(
    xml: &mut Xml<'w, W>,
    tag: &str,
    body: impl FnOnce(&mut Xml<'w, W>) -> io::Result<()>,
) -> io::Result<()> {
    writeln!(xml.out, "<{tag}>")?;
    body(xml)?;
    writeln!(xml.out, "</{tag}>")
}

pub(super) fn write_column<W: Write>(
    xml: &mut Xml<'_, W>,
    column: &Column<'_>,
    precision: Precision,
) -> io::Result<()> {
    let name = column.name;
    match column.values {
        Values::Scalar(values) => floats(xml, name, 1, values, precision),
        Values::Vector(values) => floats(xml, name, 3, values.as_flattened(), precision),
        Values::Tensor(values) => floats(xml, name, 9, values.as_flattened(), precision),
        Values::Integer(values) => array(xml, name, "Int64", 1, values.iter().map(|x| x.to_le_bytes())),
        Values::Index(values) => {
            array(xml, name, "Int64", 1, values.iter().map(|&x| i64::from(x).to_le_bytes()))
        }
    }
}

/// An array of floating numbers.
fn floats<W: Write>(
    xml: &mut Xml<'_, W>,
    name: &str,
    components: usize,
    values: &[f64],
    precision: Precision,
) -> io::Result<()> {
    match precision {
        Precision::Double => array(xml, name, "Float64", components, values.iter().map(|x| x.to_le_bytes())),
        Precision::Single => {
            array(xml, name, "Float32", components, values.iter().map(|&x| (x as f32).to_le_bytes()))
        }
    }
}

/// Points in a row belong together in groups of `size`.
fn topology<W: Write>(xml: &mut Xml<'_, W>, points: usize, size: usize) -> io::Result<()> {
    let integer = |value: usize| (value as u64).to_le_bytes();
    array(xml, "connectivity", "Int64", 1, (0..points).map(integer))?;
    array(xml, "offsets", "Int64", 1, (0..points / size).map(|group| integer((group + 1) * size)))
}

/// Bytes handed to the encoder at once; a multiple of its groups of three, so that it keeps nothing back.
const CHUNK: usize = 6144;

/// One array: the payload's length [byte] as a 64-bit integer and the payload, in one base64 stream.
fn array<W: Write, I, const BYTES: usize>(
    xml: &mut Xml<'_, W>,
    name: &str,
    kind: &str,
    components: usize,
    values: I,
) -> io::Result<()>
where
    I: ExactSizeIterator<Item = [u8; BYTES]>,
{
    let name = escape(name);
    write!(xml.out, "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" ")?;
    if let Some(data) = &mut xml.appended {
        writeln!(xml.out, "format=\"appended\" offset=\"{}\"/>", data.len())?;
        return compress(&values.flatten().collect::<Vec<u8>>(), data);
    }
    writeln!(xml.out, "format=\"binary\">")?;
    let mut encoder = EncoderWriter::new(&mut *xml.out, &STANDARD);
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
    writeln!(xml.out, "\n</DataArray>")
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
