//! Corners of triangles that are one point.

use std::collections::HashMap;

use pulvis_math::Vector3;

use super::InvalidMesh;

/// Points, and triangles by the indices of their corners.
pub(super) type Welded = (Vec<Vector3>, Vec<[u32; 3]>);

/// Joins corners that are nearer than `same` [m]. A triangle with two equal corners is left out: its neighbours share the
/// edge that remains. One whose corners lie on a line leaves a gap and is refused.
pub(super) fn weld(triangles: &[[Vector3; 3]], same: f64) -> Result<Welded, InvalidMesh> {
    let mut points: Vec<Vector3> = Vec::new();
    let mut exact: HashMap<[u64; 3], u32> = HashMap::new();
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let edge = 4.0 * same;
    let mut point_of = |corner: Vector3| -> u32 {
        // The sum makes a positive zero of a negative one.
        let bits = corner.to_array().map(|x| (x + 0.0).to_bits());
        if let Some(&known) = exact.get(&bits) {
            return known;
        }
        let cell = corner.to_array().map(|x| (x / edge).floor().clamp(-1e18, 1e18) as i64);
        let around = (0..27_i64).map(|n| [cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1]);
        let near = around.filter_map(|cell| cells.get(&cell)).flatten().copied();
        let near = near.filter(|&known| (points[known as usize] - corner).norm() <= same).min();
        let number = near.unwrap_or_else(|| {
            points.push(corner);
            let number = points.len() as u32 - 1;
            cells.entry(cell).or_default().push(number);
            number
        });
        exact.insert(bits, number);
        number
    };
    let numbered: Vec<[u32; 3]> = triangles.iter().map(|corners| corners.map(&mut point_of)).collect();
    let (mut kept, mut flat) = (Vec::new(), Vec::new());
    for (index, corners) in numbered.into_iter().enumerate() {
        let [a, b, c] = corners;
        if a == b || b == c || c == a {
            continue;
        }
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        let is_wide = (b - a).cross(c - a).norm() > same * longest;
        if is_wide { kept.push(corners) } else { flat.push(index + 1) }
    }
    match flat.first() {
        Some(&first) => Err(InvalidMesh::NoArea { found: flat.len(), triangles: triangles.len(), first }),
        None if kept.is_empty() => {
            Err(InvalidMesh::NoArea { found: triangles.len(), triangles: triangles.len(), first: 1 })
        }
        None => Ok((points, kept)),
    }
}
