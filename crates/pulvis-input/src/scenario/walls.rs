//! Plane walls: the box, and further planes.

use super::axis::{Axis, BoxFace, Side};
use super::domain::read_extent;
use super::materials::{Material, read_material_name};
use crate::context::{Location, Reported};
use crate::list::{List, Vector};
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_boundary::{Cuboid, Domain};
use pulvis_math::{Dimension, Vector3};

/// A plane wall at the start of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Its name, which no other wall has.
    pub name: String,
    /// Index of its material.
    pub material: usize,
    /// A point of the plane [m].
    pub point: Vector3,
    /// Unit vector at right angles to the plane, towards the particles [1].
    pub normal: Vector3,
    /// The face of the box that this wall is, if it is one.
    pub face: Option<BoxFace>,
    /// Area on which a servo's pressure acts [m^2]. Of a face of the box it is always `None`: it follows
    /// from the distances of the other walls.
    pub area: Option<f64>,
}

impl Wall {
    /// Distance of a point from the plane, positive on the particles' side [m].
    pub fn distance(&self, point: Vector3) -> f64 {
        (point - self.point).dot(self.normal)
    }
}

/// The box and all walls.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Walls {
    pub(super) enclosure: Option<Cuboid>,
    pub(super) walls: Vec<Wall>,
}

/// Reads `[box]` and `[walls.NAME]`.
pub(super) fn read_walls(
    root: &mut TableReader<'_>,
    materials: &[Material],
    domain: Option<&Domain>,
) -> Result<Walls, Reported> {
    let enclosed = match root.optional_table("box") {
        Ok(Some(table)) => read_box(table, materials, domain).map(|(extent, walls)| (Some(extent), walls)),
        Ok(None) => Ok((None, Vec::new())),
        Err(reported) => Err(reported),
    };
    let tables = root.named_tables("walls")?;
    let places: Vec<Location> = tables.iter().map(|(_, table)| table.location("")).collect();
    let planes: Vec<_> =
        tables.into_iter().map(|(name, table)| read_wall(name, table, materials, domain)).collect();
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
        normal: face.normal(),
        face: Some(face),
        area: None,
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
) -> Result<Wall, Reported> {
    let named = if BoxFace::NAMES.contains(&name.as_str()) {
        let found = format!("{name} is the name of a face of the box");
        Err(table.refuse("", Problem::rule(found, "another name for this wall")))
    } else {
        Ok(())
    };
    let material = read_material_name(&mut table, "material", materials);
    let point = table.required("point", Vector::of(Dimension::LENGTH));
    let normal = table.required("normal", Vector::of(Dimension::NONE)).and_then(|normal| {
        let normal = Vector3::from(normal);
        // A vector that is of unit length already stays as it is, so that a resolved scenario reads back
        // to the same bits.
        let is_unit = (normal.norm_squared() - 1.0).abs() < 1e-14;
        let direction = if is_unit { Some(normal) } else { normal.unit() };
        direction.ok_or_else(|| {
            table.refuse("normal", Problem::rule("the vector has no direction", "a vector that is not zero"))
        })
    });
    let normal = normal.and_then(|normal| {
        let periodic = domain.map_or([false; 3], |domain| domain.periodic);
        match Axis::ALL.into_iter().find(|axis| periodic[axis.index()] && normal[axis.index()] != 0.0) {
            Some(axis) => {
                let found = format!("the wall cuts through {}, which is periodic", axis.name());
                Err(table.refuse("normal", Problem::rule(found, "a plane along every periodic direction")))
            }
            None => Ok(normal),
        }
    });
    let area = table.optional("area", QuantityRule::of(Dimension::new(0, 2, 0)).above(0.0));
    table.finish();
    named?;
    let (material, point, normal, area) = (material?, point?.into(), normal?, area?);
    Ok(Wall { name, material, point, normal, face: None, area })
}

/// Two walls that coincide, or face away from each other so that no space is left between them.
fn clash(plane: &Wall, wall: &Wall) -> Option<Problem> {
    // Directions that are written as equal differ by no more than rounding.
    let parallel = |sign: f64| (plane.normal - wall.normal * sign).norm() < 1e-12;
    let distance = wall.distance(plane.point);
    let names = format!("{} and {}", wall.name, plane.name);
    if parallel(1.0) && distance == 0.0 {
        return Some(Problem::rule(format!("{names} are the same plane"), "each wall once"));
    }
    if parallel(-1.0) && distance <= 0.0 {
        let found = format!("{names} overlap: they lie {} m behind each other", distance.abs());
        return Some(Problem::rule(found, "space between walls that face each other"));
    }
    None
}
