//! The walls of a run as triangles, for programs that show surfaces.

use std::f64::consts::TAU;

use pulvis_boundary::{Cylinder, WallShape};
use pulvis_core::Simulation;
use pulvis_core::walls::Wall;
use pulvis_input::scenario::Scenario;
use pulvis_io::vtk::{Numbers, PolyData};
use pulvis_math::{Vector3, elementary};

use super::outlines::{bounds, ends};

/// Parts of a circle.
const SEGMENTS: usize = 48;

type Triangle = [Vector3; 3];

/// All walls that are there: planes cut to the box of the run, or to the block around its particles; of cylinders as much as
/// pictures show. The column `wall` is the number of the wall in the order of the scenario.
pub(super) fn surfaces(scenario: &Scenario, simulation: &Simulation) -> PolyData {
    let block = Block::of(scenario, simulation);
    let mut data = PolyData::default();
    let mut numbers = Vec::new();
    for (number, wall) in simulation.walls().iter().enumerate().filter(|(_, wall)| wall.present) {
        let triangles = match &wall.shape {
            WallShape::Plane(plane) => block.cut_plane(wall.point, plane.normal),
            WallShape::PlaneWithHole(plane) => {
                let ring =
                    lathe(plane.normal, [plane.radius, 0.0], [plane.radius + block.reach(wall.point), 0.0]);
                block.cut(wall.place_triangles(ring.into_iter()))
            }
            WallShape::Cylinder(cylinder) => of_cylinder(scenario, simulation, wall, cylinder),
            WallShape::Cone(cone) => wall.place_triangles(
                lathe(cone.axis, [cone.radii[0], 0.0], [cone.radii[1], cone.height]).into_iter(),
            ),
            WallShape::Tube(tube) => wall.place_triangles(
                lathe(tube.axis, [tube.radius, 0.0], [tube.radius, tube.length]).into_iter(),
            ),
            WallShape::Disk(disk) => {
                wall.place_triangles(lathe(disk.normal, [0.0, 0.0], [disk.radius, 0.0]).into_iter())
            }
            WallShape::Mesh(mesh) => wall.place_triangles(mesh.surface.triangles()),
        };
        // Walls whose state is broken are shown by the pictures of the start.
        let sound = |triangle: &Triangle| {
            triangle.iter().all(|corner| corner.to_array().iter().all(|x| x.is_finite()))
        };
        for triangle in triangles.into_iter().filter(sound) {
            data.points.extend(triangle.map(Vector3::to_array));
            numbers.push(number as i64);
        }
    }
    data.columns.push(("wall".to_owned(), Numbers::Integer(numbers)));
    data
}

fn of_cylinder(
    scenario: &Scenario,
    simulation: &Simulation,
    wall: &Wall,
    cylinder: &Cylinder,
) -> Vec<Triangle> {
    let Some([low, high]) = ends(scenario, simulation, cylinder, wall.point) else { return Vec::new() };
    let rings = lathe(cylinder.axis, [cylinder.radius, low], [cylinder.radius, high]);
    wall.place_triangles(rings.into_iter())
}

/// What a straight line from one radius and height to another sweeps when it goes around an axis.
fn lathe(axis: Vector3, from: [f64; 2], to: [f64; 2]) -> Vec<Triangle> {
    let [x, y, z] = axis.to_array().map(f64::abs);
    let aside = match (x <= y && x <= z, y <= z) {
        (true, _) => Vector3::new(1.0, 0.0, 0.0),
        (false, true) => Vector3::new(0.0, 1.0, 0.0),
        _ => Vector3::new(0.0, 0.0, 1.0),
    };
    let across = aside.tangential_to(axis);
    let across = across * (1.0 / across.norm());
    let other = axis.cross(across);
    let point = |[radius, height]: [f64; 2], segment: usize| {
        // The last point is the first one, to the bit.
        let angle = TAU * (segment % SEGMENTS) as f64 / SEGMENTS as f64;
        let (sine, cosine) = elementary::sin_cos(angle);
        axis * height + (across * cosine + other * sine) * radius
    };
    let mut triangles = Vec::new();
    for segment in 0..SEGMENTS {
        let [one, two] = [point(from, segment), point(from, segment + 1)];
        let [three, four] = [point(to, segment), point(to, segment + 1)];
        // At the tip of a cone, and in the middle of a disk, one of the two has no area.
        if from[0] > 0.0 {
            triangles.push([one, two, four]);
        }
        if to[0] > 0.0 {
            triangles.push([one, four, three]);
        }
    }
    triangles
}

/// The block that planes without end are cut to.
struct Block {
    lower: Vector3,
    upper: Vector3,
}

impl Block {
    /// The box of the run; without one the block around its particles, and what walls with edges and planes beside it reach.
    fn of(scenario: &Scenario, simulation: &Simulation) -> Self {
        let around = bounds(scenario, simulation);
        let mut block = Self { lower: around.lower.into(), upper: around.upper.into() };
        if scenario.enclosure.is_some() {
            return block;
        }
        let middle = (block.lower + block.upper) * 0.5;
        let mut reached = Vec::new();
        for wall in simulation.walls().iter().filter(|wall| wall.present) {
            match wall.plane_normal() {
                Some(normal) => reached.push(middle - normal * (middle - wall.point).dot(normal)),
                None => reached.extend(wall.outline().into_iter().flatten()),
            }
        }
        let finite = |point: &Vector3| point.to_array().iter().all(|x| x.is_finite());
        let (mut lower, mut upper) = (block.lower.to_array(), block.upper.to_array());
        for point in reached.iter().filter(|point| finite(point)) {
            for axis in (0..3).filter(|&axis| !around.periodic[axis]) {
                lower[axis] = lower[axis].min(point[axis]);
                upper[axis] = upper[axis].max(point[axis]);
            }
        }
        (block.lower, block.upper) = (lower.into(), upper.into());
        block
    }

    /// A length from a point beyond which nothing of the block lies \[m\].
    fn reach(&self, from: Vector3) -> f64 {
        let size = (self.upper - self.lower).norm();
        let middle = (self.lower + self.upper) * 0.5;
        (from - middle).norm() + size
    }

    /// A plane through a point.
    fn cut_plane(&self, point: Vector3, normal: Vector3) -> Vec<Triangle> {
        let reach = self.reach(point);
        // A square about the point of the plane that is nearest to the middle of the block.
        let middle = (self.lower + self.upper) * 0.5;
        let centre = middle - normal * (middle - point).dot(normal);
        let [x, y, z] = normal.to_array().map(f64::abs);
        let aside = if x <= y && x <= z {
            Vector3::new(1.0, 0.0, 0.0)
        } else if y <= z {
            Vector3::new(0.0, 1.0, 0.0)
        } else {
            Vector3::new(0.0, 0.0, 1.0)
        };
        let across = aside.tangential_to(normal);
        let across = across * (reach / across.norm());
        let other = normal.cross(across);
        let square = vec![centre + across, centre + other, centre - across, centre - other];
        fan(self.polygon(square))
    }

    /// The parts of triangles that lie in the block.
    fn cut(&self, triangles: Vec<Triangle>) -> Vec<Triangle> {
        triangles.into_iter().flat_map(|triangle| fan(self.polygon(triangle.to_vec()))).collect()
    }

    /// The part of a convex polygon that lies in the block: cut by one face after the other (I. E. Sutherland, G. W. Hodgman,
    /// Commun. ACM 17, 32, 1974).
    fn polygon(&self, mut polygon: Vec<Vector3>) -> Vec<Vector3> {
        // A wall of the box lies in a face of the block.
        let room = 1e-9 * (self.upper - self.lower).norm();
        for axis in 0..3 {
            for (sign, face) in [(1.0, self.lower[axis]), (-1.0, -self.upper[axis])] {
                let inside = |point: &Vector3| sign * point[axis] - face + room;
                let mut kept = Vec::with_capacity(polygon.len() + 1);
                for (index, point) in polygon.iter().enumerate() {
                    let next = &polygon[(index + 1) % polygon.len()];
                    let [here, there] = [inside(point), inside(next)];
                    if here >= 0.0 {
                        kept.push(*point);
                    }
                    if (here >= 0.0) != (there >= 0.0) {
                        let share = here / (here - there);
                        kept.push(*point + (*next - *point) * share);
                    }
                }
                polygon = kept;
            }
        }
        polygon
    }
}

/// The triangles of a convex polygon.
fn fan(polygon: Vec<Vector3>) -> Vec<Triangle> {
    let corners = polygon.windows(2).skip(1);
    corners.map(|pair| [polygon[0], pair[0], pair[1]]).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;
    use crate::protocol::prepare;

    fn area(triangle: &[[f64; 3]; 3]) -> f64 {
        let [a, b, c] = triangle.map(Vector3::from);
        0.5 * (b - a).cross(c - a).norm()
    }

    /// The area of each wall of a good scenario, by its name.
    fn areas(text: &str) -> Vec<(String, f64)> {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../pulvis-input/tests/good");
        let scenario = Scenario::load(folder.join(text)).unwrap_or_else(|errors| panic!("{errors}"));
        let simulation = prepare(&scenario).unwrap().simulation;
        let data = surfaces(&scenario, &simulation);
        let Some(Numbers::Integer(numbers)) = data.column("wall") else { panic!("no numbers of walls") };
        let mut areas: Vec<(String, f64)> =
            simulation.walls().iter().map(|wall| (wall.name.clone(), 0.0)).collect();
        for (triangle, number) in data.triangles().iter().zip(numbers) {
            areas[*number as usize].1 += area(triangle);
        }
        areas
    }

    #[test]
    fn the_walls_of_a_box_are_its_faces() {
        let areas = areas("output_files.toml");
        assert_eq!(areas.len(), 6);
        // 4 mm x 4 mm; faces lie in the block up to a billionth of its diagonal.
        assert!(areas.iter().all(|(_, area)| (area / 16e-6 - 1.0).abs() < 1e-8), "{areas:?}");
    }

    #[test]
    fn round_walls_have_the_areas_of_their_polygons_and_meshes_those_of_their_triangles() {
        let found = areas("hopper_of_parts.toml");
        let area = |name: &str| found.iter().find(|(known, _)| known == name).unwrap().1;
        // Regular polygons of 48 sides: perimeter 2 n r sin(pi/n), area n r^2 sin(2 pi/n)/2.
        let n = SEGMENTS as f64;
        let perimeter = |radius: f64| 2.0 * n * radius * elementary::sin(std::f64::consts::PI / n);
        assert!((area("silo") / (perimeter(0.01) * 0.03) - 1.0).abs() < 1e-12, "{found:?}");
        let polygon = 0.5 * n * 0.01 * 0.01 * elementary::sin(TAU / n);
        assert!((area("piston") / polygon - 1.0).abs() < 1e-12, "{found:?}");
        // A cone to its tip: half the perimeter times the height of its triangles.
        let apothem = 0.01 * elementary::cos(std::f64::consts::PI / n);
        let slant = (0.01 * 0.01 + apothem * apothem).sqrt();
        assert!((area("funnel") / (0.5 * perimeter(0.01) * slant) - 1.0).abs() < 1e-12, "{found:?}");
        // The blade of 8 mm x 4 mm.
        assert!((area("paddle") / 32e-6 - 1.0).abs() < 1e-9, "{found:?}");
        assert!(area("floor") > 0.0);
    }

    #[test]
    fn a_slanted_plane_is_cut_to_the_block_and_one_outside_is_not_there() {
        let block = Block { lower: Vector3::zero(), upper: Vector3::new(1.0, 2.0, 3.0) };
        let sum = |triangles: Vec<Triangle>| -> f64 {
            triangles.iter().map(|triangle| area(&triangle.map(Vector3::to_array))).sum()
        };
        // Through the edge x = 0, z = 0 and the edge x = 1, z = 3: 2 x sqrt(10).
        let normal = Vector3::new(3.0, 0.0, -1.0) * (1.0 / 10.0_f64.sqrt());
        let slanted = sum(block.cut_plane(Vector3::new(0.0, 5.0, 0.0), normal));
        assert!((slanted / (2.0 * 10.0_f64.sqrt()) - 1.0).abs() < 1e-7, "{slanted}");
        assert!(block.cut_plane(Vector3::new(0.0, 0.0, 4.0), Vector3::new(0.0, 0.0, 1.0)).is_empty());
    }
}
