//! Shapes of walls: planes and cylinders.

use super::axis::Axis;
use crate::context::Reported;
use crate::list::Vector;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Choice;
use pulvis_boundary::{Cylinder, CylinderSide, Domain, Plane, WallShape};
use pulvis_math::{Dimension, Vector3};

const SIDES: [(&str, CylinderSide); 2] = [
    (CylinderSide::Inside.name(), CylinderSide::Inside),
    (CylinderSide::Outside.name(), CylinderSide::Outside),
];

/// A shape, the wall's point [m], and the area for a servo [m^2].
type Placed = (WallShape, Vector3, Option<f64>);

/// Reads `kind` and the keys that go with it.
pub(super) fn read_shape(table: &mut TableReader<'_>, domain: Option<&Domain>) -> Result<Placed, Reported> {
    let periodic = domain.map_or([false; 3], |domain| domain.periodic);
    match table.selector_or("kind", WallShape::NAMES, "plane") {
        Ok("cylinder") => read_cylinder(table, periodic),
        Ok(_) => refuse_unnamed_cylinder(table).and_then(|()| read_plane(table, periodic)),
        Err(reported) => {
            leave_the_rest(table);
            Err(reported)
        }
    }
}

/// Which keys are unknown depends on the kind.
fn leave_the_rest(table: &mut TableReader<'_>) {
    for key in ["kind", "point", "normal", "area", "axis", "radius", "side"] {
        table.value(key);
    }
}

/// A wall is a plane unless it says otherwise: who describes a cylinder and forgets `kind` is told that, not that its keys
/// are unknown.
fn refuse_unnamed_cylinder(table: &mut TableReader<'_>) -> Result<(), Reported> {
    let keys = table.keys();
    let of_cylinder = ["axis", "radius", "side"].into_iter().find(|key| keys.contains(key));
    let Some(key) = of_cylinder.filter(|_| !keys.contains(&"kind") && !keys.contains(&"normal")) else {
        return Ok(());
    };
    leave_the_rest(table);
    let found = format!("the wall has the key `{key}` of a cylinder, and no `kind`");
    let help = "without `kind` a wall is a plane";
    Err(table.refuse_with_help("", Problem::rule(found, "`kind = \"cylinder\"`"), help))
}

fn read_plane(table: &mut TableReader<'_>, periodic: [bool; 3]) -> Result<Placed, Reported> {
    let point = table.required("point", Vector::of(Dimension::LENGTH));
    let normal = read_direction(table, "normal").and_then(|normal| {
        match Axis::ALL.into_iter().find(|axis| periodic[axis.index()] && normal[axis.index()] != 0.0) {
            Some(axis) => {
                let found = format!("the wall cuts through {}, which is periodic", axis.name());
                Err(table.refuse("normal", Problem::rule(found, "a plane along every periodic direction")))
            }
            None => Ok(normal),
        }
    });
    let area = table.optional("area", QuantityRule::of(Dimension::new(0, 2, 0)).above(0.0));
    let (point, normal, area) = (point?, normal?, area?);
    Ok((Plane { normal }.into(), point.into(), area))
}

fn read_cylinder(table: &mut TableReader<'_>, periodic: [bool; 3]) -> Result<Placed, Reported> {
    let point = table.required("point", Vector::of(Dimension::LENGTH));
    let axis = read_direction(table, "axis").and_then(|direction| {
        let across = |axis: &Axis| direction.tangential_to(axis.unit()) != Vector3::zero();
        match Axis::ALL.into_iter().filter(|axis| periodic[axis.index()]).find(across) {
            Some(axis) => {
                let name = axis.name();
                let found = format!("the wall cuts through {name}, which is periodic");
                Err(table.refuse("axis", Problem::rule(found, format!("an axis along {name}"))))
            }
            None => Ok(direction),
        }
    });
    let radius = table.required("radius", QuantityRule::of(Dimension::LENGTH).above(0.0));
    let side = table.required("side", Choice(&SIDES));
    let (point, axis, radius, side) = (point?, axis?, radius?, side?);
    Ok((Cylinder { axis, radius, side }.into(), point.into(), None))
}

/// Reads a vector of which only the direction counts.
pub(super) fn read_direction(table: &mut TableReader<'_>, key: &str) -> Result<Vector3, Reported> {
    let vector = Vector3::from(table.required(key, Vector::of(Dimension::NONE))?);
    // A vector that is of unit length already stays as it is, so that a resolved scenario reads back to
    // the same bits.
    let is_unit = (vector.norm_squared() - 1.0).abs() < 1e-14;
    let direction = if is_unit { Some(vector) } else { vector.unit() };
    direction.ok_or_else(|| {
        table.refuse(key, Problem::rule("the vector has no direction", "a vector that is not zero"))
    })
}
