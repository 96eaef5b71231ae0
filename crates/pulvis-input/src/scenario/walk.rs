//! The walk over a scenario file, first as it stands, then once more for every stage that switches.

use super::contacts::{Contact, MaterialUse, read_contacts};
use super::domain::{read_background, read_domain};
use super::limits::read_limits;
use super::materials::{Material, read_materials};
use super::output::read_output;
use super::particles::{PlacedGroup, read_particles};
use super::placement::check_placement;
use super::stages::{PlannedStage, Stage, read_stages};
use super::switches::switched;
use super::time::{TimeStep, read_time};
use super::walls::{Walls, read_walls};
use super::{Scenario, ScenarioSource};
use crate::context::Reported;
use crate::document::Document;
use crate::error::InputErrors;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::{Integer, Text};
use pulvis_boundary::Background;
use pulvis_contact::bond::Form;
use std::path::Path;

/// The keys of a scenario, in the order of the documentation.
const KEYS: [&str; 14] = [
    "title",
    "seed",
    "gravity",
    "domain",
    "materials",
    "contacts",
    "background",
    "particles",
    "box",
    "walls",
    "time",
    "stages",
    "limits",
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
    let domain = read_domain(&mut root);
    let time = read_time(&mut root, TimeStep::default());
    let limits = read_limits(&mut root);
    // Everything else speaks of materials.
    let (materials, fit) = read_materials(&mut root)?;
    let known = domain.as_ref().map_or(None, Option::as_ref);
    let walls = read_walls(&mut root, &materials, known);
    let groups = read_particles(&mut root, &materials, folder);
    let stages = match (&walls, &time) {
        (Ok(walls), Ok(time)) => read_stages(&mut root, &walls.walls, *time),
        (&Err(reported), _) | (_, &Err(reported)) => Err(reported),
    };
    let names: Option<Vec<&str>> =
        stages.as_ref().ok().map(|stages| stages.iter().map(|stage| stage.name.as_str()).collect());
    let output = read_output(&mut root, file, names.as_deref());
    let bodies = walls.and_then(|walls| {
        let groups = groups?;
        check_placement(&root, &groups, &walls.walls, known)?;
        Ok((walls, groups))
    });
    let used = bodies.as_ref().map(|(walls, groups)| material_use(walls, groups)).ok();
    let changing = Changing::read(&mut root, &materials, used.as_ref());
    root.finish();
    fit?;
    let (walls, groups) = bodies?;
    let Changing { contacts, background } = changing?;
    let scenario = Scenario {
        source: ScenarioSource::default(),
        title: title?,
        seed: seed?.unsigned_abs(),
        domain: domain?,
        materials,
        contacts,
        background,
        particles: groups.into_iter().map(|(group, _)| group).collect(),
        enclosure: walls.enclosure,
        walls: walls.walls,
        time: time?,
        stages: Vec::new(),
        limits: limits?,
        output: output?,
    };
    Ok((scenario, stages?, used.unwrap_or_default()))
}

/// The materials of particles and walls, each once.
fn material_use(walls: &Walls, groups: &[PlacedGroup]) -> MaterialUse {
    let unique = |mut indices: Vec<usize>| {
        indices.sort_unstable();
        indices.dedup();
        indices
    };
    let count = |material: usize| -> usize {
        let of_material = groups.iter().filter(|(group, _)| group.material == material);
        of_material.map(|(group, _)| group.count).sum()
    };
    let particles = unique(groups.iter().map(|(group, _)| group.material).collect());
    MaterialUse {
        lone: particles.iter().copied().filter(|&material| count(material) == 1).collect(),
        particles,
        walls: unique(walls.walls.iter().map(|wall| wall.material).collect()),
    }
}

/// What stages can switch.
struct Changing {
    contacts: Vec<Contact>,
    background: Background,
}

impl Changing {
    fn read(
        root: &mut TableReader<'_>,
        materials: &[Material],
        used: Option<&MaterialUse>,
    ) -> Result<Self, Reported> {
        let background = read_background(root);
        let contacts = read_contacts(root, materials, used)?;
        Ok(Self { contacts, background: background? })
    }
}

/// Whether bonds of a contact form at the start of stages that say so.
fn forms_bonds_at_start(contact: &Contact) -> bool {
    contact.model.laws.bond.is_some_and(|bond| bond.formation.form == Form::StageStart)
}

/// The stages with everything that holds in them.
fn resolve(
    document: &Document,
    scenario: &Scenario,
    used: &MaterialUse,
    planned: Vec<PlannedStage>,
) -> Result<Vec<Stage>, InputErrors> {
    let mut document = document.clone();
    let mut stages: Vec<Stage> = Vec::with_capacity(planned.len());
    for stage in planned {
        let PlannedStage { name, until, remove, form_bonds, controls, switches, time } = stage;
        let changing = if switches.is_empty() {
            let before = stages.last();
            Changing {
                contacts: before.map_or(&scenario.contacts, |stage| &stage.contacts).clone(),
                background: before.map_or(scenario.background, |stage| stage.background),
            }
        } else {
            document = switched(&document, &switches)?;
            let read = document.read(|mut root| {
                let changing = Changing::read(&mut root, &scenario.materials, Some(used));
                // The rest of the file has been checked in the first walk.
                for key in root.keys() {
                    root.value(key);
                }
                root.finish();
                changing
            });
            read.map_err(|errors| {
                errors.with_help(&format!("this is what [stages.set] of stage \"{name}\" leads to"))
            })?
        };
        let Changing { contacts, background } = changing;
        if let Some(place) = &form_bonds
            && !contacts.iter().any(forms_bonds_at_start)
        {
            let found = "no contact has a bond that forms at the start of a stage";
            let expected = "a table [contacts.A-B.bond] with `form = \"stage-start\"`";
            return Err(document.error_at(place, Problem::rule(found, expected)).into());
        }
        let form_bonds = form_bonds.is_some();
        stages.push(Stage { name, until, remove, form_bonds, controls, contacts, background, time });
    }
    Ok(stages)
}
