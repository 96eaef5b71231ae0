//! Inlets and outlets: what both have in common.

use super::inlets::{Inlet, read_inlets};
use super::materials::Material;
use super::observers::Observer;
use super::outlets::{Outlet, read_outlets};
use super::particles::PlacedGroup;
use super::resolved::writer::{Writer, list, quantity, text};
use crate::context::{Location, Reported};
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Text;
use pulvis_boundary::{Cuboid, Domain};
use pulvis_math::Dimension;

/// When an opening is open.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    /// The names of the stages in which it is open; all of them where it is `None`.
    pub stages: Option<Vec<String>>,
    /// Time of the run before which it is shut [s].
    pub start: f64,
    /// Time of the run from which on it is shut [s]; may be infinite.
    pub stop: f64,
}

impl Schedule {
    /// Whether it is open in a stage at some time.
    pub fn takes_in(&self, stage: &str) -> bool {
        self.stages.as_ref().is_none_or(|stages| stages.iter().any(|name| name == stage))
    }
}

/// The inlets and outlets of a scenario as they are read, with the places of their stages in the file.
pub(super) struct Openings {
    pub(super) inlets: Vec<(Inlet, Location)>,
    pub(super) outlets: Vec<(Outlet, Location)>,
}

/// What an opening is called, and what will pass it at most.
#[derive(Clone, Debug)]
pub(super) struct Opening {
    pub(super) name: String,
    pub(super) total: Option<pulvis_packing::Amount>,
}

impl Openings {
    /// Inlets, then outlets.
    pub(super) fn list(&self) -> Vec<Opening> {
        let inlets =
            self.inlets.iter().map(|(inlet, _)| Opening { name: inlet.name.clone(), total: inlet.total });
        let outlets =
            self.outlets.iter().map(|(outlet, _)| Opening { name: outlet.name.clone(), total: None });
        inlets.chain(outlets).collect()
    }

    /// Refuses stages that there are not.
    pub(super) fn check_stages(&self, root: &TableReader<'_>, stages: &[&str]) -> Result<(), Reported> {
        let inlets = self.inlets.iter().map(|(inlet, place)| (&inlet.schedule, place));
        let outlets = self.outlets.iter().map(|(outlet, place)| (&outlet.schedule, place));
        for (schedule, place) in inlets.chain(outlets) {
            let mut names = schedule.stages.iter().flatten();
            if let Some(name) = names.find(|name| !stages.contains(&name.as_str())) {
                return Err(root.refuse_at(place, Problem::unknown_choice(name, stages)));
            }
        }
        Ok(())
    }

    /// Refuses observers that are called like an opening: their columns could be confused.
    pub(super) fn check_observers(
        &self,
        root: &TableReader<'_>,
        observers: &[Observer],
    ) -> Result<(), Reported> {
        let openings = self.list();
        let same =
            observers.iter().find(|observer| openings.iter().any(|opening| opening.name == observer.name));
        let Some(observer) = same else { return Ok(()) };
        let found = format!("an observer and an inlet or outlet are called {:?}", observer.name);
        Err(root.refuse("observers", Problem::rule(found, "another name for each")))
    }
}

/// Reads `[[inlets]]` and `[[outlets]]`.
pub(super) fn read_openings(
    root: &mut TableReader<'_>,
    materials: &[Material],
    groups: Option<&[PlacedGroup]>,
    domain: Option<&Domain>,
    enclosure: Option<&Cuboid>,
) -> Result<Openings, Reported> {
    let mut names = Vec::new();
    let inlets = read_inlets(root, materials, groups, (domain, enclosure), &mut names);
    let outlets = read_outlets(root, domain, &mut names);
    Ok(Openings { inlets: inlets?, outlets: outlets? })
}

/// Reads the name of an opening, which no other one in `names` has.
pub(super) fn read_name(table: &mut TableReader<'_>, names: &mut Vec<String>) -> Result<String, Reported> {
    let name = table.required("name", Text)?;
    if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        let found = format!("{name:?} is no name for columns");
        return Err(table.refuse("name", Problem::rule(found, "only letters, digits and underscores")));
    }
    if name.contains("_class_") {
        let found = format!("{name:?} has `_class_` in it, as columns of classes of size have");
        return Err(table.refuse("name", Problem::rule(found, "a name without `_class_`")));
    }
    if names.contains(&name) {
        let found = format!("two inlets or outlets are called {name:?}");
        return Err(table.refuse("name", Problem::rule(found, "another name for each of them")));
    }
    names.push(name.clone());
    Ok(name)
}

/// Reads `stages`, `start` and `stop`, with the place of `stages`.
pub(super) fn read_schedule(table: &mut TableReader<'_>) -> Result<(Schedule, Location), Reported> {
    let stages = table.optional("stages", List::of(Text));
    let place = table.location("stages");
    let start = table.or("start", QuantityRule::of(Dimension::TIME).at_least(0.0), 0.0);
    let rule = QuantityRule::of(Dimension::TIME).above(0.0).or_infinite();
    let stop = table.or("stop", rule, f64::INFINITY);
    let (stages, start, stop) = (stages?, start?, stop?);
    if stop <= start {
        let found = format!("{stop} s is not after start = {start} s");
        return Err(table.refuse("stop", Problem::rule(found, "start < stop")));
    }
    Ok((Schedule { stages, start, stop }, place))
}

/// Writes the keys of [`read_schedule`].
pub(super) fn write_schedule(writer: &mut Writer, schedule: &Schedule) {
    let Schedule { stages, start, stop } = schedule;
    if let Some(stages) = stages {
        writer.key("stages", list(stages.iter().map(|stage| text(stage))));
    }
    writer.key("start", quantity(*start, Dimension::TIME));
    writer.key("stop", quantity(*stop, Dimension::TIME));
}

/// Reads `size_classes`: radii between classes of size that are counted apart.
pub(super) fn read_size_classes(table: &mut TableReader<'_>) -> Result<Vec<f64>, Reported> {
    let radii = List::of(QuantityRule::of(Dimension::LENGTH).above(0.0)).at_least(1);
    let bounds = table.optional("size_classes", radii)?.unwrap_or_default();
    if let Some(two) = bounds.windows(2).find(|two| two[0] >= two[1]) {
        let found = format!("{} m is not above {} m before it", two[1], two[0]);
        return Err(table.refuse("size_classes", Problem::rule(found, "rising radii between the classes")));
    }
    Ok(bounds)
}

/// Writes `size_classes`, if there are.
pub(super) fn write_size_classes(writer: &mut Writer, bounds: &[f64]) {
    if !bounds.is_empty() {
        writer.key("size_classes", list(bounds.iter().map(|radius| quantity(*radius, Dimension::LENGTH))));
    }
}
