//! The walls of a run as pictures and files show them: edges, rims, and axes of cylinders.

use pulvis_boundary::{Cylinder, CylinderSide, WallShape};
use pulvis_core::Simulation;
use pulvis_core::walls::Wall;
use pulvis_input::scenario::Scenario;
use pulvis_io::frames::Bounds;
use pulvis_io::picture::{OutlineBox, OutlineCylinder};
use pulvis_io::vtk::{Numbers, PolyData};
use pulvis_math::Vector3;

use super::setup::box_walls;

/// A box that has grown to more than this many times its first size has been blown apart by what it should hold.
const BLOWN_APART: f64 = 20.0;

/// The walls as lines of two points each; a cylinder is its axis, with its radius in the column `radius`.
pub(super) fn walls(scenario: &Scenario, simulation: &Simulation) -> PolyData {
    let cylinders = cylinders(scenario, simulation);
    let boxes = boxes(scenario, simulation, &cylinders);
    let mut edges: Vec<[[f64; 3]; 2]> = boxes.iter().flat_map(OutlineBox::edges).collect();
    edges.extend(tilted_edges(simulation));
    edges.extend(rims(simulation));
    let radii = edges.iter().map(|_| 0.0).chain(cylinders.iter().map(|cylinder| cylinder.radius)).collect();
    let lines = edges.iter().chain(cylinders.iter().map(|cylinder| &cylinder.ends));
    PolyData {
        points: lines.flatten().copied().collect(),
        columns: vec![("radius".to_owned(), Numbers::Scalar(radii))],
    }
}

/// The lines of the walls with edges that are there: rims, lines along cones and tubes, edges of meshes.
fn rims(simulation: &Simulation) -> impl Iterator<Item = [[f64; 3]; 2]> {
    let walls = simulation.walls().iter().filter(|wall| wall.present);
    let lines = walls.flat_map(Wall::outline).map(|line| line.map(Vector3::to_array));
    lines.filter(|line| line.iter().flatten().all(|x| x.is_finite()))
}

/// The box of a run for files that need one: along each axis the period, or the two walls of the box; where there are none,
/// from the lowest to the highest point of any particle.
pub(super) fn bounds(scenario: &Scenario, simulation: &Simulation) -> Bounds {
    let (domain, particles) = (simulation.domain(), simulation.particles());
    let mut bounds = Bounds { tilt: domain.tilts, periodic: domain.periodic, ..Bounds::default() };
    for axis in 0..3 {
        let spans = || particles.positions().iter().zip(particles.radii());
        let low = spans().map(|(centre, radius)| centre[axis] - radius).fold(f64::INFINITY, f64::min);
        let high = spans().map(|(centre, radius)| centre[axis] + radius).fold(f64::NEG_INFINITY, f64::max);
        let [lower, upper] = faces(scenario, simulation, axis);
        let [mut lower, mut upper] = [lower.unwrap_or(low), upper.unwrap_or(high)];
        if particles.is_empty() && !(lower.is_finite() && upper.is_finite()) {
            (lower, upper) = (0.0, 0.0);
        }
        (bounds.lower[axis], bounds.upper[axis]) = (lower, upper);
    }
    bounds
}

/// The edges of a tilted cell from its lower corner, which lead to the next images; the block that holds the particles is
/// shown whole beside them.
fn tilted_edges(simulation: &Simulation) -> impl Iterator<Item = [[f64; 3]; 2]> {
    let domain = *simulation.domain();
    let corner = domain.extent.lower;
    let axes = (0..3).filter(move |&axis| domain.is_tilted() && domain.periodic[axis]);
    axes.map(move |axis| [corner.to_array(), (corner + domain.shift(axis)).to_array()])
}

/// The box as far as it is there: whole, or the walls that are left. Where it has been blown apart, the box of the start.
fn boxes(scenario: &Scenario, simulation: &Simulation, cylinders: &[OutlineCylinder]) -> Vec<OutlineBox> {
    let faces: [[Option<f64>; 2]; 3] = std::array::from_fn(|axis| faces(scenario, simulation, axis));
    let start = scenario.enclosure;
    let first =
        || start.map(|start| OutlineBox { low: start.lower.to_array(), high: start.upper.to_array() });
    if faces.iter().flatten().flatten().any(|at| !at.is_finite()) {
        return first().into_iter().collect();
    }
    let whole = |axis: usize| faces[axis][0].zip(faces[axis][1]);
    if let (Some(x), Some(y), Some(z)) = (whole(0), whole(1), whole(2)) {
        let sound = |axis: usize, (low, high): (f64, f64)| {
            let size = start.map_or(high - low, |start| start.size()[axis]);
            (high - low).abs() <= BLOWN_APART * size
        };
        if sound(0, x) && sound(1, y) && sound(2, z) {
            return vec![OutlineBox { low: [x.0, y.0, z.0], high: [x.1, y.1, z.1] }];
        }
        return first().into_iter().collect();
    }
    // Along a single wall its edges lie where the particles end, those aside that have flown away.
    let ends: [[f64; 2]; 3] = std::array::from_fn(|axis| {
        let [least, most] = start.map_or([f64::NEG_INFINITY, f64::INFINITY], |start| {
            let size = start.size()[axis];
            [start.lower[axis] - size, start.upper[axis] + size]
        });
        let centres = simulation.particles().positions();
        let near = centres.iter().map(|centre| centre[axis]).filter(|x| (least..=most).contains(x));
        let [low, high] =
            near.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        [faces[axis][0].unwrap_or(low), faces[axis][1].unwrap_or(high)]
    });
    // The circles at the ends of a cylinder show where it is cut.
    let is_cut = |axis: usize, at: f64| {
        let meets = |shown: &OutlineCylinder| {
            shown.ends.iter().any(|end| (end[axis] - at).abs() < 1e-9 * shown.radius)
        };
        cylinders.iter().any(meets)
    };
    let walls = (0..3).flat_map(|axis| faces[axis].into_iter().flatten().map(move |at| (axis, at)));
    let walls = walls.filter(|&(axis, at)| !is_cut(axis, at));
    walls
        .map(|(axis, at)| {
            let mut outline = OutlineBox { low: ends.map(|end| end[0]), high: ends.map(|end| end[1]) };
            (outline.low[axis], outline.high[axis]) = (at, at);
            outline
        })
        .collect()
}

/// The cylinders that are there, from one end of the box or of the particles to the other.
fn cylinders(scenario: &Scenario, simulation: &Simulation) -> Vec<OutlineCylinder> {
    let walls = simulation.walls().iter().filter(|wall| wall.present);
    let cylinder =
        |shape: &WallShape| if let WallShape::Cylinder(cylinder) = shape { Some(*cylinder) } else { None };
    walls
        .filter_map(|wall| {
            let cylinder = cylinder(&wall.shape)?;
            let [low, high] = ends(scenario, simulation, &cylinder, wall.point)?;
            let end = |along: f64| (wall.point + cylinder.axis * along).to_array();
            Some(OutlineCylinder { ends: [end(low), end(high)], radius: cylinder.radius })
        })
        .collect()
}

/// Where a cylinder begins and ends in files and pictures, along its axis from its reference point [m].
pub(super) fn ends(
    scenario: &Scenario,
    simulation: &Simulation,
    cylinder: &Cylinder,
    point: Vector3,
) -> Option<[f64; 2]> {
    let along = (0..3).find(|&axis| cylinder.axis[axis].abs() == 1.0);
    let of_box = along.and_then(|axis| {
        let [low, high] = faces(scenario, simulation, axis);
        let [one, other] = [low?, high?].map(|face| (face - point[axis]) * cylinder.axis[axis]);
        Some([one.min(other), one.max(other)])
    });
    of_box.or_else(|| {
        let particles = simulation.particles();
        let spheres = particles.positions().iter().zip(particles.radii());
        let held = spheres.filter(|&(centre, _)| {
            let across = (centre - point).tangential_to(cylinder.axis).norm();
            cylinder.side == CylinderSide::Outside || across <= cylinder.radius
        });
        let spans = held.map(|(centre, radius)| {
            let at = (centre - point).dot(cylinder.axis);
            [at - radius, at + radius]
        });
        spans.reduce(|[low, high], [from, to]| [low.min(from), high.max(to)])
    })
}

/// Lower and upper end of the box along an axis, as far as they are there [m].
fn faces(scenario: &Scenario, simulation: &Simulation, axis: usize) -> [Option<f64>; 2] {
    let domain = simulation.domain();
    if domain.periodic[axis] {
        return [Some(domain.extent.lower[axis]), Some(domain.extent.upper[axis])];
    }
    box_walls(scenario, axis).map(|index| {
        let wall = simulation.walls().get(index?)?;
        wall.present.then(|| wall.point[axis])
    })
}
