//! What stands in a VTK file: its kind, the arrays of its points, the files that it names.

use super::Broken;
use super::array::{Encoding, Stored};
use super::xml::{Kind, Tag, Tags};

/// A VTK file, its numbers still packed.
#[derive(Debug)]
pub(super) struct VtkFile<'a> {
    /// What it says it is, such as `PolyData`.
    pub(super) kind: String,
    pub(super) encoding: Encoding,
    /// Number of its points, if it has any.
    pub(super) points: Option<usize>,
    /// Arrays with a value for each point; the positions are called `Points`.
    pub(super) arrays: Vec<Array<'a>>,
    /// The files that it names.
    pub(super) files: Vec<Named>,
    /// What follows `AppendedData`.
    appended: Option<Stored<'a>>,
}

/// An array.
#[derive(Debug)]
pub(super) struct Array<'a> {
    pub(super) name: String,
    /// The number of its line.
    pub(super) line: usize,
    /// The type of its numbers.
    pub(super) kind: String,
    /// Numbers for each point.
    pub(super) components: usize,
    source: Source<'a>,
}

#[derive(Debug)]
enum Source<'a> {
    Inline(Stored<'a>),
    /// So far behind the beginning of the appended data.
    Appended(usize),
}

/// A file that another one names.
#[derive(Debug)]
pub(super) struct Named {
    pub(super) line: usize,
    /// The name of a block, or the time of an instant.
    pub(super) label: String,
    pub(super) file: String,
}

impl<'a> VtkFile<'a> {
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, Broken> {
        let mut tags = Tags::of(bytes);
        let first = tags.next()?.filter(|tag| tag.name == "VTKFile");
        let root = first.ok_or_else(|| Broken::new(1, "no VTK file", "the tag <VTKFile> first"))?;
        let encoding = encoding(&root)?;
        let kind = root.text("type").unwrap_or_default();
        let mut file =
            Self { kind, encoding, points: None, arrays: Vec::new(), files: Vec::new(), appended: None };
        let mut section = "";
        while let Some(tag) = tags.next()? {
            match (tag.name, tag.kind) {
                ("VTKFile", Kind::Close) => return Ok(file),
                ("Piece", Kind::Open | Kind::Alone) => {
                    if file.points.is_some() {
                        return Err(Broken::new(tag.line, "a second piece", "all particles in one"));
                    }
                    file.points = Some(points(&tag)?);
                }
                ("Points" | "PointData", Kind::Open) => section = tag.name,
                ("Points" | "PointData", Kind::Close) => section = "",
                ("DataSet", Kind::Open | Kind::Alone) => file.files.push(named(&tag)?),
                ("DataArray", kind) if kind != Kind::Close && !section.is_empty() => {
                    file.arrays.push(array(&mut tags, &tag, section, bytes)?);
                }
                ("AppendedData", Kind::Open) => {
                    file.appended = Some(appended(&tag, &bytes[tag.end..])?);
                    return Ok(file);
                }
                _ => {}
            }
        }
        Err(Broken::new(tags.line(), "the end of the file", "</VTKFile>"))
    }

    /// Where the numbers of an array stand.
    pub(super) fn stored(&self, array: &Array<'a>) -> Result<Stored<'a>, String> {
        let offset = match array.source {
            Source::Inline(stored) => return Ok(stored),
            Source::Appended(offset) => offset,
        };
        let beyond = || format!("begins at byte {offset} of the appended data, where nothing is");
        match self.appended.ok_or_else(beyond)? {
            Stored::Bytes(bytes) => bytes.get(offset..).map(Stored::Bytes).ok_or_else(beyond),
            Stored::Base64(text) | Stored::Text(text) => {
                text.get(offset..).map(Stored::Base64).ok_or_else(beyond)
            }
        }
    }
}

fn encoding(root: &Tag<'_>) -> Result<Encoding, Broken> {
    let refused = |found: String, expected: &str| Broken::new(root.line, &found, expected);
    let order = root.attribute("byte_order").unwrap_or("LittleEndian");
    if order != "LittleEndian" {
        return Err(refused(format!("the byte order {order:?}"), "LittleEndian"));
    }
    let header = match root.attribute("header_type").unwrap_or("UInt32") {
        "UInt32" => 4,
        "UInt64" => 8,
        other => return Err(refused(format!("headers of the type {other:?}"), "UInt32 or UInt64")),
    };
    let compressed = match root.attribute("compressor") {
        None => false,
        Some("vtkZLibDataCompressor") => true,
        Some(other) => {
            return Err(refused(format!("the compressor {other:?}"), "vtkZLibDataCompressor or none"));
        }
    };
    Ok(Encoding { header, compressed })
}

fn points(tag: &Tag<'_>) -> Result<usize, Broken> {
    let points = tag.attribute("NumberOfPoints");
    points.and_then(|points| points.trim().parse().ok()).ok_or_else(|| {
        Broken::new(tag.line, points.unwrap_or("no NumberOfPoints"), "the number of points of the piece")
    })
}

fn named(tag: &Tag<'_>) -> Result<Named, Broken> {
    let file = tag.text("file").ok_or_else(|| Broken::new(tag.line, "no name of a file", "file=\"...\""))?;
    let label = tag.text("name").or_else(|| tag.text("timestep")).unwrap_or_default();
    Ok(Named { line: tag.line, label, file })
}

/// An array, and everything up to its end.
fn array<'a>(
    tags: &mut Tags<'a>,
    tag: &Tag<'_>,
    section: &str,
    bytes: &'a [u8],
) -> Result<Array<'a>, Broken> {
    let refused = |found: &str, expected: &str| Broken::new(tag.line, found, expected);
    let name = if section == "Points" { Some("Points".to_owned()) } else { tag.text("Name") };
    let components = tag.attribute("NumberOfComponents").unwrap_or("1");
    let format = tag.attribute("format").unwrap_or("ascii");
    let body = body(tags, tag, bytes)?;
    let source = match format {
        "ascii" => Source::Inline(Stored::Text(body)),
        "binary" => Source::Inline(Stored::Base64(body)),
        "appended" => {
            let offset = tag.attribute("offset");
            let number = offset.and_then(|offset| offset.parse().ok());
            Source::Appended(number.ok_or_else(|| {
                refused(offset.unwrap_or("no offset"), "where the array begins in the appended data")
            })?)
        }
        other => return Err(refused(other, "the format ascii, binary or appended")),
    };
    Ok(Array {
        name: name.ok_or_else(|| refused("an array without a name", "Name=\"...\""))?,
        line: tag.line,
        kind: tag.text("type").unwrap_or_default(),
        components: components.parse().map_err(|_| refused(components, "a number of components"))?,
        source,
    })
}

/// The text of an array; tags in it tell more about it, and are passed over.
fn body<'a>(tags: &mut Tags<'a>, tag: &Tag<'_>, bytes: &'a [u8]) -> Result<&'a [u8], Broken> {
    let (mut body, mut start, mut depth): (&[u8], _, _) = (&[], tag.end, 0);
    if tag.kind == Kind::Alone {
        return Ok(body);
    }
    loop {
        let broken = || Broken::new(tag.line, "an array that does not end", "</DataArray>");
        let next = tags.next()?.ok_or_else(broken)?;
        let before = &bytes[start..next.start];
        if depth == 0 && body.is_empty() {
            body = before.trim_ascii();
        }
        start = next.end;
        match next.kind {
            Kind::Open => depth += 1,
            Kind::Close if depth == 0 => return Ok(body),
            Kind::Close => depth -= 1,
            Kind::Alone => {}
        }
    }
}

/// What follows the underscore.
fn appended<'a>(tag: &Tag<'_>, bytes: &'a [u8]) -> Result<Stored<'a>, Broken> {
    let begin = bytes.iter().position(|byte| !byte.is_ascii_whitespace());
    let Some(begin) = begin.filter(|&begin| bytes[begin] == b'_') else {
        return Err(Broken::new(tag.line, "no appended data", "an underscore before them"));
    };
    let data = &bytes[begin + 1..];
    match tag.attribute("encoding") {
        Some("raw") => Ok(Stored::Bytes(data)),
        Some("base64") => {
            let end = data.iter().position(|&byte| byte == b'<').unwrap_or(data.len());
            Ok(Stored::Base64(data[..end].trim_ascii()))
        }
        other => Err(Broken::new(tag.line, other.unwrap_or("no encoding"), "the encoding raw or base64")),
    }
}
