//! All that a frame holds of one particle.

use pulvis_io::vtk::{Frame, Numbers, PolyData};
use serde_json::{Value, json};

/// Values of a row and its contacts, with all digits; `None` where there is no such row.
pub(super) fn values(frame: &Frame, row: usize) -> Option<Value> {
    let particles = &frame.particles;
    let position = particles.points.get(row)?;
    let ids = match particles.column("id") {
        Some(Numbers::Integer(ids)) => ids.as_slice(),
        _ => &[],
    };
    let id = ids.get(row).copied();
    Some(json!({
        "row": row,
        "id": id,
        "position": position,
        "columns": columns(particles, row),
        "contacts": id.map_or_else(|| json!([]), |id| contacts(frame, ids, id)),
    }))
}

fn columns(data: &PolyData, row: usize) -> Value {
    let named = data.columns.iter().map(|(name, numbers)| json!({ "name": name, "value": at(numbers, row) }));
    named.collect()
}

fn at(numbers: &Numbers, row: usize) -> Value {
    match numbers {
        Numbers::Scalar(values) => json!(values.get(row)),
        Numbers::Integer(values) => json!(values.get(row)),
        Numbers::Vector(values) => json!(values.get(row)),
        Numbers::Tensor(values) => json!(values.get(row)),
    }
}

/// Contacts with the other's id and row, or the number of the wall.
fn contacts(frame: &Frame, ids: &[i64], id: i64) -> Value {
    let ends = |name| match frame.contacts.column(name) {
        Some(Numbers::Integer(values)) => values.as_slice(),
        _ => &[],
    };
    let pairs = ends("id1").iter().zip(ends("id2")).enumerate();
    let own = pairs.filter(|(_, (first, second))| **first == id || **second == id);
    let contact = |(number, (first, second)): (usize, (&i64, &i64))| {
        let other = if *first == id { *second } else { *first };
        json!({
            "id": (other >= 0).then_some(other),
            "row": ids.binary_search(&other).ok(),
            "wall": (other < 0).then_some(-1 - other),
            "columns": columns(&frame.contacts, number),
        })
    };
    own.map(contact).collect()
}
