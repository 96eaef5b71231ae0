//! What a scenario takes out of a checkpoint of another run: its particles.

use std::path::Path;

use pulvis_core::State;
use pulvis_input::scenario::{CheckpointParticles, Grain, GrainColumn, Scenario};
use pulvis_input::{Document, InputErrors};

use super::find;

/// The particles of a checkpoint file, or of the latest one in a folder.
///
/// # Errors
/// There is none, or it cannot be used; with the file.
pub(in crate::protocol) fn read_particles(path: &Path) -> Result<CheckpointParticles, String> {
    let found = find(path).map_err(|error| error.to_string())?;
    let found = found.ok_or_else(|| format!("there is no checkpoint in {}", path.display()))?;
    let file = found.path.display().to_string();
    // Only names: its own particles may come out of files that are no longer there.
    let document = Document::from_str("the scenario of the checkpoint", &found.checkpoint.scenario);
    let materials = document.map_err(|errors| format!("{file}: {errors}"))?.material_names();
    let state: State = found.checkpoint.into_state().map_err(|problem| format!("{file}: {problem}"))?;
    let particles = &state.particles;
    let mut rows: Vec<usize> = (0..particles.id.len()).collect();
    rows.sort_unstable_by_key(|&row| particles.id[row]);
    let grain = |&row: &usize| Grain {
        position: particles.position[row].into(),
        radius: Some(particles.radius[row]),
        velocity: Some(particles.velocity[row].into()),
        angular_velocity: Some(particles.angular_velocity[row].into()),
        material: Some(usize::from(particles.material[row])),
    };
    let column = |column: &pulvis_core::NamedColumn| GrainColumn {
        name: column.name.clone(),
        unit: column.unit.clone(),
        values: rows.iter().map(|&row| column.values[row]).collect(),
    };
    let columns = particles.columns.iter().map(column).collect();
    Ok(CheckpointParticles { materials, grains: rows.iter().map(grain).collect(), columns })
}

/// A scenario that stands in no file of the user, such as the record of a run.
///
/// # Errors
/// All mistakes of the text, and of the files that it names.
pub fn scenario_from_text(name: &str, text: &str) -> Result<Scenario, InputErrors> {
    Scenario::from_document(&Document::from_str(name, text)?.with_checkpoint_reader(read_particles), None)
}
