//! Particles out of a checkpoint of a run.
//!
//! What stands in a checkpoint is known above this crate; whoever reads scenarios there gives a [`CheckpointReader`] along
//! ([`Document::with_checkpoint_reader`](crate::Document::with_checkpoint_reader)).

use super::{FileReading, PointsError, Read};
use crate::scenario::arrangement::Grain;
use std::path::Path;

/// Reads a checkpoint file, or the latest one in the folder of a run; the error says what is wrong, with the file.
pub type CheckpointReader = fn(&Path) -> Result<CheckpointParticles, String>;

/// The particles of a checkpoint, in the order of their ids.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckpointParticles {
    /// Names of the materials.
    pub materials: Vec<String>,
    /// The particles, with all quantities; materials count the names.
    pub grains: Vec<Grain>,
    /// Their further quantities.
    pub columns: Vec<GrainColumn>,
}

/// A further quantity of the particles of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainColumn {
    /// Its name.
    pub name: String,
    /// Its unit in SI.
    pub unit: String,
    /// A value for each particle.
    pub values: Vec<f64>,
}

/// The particles of a checkpoint, in the units and materials of the scenario.
pub(super) fn read(
    path: &Path,
    reading: &FileReading,
    reader: Option<CheckpointReader>,
) -> Result<Read, PointsError> {
    let refused = |reason| PointsError::Checkpoint { reason };
    let reader = reader.ok_or_else(|| {
        refused(format!("{} is not read here: checkpoints are for runs and their checks", path.display()))
    })?;
    let CheckpointParticles { materials: names, grains, columns } = reader(path).map_err(refused)?;
    let FileReading { length_unit, time_unit, materials, .. } = reading;
    let material = |(row, grain): (usize, &Grain)| {
        let Some(known) = materials else { return Ok(None) };
        let number = grain.material.unwrap_or_default();
        let name = names.get(number).cloned().unwrap_or_default();
        let found = known.get(&name).or_else(|| known.get(&number.to_string()));
        found.copied().map(Some).ok_or_else(|| PointsError::Material {
            file: path.display().to_string(),
            particle: row,
            found: name,
            known: known.keys().map(String::as_str).collect::<Vec<_>>().join(", "),
        })
    };
    let materials: Vec<Option<usize>> = grains.iter().enumerate().map(material).collect::<Result<_, _>>()?;
    let grain = |(grain, material): (Grain, Option<usize>)| Grain {
        position: grain.position * *length_unit,
        radius: grain.radius.map(|radius| radius * length_unit),
        velocity: grain.velocity.map(|velocity| velocity * (length_unit / time_unit)),
        angular_velocity: grain.angular_velocity.map(|spin| spin * (1.0 / time_unit)),
        material,
    };
    Ok((grains.into_iter().zip(materials).map(grain).collect(), columns))
}
