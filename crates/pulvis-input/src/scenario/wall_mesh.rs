//! Walls of triangles from a file.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::mesh_file::{MeshFileError, read_triangles};
use super::resolved::writer::{Writer, quantity, text, vector};
use super::wall_shape::{area, read_direction};
use crate::context::Reported;
use crate::list::Vector;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Text;
use pulvis_boundary::{Mesh, TriangleMesh};
use pulvis_math::{Dimension, Vector3, elementary};

/// Where the triangles of a mesh come from, and how they were placed: a point p of the file is at `translate` + R `scale` p.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSource {
    /// The absolute path of the file.
    pub file: PathBuf,
    /// Hash of its bytes.
    pub hash: String,
    /// Length of one unit of the file [m].
    pub scale: f64,
    /// Where the origin of the file is [m].
    pub translate: Vector3,
    /// The rotation R about the origin of the file: unit vector along its axis, and angle [rad].
    pub rotate: Option<(Vector3, f64)>,
}

/// A mesh, its reference point [m], the area for a servo [m^2], and where it comes from.
type Read = (Mesh, Vector3, Option<f64>, MeshSource);

/// Reads the keys of a mesh; its file is relative to `folder`.
pub(super) fn read_mesh(table: &mut TableReader<'_>, folder: &Path) -> Result<Read, Reported> {
    let file = table.required("file", Text);
    let hash = table.optional("file_hash", Text);
    let scale = table.required("scale", QuantityRule::of(Dimension::LENGTH).above(0.0));
    let translate = table.or("translate", Vector::of(Dimension::LENGTH), [0.0; 3]);
    let rotate = read_rotation(table);
    let point = table.or("point", Vector::of(Dimension::LENGTH), [0.0; 3]);
    let axis = match table.value("axis") {
        Some(_) => read_direction(table, "axis"),
        None => Ok(Vector3::new(0.0, 0.0, 1.0)),
    };
    let area = table.optional("area", area());
    let (file, hash, scale, rotate) = (file?, hash?, scale?, rotate?);
    let (translate, point) = (Vector3::from(translate?), Vector3::from(point?));
    let (axis, area) = (axis?, area?);
    let path = folder.join(file);
    let file = std::path::absolute(&path).unwrap_or(path);
    let read = read_triangles(&file).and_then(|triangles| match hash {
        Some(expected) if expected != triangles.hash => {
            let (file, found) = (file.display().to_string(), triangles.hash);
            Err(MeshFileError::Changed { file, found, expected })
        }
        _ => Ok(triangles),
    });
    let source = |hash: String| MeshSource { file: file.clone(), hash, scale, translate, rotate };
    let surface = read.and_then(|triangles| {
        let source = source(triangles.hash);
        let placed = |corner: Vector3| source.place(corner) - point;
        let corners: Vec<[Vector3; 3]> =
            triangles.corners.into_iter().map(|corners| corners.map(placed)).collect();
        let surface = TriangleMesh::new(&corners).map_err(|reason| {
            let file = file.display().to_string();
            MeshFileError::Surface { file, reason }
        })?;
        Ok((surface, source))
    });
    match surface {
        Ok((surface, source)) => Ok((Mesh::new(Arc::new(surface), axis), point, area, source)),
        Err(error) => {
            let help = match error {
                MeshFileError::Missing { .. } | MeshFileError::Unreadable { .. } => {
                    "the path is relative to the folder of the scenario"
                }
                MeshFileError::Changed { .. } => "bring back the file, or start a new run",
                MeshFileError::Surface { .. } => "repair the mesh in the program that made it",
                _ => "export the mesh again as STL or OBJ",
            };
            Err(table.refuse_with_help("file", Problem::Refused(Box::new(error)), help))
        }
    }
}

/// Reads `rotate = { axis = [0, 0, 1], angle = "90 deg" }`.
fn read_rotation(table: &mut TableReader<'_>) -> Result<Option<(Vector3, f64)>, Reported> {
    let Some(mut table) = table.optional_table("rotate")? else { return Ok(None) };
    let axis = read_direction(&mut table, "axis");
    let angle = table.required("angle", QuantityRule::of(Dimension::NONE));
    table.finish();
    Ok(Some((axis?, angle?)))
}

impl MeshSource {
    /// Where a point of the file is [m].
    fn place(&self, point: Vector3) -> Vector3 {
        let point = point * self.scale;
        let Some((axis, angle)) = self.rotate else { return self.translate + point };
        // Rodrigues' rotation.
        let (sine, cosine) = elementary::sin_cos(angle);
        let along = axis * point.dot(axis);
        self.translate + along + (point - along) * cosine + axis.cross(point) * sine
    }

    /// Writes the keys of the mesh that are not those of other walls.
    pub(super) fn write(&self, writer: &mut Writer) {
        let Self { file, hash, scale, translate, rotate } = self;
        writer.key("file", text(&file.to_string_lossy()));
        writer.key("file_hash", text(hash));
        writer.key("scale", quantity(*scale, Dimension::LENGTH));
        writer.key("translate", vector(*translate, Dimension::LENGTH));
        if let Some((axis, angle)) = rotate {
            let (axis, angle) = (vector(*axis, Dimension::NONE), quantity(*angle, Dimension::NONE));
            writer.key("rotate", format!("{{ axis = {axis}, angle = {angle} }}"));
        }
    }
}
