//! Groups of particles, and what stages do with them.

use super::controls::{read_parameter, write_parameters};
use super::materials::Material;
use super::observers::Observer;
use super::region::{read_region, write_region};
use super::resolved::writer::{Writer, key, list, text};
use super::walls::Wall;
use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::{Boolean, Integer, Name};
use pulvis_boundary::{Domain, GroupMotion, Region};

/// A group: the particles to which all of its criteria apply when it is gathered, at the start of the first stage that names it.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupPlan {
    /// Its name: letters, digits and underscores.
    pub name: String,
    /// Index of the material of its particles.
    pub material: Option<usize>,
    /// Where their centres lie.
    pub region: Option<Region>,
    /// Ranges of their ids, first and last; of any where there is none.
    pub ids: Vec<[u32; 2]>,
}

impl GroupPlan {
    /// Whether the criteria that need no place apply to a particle.
    pub fn takes_in(&self, id: u32, material: usize) -> bool {
        self.material.is_none_or(|own| own == material)
            && (self.ids.is_empty() || self.ids.iter().any(|[first, last]| (*first..=*last).contains(&id)))
    }
}

/// What happens to a group at the start of a stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupControl {
    /// How it moves from now on.
    pub motion: GroupMotion,
    /// Whether its particles are gathered anew.
    pub regather: bool,
}

/// Reads `[groups.NAME]`.
pub(super) fn read_groups(
    root: &mut TableReader<'_>,
    materials: &[Material],
    walls: &[Wall],
    others: &[String],
) -> Result<Vec<GroupPlan>, Reported> {
    let tables = root.named_tables("groups")?;
    let read: Vec<_> = tables
        .into_iter()
        .map(|(name, table)| {
            let used = walls.iter().any(|wall| wall.name == name) || others.contains(&name);
            read_group(table, name, materials, used)
        })
        .collect();
    read.into_iter().collect()
}

fn read_group(
    mut table: TableReader<'_>,
    name: String,
    materials: &[Material],
    is_used: bool,
) -> Result<GroupPlan, Reported> {
    if !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        let found = format!("{name:?} is no name for columns");
        return Err(table.refuse("", Problem::rule(found, "only letters, digits and underscores")));
    }
    if is_used {
        let found = format!("a wall, an inlet or an outlet is called {name:?} too");
        return Err(table.refuse("", Problem::rule(found, "another name for the group")));
    }
    let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
    let material = table.optional("material", Name(&names));
    let region = read_region(&mut table, "region");
    let range = List::of(Integer::between(0, i64::from(u32::MAX))).exactly(2);
    let ids = table.optional("ids", List::of(range).at_least(1));
    let ids = ids.and_then(|ids| {
        let ids: Vec<Vec<i64>> = ids.unwrap_or_default();
        if let Some(wrong) = ids.iter().find(|range| range[0] > range[1]) {
            let found = format!("{} is above {}", wrong[0], wrong[1]);
            return Err(
                table.refuse("ids", Problem::rule(found, "[first, last] of each range, both included"))
            );
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // read as 32-bit numbers
        Ok(ids.into_iter().map(|range| [range[0] as u32, range[1] as u32]).collect::<Vec<_>>())
    });
    let (material, region, ids) = (material?, region?, ids?);
    if material.is_none() && region.is_none() && ids.is_empty() {
        let expected = "what its particles have in common: `material`, `region` or `ids`".to_owned();
        return Err(table.refuse("region", Problem::MissingKey { key: "region".to_owned(), expected }));
    }
    table.finish();
    let material = material.and_then(|name| names.iter().position(|known| *known == name));
    Ok(GroupPlan { name, material, region, ids })
}

/// Refuses observers that are called like a group: their columns could be confused.
pub(super) fn check_group_names(
    root: &TableReader<'_>,
    groups: &[GroupPlan],
    observers: &[Observer],
) -> Result<(), Reported> {
    let same = observers.iter().find(|observer| groups.iter().any(|group| group.name == observer.name));
    let Some(observer) = same else { return Ok(()) };
    let found = format!("an observer and a group are called {:?}", observer.name);
    Err(root.refuse("observers", Problem::rule(found, "another name for each")))
}

/// Reads `[stages.groups.NAME]`.
pub(super) fn read_group_controls(
    stage: &mut TableReader<'_>,
    groups: &[GroupPlan],
    domain: Option<&Domain>,
) -> Result<Vec<(usize, GroupControl)>, Reported> {
    let names: Vec<&str> = groups.iter().map(|group| group.name.as_str()).collect();
    let mut controls = Vec::new();
    let mut failure = None;
    for (name, table) in stage.named_tables("groups")? {
        let read = match names.iter().position(|known| *known == name) {
            None if names.is_empty() => {
                let found = format!("there is no group {name}, nor any other");
                Err(table
                    .refuse("", Problem::rule(found, format!("[groups.{name}] that says who belongs to it"))))
            }
            None => Err(table.refuse("", Problem::unknown_choice(&name, &names))),
            Some(index) => read_control(table, domain).map(|control| controls.push((index, control))),
        };
        failure = read.err().or(failure);
    }
    controls.sort_by_key(|(index, _)| *index);
    failure.map_or(Ok(controls), Err)
}

fn read_control(mut table: TableReader<'_>, domain: Option<&Domain>) -> Result<GroupControl, Reported> {
    let name = table.selector("control", &GroupMotion::NAMES)?;
    let regather = table.or("regather", Boolean, false);
    let mut motion = GroupMotion::named(name).unwrap_or_default();
    let (mut failure, mut numbers) = (None, Vec::new());
    for parameter in motion.parameters() {
        failure = read_parameter(&mut table, parameter, &mut numbers).err().or(failure);
    }
    if let Some(reported) = failure {
        return Err(reported);
    }
    if let Err(invalid) = motion.check() {
        return Err(table.refuse(invalid.parameter, Problem::rule(invalid.found, invalid.expected)));
    }
    if let (GroupMotion::Rotation(rotation), Some(domain)) = (&motion, domain) {
        let unit = rotation.axis * (1.0 / rotation.axis.norm());
        let across = |&axis: &usize| domain.periodic[axis] && (unit[axis].abs() - 1.0).abs() >= 1e-12;
        if let Some(axis) = (0..3).find(across) {
            let found = format!("a rotation through {}, where space repeats", ["x", "y", "z"][axis]);
            return Err(
                table.refuse("axis", Problem::rule(found, "an axis along the only direction that repeats"))
            );
        }
    }
    table.finish();
    Ok(GroupControl { motion, regather: regather? })
}

/// Writes `[groups.NAME]`.
pub(super) fn write_groups(writer: &mut Writer, groups: &[GroupPlan], material: impl Fn(usize) -> String) {
    for GroupPlan { name, material: own, region, ids } in groups {
        writer.table(&format!("groups.{}", key(name)));
        if let Some(own) = own {
            writer.key("material", material(*own));
        }
        if !ids.is_empty() {
            let ranges = ids.iter().map(|range| list(range.iter().map(ToString::to_string)));
            writer.key("ids", list(ranges));
        }
        if let Some(region) = region {
            writer.table(&format!("groups.{}.region", key(name)));
            write_region(writer, region);
        }
    }
}

/// Writes `[stages.groups.NAME]`.
pub(super) fn write_group_control(writer: &mut Writer, control: &GroupControl) {
    let GroupControl { mut motion, regather } = *control;
    writer.key("control", text(motion.name()));
    if regather {
        writer.key("regather", true.to_string());
    }
    write_parameters(writer, motion.parameters());
}
