//! STL, binary and text.
//!
//! # Source
//! 3D Systems, StereoLithography Interface Specification (1989). A binary file has 80 bytes of header, the number of
//! triangles, and for each 12 numbers (normal, corners) of 4 bytes and 2 bytes of attributes, the lowest byte first. Normals
//! are not read: they follow from the corners.

use pulvis_math::Vector3;

use super::{MeshFileError, coordinates};

const HEADER: usize = 84;
const TRIANGLE: usize = 50;

pub(super) fn parse(file: &str, bytes: &[u8]) -> Result<Vec<[Vector3; 3]>, MeshFileError> {
    let stated = bytes.get(80..HEADER).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    let length = stated.map(|count| HEADER as u64 + TRIANGLE as u64 * u64::from(count));
    // Headers of binary files may begin with `solid` too: only the length tells.
    if length == Some(bytes.len() as u64) {
        return Ok(bytes[HEADER..].chunks_exact(TRIANGLE).map(triangle).collect());
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if text.trim_start().starts_with("solid") => parse_text(file, text),
        _ => {
            let expected = length.unwrap_or(HEADER as u64);
            Err(MeshFileError::Length { file: file.to_owned(), found: bytes.len(), expected })
        }
    }
}

/// The corners of a binary triangle.
fn triangle(record: &[u8]) -> [Vector3; 3] {
    let number = |index: usize| {
        let bytes = std::array::from_fn(|byte| record[4 * index + byte]);
        f64::from(f32::from_le_bytes(bytes))
    };
    // The first three numbers are the normal.
    [3, 6, 9].map(|first| Vector3::new(number(first), number(first + 1), number(first + 2)))
}

fn parse_text(file: &str, text: &str) -> Result<Vec<[Vector3; 3]>, MeshFileError> {
    let mut triangles = Vec::new();
    let mut corners: Vec<Vector3> = Vec::new();
    for (index, content) in text.lines().enumerate() {
        let words: Vec<&str> = content.split_whitespace().collect();
        let line = index + 1;
        let refused = |expected| {
            let found = content.trim().to_owned();
            Err(MeshFileError::Line { file: file.to_owned(), line, found, expected })
        };
        match words.first().map(|word| word.to_lowercase()).as_deref() {
            Some("vertex") => corners.push(coordinates(file, line, &words[1..])?),
            Some("endloop") => match corners[..] {
                [a, b, c] => {
                    triangles.push([a, b, c]);
                    corners.clear();
                }
                _ => return refused("three lines `vertex` before it"),
            },
            Some("solid" | "facet" | "outer" | "endfacet" | "endsolid") if corners.is_empty() => {}
            None => {}
            _ => {
                return refused(
                    "a line of an STL file: solid, facet, outer loop, vertex, endloop, endfacet, endsolid",
                );
            }
        }
    }
    if corners.is_empty() {
        return Ok(triangles);
    }
    let (line, found) = (text.lines().count(), "the end of the file".to_owned());
    Err(MeshFileError::Line { file: file.to_owned(), line, found, expected: "`endloop` after three corners" })
}
