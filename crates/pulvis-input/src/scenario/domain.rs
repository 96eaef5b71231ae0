//! The space of a run: periodic directions, gravity, background.

use super::axis::{Axis, AxisShape};
use crate::context::Reported;
use crate::list::{List, Vector};
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_math::{Dimension, Vector3};

/// A block of space with faces along the axes; upper is above lower in every direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Lower corner [m].
    pub lower: Vector3,
    /// Upper corner [m].
    pub upper: Vector3,
}

impl Extent {
    /// The lengths of the edges [m].
    pub fn size(&self) -> Vector3 {
        self.upper - self.lower
    }

    /// Volume [m^3].
    pub fn volume(&self) -> f64 {
        let size = self.size();
        size.x * size.y * size.z
    }

    /// The eight corners [m].
    pub fn corners(&self) -> [Vector3; 8] {
        std::array::from_fn(|number| {
            let at = |bit: usize, axis: usize| {
                if number & bit == 0 { self.lower[axis] } else { self.upper[axis] }
            };
            Vector3::new(at(1, 0), at(2, 1), at(4, 2))
        })
    }
}

/// Periodic directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// The block that repeats; along directions that are not periodic it means nothing.
    pub extent: Extent,
    /// Whether x, y, z repeat; at least one of them does.
    pub periodic: [bool; 3],
}

/// A medium at rest that slows the particles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background {
    /// Coefficient c of the force −c v [kg/s].
    pub drag: f64,
    /// Coefficient c of the torque −c a² ω [kg/s].
    pub rotational_drag: f64,
}

/// Reads `lower` and `upper` of a block.
pub(super) fn read_extent(table: &mut TableReader<'_>) -> Result<Extent, Reported> {
    let lower = table.required("lower", Vector::of(Dimension::LENGTH));
    let upper = table.required("upper", Vector::of(Dimension::LENGTH));
    let extent = Extent { lower: lower?.into(), upper: upper?.into() };
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
    Ok(Some(Domain { extent: extent?, periodic: periodic? }))
}

/// Reads `gravity`.
pub(super) fn read_gravity(root: &mut TableReader<'_>) -> Result<Vector3, Reported> {
    Ok(root.or("gravity", Vector::of(Dimension::ACCELERATION), [0.0; 3])?.into())
}

/// Reads `[background]`.
pub(super) fn read_background(root: &mut TableReader<'_>) -> Result<Background, Reported> {
    let Some(mut table) = root.optional_table("background")? else { return Ok(Background::default()) };
    let rule = QuantityRule::of(Dimension::DASHPOT).at_least(0.0);
    let drag = table.or("drag", rule, 0.0);
    let rotational_drag = table.or("rotational_drag", rule, 0.0);
    table.finish();
    Ok(Background { drag: drag?, rotational_drag: rotational_drag? })
}
