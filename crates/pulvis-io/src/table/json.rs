//! JSON: an array with one object per row.

use super::{Cell, Format, Table};
use serde::ser::{Serialize, SerializeMap, SerializeSeq, Serializer};

/// An array of objects, keys in the order of the columns.
pub(super) const FORMAT: Format = Format {
    name: "json",
    extension: "json",
    summary: "array of one object per row, exact numbers, null for what is missing or not finite, for programs",
    write: |table, out| {
        serde_json::to_writer_pretty(&mut *out, &Rows(table))?;
        out.write_all(b"\n")
    },
};

struct Rows<'a>(&'a Table);

struct Row<'a>(&'a [String], &'a [Cell]);

impl Serialize for Rows<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut sequence = serializer.serialize_seq(Some(self.0.rows().len()))?;
        for row in self.0.rows() {
            sequence.serialize_element(&Row(self.0.columns(), row))?;
        }
        sequence.end()
    }
}

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, cell) in self.0.iter().zip(self.1) {
            match cell {
                // serde_json itself writes null for numbers that are not finite.
                Cell::Number(value) => map.serialize_entry(name, value)?,
                Cell::Text(words) => map.serialize_entry(name, words)?,
                Cell::Empty => map.serialize_entry(name, &())?,
            }
        }
        map.end()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn numbers_are_exact_and_what_is_not_finite_is_null() {
        let mut table = Table::new(["z", "a", "m"]);
        table.push([Cell::Number(0.1 + 0.2), Cell::Number(f64::NAN), Cell::Empty]).unwrap();
        table.push([Cell::Number(5e-324), Cell::from("é\""), Cell::Number(f64::INFINITY)]).unwrap();
        let text = table.to_string(&FORMAT).unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value[0]["z"].as_f64(), Some(0.1 + 0.2));
        assert!(value[0]["a"].is_null() && value[0]["m"].is_null() && value[1]["m"].is_null());
        assert_eq!(value[1]["z"].as_f64(), Some(5e-324));
        assert_eq!(value[1]["a"].as_str(), Some("é\""));
        assert!(text.find("\"z\"") < text.find("\"a\""), "columns keep their order");
    }
}
