//! VTK files (`.vtp`, `.vtu`), indices of blocks and of instants (`.vtm`, `.pvd`), and folders of runs, which hold all of them.
//!
//! # Source
//! VTK documentation, "VTK XML file formats".

mod array;
mod file;
#[cfg(test)]
mod tests;
mod xml;

use super::rows::wanted;
use super::{FileReading, PointsError, read_bytes};
use crate::document::Document;
use crate::problem::shortened;
use crate::scenario::arrangement::Grain;
use file::{Array, VtkFile};
use pulvis_math::Vector3;
use std::collections::BTreeMap;
use std::path::Path;

/// A place where a file is not what it should be.
#[derive(Debug)]
pub(super) struct Broken {
    line: usize,
    found: String,
    expected: String,
}

impl Broken {
    fn new(line: usize, found: &str, expected: &str) -> Self {
        Self { line, found: shortened(found, 60), expected: expected.to_owned() }
    }

    fn of(self, path: &Path) -> PointsError {
        let Self { line, found, expected } = self;
        PointsError::Structure { file: path.display().to_string(), line, found, expected }
    }
}

/// The index of the instants of a run.
const INDEX: &str = "series.pvd";

/// What a run was made of, with all defaults.
const RECORD: &str = "run.toml";

/// Reads the particles of an instant of a run: of the last one, unless another is asked for.
pub(super) fn read_run(folder: &Path, reading: &FileReading) -> Result<Vec<Grain>, PointsError> {
    let index = folder.join(INDEX);
    if !index.is_file() {
        return Err(PointsError::NoRun { folder: folder.display().to_string() });
    }
    let names =
        if reading.materials.is_some() { materials_of_run(&folder.join(RECORD))? } else { Vec::new() };
    read(&index, reading, &names)
}

/// The names of the materials of a run, in their order.
fn materials_of_run(record: &Path) -> Result<Vec<String>, PointsError> {
    let refused = |errors: crate::InputErrors| PointsError::Record { reason: errors.to_string() };
    Ok(Document::load(record).map_err(refused)?.material_names())
}

/// Reads the particles of a file, or of the files that it names; numbers of materials count `names`, if there are any.
pub(super) fn read(path: &Path, reading: &FileReading, names: &[String]) -> Result<Vec<Grain>, PointsError> {
    let bytes = read_bytes(path)?;
    parse(path, &bytes, reading, names, &["Collection", "vtkMultiBlockDataSet"])
}

/// `indices`: the kinds of files that may name others; each of these only such as stand behind it.
fn parse(
    path: &Path,
    bytes: &[u8],
    reading: &FileReading,
    names: &[String],
    indices: &[&str],
) -> Result<Vec<Grain>, PointsError> {
    let shown = path.display().to_string();
    let file = VtkFile::parse(bytes).map_err(|broken| broken.of(path))?;
    let Some(level) = indices.iter().position(|kind| *kind == file.kind) else {
        if !matches!(file.kind.as_str(), "PolyData" | "UnstructuredGrid") {
            let found = format!("a file of the kind {:?}", file.kind);
            return Err(Broken::new(1, &found, "PolyData, or an index of such files").of(path));
        }
        return match wanted(&shown, vec![file], reading)? {
            Some(file) => grains(&shown, &file, reading, names),
            None => Ok(Vec::new()),
        };
    };
    let (named, reading) = if file.kind == "Collection" {
        let mut files = file.files;
        if let Some(part) = files.windows(2).find(|pair| pair[0].label == pair[1].label) {
            let found = format!("a second file of the time {}", part[1].label);
            return Err(Broken::new(part[1].line, &found, "all particles in one").of(path));
        }
        let chosen = reading.frame.unwrap_or(files.len().saturating_sub(1));
        let frame = wanted(&shown, files.iter().map(|_| ()).collect(), reading)?;
        let named = frame.map(|()| files.swap_remove(chosen));
        (named, FileReading { frame: None, ..reading.clone() })
    } else {
        let mut files = file.files;
        let particles = files.iter().position(|file| file.label == "Particles");
        let only = (files.len() == 1).then_some(0);
        (particles.or(only).map(|index| files.swap_remove(index)), reading.clone())
    };
    let named =
        named.ok_or_else(|| Broken::new(1, "an index without particles", "a file of them").of(path))?;
    let inner = path.parent().unwrap_or(Path::new("")).join(&named.file);
    parse(&inner, &read_bytes(&inner)?, &reading, names, &indices[level + 1..])
}

/// Names of arrays in files of Pulvis and others; the first ones are ours.
const RADIUS: &[&str] = &["radius", "Radius"];
const DIAMETER: &[&str] = &["diameter", "Diameter"];
const VELOCITY: &[&str] = &["v", "velocity", "Velocity"];
const ANGULAR_VELOCITY: &[&str] = &["omega", "angular_velocity", "AngularVelocity", "Angular Velocity"];
const MATERIAL: &[&str] = &["material", "species", "type"];

/// The numbers of an array, with its name and line.
struct Values {
    name: String,
    line: usize,
    numbers: Vec<f64>,
}

/// The arrays of a file.
struct Arrays<'f, 'a> {
    path: &'f str,
    file: &'f VtkFile<'a>,
    points: usize,
}

impl Arrays<'_, '_> {
    /// The array that has one of these names, with so many numbers for each particle.
    fn find(&self, known: &[&str], components: usize) -> Result<Option<Values>, PointsError> {
        let Some(array) =
            known.iter().find_map(|name| self.file.arrays.iter().find(|array| array.name == *name))
        else {
            return Ok(None);
        };
        let refused = |problem| PointsError::Array {
            file: self.path.to_owned(),
            line: array.line,
            name: array.name.clone(),
            problem,
        };
        self.read(array, components).map(Some).map_err(refused)
    }

    fn read(&self, array: &Array<'_>, components: usize) -> Result<Values, String> {
        if array.components != components {
            return Err(format!("has {} numbers for each particle; expected {components}", array.components));
        }
        let count = self.points.checked_mul(components);
        let count = count.ok_or_else(|| format!("belongs to {} particles", self.points))?;
        let stored = self.file.stored(array)?;
        let numbers = array::numbers(stored, self.file.encoding, &array.kind, count)?;
        Ok(Values { name: array.name.clone(), line: array.line, numbers })
    }

    fn missing(&self, expected: &str) -> PointsError {
        let names = self.file.arrays.iter().map(|array| &*array.name).collect::<Vec<_>>();
        PointsError::Columns {
            file: self.path.to_owned(),
            line: 1,
            found: shortened(&names.join(","), 120),
            expected: expected.to_owned(),
        }
    }

    fn refused(&self, values: &Values, particle: usize, found: String, expected: String) -> PointsError {
        PointsError::Value {
            file: self.path.to_owned(),
            line: values.line,
            column: format!("{} of particle {}", values.name, particle + 1),
            found,
            expected,
        }
    }

    /// Vectors in SI; none where there are no values.
    fn vectors(&self, values: Option<&Values>, unit: f64) -> Result<Option<Vec<Vector3>>, PointsError> {
        let Some(values) = values else { return Ok(None) };
        if let Some(index) = values.numbers.iter().position(|value| !value.is_finite()) {
            let found = values.numbers[index].to_string();
            return Err(self.refused(values, index / 3, found, "finite numbers".to_owned()));
        }
        let vectors = values.numbers.as_chunks::<3>().0;
        Ok(Some(vectors.iter().map(|&vector| Vector3::from(vector) * unit).collect()))
    }
}

/// The particles of a file with points.
fn grains(
    path: &str,
    file: &VtkFile<'_>,
    reading: &FileReading,
    names: &[String],
) -> Result<Vec<Grain>, PointsError> {
    let FileReading { length_unit, time_unit, ref materials, .. } = *reading;
    let arrays = Arrays { path, file, points: file.points.unwrap_or(0) };
    let positions = arrays.find(&["Points"], 3)?;
    let positions = arrays
        .vectors(positions.as_ref(), length_unit)?
        .ok_or_else(|| arrays.missing("`Points` among them"))?;
    let radii = match arrays.find(RADIUS, 1)? {
        Some(radii) => Some((radii, 1.0)),
        None => arrays.find(DIAMETER, 1)?.map(|diameters| (diameters, 0.5)),
    };
    let radii = radii.map(|(values, share)| sizes(&arrays, &values, share * length_unit)).transpose()?;
    let velocities = arrays.find(VELOCITY, 3)?;
    let velocities = arrays.vectors(velocities.as_ref(), length_unit / time_unit)?;
    let spins = arrays.find(ANGULAR_VELOCITY, 3)?;
    let spins = arrays.vectors(spins.as_ref(), 1.0 / time_unit)?;
    let materials = match materials {
        None => None,
        Some(known) => Some(materials_of(&arrays, known, names)?),
    };
    let grain = |(row, position): (usize, Vector3)| Grain {
        position,
        radius: radii.as_ref().map(|radii| radii[row]),
        velocity: velocities.as_ref().map(|velocities| velocities[row]),
        angular_velocity: spins.as_ref().map(|spins| spins[row]),
        material: materials.as_ref().map(|materials| materials[row]),
    };
    Ok(positions.into_iter().enumerate().map(grain).collect())
}

/// Radii [m] of sizes.
fn sizes(arrays: &Arrays<'_, '_>, values: &Values, unit: f64) -> Result<Vec<f64>, PointsError> {
    let size = |(row, &value): (usize, &f64)| {
        let expected = || format!("a {} above 0 m", values.name);
        let fits = value.is_finite() && value > 0.0;
        if fits { Ok(value * unit) } else { Err(arrays.refused(values, row, value.to_string(), expected())) }
    };
    values.numbers.iter().enumerate().map(size).collect()
}

/// The material of each particle: the file has numbers, which count `names` where there are any.
fn materials_of(
    arrays: &Arrays<'_, '_>,
    known: &BTreeMap<String, usize>,
    names: &[String],
) -> Result<Vec<usize>, PointsError> {
    let needed = "`material`, `species` or `type` among them, for the key `materials`";
    let values = arrays.find(MATERIAL, 1)?.ok_or_else(|| arrays.missing(needed))?;
    let index = |(row, number): (usize, &f64)| {
        let number = number.to_string();
        let name = number.parse().ok().and_then(|number: usize| names.get(number));
        let words = [name, Some(&number)];
        words.into_iter().flatten().find_map(|word| known.get(word)).copied().ok_or_else(|| {
            let found = format!("\"{}\"", name.unwrap_or(&number));
            let known: Vec<&str> = known.keys().map(String::as_str).collect();
            let expected = format!("one of {}, as the key `materials` says", known.join(", "));
            arrays.refused(&values, row, found, expected)
        })
    };
    values.numbers.iter().enumerate().map(index).collect()
}
