//! The walk over a scenario file, first as it stands, then once more for every stage that switches.

use super::allow::read_allow;
use super::columns::{ParticleColumn, Reader, needs_quantity};
use super::contacts::{Contact, MaterialUse, read_contacts};
use super::domain::{read_background, read_domain};
use super::electrostatics::{check_charges, check_number_of_charges, read_electrostatics};
use super::groups::{check_group_names, read_groups};
use super::limits::read_limits;
use super::materials::{Material, read_materials};
use super::observers::{check_discards, durations, read_observers};
use super::openings::{Openings, read_openings};
use super::output::read_output;
use super::output_files::Sample;
use super::particles::{PlacedGroup, read_particles};
use super::placement::check_placement;
use super::resolve::resolve;
use super::stages::{PlannedStage, read_stages};
use super::start::read_start;
use super::time::{TimeStep, read_time};
use super::walls::{Walls, read_walls};
use super::{Scenario, ScenarioSource};
use crate::context::Reported;
use crate::document::Document;
use crate::error::InputErrors;
use crate::reader::TableReader;
use crate::shape::{Integer, Text};
use crate::surroundings::{needs_temperature, read_temperature};
use pulvis_boundary::{Background, TemperatureProgram};
use std::path::Path;

/// The keys of a scenario, in the order of the documentation.
const KEYS: [&str; 22] = [
    "title",
    "start_from",
    "seed",
    "allow",
    "gravity",
    "domain",
    "materials",
    "contacts",
    "background",
    "temperature",
    "electrostatics",
    "particles",
    "inlets",
    "outlets",
    "box",
    "walls",
    "groups",
    "time",
    "stages",
    "limits",
    "observers",
    "output",
];

/// Reads and checks a scenario.
pub(super) fn scenario(document: &Document, path: Option<&Path>) -> Result<Scenario, InputErrors> {
    let file = path.unwrap_or(Path::new(document.name()));
    let folder = path.and_then(Path::parent).unwrap_or(Path::new(""));
    let (mut scenario, planned, used) = document.read(|root| walk(root, file, folder))?;
    scenario.source = ScenarioSource {
        name: document.name().to_owned(),
        path: path.map(Path::to_path_buf),
        text: document.text().to_owned(),
        replaced: document.replaced(),
    };
    scenario.stages = resolve(document, &scenario, &used, planned)?;
    Ok(scenario)
}

/// A scenario without stages, its stages before their switches are applied, and its materials' use.
type Walked = (Scenario, Vec<PlannedStage>, MaterialUse);

fn walk(mut root: TableReader<'_>, file: &Path, folder: &Path) -> Result<Walked, Reported> {
    // Fixed order of known keys, which is the order in which help texts list them.
    for key in KEYS {
        root.value(key);
    }
    let title = root.optional("title", Text);
    let seed = root.or("seed", Integer::at_least(0), 1);
    let allow = read_allow(&mut root);
    let start_from = read_start(&mut root, folder);
    let domain = read_domain(&mut root);
    let time = read_time(&mut root, TimeStep::default());
    let limits = read_limits(&mut root);
    // Everything else speaks of materials.
    let (materials, fit) = read_materials(&mut root)?;
    let known = domain.as_ref().map_or(None, Option::as_ref);
    let walls = read_walls(&mut root, &materials, known, folder);
    let groups = read_particles(&mut root, &materials, folder);
    let enclosure = walls.as_ref().ok().and_then(|walls| walls.enclosure.as_ref());
    let placed = groups.as_ref().ok().map(|groups| &groups[..]);
    let openings = read_openings(&mut root, &materials, placed, known, enclosure);
    let particle_groups = match (&walls, &openings) {
        (Ok(walls), Ok(openings)) => {
            let others: Vec<String> = openings.list().into_iter().map(|opening| opening.name).collect();
            read_groups(&mut root, &materials, &walls.walls, &others)
        }
        (&Err(reported), _) | (_, &Err(reported)) => Err(reported),
    };
    let stages = match (&walls, &time, &openings, &particle_groups) {
        (Ok(walls), Ok(time), Ok(openings), Ok(groups)) => {
            read_stages(&mut root, known, &walls.walls, groups, &openings.list(), *time)
        }
        (&Err(reported), ..) | (_, &Err(reported), ..) | (_, _, &Err(reported), _) | (.., &Err(reported)) => {
            Err(reported)
        }
    };
    let names: Option<Vec<&str>> =
        stages.as_ref().ok().map(|stages| stages.iter().map(|stage| stage.name.as_str()).collect());
    let openings = openings.and_then(|openings| {
        openings.check_stages(&root, names.as_deref().unwrap_or_default())?;
        Ok(openings)
    });
    let observers = read_observers(&mut root, known, enclosure).and_then(|observers| {
        let durations = stages.as_ref().map_or_else(|_| vec![None], |stages| durations(stages));
        check_discards(&root, &observers, &durations)?;
        openings.as_ref().map_or(Ok(()), |openings| openings.check_observers(&root, &observers))?;
        let groups = particle_groups.as_ref().map_or(&[][..], |groups| &groups[..]);
        check_group_names(&root, groups, &observers)?;
        Ok(observers)
    });
    let columns = match (&groups, &openings) {
        (Ok(groups), Ok(openings)) => {
            // All groups and inlets have the same; where there is neither, particles come from another run.
            let group = groups.first().map(|(group, _)| &group.columns[..]);
            let first = group.or_else(|| openings.inlets.first().map(|(inlet, _)| &inlet.columns[..]));
            first.map(|columns| columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>())
        }
        _ => None,
    };
    let sample = Sample { domain: known, enclosure, columns: columns.as_deref() };
    let output = read_output(&mut root, file, &sample, names.as_deref());
    let bodies = walls.and_then(|walls| {
        let groups = groups?;
        check_placement(&root, &groups, &walls.walls, known)?;
        Ok((walls, groups, openings?))
    });
    let used = bodies.as_ref().map(|(walls, groups, openings)| material_use(walls, groups, openings)).ok();
    let temperature = read_temperature(&mut root);
    let electrostatics = read_electrostatics(&mut root, known).and_then(|medium| {
        if let (Some(_), Ok((_, groups, _))) = (medium, &bodies) {
            check_number_of_charges(&root, groups)?;
        }
        Ok(medium)
    });
    let columns = bodies.as_ref().map(|(_, groups, openings)| {
        let groups = groups.iter().map(|(group, _)| ("particles", &group.columns[..]));
        groups
            .chain(openings.inlets.iter().map(|(inlet, _)| ("inlets", &inlet.columns[..])))
            .collect::<Vec<_>>()
    });
    let given = match (&columns, &temperature, &electrostatics) {
        (Ok(columns), Ok(temperature), Ok(electrostatics)) => Some(Given {
            columns,
            temperature: temperature.as_ref(),
            has_electrostatics: electrostatics.is_some(),
        }),
        _ => None,
    };
    let changing = Changing::read(&mut root, &materials, used.as_ref(), given);
    root.finish();
    fit?;
    let (walls, groups, openings) = bodies?;
    let Changing { contacts, background } = changing?;
    let scenario = Scenario {
        source: ScenarioSource::default(),
        title: title?,
        start_from: start_from?.map(|(start, _)| start),
        seed: seed?.unsigned_abs(),
        domain: domain?,
        materials,
        contacts,
        background,
        temperature: temperature?,
        electrostatics: electrostatics?,
        particles: groups.into_iter().map(|(group, _)| group).collect(),
        inlets: openings.inlets.into_iter().map(|(inlet, _)| inlet).collect(),
        outlets: openings.outlets.into_iter().map(|(outlet, _)| outlet).collect(),
        enclosure: walls.enclosure,
        walls: walls.walls,
        groups: particle_groups?,
        time: time?,
        stages: Vec::new(),
        allow: allow?,
        limits: limits?,
        observers: observers?,
        output: output?,
    };
    Ok((scenario, stages?, used.unwrap_or_default()))
}

/// The materials of particles and walls, each once.
fn material_use(walls: &Walls, groups: &[PlacedGroup], openings: &Openings) -> MaterialUse {
    let unique = |mut indices: Vec<usize>| {
        indices.sort_unstable();
        indices.dedup();
        indices
    };
    let count = |material: usize| -> usize { groups.iter().map(|(group, _)| group.count_of(material)).sum() };
    let brought = || openings.inlets.iter().map(|(inlet, _)| inlet.material);
    let particles = unique(groups.iter().flat_map(|(group, _)| group.materials()).chain(brought()).collect());
    let is_lone = |material: usize| count(material) == 1 && !brought().any(|other| other == material);
    MaterialUse {
        lone: particles.iter().copied().filter(|&material| is_lone(material)).collect(),
        particles,
        walls: unique(walls.walls.iter().map(|wall| wall.material).collect()),
    }
}

/// What stages can switch.
pub(super) struct Changing {
    pub(super) contacts: Vec<Contact>,
    pub(super) background: Background,
}

impl Changing {
    pub(super) fn read(
        root: &mut TableReader<'_>,
        materials: &[Material],
        used: Option<&MaterialUse>,
        given: Option<Given<'_>>,
    ) -> Result<Self, Reported> {
        let background = read_background(root);
        let mut contacts = read_contacts(root, materials, used)?;
        if let Some(given) = given {
            given.satisfies(root, &mut contacts)?;
        }
        Ok(Self { contacts, background: background? })
    }
}

/// What a scenario gives to laws that ask for more than the bodies and their motion.
#[derive(Clone, Copy)]
pub(super) struct Given<'a> {
    /// The further quantities of all groups and inlets, with the key that they stand under.
    pub(super) columns: &'a [(&'a str, &'a [ParticleColumn])],
    pub(super) temperature: Option<&'a TemperatureProgram>,
    /// Whether charges act over all distances.
    pub(super) has_electrostatics: bool,
}

impl Given<'_> {
    /// Whether all is there that the contacts read; tells them how large it is.
    fn satisfies(&self, root: &TableReader<'_>, contacts: &mut [Contact]) -> Result<(), Reported> {
        needs_temperature(root, self.temperature, contacts.iter().map(|contact| &contact.model))?;
        if self.has_electrostatics {
            check_charges(root, self.columns, contacts)?;
        }
        for contact in contacts {
            for quantity in contact.model.particle_quantities() {
                self.columns
                    .iter()
                    .try_for_each(|columns| needs_quantity(root, *columns, quantity, Reader::Law))?;
            }
            let columns = || self.columns.iter().flat_map(|(_, columns)| *columns);
            contact.model = contact.model.bounded_by(|name| {
                columns().filter(|column| column.name == name).map(|column| column.value).collect()
            });
        }
        Ok(())
    }
}
