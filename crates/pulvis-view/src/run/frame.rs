//! Frames as bytes that a graphics card takes as they are.
//!
//! Four letters, the length of a header \[byte\] as a 32-bit integer, the header in JSON, padded with blanks so that the numbers
//! begin at a multiple of four; then 32-bit floats, little endian.

use pulvis_io::vtk::{Frame, Numbers, PolyData};
use serde_json::{Value, json};

/// Columns of a frame by name.
pub(crate) type Columns<'a> = &'a [(String, Numbers)];

/// Particles, walls, and the values of a column by which particles are coloured; `None` where there is no such column.
///
/// Header: `time`, `particles`, `walls`, `triangles`, `columns`. Numbers: 3 coordinates, radius and value of each particle, one
/// array after another; 6 coordinates and a radius of each line of the walls; 9 coordinates of each triangle of their surfaces.
pub(super) fn particles(time: f64, frame: &Frame, column: Option<&str>) -> Option<Vec<u8>> {
    let particles = &frame.particles;
    let count = particles.points.len();
    let values = match column {
        Some(name) => scalars(particles.column(name)?),
        None => vec![0.0; count],
    };
    let radii = particles.scalar("radius")?;
    let lines = frame.walls.lines();
    let wall_radii = frame.walls.scalar("radius").unwrap_or_else(|| vec![0.0; lines.len()]);
    let header = json!({
        "time": time,
        "particles": count,
        "walls": lines.len(),
        "triangles": frame.surfaces.points.len() / 3,
        "contacts": frame.contacts.points.len() / 2,
        "columns": column_names(&particles.columns),
    });
    let parts: [&[f64]; 6] = [
        particles.points.as_flattened(),
        &radii,
        &values,
        lines.as_flattened().as_flattened(),
        &wall_radii,
        frame.surfaces.points.as_flattened(),
    ];
    Some(packed("PVP1", &header, &parts))
}

/// Contacts: 6 coordinates of each, and its normal force.
pub(super) fn contacts(frame: &Frame) -> Vec<u8> {
    let contacts: &PolyData = &frame.contacts;
    let count = contacts.points.len() / 2;
    let forces = contacts.scalar("normal_force").unwrap_or_else(|| vec![0.0; count]);
    packed("PVC1", &json!({ "contacts": count }), &[contacts.points.as_flattened(), &forces])
}

/// One number for each row: magnitudes of vectors, a third of the trace of tensors.
pub(crate) fn scalars(numbers: &Numbers) -> Vec<f64> {
    match numbers {
        Numbers::Scalar(values) => values.clone(),
        Numbers::Integer(values) => values.iter().map(|&value| value as f64).collect(),
        Numbers::Vector(values) => values.iter().map(|[x, y, z]| (x * x + y * y + z * z).sqrt()).collect(),
        Numbers::Tensor(values) => values.iter().map(|one| (one[0] + one[4] + one[8]) / 3.0).collect(),
    }
}

/// Names and shapes.
pub(crate) fn column_names(columns: Columns<'_>) -> Value {
    let shape = |numbers: &Numbers| match numbers {
        Numbers::Scalar(_) => "scalar",
        Numbers::Integer(_) => "integer",
        Numbers::Vector(_) => "vector",
        Numbers::Tensor(_) => "tensor",
    };
    columns.iter().map(|(name, numbers)| json!({ "name": name, "shape": shape(numbers) })).collect()
}

fn packed(letters: &str, header: &Value, parts: &[&[f64]]) -> Vec<u8> {
    let mut header = header.to_string();
    while !header.len().is_multiple_of(4) {
        header.push(' ');
    }
    let numbers: usize = parts.iter().map(|part| part.len()).sum();
    let mut bytes = Vec::with_capacity(8 + header.len() + 4 * numbers);
    bytes.extend_from_slice(letters.as_bytes());
    bytes.extend_from_slice(&(header.len() as u32).to_le_bytes());
    bytes.extend_from_slice(header.as_bytes());
    for number in parts.iter().copied().flatten() {
        bytes.extend_from_slice(&(*number as f32).to_le_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_frame_is_sent_with_its_numbers_where_the_header_says() {
        let particles = PolyData {
            points: vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
            columns: vec![
                ("radius".to_owned(), Numbers::Scalar(vec![0.5, 0.25])),
                ("v".to_owned(), Numbers::Vector(vec![[3.0, 0.0, 4.0], [0.0, 0.0, -2.0]])),
            ],
        };
        let surfaces =
            PolyData { points: vec![[0.0, 0.0, 7.0], [1.0, 0.0, 7.0], [0.0, 1.0, 7.0]], columns: vec![] };
        let frame = Frame { particles, surfaces, ..Frame::default() };
        let bytes = super::particles(0.125, &frame, Some("v")).unwrap();
        let length = u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
        assert_eq!((&bytes[..4], length % 4), (&b"PVP1"[..], 0));
        let header: Value = serde_json::from_slice(&bytes[8..8 + length]).unwrap();
        assert_eq!((header["time"].as_f64(), header["particles"].as_u64()), (Some(0.125), Some(2)));
        let numbers: Vec<f32> = bytes[8 + length..]
            .chunks_exact(4)
            .map(|four| f32::from_le_bytes(four.try_into().unwrap()))
            .collect();
        assert_eq!(numbers[..10], [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 0.5, 0.25, 5.0, 2.0]);
        assert_eq!(header["triangles"].as_u64(), Some(1));
        assert_eq!(numbers[10..], [0.0, 0.0, 7.0, 1.0, 0.0, 7.0, 0.0, 1.0, 7.0]);
        assert_eq!(super::particles(0.0, &frame, Some("w")), None);
    }
}
