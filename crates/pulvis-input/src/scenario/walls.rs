//! Walls: the box, and further ones of any shape.

use super::axis::{Axis, BoxFace, Side};
use super::domain::read_extent;
use super::materials::{Material, read_material_name};
use super::wall_mesh::MeshSource;
use super::wall_shape::{Placed, read_shape};
use crate::context::{Location, Reported};
use crate::list::List;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_boundary::{Cuboid, Cylinder, CylinderSide, Domain, Plane, WallShape};
use pulvis_math::Vector3;
use std::path::Path;

/// A wall at the start of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Its name, which no other wall has.
    pub name: String,
    /// Index of its material.
    pub material: usize,
    /// Its reference point [m].
    pub point: Vector3,
    /// What its surface looks like.
    pub shape: WallShape,
    /// The face of the box that this wall is, if it is one.
    pub face: Option<BoxFace>,
    /// Area on which a servo's pressure acts [m^2]. Of a face of the box it is always `None`: it follows
    /// from the distances of the other walls.
    pub area: Option<f64>,
    /// Where the triangles of a mesh come from.
    pub mesh: Option<MeshSource>,
}

impl Wall {
    /// Distance of a point from the surface, positive on the particles' side [m].
    pub fn distance(&self, point: Vector3) -> f64 {
        match self.shape.edgeless() {
            Some(shape) => shape.surface(self.point, point).distance,
            None => self.shape.distance(point - self.point),
        }
    }

    /// On which side of it particles have to be, in words.
    pub fn where_particles_are(&self) -> String {
        match &self.shape {
            WallShape::Plane(_) => "particles on the side to which the wall's normal points".to_owned(),
            WallShape::Cylinder(cylinder) => format!("particles {} the cylinder", cylinder.side.name()),
            _ => "particles on one side of the wall or the other".to_owned(),
        }
    }
}

/// The box and all walls.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Walls {
    pub(super) enclosure: Option<Cuboid>,
    pub(super) walls: Vec<Wall>,
}

/// Reads `[box]` and `[walls.NAME]`; files of meshes are relative to `folder`.
pub(super) fn read_walls(
    root: &mut TableReader<'_>,
    materials: &[Material],
    domain: Option<&Domain>,
    folder: &Path,
) -> Result<Walls, Reported> {
    let enclosed = match root.optional_table("box") {
        Ok(Some(table)) => read_box(table, materials, domain).map(|(extent, walls)| (Some(extent), walls)),
        Ok(None) => Ok((None, Vec::new())),
        Err(reported) => Err(reported),
    };
    let tables = root.named_tables("walls")?;
    let places: Vec<Location> = tables.iter().map(|(_, table)| table.location("")).collect();
    let planes: Vec<_> =
        tables.into_iter().map(|(name, table)| read_wall(name, table, materials, domain, folder)).collect();
    let (enclosure, mut walls) = enclosed?;
    for (plane, place) in planes.into_iter().zip(places) {
        let plane = plane?;
        if let Some(problem) = walls.iter().find_map(|wall| clash(&plane, wall)) {
            return Err(root.refuse_at(&place, problem));
        }
        walls.push(plane);
    }
    Ok(Walls { enclosure, walls })
}

/// Reads `[box]`: its extent and the walls at its faces.
fn read_box(
    mut table: TableReader<'_>,
    materials: &[Material],
    domain: Option<&Domain>,
) -> Result<(Cuboid, Vec<Wall>), Reported> {
    let periodic = domain.map_or([false; 3], |domain| domain.periodic);
    let extent = read_extent(&mut table).and_then(|extent| fits_domain(&table, extent, domain));
    let material = read_material_name(&mut table, "material", materials);
    let open = table.or("open", List::of(Name(&BoxFace::NAMES)), Vec::new());
    let special = read_face_materials(&mut table, materials);
    let faces: Vec<BoxFace> = BoxFace::ALL.into_iter().filter(|face| !periodic[face.axis.index()]).collect();
    let walled = |name: &str| faces.iter().any(|face| face.name() == name);
    if let Ok(open) = &open {
        for name in open.iter().filter(|name| !walled(name)) {
            table.refuse("open", periodic_face(name));
        }
    }
    let special = special.and_then(|special| {
        match special
            .iter()
            .find(|(name, _)| !walled(name) || matches!(&open, Ok(open) if open.contains(name)))
        {
            Some((name, _)) if walled(name) => {
                let found = format!("{name} is open and has a material");
                Err(table.refuse("materials", Problem::rule(found, "materials of faces that are walls")))
            }
            Some((name, _)) => Err(table.refuse("materials", periodic_face(name))),
            None => Ok(special),
        }
    });
    table.finish();
    let (extent, material, open, special) = (extent?, material?, open?, special?);
    let closed = faces.into_iter().filter(|face| !open.contains(&face.name()));
    let walls = closed.map(|face| Wall {
        name: face.name().to_owned(),
        material: special.iter().find(|(name, _)| *name == face.name()).map_or(material, |(_, own)| *own),
        point: match face.side {
            Side::Low => extent.lower,
            Side::High => extent.upper,
        },
        shape: Plane { normal: face.normal() }.into(),
        face: Some(face),
        area: None,
        mesh: None,
    });
    Ok((extent, walls.collect()))
}

/// Along a periodic direction the box has no walls; its bounds there are those of the domain.
fn fits_domain(table: &TableReader<'_>, extent: Cuboid, domain: Option<&Domain>) -> Result<Cuboid, Reported> {
    let Some(domain) = domain else { return Ok(extent) };
    for axis in Axis::ALL.into_iter().filter(|axis| domain.periodic[axis.index()]) {
        let along = |extent: &Cuboid| (extent.lower[axis.index()], extent.upper[axis.index()]);
        let ((lower, upper), (first, last)) = (along(&extent), along(&domain.extent));
        if (lower, upper) != (first, last) {
            let name = axis.name();
            let found = format!("the box reaches from {name} = {lower} m to {upper} m");
            let expected =
                format!("the bounds of the domain, {first} m and {last} m, because {name} is periodic");
            return Err(table.refuse("upper", Problem::rule(found, expected)));
        }
    }
    if domain.periodic == [true; 3] {
        let expected = "a direction that is not periodic, or no [box]";
        return Err(table.refuse("", Problem::rule("the box has no walls", expected)));
    }
    Ok(extent)
}

fn periodic_face(name: &str) -> Problem {
    let axis = name.split('-').next().unwrap_or_default();
    Problem::rule(format!("there is no wall {name}"), format!("faces of the box; {axis} is periodic"))
}

/// Reads `[box.materials]`: faces and the indices of their materials.
fn read_face_materials(
    table: &mut TableReader<'_>,
    materials: &[Material],
) -> Result<Vec<(&'static str, usize)>, Reported> {
    let Some(mut table) = table.optional_table("materials")? else { return Ok(Vec::new()) };
    let mut special = Vec::new();
    let mut failure = None;
    for name in BoxFace::NAMES {
        // Ask for every face, so that a misspelled one is told from the known ones.
        if table.value(name).is_some() {
            match read_material_name(&mut table, name, materials) {
                Ok(material) => special.push((name, material)),
                Err(reported) => failure = Some(reported),
            }
        }
    }
    table.finish();
    failure.map_or(Ok(special), Err)
}

/// Reads `[walls.NAME]`.
fn read_wall(
    name: String,
    mut table: TableReader<'_>,
    materials: &[Material],
    domain: Option<&Domain>,
    folder: &Path,
) -> Result<Wall, Reported> {
    let named = if BoxFace::NAMES.contains(&name.as_str()) {
        let found = format!("{name} is the name of a face of the box");
        Err(table.refuse("", Problem::rule(found, "another name for this wall")))
    } else {
        Ok(())
    };
    let material = read_material_name(&mut table, "material", materials);
    let placed = read_shape(&mut table, domain, folder);
    table.finish();
    named?;
    let (material, Placed { shape, point, area, mesh }) = (material?, placed?);
    Ok(Wall { name, material, point, shape, face: None, area, mesh })
}

/// Two walls that coincide, or face away from each other so that no space is left between them.
fn clash(one: &Wall, other: &Wall) -> Option<Problem> {
    match (&one.shape, &other.shape) {
        (WallShape::Plane(plane), WallShape::Plane(plane_other)) => {
            clash_of_planes((one, plane.normal), (other, plane_other.normal))
        }
        (WallShape::Cylinder(cylinder), WallShape::Cylinder(cylinder_other)) => {
            clash_of_cylinders((one, cylinder), (other, cylinder_other))
        }
        _ => None,
    }
}

/// Directions that are written as equal differ by no more than rounding.
fn are_equal(one: Vector3, other: Vector3) -> bool {
    (one - other).norm() < 1e-12
}

fn clash_of_planes((plane, normal): (&Wall, Vector3), (wall, other): (&Wall, Vector3)) -> Option<Problem> {
    let distance = wall.distance(plane.point);
    let names = format!("{} and {}", wall.name, plane.name);
    if are_equal(normal, other) && distance == 0.0 {
        return Some(Problem::rule(format!("{names} are the same plane"), "each wall once"));
    }
    if are_equal(normal, -other) && distance <= 0.0 {
        let found = format!("{names} overlap: they lie {} m behind each other", distance.abs());
        return Some(Problem::rule(found, "space between walls that face each other"));
    }
    None
}

/// Of cylinders with the same axis.
fn clash_of_cylinders(
    (wall, cylinder): (&Wall, &Cylinder),
    (wall_other, other): (&Wall, &Cylinder),
) -> Option<Problem> {
    let parallel = are_equal(cylinder.axis, other.axis) || are_equal(cylinder.axis, -other.axis);
    let apart = (wall.point - wall_other.point).tangential_to(other.axis).norm();
    if !parallel || apart > 1e-12 * cylinder.radius {
        return None;
    }
    let names = format!("{} and {}", wall_other.name, wall.name);
    if cylinder.side == other.side {
        let same = cylinder.radius == other.radius;
        return same.then(|| Problem::rule(format!("{names} are the same cylinder"), "each wall once"));
    }
    let [inside, outside] =
        if cylinder.side == CylinderSide::Inside { [cylinder, other] } else { [other, cylinder] };
    let gap = inside.radius - outside.radius;
    (gap <= 0.0).then(|| {
        let found = format!("{names} overlap: they lie {} m behind each other", -gap);
        Problem::rule(found, "space between walls that face each other")
    })
}
