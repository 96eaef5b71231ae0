#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;

/// A tetrahedron as a binary STL file of this number of triangles.
fn binary(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    // Many programs begin their binary files with this word.
    let mut bytes = b"solid".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in triangles {
        bytes.extend([0_u8; 12]);
        bytes.extend(corners.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0_u8; 2]);
    }
    bytes
}

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, -2.25, 1e-3]];

#[test]
fn all_three_formats_give_the_same_triangle() {
    let text = "solid one\n facet normal 0 0 0\n  outer loop\n   vertex 0 0 0\n   vertex 1.5 0 0\n   vertex 0 -2.25 1e-3\n  endloop\n endfacet\nendsolid one\n";
    let object = "# comment\no one\nv 0 0 0\nv 1.5 0 0 1\nvn 0 0 1\nv 0 -2.25 1e-3\nf 1//1 2//1 -1//1\n";
    let from_binary = stl::parse("a.stl", &binary(&[TRIANGLE])).unwrap();
    let from_text = stl::parse("a.stl", text.as_bytes()).unwrap();
    assert_eq!(from_text, obj::parse("a.obj", object.as_bytes()).unwrap());
    assert_eq!(from_text.len(), 1);
    for (one, other) in from_binary[0].iter().zip(from_text[0]) {
        // Binary files have numbers of 24 bits.
        assert!((*one - other).norm() < 1e-10);
    }
}

#[test]
fn a_square_face_is_two_triangles() {
    let object = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let triangles = obj::parse("a.obj", object.as_bytes()).unwrap();
    let area: f64 = triangles.iter().map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a).norm()).sum();
    assert_eq!((triangles.len(), area), (2, 1.0));
}

#[test]
fn damaged_files_are_refused_with_the_line_or_the_length() {
    let stl = |bytes: &[u8]| stl::parse("a.stl", bytes).unwrap_err().to_string();
    let obj = |text: &str| obj::parse("a.obj", text.as_bytes()).unwrap_err().to_string();
    let mut cut = binary(&[TRIANGLE, TRIANGLE]);
    cut.truncate(150);
    cut[0] = 0;
    assert_eq!(
        stl(&cut),
        "a.stl is damaged: it holds 150 bytes; expected 184, the header and the triangles that it counts"
    );
    assert_eq!(
        stl(b"solid\nvertex 1 2\n"),
        "a.stl:2: found `1 2`; expected three coordinates, each a finite number"
    );
    assert_eq!(
        stl(b"solid\nvertex 1 2 nan\n"),
        "a.stl:2: found `1 2 nan`; expected three coordinates, each a finite number"
    );
    assert_eq!(
        stl(b"solid\nvertex 1 2 3\nendloop\n"),
        "a.stl:3: found `endloop`; expected three lines `vertex` before it"
    );
    assert_eq!(
        obj("v 0 0 0\nf 1 2 3\n"),
        "a.obj:2: found `f 1 2 3`; expected numbers of corners that stand before the face"
    );
    assert_eq!(obj("v 0 0 0\nf 1 1\n"), "a.obj:2: found `f 1 1`; expected three corners or more");
    assert_eq!(
        obj("surf 0 1\n"),
        "a.obj:1: found `surf 0 1`; expected a line of an OBJ file: v, f, or what belongs to its looks"
    );
}

#[test]
fn the_hash_is_that_of_published_examples() {
    // RFC 9923, test values of FNV-1a with 64 bits.
    assert_eq!(
        [hash(b""), hash(b"a"), hash(b"foobar")],
        ["cbf29ce484222325", "af63dc4c8601ec8c", "85944171f73967e8"]
    );
}
