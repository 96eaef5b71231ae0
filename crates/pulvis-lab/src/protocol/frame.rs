//! One instant of a run: what files hold of it and pictures show.

use pulvis_core::{ContactPartner, ContactView, Simulation};
use pulvis_input::scenario::Scenario;
use pulvis_io::vtk::{Frame, Numbers, PolyData};

use super::outlines::walls;

/// Particles in the order of their ids, contacts and walls at the present time.
pub(crate) fn frame_of(scenario: &Scenario, simulation: &Simulation) -> Frame {
    let contacts = Contacts::of(simulation);
    Frame {
        particles: particles(simulation, &contacts),
        contacts: contacts.into_lines(),
        walls: walls(scenario, simulation),
    }
}

fn particles(simulation: &Simulation, contacts: &Contacts) -> PolyData {
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    let vectors = |column: pulvis_core::Vectors<'_>| -> Vec<[f64; 3]> {
        rows.iter().map(|&row| column[row].to_array()).collect()
    };
    let scalars = |column: &[f64]| Numbers::Scalar(rows.iter().map(|&row| column[row]).collect());
    let ids: Vec<i64> = rows.iter().map(|&row| i64::from(particles.ids()[row])).collect();
    let materials = rows.iter().map(|&row| i64::from(particles.materials()[row])).collect();
    let coordination = contacts.coordination(&ids);
    let own = [
        ("id", Numbers::Integer(ids)),
        ("type", Numbers::Integer(materials)),
        ("radius", scalars(particles.radii())),
        ("v", Numbers::Vector(vectors(particles.velocities()))),
        ("omega", Numbers::Vector(vectors(particles.angular_velocities()))),
        ("f", Numbers::Vector(vectors(particles.forces()))),
        ("torque", Numbers::Vector(vectors(particles.torques()))),
        ("coordination", Numbers::Integer(coordination)),
    ];
    let further = particles.columns().iter().map(|column| (column.name.clone(), scalars(&column.values)));
    let columns = own.into_iter().map(|(name, numbers)| (name.to_owned(), numbers)).chain(further);
    PolyData { points: vectors(particles.positions()), columns: columns.collect() }
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
    /// The contacts as lines with their columns.
    fn into_lines(self) -> PolyData {
        let own = [
            ("id1", Numbers::Integer(self.first)),
            ("id2", Numbers::Integer(self.second)),
            ("force", Numbers::Vector(self.force)),
            ("normal_force", Numbers::Scalar(self.normal_force)),
            ("overlap", Numbers::Scalar(self.overlap)),
        ];
        let memory = self.memory.into_iter().map(|(name, values)| (name, Numbers::Scalar(values)));
        let columns = own.into_iter().chain(memory);
        PolyData {
            points: self.ends.into_iter().flatten().collect(),
            columns: columns.map(|(name, numbers)| (name.to_owned(), numbers)).collect(),
        }
    }

    fn of(simulation: &Simulation) -> Self {
        let parts = simulation.gather_contacts(Self::take_in);
        let mut all = Self::default();
        parts.into_iter().for_each(|part| all.append(part));
        for (_, values) in &mut all.memory {
            values.resize(all.first.len(), f64::NAN);
        }
        all
    }

    fn take_in(&mut self, contact: &ContactView<'_>) {
        self.ends.push([contact.centre_first.to_array(), contact.centre_second.to_array()]);
        self.first.push(i64::from(contact.first));
        self.second.push(match contact.second {
            ContactPartner::Particle(id) => i64::from(id),
            ContactPartner::Wall(place) => -1 - place as i64,
        });
        self.force.push(contact.force.to_array());
        self.normal_force.push(contact.normal_force);
        self.overlap.push(contact.overlap);
        self.remember(contact);
    }

    /// Adds the contacts of a later part.
    fn append(&mut self, part: Self) {
        let before = self.first.len();
        let Self { ends, first, second, force, normal_force, overlap, memory } = part;
        self.ends.extend(ends);
        self.first.extend(first);
        self.second.extend(second);
        self.force.extend(force);
        self.normal_force.extend(normal_force);
        self.overlap.extend(overlap);
        for (name, part) in memory {
            let values = self.memory_of(name);
            values.resize(before, f64::NAN);
            values.extend(part);
        }
    }

    /// The column of memory of this name.
    fn memory_of(&mut self, name: &'static str) -> &mut Vec<f64> {
        let known = self.memory.iter().position(|(known, _)| *known == name);
        let index = known.unwrap_or_else(|| {
            self.memory.push((name, Vec::new()));
            self.memory.len() - 1
        });
        &mut self.memory[index].1
    }

    fn remember(&mut self, contact: &ContactView<'_>) {
        let before = self.first.len() - 1;
        for (name, &value) in contact.layout.names().zip(contact.memory) {
            let name = name.split(' ').next().unwrap_or(name);
            let values = self.memory_of(name);
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
