//! Which particles a stage takes away.

use super::domain::read_extent;
use crate::context::Reported;
use crate::list::Vector;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_boundary::Region;
use pulvis_math::Dimension;

/// Reads `[stages.remove]`.
pub(super) fn read_removal(stage: &mut TableReader<'_>) -> Result<Option<Region>, Reported> {
    let Some(mut table) = stage.optional_table("remove")? else { return Ok(None) };
    let region = match table.required("kind", Name(&["box", "sphere"]))? {
        "box" => read_extent(&mut table).map(Region::Box),
        _ => {
            let centre = table.required("centre", Vector::of(Dimension::LENGTH));
            let radius = table.required("radius", QuantityRule::of(Dimension::LENGTH).above(0.0));
            centre.and_then(|centre| Ok(Region::Sphere { centre: centre.into(), radius: radius? }))
        }
    };
    table.finish();
    region.map(Some)
}
