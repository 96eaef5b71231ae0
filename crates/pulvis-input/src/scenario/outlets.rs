//! Outlets: where particles are taken away while a run goes on.

use super::axis::Axis;
use super::openings::{
    Schedule, read_name, read_schedule, read_size_classes, write_schedule, write_size_classes,
};
use super::region::{read_region, write_region};
use super::resolved::writer::{Writer, text, vector};
use super::wall_shape::read_direction;
use crate::context::{Location, Reported};
use crate::list::Vector;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Integer;
use pulvis_boundary::{Domain, Region};
use pulvis_math::{Dimension, Vector3};

/// A part of space from which particles are taken away.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlet {
    /// Its name, which no other inlet, outlet or observer has: letters, digits and underscores.
    pub name: String,
    /// The particles whose centres lie here leave.
    pub zone: OutletZone,
    /// Steps from one look to the next.
    pub steps: u64,
    /// When it is open.
    pub schedule: Schedule,
    /// Radii between classes of size that are counted apart [m], rising.
    pub size_classes: Vec<f64>,
}

/// Where an outlet is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutletZone {
    /// In a region.
    Region(Region),
    /// Everywhere beyond a plane.
    Beyond {
        /// A point of the plane [m].
        point: Vector3,
        /// Unit vector that points away from the particles that stay.
        normal: Vector3,
    },
}

impl OutletZone {
    /// Whether a position [m] lies in it; one that is NaN lies nowhere.
    pub fn contains(&self, position: Vector3, domain: &Domain) -> bool {
        match self {
            Self::Region(region) => region.contains(position, domain),
            Self::Beyond { point, normal } => (position - *point).dot(*normal) > 0.0,
        }
    }
}

/// Steps between two looks where nothing is said: particles move a small part of their radius meanwhile.
const DEFAULT_STEPS: u64 = 50;

/// Reads `[[outlets]]`, with the places of their `stages`.
pub(super) fn read_outlets(
    root: &mut TableReader<'_>,
    domain: Option<&Domain>,
    names: &mut Vec<String>,
) -> Result<Vec<(Outlet, Location)>, Reported> {
    let outlets: Vec<_> =
        root.tables("outlets")?.into_iter().map(|table| read_outlet(table, domain, names)).collect();
    outlets.into_iter().collect()
}

fn read_outlet(
    mut table: TableReader<'_>,
    domain: Option<&Domain>,
    names: &mut Vec<String>,
) -> Result<(Outlet, Location), Reported> {
    let name = read_name(&mut table, names);
    let region = read_region(&mut table, "region");
    let beyond = read_beyond(&mut table, domain);
    let zone = match (region, beyond) {
        (Ok(Some(_)), Ok(Some(_))) => {
            Err(table.refuse("beyond", Problem::rule("given beside `region`", "only one of them")))
        }
        (Ok(Some(region)), Ok(None)) => Ok(OutletZone::Region(region)),
        (Ok(None), Ok(Some(beyond))) => Ok(beyond),
        (Ok(None), Ok(None)) => {
            let expected = "where particles leave: `region`, or `beyond` a plane".to_owned();
            Err(table.refuse("region", Problem::MissingKey { key: "region".to_owned(), expected }))
        }
        (Err(reported), _) | (_, Err(reported)) => Err(reported),
    };
    let steps = table.optional("steps", Integer::between(1, 1_000_000_000));
    let schedule = read_schedule(&mut table);
    let size_classes = read_size_classes(&mut table);
    table.finish();
    let (schedule, place) = schedule?;
    let outlet = Outlet {
        name: name?,
        zone: zone?,
        steps: steps?.map_or(DEFAULT_STEPS, i64::unsigned_abs),
        schedule,
        size_classes: size_classes?,
    };
    Ok((outlet, place))
}

fn read_beyond(
    outlet: &mut TableReader<'_>,
    domain: Option<&Domain>,
) -> Result<Option<OutletZone>, Reported> {
    let Some(mut table) = outlet.optional_table("beyond")? else { return Ok(None) };
    let point = table.required("point", Vector::of(Dimension::LENGTH)).map(Vector3::from);
    let normal = read_direction(&mut table, "normal").and_then(|normal| {
        let repeats = |axis: &Axis| {
            normal[axis.index()] != 0.0 && domain.is_some_and(|domain| domain.periodic[axis.index()])
        };
        match Axis::ALL.iter().find(|axis| repeats(axis)) {
            Some(axis) => {
                let found =
                    format!("it points along {}, where space repeats: nothing is beyond", axis.name());
                let expected = "a plane across directions that do not repeat";
                Err(table.refuse("normal", Problem::rule(found, expected)))
            }
            None => Ok(normal),
        }
    });
    table.finish();
    Ok(Some(OutletZone::Beyond { point: point?, normal: normal? }))
}

/// Writes `[[outlets]]`.
pub(super) fn write_outlets(writer: &mut Writer, outlets: &[Outlet]) {
    for outlet in outlets {
        let Outlet { name, zone, steps, schedule, size_classes } = outlet;
        writer.item("outlets");
        writer.key("name", text(name));
        writer.key("steps", steps.to_string());
        write_schedule(writer, schedule);
        write_size_classes(writer, size_classes);
        match zone {
            OutletZone::Region(region) => {
                writer.table("outlets.region");
                write_region(writer, region);
            }
            OutletZone::Beyond { point, normal } => {
                writer.table("outlets.beyond");
                writer.key("point", vector(*point, Dimension::LENGTH));
                writer.key("normal", vector(*normal, Dimension::NONE));
            }
        }
    }
}
