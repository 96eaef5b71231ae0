//! What a deforming cell keeps between steps, as numbers with names.

use pulvis_boundary::{CellContent, CellMotion, Domain, UpperTriangular};
use pulvis_math::Vector3;

use super::Cell;
use crate::columns::{NameError, NamedNumbers, NumberReader, NumberWriter};

impl Cell {
    /// All of it but the motion and the domain of the list.
    pub(in crate::simulation) fn numbers(&self) -> NamedNumbers {
        let Self { motion: _, start, content, rate, stress, work, strain, since_list, listed: _ } = self;
        let mut writer = NumberWriter::default();
        writer.number("start", *start);
        writer.number("diameter", content.diameter);
        writer.number("density", content.density);
        writer.number("work", *work);
        for (name, matrix) in [("rate", rate), ("strain", strain), ("since_list", since_list)] {
            for (entry, value) in UpperTriangular::NAMES.into_iter().zip(matrix.to_array()) {
                writer.number(&format!("{name}_{entry}"), value);
            }
        }
        for (name, row) in ["stress_x", "stress_y", "stress_z"].into_iter().zip(stress) {
            writer.vector(name, Vector3::from(*row));
        }
        writer.finish()
    }

    /// From all of it.
    pub(in crate::simulation) fn from_numbers(
        motion: CellMotion,
        listed: Domain,
        mut reader: NumberReader<'_>,
    ) -> Result<Self, NameError> {
        let start = reader.number("start")?;
        let content =
            CellContent { diameter: reader.number("diameter")?, density: reader.number("density")? };
        let work = reader.number("work")?;
        let mut matrix = |name: &str| -> Result<UpperTriangular, NameError> {
            let mut entries = [0.0; 6];
            for (value, entry) in entries.iter_mut().zip(UpperTriangular::NAMES) {
                *value = reader.number(&format!("{name}_{entry}"))?;
            }
            Ok(UpperTriangular::from_array(entries))
        };
        let (rate, strain, since_list) = (matrix("rate")?, matrix("strain")?, matrix("since_list")?);
        let mut row = |name: &str| reader.vector(name).map(Vector3::to_array);
        let stress = [row("stress_x")?, row("stress_y")?, row("stress_z")?];
        reader.finish()?;
        Ok(Self { motion, start, content, rate, stress, work, strain, since_list, listed })
    }
}
