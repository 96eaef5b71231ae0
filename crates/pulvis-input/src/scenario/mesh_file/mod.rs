//! Files of triangles: STL, binary and text, and OBJ.

mod error;
mod obj;
mod stl;

use std::path::Path;

use pulvis_math::Vector3;

pub use error::MeshFileError;

/// The triangles of a file, in the units of the file, and a hash of its bytes.
pub(super) struct Triangles {
    pub(super) corners: Vec<[Vector3; 3]>,
    pub(super) hash: String,
}

/// Reads a file; its name tells the format.
pub(super) fn read_triangles(path: &Path) -> Result<Triangles, MeshFileError> {
    let file = path.display().to_string();
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    let parse = match extension.as_deref() {
        Some("stl") => stl::parse,
        Some("obj") => obj::parse,
        _ => return Err(MeshFileError::Format { file }),
    };
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(reason) if reason.kind() == std::io::ErrorKind::NotFound => {
            return Err(MeshFileError::Missing { file });
        }
        Err(reason) => return Err(MeshFileError::Unreadable { file, reason }),
    };
    Ok(Triangles { corners: parse(&file, &bytes)?, hash: hash(&bytes) })
}

/// The 64-bit FNV-1a hash of some bytes, as 16 digits: it tells whether a file has changed, not whether somebody meant harm.
///
/// # Source
/// G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, The FNV Non-Cryptographic Hash Algorithm, RFC 9923.
fn hash(bytes: &[u8]) -> String {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    format!("{:016x}", bytes.iter().fold(0xcbf2_9ce4_8422_2325, step))
}

/// Three coordinates in a line of text, from the words that follow its first one.
fn coordinates(file: &str, line: usize, words: &[&str]) -> Result<Vector3, MeshFileError> {
    let found = || words.join(" ");
    let expected = "three coordinates, each a finite number";
    let refused = || MeshFileError::Line { file: file.to_owned(), line, found: found(), expected };
    let [x, y, z] = words else { return Err(refused()) };
    let number = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
    let (Some(x), Some(y), Some(z)) = (number(x), number(y), number(z)) else { return Err(refused()) };
    Ok(Vector3::new(x, y, z))
}

#[cfg(test)]
mod tests;
