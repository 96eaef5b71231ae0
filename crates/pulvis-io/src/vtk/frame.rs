//! One instant as borrowed columns, and the two kinds of `.vtp` file made of it.

use super::polydata::{self, Cells};
use crate::frames::Precision;
use crate::{IoError, file};
use std::collections::HashSet;
use std::path::Path;

/// A named array with one value per particle or per contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column<'a> {
    /// Name under which readers show the array. Write units into it if they are not SI.
    pub name: &'a str,
    /// The values.
    pub values: Values<'a>,
}

/// The values of a [`Column`], borrowed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Values<'a> {
    /// One number per row; 64-bit float in the file.
    Scalar(&'a [f64]),
    /// One vector per row; three components of 64-bit float in the file.
    Vector(&'a [[f64; 3]]),
    /// One tensor per row; nine components of 64-bit float in the file, xx, xy, xz, yx and so on.
    Tensor(&'a [[f64; 9]]),
    /// One signed whole number per row; 64-bit integer in the file.
    Integer(&'a [i64]),
    /// One identifier per row; widened to a 64-bit integer in the file, which every reader knows.
    Index(&'a [u32]),
}

impl<'a> Column<'a> {
    /// A column of numbers.
    pub fn scalar(name: &'a str, values: &'a [f64]) -> Self {
        Self { name, values: Values::Scalar(values) }
    }

    /// A column of vectors.
    pub fn vector(name: &'a str, values: &'a [[f64; 3]]) -> Self {
        Self { name, values: Values::Vector(values) }
    }

    /// A column of tensors.
    pub fn tensor(name: &'a str, values: &'a [[f64; 9]]) -> Self {
        Self { name, values: Values::Tensor(values) }
    }

    /// A column of signed whole numbers.
    pub fn integer(name: &'a str, values: &'a [i64]) -> Self {
        Self { name, values: Values::Integer(values) }
    }

    /// A column of identifiers.
    pub fn index(name: &'a str, values: &'a [u32]) -> Self {
        Self { name, values: Values::Index(values) }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        match self.values {
            Values::Scalar(values) => values.len(),
            Values::Vector(values) => values.len(),
            Values::Tensor(values) => values.len(),
            Values::Integer(values) => values.len(),
            Values::Index(values) => values.len(),
        }
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The particles of one instant.
#[derive(Clone, Copy, Debug)]
pub struct ParticleFrame<'a> {
    /// Centre of each particle \[m\].
    pub positions: &'a [[f64; 3]],
    /// Named arrays with one value per particle.
    pub columns: &'a [Column<'a>],
}

/// The contacts of one instant.
#[derive(Clone, Copy, Debug)]
pub struct ContactFrame<'a> {
    /// The two points that each contact joins, usually the centres of its particles \[m\].
    ///
    /// Across a periodic face give the image next to the first particle, or the line will cross the whole box.
    pub ends: &'a [[[f64; 3]; 2]],
    /// Named arrays with one value per contact.
    pub columns: &'a [Column<'a>],
}

/// The walls of one instant: edges, and axes of cylinders.
#[derive(Clone, Copy, Debug)]
pub struct WallFrame<'a> {
    /// Ends of each line \[m\].
    pub ends: &'a [[[f64; 3]; 2]],
    /// Radius of each cylinder whose axis a line is, 0 for an edge \[m\].
    pub radii: &'a [f64],
}

/// Writes triangles: `path` should end in `.vtp`. Three points in a row are one; columns have one value per triangle.
pub(super) fn write_triangles(
    path: &Path,
    corners: &[[f64; 3]],
    columns: &[Column<'_>],
) -> Result<(), IoError> {
    check(columns, corners.len() / 3, "triangles")?;
    let coordinates = corners.as_flattened();
    file::replace(path, |file| {
        polydata::write(file, coordinates, Cells::Triangles, columns, Precision::Double, false)
    })
}

/// Writes particles as points: `path` should end in `.vtp`.
///
/// # Errors
/// A column of the wrong length, a name used twice, or a file that cannot be written.
pub fn write_particles(path: &Path, frame: &ParticleFrame<'_>) -> Result<(), IoError> {
    write_particles_as(path, frame, Precision::Double, false)
}

/// The same with numbers of this precision, compressed if asked for.
pub(super) fn write_particles_as(
    path: &Path,
    frame: &ParticleFrame<'_>,
    precision: Precision,
    compressed: bool,
) -> Result<(), IoError> {
    check(frame.columns, frame.positions.len(), "particles")?;
    file::replace(path, |file| {
        polydata::write(
            file,
            frame.positions.as_flattened(),
            Cells::Vertices,
            frame.columns,
            precision,
            compressed,
        )
    })
}

/// Writes contacts as lines of two points each: `path` should end in `.vtp`.
///
/// # Errors
/// A column of the wrong length, a name used twice, or a file that cannot be written.
pub fn write_contacts(path: &Path, frame: &ContactFrame<'_>) -> Result<(), IoError> {
    write_contacts_as(path, frame, Precision::Double, false)
}

/// The same with numbers of this precision, compressed if asked for.
pub(super) fn write_contacts_as(
    path: &Path,
    frame: &ContactFrame<'_>,
    precision: Precision,
    compressed: bool,
) -> Result<(), IoError> {
    check(frame.columns, frame.ends.len(), "contacts")?;
    let coordinates = frame.ends.as_flattened().as_flattened();
    file::replace(path, |file| {
        polydata::write(file, coordinates, Cells::Lines, frame.columns, precision, compressed)
    })
}

/// Writes walls as lines of two points each: `path` should end in `.vtp`.
///
/// # Errors
/// Not one radius per line, or a file that cannot be written.
pub fn write_walls(path: &Path, frame: &WallFrame<'_>) -> Result<(), IoError> {
    let columns = [Column::scalar("radius", frame.radii)];
    check(&columns, frame.ends.len(), "walls")?;
    let coordinates = frame.ends.as_flattened().as_flattened();
    file::replace(path, |file| {
        polydata::write(file, coordinates, Cells::Lines, &columns, Precision::Double, false)
    })
}

/// Every column has one value per row and its own name.
pub(super) fn check(columns: &[Column<'_>], rows: usize, what: &'static str) -> Result<(), IoError> {
    let mut names = HashSet::new();
    for column in columns {
        if column.len() != rows {
            let (column, found) = (column.name.to_owned(), column.len());
            return Err(IoError::ColumnLength { column, rows: what, expected: rows, found });
        }
        if !names.insert(column.name) {
            return Err(IoError::DuplicateColumn { column: column.name.to_owned() });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;

    /// Length header and payload of the array `name`, decoded without the writer's code.
    fn payload(text: &str, name: &str) -> Vec<u8> {
        let start = text.find(&format!("Name=\"{name}\"")).unwrap();
        let body = &text[start..];
        let body = &body[body.find('>').unwrap() + 1..body.find("</DataArray>").unwrap()];
        let bytes = STANDARD.decode(body.trim()).unwrap();
        let length = u64::from_le_bytes(bytes[..8].try_into().unwrap());
        assert_eq!(length as usize, bytes.len() - 8, "the header tells the payload's length");
        bytes[8..].to_vec()
    }

    fn floats(bytes: &[u8]) -> Vec<u64> {
        bytes.chunks_exact(8).map(|chunk| u64::from_le_bytes(chunk.try_into().unwrap())).collect()
    }

    fn written(write: impl FnOnce(&Path)) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file.vtp");
        write(&path);
        std::fs::read_to_string(path).unwrap()
    }

    /// More rows than one encoder chunk, with the bits that text formats lose.
    fn awkward(rows: usize) -> Vec<f64> {
        let special = [0.0, -0.0, f64::NAN, f64::NEG_INFINITY, f64::MIN_POSITIVE / 4.0, 0.1, f64::MAX];
        (0..rows).map(|row| special.get(row).copied().unwrap_or((row as f64).sqrt().sin())).collect()
    }

    #[test]
    fn particle_columns_come_back_bit_for_bit() {
        let radius = awkward(5003);
        let positions: Vec<[f64; 3]> = radius.iter().map(|&r| [r, -r, 3.0 * r]).collect();
        let charge: Vec<i64> = (0..5003).map(|row| i64::MIN + row).collect();
        let id: Vec<u32> = (0..5003).map(|row| u32::MAX - row).collect();
        let columns = [
            Column::scalar("radius", &radius),
            Column::vector("velocity", &positions),
            Column::integer("charge", &charge),
            Column::index("id", &id),
        ];
        let text = written(|path| {
            write_particles(path, &ParticleFrame { positions: &positions, columns: &columns }).unwrap();
        });
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(floats(&payload(&text, "radius")), bits(&radius));
        assert_eq!(floats(&payload(&text, "velocity")), bits(positions.as_flattened()));
        assert_eq!(floats(&payload(&text, "Points")), bits(positions.as_flattened()));
        assert_eq!(floats(&payload(&text, "charge")), charge.iter().map(|&c| c as u64).collect::<Vec<_>>());
        assert_eq!(floats(&payload(&text, "id")), id.iter().map(|&i| u64::from(i)).collect::<Vec<_>>());
        assert!(!text.contains("FieldData") && !text.contains("compressor"), "OVITO refuses both");
    }

    #[test]
    fn each_contact_is_a_line_with_two_points_of_its_own() {
        let ends = [[[0.0; 3], [1.0; 3]], [[1.0; 3], [2.0; 3]]];
        let columns = [Column::index("id1", &[1, 2]), Column::index("id2", &[2, 3])];
        let text =
            written(|path| write_contacts(path, &ContactFrame { ends: &ends, columns: &columns }).unwrap());
        assert!(text.contains("NumberOfPoints=\"4\"") && text.contains("NumberOfLines=\"2\""));
        assert_eq!(floats(&payload(&text, "connectivity")), [0, 1, 2, 3]);
        assert_eq!(floats(&payload(&text, "offsets")), [2, 4]);
    }

    #[test]
    fn names_are_escaped_for_xml() {
        let columns = [Column::scalar("a<b & \"c\"", &[])];
        let text = written(|path| {
            write_particles(path, &ParticleFrame { positions: &[], columns: &columns }).unwrap()
        });
        assert!(text.contains("Name=\"a&lt;b &amp; &quot;c&quot;\""), "{text}");
    }

    #[test]
    fn a_column_of_another_length_or_a_second_use_of_a_name_is_refused() {
        let path = Path::new("never-written.vtp");
        let short = [Column::scalar("radius", &[1.0])];
        let error = write_particles(path, &ParticleFrame { positions: &[[0.0; 3]; 2], columns: &short });
        assert!(matches!(error, Err(IoError::ColumnLength { expected: 2, found: 1, .. })));
        let twice = [Column::scalar("force", &[]), Column::index("force", &[])];
        let error = write_contacts(path, &ContactFrame { ends: &[], columns: &twice });
        assert!(matches!(error, Err(IoError::DuplicateColumn { .. })));
        assert!(!path.exists());
    }
}
