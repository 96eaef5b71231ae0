//! Values as TOML that reads back to the same bits.

use pulvis_math::{Dimension, Vector3};
use std::fmt::Write;

/// Grows a TOML text line by line.
#[derive(Debug, Default)]
pub(in crate::scenario) struct Writer {
    text: String,
}

impl Writer {
    /// A comment; line breaks would end it.
    pub(in crate::scenario) fn comment(&mut self, comment: &str) {
        let comment: String = comment.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        self.line(&format!("# {comment}"));
    }

    /// An empty line and the header of a table.
    pub(in crate::scenario) fn table(&mut self, header: &str) {
        self.line(&format!("\n[{header}]"));
    }

    /// An empty line and the header of one more table of a list.
    pub(in crate::scenario) fn item(&mut self, header: &str) {
        self.line(&format!("\n[[{header}]]"));
    }

    /// `key = value`, the value as TOML.
    pub(in crate::scenario) fn key(&mut self, key: &str, value: impl AsRef<str>) {
        self.line(&format!("{key} = {}", value.as_ref()));
    }

    pub(in crate::scenario) fn finish(self) -> String {
        self.text
    }

    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }
}

/// A pure number. The shortest decimal that reads back to the same number, as `{:?}` writes it.
pub(in crate::scenario) fn number(value: f64) -> String {
    format!("{value:?}")
}

/// A quantity with its SI unit; a pure number needs no quotes.
pub(in crate::scenario) fn quantity(value: f64, dimension: Dimension) -> String {
    match dimension {
        Dimension::NONE => number(value),
        _ if value.is_infinite() => "\"inf\"".to_owned(),
        _ => format!("\"{value:?} {}\"", dimension.unit()),
    }
}

/// Three components with their unit.
pub(in crate::scenario) fn vector(value: Vector3, dimension: Dimension) -> String {
    list(value.to_array().iter().map(|component| quantity(*component, dimension)))
}

/// A list of values that are TOML already.
pub(in crate::scenario) fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", items.into_iter().collect::<Vec<_>>().join(", "))
}

/// A text in quotes.
pub(in crate::scenario) fn text(value: &str) -> String {
    let mut quoted = String::with_capacity(value.len() + 2);
    quoted.push('"');
    for c in value.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                // Writing into a text cannot fail.
                let _ = write!(quoted, "\\u{:04x}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// A key, in quotes only where TOML needs them.
pub(in crate::scenario) fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    if !name.is_empty() && name.chars().all(bare) { name.to_owned() } else { text(name) }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;
    use crate::{Document, QuantityRule, Text, parse_quantity};

    #[test]
    fn numbers_come_back_bit_by_bit() {
        for value in [0.1 + 0.2, 1e-300, -5e-324, f64::MAX, 4.0e7, 0.0] {
            let written = quantity(value, Dimension::PRESSURE);
            let read = parse_quantity(written.trim_matches('"'), Dimension::PRESSURE);
            assert_eq!(read.unwrap().to_bits(), value.to_bits(), "{written}");
        }
        let rule = QuantityRule::of(Dimension::STIFFNESS).or_infinite();
        assert_eq!(quantity(f64::INFINITY, Dimension::STIFFNESS), "\"inf\"");
        assert_eq!(parse_quantity("inf", rule), Ok(f64::INFINITY));
    }

    #[test]
    fn any_text_comes_back() {
        let awkward = "a \"b\" \\ c\nd\te \u{7f} µ";
        let mut writer = Writer::default();
        writer.comment("two\nlines");
        writer.key(&key("a b"), text(awkward));
        let document = Document::from_str("a.toml", &writer.finish()).unwrap();
        let read = document.read(|mut root| {
            let value = root.required("a b", Text);
            root.finish();
            value
        });
        assert_eq!(read.unwrap(), awkward);
    }
}
