//! Surfaces of triangles.
//!
//! A sphere must not feel how a surface is cut into triangles. Triangles that share edges and lie in a plane are one
//! *flat*, and edges between the same two flats that lie on a line are one *line*. Flats, lines and the *corners* where
//! lines end are the features of the surface. A sphere touches a feature where its distance from the whole surface has a
//! minimum. That is the case
//! - in a flat, if the centre lies straight above it;
//! - on a line, if the centre lies straight above it and beyond the edges of all flats that meet there;
//! - in a corner, if the centre lies behind the ends of all edges that begin there.
//!
//! Each rule asks on which side of a plane the centre is. Neighbouring features ask the same planes for opposite answers,
//! with the same arithmetic, so that a contact on an edge counts exactly once.
//!
//! # Source
//! The rules are those of the Voronoi regions of a polyhedron: M. C. Lin, J. F. Canny, Proc. IEEE Int. Conf. Robotics and
//! Automation (1991), 1008.

mod build;
mod tree;
mod weld;

use std::sync::Arc;

use pulvis_math::Vector3;
use thiserror::Error;

use self::tree::Tree;
use super::{EdgedShape, FeatureSurface, Shape, across, check_axis};

/// No line, no corner: an edge within a flat, a point where no line ends.
const NONE: u32 = u32::MAX;

/// Flats of so many triangles are searched one by one.
const FEW: usize = 6;

/// A surface of triangles, with particles on both sides. It need not be closed.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// The triangles, which several walls may share; their coordinates are counted from the wall's reference point.
    pub surface: Arc<TriangleMesh>,
    /// Unit vector along the axis of rotations, through the reference point; a pressure moves the mesh along it.
    pub axis: Vector3,
    /// The largest distance from the axis [m].
    radius: f64,
}

impl Mesh {
    /// Triangles and the axis about which they may turn, a unit vector.
    pub fn new(surface: Arc<TriangleMesh>, axis: Vector3) -> Self {
        let positions = surface.facets.iter().flat_map(|facet| facet.positions);
        let radius = positions.map(|position| position.tangential_to(axis).norm()).fold(0.0, f64::max);
        Self { surface, axis, radius }
    }
}

/// Triangles, and the features that they make up.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    facets: Vec<Facet>,
    flats: Vec<Flat>,
    /// The facets of all flats, one flat after the other.
    members: Vec<u32>,
    lines: Vec<Line>,
    /// Where the flats at each line lie: unit vectors in their planes, across the line and out of the flat.
    outwards: Vec<Vector3>,
    corners: Vec<Corner>,
    /// Unit vectors along all edges that begin in each corner.
    directions: Vec<Vector3>,
    /// The facets that meet in each corner.
    incident: Vec<u32>,
    tree: Tree,
    /// How far triangles of a flat may lie beside its plane [m].
    same: f64,
    /// Lengths below this are rounding errors [m].
    fuzz: f64,
}

/// A triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Facet {
    positions: [Vector3; 3],
    flat: u32,
    /// From each of the positions to the next.
    edges: [Edge; 3],
    /// Corners at the positions, or [`NONE`].
    corners: [u32; 3],
}

/// An edge of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Edge {
    /// A point of it [m].
    origin: Vector3,
    /// Unit vector across it, out of the triangle.
    outward: Vector3,
    /// The line that it is a part of, or [`NONE`] within a flat.
    line: u32,
}

/// Triangles in one plane.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flat {
    normal: Vector3,
    point: Vector3,
    /// Range of members.
    start: u32,
    end: u32,
}

/// A straight edge.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Line {
    ends: [Vector3; 2],
    /// Unit vector from the first end to the second.
    direction: Vector3,
    /// Range of outward vectors.
    start: u32,
    end: u32,
}

/// A point where lines end.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    position: Vector3,
    /// Range of directions.
    start: u32,
    end: u32,
    /// Range of facets.
    facets: [u32; 2],
}

/// Why triangles are no mesh.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum InvalidMesh {
    /// There are none.
    #[error("it has no triangles")]
    Empty,
    /// A coordinate is NaN or infinite, or so large that its square is.
    #[error("a corner of triangle {triangle} is not a finite point")]
    NotFinite {
        /// Number of the triangle; the first is 1.
        triangle: usize,
    },
    /// Triangles whose corners lie on a line.
    #[error("{found} of {triangles} triangles have no area, the first is triangle {first}")]
    NoArea {
        /// How many.
        found: usize,
        /// Of how many.
        triangles: usize,
        /// Number of the first; the first triangle is 1.
        first: usize,
    },
    /// More features than contacts can tell apart.
    #[error(
        "its {found} flat parts, edges and corners are more than {most}, the most that contacts can tell apart"
    )]
    TooMany {
        /// How many.
        found: usize,
        /// How many there may be.
        most: usize,
    },
}

impl TriangleMesh {
    /// Features that can be told apart.
    pub const MOST_FEATURES: usize = 1 << 20;

    /// From triangles whose corners are counted from the wall's reference point [m]. Corners that are nearer to each other
    /// than 5·10⁻⁷ of the size of the mesh are one.
    ///
    /// # Errors
    /// The triangles are no surface.
    pub fn new(triangles: &[[Vector3; 3]]) -> Result<Self, InvalidMesh> {
        build::build(triangles)
    }

    /// Its triangles, counted from the wall's reference point \[m\].
    pub fn triangles(&self) -> impl Iterator<Item = [Vector3; 3]> + '_ {
        self.facets.iter().map(|facet| facet.positions)
    }

    /// Numbers of triangles, flat parts, straight edges and corners.
    pub fn counts(&self) -> [usize; 4] {
        [self.facets.len(), self.flats.len(), self.lines.len(), self.corners.len()]
    }

    /// Whether all edges have a triangle on either side.
    pub fn is_closed(&self) -> bool {
        self.lines.iter().all(|line| line.end - line.start >= 2)
    }

    /// The box around it: lower and upper corner [m].
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        tree::bounds(self.facets.iter().flat_map(|facet| facet.positions))
    }

    fn in_flat(&self, number: usize, centre: Vector3, limit: f64) -> Option<FeatureSurface> {
        let flat = self.flats.get(number)?;
        let height = (centre - flat.point).dot(flat.normal);
        let distance = height.abs();
        let is_near = distance < limit;
        if !is_near || !self.is_above(number, centre, centre - flat.normal * height) {
            return None;
        }
        let normal = if height >= 0.0 { flat.normal } else { -flat.normal };
        Some(FeatureSurface {
            normal,
            distance,
            mean_curvature: 0.0,
            tangent: across(normal),
            turning: [0.0; 2],
        })
    }

    /// Whether a centre, whose foot in the plane is given, lies straight above a flat.
    fn is_above(&self, number: usize, centre: Vector3, foot: Vector3) -> bool {
        let flat = &self.flats[number];
        let members = &self.members[flat.start as usize..flat.end as usize];
        if members.len() <= FEW {
            return members.iter().any(|&facet| self.facet_holds(facet as usize, centre));
        }
        self.tree.any_within(foot, 2.0 * self.same, |facet| {
            self.facets[facet].flat as usize == number && self.facet_holds(facet, centre)
        })
    }

    /// Whether a centre lies straight above a triangle.
    fn facet_holds(&self, facet: usize, centre: Vector3) -> bool {
        self.facets[facet].edges.iter().all(|edge| {
            // Within a flat, triangles may overlap by a hair: there must be no gap between them.
            let slack = if edge.line == NONE { self.fuzz } else { 0.0 };
            (centre - edge.origin).dot(edge.outward) <= slack
        })
    }

    fn on_line(&self, number: usize, centre: Vector3, limit: f64) -> Option<FeatureSurface> {
        let Line { ends: [first, last], direction, start, end } = *self.lines.get(number)?;
        let from_first = centre - first;
        let along = from_first.dot(direction);
        let is_between = along > 0.0 && (centre - last).dot(-direction) > 0.0;
        let mut outwards = self.outwards[start as usize..end as usize].iter();
        if !is_between || !outwards.all(|&outward| from_first.dot(outward) > 0.0) {
            return None;
        }
        let apart = from_first - direction * along;
        at_point(apart, limit, |_| (direction, [0.0, 1.0]))
    }

    fn in_corner(&self, number: usize, centre: Vector3, limit: f64) -> Option<FeatureSurface> {
        let Corner { position, start, end, facets: [first, last] } = *self.corners.get(number)?;
        let apart = centre - position;
        let mut directions = self.directions[start as usize..end as usize].iter();
        if !directions.all(|&direction| apart.dot(direction) <= 0.0) {
            return None;
        }
        let seen = at_point(apart, limit, |normal| (across(normal), [1.0; 2]))?;
        // Straight above the corner, up to rounding errors, a triangle holds the centre as well.
        let mut facets = self.incident[first as usize..last as usize].iter();
        (!facets.any(|&facet| self.facet_holds(facet as usize, centre))).then_some(seen)
    }

    /// Distance of a point from a triangle [m].
    fn distance_from(&self, facet: usize, point: Vector3) -> f64 {
        let Facet { positions, flat, edges, .. } = &self.facets[facet];
        let is_above =
            edges.iter().zip(positions).all(|(edge, &corner)| (point - corner).dot(edge.outward) <= 0.0);
        if is_above {
            let flat = &self.flats[*flat as usize];
            return (point - flat.point).dot(flat.normal).abs();
        }
        let edges = [(0, 1), (1, 2), (2, 0)]
            .map(|(from, to)| segment_distance([positions[from], positions[to]], point));
        edges[0].min(edges[1]).min(edges[2])
    }
}

/// How a point of an edge or a corner lies to a centre that is `apart` from it [m]. `turning` gives a tangent to a normal,
/// and where the normal turns.
fn at_point(
    apart: Vector3,
    limit: f64,
    turning: impl Fn(Vector3) -> (Vector3, [f64; 2]),
) -> Option<FeatureSurface> {
    let distance = apart.norm();
    // A centre on the edge has no normal: the sphere is in there by its radius, and no contact.
    let is_near = distance > 0.0 && distance < limit;
    is_near.then(|| {
        let normal = apart * (1.0 / distance);
        let (tangent, turning) = turning(normal);
        let turning = turning.map(|turns| turns / distance);
        // Sharp as it is, an edge counts as flat: so the stiffness of contacts passes it continuously.
        FeatureSurface { normal, distance, mean_curvature: 0.0, tangent, turning }
    })
}

/// Distance of a point from a straight line with ends [m].
fn segment_distance([from, to]: [Vector3; 2], point: Vector3) -> f64 {
    let way = to - from;
    let share = ((point - from).dot(way) / way.norm_squared()).clamp(0.0, 1.0);
    (point - (from + way * share)).norm()
}

impl Shape for Mesh {
    fn least_mean_curvature(&self) -> f64 {
        0.0
    }

    fn axis(&self) -> Option<Vector3> {
        Some(self.axis)
    }

    fn distance_from_axis(&self) -> f64 {
        self.radius
    }

    fn is_turned_by_rotation(&self) -> bool {
        true
    }

    fn direction_of_push(&self) -> Option<Vector3> {
        Some(self.axis)
    }

    fn check(&self, _largest_radius: f64) -> Result<(), String> {
        check_axis(self.axis)
    }
}

impl EdgedShape for Mesh {
    fn surface_of(&self, feature: u32, centre: Vector3, limit: f64) -> Option<FeatureSurface> {
        let surface = &*self.surface;
        let (flats, lines) = (surface.flats.len(), surface.lines.len());
        match feature as usize {
            flat if flat < flats => surface.in_flat(flat, centre, limit),
            line if line < flats + lines => surface.on_line(line - flats, centre, limit),
            corner => surface.in_corner(corner - flats - lines, centre, limit),
        }
    }

    fn features_near(&self, centre: Vector3, limit: f64, found: &mut Vec<(u32, f64)>) {
        let surface = &*self.surface;
        let (flats, lines) = (surface.flats.len() as u32, surface.lines.len() as u32);
        surface.tree.any_within(centre, limit, |number| {
            let distance = surface.distance_from(number, centre);
            if distance >= limit {
                return false;
            }
            let facet = &surface.facets[number];
            found.push((facet.flat, distance));
            for edge in facet.edges.iter().filter(|edge| edge.line != NONE) {
                let apart = segment_distance(surface.lines[edge.line as usize].ends, centre);
                if apart < limit {
                    found.push((flats + edge.line, apart));
                }
            }
            for &corner in facet.corners.iter().filter(|corner| **corner != NONE) {
                let apart = (centre - surface.corners[corner as usize].position).norm();
                if apart < limit {
                    found.push((flats + lines + corner, apart));
                }
            }
            false
        });
        // Of a feature that several triangles belong to, the least distance stays.
        found.sort_unstable_by(|one, other| one.0.cmp(&other.0).then(one.1.total_cmp(&other.1)));
        found.dedup_by_key(|(feature, _)| *feature);
    }

    fn distance(&self, centre: Vector3) -> f64 {
        self.surface.tree.nearest(centre, |facet| self.surface.distance_from(facet, centre))
    }

    fn outline(&self) -> Vec<[Vector3; 2]> {
        self.surface.lines.iter().map(|line| line.ends).collect()
    }
}
