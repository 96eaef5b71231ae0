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

/// The points that decide whether a group is inside. In front of planes and inside cylinders the corners of a block
/// speak for all of it. A block around a post has its corners outside; there the run looks at every particle.
fn points(group: &ParticleGroup) -> Vec<Point> {
    let corners = |what: &str, block: &Cuboid| -> Vec<Point> {
        let size = block.lower.norm().max(block.upper.norm());
        let point = |at| Point { what: format!("a corner of the {what},"), at, slack: 1e-12 * size };
        block.corners().into_iter().map(point).collect()
    };
    let centre = |number: usize, at: Vector3| Point { what: format!("particle {number},"), at, slack: 0.0 };
    match &group.arrangement {
        Arrangement::Random(block) | Arrangement::Dense(block) => corners("block", block),
        Arrangement::Lattice(lattice) if group.count == lattice.site_count() => {
            corners("lattice", &lattice.extent())
        }
        Arrangement::Lattice(lattice) => {
            let of_cell = lattice.sites_per_cell();
            let cells = outermost_sites(lattice.counts, group.count.div_ceil(of_cell)).into_iter();
            let sites = cells.flat_map(|cell| of_cell * cell..of_cell * (cell + 1));
            let sites = sites.filter(|number| *number < group.count);
            sites.map(|number| centre(number, lattice.site(number))).collect()
        }
        Arrangement::File { grains, .. } | Arrangement::List(grains) => {
            grains.iter().enumerate().map(|(number, grain)| centre(number, grain.position)).collect()
        }
        // Where its particles are shows when it has grown.
        Arrangement::Aggregate { centre: at, .. } => {
            vec![Point { what: "the centre of the aggregate,".to_owned(), at: *at, slack: 0.0 }]
        }
    }
}

/// The corners of the blocks that the first `count` sites of a lattice fill: whole layers, whole rows of
/// the next layer, and the beginning of a row; by their numbers, in order. There may be more sites than could be
/// looked at.
fn outermost_sites([along_x, along_y, _]: [usize; 3], count: usize) -> Vec<usize> {
    let (rows, rest) = (count / along_x, count % along_x);
    let (layers, whole_rows) = (rows / along_y, rows % along_y);
    let blocks = [
        ([0, 0, 0], [along_x, along_y, layers]),
        ([0, 0, layers], [along_x, whole_rows, 1]),
        ([0, whole_rows, layers], [rest, 1, 1]),
    ];
    let mut sites = Vec::new();
    for (first, size) in blocks.into_iter().filter(|(_, size)| !size.contains(&0)) {
        for corner in 0..8_usize {
            let along = |axis: usize| first[axis] + (size[axis] - 1) * (corner >> axis & 1);
            sites.push(along(0) + along_x * (along(1) + along_y * along(2)));
        }
    }
    sites.sort_unstable();
    sites.dedup();
    sites
}

fn behind_wall(point: &Point, wall: &Wall) -> Problem {
    let Point { what, at, .. } = point;
    let (x, y, z) = (at.x, at.y, at.z);
    let found = format!(
        "{what} ({x}, {y}, {z}) m, lies {} m behind the wall {}",
        rounded(-wall.distance(*at)),
        wall.name
    );
    Problem::rule(found, wall.where_particles_are())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outermost_sites_of_a_lattice_reach_as_far_as_all_its_sites_in_every_direction() {
        let counts = [4, 3, 5];
        let numbers = |count: usize| (0..count).map(|n| [n % 4, n / 4 % 3, n / 12]);
        let directions = [[1, 0, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [3, -2, 1], [-5, 7, 2], [1, 1, -9]];
        for count in 1..=60 {
            let outermost = outermost_sites(counts, count);
            assert!(outermost.iter().all(|&number| number < count));
            for direction in directions {
                let along = |cell: [usize; 3]| -> i64 {
                    cell.iter().zip(direction).map(|(&at, slope)| at as i64 * slope).sum()
                };
                let reached = outermost.iter().filter_map(|&number| numbers(60).nth(number).map(along)).max();
                assert_eq!(reached, numbers(count).map(along).max(), "{count} {direction:?}");
            }
        }
    }
}
