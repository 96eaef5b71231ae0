//! The space of a run: periodic directions, gravity, background.

use super::axis::{Axis, AxisShape};
use crate::context::Reported;
use crate::list::{List, Vector};
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_boundary::{Background, Cuboid, Domain};
use pulvis_math::{Dimension, Vector3};

/// Reads `lower` and `upper` of a block.
pub(super) fn read_extent(table: &mut TableReader<'_>) -> Result<Cuboid, Reported> {
    let lower = table.required("lower", Vector::of(Dimension::LENGTH));
    let upper = table.required("upper", Vector::of(Dimension::LENGTH));
    let extent = Cuboid { lower: lower?.into(), upper: upper?.into() };
    for axis in Axis::ALL {
        let (lower, upper) = (extent.lower[axis.index()], extent.upper[axis.index()]);
        if lower >= upper {
            let found = format!("{} = {upper} m is not above lower = {lower} m", axis.name());
            return Err(table.refuse("upper", Problem::rule(found, "lower < upper in every direction")));
        }
    }
    Ok(extent)
}

/// Reads `[domain]`.
pub(super) fn read_domain(root: &mut TableReader<'_>) -> Result<Option<Domain>, Reported> {
    let Some(mut table) = root.optional_table("domain")? else { return Ok(None) };
    let extent = read_extent(&mut table);
    let axes = table.required("periodic", List::of(AxisShape).at_least(1).at_most(3));
    let periodic = axes.and_then(|axes| {
        let mut periodic = [false; 3];
        for axis in axes {
            if std::mem::replace(&mut periodic[axis.index()], true) {
                let found = format!("{} stands here twice", axis.name());
                return Err(table.refuse("periodic", Problem::rule(found, "each direction once")));
            }
        }
        Ok(periodic)
    });
    table.finish();
    let Cuboid { lower, upper } = extent?;
    Ok(Some(Domain::periodic(lower, upper, periodic?)))
}

/// Reads `gravity` and `[background]`.
pub(super) fn read_background(root: &mut TableReader<'_>) -> Result<Background, Reported> {
    let gravity = root.or("gravity", Vector::of(Dimension::ACCELERATION), [0.0; 3]).map(Vector3::from);
    let Some(mut table) = root.optional_table("background")? else {
        return Ok(Background { gravity: gravity?, ..Background::default() });
    };
    let rule = QuantityRule::of(Dimension::DASHPOT).at_least(0.0);
    let drag = table.or("drag", rule, 0.0);
    let rotational_drag = table.or("rotational_drag", rule, 0.0);
    table.finish();
    Ok(Background { gravity: gravity?, drag: drag?, rotational_drag: rotational_drag? })
}
