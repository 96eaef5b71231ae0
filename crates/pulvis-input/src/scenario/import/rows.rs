//! Columns by name, and lines of values made into particles.

use super::{FileReading, PointsError};
use crate::problem::{LONGEST_VALUE, shortened};
use crate::scenario::arrangement::Grain;
use pulvis_math::Vector3;

/// Where in a line each quantity stands.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    names: Vec<String>,
    position: [usize; 3],
    size: Option<Size>,
    velocity: Option<[usize; 3]>,
    angular_velocity: Option<[usize; 3]>,
    material: Option<usize>,
}

#[derive(Clone, Copy, Debug)]
enum Size {
    Radius(usize),
    Diameter(usize),
}

/// Names of columns in files of Pulvis, LAMMPS and OVITO; the first ones are ours.
const POSITION: [&[&str]; 3] =
    [&["x", "xu", "position_x"], &["y", "yu", "position_y"], &["z", "zu", "position_z"]];
const VELOCITY: [&[&str]; 3] = [&["vx", "v_x"], &["vy", "v_y"], &["vz", "v_z"]];
const ANGULAR_VELOCITY: [&[&str]; 3] =
    [&["omegax", "omega_x"], &["omegay", "omega_y"], &["omegaz", "omega_z"]];
const MATERIAL: &[&str] = &["material", "species", "type"];

impl Columns {
    /// Finds the quantities among names in any order; further columns are skipped.
    pub(super) fn named(
        file: &str,
        line: usize,
        names: &[&str],
        reading: &FileReading,
    ) -> Result<Self, PointsError> {
        let refused = |expected: String| PointsError::Columns {
            file: file.to_owned(),
            line,
            found: shortened(&names.join(","), 120),
            expected,
        };
        let place =
            |known: &[&str]| known.iter().find_map(|known| names.iter().position(|name| name == known));
        let all = |known: [&[&str]; 3]| -> Result<Option<[usize; 3]>, PointsError> {
            match known.map(place) {
                [Some(x), Some(y), Some(z)] => Ok(Some([x, y, z])),
                [None, None, None] => Ok(None),
                _ => {
                    Err(refused(format!("all of {}, {}, {}, or none", known[0][0], known[1][0], known[2][0])))
                }
            }
        };
        if let Some(twice) = names.iter().enumerate().find(|(index, name)| names[..*index].contains(name)) {
            return Err(refused(format!("`{}` once", twice.1)));
        }
        let [Some(x), Some(y), Some(z)] = POSITION.map(place) else {
            let scaled = place(&["xs", "xsu"]).is_some();
            let expected = if scaled { "x, y, z, not scaled with the box" } else { "x, y and z among them" };
            return Err(refused(expected.to_owned()));
        };
        let radius = place(&["radius"]).map(Size::Radius);
        let material = place(MATERIAL);
        if reading.materials.is_some() && material.is_none() {
            return Err(refused(
                "`material`, `species` or `type` among them, for the key `materials`".to_owned(),
            ));
        }
        Ok(Self {
            names: names.iter().map(|&name| name.to_owned()).collect(),
            position: [x, y, z],
            size: radius.or_else(|| place(&["diameter"]).map(Size::Diameter)),
            velocity: all(VELOCITY)?,
            angular_velocity: all(ANGULAR_VELOCITY)?,
            material,
        })
    }

    /// The particle of a line, in SI.
    pub(super) fn grain(
        &self,
        file: &str,
        line: usize,
        cells: &[&str],
        reading: &FileReading,
    ) -> Result<Grain, PointsError> {
        if cells.len() != self.names.len() {
            let (found, expected) = (cells.len(), self.names.len());
            return Err(PointsError::Count { file: file.to_owned(), line, found, expected });
        }
        let refused = |column: usize, expected: &str| PointsError::Value {
            file: file.to_owned(),
            line,
            column: self.names[column].clone(),
            found: format!("\"{}\"", shortened(cells[column], LONGEST_VALUE)),
            expected: expected.to_owned(),
        };
        let number = |column: usize| match cells[column].parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(refused(column, "a finite number")),
            Err(_) => Err(refused(column, "a number")),
        };
        let vector = |columns: [usize; 3], unit: f64| -> Result<Vector3, PointsError> {
            let [x, y, z] = columns;
            Ok(Vector3::new(number(x)?, number(y)?, number(z)?) * unit)
        };
        let size = |column: usize| match number(column)? {
            value if value > 0.0 => Ok(value * reading.length_unit),
            _ => Err(refused(column, &format!("a {} above 0 m", self.names[column]))),
        };
        let material = match (&reading.materials, self.material) {
            (Some(known), Some(column)) => Some(*known.get(cells[column]).ok_or_else(|| {
                let words: Vec<&str> = known.keys().map(String::as_str).collect();
                refused(column, &format!("one of {}, as the key `materials` says", words.join(", ")))
            })?),
            _ => None,
        };
        Ok(Grain {
            position: vector(self.position, reading.length_unit)?,
            radius: match self.size {
                None => None,
                Some(Size::Radius(column)) => Some(size(column)?),
                Some(Size::Diameter(column)) => Some(0.5 * size(column)?),
            },
            velocity: self
                .velocity
                .map(|columns| vector(columns, reading.length_unit / reading.time_unit))
                .transpose()?,
            angular_velocity: self
                .angular_velocity
                .map(|columns| vector(columns, 1.0 / reading.time_unit))
                .transpose()?,
            material,
        })
    }
}

/// A line that does not belong where it stands.
pub(super) fn structure(file: &str, line: usize, found: Option<&str>, expected: &str) -> PointsError {
    let found = found
        .map_or("the end of the file".to_owned(), |found| format!("\"{}\"", shortened(found.trim(), 60)));
    PointsError::Structure { file: file.to_owned(), line, found, expected: expected.to_owned() }
}

/// The instant that is asked for, out of several.
pub(super) fn wanted<T>(
    file: &str,
    mut frames: Vec<T>,
    reading: &FileReading,
) -> Result<Option<T>, PointsError> {
    let found = frames.len();
    match reading.frame {
        None => Ok(frames.pop()),
        Some(wanted) if wanted < found => Ok(Some(frames.swap_remove(wanted))),
        Some(wanted) => Err(PointsError::Frame { file: file.to_owned(), found, wanted }),
    }
}
