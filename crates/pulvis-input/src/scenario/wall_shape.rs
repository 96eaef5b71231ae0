//! Shapes of walls.

use std::path::Path;

use super::axis::Axis;
use super::wall_mesh::{MeshSource, read_mesh};
use crate::context::Reported;
use crate::list::{List, Vector};
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Choice;
use pulvis_boundary::{Cone, Cylinder, CylinderSide, Disk, Domain, Plane, PlaneWithHole, Tube, WallShape};
use pulvis_math::{Dimension, Vector3};

const SIDES: [(&str, CylinderSide); 2] = [
    (CylinderSide::Inside.name(), CylinderSide::Inside),
    (CylinderSide::Outside.name(), CylinderSide::Outside),
];

/// A shape as a wall has it.
pub(super) struct Placed {
    pub(super) shape: WallShape,
    /// The wall's reference point [m].
    pub(super) point: Vector3,
    /// The area for a servo [m^2].
    pub(super) area: Option<f64>,
    /// Where the triangles of a mesh come from.
    pub(super) mesh: Option<MeshSource>,
}

impl Placed {
    fn new(shape: impl Into<WallShape>, point: [f64; 3], area: Option<f64>) -> Self {
        Self { shape: shape.into(), point: point.into(), area, mesh: None }
    }
}

/// Reads `kind` and the keys that go with it; files are relative to `folder`.
pub(super) fn read_shape(
    table: &mut TableReader<'_>,
    domain: Option<&Domain>,
    folder: &Path,
) -> Result<Placed, Reported> {
    let periodic = domain.map_or([false; 3], |domain| domain.periodic);
    let edged = match table.selector_or("kind", WallShape::NAMES, "plane") {
        Ok("plane") => return refuse_without_kind(table).and_then(|()| read_plane(table, periodic)),
        Ok("cylinder") => return read_cylinder(table, periodic),
        Ok("cone") => read_cone(table),
        Ok("tube") => read_tube(table),
        Ok("disk") => read_disk(table),
        Ok("plane-with-hole") => read_plane_with_hole(table),
        Ok(_) => read_mesh(table, folder).map(|(shape, point, area, mesh)| Placed {
            mesh: Some(mesh),
            ..Placed::new(shape, point.to_array(), area)
        }),
        Err(reported) => {
            leave_the_rest(table);
            Err(reported)
        }
    };
    let placed = edged?;
    let Some(axis) = Axis::ALL.into_iter().find(|axis| periodic[axis.index()]) else { return Ok(placed) };
    // A particle beyond the boundary would have to meet the image of the wall.
    let found = format!("a {} has edges, and {} is periodic", placed.shape.name(), axis.name());
    let expected = "a plane or a cylinder along it, or no periodic direction";
    Err(table.refuse("kind", Problem::rule(found, expected)))
}

/// Which keys are unknown depends on the kind.
fn leave_the_rest(table: &mut TableReader<'_>) {
    let keys = ["kind", "point", "normal", "area", "axis", "radius", "side", "radii", "height", "length"];
    let of_mesh = ["file", "file_hash", "scale", "translate", "rotate"];
    for key in keys.into_iter().chain(of_mesh) {
        table.value(key);
    }
}

/// Keys by which a wall without `kind` is known, and its kind.
const TELLING: [(&str, &str); 6] = [
    ("file", "mesh"),
    ("radii", "cone"),
    ("length", "tube"),
    ("axis", "cylinder"),
    ("radius", "cylinder"),
    ("side", "cylinder"),
];

/// A wall is a plane unless it says otherwise: who describes a cylinder and forgets `kind` is told that, not that its keys
/// are unknown.
fn refuse_without_kind(table: &mut TableReader<'_>) -> Result<(), Reported> {
    let keys = table.keys();
    let telling = TELLING.into_iter().find(|(key, _)| keys.contains(key));
    let Some((key, kind)) = telling.filter(|_| !keys.contains(&"kind") && !keys.contains(&"normal")) else {
        return Ok(());
    };
    leave_the_rest(table);
    let found = format!("the wall has the key `{key}` of a {kind}, and no `kind`");
    let help = "without `kind` a wall is a plane";
    Err(table.refuse_with_help("", Problem::rule(found, format!("`kind = \"{kind}\"`")), help))
}

/// A length that is greater than zero.
fn length() -> QuantityRule {
    QuantityRule::of(Dimension::LENGTH).above(0.0)
}

/// An area that is greater than zero.
pub(super) fn area() -> QuantityRule {
    QuantityRule::of(Dimension::new(0, 2, 0)).above(0.0)
}

fn read_cone(table: &mut TableReader<'_>) -> Result<Placed, Reported> {
    let point = table.required("point", Vector::of(Dimension::LENGTH));
    let axis = read_direction(table, "axis");
    let radii = List::of(QuantityRule::of(Dimension::LENGTH).at_least(0.0)).exactly(2);
    let radii = table.required("radii", radii).and_then(|radii| match radii[..] {
        [first, second] if first + second > 0.0 => Ok([first, second]),
        _ => {
            let problem = Problem::rule("both radii are zero", "one that is greater than zero");
            Err(table.refuse("radii", problem))
        }
    });
    let height = table.required("height", length());
    let (point, axis, radii, height) = (point?, axis?, radii?, height?);
    Ok(Placed::new(Cone { axis, radii, height }, point, None))
}

fn read_tube(table: &mut TableReader<'_>) -> Result<Placed, Reported> {
    let point = table.required("point", Vector::of(Dimension::LENGTH));
    let axis = read_direction(table, "axis");
    let radius = table.required("radius", length());
    let long = table.required("length", length());
    let (point, axis, radius, length) = (point?, axis?, radius?, long?);
    Ok(Placed::new(Tube { axis, radius, length }, point, None))
}

fn read_disk(table: &mut TableReader<'_>) -> Result<Placed, Reported> {
    let (point, normal, radius, area) = read_round(table)?;
    // The whole disk, unless the pressure acts on a part of it.
    let area = area.unwrap_or(std::f64::consts::PI * radius * radius);
    Ok(Placed::new(Disk { normal, radius }, point, Some(area)))
}

fn read_plane_with_hole(table: &mut TableReader<'_>) -> Result<Placed, Reported> {
    let (point, normal, radius, area) = read_round(table)?;
    Ok(Placed::new(PlaneWithHole { normal, radius }, point, area))
}

/// Reads the keys of a disk and of a plane with a hole.
fn read_round(table: &mut TableReader<'_>) -> Result<([f64; 3], Vector3, f64, Option<f64>), Reported> {
    let point = table.required("point", Vector::of(Dimension::LENGTH));
    let normal = read_direction(table, "normal");
    let radius = table.required("radius", length());
    let area = table.optional("area", area());
    Ok((point?, normal?, radius?, area?))
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
    let area = table.optional("area", area());
    let (point, normal, area) = (point?, normal?, area?);
    Ok(Placed::new(Plane { normal }, point, area))
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
    let radius = table.required("radius", length());
    let side = table.required("side", Choice(&SIDES));
    let (point, axis, radius, side) = (point?, axis?, radius?, side?);
    Ok(Placed::new(Cylinder { axis, radius, side }, point, None))
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
