//! Parts of space: what a stage takes away, what an observer looks at.

use super::axis::{Axis, AxisShape};
use super::domain::read_extent;
use super::resolved::bodies::write_extent;
use super::resolved::writer::{Writer, quantity, text, vector};
use crate::context::Reported;
use crate::list::Vector;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_boundary::Region;
use pulvis_math::{Dimension, Vector3};

/// The kinds of regions, by their names in a scenario.
const KINDS: [&str; 4] = ["box", "sphere", "cylinder", "layer"];

/// Reads a region out of the table at `key`, if it is there.
pub(super) fn read_region(table: &mut TableReader<'_>, key: &str) -> Result<Option<Region>, Reported> {
    let Some(mut table) = table.optional_table(key)? else { return Ok(None) };
    let region = match table.required("kind", Name(&KINDS))? {
        "box" => read_extent(&mut table).map(Region::Box),
        "sphere" => {
            let (centre, radius) = (position(&mut table, "centre"), radius(&mut table));
            centre.and_then(|centre| Ok(Region::Sphere { centre, radius: radius? }))
        }
        "cylinder" => read_cylinder(&mut table),
        _ => read_layer(&mut table),
    };
    table.finish();
    region.map(Some)
}

fn read_cylinder(table: &mut TableReader<'_>) -> Result<Region, Reported> {
    let (start, end) = (position(table, "start"), position(table, "end"));
    let radius = radius(table);
    let ends = [start?, end?];
    if ends[0] == ends[1] {
        let problem = Problem::rule("it is where `start` is", "the two ends of the axis");
        return Err(table.refuse("end", problem));
    }
    Ok(Region::Cylinder { ends, radius: radius? })
}

fn read_layer(table: &mut TableReader<'_>) -> Result<Region, Reported> {
    let axis = table.required("axis", AxisShape);
    let lower = table.required("lower", Dimension::LENGTH);
    let upper = table.required("upper", Dimension::LENGTH);
    let (axis, lower, upper) = (axis?, lower?, upper?);
    if lower >= upper {
        let found = format!("{upper} m is not above lower = {lower} m");
        return Err(table.refuse("upper", Problem::rule(found, "lower < upper")));
    }
    Ok(Region::Layer { axis: axis.index(), lower, upper })
}

fn position(table: &mut TableReader<'_>, key: &str) -> Result<Vector3, Reported> {
    table.required(key, Vector::of(Dimension::LENGTH)).map(Vector3::from)
}

fn radius(table: &mut TableReader<'_>) -> Result<f64, Reported> {
    table.required("radius", QuantityRule::of(Dimension::LENGTH).above(0.0))
}

/// Writes the keys of a region.
pub(super) fn write_region(writer: &mut Writer, region: &Region) {
    let length = |value: f64| quantity(value, Dimension::LENGTH);
    match *region {
        Region::Box(extent) => {
            writer.key("kind", text("box"));
            write_extent(writer, &extent);
        }
        Region::Sphere { centre, radius } => {
            writer.key("kind", text("sphere"));
            writer.key("centre", vector(centre, Dimension::LENGTH));
            writer.key("radius", length(radius));
        }
        Region::Cylinder { ends: [start, end], radius } => {
            writer.key("kind", text("cylinder"));
            writer.key("start", vector(start, Dimension::LENGTH));
            writer.key("end", vector(end, Dimension::LENGTH));
            writer.key("radius", length(radius));
        }
        Region::Layer { axis, lower, upper } => {
            writer.key("kind", text("layer"));
            let name = Axis::ALL.get(axis).map_or("x", |axis| axis.name());
            writer.key("axis", text(name));
            writer.key("lower", length(lower));
            writer.key("upper", length(upper));
        }
    }
}
