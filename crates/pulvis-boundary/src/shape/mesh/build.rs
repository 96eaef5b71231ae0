//! From triangles to flats, lines and corners.

use std::collections::HashMap;

use pulvis_math::Vector3;

use super::tree::{Tree, bounds};
use super::weld::weld;
use super::{Corner, Edge, Facet, Flat, InvalidMesh, Line, NONE, TriangleMesh};

/// Corners that are nearer than this, over the size of the mesh, are one: coordinates in files have six or seven digits.
const SAME_POINT: f64 = 5e-7;

/// Sine of the angle up to which triangles lie in one plane, and edges on one line: so far do six digits turn a triangle
/// that is a hundredth of the mesh. A drum of 20 000 sides still has that many flats.
const SAME_PLANE: f64 = 1e-4;

/// Lengths below this, over the size of the mesh, are rounding errors.
const FUZZ: f64 = 1e-12;

/// An edge of the mesh with the triangles that share it.
struct MeshEdge {
    /// Points at its ends.
    ends: [u32; 2],
    /// Triangles, and which of their edges it is.
    shared: Vec<(usize, usize)>,
    /// The line that it is a part of, or [`NONE`] within a flat.
    line: u32,
}

/// What is known of the mesh while it is built.
struct Builder {
    points: Vec<Vector3>,
    triangles: Vec<[u32; 3]>,
    edges: Vec<MeshEdge>,
    /// The edge that begins at each point of each triangle.
    edges_of: Vec<[usize; 3]>,
    /// The flat of each triangle.
    flat_of: Vec<u32>,
    flats: Vec<Flat>,
    /// Lengths below this mean nothing [m].
    same: f64,
}

pub(super) fn build(triangles: &[[Vector3; 3]]) -> Result<TriangleMesh, InvalidMesh> {
    if triangles.is_empty() {
        return Err(InvalidMesh::Empty);
    }
    let is_sound = |corner: &Vector3| corner.norm_squared().is_finite();
    if let Some(index) = triangles.iter().position(|corners| !corners.iter().all(is_sound)) {
        return Err(InvalidMesh::NotFinite { triangle: index + 1 });
    }
    let (low, high) = bounds(triangles.iter().flatten().copied());
    let size = (Vector3::from(high) - Vector3::from(low)).norm();
    let (points, triangles) = weld(triangles, SAME_POINT * size)?;
    let mut builder = Builder {
        points,
        flat_of: vec![NONE; triangles.len()],
        triangles,
        edges: Vec::new(),
        edges_of: Vec::new(),
        flats: Vec::new(),
        same: SAME_POINT * size,
    };
    builder.find_edges();
    builder.find_flats();
    builder.finish(FUZZ * size)
}

impl Builder {
    fn at(&self, point: u32) -> Vector3 {
        self.points[point as usize]
    }

    fn normal(&self, triangle: usize) -> Vector3 {
        let [a, b, c] = self.triangles[triangle].map(|point| self.at(point));
        (b - a).cross(c - a)
    }

    fn find_edges(&mut self) {
        let mut numbers: HashMap<[u32; 2], usize> = HashMap::new();
        for (triangle, corners) in self.triangles.iter().enumerate() {
            let edges = [0, 1, 2].map(|side| {
                let (from, to) = (corners[side], corners[(side + 1) % 3]);
                let ends = [from.min(to), from.max(to)];
                let number = *numbers.entry(ends).or_insert(self.edges.len());
                if number == self.edges.len() {
                    self.edges.push(MeshEdge { ends, shared: Vec::new(), line: NONE });
                }
                self.edges[number].shared.push((triangle, side));
                number
            });
            self.edges_of.push(edges);
        }
    }

    /// Grows flats from the largest triangles, whose planes are known best.
    fn find_flats(&mut self) {
        let sizes: Vec<f64> =
            (0..self.triangles.len()).map(|triangle| self.normal(triangle).norm()).collect();
        let mut order: Vec<usize> = (0..self.triangles.len()).collect();
        order.sort_by(|&one, &other| sizes[other].total_cmp(&sizes[one]).then(one.cmp(&other)));
        for seed in order {
            if self.flat_of[seed] != NONE {
                continue;
            }
            let number = self.flats.len() as u32;
            let (normal, point) = (self.normal(seed) * (1.0 / sizes[seed]), self.at(self.triangles[seed][0]));
            self.flats.push(Flat { normal, point, start: 0, end: 0 });
            self.flat_of[seed] = number;
            let mut reached = vec![seed];
            while let Some(triangle) = reached.pop() {
                for edge in self.edges_of[triangle] {
                    for &(other, _) in &self.edges[edge].shared {
                        let is_parallel =
                            self.normal(other).cross(normal).norm() <= SAME_PLANE * sizes[other];
                        let is_near = |corner: u32| (self.at(corner) - point).dot(normal).abs() <= self.same;
                        if self.flat_of[other] == NONE
                            && is_parallel
                            && self.triangles[other].into_iter().all(is_near)
                        {
                            self.flat_of[other] = number;
                            reached.push(other);
                        }
                    }
                }
            }
        }
    }

    /// Across an edge with this direction, in the plane of a triangle and out of it.
    fn outward(&self, triangle: usize, side: usize, direction: Vector3) -> Vector3 {
        let across = direction.cross(self.flats[self.flat_of[triangle] as usize].normal);
        let across = across * (1.0 / across.norm());
        let corners = self.triangles[triangle];
        let inwards = self.at(corners[(side + 2) % 3]) - self.at(corners[side]);
        if inwards.dot(across) > 0.0 { -across } else { across }
    }

    fn direction(&self, [from, to]: [u32; 2]) -> Vector3 {
        let way = self.at(to) - self.at(from);
        way * (1.0 / way.norm())
    }

    /// Whether an edge lies within a flat, with triangles on both sides of it.
    fn is_within_flat(&self, edge: &MeshEdge) -> bool {
        let direction = self.direction(edge.ends);
        let Some(&(first, side)) = edge.shared.first() else { return false };
        let outward = self.outward(first, side, direction);
        let mut others = edge.shared.iter();
        edge.shared.iter().all(|&(triangle, _)| self.flat_of[triangle] == self.flat_of[first])
            && others.any(|&(triangle, side)| self.outward(triangle, side, direction).dot(outward) < 0.0)
    }

    /// The flats at an edge, in order.
    fn flats_at(&self, edge: usize) -> Vec<u32> {
        let mut flats: Vec<u32> =
            self.edges[edge].shared.iter().map(|&(triangle, _)| self.flat_of[triangle]).collect();
        flats.sort_unstable();
        flats
    }

    /// Joins edges into lines. Returns the edges of each, in the order of the line, and the points at its ends.
    fn find_lines(&mut self) -> Vec<(Vec<usize>, [u32; 2])> {
        let sharp: Vec<bool> = self.edges.iter().map(|edge| !self.is_within_flat(edge)).collect();
        let mut at_point: Vec<Vec<usize>> = vec![Vec::new(); self.points.len()];
        for (number, edge) in self.edges.iter().enumerate().filter(|(number, _)| sharp[*number]) {
            edge.ends.into_iter().for_each(|end| at_point[end as usize].push(number));
        }
        let mut lines: Vec<(Vec<usize>, [u32; 2])> = Vec::new();
        let mut taken = vec![false; self.edges.len()];
        for seed in (0..self.edges.len()).filter(|&edge| sharp[edge]) {
            if taken[seed] {
                continue;
            }
            taken[seed] = true;
            let mut edges = vec![seed];
            let mut ends = self.edges[seed].ends;
            for end in &mut ends {
                let mut last = seed;
                while let Some(next) = self.next_of_line(last, *end, &at_point[*end as usize]) {
                    if taken[next] {
                        break;
                    }
                    taken[next] = true;
                    edges.push(next);
                    let [from, to] = self.edges[next].ends;
                    *end = if from == *end { to } else { from };
                    last = next;
                }
            }
            let number = lines.len() as u32;
            edges.iter().for_each(|&edge| self.edges[edge].line = number);
            lines.push((edges, ends));
        }
        lines
    }

    /// The edge that continues another one beyond a point on the same line, between the same flats.
    fn next_of_line(&self, edge: usize, point: u32, sharp: &[usize]) -> Option<usize> {
        let [one, other] = *sharp else { return None };
        let next = if one == edge { other } else { one };
        let from = |edge: usize| {
            let [first, last] = self.edges[edge].ends;
            self.direction(if first == point { [first, last] } else { [last, first] })
        };
        let (before, after) = (from(edge), from(next));
        let is_straight = before.cross(after).norm() <= SAME_PLANE && before.dot(after) < 0.0;
        (is_straight && self.flats_at(edge) == self.flats_at(next)).then_some(next)
    }

    fn finish(mut self, fuzz: f64) -> Result<TriangleMesh, InvalidMesh> {
        let joined = self.find_lines();
        let (lines, outwards) = self.lines(&joined);
        let (mut corners, directions, corner_of) = self.corners(&joined, &lines);
        let incident = self.incident(&mut corners, &corner_of);
        let found = self.flats.len() + lines.len() + corners.len();
        if found > TriangleMesh::MOST_FEATURES {
            return Err(InvalidMesh::TooMany { found, most: TriangleMesh::MOST_FEATURES });
        }
        let facets: Vec<Facet> = (0..self.triangles.len())
            .map(|triangle| Facet {
                positions: self.triangles[triangle].map(|point| self.at(point)),
                flat: self.flat_of[triangle],
                edges: [0, 1, 2].map(|side| self.edge(triangle, side, &lines, &outwards)),
                corners: self.triangles[triangle].map(|point| corner_of[point as usize]),
            })
            .collect();
        let mut members: Vec<u32> = (0..facets.len() as u32).collect();
        members.sort_by_key(|&facet| self.flat_of[facet as usize]);
        for (index, &facet) in members.iter().enumerate() {
            let flat = &mut self.flats[self.flat_of[facet as usize] as usize];
            if flat.end == 0 {
                flat.start = index as u32;
            }
            flat.end = index as u32 + 1;
        }
        let positions: Vec<[Vector3; 3]> = facets.iter().map(|facet| facet.positions).collect();
        let tree = Tree::new(&positions);
        let (flats, same) = (self.flats, self.same);
        Ok(TriangleMesh {
            facets,
            flats,
            members,
            lines,
            outwards,
            corners,
            directions,
            incident,
            tree,
            same,
            fuzz,
        })
    }

    /// The facets that meet in each corner.
    fn incident(&self, corners: &mut [Corner], corner_of: &[u32]) -> Vec<u32> {
        let mut at_corner: Vec<Vec<u32>> = vec![Vec::new(); corners.len()];
        for (facet, points) in self.triangles.iter().enumerate() {
            for corner in points.map(|point| corner_of[point as usize]) {
                if let Some(facets) = at_corner.get_mut(corner as usize) {
                    facets.push(facet as u32);
                }
            }
        }
        let mut incident = Vec::new();
        for (corner, facets) in corners.iter_mut().zip(&at_corner) {
            corner.facets[0] = incident.len() as u32;
            incident.extend_from_slice(facets);
            corner.facets[1] = incident.len() as u32;
        }
        incident
    }

    fn lines(&self, joined: &[(Vec<usize>, [u32; 2])]) -> (Vec<Line>, Vec<Vector3>) {
        let (mut lines, mut outwards) = (Vec::new(), Vec::new());
        for (edges, ends) in joined {
            let direction = self.direction(*ends);
            let start = outwards.len() as u32;
            let mut seen: Vec<(u32, Vector3)> = Vec::new();
            for &(triangle, side) in edges.iter().flat_map(|&edge| &self.edges[edge].shared) {
                let (flat, outward) = (self.flat_of[triangle], self.outward(triangle, side, direction));
                if !seen.iter().any(|(known, other)| *known == flat && other.dot(outward) > 0.0) {
                    seen.push((flat, outward));
                }
            }
            outwards.extend(seen.into_iter().map(|(_, outward)| outward));
            let ends = ends.map(|end| self.at(end));
            lines.push(Line { ends, direction, start, end: outwards.len() as u32 });
        }
        (lines, outwards)
    }

    /// An edge of a triangle; one on a line has the point and the vector of the line, bit for bit.
    fn edge(&self, triangle: usize, side: usize, lines: &[Line], outwards: &[Vector3]) -> Edge {
        let edge = &self.edges[self.edges_of[triangle][side]];
        let Some(line) = lines.get(edge.line as usize) else {
            let outward = self.outward(triangle, side, self.direction(edge.ends));
            return Edge { origin: self.at(edge.ends[0]), outward, line: NONE };
        };
        let own = self.outward(triangle, side, line.direction);
        let of_line = &outwards[line.start as usize..line.end as usize];
        // Of the vectors of the line, its own one: the one that it departs from least.
        let nearest = of_line.iter().copied().max_by(|one, other| one.dot(own).total_cmp(&other.dot(own)));
        Edge { origin: line.ends[0], outward: nearest.unwrap_or(own), line: edge.line }
    }

    /// Corners, the directions of their edges, and the corner of each point.
    fn corners(
        &self,
        joined: &[(Vec<usize>, [u32; 2])],
        lines: &[Line],
    ) -> (Vec<Corner>, Vec<Vector3>, Vec<u32>) {
        let mut corner_of = vec![NONE; self.points.len()];
        let mut count = 0;
        for end in joined.iter().flat_map(|(_, ends)| *ends) {
            let corner = &mut corner_of[end as usize];
            if *corner == NONE {
                *corner = count;
                count += 1;
            }
        }
        let mut of_corner: Vec<Vec<Vector3>> = vec![Vec::new(); count as usize];
        for edge in &self.edges {
            for (index, &end) in edge.ends.iter().enumerate() {
                let corner = corner_of[end as usize];
                if corner == NONE {
                    continue;
                }
                let direction = match joined.get(edge.line as usize) {
                    // As the line has it, bit for bit.
                    Some((_, [first, _])) => {
                        let line = &lines[edge.line as usize];
                        if *first == end { line.direction } else { -line.direction }
                    }
                    None => self.direction([end, edge.ends[1 - index]]),
                };
                of_corner[corner as usize].push(direction);
            }
        }
        let mut corners =
            vec![Corner { position: Vector3::zero(), start: 0, end: 0, facets: [0; 2] }; count as usize];
        let mut directions = Vec::new();
        for (corner, own) in corners.iter_mut().zip(&of_corner) {
            corner.start = directions.len() as u32;
            directions.extend_from_slice(own);
            corner.end = directions.len() as u32;
        }
        for (point, &corner) in corner_of.iter().enumerate().filter(|(_, corner)| **corner != NONE) {
            corners[corner as usize].position = self.points[point];
        }
        (corners, directions, corner_of)
    }
}
