//! Surfaces of triangles.

use std::sync::Arc;

use super::*;

type Triangles = Vec<[Vector3; 3]>;

fn vector(x: f64, y: f64, z: f64) -> Vector3 {
    Vector3::new(x, y, z)
}

/// A block from −1 to 1 along each axis, each face in n × n squares of two triangles.
fn block(n: u32) -> Triangles {
    let mut triangles = Vec::new();
    let at = |number: u32| -1.0 + 2.0 * f64::from(number) / f64::from(n);
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let point = |i: u32, j: u32| {
                let mut point = [side; 3];
                (point[(axis + 1) % 3], point[(axis + 2) % 3]) = (at(i), at(j));
                Vector3::from(point)
            };
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let corners = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
                triangles.push([corners[0], corners[1], corners[2]]);
                triangles.push([corners[0], corners[2], corners[3]]);
            }
        }
    }
    triangles
}

/// Two squares that meet in a ridge along y at x = 0, z = 0, falling by `slope` to both sides.
fn ridge(slope: f64) -> Triangles {
    let square = |x: f64| {
        let (low, high) = (vector(x, -1.0, -slope), vector(x, 1.0, -slope));
        let (start, end) = (vector(0.0, -1.0, 0.0), vector(0.0, 1.0, 0.0));
        [[start, low, high], [start, high, end]]
    };
    [square(1.0), square(-1.0)].concat()
}

fn mesh(triangles: &[[Vector3; 3]]) -> Mesh {
    Mesh::new(Arc::new(TriangleMesh::new(triangles).unwrap()), vector(0.0, 0.0, 1.0))
}

/// The contacts of a sphere of this radius.
fn contacts(mesh: &Mesh, centre: Vector3, radius: f64) -> Vec<FeatureSurface> {
    let mut near = Vec::new();
    mesh.features_near(centre, radius, &mut near);
    near.iter().filter_map(|&(feature, _)| mesh.surface_of(feature, centre, radius)).collect()
}

#[test]
fn a_block_has_six_flats_twelve_edges_and_eight_corners_however_it_is_cut() {
    for n in [1, 2, 7] {
        let surface = TriangleMesh::new(&block(n)).unwrap();
        assert_eq!(surface.counts(), [12 * (n * n) as usize, 6, 12, 8]);
        assert!(surface.is_closed());
    }
    let open = TriangleMesh::new(&block(3)[18..]).unwrap();
    assert_eq!((open.counts(), open.is_closed()), ([90, 5, 12, 8], false));
}

#[test]
fn the_distance_from_a_block_is_the_closed_form() {
    let block = mesh(&block(5));
    let mut random = 0.5_f64;
    let mut next = || {
        random = (random * 997.0 + 0.123_456_7).fract();
        4.0 * random - 2.0
    };
    for _ in 0..2000 {
        let centre = vector(next(), next(), next());
        let beyond = centre.to_array().map(|x| x.abs() - 1.0);
        let inside = beyond.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let outside = beyond.map(|x| x.max(0.0));
        let expected = if inside < 0.0 { -inside } else { Vector3::from(outside).norm() };
        assert!((block.distance(centre) - expected).abs() < 1e-14, "{centre:?}");
        // Outside, the nearest of its contacts is at the nearest point of the block.
        if inside > 0.0 {
            let all = contacts(&block, centre, 10.0);
            let only = all.iter().min_by(|one, other| one.distance.total_cmp(&other.distance)).unwrap();
            assert!((only.distance - expected).abs() < 1e-14);
            let nearest = Vector3::from(centre.to_array().map(|x| x.clamp(-1.0, 1.0)));
            assert!((centre - only.normal * only.distance - nearest).norm() < 1e-14);
        }
    }
}

#[test]
fn a_sphere_has_one_contact_on_a_face_an_edge_or_a_corner_and_several_in_hollows() {
    let block = mesh(&block(4));
    let count = |x: f64, y: f64, z: f64| contacts(&block, vector(x, y, z), 0.3).len();
    // Outside: above a face and above lines between its triangles, above an edge, above a corner.
    assert_eq!([count(0.1, 0.3, 1.2), count(0.5, 0.5, 1.2), count(0.0, 0.0, 1.2)], [1; 3]);
    assert_eq!([count(1.1, 0.5, 1.1), count(1.1, 0.1, 1.1), count(1.1, 1.1, 1.1)], [1; 3]);
    // Inside: at a face, in an edge, in a corner.
    assert_eq!([count(0.1, 0.3, 0.8), count(0.8, 0.5, 0.8), count(0.8, -0.8, 0.8)], [1, 2, 3]);
    // Exactly above an edge of the outline, on the border between flat and edge.
    assert_eq!([count(1.0, 0.5, 1.2), count(1.0, 1.0, 1.2)], [1; 2]);
}

#[test]
fn the_distance_from_a_ridge_is_continuous_and_has_one_contact_all_the_way() {
    for slope in [0.01, 0.3, 2.0] {
        let ridge = mesh(&ridge(slope));
        let mut before: Option<FeatureSurface> = None;
        for number in -4000..=4000 {
            let centre = vector(f64::from(number) * 1e-4, 0.013, 0.2);
            let all = contacts(&ridge, centre, 0.9);
            let [now] = all[..] else { panic!("{} contacts at {centre:?}", all.len()) };
            if let Some(before) = before {
                assert!((now.distance - before.distance).abs() < 1.01e-4);
                // On the edge the normal turns by the way over the distance.
                assert!((now.normal - before.normal).norm() < 1.01e-4 / 0.2 + 1e-12);
            }
            before = Some(now);
        }
    }
}

#[test]
fn corners_that_differ_in_the_seventh_digit_are_one() {
    let shaken: Triangles = block(3)
        .iter()
        .enumerate()
        .map(|(number, corners)| corners.map(|corner| corner * (1.0 + 1e-7 * ((number % 5) as f64 - 2.0))))
        .collect();
    assert_eq!(TriangleMesh::new(&shaken).unwrap().counts(), [108, 6, 12, 8]);
}

#[test]
fn what_is_no_surface_is_refused_in_words() {
    let refused = |triangles: &[[Vector3; 3]]| TriangleMesh::new(triangles).unwrap_err().to_string();
    assert_eq!(refused(&[]), "it has no triangles");
    let mut bad = block(1);
    bad[4][1].y = f64::NAN;
    assert_eq!(refused(&bad), "a corner of triangle 5 is not a finite point");
    let mut flat = block(1);
    flat[2] = [vector(0.0, 0.0, 0.0), vector(0.5, 0.5, 0.5), vector(1.0, 1.0, 1.0)];
    assert_eq!(refused(&flat), "1 of 12 triangles have no area, the first is triangle 3");
    // A triangle that has shrunk to an edge leaves no gap.
    let mut shrunk = block(1);
    let [a, b, _] = shrunk[0];
    shrunk.push([a, b, b]);
    assert_eq!(TriangleMesh::new(&shrunk).unwrap().counts(), [12, 6, 12, 8]);
}
