//! One instant of a run: what files hold of it and pictures show.

use pulvis_boundary::Region;
use pulvis_core::{ContactPartner, ContactView, Simulation, Vectors};
use pulvis_input::scenario::{
    ClusterRule, ContactFields, DEFAULT_CONTACT_FIELDS, DEFAULT_PARTICLE_FIELDS, OutputFiles, Scenario,
};
use pulvis_io::vtk::{Frame, Numbers, PolyData};
use pulvis_math::Vector3;

use super::clusters::Graph;
use super::outlines::walls;
use super::particle_sums::ParticleSums;
use super::surfaces::surfaces;

/// What a frame holds.
#[derive(Clone, Debug)]
pub(crate) struct Selection<'a> {
    /// Names of what there is of particles; `None` is the default.
    fields: Option<&'a [String]>,
    /// Names of what there is of contacts.
    contacts: Vec<&'a str>,
    /// Names of the columns of memory; `None`: those that contacts have just now.
    memory: Option<Vec<&'static str>>,
    /// Where particles and contact points lie.
    region: Option<Region>,
    /// What joins particles to groups.
    clusters: ClusterRule,
}

/// Fields that tell of the group of a particle; there by default where the time series tells groups.
const OF_CLUSTERS: [&str; 2] = ["cluster", "cluster_size"];

impl<'a> Selection<'a> {
    /// What the key `vtk` writes.
    pub(crate) fn default_of_runs(scenario: &Scenario) -> Self {
        let clusters = scenario.output.clusters;
        Self { fields: None, contacts: DEFAULT_CONTACT_FIELDS.to_vec(), memory: None, region: None, clusters }
    }

    /// The same without anything of contacts.
    pub(super) fn without_contacts(self) -> Self {
        Self { contacts: Vec::new(), ..self }
    }

    /// Names of what there is of particles, which have these further columns.
    pub(super) fn fields<'b>(&self, own: impl Iterator<Item = &'b str>) -> Vec<&'b str>
    where
        'a: 'b,
    {
        match self.fields {
            // Rows without ids, and particles without their material, would have to be numbered by the formats.
            Some(fields) => {
                let always =
                    ["id", "type"].into_iter().filter(|name| fields.iter().all(|field| field != name));
                always.chain(fields.iter().map(String::as_str)).collect()
            }
            None => {
                let groups = OF_CLUSTERS.into_iter().filter(|_| self.clusters != ClusterRule::Never);
                DEFAULT_PARTICLE_FIELDS.iter().copied().chain(groups).chain(own).collect()
            }
        }
    }

    /// Names of the columns of memory, if they are the same all the time.
    pub(super) fn memory(&self) -> &[&'static str] {
        self.memory.as_deref().unwrap_or_default()
    }

    /// Names of what there is of contacts.
    pub(super) fn contacts(&self) -> &[&'a str] {
        &self.contacts
    }

    /// Whether there is anything of contacts.
    pub(crate) fn has_contacts(&self) -> bool {
        !self.contacts.is_empty()
    }

    /// What a block of files asks for.
    pub(crate) fn of(files: &'a OutputFiles, scenario: &Scenario) -> Self {
        let contacts = match &files.contacts {
            ContactFields::None => Vec::new(),
            ContactFields::Default => DEFAULT_CONTACT_FIELDS.to_vec(),
            ContactFields::Named(names) => names.iter().map(String::as_str).collect(),
        };
        let memory = Some(memory_columns(scenario));
        let clusters = scenario.output.clusters;
        Self { fields: files.fields.as_deref(), contacts, memory, region: files.region, clusters }
    }
}

/// The columns of memory of all contacts of all stages: readers of one file with all instants want the same columns in each.
fn memory_columns(scenario: &Scenario) -> Vec<&'static str> {
    let mut names = Vec::new();
    let contacts = scenario.contacts.iter().chain(scenario.stages.iter().flat_map(|stage| &stage.contacts));
    for name in contacts.flat_map(|contact| contact.model.memory_layout().names()) {
        let name = column_name(name);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// The units of those columns, by their names.
pub(super) fn memory_units(scenario: &Scenario) -> Vec<(String, String)> {
    let contacts = scenario.contacts.iter().chain(scenario.stages.iter().flat_map(|stage| &stage.contacts));
    let with_unit = |name: &'static str| {
        let (name, unit) = name.split_once(" [")?;
        Some((name.to_owned(), unit.trim_end_matches(']').to_owned()))
    };
    contacts
        .flat_map(|contact| contact.model.memory_layout().names().filter_map(with_unit).collect::<Vec<_>>())
        .collect()
}

/// The name of a column of memory without what follows it.
fn column_name(name: &'static str) -> &'static str {
    name.split(' ').next().unwrap_or(name)
}

/// Particles in the order of their ids, contacts and walls at the present time.
pub(crate) fn frame_of(scenario: &Scenario, simulation: &Simulation) -> Frame {
    selected_frame(scenario, simulation, &Selection::default_of_runs(scenario))
}

/// What is asked for of the present state.
pub(crate) fn selected_frame(
    scenario: &Scenario,
    simulation: &Simulation,
    selection: &Selection<'_>,
) -> Frame {
    let contacts = Contacts::of(simulation);
    Frame {
        particles: particles(simulation, &contacts, selection),
        contacts: contacts.into_lines(simulation, selection),
        walls: walls(scenario, simulation),
        surfaces: surfaces(scenario, simulation),
    }
}

fn particles(simulation: &Simulation, contacts: &Contacts, selection: &Selection<'_>) -> PolyData {
    let particles = simulation.particles();
    let mut rows = particles.rows_by_id();
    // Sums over contacts need all particles.
    let sums = ParticleSums::new(contacts, simulation, &rows);
    let mut kept: Vec<usize> = (0..rows.len()).collect();
    if let Some(region) = &selection.region {
        kept.retain(|&place| region.contains(particles.positions()[rows[place]], simulation.domain()));
        rows = kept.iter().map(|&place| rows[place]).collect();
    }
    let vectors =
        |column: Vectors<'_>| -> Vec<[f64; 3]> { rows.iter().map(|&row| column[row].to_array()).collect() };
    let scalars = |column: &[f64]| Numbers::Scalar(rows.iter().map(|&row| column[row]).collect());
    let computed =
        |value: &dyn Fn(usize) -> f64| Numbers::Scalar(rows.iter().map(|&row| value(row)).collect());
    let names = selection.fields(particles.columns().iter().map(|column| column.name.as_str()));
    // Where the time series does not tell groups, a file that asks for them has those of contacts that act.
    let rule =
        if selection.clusters == ClusterRule::Never { ClusterRule::Acting } else { selection.clusters };
    let graph = names.iter().any(|name| OF_CLUSTERS.contains(name)).then(|| Graph::new(simulation, rule));
    let of_graph = |of: &dyn Fn(&Graph, usize) -> usize| {
        let number =
            |&row: &usize| graph.as_ref().map_or(0, |graph| of(graph, particles.ids()[row] as usize));
        Numbers::Integer(rows.iter().map(|row| number(row) as i64).collect())
    };
    let column = |name: &str| match name {
        "id" => Numbers::Integer(rows.iter().map(|&row| i64::from(particles.ids()[row])).collect()),
        "type" => Numbers::Integer(rows.iter().map(|&row| i64::from(particles.materials()[row])).collect()),
        "radius" => scalars(particles.radii()),
        "v" => Numbers::Vector(vectors(particles.velocities())),
        "omega" => Numbers::Vector(vectors(particles.angular_velocities())),
        "f" => Numbers::Vector(vectors(particles.forces())),
        "torque" => Numbers::Vector(vectors(particles.torques())),
        "coordination" => Numbers::Integer(sums.coordination(&kept)),
        "mass" => scalars(particles.masses()),
        "stress" => Numbers::Tensor(sums.stress(&kept)),
        "kinetic_translation" => {
            computed(&|row| 0.5 * particles.masses()[row] * particles.velocities()[row].norm_squared())
        }
        "kinetic_rotation" => computed(&|row| {
            // I = 2/5 m a^2 of a sphere.
            let inertia = 0.4 * particles.masses()[row] * particles.radii()[row] * particles.radii()[row];
            0.5 * inertia * particles.angular_velocities()[row].norm_squared()
        }),
        "stored_energy" => Numbers::Scalar(sums.stored_energy(&kept)),
        "cluster" => of_graph(&|graph, id| graph.root(id)),
        "cluster_size" => of_graph(&|graph, id| graph.size_around(id)),
        own => match particles.column(own) {
            Some(own) => scalars(&own.values),
            None => Numbers::Scalar(vec![f64::NAN; rows.len()]),
        },
    };
    let columns = names.into_iter().map(|name| (name.to_owned(), column(name))).collect();
    PolyData { points: vectors(particles.positions()), columns }
}

/// All contacts, column by column. The second id of a wall contact is −1 − the wall's place.
#[derive(Default)]
pub(super) struct Contacts {
    /// Centres; of a wall the nearest point of its surface [m].
    pub(super) ends: Vec<[[f64; 3]; 2]>,
    pub(super) first: Vec<i64>,
    pub(super) second: Vec<i64>,
    /// Force on the first body [N].
    pub(super) force: Vec<[f64; 3]>,
    normal_force: Vec<f64>,
    pub(super) overlap: Vec<f64>,
    pub(super) stored_energy: Vec<f64>,
    /// What contacts remember, by the names of the columns; NaN where a contact has no such column.
    memory: Vec<(&'static str, Vec<f64>)>,
}

impl Contacts {
    /// The contacts as lines with their columns.
    fn into_lines(self, simulation: &Simulation, selection: &Selection<'_>) -> PolyData {
        if selection.contacts.is_empty() {
            return PolyData::default();
        }
        let needed = selection.region.is_some() || selection.contacts.contains(&"point");
        let points = if needed { self.points(simulation) } else { Vec::new() };
        let is_inside = |contact: usize| {
            let region = selection.region.as_ref();
            region.is_none_or(|region| region.contains(points[contact].into(), simulation.domain()))
        };
        let kept: Vec<usize> = (0..self.first.len()).filter(|&contact| is_inside(contact)).collect();
        let mut columns = Vec::new();
        for &name in &selection.contacts {
            if name == "memory" {
                let now = || self.memory.iter().map(|(name, _)| *name).collect();
                for name in selection.memory.clone().unwrap_or_else(now) {
                    columns.push((name.to_owned(), self.remembered(name, &kept)));
                }
            } else {
                columns.push((name.to_owned(), self.column(name, &points, &kept)));
            }
        }
        PolyData { points: kept.iter().flat_map(|&contact| self.ends[contact]).collect(), columns }
    }

    fn column(&self, name: &str, points: &[[f64; 3]], kept: &[usize]) -> Numbers {
        let vectors = |vector: &dyn Fn(usize) -> [f64; 3]| {
            Numbers::Vector(kept.iter().map(|&contact| vector(contact)).collect())
        };
        let integers =
            |values: &[i64]| Numbers::Integer(kept.iter().map(|&contact| values[contact]).collect());
        match name {
            "id1" => integers(&self.first),
            "id2" => integers(&self.second),
            "force" => vectors(&|contact| self.force[contact]),
            "normal_force" => scalars(&self.normal_force, kept),
            "overlap" => scalars(&self.overlap, kept),
            "stored_energy" => scalars(&self.stored_energy, kept),
            "point" => vectors(&|contact| points[contact]),
            "branch" => vectors(&|contact| self.branch(contact).to_array()),
            "normal" => vectors(&|contact| self.normal(contact).to_array()),
            _ => vectors(&|contact| {
                let force = Vector3::from(self.force[contact]);
                (force - self.normal(contact) * self.normal_force[contact]).to_array()
            }),
        }
    }

    /// What contacts remember in a column of this name.
    fn remembered(&self, name: &str, kept: &[usize]) -> Numbers {
        match self.memory.iter().find(|(known, _)| *known == name) {
            Some((_, values)) => scalars(values, kept),
            None => Numbers::Scalar(vec![f64::NAN; kept.len()]),
        }
    }

    /// From the second centre to the first; of a wall from the nearest point of its surface [m].
    pub(super) fn branch(&self, contact: usize) -> Vector3 {
        let [first, second] = self.ends[contact];
        Vector3::from(first) - Vector3::from(second)
    }

    /// The direction of the branch.
    fn normal(&self, contact: usize) -> Vector3 {
        let branch = self.branch(contact);
        branch * (1.0 / branch.norm())
    }

    /// The contact points: between particles in the middle of the overlap, on a wall the nearest point of its surface [m].
    pub(super) fn points(&self, simulation: &Simulation) -> Vec<[f64; 3]> {
        let particles = simulation.particles();
        let (rows, ids) = (particles.rows_by_id(), particles.ids());
        let radius = |id: i64| {
            let place = rows.binary_search_by_key(&id, |&row| i64::from(ids[row]));
            place.map_or(f64::NAN, |place| particles.radii()[rows[place]])
        };
        let point = |contact: usize| {
            let [first, second] = self.ends[contact];
            if self.second[contact] < 0 {
                return second;
            }
            let lever = radius(self.first[contact]) - 0.5 * self.overlap[contact];
            (Vector3::from(first) - self.normal(contact) * lever).to_array()
        };
        (0..self.first.len()).map(point).collect()
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
        self.stored_energy.push(contact.stored_energy);
        self.remember(contact);
    }

    /// Adds the contacts of a later part.
    fn append(&mut self, part: Self) {
        let before = self.first.len();
        let Self { ends, first, second, force, normal_force, overlap, stored_energy, memory } = part;
        self.ends.extend(ends);
        self.first.extend(first);
        self.second.extend(second);
        self.force.extend(force);
        self.normal_force.extend(normal_force);
        self.overlap.extend(overlap);
        self.stored_energy.extend(stored_energy);
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
            let values = self.memory_of(column_name(name));
            values.resize(before, f64::NAN);
            values.push(value);
        }
    }
}

fn scalars(values: &[f64], kept: &[usize]) -> Numbers {
    Numbers::Scalar(kept.iter().map(|&contact| values[contact]).collect())
}
