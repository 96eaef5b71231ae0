//! Whether the particles start where walls and periodic directions want them.

use super::arrangement::Arrangement;
use super::axis::Axis;
use super::particles::{ParticleGroup, PlacedGroup};
use super::walls::Wall;
use crate::context::Reported;
use crate::problem::Problem;
use crate::reader::TableReader;
use pulvis_boundary::{Cuboid, Domain};
use pulvis_math::Vector3;

/// Checks every group: centres lie on the inner side of all walls, and inside the domain along periodic
/// directions.
pub(super) fn check_placement(
    root: &TableReader<'_>,
    groups: &[PlacedGroup],
    walls: &[Wall],
    domain: Option<&Domain>,
) -> Result<(), Reported> {
    let mut failure = None;
    for (group, place) in groups {
        let problem = points(group).into_iter().find_map(|point| {
            let wall = walls.iter().find(|wall| wall.distance(point.at) < -point.slack);
            let behind = wall.map(|wall| behind_wall(&point, wall));
            behind.or_else(|| domain.and_then(|domain| outside_domain(&point, domain)))
        });
        if let Some(problem) = problem {
            failure = Some(root.refuse_at(place, problem));
        }
    }
    failure.map_or(Ok(()), Err)
}

/// A point that has to be inside.
struct Point {
    what: String,
    at: Vector3,
    /// A corner of a block may lie in the plane of a wall, up to the rounding of its coordinates [m].
    slack: f64,
}

/// The points that decide whether a group is inside: walls are planes, so the corners of a block speak
/// for all of it.
fn points(group: &ParticleGroup) -> Vec<Point> {
    let corners = |what: &str, block: &Cuboid| -> Vec<Point> {
        let size = block.lower.norm().max(block.upper.norm());
        let point = |at| Point { what: format!("a corner of the {what},"), at, slack: 1e-12 * size };
        block.corners().into_iter().map(point).collect()
    };
    let centre = |number: usize, at: Vector3| Point { what: format!("particle {number},"), at, slack: 0.0 };
    match &group.arrangement {
        Arrangement::Random(block) => corners("block", block),
        Arrangement::Lattice(lattice) if group.count == lattice.site_count() => {
            corners("lattice", &lattice.extent())
        }
        Arrangement::Lattice(lattice) => {
            lattice.sites().take(group.count).enumerate().map(|(number, at)| centre(number, at)).collect()
        }
        Arrangement::File { grains, .. } => {
            grains.iter().enumerate().map(|(number, grain)| centre(number, grain.position)).collect()
        }
        Arrangement::List(positions) => {
            positions.iter().enumerate().map(|(number, at)| centre(number, *at)).collect()
        }
    }
}

fn behind_wall(point: &Point, wall: &Wall) -> Problem {
    let Point { what, at, .. } = point;
    let (x, y, z) = (at.x, at.y, at.z);
    let found = format!(
        "{what} ({x}, {y}, {z}) m, lies {} m behind the wall {}",
        rounded(-wall.distance(*at)),
        wall.name
    );
    Problem::rule(found, "particles on the side to which the wall's normal points")
}

fn outside_domain(point: &Point, domain: &Domain) -> Option<Problem> {
    let Point { what, at, slack } = point;
    Axis::ALL.into_iter().filter(|axis| domain.periodic[axis.index()]).find_map(|axis| {
        let value = at[axis.index()];
        let (lower, upper) = (domain.extent.lower[axis.index()], domain.extent.upper[axis.index()]);
        if value >= lower - slack && value <= upper + slack {
            return None;
        }
        let name = axis.name();
        let found = format!("{what} {name} = {value} m, lies outside the domain");
        Some(Problem::rule(found, format!("{name} from {lower} m to {upper} m, where it repeats")))
    })
}

/// The value with six digits, as a message shows it.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
