//! Names of single components in formats whose columns are plain numbers, and the numbers as text.

use super::Precision;
use crate::vtk::{Numbers, PolyData};
use std::io::{self, Write};

const AXES: [&str; 3] = ["x", "y", "z"];

/// The names of the components of a column. Velocity, angular velocity, force and torque have those of LAMMPS; other
/// vectors end in `_x`, `_y`, `_z`, tensors in `_xx`, `_xy` and so on, row by row.
pub fn component_names(name: &str, numbers: &Numbers) -> Vec<String> {
    let stem = match name {
        "v" => "v",
        "omega" => "omega",
        "f" => "f",
        "torque" => "tq",
        _ => &format!("{name}_"),
    };
    match numbers {
        Numbers::Scalar(_) | Numbers::Integer(_) => vec![name.to_owned()],
        Numbers::Vector(_) => AXES.iter().map(|axis| format!("{stem}{axis}")).collect(),
        Numbers::Tensor(_) => {
            AXES.iter().flat_map(|one| AXES.map(|other| format!("{name}_{one}{other}"))).collect()
        }
    }
}

/// The shape of one value: empty of a number, else the number of its components along each index.
pub fn shape(numbers: &Numbers) -> &'static [usize] {
    match numbers {
        Numbers::Scalar(_) | Numbers::Integer(_) => &[],
        Numbers::Vector(_) => &[3],
        Numbers::Tensor(_) => &[3, 3],
    }
}

/// A number as text: the shortest that reads back as the same number of this precision; `nan`, `inf`, `-inf` for the rest.
pub(super) fn number(out: &mut impl Write, value: f64, precision: Precision) -> io::Result<()> {
    if value.is_nan() {
        return out.write_all(b"nan");
    }
    let mut buffer = zmij::Buffer::new();
    let text = match precision {
        Precision::Double => buffer.format(value),
        Precision::Single => buffer.format(value as f32),
    };
    // Whole numbers come with a fraction that says nothing.
    out.write_all(text.strip_suffix(".0").unwrap_or(text).as_bytes())
}

/// The components of one value, each after a separator.
pub(super) fn components(
    out: &mut impl Write,
    numbers: &Numbers,
    row: usize,
    separator: &[u8],
    precision: Precision,
) -> io::Result<()> {
    let mut each = |values: &[f64]| {
        values.iter().try_for_each(|&value| {
            out.write_all(separator)?;
            number(out, value, precision)
        })
    };
    match numbers {
        Numbers::Scalar(values) => each(&values[row..=row]),
        Numbers::Vector(values) => each(&values[row]),
        Numbers::Tensor(values) => each(&values[row]),
        Numbers::Integer(values) => {
            out.write_all(separator)?;
            write!(out, "{}", values[row])
        }
    }
}

/// The ids and materials of particles, and all other columns. Rows without a material are of the first one.
pub(super) struct Particles<'a> {
    pub(super) ids: Option<&'a [i64]>,
    pub(super) materials: Option<&'a [i64]>,
    pub(super) others: Vec<(&'a str, &'a Numbers)>,
}

impl<'a> Particles<'a> {
    pub(super) fn of(data: &'a PolyData) -> Self {
        let whole = |name: &str| match data.column(name) {
            Some(Numbers::Integer(values)) => Some(&values[..]),
            _ => None,
        };
        let others = data.columns.iter().map(|(name, numbers)| (name.as_str(), numbers));
        Self {
            ids: whole("id"),
            materials: whole("type"),
            others: others.filter(|(name, _)| !["id", "type"].contains(name)).collect(),
        }
    }
}
