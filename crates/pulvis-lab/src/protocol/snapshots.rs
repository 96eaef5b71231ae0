//! Particles and contacts as files for ParaView and OVITO.

use std::path::Path;

use super::error::RunError;
use super::folder::OutputFolder;
use pulvis_core::{ContactPartner, ContactView, Simulation};
use pulvis_io::IoError;
use pulvis_io::vtk::{Column, ContactFrame, ParticleFrame, SeriesWriter};

/// Writes one frame after another into a folder.
pub(super) struct Snapshots {
    series: SeriesWriter,
    last_step: Option<u64>,
}

impl Snapshots {
    pub(super) fn create(folder: &Path) -> Result<Self, IoError> {
        Ok(Self { series: SeriesWriter::create(folder, "")?, last_step: None })
    }

    /// Goes on with the frames of an interrupted run, of which the last was of `last_step`.
    pub(super) fn resume(folder: &Path, frames: u64, last_step: Option<u64>) -> Result<Self, IoError> {
        Ok(Self { series: SeriesWriter::resume(folder, "", frames as usize)?, last_step })
    }

    /// Number of frames, and the step of the last one.
    pub(super) fn position(&self) -> (u64, Option<u64>) {
        let Self { series, last_step } = self;
        (series.frames() as u64, *last_step)
    }

    /// Writes the present state, unless it has just been written.
    pub(super) fn write(
        &mut self,
        simulation: &Simulation,
        output: &mut OutputFolder,
    ) -> Result<(), RunError> {
        if self.last_step == Some(simulation.steps()) {
            return Ok(());
        }
        self.last_step = Some(simulation.steps());
        let contacts = Contacts::of(simulation);
        let particles = simulation.particles();
        let rows = particles.rows_by_id();
        let vectors = |column: pulvis_core::Vectors<'_>| -> Vec<[f64; 3]> {
            rows.iter().map(|&row| column[row].to_array()).collect()
        };
        let ids: Vec<i64> = rows.iter().map(|&row| i64::from(particles.ids()[row])).collect();
        let materials: Vec<i64> = rows.iter().map(|&row| i64::from(particles.materials()[row])).collect();
        let radii: Vec<f64> = rows.iter().map(|&row| particles.radii()[row]).collect();
        let [velocities, angular_velocities] =
            [vectors(particles.velocities()), vectors(particles.angular_velocities())];
        let [forces, torques] = [vectors(particles.forces()), vectors(particles.torques())];
        let coordination = contacts.coordination(&ids);
        let further: Vec<Vec<f64>> = particles
            .columns()
            .iter()
            .map(|column| rows.iter().map(|&row| column.values[row]).collect())
            .collect();
        let positions = vectors(particles.positions());
        let mut columns = vec![
            Column::integer("id", &ids),
            Column::integer("type", &materials),
            Column::scalar("radius", &radii),
            Column::vector("v", &velocities),
            Column::vector("omega", &angular_velocities),
            Column::vector("f", &forces),
            Column::vector("torque", &torques),
            Column::integer("coordination", &coordination),
        ];
        for (column, values) in particles.columns().iter().zip(&further) {
            columns.push(Column::scalar(&column.name, values));
        }
        let particle_frame = ParticleFrame { positions: &positions, columns: &columns };
        let mut contact_columns = vec![
            Column::integer("id1", &contacts.first),
            Column::integer("id2", &contacts.second),
            Column::vector("force", &contacts.force),
            Column::scalar("normal_force", &contacts.normal_force),
            Column::scalar("overlap", &contacts.overlap),
        ];
        contact_columns.extend(contacts.memory.iter().map(|(name, values)| Column::scalar(name, values)));
        let contact_frame = ContactFrame { ends: &contacts.ends, columns: &contact_columns };
        for name in self.series.next_files() {
            output.file(&name)?;
        }
        self.series.write(simulation.time(), &particle_frame, &contact_frame)?;
        Ok(())
    }
}

/// All contacts, column by column. The second id of a wall contact is −1 − the wall's place.
#[derive(Default)]
struct Contacts {
    ends: Vec<[[f64; 3]; 2]>,
    first: Vec<i64>,
    second: Vec<i64>,
    force: Vec<[f64; 3]>,
    normal_force: Vec<f64>,
    overlap: Vec<f64>,
    /// What contacts remember, by the names of the columns; NaN where a contact has no such column.
    memory: Vec<(&'static str, Vec<f64>)>,
}

impl Contacts {
    fn of(simulation: &Simulation) -> Self {
        let mut contacts = Self::default();
        simulation.for_each_contact(&mut |contact| {
            contacts.ends.push([contact.centre_first.to_array(), contact.centre_second.to_array()]);
            contacts.first.push(i64::from(contact.first));
            contacts.second.push(match contact.second {
                ContactPartner::Particle(id) => i64::from(id),
                ContactPartner::Wall(place) => -1 - place as i64,
            });
            contacts.force.push(contact.force.to_array());
            contacts.normal_force.push(contact.normal_force);
            contacts.overlap.push(contact.overlap);
            contacts.remember(contact);
        });
        for (_, values) in &mut contacts.memory {
            values.resize(contacts.first.len(), f64::NAN);
        }
        contacts
    }

    fn remember(&mut self, contact: &ContactView<'_>) {
        let before = self.first.len() - 1;
        for (name, &value) in contact.layout.names().zip(contact.memory) {
            let name = name.split(' ').next().unwrap_or(name);
            let known = self.memory.iter().position(|(known, _)| *known == name);
            let index = known.unwrap_or_else(|| {
                self.memory.push((name, Vec::new()));
                self.memory.len() - 1
            });
            let values = &mut self.memory[index].1;
            values.resize(before, f64::NAN);
            values.push(value);
        }
    }

    /// Touching contacts of each particle, walls included; `ids` in ascending order.
    fn coordination(&self, ids: &[i64]) -> Vec<i64> {
        let mut counts = vec![0; ids.len()];
        let mut count = |id: i64| {
            // Ids of removed particles are missing; a wall has a negative one.
            if let Ok(index) = ids.binary_search(&id) {
                counts[index] += 1;
            }
        };
        for contact in (0..self.first.len()).filter(|&contact| self.overlap[contact] > 0.0) {
            count(self.first[contact]);
            count(self.second[contact]);
        }
        counts
    }
}
