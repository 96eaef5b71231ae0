//! Wavefront OBJ: corners (`v`) and faces (`f`). Everything else is left aside.
//!
//! # Source
//! Wavefront Technologies, Advanced Visualizer manual, appendix B1, Object files (.obj).

use pulvis_math::Vector3;

use super::{MeshFileError, coordinates};

/// Statements that change no corner and no face.
const OTHERS: [&str; 16] = [
    "vn", "vt", "vp", "g", "o", "s", "mg", "usemtl", "mtllib", "l", "p", "lod", "bevel", "c_interp",
    "d_interp", "usemap",
];

pub(super) fn parse(file: &str, bytes: &[u8]) -> Result<Vec<[Vector3; 3]>, MeshFileError> {
    let text = String::from_utf8_lossy(bytes);
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for (index, content) in text.lines().enumerate() {
        let content = content.split('#').next().unwrap_or_default();
        let words: Vec<&str> = content.split_whitespace().collect();
        let line = index + 1;
        let refused = |expected| {
            let found = content.trim().to_owned();
            MeshFileError::Line { file: file.to_owned(), line, found, expected }
        };
        match words.first() {
            // A weight or a colour may follow.
            Some(&"v") => points.push(coordinates(file, line, &words[1..words.len().min(4)])?),
            Some(&"f") => {
                let corners: Option<Vec<Vector3>> =
                    words[1..].iter().map(|word| corner(word, &points)).collect();
                let corners =
                    corners.ok_or_else(|| refused("numbers of corners that stand before the face"))?;
                let [first, rest @ ..] = &corners[..] else { return Err(refused("three corners or more")) };
                if rest.len() < 2 {
                    return Err(refused("three corners or more"));
                }
                // A fan: right for triangles, and for faces that are flat and convex.
                triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
            }
            Some(word) if OTHERS.contains(word) => {}
            None => {}
            Some(_) => return Err(refused("a line of an OBJ file: v, f, or what belongs to its looks")),
        }
    }
    Ok(triangles)
}

/// The corner that `7`, `7/1`, `7/1/3` or `-1` means; the first is 1, the last one before the face is -1.
fn corner(word: &str, points: &[Vector3]) -> Option<Vector3> {
    let number: i64 = word.split('/').next()?.parse().ok()?;
    let index = if number > 0 { number - 1 } else { number + points.len() as i64 };
    // Zero means nothing: it would be behind the last one.
    points.get(usize::try_from(index).ok()?).copied()
}
