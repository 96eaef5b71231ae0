//! Frames in memory, read back from files that this module wrote; other VTK files are not understood.

use super::frame::Column;
use super::index::{attribute, read_blocks, unescape};
use crate::IoError;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::path::Path;

/// The numbers of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// One number per row.
    Scalar(Vec<f64>),
    /// One vector per row.
    Vector(Vec<[f64; 3]>),
    /// One tensor per row, xx, xy, xz, yx and so on.
    Tensor(Vec<[f64; 9]>),
    /// One whole number per row.
    Integer(Vec<i64>),
}

/// Points and named columns: a file, or what becomes one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolyData {
    /// The points \[m\]: one per particle, two per line, three per triangle.
    pub points: Vec<[f64; 3]>,
    /// Named columns, one value per particle, line or triangle.
    pub columns: Vec<(String, Numbers)>,
}

/// One instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// The particles.
    pub particles: PolyData,
    /// The contacts.
    pub contacts: PolyData,
    /// The walls as lines; none in frames that older versions wrote.
    pub walls: PolyData,
    /// The walls as triangles, three points each, with the number of the wall in the column `wall`.
    pub surfaces: PolyData,
}

impl PolyData {
    /// The column of this name.
    pub fn column(&self, name: &str) -> Option<&Numbers> {
        self.columns.iter().find(|(known, _)| known == name).map(|(_, numbers)| numbers)
    }

    /// The column of this name, if it holds numbers; whole ones become floating ones.
    pub fn scalar(&self, name: &str) -> Option<Vec<f64>> {
        match self.column(name)? {
            Numbers::Scalar(values) => Some(values.clone()),
            Numbers::Integer(values) => Some(values.iter().map(|&value| value as f64).collect()),
            Numbers::Vector(_) | Numbers::Tensor(_) => None,
        }
    }

    /// The columns for the writers.
    pub(super) fn borrowed(&self) -> Vec<Column<'_>> {
        let columns = self.columns.iter().map(|(name, numbers)| match numbers {
            Numbers::Scalar(values) => Column::scalar(name, values),
            Numbers::Vector(values) => Column::vector(name, values),
            Numbers::Tensor(values) => Column::tensor(name, values),
            Numbers::Integer(values) => Column::integer(name, values),
        });
        columns.collect()
    }

    /// The corners of each triangle.
    pub fn triangles(&self) -> Vec<[[f64; 3]; 3]> {
        self.points.as_chunks().0.to_vec()
    }

    /// The ends of each line.
    pub fn lines(&self) -> Vec<[[f64; 3]; 2]> {
        self.points.as_chunks().0.to_vec()
    }
}

impl Numbers {
    fn len(&self) -> usize {
        match self {
            Self::Scalar(values) => values.len(),
            Self::Vector(values) => values.len(),
            Self::Tensor(values) => values.len(),
            Self::Integer(values) => values.len(),
        }
    }
}

/// Reads a frame: the `.vtm` file and those that it names.
///
/// # Errors
/// A file cannot be read, or is not one that Pulvis wrote.
pub fn read_frame(path: &Path) -> Result<Frame, IoError> {
    read(path, true)
}

/// Reads particles and lines of walls of a frame, but no contacts, which are most of it, and no surfaces.
///
/// # Errors
/// A file cannot be read, or is not one that Pulvis wrote.
pub fn read_frame_without_contacts(path: &Path) -> Result<Frame, IoError> {
    read(path, false)
}

fn read(path: &Path, with_contacts: bool) -> Result<Frame, IoError> {
    let mut frame = Frame::default();
    let folder = path.parent().unwrap_or(Path::new(""));
    for (name, file) in read_blocks(path)? {
        let block = match name.as_str() {
            "Particles" => &mut frame.particles,
            "Contacts" if with_contacts => &mut frame.contacts,
            "Walls" => &mut frame.walls,
            "Surfaces" if with_contacts => &mut frame.surfaces,
            _ => continue,
        };
        *block = read_polydata(&folder.join(file))?;
    }
    Ok(frame)
}

/// Reads points and columns of a `.vtp` file.
///
/// # Errors
/// The file cannot be read, or is not one that Pulvis wrote.
pub fn read_polydata(path: &Path) -> Result<PolyData, IoError> {
    let text = std::fs::read_to_string(path).map_err(|source| IoError::system("read", path, source))?;
    parse(&text).map_err(|problem| IoError::Frame { path: path.to_path_buf(), problem })
}

/// The parts of a file that hold arrays.
const SECTIONS: [&str; 6] = ["<Points>", "<PointData>", "<CellData>", "<Verts>", "<Lines>", "<Polys>"];

fn parse(text: &str) -> Result<PolyData, String> {
    let mut lines = text.lines();
    let mut data = PolyData::default();
    let (mut section, mut rows) = ("", None);
    while let Some(line) = lines.next() {
        if line.starts_with("<Piece ") {
            let count = |name| attribute(line, name).and_then(|text| text.parse::<usize>().ok());
            let counts = count("NumberOfPoints").zip(count("NumberOfLines"));
            let (points, lines) = counts.ok_or("its piece has no numbers of points and lines")?;
            let cells = lines + count("NumberOfPolys").unwrap_or(0);
            rows = Some((points, if cells > 0 || points == 0 { cells } else { points }));
        } else if SECTIONS.contains(&line) {
            section = line;
        } else if line.starts_with("<DataArray ") {
            // An array ends on the line after its numbers; of those that join points nothing is needed.
            let body = lines.next().ok_or("it breaks off in an array")?;
            if !matches!(section, "<Verts>" | "<Lines>" | "<Polys>") {
                let name = unescape(attribute(line, "Name").ok_or("an array has no name")?);
                let numbers = numbers(line, body).map_err(|problem| format!("array `{name}` {problem}"))?;
                data.columns.push((name, numbers));
            }
        }
    }
    if text.lines().next_back() != Some("</VTKFile>") {
        return Err("it breaks off".to_owned());
    }
    let (points, rows) = rows.ok_or("it has no piece")?;
    let place = data.columns.iter().position(|(name, _)| name == "Points").ok_or("it has no points")?;
    let Numbers::Vector(found) = data.columns.remove(place).1 else {
        return Err("its points have not three coordinates each".to_owned());
    };
    data.points = found;
    if data.points.len() != points {
        return Err(format!("it has {} points and announces {points}", data.points.len()));
    }
    match data.columns.iter().find(|(_, numbers)| numbers.len() != rows) {
        Some((name, numbers)) => Err(format!("array `{name}` has {} values for {rows} rows", numbers.len())),
        None => Ok(data),
    }
}

/// The numbers of an array: length [byte] and payload in one text.
fn numbers(head: &str, body: &str) -> Result<Numbers, String> {
    let bytes = STANDARD.decode(body).map_err(|error| format!("is no base64 text: {error}"))?;
    let Some((length, numbers)) = bytes.split_first_chunk::<8>() else {
        return Err("has broken numbers".to_owned());
    };
    let single = attribute(head, "type") == Some("Float32");
    if !numbers.len().is_multiple_of(if single { 4 } else { 8 }) {
        return Err("has broken numbers".to_owned());
    }
    if u64::from_le_bytes(*length) != numbers.len() as u64 {
        return Err("is not as long as it announces".to_owned());
    }
    let words = numbers.as_chunks::<8>().0;
    let floats = || -> Vec<f64> {
        if single {
            numbers.as_chunks::<4>().0.iter().map(|word| f64::from(f32::from_le_bytes(*word))).collect()
        } else {
            words.iter().map(|word| f64::from_le_bytes(*word)).collect()
        }
    };
    let tells = |components: usize| numbers.len().is_multiple_of(components * if single { 4 } else { 8 });
    match (attribute(head, "type"), attribute(head, "NumberOfComponents")) {
        (Some("Float64" | "Float32"), Some("1")) => Ok(Numbers::Scalar(floats())),
        (Some("Float64" | "Float32"), Some("3")) if tells(3) => {
            Ok(Numbers::Vector(floats().as_chunks().0.to_vec()))
        }
        (Some("Float64" | "Float32"), Some("9")) if tells(9) => {
            Ok(Numbers::Tensor(floats().as_chunks().0.to_vec()))
        }
        (Some("Int64"), Some("1")) => {
            Ok(Numbers::Integer(words.iter().map(|word| i64::from_le_bytes(*word)).collect()))
        }
        (kind, components) => Err(format!(
            "has the type {} with {} components",
            kind.unwrap_or("unknown"),
            components.unwrap_or("unknown")
        )),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use crate::vtk::{Column, ContactFrame, ParticleFrame, SeriesWriter, WallFrame, read_series};

    /// A folder with one frame of two particles.
    fn folder() -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let particles = ParticleFrame {
            positions: &[[0.0, -0.0, 1.0e-300], [f64::INFINITY, 2.0, 0.1]],
            columns: &[
                Column::index("id", &[7, 3]),
                Column::scalar("a<b", &[0.1, -2.5]),
                Column::vector("v", &[[1.0; 3], [2.0; 3]]),
                Column::integer("type", &[-1, i64::MAX]),
            ],
        };
        let contacts =
            ContactFrame { ends: &[[[0.0; 3], [1.0; 3]]], columns: &[Column::scalar("overlap", &[0.5])] };
        let walls = WallFrame { ends: &[[[1.0; 3], [2.0; 3]]], radii: &[0.5] };
        let mut series = SeriesWriter::create(folder.path(), "").unwrap();
        series.write(0.25, &particles, &contacts, &walls).unwrap();
        let entries = read_series(&series.index()).unwrap();
        assert_eq!((entries.len(), entries[0].time), (1, 0.25));
        let path = folder.path().join(&entries[0].file);
        (folder, path)
    }

    #[test]
    fn a_frame_is_read_as_it_was_written() {
        let (_folder, path) = folder();
        let Frame { particles, contacts, walls, surfaces: _ } = read_frame(&path).unwrap();
        assert_eq!(particles.points, [[0.0, -0.0, 1.0e-300], [f64::INFINITY, 2.0, 0.1]]);
        assert_eq!(particles.scalar("id").unwrap(), [7.0, 3.0]);
        assert_eq!(particles.column("a<b"), Some(&Numbers::Scalar(vec![0.1, -2.5])));
        assert_eq!(particles.column("v"), Some(&Numbers::Vector(vec![[1.0; 3], [2.0; 3]])));
        assert_eq!(particles.column("type"), Some(&Numbers::Integer(vec![-1, i64::MAX])));
        assert_eq!((particles.columns.len(), particles.scalar("v")), (4, None));
        assert_eq!(contacts.lines(), [[[0.0; 3], [1.0; 3]]]);
        assert_eq!(contacts.columns, [("overlap".to_owned(), Numbers::Scalar(vec![0.5]))]);
        assert_eq!(walls.lines(), [[[1.0; 3], [2.0; 3]]]);
        assert_eq!(walls.scalar("radius").unwrap(), [0.5]);
        let without = read_frame_without_contacts(&path).unwrap();
        assert_eq!((without.particles, without.walls), (particles, walls));
        assert!(without.contacts.columns.is_empty());
    }

    #[test]
    fn a_file_that_was_changed_is_refused_with_what_is_wrong() {
        let (folder, path) = folder();
        let file = folder.path().join("particles_0000.vtp");
        let text = std::fs::read_to_string(&file).unwrap();
        for (from, to, problem) in [
            ("</VTKFile>", "", "it breaks off"),
            ("NumberOfPoints=\"2\"", "NumberOfPoints=\"3\"", "it has 2 points and announces 3"),
            ("Name=\"Points\"", "Name=\"Pints\"", "it has no points"),
            ("<Piece", "<Peace", "it has no piece"),
            ("Float64\" Name=\"a&lt;b\"", "Float16\" Name=\"a&lt;b\"", "array `a<b` has the type Float16"),
        ] {
            assert!(text.contains(from), "{from}");
            std::fs::write(&file, text.replacen(from, to, 1)).unwrap();
            let message = read_frame(&path).unwrap_err().to_string();
            assert!(message.contains(&format!("is not a file that Pulvis wrote: {problem}")), "{message}");
            assert!(message.contains("particles_0000.vtp"), "{message}");
        }
        std::fs::remove_file(&file).unwrap();
        assert!(matches!(read_frame(&path), Err(IoError::System { action: "read", .. })));
    }
}
